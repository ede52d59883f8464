/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/curve.h"
#include "mesh/obj_lines.h"
#include "mesh/obj_twins.h"
#include "system/path.h"

_Static_assert(sizeof(HdVec3) == 3 * sizeof(double), "three numbers of the text are a vector");

/* A growing array. */
typedef struct Row {
    void *data; /* owned */
    size_t count, capacity;
} Row;

/* Elements that corners of faces name by number. */
typedef enum Kind { VERTEX, UV, NORMAL, KIND_COUNT } Kind;

typedef struct Elements {
    Row row;         /* 3 doubles for vertices and normals, 2 for texture coordinates */
    int64_t highest; /* highest number named by a face, from 1; 0: none */
    size_t line_of_highest;
    size_t first_line; /* first line that names one */
} Elements;

typedef struct Face {
    int32_t corner_count, material; /* index into `names` */
} Face;

/* Indices of elements from 0; -1: none. */
typedef struct Corner {
    int32_t element[KIND_COUNT];
} Corner;

typedef struct Text {
    HdObjLines lines;
    HdProblems *fault_list, *notes;
    HdFaults faults; /* of this file, not yet in the list */

    Elements elements[KIND_COUNT];
    Row colours; /* of the first vertices, as written */
    double largest_colour;
    Row faces;
    Row corners; /* corners of the faces, in order */
    int64_t triangle_count;
    int32_t max_corners; /* maximum of a face */
    HdNameTable names;   /* names of materials */
    Row libraries;       /* zero-terminated names, as in the file */

    int32_t material; /* -1: none named yet */
    bool has_noted_unused;
    size_t wrong_vertex_count;
    size_t line_of_wrong_vertex; /* of the first one, */
    char wrong_vertex[256];      /* and what is wrong with it */
} Text;

/* Appends copies of `count` elements of `size` bytes to the row. */
static inline bool append(Text *text, Row *row, size_t size, size_t count, const void *elements) {
    if (count > row->capacity - row->count) {
        const size_t capacity = row->capacity + row->capacity / 2 + count + 16;
        void *grown = hd_obj_resize(text->lines.memory, row->data, size, row->capacity, capacity);
        if (grown == NULL)
            return hd_obj_fail_allocation(&text->lines);
        row->data = grown;
        row->capacity = capacity;
    }
    memcpy((char *)row->data + row->count * size, elements, count * size);
    row->count += count;
    return true;
}

/* ---- statements ---- */

enum {
    MAX_DIGITS = 9,                  /* of an element's number; ten might overflow int32_t */
    MAX_ELEMENTS = 322 * 1000 * 1000 /* maximum of a kind */
};

static const struct {
    const char *name, *plural;
    int min_numbers, max_numbers; /* numbers of an element */
} kinds[KIND_COUNT] = {{"vertex", "vertices", 3, 3},
                       {"texture coordinate", "texture coordinates", 1, 2},
                       {"normal", "normals", 3, 3}};

/* Statements that have no effect here, or that can be ignored. */
static const char *const harmless[] = {"o",   "g",     "s",        "usemap",  "maplib",
                                       "lod", "bevel", "c_interp", "d_interp"};

#define fail_line(text, ...) hd_obj_fail_at(&(text)->lines, (text)->lines.line_number, __VA_ARGS__)

/* Passes over a fault of this line. */
#define pass_over(text, kind, format, ...)                                                         \
    hd_fault(&(text)->faults, kind, 1, "line %zu: " format, (text)->lines.line_number, __VA_ARGS__)

/* Hides words of a file that is no OBJ by its name or contents: they may be confidential. */
static HdSpan quoted(const Text *text, HdSpan word) {
    const bool is_obj = text->elements[VERTEX].row.count > text->wrong_vertex_count ||
                        hd_path_has_ending(text->lines.path, ".obj");
    return is_obj ? word : hd_span_of("...");
}

/* Arguments for "%.*s". */
#define shown(text, word) hd_span_shown(quoted(text, word)), quoted(text, word).begin

static bool is_statement_end(HdSpan word) {
    return word.begin == word.end || *word.begin == '#';
}

/* A wrong vertex is an error only if a face uses it. */
static void pass_over_number(Text *text, Kind kind, int number, HdSpan word, const char *expected) {
    if (kind == NORMAL)
        pass_over(text, "vn", "number %d of a normal is '%.*s', expected %s; its corners are flat",
                  number, shown(text, word), expected);
    else if (kind == UV)
        pass_over(text, "vt",
                  "number %d of a texture coordinate is '%.*s', expected %s; it becomes 0", number,
                  shown(text, word), expected);
    else if (text->wrong_vertex_count++ == 0) {
        text->line_of_wrong_vertex = text->lines.line_number;
        snprintf(text->wrong_vertex, sizeof text->wrong_vertex,
                 "number %d of a vertex is '%.*s', expected %s", number, shown(text, word),
                 expected);
    }
}

/* Ignores further numbers; optional numbers that are missing are 0. Rounds all but vertices to
   float. A wrong vertex becomes (NaN, line, 0), other wrong elements become 0. */
static void read_numbers(Text *text, Kind kind, HdSpan line, double numbers[3]) {
    for (int i = 0; i < kinds[kind].max_numbers; i++) {
        const HdSpan word = hd_next_word(&line);
        if (i >= kinds[kind].min_numbers && is_statement_end(word))
            break;
        const char *fault = hd_number_fault(word, &numbers[i]);
        if (fault != NULL) {
            pass_over_number(text, kind, i + 1, word, fault);
            numbers[0] = kind == VERTEX ? (double)NAN : 0.0;
            numbers[1] = kind == VERTEX ? (double)text->lines.line_number : 0.0;
            numbers[2] = 0.0;
            return;
        }
        if (kind != VERTEX)
            numbers[i] = (double)(float)numbers[i];
    }
}

static bool keep_numbers(Text *text, Kind kind, HdSpan line) {
    double numbers[3] = {0.0, 0.0, 0.0};
    read_numbers(text, kind, line, numbers);
    Row *row = &text->elements[kind].row;
    if (row->count == MAX_ELEMENTS)
        return fail_line(text, "there are more than %d %s", (int)MAX_ELEMENTS, kinds[kind].plural);
    return append(text, row, (size_t)kinds[kind].max_numbers * sizeof *numbers, 1, numbers);
}

/* Keeps the colour of the last vertex, if the line has one after the place. Earlier vertices
   without one are white. */
static bool keep_colour(Text *text, HdSpan line) {
    static const double white[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}; /* on either scale */
    const size_t vertices = text->elements[VERTEX].row.count;
    double colour[3];
    for (int i = 0; i < 3; i++)
        hd_next_word(&line);
    for (int i = 0; i < 3; i++) {
        const HdSpan word = hd_next_word(&line);
        if (is_statement_end(word) || hd_number_fault(word, &colour[i]) != NULL)
            return true;
    }
    for (int i = 0; i < 3; i++)
        text->largest_colour = fmax(text->largest_colour, colour[i]);
    while (text->colours.count < vertices - 1)
        if (!append(text, &text->colours, sizeof white, 1, white))
            return false;
    return append(text, &text->colours, sizeof colour, 1, colour);
}

/* Reads "-12" or "12"; without digits, `*number` is 0. Returns NULL if there are too many
   digits. */
static const char *read_index(const char *at, const char *end, bool *has_digits, int64_t *number) {
    const bool is_negative = at < end && *at == '-';
    int64_t value = 0;
    int digits = 0;
    if (is_negative)
        at++;
    for (; at < end && *at >= '0' && *at <= '9'; at++) {
        if (++digits > MAX_DIGITS)
            return NULL;
        value = 10 * value + (*at - '0');
    }
    *has_digits = digits > 0;
    *number = is_negative ? -value : value;
    return is_negative && digits == 0 ? NULL : at;
}

/* Positive numbers may name later elements; `finish` checks the highest. */
static bool keep_index(Text *text, Kind kind, int64_t number, HdSpan word, Corner *corner) {
    Elements *elements = &text->elements[kind];
    const int64_t absolute = number < 0 ? (int64_t)elements->row.count + 1 + number : number;
    if (absolute > elements->highest) {
        if (elements->highest == 0)
            elements->first_line = text->lines.line_number;
        elements->highest = absolute;
        elements->line_of_highest = text->lines.line_number;
    }
    corner->element[kind] = (int32_t)(absolute - 1);
    if (absolute > 0)
        return true;
    if (kind == VERTEX || (number < 0 && elements->row.count > 0))
        return fail_line(text,
                         "corner '%.*s' of a face names %s %lld, expected 1 and up, or -1 to "
                         "-%zu counted back from here",
                         shown(text, word), kinds[kind].name, (long long)number,
                         elements->row.count);
    corner->element[kind] = -1;
    pass_over(text, kinds[kind].plural,
              "corner '%.*s' of a face names %s %lld, expected 1 and up; it counts as not given",
              shown(text, word), kinds[kind].name, (long long)number);
    return true;
}

/* Reads "v", "v/t", "v//n" or "v/t/n". */
static bool read_corner(Text *text, HdSpan word, Corner *corner) {
    const char *at = word.begin;
    *corner = (Corner){{-1, -1, -1}};
    for (int kind = VERTEX; kind < KIND_COUNT; kind++) {
        int64_t number;
        bool is_there;
        at = read_index(at, word.end, &is_there, &number);
        if (at == NULL || (kind == VERTEX && !is_there))
            break;
        if (is_there && !keep_index(text, (Kind)kind, number, word, corner))
            return false;
        if (at == word.end)
            return true;
        if (*at++ != '/')
            break;
    }
    return fail_line(
        text,
        "corner '%.*s' of a face, expected numbers of a vertex, texture coordinate and "
        "normal as 1, 1/2, 1//3 or 1/2/3",
        shown(text, word));
}

static bool keep_corner(Text *text, HdSpan word) {
    Corner corner;
    return read_corner(text, word, &corner) &&
           append(text, &text->corners, sizeof corner, 1, &corner);
}

static bool set_material(Text *text, HdSpan name) {
    const int number = hd_name_table_add(&text->names, name, text->lines.memory);
    if (number == HD_NAME_NO_MEMORY)
        return hd_obj_fail_allocation(&text->lines);
    if (number == HD_NAME_TOO_MANY)
        return fail_line(text, "there are more materials than fit, expected at most %d",
                         (int)HD_MAX_MESH_MATERIALS);
    text->material = number;
    return true;
}

static bool keep_face(Text *text, HdSpan line) {
    int32_t count = 0;
    for (HdSpan word = hd_next_word(&line); !is_statement_end(word); word = hd_next_word(&line)) {
        if (!keep_corner(text, word))
            return false;
        count++;
    }
    if (count < 3) {
        pass_over(text, "f", "a face has %d corner%s, expected at least 3; it is left out",
                  (int)count, count == 1 ? "" : "s");
        text->corners.count -= (size_t)count;
        return true;
    }
    if (text->material < 0 && !set_material(text, hd_span_of(HD_OBJ_NO_MATERIAL)))
        return false;
    if (!append(text, &text->faces, sizeof(Face), 1, &(Face){count, text->material}))
        return false;
    text->triangle_count += count - 2;
    if (count > text->max_corners)
        text->max_corners = count;
    if (text->triangle_count > HD_MAX_MESH_TRIANGLES)
        return fail_line(text, "there are more than %d triangles", (int)HD_MAX_MESH_TRIANGLES);
    return true;
}

static bool keep_material(Text *text, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    if (fault == NULL)
        return set_material(text, name);
    pass_over(text, "usemtl",
              "usemtl has no usable name, expected %s; the default material applies", fault);
    return set_material(text, hd_span_of(HD_OBJ_NO_MATERIAL));
}

static bool keep_library(Text *text, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    if (fault == NULL)
        return append(text, &text->libraries, 1, hd_span_size(name), name.begin) &&
               append(text, &text->libraries, 1, 1, "");
    pass_over(text, "mtllib", "mtllib has no usable name, expected %s; it is left out", fault);
    return true;
}

/* Notes the first unused statement. Files of other kinds seldom begin with a word. */
static bool note_unused(Text *text, HdSpan word) {
    for (const char *at = word.begin; at < word.end; at++)
        if (*at <= ' ' || *at > '~')
            return fail_line(text, "it begins with byte 0x%02x, so it is no OBJ file",
                             (unsigned)(unsigned char)*at);
    for (size_t i = 0; i < sizeof harmless / sizeof *harmless; i++)
        if (hd_span_is(word, harmless[i]))
            return true;
    if (!text->has_noted_unused)
        hd_problem(text->notes,
                   "%s: line %zu: statements such as '%.*s' are not used, only faces (f) are",
                   text->lines.path, text->lines.line_number, shown(text, word));
    text->has_noted_unused = true;
    return true;
}

static bool take_line(Text *text, HdSpan line) {
    const HdSpan word = hd_next_word(&line);
    if (is_statement_end(word))
        return true;
    if (hd_span_is(word, "v"))
        return keep_numbers(text, VERTEX, line) && keep_colour(text, line);
    if (hd_span_is(word, "f"))
        return keep_face(text, line);
    if (hd_span_is(word, "vn"))
        return keep_numbers(text, NORMAL, line);
    if (hd_span_is(word, "vt"))
        return keep_numbers(text, UV, line);
    if (hd_span_is(word, "usemtl"))
        return keep_material(text, line);
    if (hd_span_is(word, "mtllib"))
        return keep_library(text, line);
    return note_unused(text, word);
}

/* If the file has no element of the kind, indices into its list count as not given. */
static void pass_over_missing(Text *text, Kind kind) {
    Elements *elements = &text->elements[kind];
    Corner *corners = text->corners.data;
    size_t count = 0;
    if (elements->row.count > 0 || elements->highest == 0)
        return;
    for (size_t i = 0; i < text->corners.count; i++) {
        count += corners[i].element[kind] >= 0;
        corners[i].element[kind] = -1;
    }
    elements->highest = 0;
    hd_fault(&text->faults, kinds[kind].name, count,
             "line %zu: a face names a %s, and there are none; it counts as not given",
             elements->first_line, kinds[kind].name);
}

static bool fail_vertex(Text *text, HdVec3 vertex) {
    const size_t line = (size_t)vertex.y;
    return hd_obj_fail_at(&text->lines, line, "%s",
                          line == text->line_of_wrong_vertex
                              ? text->wrong_vertex
                              : "a vertex that a face uses, expected three decimal numbers");
}

/* Returns whether no face uses a vertex with wrong numbers. */
static bool check_vertices(Text *text) {
    HdVec3 *vertices = text->elements[VERTEX].row.data;
    const Corner *corners = text->corners.data;
    if (text->wrong_vertex_count == 0)
        return true;
    for (size_t i = 0; i < text->corners.count; i++)
        if (isnan(vertices[corners[i].element[VERTEX]].x))
            return fail_vertex(text, vertices[corners[i].element[VERTEX]]);
    for (size_t i = 0; i < text->elements[VERTEX].row.count; i++)
        if (isnan(vertices[i].x))
            vertices[i] = hd_vec3(0.0, 0.0, 0.0);
    hd_fault(&text->faults, "v", text->wrong_vertex_count, "line %zu: %s; no face uses it",
             text->line_of_wrong_vertex, text->wrong_vertex);
    return true;
}

static bool check_indices(Text *text) {
    for (int kind = 0; kind < KIND_COUNT; kind++) {
        const Elements *elements = &text->elements[kind];
        if (elements->highest > (int64_t)elements->row.count)
            return hd_obj_fail_at(&text->lines, elements->line_of_highest,
                                  "a face names %s %lld, and there are %zu %s", kinds[kind].name,
                                  (long long)elements->highest, elements->row.count,
                                  kinds[kind].plural);
    }
    return true;
}

/* Checks the whole file: whether it has faces, and the elements that they name. */
static HdStatus finish(Text *text) {
    if (text->lines.status != HD_OK)
        return text->lines.status;
    pass_over_missing(text, UV);
    pass_over_missing(text, NORMAL);
    if (check_indices(text) && check_vertices(text) && text->faces.count == 0)
        hd_obj_fail_reading(&text->lines,
                            text->elements[VERTEX].row.count > text->wrong_vertex_count
                                ? "it has vertices, but no faces"
                                : "it has no faces, so it is empty or no OBJ file "
                                  "(of other formats, such as STL, PLY and glTF, "
                                  "Blender or assimp can make one)");
    return text->lines.status;
}

static HdStatus read_text(Text *text) {
    HdSpan line;
    text->material = -1;
    if (hd_obj_lines_open(&text->lines))
        while (hd_obj_lines_next(&text->lines, &line) && take_line(text, line))
            continue;
    hd_obj_lines_close(&text->lines);
    return finish(text);
}

/* Returns the elements as an array of exact size; free() releases it. */
static void *release_numbers(Text *text, Kind kind) {
    Row *row = &text->elements[kind].row;
    const size_t size = (size_t)kinds[kind].max_numbers * sizeof(double);
    void *fitting = hd_obj_resize(text->lines.memory, row->data, size, row->capacity, row->count);
    void *numbers = fitting != NULL ? fitting : row->data;
    row->data = NULL;
    return numbers;
}

static void free_text(Text *text) {
    for (int kind = 0; kind < KIND_COUNT; kind++)
        free(text->elements[kind].row.data);
    free(text->colours.data);
    free(text->faces.data);
    free(text->corners.data);
    free(text->libraries.data);
    hd_name_table_free(&text->names);
}

/* ---- from the text to the mesh ---- */

/* Moves the colours of vertices to the mesh as light. Exporters write sRGB, up to 1 or 255. */
static bool move_colours(Text *text, HdMesh *mesh) {
    const double white = text->largest_colour > 1.0 ? 255.0 : 1.0;
    const size_t count = (size_t)mesh->vertex_count;
    const double *from = text->colours.data;
    if (from == NULL)
        return true;
    double *to = hd_obj_allocate(text->lines.memory, count, sizeof *mesh->colours);
    if (to == NULL)
        return false;
    for (size_t i = 0; i < 3 * count; i++) {
        const double share = i < 3 * text->colours.count ? from[i] / white : 1.0;
        to[i] = hd_curve_to_linear(HD_CURVE_SRGB, fmin(fmax(share, 0.0), 1.0));
    }
    mesh->colours = (HdVec3 *)to;
    return true;
}

/* Moves the elements to the mesh; drops texture coordinates and normals that no corner names. */
static void move_elements(Text *text, HdMesh *mesh) {
    const Elements *elements = text->elements;
    mesh->vertices = release_numbers(text, VERTEX);
    mesh->vertex_count = (int)elements[VERTEX].row.count;
    if (elements[NORMAL].highest > 0) {
        mesh->normals = release_numbers(text, NORMAL);
        mesh->normal_count = (int)elements[NORMAL].row.count;
    }
    if (elements[UV].highest > 0) {
        mesh->uvs = release_numbers(text, UV);
        mesh->uv_count = (int)elements[UV].row.count;
    }
}

static bool allocate_triangles(const Text *text, HdMesh *mesh) {
    HdObjMemory *memory = text->lines.memory;
    const size_t count = (size_t)text->triangle_count;
    mesh->corners = hd_obj_allocate(memory, count, sizeof *mesh->corners);
    if (mesh->normals != NULL)
        mesh->corner_normals = hd_obj_allocate(memory, count, sizeof *mesh->corner_normals);
    if (mesh->uvs != NULL)
        mesh->corner_uvs = hd_obj_allocate(memory, count, sizeof *mesh->corner_uvs);
    if (text->names.count > 1)
        mesh->material_of = hd_obj_allocate(memory, count, sizeof *mesh->material_of);
    return !memory->has_refused;
}

/* A normal of length 0 has no direction. */
static int32_t normal_of(const HdMesh *mesh, int32_t number) {
    if (number < 0)
        return -1;
    const HdVec3 normal = mesh->normals[number];
    return normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0 ? -1 : number;
}

static void add_triangle(HdMesh *mesh, const Corner *corners, const int32_t chosen[3],
                         int32_t material) {
    const int triangle = mesh->triangle_count++;
    for (int i = 0; i < 3; i++) {
        const int32_t *element = corners[chosen[i]].element;
        mesh->corners[triangle][i] = element[VERTEX];
        if (mesh->corner_normals != NULL)
            mesh->corner_normals[triangle][i] = normal_of(mesh, element[NORMAL]);
        if (mesh->corner_uvs != NULL)
            mesh->corner_uvs[triangle][i] = element[UV];
    }
    if (mesh->material_of != NULL)
        mesh->material_of[triangle] = material;
}

/* Rounds the vertices to float, unless they lie so far from the origin that this loses digits of
   the shape. */
static void round_vertices(const Text *text, HdMesh *mesh) {
    static const double farthest = 4.0; /* in halves of the longest side */
    const Corner *corners = text->corners.data;
    HdVec3 lower = mesh->vertices[corners[0].element[VERTEX]], upper = lower;
    for (size_t i = 1; i < text->corners.count; i++) {
        const HdVec3 at = mesh->vertices[corners[i].element[VERTEX]];
        /* Without calls of fmin and fmax, which take most of the time here. */
        lower = hd_vec3(at.x < lower.x ? at.x : lower.x, at.y < lower.y ? at.y : lower.y,
                        at.z < lower.z ? at.z : lower.z);
        upper = hd_vec3(at.x > upper.x ? at.x : upper.x, at.y > upper.y ? at.y : upper.y,
                        at.z > upper.z ? at.z : upper.z);
    }
    const double half_side = 0.5 * hd_largest(hd_sub(upper, lower));
    if (fmax(hd_largest(lower), hd_largest(upper)) > farthest * half_side)
        return;
    /* One by one: GCC 12 drops the conversions of a whole vector. */
    double *numbers = &mesh->vertices[0].x;
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++)
        numbers[i] = (double)(float)numbers[i];
}

/* Capacity for the largest polygon. */
typedef struct Polygon {
    HdVec3 *points;
    int32_t (*triangles)[3];
} Polygon;

static bool cut_face(HdMesh *mesh, const Polygon *capacity, const Corner *corners, int count,
                     int32_t material) {
    static const int32_t in_order[3] = {0, 1, 2};
    if (count == 3) {
        add_triangle(mesh, corners, in_order, material);
        return true;
    }
    for (int i = 0; i < count; i++)
        capacity->points[i] = mesh->vertices[corners[i].element[VERTEX]];
    if (!hd_polygon_cut(capacity->points, count, capacity->triangles))
        return false;
    for (int i = 0; i < count - 2; i++)
        add_triangle(mesh, corners, capacity->triangles[i], material);
    return true;
}

static HdStatus add_faces(const Text *text, HdMesh *mesh, const Polygon *capacity,
                          HdObjTwins *twins) {
    const Corner *corners = text->corners.data;
    size_t twin_count = 0;
    for (size_t i = 0; i < text->faces.count; i++) {
        const Face *face = (const Face *)text->faces.data + i;
        const int32_t material = text->names.names[face->material].stand_in;
        if (hd_obj_is_twin(twins, &corners->element[VERTEX], face->corner_count))
            twin_count++;
        else if (!cut_face(mesh, capacity, corners, face->corner_count, material))
            return hd_fail(text->lines.error, HD_BAD_INPUT,
                           "%s: face %zu is not convex and has %d corners, expected at most %d",
                           text->lines.path, i + 1, (int)face->corner_count,
                           (int)HD_MAX_CONCAVE_CORNERS);
        corners += face->corner_count;
    }
    if (twin_count > 0)
        hd_problem(
            text->notes,
            "%s: %zu of its faces coincide with earlier ones, corner by corner, and are left "
            "out",
            text->lines.path, twin_count);
    return HD_OK;
}

static HdStatus take_faces(const Text *text, HdMesh *mesh) {
    HdObjMemory *memory = text->lines.memory;
    const size_t most = (size_t)text->max_corners;
    const Polygon capacity = {hd_obj_allocate(memory, most, sizeof *capacity.points),
                              hd_obj_allocate(memory, most, sizeof *capacity.triangles)};
    HdObjTwins twins = {0};
    const bool has_memory =
        capacity.points != NULL && capacity.triangles != NULL && allocate_triangles(text, mesh) &&
        hd_obj_twins_begin(&twins, mesh->vertices, KIND_COUNT, text->faces.count, memory);
    const HdStatus status =
        has_memory ? add_faces(text, mesh, &capacity, &twins) : hd_obj_fail_memory(&text->lines);
    hd_obj_twins_end(&twins, memory);
    free(capacity.points);
    free(capacity.triangles);
    return status;
}

static HdStatus take_mesh(Text *text, HdMesh *mesh) {
    HdObjMemory *memory = text->lines.memory;
    HdMapOptions *options = NULL;
    move_elements(text, mesh);
    round_vertices(text, mesh);
    hd_faults_report(&text->faults, text->lines.path, text->fault_list);
    HdStatus status = HD_OK;
    if (!move_colours(text, mesh) ||
        !hd_obj_read_materials(mesh, text->lines.path, &text->names, text->libraries.data,
                               text->libraries.count, &options, memory, text->fault_list,
                               text->notes))
        status = hd_obj_fail_memory(&text->lines);
    if (status == HD_OK)
        status = take_faces(text, mesh);
    if (status == HD_OK && !hd_obj_place_pictures(mesh, options, memory))
        status = hd_obj_fail_memory(&text->lines);
    free(options);
    HD_TRY(status);
    const int count = mesh->triangle_count;
    hd_mesh_drop_degenerate(mesh);
    if (mesh->triangle_count == 0)
        return hd_fail(text->lines.error, HD_BAD_INPUT, "%s: none of its %d triangles has an area",
                       text->lines.path, count);
    return HD_OK;
}

HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t max_bytes, HdProblems *faults,
                          HdProblems *notes, HdError *error) {
    HdObjMemory memory = {.max_bytes = max_bytes};
    Text text = {.lines = {.path = path, .memory = &memory, .error = error},
                 .fault_list = faults,
                 .notes = notes};
    *mesh = (HdMesh){0};
    HdStatus status = read_text(&text);
    if (status == HD_OK)
        status = take_mesh(&text, mesh);
    free_text(&text);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}
