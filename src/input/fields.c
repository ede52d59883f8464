/* SPDX-License-Identifier: MIT */
#include "input/fields.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof(array)[0]))

#define TYPE_OF(struct_name, table, writes_all)                                                    \
    {                                                                                              \
        .fields = (table), .field_count = COUNT_OF(table), .size = sizeof(struct_name),            \
        .is_complete = (writes_all)                                                                \
    }
#define TYPE(struct_name, table)          TYPE_OF(struct_name, table, false)
#define COMPLETE_TYPE(struct_name, table) TYPE_OF(struct_name, table, true)

/* What begins a field: its place, its key, and what it is about. */
#define AT(struct_name, member, key_text, about_text)                                              \
    .offset = offsetof(struct_name, member), .key = (key_text), .about = (about_text)

/* The same for what has no place of its own. */
#define HERE(key_text, about_text) .key = (key_text), .about = (about_text)

#define NUMBER(low_number, high_number)                                                            \
    .type = HD_FIELD_NUMBER, .low = (low_number), .high = (high_number)
#define INTEGER(low_number, high_number)                                                           \
    .type = HD_FIELD_INTEGER, .low = (low_number), .high = (high_number)
#define VECTOR(low_number, high_number)                                                            \
    .type = HD_FIELD_VECTOR, .low = (low_number), .high = (high_number)
#define CHOICE(list, value) .type = HD_FIELD_CHOICE, .choices = (list), .standard = {(value)}
#define PART(object_type)   .type = HD_FIELD_OBJECT, .object = &(object_type)
#define TEXT                .type = HD_FIELD_TEXT
#define ANY_NUMBER          NUMBER(-HD_MAX_NUMBER, HD_MAX_NUMBER)
#define POSITION            VECTOR(-HD_MAX_NUMBER, HD_MAX_NUMBER)
#define COLOUR              VECTOR(0.0, 1.0), .is_light = true
#define DEFAULT(number)     .standard = {(number)}
#define WHITE               .standard = {1.0, 1.0, 1.0}
#define REQUIRED            .required = true

/* Enums are stored as int. */
_Static_assert(sizeof(HdSolidKind) == sizeof(int), "an HdSolidKind is as large as an int");
_Static_assert(sizeof(HdCurve) == sizeof(int), "an HdCurve is as large as an int");
_Static_assert(sizeof(HdMeshNormals) == sizeof(int), "an HdMeshNormals is as large as an int");

static const HdChoice versions[] = {{"1", 1}, {NULL, 0}};
static const HdChoice curves[] = {{"srgb", HD_CURVE_SRGB}, {"linear", HD_CURVE_LINEAR}, {NULL, 0}};
static const HdChoice bits[] = {{"8", 8}, {"16", 16}, {"32", 32}, {NULL, 0}};
static const HdChoice normals[] = {
    {"file", HD_NORMALS_FILE}, {"flat", HD_NORMALS_FLAT}, {"smooth", HD_NORMALS_SMOOTH}, {NULL, 0}};
#define KIND_CHOICE(kind, name) {name, kind},
static const HdChoice kinds[] = {HD_SOLID_KINDS(KIND_CHOICE){NULL, 0}};

static const HdChoice samplings[] = {
    {"grid", HD_SAMPLING_GRID}, {"adaptive", HD_SAMPLING_ADAPTIVE}, {NULL, 0}};
_Static_assert(sizeof(HdSampling) == sizeof(int), "an HdSampling is as large as an int");

static const HdField image_fields[] = {
    {AT(HdScene, width, "width", "Pixels in a row"), INTEGER(1, HD_MAX_IMAGE_SIDE), DEFAULT(640)},
    {AT(HdScene, height, "height", "Rows of pixels"), INTEGER(1, HD_MAX_IMAGE_SIDE), DEFAULT(480)},
    {AT(HdScene, samples_per_side, "samples",
        "n of the n x n samples that every pixel is the mean of"),
     INTEGER(1, HD_MAX_SAMPLES_PER_SIDE), .said = "samples per side", DEFAULT(3)},
    {AT(HdScene, depth, "depth", "How many times a ray may go on, mirrored or passing through"),
     INTEGER(0, HD_MAX_DEPTH), DEFAULT(8)},
    {AT(HdScene, cutoff, "cutoff", "Rays whose weight falls below it in every channel end; 0: off"),
     NUMBER(0.0, 1.0), .below_high = true, DEFAULT(0.0)},
    {AT(HdScene, sampling, "aa",
        "Which of the n x n samples a pixel gets: all of the grid, or as many as it needs"),
     CHOICE(samplings, HD_SAMPLING_GRID)},
    {AT(HdScene, max_error, "max_error",
        "What may be left out of a pixel, in steps of 255: depth, cutoff and lights follow from "
        "it; "
        "0: off"),
     NUMBER(0.0, HD_MAX_ERROR), .least_but_zero = HD_MIN_ERROR, .said = "max_error", DEFAULT(0.0)},
    {AT(HdScene, exposure, "exposure", "What every pixel is multiplied by"),
     NUMBER(0.0, HD_MAX_EXPOSURE), .above_low = true, DEFAULT(1.0)},
};
static const HdObjectType image = COMPLETE_TYPE(HdScene, image_fields);

#define CYLINDER(member, about_text)                                                               \
    { AT(HdPath, cylinder.member, #member, about_text), ANY_NUMBER }

static const HdField cylinder_fields[] = {
    CYLINDER(r0, "Mean distance from the z axis"),
    CYLINDER(z0, "Mean height"),
    CYLINDER(phi0, "Angle about the z axis at the start, in radians"),
    CYLINDER(r_amplitude, "How far the distance swings"),
    CYLINDER(z_amplitude, "How far the height swings"),
    CYLINDER(r_frequency, "Swings of the distance in the whole sequence"),
    CYLINDER(z_frequency, "Swings of the height in the whole sequence"),
    CYLINDER(phi_frequency, "Turns about the z axis"),
    CYLINDER(r_phase, "Phase of the distance's swing, in radians"),
    CYLINDER(z_phase, "Phase of the height's swing, in radians"),
};
static const HdObjectType cylinder = TYPE(HdPath, cylinder_fields);

#define PATH                                                                                       \
    .type = HD_FIELD_PATH, .low = -HD_MAX_NUMBER, .high = HD_MAX_NUMBER, .object = &cylinder

static const HdField camera_fields[] = {
    {AT(HdScene, field_of_view_degrees, "field_of_view", "Horizontal field of view, in degrees"),
     NUMBER(0.0, HD_MAX_FIELD_OF_VIEW), .above_low = true, .unit = " degrees", DEFAULT(60.0)},
    {AT(HdScene, frame_count, "frames", "Frames of the whole sequence"), INTEGER(1, HD_MAX_FRAMES),
     .said = "frame count", DEFAULT(1)},
    {AT(HdScene, eye, "eye", "Where the eye is: a point, or a path on a cylinder"), PATH, REQUIRED,
     DEFAULT(1.0)},
    {AT(HdScene, target, "target", "What the eye looks at: a point, or a path on a cylinder"), PATH,
     DEFAULT(0.0)},
};
static const HdObjectType camera = COMPLETE_TYPE(HdScene, camera_fields);

static const HdField output_fields[] = {
    {AT(HdSceneFile, output.path, "path",
        "File of the picture or film; #### or %04d stands for the number of a frame"),
     TEXT},
    {AT(HdSceneFile, output.style.frames_per_second, "frames_per_second", "Speed of a film"),
     INTEGER(1, HD_MAX_FRAMES_PER_SECOND), DEFAULT(HD_DEFAULT_FRAMES_PER_SECOND)},
    {AT(HdSceneFile, output.style.picture.curve, "curve",
        "Transfer curve of the numbers in the file"),
     CHOICE(curves, HD_CURVE_SRGB)},
    {AT(HdSceneFile, output.style.picture.bits, "bits",
        "Bits of a channel: of PNG 8 or 16; 32: OpenEXR in float, otherwise in half"),
     CHOICE(bits, 8)},
};
static const HdObjectType output = COMPLETE_TYPE(HdSceneFile, output_fields);

#define INNER_SIDE .flag_offset = offsetof(HdMaterial, has_inner_side)

static const HdField material_fields[] = {
    {AT(HdMaterial, colour, "colour", "Tint of diffuse light and of what passes through, linear"),
     COLOUR, WHITE},
    {AT(HdMaterial, mirror_tint, "mirror_tint", "Tint of the mirror image, linear"), COLOUR, WHITE},
    {AT(HdMaterial, ambient, "ambient", "Coefficient of the light that is everywhere"),
     NUMBER(0.0, HD_MAX_COEFFICIENT), DEFAULT(0.0)},
    {AT(HdMaterial, diffuse, "diffuse", "Coefficient of diffuse light"),
     NUMBER(0.0, HD_MAX_COEFFICIENT), DEFAULT(0.0)},
    {AT(HdMaterial, specular, "specular", "Coefficient of the highlight"),
     NUMBER(0.0, HD_MAX_COEFFICIENT), DEFAULT(0.0)},
    {AT(HdMaterial, shininess, "shininess", "Exponent of the highlight"),
     INTEGER(1, HD_MAX_SHININESS), DEFAULT(64)},
    {AT(HdMaterial, reflection, "reflection",
        "Share that is mirrored; at most 1 together with the transmission"),
     NUMBER(0.0, 1.0), DEFAULT(0.0)},
    {AT(HdMaterial, transmission, "transmission", "Share that passes through"), NUMBER(0.0, 1.0),
     DEFAULT(0.0)},
    {AT(HdMaterial, inner_reflection, "inner_reflection",
        "Reflection of rays from inside the solid; as outside unless given"),
     NUMBER(0.0, 1.0), INNER_SIDE},
    {AT(HdMaterial, inner_transmission, "inner_transmission",
        "Transmission of rays from inside the solid; as outside unless given"),
     NUMBER(0.0, 1.0), INNER_SIDE},
    {AT(HdMaterial, index_of_refraction, "index_of_refraction",
        "Inside the solid, 1 outside; 1: rays go straight on"),
     NUMBER(HD_MIN_INDEX_OF_REFRACTION, HD_MAX_INDEX_OF_REFRACTION), DEFAULT(1.0)},
    {AT(HdMaterial, lit_from_behind, "lit_from_behind",
        "Whether lights behind the face shine through it"),
     .type = HD_FIELD_BOOLEAN, DEFAULT(0)},
};
const HdObjectType hd_material_fields = TYPE(HdMaterial, material_fields);

#define MATERIAL .type = HD_FIELD_MATERIAL, REQUIRED
#define LENGTH   NUMBER(HD_MIN_LENGTH, HD_MAX_NUMBER)

#define FALLOFF(struct_name)                                                                       \
    {AT(struct_name, falloff.distance, "falloff_distance",                                         \
        "d0 of the falloff 1 / (1 + (d / d0)^2); no falloff unless given"),                        \
     LENGTH, .zero_is_absent = true},                                                              \
    {                                                                                              \
        AT(struct_name, falloff.end, "falloff_end",                                                \
           "d1 of the falloff (1 - (d / d1)^2)^2, which ends at d1; no falloff unless given"),     \
            LENGTH, .zero_is_absent = true, .instead_of = "falloff_distance"                       \
    }

static const HdField rim_fields[] = {
    {AT(HdSolid, rim_width, "width", "Measured in the face, from the edge inwards"), LENGTH,
     REQUIRED},
    {AT(HdSolid, rim, "material", "Name of its material, which must be opaque"), MATERIAL},
};
static const HdObjectType rim = TYPE(HdSolid, rim_fields);

static const HdField edge_light_fields[] = {
    {AT(HdEdgeLights, per_edge, "per_edge", "Lights on each edge, evenly spaced"),
     INTEGER(0, HD_MAX_LIGHTS), .said = "number of lights per edge", REQUIRED},
    {AT(HdEdgeLights, colours, "colours", "The edges take these in turn; linear"),
     .type = HD_FIELD_VECTORS, .low = 0.0, .high = 1.0, .least = 1, .most = HD_MAX_EDGE_COLOURS,
     .count_offset = offsetof(HdEdgeLights, colour_count), .said = "edge lights' colour",
     .is_light = true, WHITE},
    {AT(HdEdgeLights, intensity, "intensity",
        "Of each light, times its colour; 0: it lights nothing"),
     NUMBER(0.0, HD_MAX_NUMBER), .said = "edge lights' intensity", DEFAULT(0.0)},
    {AT(HdEdgeLights, disc_radius, "disc_radius", "Each light is seen as a disc of this radius"),
     NUMBER(0.0, HD_MAX_NUMBER), .said = "edge lights' disc radius", DEFAULT(0.0)},
    {AT(HdEdgeLights, disc_radiance, "disc_radiance", "Brightness of the disc, times the colour"),
     NUMBER(0.0, HD_MAX_NUMBER), .said = "edge lights' disc radiance", DEFAULT(0.0)},
    FALLOFF(HdEdgeLights),
};
static const HdObjectType edge_lights = TYPE(HdEdgeLights, edge_light_fields);

static bool has_rim(const void *owner) {
    return ((const HdSolid *)owner)->rim_width > 0.0;
}

static bool has_edge_lights(const void *owner) {
    return ((const HdSolid *)owner)->lights.colour_count > 0;
}

static const HdField solid_fields[] = {
    {AT(HdSolid, kind, "kind", "Which of the five platonic solids"), CHOICE(kinds, HD_TETRAHEDRON),
     REQUIRED},
    {AT(HdSolid, centre, "centre", "Its centre"), POSITION, DEFAULT(0.0)},
    {AT(HdSolid, circumradius, "circumradius", "From the centre to a corner"), LENGTH,
     .said = "radius", DEFAULT(1.0)},
    {AT(HdSolid, rotation_degrees, "rotation",
        "Degrees about the x axis, then the y axis, then the z axis"),
     VECTOR(-HD_MAX_ROTATION, HD_MAX_ROTATION), DEFAULT(0.0)},
    {AT(HdSolid, face, "material", "Name of the faces' material"), MATERIAL},
    {HERE("rim", "A frame along the edges of every face"), PART(rim), .is_given = has_rim},
    {AT(HdSolid, lights, "edge_lights", "Point lights along the edges"), PART(edge_lights),
     .is_given = has_edge_lights},
};
static const HdObjectType solid = TYPE(HdSolid, solid_fields);

static const HdField mesh_fields[] = {
    {AT(HdMeshEntry, file, "file", "Wavefront OBJ; counts from the scene's folder"),
     .type = HD_FIELD_FILE, REQUIRED},
    {AT(HdMeshEntry, instance.position, "position", "Where the mesh's origin comes to lie"),
     POSITION, DEFAULT(0.0)},
    {AT(HdMeshEntry, instance.rotation_degrees, "rotation",
        "Degrees about the x axis, then the y axis, then the z axis"),
     VECTOR(-HD_MAX_ROTATION, HD_MAX_ROTATION), DEFAULT(0.0)},
    {AT(HdMeshEntry, instance.scale, "scale",
        "What coordinates are multiplied by before the rotation: one number, or one for each axis"),
     .type = HD_FIELD_SCALE, .low = HD_MIN_LENGTH, .high = HD_MAX_NUMBER, WHITE},
    {AT(HdMeshEntry, normals, "normals",
        "Those of the file, which is flat where it has none; flat; or smooth but for sharp edges"),
     CHOICE(normals, HD_NORMALS_FILE)},
    {AT(HdMeshEntry, crease_degrees, "crease",
        "Smooth normals keep edges where faces meet at more degrees"),
     NUMBER(0.0, 180.0), DEFAULT(40.0)},
    {AT(HdMeshEntry, instance.material, "material",
        "Name of a material in place of all that the file has"),
     .type = HD_FIELD_MATERIAL, .flag_offset = offsetof(HdMeshEntry, instance.has_material)},
};
static const HdObjectType mesh = TYPE(HdMeshEntry, mesh_fields);

static const HdField light_fields[] = {
    {AT(HdLight, position, "position", "Its place"), POSITION, REQUIRED},
    {AT(HdLight, intensity, "colour", "Linear"), .type = HD_FIELD_UNSCALED, .low = 0.0, .high = 1.0,
     WHITE},
    {AT(HdLight, intensity, "intensity", "What the colour is multiplied by"),
     .type = HD_FIELD_FACTOR, .low = 0.0, .high = HD_MAX_NUMBER, .is_light = true, DEFAULT(1.0)},
    FALLOFF(HdLight),
};
static const HdObjectType light = TYPE(HdLight, light_fields);

static const HdField texture_fields[] = {
    {AT(HdSceneFile, texture_path, "file",
        "PNG, JPEG or the data format; counts from the scene's folder; \"builtin:floor\" is built "
        "in"),
     TEXT, REQUIRED},
    {AT(HdSceneFile, texture_curve, "curve", "Transfer curve of the numbers in the file"),
     CHOICE(curves, HD_CURVE_SRGB)},
};
static const HdObjectType texture = TYPE(HdSceneFile, texture_fields);

static bool has_texture(const void *owner) {
    return ((const HdSceneFile *)owner)->texture_path[0] != '\0';
}

static const HdField floor_fields[] = {
    {AT(HdSceneFile, scene.floor.corners, "corners",
        "Of a flat and convex quadrilateral, in their order around it, from the texture's top "
        "left"),
     .type = HD_FIELD_VECTORS, .low = -HD_MAX_NUMBER, .high = HD_MAX_NUMBER, .least = 4, .most = 4,
     .said = "corner", REQUIRED},
    {AT(HdSceneFile, scene.floor.material, "material", "Name of its material"), MATERIAL},
    {HERE("texture", "Picture that tints the floor"), PART(texture), .is_given = has_texture},
};
static const HdObjectType floor_object = TYPE(HdSceneFile, floor_fields);

static const HdField scene_fields[] = {
    {AT(HdSceneFile, schema, "$schema", "Where the JSON Schema is, for editors"), TEXT},
    {AT(HdSceneFile, version, "hedron", "Version of the format"), CHOICE(versions, 1), REQUIRED,
     .is_unseen = true},
    {AT(HdSceneFile, scene, "image", "The picture and what it may cost"), PART(image)},
    {AT(HdSceneFile, scene, "camera", "The view"), PART(camera), REQUIRED},
    {HERE("output", "What becomes of the frames"), PART(output), .is_unseen = true},
    {AT(HdSceneFile, scene.background, "background", "Where a ray meets nothing; linear"),
     VECTOR(0.0, HD_MAX_NUMBER), .is_light = true, DEFAULT(0.0)},
    {HERE("materials", "Materials by their names"), .type = HD_FIELD_MATERIALS,
     .object = &hd_material_fields, .most = HD_MAX_MATERIALS},
    {AT(HdSceneFile, scene.solids, "solids", "Platonic solids"), .type = HD_FIELD_LIST,
     .object = &solid, .most = HD_MAX_SOLIDS,
     .count_offset = offsetof(HdSceneFile, scene.solid_count)},
    {AT(HdSceneFile, mesh_entries, "meshes", "Meshes of triangles, each in its place"),
     .type = HD_FIELD_LIST, .object = &mesh, .most = HD_MAX_INSTANCES,
     .said = "meshes in their places", .count_offset = offsetof(HdSceneFile, mesh_entry_count)},
    {AT(HdSceneFile, scene.lights, "lights", "Point lights"), .type = HD_FIELD_LIST,
     .object = &light, .most = HD_MAX_LIGHTS,
     .count_offset = offsetof(HdSceneFile, scene.light_count)},
    {HERE("floor", "A flat floor; none unless given"), PART(floor_object),
     .flag_offset = offsetof(HdSceneFile, scene.floor.present)},
};
const HdObjectType hd_scene_fields = TYPE(HdSceneFile, scene_fields);

const HdField *hd_field(const HdObjectType *type, const char *key) {
    for (int i = 0; i < type->field_count; i++)
        if (strcmp(type->fields[i].key, key) == 0)
            return &type->fields[i];
    return NULL;
}

bool hd_field_may_be_absent(const HdField *field) {
    const bool is_text = field->type == HD_FIELD_TEXT && !field->required;
    return is_text || field->zero_is_absent || field->flag_offset != 0 || field->is_given != NULL;
}

bool hd_field_is_given(const HdField *field, const void *owner) {
    const char *begin = owner;
    if (field->type == HD_FIELD_TEXT)
        return begin[field->offset] != '\0';
    if (field->zero_is_absent)
        return *(const double *)(const void *)(begin + field->offset) != 0.0;
    if (field->flag_offset != 0)
        return *(const bool *)(const void *)(begin + field->flag_offset);
    return field->is_given == NULL || field->is_given(owner);
}

void hd_field_said(const HdField *field, char out[HD_SAID_SIZE]) {
    snprintf(out, HD_SAID_SIZE, "%s", field->said != NULL ? field->said : field->key);
    for (char *c = out; field->said == NULL && *c != '\0'; c++)
        if (*c == '_')
            *c = ' ';
}

const char *hd_field_choice(const HdField *field, int value) {
    const HdChoice *choice = field->choices;
    while (choice[1].word != NULL && choice->value != value)
        choice++;
    return choice->word;
}

bool hd_choice_is_number(const char *word) {
    return word[0] >= '0' && word[0] <= '9';
}

int hd_field_count(const HdField *field, const void *owner) {
    if (field->count_offset == 0)
        return field->most;
    return *(const int *)(const void *)((const char *)owner + field->count_offset);
}

bool hd_field_holds(const HdField *field, double value) {
    const bool from = field->above_low ? value > field->low : value >= field->low;
    const bool to = field->below_high ? value < field->high : value <= field->high;
    return from && to;
}

int hd_field_parts(const HdField *field) {
    static const int parts[HD_FIELD_MATERIALS + 1] = {
        [HD_FIELD_BOOLEAN] = 1,  [HD_FIELD_INTEGER] = 1, [HD_FIELD_NUMBER] = 1,
        [HD_FIELD_FACTOR] = 1,   [HD_FIELD_CHOICE] = 1,  [HD_FIELD_VECTOR] = 3,
        [HD_FIELD_UNSCALED] = 3, [HD_FIELD_VECTORS] = 3, [HD_FIELD_SCALE] = 3,
        [HD_FIELD_PATH] = 3};
    return parts[field->type];
}

void hd_field_set(const HdField *field, void *owner, const double numbers[3]) {
    void *place = (char *)owner + field->offset;
    const HdVec3 vector = hd_vec3(numbers[0], numbers[1], numbers[2]);
    if (field->type == HD_FIELD_BOOLEAN)
        *(bool *)place = numbers[0] != 0.0;
    else if (field->type == HD_FIELD_INTEGER || field->type == HD_FIELD_CHOICE)
        *(int *)place = (int)numbers[0];
    else if (field->type == HD_FIELD_NUMBER)
        *(double *)place = numbers[0];
    else if (field->type == HD_FIELD_FACTOR)
        *(HdVec3 *)place = hd_scale(*(const HdVec3 *)place, numbers[0]);
    else if (field->type == HD_FIELD_PATH)
        *(HdPath *)place = (HdPath){.is_fixed = true, .point = vector};
    else if (hd_field_parts(field) == 3)
        *(HdVec3 *)place = vector;
    if (field->type == HD_FIELD_VECTORS && field->count_offset != 0)
        *(int *)(void *)((char *)owner + field->count_offset) = 1;
}

static void expected_range(const HdField *field, const char *what, char out[HD_EXPECTED_SIZE]) {
    char low[HD_NUMBER_SIZE], high[HD_NUMBER_SIZE];
    if (field->type == HD_FIELD_INTEGER) {
        snprintf(low, sizeof low, "%.0f", field->low);
        snprintf(high, sizeof high, "%.0f", field->high);
    } else {
        hd_short_number(field->low, low);
        hd_short_number(field->high, high);
    }
    if (!field->above_low && !field->below_high)
        snprintf(out, HD_EXPECTED_SIZE, "%s from %s to %s", what, low, high);
    else
        snprintf(out, HD_EXPECTED_SIZE, "%s %s %s and %s %s", what,
                 field->above_low ? "above" : "of at least", low,
                 field->below_high ? "below" : "at most", high);
}

static void expected_choice(const HdField *field, char out[HD_EXPECTED_SIZE]) {
    size_t used = 0;
    for (const HdChoice *choice = field->choices; choice->word != NULL; choice++) {
        const char *quote = hd_choice_is_number(choice->word) ? "" : "\"";
        const char *between = choice == field->choices ? ""
                              : choice[1].word == NULL ? " or "
                                                       : ", ";
        used += (size_t)snprintf(out + used, HD_EXPECTED_SIZE - used, "%s%s%s%s", between, quote,
                                 choice->word, quote);
    }
}

void hd_field_expected_count(const HdField *field, char out[HD_EXPECTED_SIZE]) {
    if (field->least == field->most)
        snprintf(out, HD_EXPECTED_SIZE, "%d elements", field->most);
    else if (field->least == 0)
        snprintf(out, HD_EXPECTED_SIZE, "at most %d elements", field->most);
    else
        snprintf(out, HD_EXPECTED_SIZE, "%d to %d elements", field->least, field->most);
}

void hd_field_expected(const HdField *field, int parts, char out[HD_EXPECTED_SIZE]) {
    static const char number[] = "a number", vector[] = "three numbers, each a number";
    static const char *const of_range[HD_FIELD_MATERIALS + 1] = {
        [HD_FIELD_NUMBER] = number,        [HD_FIELD_FACTOR] = number,
        [HD_FIELD_INTEGER] = "an integer", [HD_FIELD_VECTOR] = vector,
        [HD_FIELD_UNSCALED] = vector,      [HD_FIELD_SCALE] = "one number or three, each a number"};
    static const char *const plain[] = {
        [HD_FIELD_BOOLEAN] = "true or false",
        [HD_FIELD_TEXT] = "a string that is not empty",
        [HD_FIELD_FILE] = "a string that is not empty",
        [HD_FIELD_MATERIAL] = "the name of one of the materials",
        [HD_FIELD_PATH] = "three numbers, [x, y, z], or an object with the path on a cylinder",
        [HD_FIELD_OBJECT] = "an object",
        [HD_FIELD_LIST] = "an array of objects",
        [HD_FIELD_MATERIALS] = "an object with a material for each name",
        [HD_FIELD_VECTORS] = "an array of vectors"};
    const char *what = parts == 1 ? number : parts == 3 ? vector : of_range[field->type];
    if (what != NULL)
        expected_range(field, what, out);
    else if (field->type == HD_FIELD_CHOICE)
        expected_choice(field, out);
    else
        snprintf(out, HD_EXPECTED_SIZE, "%s", plain[field->type]);
}
