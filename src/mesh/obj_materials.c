/* SPDX-License-Identifier: MIT */
/* Reads the materials of an OBJ file from the material libraries (MTL) that it names. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"
#include "mesh/obj_reading.h"
#include "system/path.h"

enum { NO_ILLUM = -1, MAX_ILLUM = 10, MAX_NOTED = 32, MAX_LIBRARIES = 64 };

/* Supported parameters, named as in the file. */
typedef struct Parameters {
    float Ka[3], Kd[3], Ks[3], Ke[3], Tf[3];
    float Ns, Ni, d;
    int illum; /* or NO_ILLUM */
} Parameters;

/* A material without parameters: white and opaque. */
static const Parameters defaults = {.Kd = {1.0f, 1.0f, 1.0f},
                                    .Tf = {1.0f, 1.0f, 1.0f},
                                    .Ns = 64.0f,
                                    .Ni = 1.0f,
                                    .d = 1.0f,
                                    .illum = NO_ILLUM};

typedef struct Definition {
    Parameters parameters;
    char *texture, *mask; /* owned; NULL: none */
    HdMapOptions options; /* of the texture, or else of the mask */
    bool is_defined;
} Definition;

typedef struct Libraries {
    const char *path; /* path of the mesh */
    HdObjMemory *memory;
    HdProblems *notes;
    const HdNameTable *materials; /* names used by the mesh */
    Definition *definitions;      /* one for each material */
    int32_t *order;               /* numbers of the defined ones, in the order of the libraries */
    int defined_count;
    const char *names[MAX_LIBRARIES]; /* names of the libraries requested */
    int count;
} Libraries;

/* Reads one library; checks and stores each statement at once. */
typedef struct Reader {
    Libraries *libraries;
    const char *path;
    HdSpan folder; /* folder of its texture names, below the mesh's: empty, or with a final slash */
    size_t line;
    bool is_in_material;
    bool has_dissolve;       /* the material has d, so Tr does not count */
    Definition *material;    /* the one being defined; */
    Definition unused;       /* the target if it is not wanted */
    HdSpan noted[MAX_NOTED]; /* statements reported already */
    int noted_count;
} Reader;

/* ---- conversion of materials ---- */

typedef struct Notes {
    const char *place;
    HdProblems *problems;
} Notes;

static double clamp_noted(const Notes *notes, const char *name, double value, double low,
                          double high) {
    const double legal = value < low ? low : value > high ? high : value;
    if (legal != value)
        hd_problem(notes->problems, "%s: %s is %.9g, expected %.15g to %.15g, and becomes %.15g",
                   notes->place, name, value, low, high, legal);
    return legal;
}

static HdVec3 colour(const Notes *notes, const char *name, const float *from, double high) {
    return hd_vec3(clamp_noted(notes, name, (double)from[0], 0.0, high),
                   clamp_noted(notes, name, (double)from[1], 0.0, high),
                   clamp_noted(notes, name, (double)from[2], 0.0, high));
}

static double largest(HdVec3 a) {
    return fmax(a.x, fmax(a.y, a.z));
}

static double mean(HdVec3 a) {
    return (a.x + a.y + a.z) / 3.0;
}

/* Returns the colour without its strength; white for black. */
static HdVec3 tint_of(HdVec3 a) {
    return largest(a) > 0.0 ? hd_scale(a, 1.0 / largest(a)) : hd_vec3(1.0, 1.0, 1.0);
}

static bool refracts(int illum) {
    return illum == 6 || illum == 7;
}

/* Returns the transmitted share: 1 - d, or Tf if light is refracted and d is 1. */
static double transmission_of(const Notes *notes, const Parameters *from, HdVec3 filter) {
    const double passing = 1.0 - clamp_noted(notes, "d", (double)from->d, 0.0, 1.0);
    return passing > 0.0 || !refracts(from->illum) ? passing : largest(filter);
}

/* Scales both shares if together they exceed 1. */
static void limit_shares(const Notes *notes, HdMaterial *material) {
    const double sum = material->reflection + material->transmission;
    if (sum <= 1.0)
        return;
    hd_problem(notes->problems,
               "%s: Ks reflects %.6g and d or Tf transmits %.6g, expected at most 1 "
               "together, and both are divided by %.6g",
               notes->place, material->reflection, material->transmission, sum);
    material->reflection /= sum;
    material->transmission = 1.0 - material->reflection;
}

static int shininess_of(const Notes *notes, const Parameters *from, double specular) {
    if (specular == 0.0)
        return (int)(fmin(fmax((double)from->Ns, 1.0), HD_MAX_SHININESS) + 0.5);
    return (int)(clamp_noted(notes, "Ns", (double)from->Ns, 1.0, HD_MAX_SHININESS) + 0.5);
}

/* Returns Ni if light may be refracted, otherwise 1. */
static double index_of(const Notes *notes, const Parameters *from, double transmission) {
    if (transmission == 0.0 || !(refracts(from->illum) || from->illum == NO_ILLUM))
        return 1.0;
    return clamp_noted(notes, "Ni", (double)from->Ni, HD_MIN_INDEX_OF_REFRACTION,
                       HD_MAX_INDEX_OF_REFRACTION);
}

/* Fills `material`, except name and texture, by the table in docs/reference/files.md, and notes
   values made legal. */
static void make_material(const Parameters *from, HdMeshMaterial *material, const Notes *notes) {
    const HdVec3 diffuse = colour(notes, "Kd", from->Kd, 1.0);
    const HdVec3 specular = colour(notes, "Ks", from->Ks, 1.0);
    const HdVec3 filter = colour(notes, "Tf", from->Tf, 1.0);
    const double passing = transmission_of(notes, from, filter);
    HdMaterial *to = &material->material;
    *to = (HdMaterial){.colour = diffuse, .mirror_tint = hd_vec3(1.0, 1.0, 1.0)};
    to->ambient = mean(colour(notes, "Ka", from->Ka, 1.0));
    to->diffuse = 1.0 - passing;
    to->transmission = passing;
    if (passing > 0.0 && largest(diffuse) == 0.0) {
        /* Glass is often black except for its filter, and one colour tints transmitted light
           too. */
        to->colour = tint_of(filter);
        to->diffuse = 0.0;
    }
    if (from->illum != 0 && from->illum != 1)
        to->specular = mean(specular);
    if (from->illum >= 3 && from->illum <= 9) {
        to->reflection = largest(specular);
        to->mirror_tint = tint_of(specular);
    }
    to->shininess = shininess_of(notes, from, to->specular);
    to->index_of_refraction = index_of(notes, from, to->transmission);
    limit_shares(notes, to);
    material->emission = colour(notes, "Ke", from->Ke, HD_MAX_NUMBER);
}

/* ---- names of files ---- */

static bool is_separator(char c) {
    return c == '/' || c == '\\';
}

/* Returns the expected form of a file name, which must stay in its base folder or below; NULL: it
   does. Backslashes count as slashes. */
static const char *file_name_fault(HdSpan name) {
    if (hd_name_fault(name) != NULL)
        return hd_name_fault(name);
    if (is_separator(*name.begin) || (name.end - name.begin > 1 && name.begin[1] == ':'))
        return "a name relative to this file's folder";
    for (const char *at = name.begin; at < name.end;) {
        const char *end = at;
        while (end < name.end && !is_separator(*end))
            end++;
        if (hd_span_is((HdSpan){at, end}, ".."))
            return "a name in this file's folder or below it";
        at = end < name.end ? end + 1 : end;
    }
    return NULL;
}

static void fix_separators(char *name) {
    for (; *name != '\0'; name++)
        if (*name == '\\')
            *name = '/';
}

/* Joins the parts; free() releases the result. NULL: out of memory. */
static char *join(HdObjMemory *memory, const HdSpan parts[3]) {
    size_t size = 0;
    for (int i = 0; i < 3; i++)
        size += hd_span_size(parts[i]);
    char *joined = hd_obj_allocate(memory, size + 1, 1), *to = joined;
    for (int i = 0; joined != NULL && i < 3; to += hd_span_size(parts[i]), i++)
        memcpy(to, parts[i].begin, hd_span_size(parts[i]));
    if (joined != NULL)
        *to = '\0';
    return joined;
}

/* Returns the folder of the path with its last slash, or nothing. */
static HdSpan folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    return (HdSpan){path, slash != NULL ? slash + 1 : path};
}

/* ---- statements ---- */

#define note(reader, format, ...)                                                                  \
    hd_problem((reader)->libraries->notes, "%s: line %zu: " format, (reader)->path,                \
               (reader)->line, __VA_ARGS__)

/* Returns the target of a definition; of two materials with one name the first counts. */
static Definition *define(Reader *reader, HdSpan name) {
    Libraries *libraries = reader->libraries;
    const int number = hd_name_table_find(libraries->materials, name);
    if (number < 0 || libraries->definitions[number].is_defined)
        return &reader->unused;
    libraries->order[libraries->defined_count++] = number;
    libraries->definitions[number].is_defined = true;
    return &libraries->definitions[number];
}

static void start_material(Reader *reader, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    reader->is_in_material = fault == NULL;
    reader->has_dissolve = false;
    if (fault != NULL)
        note(reader, "the name of a material, expected %s; it is left out", fault);
    else
        reader->material = define(reader, name);
}

/* Reads up to `most` numbers, at least one. Returns 0, after a note, if one is wrong. */
static int read_numbers(Reader *reader, HdSpan keyword, HdSpan line, int most, double *values) {
    for (int i = 0; i < most; i++) {
        const HdSpan word = hd_next_word(&line);
        if (i > 0 && word.begin == word.end)
            return i;
        const char *fault = hd_number_fault(word, &values[i]);
        if (fault != NULL) {
            note(reader, "%.*s has '%.*s', expected %s; the line is left out",
                 hd_span_shown(keyword), keyword.begin, hd_span_shown(word), word.begin, fault);
            return 0;
        }
    }
    return most;
}

/* One number stands for all three of a colour. */
static void keep_numbers(Reader *reader, HdSpan keyword, HdSpan line, float *to, int most) {
    double values[3];
    const int count = read_numbers(reader, keyword, line, most, values);
    if (count == 0)
        return;
    for (int i = 0; i < most; i++)
        to[i] = (float)values[i < count ? i : 0];
    reader->has_dissolve |= hd_span_is(keyword, "d");
}

/* Rounds to millionths, so that 1 - 0.9 is 0.1. */
static void keep_transparency(Reader *reader, HdSpan keyword, HdSpan line) {
    double value;
    if (read_numbers(reader, keyword, line, 1, &value) == 0 || reader->has_dissolve)
        return;
    const double opacity = value < 0.0 ? 1.0 : value > 1.0 ? 0.0 : 1.0 - value;
    reader->material->parameters.d = (float)((int)(opacity * 1e6 + 0.5) / 1e6);
    if (value < 0.0 || value > 1.0)
        note(reader, "Tr is %.9g, expected 0 to 1; the nearer of them is used", value);
}

static void keep_illum(Reader *reader, HdSpan line) {
    double value;
    const HdSpan word = hd_next_word(&line);
    if (hd_number_fault(word, &value) != NULL || value < 0.0 || value > MAX_ILLUM ||
        value != (int)value)
        note(reader, "illum is '%.*s', expected 0 to %d; the line is left out", hd_span_shown(word),
             word.begin, (int)MAX_ILLUM);
    else
        reader->material->parameters.illum = (int)value;
}

/* Sets the path of a picture; the last one counts. Prefixes "./" if the mesh has no folder, so that
   a later name can only be a file's. */
static void set_picture(Reader *reader, HdSpan name, char **path) {
    HdSpan folder = folder_of(reader->libraries->path);
    if (folder.begin == folder.end)
        folder = hd_span_of("./");
    free(*path);
    *path = join(reader->libraries->memory, (const HdSpan[3]){folder, reader->folder, name});
    if (*path != NULL)
        fix_separators(*path + hd_span_size(folder));
}

/* Keeps a texture (map_Kd), or a mask (map_d). Both lie by the texture's options. */
static void keep_picture(Reader *reader, HdSpan keyword, HdSpan line) {
    Definition *to = reader->material;
    const bool is_mask = hd_span_is(keyword, "map_d");
    HdMapOptions options;
    HdSpan wrong;
    const bool has_options = hd_take_map_options(&line, &options, &wrong);
    const HdSpan name = has_options ? hd_rest(line) : wrong;
    const char *fault =
        has_options ? file_name_fault(name) : "options of the format with their values";
    if (fault != NULL)
        note(reader, "%.*s is '%.*s', expected %s; there will be no texture",
             hd_span_shown(keyword), keyword.begin, hd_span_shown(name), name.begin, fault);
    if (fault != NULL || to == &reader->unused)
        return;
    if (!is_mask || to->texture == NULL)
        to->options = options;
    set_picture(reader, name, is_mask ? &to->mask : &to->texture);
}

static void note_unused(Reader *reader, HdSpan keyword) {
    const size_t size = hd_span_size(keyword);
    for (int i = 0; i < reader->noted_count; i++)
        if (hd_span_size(reader->noted[i]) == size &&
            memcmp(reader->noted[i].begin, keyword.begin, size) == 0)
            return;
    if (reader->noted_count == MAX_NOTED)
        return;
    reader->noted[reader->noted_count++] = keyword;
    if (hd_name_fault(keyword) == NULL)
        note(reader, "%.*s is not used", hd_span_shown(keyword), keyword.begin);
    else
        note(reader, "%s", "it has no statement of a material library");
}

static void read_statement(Reader *reader, HdSpan keyword, HdSpan line) {
    Parameters *to = &reader->material->parameters;
    const struct {
        const char *keyword;
        float *to;
        int count;
    } numbers[] = {{"Kd", to->Kd, 3}, {"Ka", to->Ka, 3},  {"Ks", to->Ks, 3},  {"Ke", to->Ke, 3},
                   {"Tf", to->Tf, 3}, {"Ns", &to->Ns, 1}, {"Ni", &to->Ni, 1}, {"d", &to->d, 1}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (hd_span_is(keyword, numbers[i].keyword)) {
            keep_numbers(reader, keyword, line, numbers[i].to, numbers[i].count);
            return;
        }
    if (hd_span_is(keyword, "Tr"))
        keep_transparency(reader, keyword, line);
    else if (hd_span_is(keyword, "illum"))
        keep_illum(reader, line);
    else if (hd_span_is(keyword, "map_Kd") || hd_span_is(keyword, "map_d"))
        keep_picture(reader, keyword, line);
    else
        note_unused(reader, keyword);
}

static void take_line(Reader *reader, HdSpan line) {
    const HdSpan keyword = hd_next_word(&line);
    if (keyword.begin == keyword.end || *keyword.begin == '#')
        return;
    if (hd_span_is(keyword, "newmtl"))
        start_material(reader, line);
    else if (reader->is_in_material)
        read_statement(reader, keyword, line);
}

/* Takes a line up to "\n", "\r\n", "\r" or the end of the text. */
static HdSpan next_line(HdSpan *text) {
    const char *at = text->begin;
    while (at < text->end && *at != '\n' && *at != '\r')
        at++;
    const HdSpan line = {text->begin, at};
    if (at < text->end && *at++ == '\r' && at < text->end && *at == '\n')
        at++;
    text->begin = at;
    return line;
}

/* Reads the first definitions of materials that the mesh names; missing parameters are as in
   `defaults`, and Tr becomes d. Notes each kind of unused statement once. */
static void read_definitions(Reader *reader, HdSpan text) {
    if (memchr(text.begin, '\0', (size_t)(text.end - text.begin)) != NULL) {
        hd_problem(reader->libraries->notes, "%s: it has a NUL byte, so it is no material library",
                   reader->path);
        return;
    }
    for (; text.begin < text.end; reader->line++)
        take_line(reader, next_line(&text));
}

/* ---- libraries ---- */

/* Returns whether to read the library; true only once for each. */
static bool should_read(Libraries *libraries, const char *name) {
    const HdSpan span = hd_span_of(name);
    const char *fault = file_name_fault(span);
    for (int i = 0; i < libraries->count; i++)
        if (strcmp(libraries->names[i], name) == 0)
            return false;
    if (libraries->count == MAX_LIBRARIES)
        fault = "no more than 64 libraries";
    if (fault != NULL) {
        hd_problem(libraries->notes, "%s: the material library '%.*s' is not read, expected %s",
                   libraries->path, hd_span_shown(span), name, fault);
        return false;
    }
    libraries->names[libraries->count++] = name;
    return true;
}

static void read_file(Libraries *libraries, const char *path, const char *name) {
    unsigned char *bytes;
    size_t size;
    HdError problem;
    HdObjMemory *memory = libraries->memory;
    const size_t capacity = memory->max_bytes - memory->used;
    const int64_t most = capacity < INT32_MAX ? (int64_t)capacity : INT32_MAX;
    if (hd_file_read(path, "material library", most, &bytes, &size, &problem) != HD_OK) {
        hd_problem(libraries->notes, "%s: %s", libraries->path, problem.message);
        return;
    }
    const char *text = (const char *)bytes;
    Reader reader = {.libraries = libraries, .path = path, .folder = folder_of(name), .line = 1};
    memory->used += size;
    read_definitions(&reader, (HdSpan){text, text + size});
    hd_obj_release(memory, bytes, size);
}

/* Reads the libraries named in the `size` bytes at `names`, each name zero-terminated. */
static void read_libraries(Libraries *libraries, char *names, size_t size) {
    for (size_t next = 0; next < size; next += strlen(names + next) + 1) {
        char *name = names + next;
        fix_separators(name);
        if (!should_read(libraries, name))
            continue;
        char *path = join(libraries->memory, (const HdSpan[3]){folder_of(libraries->path),
                                                               hd_span_of(name), hd_span_of("")});
        if (path == NULL)
            return;
        read_file(libraries, path, name);
        hd_obj_release(libraries->memory, path, strlen(path) + 1);
    }
}

/* A material without a definition gets the default parameters. */
static void define_materials(const Libraries *libraries, HdMesh *mesh) {
    char place[256];
    for (int i = 0; i < mesh->material_count; i++)
        make_material(&defaults, &mesh->materials[i], &(Notes){"", libraries->notes});
    for (int i = 0; i < libraries->defined_count; i++) {
        const int number = libraries->order[i];
        Definition *definition = &libraries->definitions[number];
        HdMeshMaterial *material = &mesh->materials[number];
        snprintf(place, sizeof place, "%s: material '%.*s'", libraries->path,
                 hd_span_shown(hd_span_of(material->name)), material->name);
        make_material(&definition->parameters, material, &(Notes){place, libraries->notes});
        material->texture = definition->texture;
        material->mask = definition->mask;
        definition->texture = definition->mask = NULL;
    }
}

static void note_undefined(const Libraries *libraries, const HdMesh *mesh) {
    const int count = mesh->material_count - libraries->defined_count;
    int first = 0;
    if (count == 0)
        return;
    while (libraries->definitions[first].is_defined)
        first++;
    const char *name = mesh->materials[first].name;
    if (mesh->material_count == 1 && strcmp(name, HD_OBJ_NO_MATERIAL) == 0)
        return; /* the file names no material */
    hd_problem(libraries->notes,
               "%s: no material library defines '%.80s'%s, so the default applies: white, opaque",
               libraries->path, name, count > 1 ? " and others that faces name" : "");
}

/* Moves the names to the mesh. */
static bool name_materials(HdNameTable *names, HdObjMemory *memory, HdMesh *mesh) {
    mesh->materials = hd_obj_allocate(memory, (size_t)names->count, sizeof *mesh->materials);
    if (mesh->materials == NULL)
        return false;
    mesh->material_count = names->count;
    for (int i = 0; i < names->count; i++) {
        mesh->materials[i] = (HdMeshMaterial){
            .name = names->names[i].owned, .picture = -1, .mask_picture = -1, .passes_as = -1};
        names->names[i].owned = NULL;
    }
    return true;
}

static bool allocate(Libraries *libraries) {
    const size_t count = (size_t)libraries->materials->count;
    libraries->definitions =
        hd_obj_allocate(libraries->memory, count, sizeof *libraries->definitions);
    libraries->order = hd_obj_allocate(libraries->memory, count, sizeof *libraries->order);
    for (size_t i = 0; libraries->definitions != NULL && i < count; i++)
        libraries->definitions[i] =
            (Definition){.parameters = defaults, .options = {.scale = {1.0, 1.0}}};
    return libraries->definitions != NULL && libraries->order != NULL;
}

bool hd_obj_read_materials(HdMesh *mesh, const char *path, HdNameTable *names, char *libraries,
                           size_t size, HdMapOptions **options, HdObjMemory *memory,
                           HdProblems *notes) {
    Libraries all = {.path = path, .memory = memory, .notes = notes, .materials = names};
    if (allocate(&all))
        read_libraries(&all, libraries, size);
    if (!memory->has_refused && name_materials(names, memory, mesh)) {
        define_materials(&all, mesh);
        note_undefined(&all, mesh);
    }
    *options = hd_obj_allocate(memory, (size_t)names->count, sizeof **options);
    for (int i = 0; all.definitions != NULL && i < names->count; i++) {
        if (*options != NULL)
            (*options)[i] = all.definitions[i].options;
        free(all.definitions[i].texture);
        free(all.definitions[i].mask);
    }
    free(all.definitions);
    free(all.order);
    return !memory->has_refused;
}
