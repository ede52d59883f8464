/* SPDX-License-Identifier: MIT */
/* Reads the materials of an OBJ file from the material libraries (MTL) that it names. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"
#include "mesh/obj_files.h"
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
    HdProblems *fault_list, *notes;
    HdFaults faults, remarks;     /* on the mesh, not yet in the lists */
    const HdNameTable *materials; /* names used by the mesh */
    Definition *definitions;      /* one for each material */
    int32_t *order;               /* numbers of the defined ones, in the order of the libraries */
    int defined_count;
    HdSpan names[MAX_LIBRARIES]; /* names of the libraries requested */
    int count;
} Libraries;

/* Reads one library; checks and stores each statement at once. */
typedef struct Reader {
    Libraries *libraries;
    const char *path;
    HdFaults faults; /* of this library, not yet in the list */
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
    const char *name;           /* of the material */
    HdFaults *faults, *remarks; /* values made legal; others that are seldom meant */
} Notes;

/* Arguments for "%.*s". */
#define named(notes) hd_span_shown(hd_span_of((notes)->name)), (notes)->name

static double clamp_noted(const Notes *notes, const char *name, double value, double low,
                          double high) {
    const double legal = value < low ? low : value > high ? high : value;
    const bool is_ours = name[0] == 'N'; /* Ns and Ni have hedron's limits, not the format's */
    if (legal != value)
        hd_fault(is_ours ? notes->remarks : notes->faults, name, 1,
                 "material '%.*s': %s is %.9g, expected %.15g to %.15g, and becomes %.15g",
                 named(notes), name, value, low, high, legal);
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
    hd_fault(notes->remarks, "sum", 1,
             "material '%.*s': Ks reflects %.6g and d or Tf transmits %.6g, expected at most 1 "
             "together, and both are divided by %.6g",
             named(notes), material->reflection, material->transmission, sum);
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

/* Remarks on libraries that hide their mesh: some programs write Tr 1 for opaque, others Kd 0 with
   a texture. */
static void remark_hidden(const HdMeshMaterial *material, const Notes *notes) {
    const HdMaterial *look = &material->material;
    if (largest(material->emission) > 0.0)
        return;
    if (look->transmission == 1.0 && look->index_of_refraction == 1.0)
        hd_fault(notes->remarks, "clear", 1,
                 "material '%.*s' is invisible except for its tint: d is 0 (or Tr 1), so all light "
                 "passes straight through",
                 named(notes));
    else if (material->texture != NULL && largest(look->colour) == 0.0)
        hd_fault(notes->remarks, "black", 1,
                 "material '%.*s' is black: Kd is 0 0 0, by which its texture is multiplied",
                 named(notes));
}

/* ---- statements ---- */

/* Passes over a fault of this line. */
#define pass_over(reader, kind, format, ...)                                                       \
    hd_fault(&(reader)->faults, kind, 1, "line %zu: " format, (reader)->line, __VA_ARGS__)

/* Returns the target of a definition; of two materials with one name the first counts. */
static Definition *define(Reader *reader, HdSpan name) {
    Libraries *libraries = reader->libraries;
    int number = hd_name_table_find(libraries->materials, name);
    if (number < 0)
        number = hd_name_table_find(libraries->materials, hd_without_comment(name));
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
        pass_over(reader, "newmtl", "newmtl has no usable name, expected %s; it is left out",
                  fault);
    else
        reader->material = define(reader, name);
}

/* Reads up to `most` numbers, at least one. Returns 0, after a note, if one is wrong. */
static int read_numbers(Reader *reader, const char *keyword, HdSpan line, int most,
                        double *values) {
    for (int i = 0; i < most; i++) {
        const HdSpan word = hd_next_word(&line);
        if (i > 0 && (word.begin == word.end || *word.begin == '#'))
            return i;
        const char *fault = hd_number_fault(word, &values[i]);
        if (fault != NULL) {
            pass_over(reader, keyword, "%s has '%.*s', expected %s; the line is left out", keyword,
                      hd_span_shown(word), word.begin, fault);
            return 0;
        }
    }
    return most;
}

/* One number stands for all three of a colour. */
static void keep_numbers(Reader *reader, const char *keyword, HdSpan line, float *to, int most) {
    double values[3];
    const int count = read_numbers(reader, keyword, line, most, values);
    if (count == 0)
        return;
    for (int i = 0; i < most; i++)
        to[i] = (float)values[i < count ? i : 0];
    reader->has_dissolve |= strcmp(keyword, "d") == 0;
}

/* Rounds to millionths, so that 1 - 0.9 is 0.1. */
static void keep_transparency(Reader *reader, HdSpan line) {
    double value;
    if (read_numbers(reader, "Tr", line, 1, &value) == 0 || reader->has_dissolve)
        return;
    const double opacity = value < 0.0 ? 1.0 : value > 1.0 ? 0.0 : 1.0 - value;
    reader->material->parameters.d = (float)((int)(opacity * 1e6 + 0.5) / 1e6);
    if (value < 0.0 || value > 1.0)
        pass_over(reader, "Tr", "Tr is %.9g, expected 0 to 1; the nearer of them is used", value);
}

static void keep_illum(Reader *reader, HdSpan line) {
    double value;
    const HdSpan word = hd_next_word(&line);
    if (hd_number_fault(word, &value) != NULL || value < 0.0 || value > MAX_ILLUM ||
        value != (int)value)
        pass_over(reader, "illum", "illum is '%.*s', expected 0 to %d; the line is left out",
                  hd_span_shown(word), word.begin, (int)MAX_ILLUM);
    else
        reader->material->parameters.illum = (int)value;
}

/* Returns the folders of the library's pictures: "./" if the mesh has no folder, so that a later
   name can only be a file's. */
static HdObjPlace place_of_pictures(const Reader *reader) {
    HdSpan base = hd_obj_folder(hd_span_of(reader->libraries->path));
    if (base.begin == base.end)
        base = hd_span_of("./");
    return (HdObjPlace){base, reader->folder};
}

/* Returns the path, also of a missing file that may be named so. NULL: none, or out of memory. */
static char *find_picture(Reader *reader, const char *keyword, HdSpan name) {
    HdObjMemory *memory = reader->libraries->memory;
    const HdObjPlace place = place_of_pictures(reader);
    const char *fault = hd_obj_file_name_fault(name);
    bool is_elsewhere;
    char *path = hd_obj_find_file(memory, &place, name, &is_elsewhere);
    if (path != NULL && is_elsewhere)
        pass_over(reader, "elsewhere", "%s is '%.*s', which is not there; %s is used", keyword,
                  hd_span_shown(name), name.begin, path);
    else if (path == NULL && fault != NULL)
        pass_over(reader, keyword, "%s is '%.*s', expected %s; the line is left out", keyword,
                  hd_span_shown(name), name.begin, fault);
    return path != NULL || fault != NULL ? path : hd_obj_path(memory, &place, name);
}

/* Keeps a texture (map_Kd), or a mask (map_d); the last one counts. Both lie by the texture's
   options. */
static void keep_picture(Reader *reader, const char *keyword, HdSpan line) {
    Definition *to = reader->material;
    const bool is_mask = strcmp(keyword, "map_d") == 0;
    HdMapOptions options;
    HdSpan wrong;
    if (to == &reader->unused)
        return;
    if (!hd_take_map_options(&line, &options, &wrong)) {
        pass_over(reader, keyword,
                  "%s is '%.*s', expected options of the format with their values; the line is "
                  "left out",
                  keyword, hd_span_shown(wrong), wrong.begin);
        return;
    }
    char *path = find_picture(reader, keyword, hd_rest(line));
    if (path == NULL)
        return;
    if (!is_mask || to->texture == NULL)
        to->options = options;
    char **kept = is_mask ? &to->mask : &to->texture;
    free(*kept);
    *kept = path;
}

static void note_unused(Reader *reader, HdSpan keyword) {
    HdProblems *notes = reader->libraries->notes;
    for (int i = 0; i < reader->noted_count; i++)
        if (hd_span_equals(reader->noted[i], keyword))
            return;
    if (reader->noted_count == MAX_NOTED)
        return;
    reader->noted[reader->noted_count++] = keyword;
    if (hd_name_fault(keyword) == NULL)
        hd_problem(notes, "%s: line %zu: %.*s is not used", reader->path, reader->line,
                   hd_span_shown(keyword), keyword.begin);
    else
        pass_over(reader, "statement", "%s", "it has no statement of a material library");
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
            keep_numbers(reader, numbers[i].keyword, line, numbers[i].to, numbers[i].count);
            return;
        }
    if (hd_span_is(keyword, "Tr"))
        keep_transparency(reader, line);
    else if (hd_span_is(keyword, "illum"))
        keep_illum(reader, line);
    else if (hd_span_is(keyword, "map_Kd"))
        keep_picture(reader, "map_Kd", line);
    else if (hd_span_is(keyword, "map_d"))
        keep_picture(reader, "map_d", line);
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
    text.begin += hd_mark_size(text);
    const char *zero = memchr(text.begin, '\0', hd_span_size(text));
    if (zero != NULL && hd_padding_size((HdSpan){zero, text.end}) < (size_t)(text.end - zero)) {
        hd_fault(&reader->faults, "zero", 1, "it has a NUL byte, so it is no material library");
        return;
    }
    if (zero != NULL)
        text.end = zero;
    for (; text.begin < text.end; reader->line++)
        take_line(reader, next_line(&text));
}

/* ---- libraries ---- */

static bool is_requested(const Libraries *libraries, HdSpan name) {
    for (int i = 0; i < libraries->count; i++)
        if (hd_span_equals(libraries->names[i], name))
            return true;
    return false;
}

static void read_file(Libraries *libraries, const char *path, HdSpan folder) {
    unsigned char *bytes;
    size_t size;
    HdError problem;
    HdObjMemory *memory = libraries->memory;
    const size_t capacity = memory->max_bytes - memory->used;
    const int64_t most = capacity < INT32_MAX ? (int64_t)capacity : INT32_MAX;
    if (hd_file_read(path, "material library", most, &bytes, &size, &problem) != HD_OK) {
        hd_fault(&libraries->faults, "library", 1, "%s", problem.message);
        return;
    }
    const char *text = (const char *)bytes;
    Reader reader = {.libraries = libraries, .path = path, .folder = folder, .line = 1};
    memory->used += size;
    read_definitions(&reader, (HdSpan){text, text + size});
    hd_faults_report(&reader.faults, path, libraries->fault_list);
    hd_obj_release(memory, bytes, size);
}

static HdObjPlace place_of_libraries(const Libraries *libraries) {
    return (HdObjPlace){hd_obj_folder(hd_span_of(libraries->path)), hd_span_of("")};
}

/* Returns the path, also of a missing file that may be named so. NULL: none, or out of memory. */
static char *find_library(Libraries *libraries, HdSpan name) {
    const HdObjPlace place = place_of_libraries(libraries);
    const char *fault = libraries->count == MAX_LIBRARIES ? "no more than 64 libraries"
                                                          : hd_obj_file_name_fault(name);
    bool is_elsewhere;
    char *path = libraries->count < MAX_LIBRARIES
                     ? hd_obj_find_file(libraries->memory, &place, name, &is_elsewhere)
                     : NULL;
    if (path != NULL && is_elsewhere)
        hd_fault(&libraries->faults, "elsewhere", 1,
                 "the material library '%.*s' is not there; %s is read", hd_span_shown(name),
                 name.begin, path);
    else if (path == NULL && fault != NULL)
        hd_fault(&libraries->faults, "name", 1,
                 "the material library '%.*s' is not read, expected %s", hd_span_shown(name),
                 name.begin, fault);
    return path != NULL || fault != NULL ? path : hd_obj_path(libraries->memory, &place, name);
}

static void read_library(Libraries *libraries, HdSpan name) {
    char *path = !is_requested(libraries, name) ? find_library(libraries, name) : NULL;
    if (path == NULL)
        return;
    libraries->names[libraries->count++] = name;
    HdSpan folder = hd_obj_folder(hd_span_of(path));
    folder.begin += hd_span_size(place_of_libraries(libraries).base);
    read_file(libraries, path, folder);
    hd_obj_release(libraries->memory, path, strlen(path) + 1);
}

/* Returns whether the words of a statement, and not all of it, name a file. */
static bool is_list(Libraries *libraries, HdSpan names) {
    const HdObjPlace place = place_of_libraries(libraries);
    bool is_found = false;
    if (libraries->count == MAX_LIBRARIES || hd_obj_has_file(libraries->memory, &place, names))
        return false;
    for (HdSpan word = hd_next_word(&names); word.begin < word.end && !is_found;
         word = hd_next_word(&names))
        is_found = hd_obj_has_file(libraries->memory, &place, word);
    return is_found;
}

/* Reads the libraries of a statement: one name that may contain blanks, or else several. */
static void read_named(Libraries *libraries, HdSpan names) {
    if (is_requested(libraries, names))
        return;
    if (!is_list(libraries, names)) {
        read_library(libraries, names);
        return;
    }
    for (HdSpan word = hd_next_word(&names); word.begin < word.end && *word.begin != '#';
         word = hd_next_word(&names))
        read_library(libraries, word);
}

/* Reads the libraries named in the `size` bytes at `names`, each name zero-terminated. */
static void read_libraries(Libraries *libraries, const char *names, size_t size) {
    for (size_t next = 0; next < size; next += strlen(names + next) + 1)
        read_named(libraries, hd_span_of(names + next));
}

/* A material without a definition gets the default parameters. */
static void define_materials(Libraries *libraries, HdMesh *mesh) {
    Notes notes = {"", &libraries->faults, &libraries->remarks};
    for (int i = 0; i < mesh->material_count; i++)
        make_material(&defaults, &mesh->materials[i], &notes);
    for (int i = 0; i < libraries->defined_count; i++) {
        const int number = libraries->order[i];
        Definition *definition = &libraries->definitions[number];
        HdMeshMaterial *material = &mesh->materials[number];
        notes.name = material->name;
        make_material(&definition->parameters, material, &notes);
        material->texture = definition->texture;
        material->mask = definition->mask;
        definition->texture = definition->mask = NULL;
        remark_hidden(material, &notes);
    }
}

/* Gives the first `count` names their stand-ins, and notes those without a definition. */
static void stand_in(Libraries *libraries, HdNameTable *names, int count) {
    int undefined = 0, first = 0;
    for (int i = count - 1; i >= 0; i--) {
        const int plain = hd_name_table_find(names, hd_without_comment(names->names[i].text));
        if (libraries->definitions[i].is_defined)
            continue;
        if (plain >= 0 && libraries->definitions[plain].is_defined) {
            names->names[i].stand_in = plain;
            continue;
        }
        undefined++;
        first = i;
    }
    const HdSpan name = names->names[first].text;
    if (undefined == 0 || (count == 1 && hd_span_is(name, HD_OBJ_NO_MATERIAL)))
        return; /* the file names no material */
    hd_fault(&libraries->faults, "undefined", 1,
             "no material library defines '%.*s'%s, so the default applies: white, opaque",
             hd_span_shown(name), name.begin, undefined > 1 ? " and others that faces name" : "");
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

/* Adds the names without comments behind them. */
static bool add_plain_names(HdNameTable *names, HdObjMemory *memory) {
    const int count = names->count;
    for (int i = 0; i < count; i++)
        if (hd_name_table_add(names, hd_without_comment(names->names[i].text), memory) ==
            HD_NAME_NO_MEMORY)
            return false;
    return true;
}

bool hd_obj_read_materials(HdMesh *mesh, const char *path, HdNameTable *names,
                           const char *libraries, size_t size, HdMapOptions **options,
                           HdObjMemory *memory, HdProblems *faults, HdProblems *notes) {
    Libraries all = {
        .path = path, .memory = memory, .fault_list = faults, .notes = notes, .materials = names};
    const int count = names->count;
    if (add_plain_names(names, memory) && allocate(&all))
        read_libraries(&all, libraries, size);
    if (all.definitions != NULL && !memory->has_refused) {
        stand_in(&all, names, count);
        if (name_materials(names, memory, mesh))
            define_materials(&all, mesh);
    }
    hd_faults_report(&all.faults, path, faults);
    hd_faults_report(&all.remarks, path, notes);
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
