/* SPDX-License-Identifier: MIT */
#include "input/classic.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "input/check.h"

/* ---- tokens separated by white space. Messages name the line, the value and what was expected.
   After the first failure all reads do nothing, so a list of reads needs no checks in between.
   `what` names the value; on failure the output is unchanged ---- */

typedef struct Reader {
    const char *text; /* needs no terminating zero */
    size_t size, position;
    int line;          /* line of the last token, from 1 */
    const char *name;  /* name of the text in messages */
    bool hides_tokens; /* messages quote no tokens, since the text may be private */
    char where[32];    /* prefix of values' names: "solid 2: ", or empty */
    HdError *error;
    HdStatus status;
} Reader;

static bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Shortens and escapes a token for a message. */
static const char *shown(const char *token, char out[44]) {
    const size_t taken = hd_escape(token, out, 41), length = strlen(out);
    snprintf(out + length, 4, "%s", token[taken] != '\0' ? "..." : "");
    return out;
}

#define refuse(reader, what, format, ...)                                                          \
    ((reader)->status =                                                                            \
         hd_fail((reader)->error, HD_BAD_INPUT, "%s:%d: %s%s " format, (reader)->name,             \
                 (reader)->line, (reader)->where, what, __VA_ARGS__))

static void fail_token(Reader *reader, const char *what, const char *token, const char *expected) {
    char value[44];
    refuse(reader, what, "is '%s', expected %s", reader->hides_tokens ? "..." : shown(token, value),
           expected);
}

static void skip_space(Reader *reader) {
    while (reader->position < reader->size && is_space(reader->text[reader->position])) {
        if (reader->text[reader->position] == '\n')
            reader->line++;
        reader->position++;
    }
}

/* Reads a token. Returns false at the end of the text, which is an error, or after an earlier
   error. */
static bool read_token(Reader *reader, const char *what, const char *expected,
                       char token[HD_MAX_PATH]) {
    if (reader->status != HD_OK)
        return false;
    skip_space(reader);
    const char *start = reader->text + reader->position;
    size_t length = 0;
    while (reader->position + length < reader->size && !is_space(start[length]))
        length++;
    reader->position += length;
    if (length == 0)
        refuse(reader, what, "is missing, expected %s", expected);
    else if (length >= HD_MAX_PATH)
        refuse(reader, what, "has %zu characters, expected at most %d", length, HD_MAX_PATH - 1);
    else if (memchr(start, '\0', length) != NULL)
        refuse(reader, what, "holds a zero byte, expected %s", expected);
    if (reader->status != HD_OK)
        return false;
    memcpy(token, start, length);
    token[length] = '\0';
    return true;
}

/* Parses decimal notation only: strtod alone would accept hexadecimal numbers, "nan" and "inf". */
static bool is_decimal(const char *s, double *number) {
    char *end;
    *number = strtod(s, &end);
    return *end == '\0' && s[strspn(s, "0123456789+-.eE")] == '\0';
}

/* Returns false if there is no number, which is an error. */
static bool next_number(Reader *reader, const char *what, double *number) {
    static const char *const expected = "a number";
    char token[HD_MAX_PATH];
    if (!read_token(reader, what, expected, token))
        return false;
    if (!is_decimal(token, number))
        fail_token(reader, what, token, expected);
    else if (isinf(*number))
        fail_token(reader, what, token, "a number within the range of double precision");
    return reader->status == HD_OK;
}

/* Reads a finite number in decimal notation. */
static void read_number(Reader *reader, const char *what, double *value) {
    double number;
    if (next_number(reader, what, &number))
        *value = number;
}

/* Reads a number from 0 to 1. */
static void read_share(Reader *reader, const char *what, double *value) {
    double number;
    if (!next_number(reader, what, &number))
        return;
    if (number >= 0.0 && number <= 1.0)
        *value = number;
    else
        refuse(reader, what, "is %.15g, expected a number from 0 to 1", number);
}

/* Reads an integer from `low` to `high`. */
static void read_int(Reader *reader, const char *what, int low, int high, int *value) {
    char expected[64], *end;
    char token[HD_MAX_PATH];
    snprintf(expected, sizeof expected, "a whole number from %d to %d", low, high);
    if (!read_token(reader, what, expected, token))
        return;
    const long number = strtol(token, &end, 10); /* saturates if too long */
    if (*end != '\0' || number < low || number > high)
        fail_token(reader, what, token, expected);
    else
        *value = (int)number;
}

/* Reads any token as a file name. */
static void read_path(Reader *reader, const char *what, char path[HD_MAX_PATH]) {
    read_token(reader, what, "a path", path);
}

/* Fails if a token is left. */
static void read_end(Reader *reader) {
    static const char *const what = "the text after the last value";
    char token[HD_MAX_PATH];
    if (reader->status != HD_OK)
        return;
    skip_space(reader);
    if (reader->position < reader->size && read_token(reader, what, "the end of the input", token))
        fail_token(reader, what, token, "the end of the input");
}

/* ---- the scene ---- */

/* Values that the input leaves open. Lengths are in circumradii of the solid. */
static const double classic_diffuse = 0.5;
static const double classic_floor_specular = 0.5;
static const int classic_shininess = 64;
static const double classic_rim_width = 0.04;
static const double classic_rim_colour = 0.03;
static const double classic_rim_specular = 0.2;
static const double classic_disc_radius = 0.02;
static const double classic_disc_radiance = 4.0;
static const double classic_edge_power = 0.7; /* total of a solid's edge lights */

typedef void ReadComponent(Reader *reader, const char *what, double *value);

static void read_three(Reader *reader, const char *what, const char *const parts[3],
                       ReadComponent *read, HdVec3 *value) {
    double *const component[3] = {&value->x, &value->y, &value->z};
    for (int i = 0; i < 3; i++) {
        char name[48];
        snprintf(name, sizeof name, "%s%s", what, parts[i]);
        read(reader, name, component[i]);
    }
}

static void read_point(Reader *reader, const char *what, HdVec3 *value) {
    static const char *const parts[3] = {" x", " y", " z"};
    read_three(reader, what, parts, read_number, value);
}

static void read_colour(Reader *reader, const char *what, ReadComponent *read, HdVec3 *value) {
    static const char *const parts[3] = {"'s red", "'s green", "'s blue"};
    read_three(reader, what, parts, read, value);
}

static void enter(Reader *reader, const char *name, int number) {
    if (number == 0)
        snprintf(reader->where, sizeof reader->where, "%s: ", name);
    else
        snprintf(reader->where, sizeof reader->where, "%s %d: ", name, number);
}

static void leave(Reader *reader) {
    reader->where[0] = '\0';
}

static void read_cylinder_path(Reader *reader, const char *name, HdCylinderPath *path) {
    enter(reader, name, 0);
    read_number(reader, "r0", &path->r0);
    read_number(reader, "z0", &path->z0);
    read_number(reader, "phi0", &path->phi0);
    read_number(reader, "r amplitude", &path->r_amplitude);
    read_number(reader, "z amplitude", &path->z_amplitude);
    read_number(reader, "r frequency", &path->r_frequency);
    read_number(reader, "z frequency", &path->z_frequency);
    read_number(reader, "phi frequency", &path->phi_frequency);
    read_number(reader, "r phase", &path->r_phase);
    read_number(reader, "z phase", &path->z_phase);
    leave(reader);
}

static HdVec3 grey(double value) {
    return hd_vec3(value, value, value);
}

static HdMaterial classic_material(void) {
    return (HdMaterial){.mirror_tint = {1.0, 1.0, 1.0},
                        .diffuse = classic_diffuse,
                        .shininess = classic_shininess,
                        .index_of_refraction = 1.0};
}

static void fill_solid(HdSolid *solid) {
    solid->face.specular = solid->face.transmission;
    solid->rim_width = classic_rim_width * solid->circumradius;
    solid->rim = classic_material();
    solid->rim.colour = grey(classic_rim_colour);
    solid->rim.specular = classic_rim_specular;
    const int count = hd_edge_light_count(solid);
    solid->lights.colour_count = 1;
    solid->lights.colours[0] = grey(1.0);
    solid->lights.intensity = count > 0 ? classic_edge_power / count : 0.0;
    solid->lights.falloff.distance = solid->circumradius;
    solid->lights.disc_radius = classic_disc_radius * solid->circumradius;
    solid->lights.disc_radiance = classic_disc_radiance;
}

static void read_solid(Reader *reader, HdSolidKind kind, int number, HdSolid *solid) {
    /* Lights per edge that reach the limit even on the solid with the fewest edges. */
    static const int max_per_edge = HD_MAX_LIGHTS / 6;
    solid->kind = kind;
    solid->face = classic_material();
    enter(reader, "solid", number);
    read_point(reader, "centre", &solid->centre);
    read_colour(reader, "colour", read_share, &solid->face.colour);
    read_number(reader, "radius", &solid->circumradius);
    read_share(reader, "reflection", &solid->face.reflection);
    read_share(reader, "transparency", &solid->face.transmission);
    read_int(reader, "number of lights per edge", 0, max_per_edge, &solid->lights.per_edge);
    leave(reader);
    fill_solid(solid);
}

static void read_floor(Reader *reader, HdSceneFile *input) {
    static const char *const names[4] = {"corner 1", "corner 2", "corner 3", "corner 4"};
    HdFloor *floor = &input->scene.floor;
    floor->present = true;
    floor->material = classic_material();
    floor->material.specular = classic_floor_specular;
    enter(reader, "floor", 0);
    for (int i = 0; i < 4; i++)
        read_point(reader, names[i], &floor->corners[i]);
    read_path(reader, "texture path", input->texture_path);
    read_colour(reader, "tint", read_share, &floor->material.colour);
    read_share(reader, "reflection", &floor->material.reflection);
    leave(reader);
}

static void *allocate(Reader *reader, size_t count, size_t size) {
    void *memory = calloc(count, size);
    if (memory == NULL && reader->status == HD_OK)
        reader->status =
            hd_fail(reader->error, HD_FAILED, "%s: no memory for the scene", reader->name);
    return memory;
}

static void read_solids(Reader *reader, const HdSolidKind *kinds, HdScene *scene) {
    scene->solids = allocate(reader, HD_CLASSIC_SOLIDS, sizeof *scene->solids);
    if (scene->solids == NULL)
        return;
    scene->solid_count = HD_CLASSIC_SOLIDS;
    for (int i = 0; i < HD_CLASSIC_SOLIDS; i++)
        read_solid(reader, kinds[i], i + 1, &scene->solids[i]);
}

static void read_lights(Reader *reader, HdScene *scene) {
    int count = 0;
    read_int(reader, "number of lights", 0, HD_CLASSIC_MAX_LIGHTS, &count);
    scene->lights = allocate(reader, HD_CLASSIC_MAX_LIGHTS, sizeof *scene->lights);
    if (scene->lights == NULL)
        return;
    scene->light_count = count;
    for (int i = 0; i < count; i++) {
        enter(reader, "light", i + 1);
        read_point(reader, "position", &scene->lights[i].position);
        read_colour(reader, "colour", read_number, &scene->lights[i].intensity);
        leave(reader);
    }
}

static void read_output_pattern(Reader *reader, char pattern[HD_MAX_PATH]) {
    char prefix[HD_MAX_PATH];
    read_path(reader, "output path", pattern);
    if (reader->status != HD_OK)
        return;
    reader->status = hd_pattern_check(pattern, reader->error);
    if (reader->status != HD_OK) {
        snprintf(prefix, sizeof prefix, "%s:%d: output path", reader->name, reader->line);
        hd_error_prefix(reader->error, prefix);
    }
}

static void read_input(Reader *reader, const HdSolidKind *kinds, HdSceneFile *input) {
    HdScene *scene = &input->scene;
    scene->exposure = 1.0;
    read_int(reader, "number of frames", 1, HD_MAX_FRAMES, &scene->frame_count);
    read_output_pattern(reader, input->output.path);
    read_int(reader, "width", 1, HD_MAX_IMAGE_SIDE, &scene->width);
    read_int(reader, "height", 1, HD_MAX_IMAGE_SIDE, &scene->height);
    read_number(reader, "field of view", &scene->field_of_view_degrees);
    read_cylinder_path(reader, "eye", &scene->eye.cylinder);
    read_cylinder_path(reader, "target", &scene->target.cylinder);
    read_solids(reader, kinds, scene);
    read_floor(reader, input);
    read_lights(reader, scene);
    read_int(reader, "recursion depth", 0, HD_MAX_DEPTH, &scene->depth);
    read_int(reader, "square root of the number of rays per pixel", 1, HD_MAX_SAMPLES_PER_SIDE,
             &scene->samples_per_side);
    read_end(reader);
    if (reader->status != HD_OK)
        return;
    reader->status = hd_scene_validate(scene, reader->error);
    if (reader->status != HD_OK)
        hd_error_prefix(reader->error, reader->name);
}

static const HdSolidKind variants[HD_CLASSIC_VARIANTS][HD_CLASSIC_SOLIDS] = {
    {HD_TETRAHEDRON, HD_HEXAHEDRON, HD_OCTAHEDRON},
    {HD_TETRAHEDRON, HD_HEXAHEDRON, HD_DODECAHEDRON},
    {HD_TETRAHEDRON, HD_HEXAHEDRON, HD_ICOSAHEDRON},
    {HD_TETRAHEDRON, HD_OCTAHEDRON, HD_DODECAHEDRON},
    {HD_TETRAHEDRON, HD_OCTAHEDRON, HD_ICOSAHEDRON},
    {HD_TETRAHEDRON, HD_DODECAHEDRON, HD_ICOSAHEDRON},
    {HD_HEXAHEDRON, HD_OCTAHEDRON, HD_DODECAHEDRON},
    {HD_HEXAHEDRON, HD_OCTAHEDRON, HD_ICOSAHEDRON},
    {HD_HEXAHEDRON, HD_DODECAHEDRON, HD_ICOSAHEDRON},
    {HD_OCTAHEDRON, HD_DODECAHEDRON, HD_ICOSAHEDRON},
};

/* Returns the first character that is not in `before`, or '\0'. */
static char first_beyond(const char *before, const char *text, size_t size) {
    size_t start = 0;
    while (start < size && text[start] != '\0' && strchr(before, text[start]) != NULL)
        start++;
    return start < size ? text[start] : '\0';
}

bool hd_classic_may_be(const char *text, size_t size) {
    const char first = first_beyond(" \t\n\v\f\r", text, size);
    return first != '\0' && strchr("0123456789+-.", first) != NULL;
}

HdStatus hd_classic_parse(HdSceneFile *input, const char *text, size_t size, const char *name,
                          int variant, HdError *error) {
    *input = (HdSceneFile){.output.style = {.picture = {.curve = HD_CURVE_LINEAR, .bits = 8},
                                            .frames_per_second = HD_DEFAULT_FRAMES_PER_SECOND},
                           .texture_curve = HD_CURVE_LINEAR};
    if (variant < 1 || variant > HD_CLASSIC_VARIANTS)
        return hd_fail(error, HD_BAD_INPUT, "the variant is %d, expected 1 to %d", variant,
                       HD_CLASSIC_VARIANTS);
    if (text == NULL) /* an empty input may have no memory */
        text = "";
    if (first_beyond(" \t\r\n\xef\xbb\xbf", text, size) == '{')
        return hd_fail(error, HD_BAD_INPUT,
                       "%s: this looks like a scene file, which 'hedron render FILE' renders",
                       name);
    Reader reader = {.text = text, .size = size, .line = 1, .name = name, .error = error};
    reader.hides_tokens = !hd_classic_may_be(text, size);
    read_input(&reader, variants[variant - 1], input);
    if (reader.status != HD_OK)
        hd_scene_file_free(input);
    return reader.status;
}

/* Writing */

static void print_number(FILE *out, double value) {
    char text[HD_NUMBER_SIZE];
    hd_exact_number(value, text);
    fputs(text, out);
}

static void print_numbers(FILE *out, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        if (i > 0)
            putc(' ', out);
        print_number(out, values[i]);
    }
}

static void print_vector(FILE *out, HdVec3 v) {
    const double values[3] = {v.x, v.y, v.z};
    print_numbers(out, values, 3);
}

static void print_cylinder_path(FILE *out, const HdCylinderPath *path) {
    const double base[3] = {path->r0, path->z0, path->phi0};
    const double amplitudes[2] = {path->r_amplitude, path->z_amplitude};
    const double frequencies[3] = {path->r_frequency, path->z_frequency, path->phi_frequency};
    const double phases[2] = {path->r_phase, path->z_phase};
    print_numbers(out, base, 3);
    fputs("   ", out);
    print_numbers(out, amplitudes, 2);
    fputs("   ", out);
    print_numbers(out, frequencies, 3);
    fputs("   ", out);
    print_numbers(out, phases, 2);
    putc('\n', out);
}

static void print_solid(FILE *out, const HdSolid *solid) {
    const double values[3] = {solid->circumradius, solid->face.reflection,
                              solid->face.transmission};
    print_vector(out, solid->centre);
    fputs("   ", out);
    print_vector(out, solid->face.colour);
    fputs("   ", out);
    print_numbers(out, values, 3);
    fprintf(out, "   %d\n", solid->lights.per_edge);
}

static void print_floor(FILE *out, const HdFloor *floor, const char *texture_path) {
    for (int i = 0; i < 4; i++) {
        print_vector(out, floor->corners[i]);
        fputs("   ", out);
    }
    fprintf(out, "%s   ", texture_path);
    print_vector(out, floor->material.colour);
    fputs("   ", out);
    print_number(out, floor->material.reflection);
    putc('\n', out);
}

static void print_lights(FILE *out, const HdScene *scene) {
    fprintf(out, "%d\n", scene->light_count);
    for (int i = 0; i < scene->light_count; i++) {
        print_vector(out, scene->lights[i].position);
        fputs("   ", out);
        print_vector(out, scene->lights[i].intensity);
        putc('\n', out);
    }
}

static bool is_one_token(const char *path) {
    return path[0] != '\0' && strpbrk(path, " \t\n\v\f\r") == NULL;
}

static HdStatus check_fits(const HdSceneFile *input, HdError *error) {
    const HdScene *scene = &input->scene;
    if (scene->solid_count != HD_CLASSIC_SOLIDS)
        return hd_fail(error, HD_BAD_INPUT, "the scene has %d solids, expected %d",
                       scene->solid_count, HD_CLASSIC_SOLIDS);
    if (!scene->floor.present)
        return hd_fail(error, HD_BAD_INPUT, "the scene has no floor, expected one");
    if (scene->light_count > HD_CLASSIC_MAX_LIGHTS)
        return hd_fail(error, HD_BAD_INPUT, "the scene has %d lights, expected at most %d",
                       scene->light_count, HD_CLASSIC_MAX_LIGHTS);
    if (!is_one_token(input->output.path))
        return hd_fail(error, HD_BAD_INPUT,
                       "the output path is '%s', expected one without white space",
                       input->output.path);
    if (!is_one_token(input->texture_path))
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture path is '%s', expected one without white space",
                       input->texture_path);
    return HD_OK;
}

HdStatus hd_classic_print(FILE *out, const HdSceneFile *input, HdError *error) {
    const HdScene *scene = &input->scene;
    HD_TRY(check_fits(input, error));
    fprintf(out, "%d\n%s\n%d %d ", scene->frame_count, input->output.path, scene->width,
            scene->height);
    print_number(out, scene->field_of_view_degrees);
    putc('\n', out);
    print_cylinder_path(out, &scene->eye.cylinder);
    print_cylinder_path(out, &scene->target.cylinder);
    for (int i = 0; i < HD_CLASSIC_SOLIDS; i++)
        print_solid(out, &scene->solids[i]);
    print_floor(out, &scene->floor, input->texture_path);
    print_lights(out, scene);
    fprintf(out, "%d %d\n", scene->depth, scene->samples_per_side);
    if (fflush(out) != 0 || ferror(out))
        return hd_fail(error, HD_FAILED, "cannot write the configuration: %s", strerror(errno));
    return HD_OK;
}
