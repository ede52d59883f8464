/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "mesh/obj/read.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "mesh/obj/reading.h"
#include "system/path.h"

_Static_assert(sizeof(HdVec3) == 3 * sizeof(double), "three numbers of the text are a vector");

/* What corners of faces refer to by number. */
typedef enum Kind { VERTEX, UV, NORMAL, KIND_COUNT } Kind;

typedef struct Elements {
    double *numbers; /* owned; of each, 3 of vertices and normals and 2 of texture coordinates, all
                        rounded to float */
    size_t count, room;
    int64_t highest; /* the number, from 1, that a face names; 0: none */
    size_t line_of_highest;
} Elements;

typedef struct Face {
    int32_t corner_count, material; /* a number of `names` */
} Face;

/* Numbers of elements from 0; -1: none. */
typedef struct Corner {
    int32_t element[KIND_COUNT];
} Corner;

typedef struct Text {
    const char *path;
    HdObjMemory *memory;
    HdProblems *notes;
    HdError *error;

    Elements elements[KIND_COUNT];
    Face *faces; /* owned */
    size_t face_count, face_room;
    Corner *corners; /* owned; of one face after the other */
    size_t corner_count, corner_room;
    int64_t triangle_count;
    int32_t most_corners; /* of a face */
    HdNameTable names;    /* of materials */
    char *libraries;      /* owned; their names as the file has them, each with a zero byte */
    size_t libraries_size, libraries_room;

    HdStatus status;  /* of the reading so far */
    int32_t material; /* -1: none has been named */
    bool has_left_out;
    int descriptor;
    char *raw; /* what has been read and not yet taken */
    size_t raw_begin, raw_end;
    char *line;         /* the one that was taken last, with those that continue it */
    size_t line_number; /* where it begins */
    size_t lines_read;
} Text;

/* ---- lines ---- */

enum { RAW_SIZE = 1 << 17, TEXT_SIZE = 2 * HD_OBJ_MOST_LINE + 1 };

static const char byte_order_mark[] = "\xef\xbb\xbf";

/* These set `status` and the error, and return false. */
static bool fail_reading(Text *text, const char *reason) {
    text->status =
        hd_fail(text->error, HD_BAD_INPUT, "cannot read the mesh %s: %s", text->path, reason);
    return false;
}

static bool fail_room(Text *text) {
    text->status = hd_obj_fail_memory(text->memory, text->path, text->error);
    return false;
}

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static bool
fail_at(Text *text, size_t line, const char *format, ...) {
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    text->status =
        hd_fail(text->error, HD_BAD_INPUT, "%s: line %zu: %s", text->path, line, message);
    return false;
}

/* Reads what comes next. False: there is nothing, or it cannot be read. */
static bool fill(Text *text) {
    const ssize_t count = hd_read_fully(text->descriptor, text->raw, RAW_SIZE);
    if (count < 0)
        return fail_reading(text, strerror(errno));
    text->raw_begin = 0;
    text->raw_end = (size_t)count;
    return count > 0;
}

static bool has_next(Text *text) {
    return text->raw_begin < text->raw_end || fill(text);
}

static bool open_file(Text *text) {
    struct stat found;
    /* Not blocking, lest a named pipe stops the program before it is refused. */
    text->descriptor = open(text->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (text->descriptor < 0 || fstat(text->descriptor, &found) != 0)
        return fail_reading(text, strerror(errno));
    if (S_ISDIR(found.st_mode))
        return fail_reading(text, strerror(EISDIR));
    if (!S_ISREG(found.st_mode))
        return fail_reading(text, "it is not a regular file");
    return true;
}

static HdStatus open_text(Text *text) {
    if (!open_file(text))
        return text->status;
    text->raw = hd_obj_allocate(text->memory, RAW_SIZE, 1);
    text->line = hd_obj_allocate(text->memory, TEXT_SIZE, 1);
    if (text->raw == NULL || text->line == NULL)
        fail_room(text);
    else if (fill(text) && text->raw_end >= 3 && memcmp(text->raw, byte_order_mark, 3) == 0)
        text->raw_begin = 3;
    return text->status;
}

static void close_text(Text *text) {
    if (text->descriptor >= 0)
        close(text->descriptor);
    hd_obj_release(text->memory, text->raw, RAW_SIZE);
    hd_obj_release(text->memory, text->line, TEXT_SIZE);
}

static bool is_comment(const char *line, size_t length) {
    const HdSpan span = hd_rest((HdSpan){line, line + length});
    return span.begin < span.end && *span.begin == '#';
}

/* Takes what the buffer has of a line, which is put behind the `*length` bytes that `text` has of
   it; of what is too long only its beginning. Whether the line goes on, and is not refused. */
static bool take_piece(Text *text, char *line, size_t *length) {
    const char *begin = text->raw + text->raw_begin, *end = text->raw + text->raw_end;
    const char *at = begin;
    while (at < end && *at != '\n' && *at != '\r' && *at != '\0')
        at++;
    const size_t size = (size_t)(at - begin), room = HD_OBJ_MOST_LINE + 1 - *length;
    const size_t kept = size < room ? size : room;
    memcpy(line + *length, begin, kept);
    *length += kept;
    text->raw_begin += size;
    return at == end && (*length <= HD_OBJ_MOST_LINE || is_comment(line, *length)) && fill(text);
}

/* Takes a line's end: "\n", "\r\n" or, as old files have it, "\r". */
static bool take_end(Text *text) {
    if (!has_next(text))
        return text->status == HD_OK;
    const char end = text->raw[text->raw_begin++];
    if (end == '\0')
        return fail_at(text, text->lines_read, "it has a byte 0, so this is no OBJ file");
    if (end == '\r' && has_next(text) && text->raw[text->raw_begin] == '\n')
        text->raw_begin++;
    return text->status == HD_OK;
}

/* Takes a line of the file and puts it behind the `*used` bytes of those that it continues, but
   nothing of a comment. False: there is none, or something is wrong. */
static bool join_line(Text *text, size_t *used) {
    char *line = text->line + *used;
    size_t length = 0;
    if (!has_next(text))
        return false;
    text->lines_read++;
    while (take_piece(text, line, &length))
        continue;
    if (is_comment(line, length))
        length = 0;
    if (length > HD_OBJ_MOST_LINE)
        return fail_at(text, text->lines_read, "it is longer than %d bytes", HD_OBJ_MOST_LINE);
    *used += length;
    if (*used > HD_OBJ_MOST_LINE)
        return fail_at(text, text->line_number,
                       "with those that continue it, it is longer than %d bytes", HD_OBJ_MOST_LINE);
    return take_end(text);
}

/* Takes the next line, which lasts until another is taken: without its end, and of a comment
   nothing. False: there is none, or something is wrong. */
static bool next_line(Text *text, HdSpan *line) {
    size_t used = 0;
    text->line_number = text->lines_read + 1;
    bool is_taken = join_line(text, &used);
    while (is_taken && used > 0 && text->line[used - 1] == '\\') {
        text->line[used - 1] = ' ';
        is_taken = join_line(text, &used);
    }
    *line = (HdSpan){text->line, text->line + used};
    return text->status == HD_OK && (is_taken || used > 0);
}

/* ---- statements ---- */

enum {
    MOST_DIGITS = 9, /* of a number of an element; ten might leave the range of int32_t */
    MOST_ELEMENTS = 322 * 1000 * 1000 /* of a kind */
};

static const struct {
    const char *name, *plural;
    int least, most; /* numbers that it has */
} kinds[KIND_COUNT] = {{"vertex", "vertices", 3, 3},
                       {"texture coordinate", "texture coordinates", 1, 2},
                       {"normal", "normals", 3, 3}};

/* Statements that change nothing here, or that the file can do without. */
static const char *const harmless[] = {"o",   "g",     "s",        "usemap",  "maplib",
                                       "lod", "bevel", "c_interp", "d_interp"};

#define fail_line(text, ...) fail_at(text, (text)->line_number, __VA_ARGS__)

/* The words of a file that neither by its name nor by what it has said is an OBJ are nobody's
   business. */
static HdSpan quoted(const Text *text, HdSpan word) {
    static const char hidden[] = "...";
    if (text->elements[VERTEX].count > 0 || hd_path_has_ending(text->path, ".obj"))
        return word;
    return (HdSpan){hidden, hidden + strlen(hidden)};
}

/* For "%.*s". */
#define shown(text, word) hd_span_shown(quoted(text, word)), quoted(text, word).begin

static bool is_statement_end(HdSpan word) {
    return word.begin == word.end || *word.begin == '#';
}

/* Numbers beyond those that are kept are for others; those that may be missing are 0. */
static bool keep_numbers(Text *text, Kind kind, HdSpan line) {
    double numbers[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < kinds[kind].most; i++) {
        const HdSpan word = hd_next_word(&line);
        if (i >= kinds[kind].least && is_statement_end(word))
            break;
        const char *fault = hd_number_fault(word, &numbers[i]);
        if (fault != NULL)
            return fail_line(text, "number %d of a %s is '%.*s', expected %s", i + 1,
                             kinds[kind].name, shown(text, word), fault);
        numbers[i] = (double)(float)numbers[i];
    }
    Elements *elements = &text->elements[kind];
    if (elements->count == MOST_ELEMENTS)
        return fail_line(text, "there are more than %d %s", (int)MOST_ELEMENTS, kinds[kind].plural);
    return hd_obj_append(text->memory, &elements->numbers,
                         (size_t)kinds[kind].most * sizeof *numbers, &elements->count,
                         &elements->room, numbers) ||
           fail_room(text);
}

/* Reads "-12" or "12"; without digits, `*number` is 0. NULL: too many digits. */
static const char *read_index(const char *at, const char *end, bool *has_digits, int64_t *number) {
    const bool is_negative = at < end && *at == '-';
    int64_t value = 0;
    int digits = 0;
    if (is_negative)
        at++;
    for (; at < end && *at >= '0' && *at <= '9'; at++) {
        if (++digits > MOST_DIGITS)
            return NULL;
        value = 10 * value + (*at - '0');
    }
    *has_digits = digits > 0;
    *number = is_negative ? -value : value;
    return is_negative && digits == 0 ? NULL : at;
}

/* Positive numbers may name what comes later; the highest is looked at again at the end. */
static bool keep_index(Text *text, Kind kind, int64_t number, HdSpan word, Corner *corner) {
    Elements *elements = &text->elements[kind];
    const int64_t absolute = number < 0 ? (int64_t)elements->count + 1 + number : number;
    if (absolute > elements->highest) {
        elements->highest = absolute;
        elements->line_of_highest = text->line_number;
    }
    corner->element[kind] = (int32_t)(absolute - 1);
    if (absolute > 0)
        return true;
    return fail_line(text,
                     "corner '%.*s' of a face names %s %lld, expected 1 and up, or -1 to "
                     "-%zu counted back from here",
                     shown(text, word), kinds[kind].name, (long long)number, elements->count);
}

/* "v", "v/t", "v//n" or "v/t/n". */
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
    if (!read_corner(text, word, &corner))
        return false;
    return hd_obj_append(text->memory, &text->corners, sizeof corner, &text->corner_count,
                         &text->corner_room, &corner) ||
           fail_room(text);
}

static bool set_material(Text *text, HdSpan name) {
    const int number = hd_name_table_add(&text->names, name, text->memory);
    if (number == HD_NAME_NO_MEMORY)
        return fail_room(text);
    if (number == HD_NAME_TOO_MANY)
        return fail_line(text, "there are more materials than fit, expected at most %d",
                         (int)HD_MAX_MESH_MATERIALS);
    text->material = number;
    return true;
}

/* A face of the corners that came last. */
static bool add_face(Text *text, int32_t corner_count) {
    static const char none[] = HD_OBJ_NO_MATERIAL;
    if (text->material < 0 && !set_material(text, (HdSpan){none, none + strlen(none)}))
        return false;
    const Face face = {corner_count, text->material};
    return hd_obj_append(text->memory, &text->faces, sizeof face, &text->face_count,
                         &text->face_room, &face) ||
           fail_room(text);
}

static bool keep_face(Text *text, HdSpan line) {
    int32_t count = 0;
    for (HdSpan word = hd_next_word(&line); !is_statement_end(word); word = hd_next_word(&line)) {
        if (!keep_corner(text, word))
            return false;
        count++;
    }
    if (count < 3)
        return fail_line(text, "a face has %d corner%s, expected at least 3", (int)count,
                         count == 1 ? "" : "s");
    if (!add_face(text, count))
        return false;
    text->triangle_count += count - 2;
    if (count > text->most_corners)
        text->most_corners = count;
    if (text->triangle_count > HD_MAX_MESH_TRIANGLES)
        return fail_line(text, "there are more than %d triangles", (int)HD_MAX_MESH_TRIANGLES);
    return true;
}

static bool add_library(Text *text, HdSpan name) {
    const size_t length = hd_span_size(name), used = text->libraries_size;
    char *libraries =
        hd_obj_grow(text->memory, text->libraries, 1, used + length + 1, &text->libraries_room);
    if (libraries == NULL)
        return fail_room(text);
    text->libraries = libraries;
    memcpy(libraries + used, name.begin, length);
    libraries[used + length] = '\0';
    text->libraries_size = used + length + 1;
    return true;
}

static bool keep_name(Text *text, HdSpan line, const char *what, bool is_library) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    if (fault != NULL)
        return fail_line(text, "the name of a %s, expected %s", what, fault);
    return is_library ? add_library(text, name) : set_material(text, name);
}

/* Of what is left out the first is told. Rubbish seldom begins with a word. */
static bool leave_out(Text *text, HdSpan word) {
    for (const char *at = word.begin; at < word.end; at++)
        if (*at <= ' ' || *at > '~')
            return fail_line(text, "it begins with byte 0x%02x, so this is no OBJ file",
                             (unsigned)(unsigned char)*at);
    for (size_t i = 0; i < sizeof harmless / sizeof *harmless; i++)
        if (hd_span_is(word, harmless[i]))
            return true;
    if (!text->has_left_out)
        hd_problem(text->notes,
                   "%s: line %zu: statements such as '%.*s' are not used, only faces (f) are",
                   text->path, text->line_number, shown(text, word));
    text->has_left_out = true;
    return true;
}

static bool take_line(Text *text, HdSpan line) {
    const HdSpan word = hd_next_word(&line);
    if (is_statement_end(word))
        return true;
    if (hd_span_is(word, "v"))
        return keep_numbers(text, VERTEX, line);
    if (hd_span_is(word, "f"))
        return keep_face(text, line);
    if (hd_span_is(word, "vn"))
        return keep_numbers(text, NORMAL, line);
    if (hd_span_is(word, "vt"))
        return keep_numbers(text, UV, line);
    if (hd_span_is(word, "usemtl"))
        return keep_name(text, line, "material", false);
    if (hd_span_is(word, "mtllib"))
        return keep_name(text, line, "material library", true);
    return leave_out(text, word);
}

/* What only the whole file tells: whether there are faces, and what they name. */
static HdStatus finish(Text *text) {
    for (int kind = 0; text->status == HD_OK && kind < KIND_COUNT; kind++) {
        const Elements *elements = &text->elements[kind];
        if (elements->highest > (int64_t)elements->count)
            fail_at(text, elements->line_of_highest, "a face names %s %lld, and there are %zu %s",
                    kinds[kind].name, (long long)elements->highest, elements->count,
                    kinds[kind].plural);
    }
    if (text->status == HD_OK && text->face_count == 0)
        fail_reading(text, text->elements[VERTEX].count > 0
                               ? "it has vertices, but no faces"
                               : "it has no faces, so it is empty or no OBJ file "
                                 "(of other formats, such as STL, PLY and glTF, "
                                 "Blender or assimp can make one)");
    return text->status;
}

static HdStatus read_text(Text *text) {
    HdSpan line;
    text->material = -1;
    if (open_text(text) == HD_OK)
        while (next_line(text, &line) && take_line(text, line))
            continue;
    close_text(text);
    return finish(text);
}

/* The elements as an array of their own, free()'s, of just their size. */
static double *take_numbers(Text *text, Kind kind) {
    Elements *elements = &text->elements[kind];
    const size_t size = (size_t)kinds[kind].most * sizeof *elements->numbers;
    double *fitting =
        hd_obj_resize(text->memory, elements->numbers, size, elements->room, elements->count);
    double *numbers = fitting != NULL ? fitting : elements->numbers;
    elements->numbers = NULL;
    return numbers;
}

static void free_text(Text *text) {
    for (int kind = 0; kind < KIND_COUNT; kind++)
        free(text->elements[kind].numbers);
    free(text->faces);
    free(text->corners);
    free(text->libraries);
    hd_name_table_free(&text->names);
}

/* ---- from the text to the mesh ---- */

/* Texture coordinates and normals that no corner names are left out. */
static void take_elements(Text *text, HdMesh *mesh) {
    const Elements *elements = text->elements;
    mesh->vertices = (HdVec3 *)take_numbers(text, VERTEX);
    mesh->vertex_count = (int)elements[VERTEX].count;
    if (elements[NORMAL].highest > 0) {
        mesh->normals = (HdVec3 *)take_numbers(text, NORMAL);
        mesh->normal_count = (int)elements[NORMAL].count;
    }
    if (elements[UV].highest > 0) {
        mesh->uvs = (double(*)[2])take_numbers(text, UV);
        mesh->uv_count = (int)elements[UV].count;
    }
}

static bool allocate_triangles(const Text *text, HdMesh *mesh) {
    HdObjMemory *memory = text->memory;
    const size_t count = (size_t)text->triangle_count;
    mesh->corners = hd_obj_allocate(memory, count, sizeof *mesh->corners);
    if (mesh->normals != NULL)
        mesh->corner_normals = hd_obj_allocate(memory, count, sizeof *mesh->corner_normals);
    if (mesh->uvs != NULL)
        mesh->corner_uvs = hd_obj_allocate(memory, count, sizeof *mesh->corner_uvs);
    if (text->names.count > 1)
        mesh->material_of = hd_obj_allocate(memory, count, sizeof *mesh->material_of);
    return mesh->corners != NULL && (mesh->normals == NULL || mesh->corner_normals != NULL) &&
           (mesh->uvs == NULL || mesh->corner_uvs != NULL) &&
           (text->names.count <= 1 || mesh->material_of != NULL);
}

/* Without a direction there is no normal. */
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

/* Room for the largest polygon. */
typedef struct Polygon {
    HdVec3 *points;
    int32_t (*triangles)[3];
} Polygon;

static bool cut_face(HdMesh *mesh, const Polygon *room, const Corner *corners, const Face *face) {
    static const int32_t in_order[3] = {0, 1, 2};
    const int count = face->corner_count;
    if (count == 3) {
        add_triangle(mesh, corners, in_order, face->material);
        return true;
    }
    for (int i = 0; i < count; i++)
        room->points[i] = mesh->vertices[corners[i].element[VERTEX]];
    if (!hd_polygon_cut(room->points, count, room->triangles))
        return false;
    for (int i = 0; i < count - 2; i++)
        add_triangle(mesh, corners, room->triangles[i], face->material);
    return true;
}

static HdStatus add_faces(const Text *text, HdMesh *mesh, const Polygon *room) {
    const Corner *corners = text->corners;
    for (size_t i = 0; i < text->face_count; i++) {
        const Face *face = &text->faces[i];
        if (!cut_face(mesh, room, corners, face))
            return hd_fail(text->error, HD_BAD_INPUT,
                           "%s: face %zu is not convex and has %d corners, expected at most %d",
                           text->path, i + 1, (int)face->corner_count, (int)HD_MAX_CONCAVE_CORNERS);
        corners += face->corner_count;
    }
    return HD_OK;
}

static HdStatus take_faces(const Text *text, HdMesh *mesh) {
    HdObjMemory *memory = text->memory;
    const size_t most = (size_t)text->most_corners;
    const Polygon room = {hd_obj_allocate(memory, most, sizeof *room.points),
                          hd_obj_allocate(memory, most, sizeof *room.triangles)};
    const bool has_room =
        room.points != NULL && room.triangles != NULL && allocate_triangles(text, mesh);
    const HdStatus status = has_room ? add_faces(text, mesh, &room)
                                     : hd_obj_fail_memory(memory, text->path, text->error);
    free(room.points);
    free(room.triangles);
    return status;
}

static HdStatus take_mesh(Text *text, HdMesh *mesh) {
    take_elements(text, mesh);
    if (!hd_obj_read_materials(mesh, text->path, &text->names, text->libraries,
                               text->libraries_size, text->memory, text->notes))
        return hd_obj_fail_memory(text->memory, text->path, text->error);
    const HdStatus status = take_faces(text, mesh);
    if (status != HD_OK)
        return status;
    const int count = mesh->triangle_count;
    hd_mesh_drop_degenerate(mesh);
    if (mesh->triangle_count == 0)
        return hd_fail(text->error, HD_BAD_INPUT, "%s: none of its %d triangles has an area",
                       text->path, count);
    return HD_OK;
}

HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t most_bytes, HdProblems *notes,
                          HdError *error) {
    HdObjMemory memory = {.most = most_bytes};
    Text text = {.path = path, .memory = &memory, .notes = notes, .error = error};
    *mesh = (HdMesh){0};
    HdStatus status = read_text(&text);
    if (status == HD_OK)
        status = take_mesh(&text, mesh);
    free_text(&text);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}
