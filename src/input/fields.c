/* SPDX-License-Identifier: MIT */
#include "input/fields.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof(array)[0]))

#define TYPE_OF(struct_name, table, writes_all, note_text)                                         \
    {                                                                                              \
        .fields = (table), .field_count = COUNT_OF(table), .size = sizeof(struct_name),            \
        .is_complete = (writes_all), .note = (note_text)                                           \
    }
#define TYPE(struct_name, table, note_text)          TYPE_OF(struct_name, table, false, note_text)
#define COMPLETE_TYPE(struct_name, table, note_text) TYPE_OF(struct_name, table, true, note_text)

/* Begins a field: its offset, key and effect. */
#define AT(struct_name, member, key_text, about_text)                                              \
    .offset = offsetof(struct_name, member), .key = (key_text), .about = (about_text)

/* Begins a field without an offset. */
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
#define COLOUR              VECTOR(0.0, 1.0), .is_light = true, MEASURE("linear RGB")
#define DEFAULT(number)     .standard = {(number)}
#define WHITE               .standard = {1.0, 1.0, 1.0}
#define REQUIRED            .required = true
#define MEASURE(text)       .measure = (text)
#define EXAMPLE(text)       .example = (text)
#define WORLD               MEASURE("world units")
#define DEGREES             MEASURE("degrees")

/* Enums are stored as int. */
_Static_assert(sizeof(HdSolidKind) == sizeof(int), "an HdSolidKind is as large as an int");
_Static_assert(sizeof(HdCurve) == sizeof(int), "an HdCurve is as large as an int");
_Static_assert(sizeof(HdUpAxis) == sizeof(int), "an HdUpAxis is as large as an int");
_Static_assert(sizeof(HdMeshNormals) == sizeof(int), "an HdMeshNormals is as large as an int");

static const HdChoice versions[] = {{"1", 1}, {NULL, 0}};
static const HdChoice curves[] = {{"srgb", HD_CURVE_SRGB}, {"linear", HD_CURVE_LINEAR}, {NULL, 0}};
static const HdChoice bits[] = {{"8", 8}, {"16", 16}, {"32", 32}, {NULL, 0}};
static const HdChoice up_axes[] = {{"z", HD_UP_Z}, {"y", HD_UP_Y}, {NULL, 0}};
static const HdChoice normals[] = {
    {"file", HD_NORMALS_FILE}, {"flat", HD_NORMALS_FLAT}, {"smooth", HD_NORMALS_SMOOTH}, {NULL, 0}};
#define KIND_CHOICE(kind, name) {name, kind},
static const HdChoice kinds[] = {HD_SOLID_KINDS(KIND_CHOICE){NULL, 0}};

static const HdChoice samplings[] = {HD_SAMPLINGS(KIND_CHOICE){NULL, 0}};
_Static_assert(sizeof(HdSampling) == sizeof(int), "an HdSampling is as large as an int");

static const HdField image_fields[] = {
    {AT(HdScene, width, "width", "Width of the picture"), INTEGER(1, HD_MAX_IMAGE_SIDE),
     MEASURE("pixels"), DEFAULT(640)},
    {AT(HdScene, height, "height", "Height of the picture"), INTEGER(1, HD_MAX_IMAGE_SIDE),
     MEASURE("pixels"), DEFAULT(480)},
    {AT(HdScene, samples_per_side, "samples", "n: each pixel is the mean of n x n samples"),
     INTEGER(1, HD_MAX_SAMPLES_PER_SIDE), .name = "samples per side", DEFAULT(3)},
    {AT(HdScene, sample_rows, "sample_rows", "With multijitter, m: n x m samples instead of n x n"),
     INTEGER(1, HD_MAX_SAMPLES_PER_SIDE), .zero_is_absent = true},
    {AT(HdScene, depth, "depth", "Maximum ray depth: reflections and transmissions in a row"),
     INTEGER(0, HD_MAX_DEPTH), DEFAULT(8)},
    {AT(HdScene, cutoff, "cutoff",
        "Rays end when their weight is below this in every channel; 0: never"),
     NUMBER(0.0, 1.0), .below_high = true, DEFAULT(0.0)},
    {AT(HdScene, sampling, "aa",
        "Antialiasing: multijitter has one sample in each of n x n cells and in each of n * n "
        "columns and rows of the pixel, grid one in the middle of each cell"),
     CHOICE(samplings, HD_SAMPLING_MULTIJITTER)},
    {AT(HdScene, max_error, "max_error",
        "Maximum truncation error of a pixel; 0: off. Otherwise rays and lights end by this bound, "
        "and depth and cutoff are ignored unless the command line has them"),
     NUMBER(0.0, HD_MAX_ERROR), MEASURE("1/255"), .least_but_zero = HD_MIN_ERROR,
     .name = "max_error", DEFAULT(0.0)},
    {AT(HdScene, exposure, "exposure", "Factor of every pixel value"), NUMBER(0.0, HD_MAX_EXPOSURE),
     .above_low = true, DEFAULT(1.0)},
};
static const HdObjectType image =
    COMPLETE_TYPE(HdScene, image_fields, "A picture has at most 2^29 pixels.");

#define CYLINDER(member, unit_text, about_text)                                                    \
    { AT(HdPath, cylinder.member, #member, about_text), ANY_NUMBER, MEASURE(unit_text) }

static const HdField cylinder_fields[] = {
    CYLINDER(r0, "world units", "Mean distance from the z axis"),
    CYLINDER(z0, "world units", "Mean height"),
    CYLINDER(phi0, "radians", "Angle about the z axis at the start; 0 is the x axis"),
    CYLINDER(r_amplitude, "world units", "Amplitude of the distance"),
    CYLINDER(z_amplitude, "world units", "Amplitude of the height"),
    CYLINDER(r_frequency, "cycles", "Oscillations of the distance in the sequence"),
    CYLINDER(z_frequency, "cycles", "Oscillations of the height in the sequence"),
    CYLINDER(phi_frequency, "turns", "Turns about the z axis in the sequence"),
    CYLINDER(r_phase, "radians", "Phase of the distance"),
    CYLINDER(z_phase, "radians", "Phase of the height"),
};
static const HdObjectType cylinder =
    TYPE(HdPath, cylinder_fields,
         "A camera path on a cylinder about the z axis of the world. t goes from 0 to 2 pi in the "
         "sequence. r(t) = r0 + r_amplitude sin(r_frequency t + r_phase), and z(t) likewise; "
         "phi(t) = phi0 + phi_frequency t. The film loops without a jump if all frequencies are "
         "whole numbers.");

#define PATH                                                                                       \
    .type = HD_FIELD_PATH, .low = -HD_MAX_NUMBER, .high = HD_MAX_NUMBER, .object = &cylinder

static const HdField camera_fields[] = {
    {AT(HdScene, field_of_view_degrees, "field_of_view", "Horizontal field of view"),
     NUMBER(0.0, HD_MAX_FIELD_OF_VIEW), .above_low = true, .unit = " degrees", DEGREES,
     DEFAULT(60.0)},
    {AT(HdScene, frame_count, "frames", "Number of frames in the sequence"),
     INTEGER(1, HD_MAX_FRAMES), .name = "frame count", DEFAULT(1)},
    {AT(HdScene, eye, "eye", "Position of the eye: a point, or a path on a cylinder"), PATH, WORLD,
     EXAMPLE("{\"r0\": 6, \"z0\": 1.1, \"phi0\": -0.75, \"phi_frequency\": 1}"), REQUIRED,
     DEFAULT(1.0)},
    {AT(HdScene, target, "target",
        "Position that the eye looks at: a point, or a path on a cylinder; never that of the eye"),
     PATH, WORLD, DEFAULT(0.0)},
};
static const HdObjectType camera = COMPLETE_TYPE(HdScene, camera_fields, NULL);

static const HdField output_fields[] = {
    {AT(HdSceneFile, output.path, "path",
        "File of the picture, sequence or film; #### or %04d stands for the frame number"),
     TEXT, EXAMPLE("\"out/%04d.png\"")},
    {AT(HdSceneFile, output.style, "frames_per_second", "Frame rate of a film"),
     .type = HD_FIELD_RATE, .low = 1, .high = HD_MAX_FRAMES_PER_SECOND, MEASURE("frames/s"),
     EXAMPLE("\"24000/1001\""), DEFAULT(HD_DEFAULT_FRAMES_PER_SECOND)},
    {AT(HdSceneFile, output.style.picture.curve, "curve",
        "Transfer curve of the values in the file; never linear for a GIF"),
     CHOICE(curves, HD_CURVE_SRGB)},
    {AT(HdSceneFile, output.style.picture.bits, "bits",
        "Bits of a channel: 8 or 16 for PNG; 32 makes OpenEXR float instead of half"),
     CHOICE(bits, 8), MEASURE("bits")},
    {AT(HdSceneFile, output.style.picture.has_alpha, "alpha",
        "Whether PNG has alpha; colours are then without the background"),
     .type = HD_FIELD_BOOLEAN, DEFAULT(0)},
};
static const HdObjectType output = COMPLETE_TYPE(HdSceneFile, output_fields, NULL);

#define INNER_SIDE .flag_offset = offsetof(HdMaterial, has_inner_side)

static const HdField material_fields[] = {
    {AT(HdMaterial, colour, "colour", "Tint of diffuse light and of transmitted rays"), COLOUR,
     WHITE},
    {AT(HdMaterial, mirror_tint, "mirror_tint", "Tint of reflected rays"), COLOUR, WHITE},
    {AT(HdMaterial, ambient, "ambient", "Coefficient of ambient light, the same everywhere"),
     NUMBER(0.0, HD_MAX_COEFFICIENT), DEFAULT(0.0)},
    {AT(HdMaterial, diffuse, "diffuse", "Coefficient of diffuse light"),
     NUMBER(0.0, HD_MAX_COEFFICIENT), DEFAULT(0.0)},
    {AT(HdMaterial, specular, "specular", "Coefficient of the highlight"),
     NUMBER(0.0, HD_MAX_COEFFICIENT), DEFAULT(0.0)},
    {AT(HdMaterial, shininess, "shininess",
        "Exponent of the highlight; a larger one makes it smaller"),
     INTEGER(1, HD_MAX_SHININESS), DEFAULT(64)},
    {AT(HdMaterial, reflection, "reflection", "Share of the light that is reflected"),
     NUMBER(0.0, 1.0), DEFAULT(0.0)},
    {AT(HdMaterial, transmission, "transmission", "Share of the light that passes through"),
     NUMBER(0.0, 1.0), DEFAULT(0.0)},
    {AT(HdMaterial, inner_reflection, "inner_reflection",
        "Reflection of rays inside the solid; as outside unless given"),
     NUMBER(0.0, 1.0), INNER_SIDE},
    {AT(HdMaterial, inner_transmission, "inner_transmission",
        "Transmission of rays inside the solid; as outside unless given"),
     NUMBER(0.0, 1.0), INNER_SIDE},
    {AT(HdMaterial, index_of_refraction, "index_of_refraction",
        "Index inside the solid; outside it is 1, or that of what holds it"),
     NUMBER(HD_MIN_INDEX_OF_REFRACTION, HD_MAX_INDEX_OF_REFRACTION), DEFAULT(1.0)},
    {AT(HdMaterial, lit_from_behind, "lit_from_behind",
        "Whether lights behind a face shine through it"),
     .type = HD_FIELD_BOOLEAN, DEFAULT(0)},
};
const HdObjectType hd_material_fields = TYPE(
    HdMaterial, material_fields,
    "Reflection and transmission add up to at most 1, outside and inside. A solid that refracts "
    "may overlap what is opaque or the floor, or be within another. One-way "
    "mirrors show the infinity effect: little "
    "reflection and much transmission outside, an inner_reflection of about 0.9.");

#define MATERIAL .type = HD_FIELD_MATERIAL, REQUIRED
#define LENGTH   NUMBER(HD_MIN_LENGTH, HD_MAX_NUMBER), WORLD

#define FALLOFF(struct_name)                                                                       \
    {AT(struct_name, falloff.distance, "falloff_distance",                                         \
        "d0 of the falloff 1 / (1 + (d / d0)^2); no falloff unless given"),                        \
     LENGTH, .zero_is_absent = true},                                                              \
    {                                                                                              \
        AT(struct_name, falloff.end, "falloff_end",                                                \
           "d1 of the falloff (1 - (d / d1)^2)^2, dark beyond d1; not with falloff_distance"),     \
            LENGTH, .zero_is_absent = true, .instead_of = "falloff_distance"                       \
    }

static const HdField rim_fields[] = {
    {AT(HdSolid, rim_width, "width",
        "Width of the rim in the face, from the edge inwards; below the inradius of the face"),
     LENGTH, REQUIRED},
    {AT(HdSolid, rim, "material", "Name of the rim's material, which must be opaque"), MATERIAL},
};
static const HdObjectType rim = TYPE(HdSolid, rim_fields, NULL);

static const HdField edge_light_fields[] = {
    {AT(HdEdgeLights, per_edge, "per_edge", "Lights on each edge, evenly spaced"),
     INTEGER(0, HD_MAX_LIGHTS), .name = "number of lights per edge", REQUIRED},
    {AT(HdEdgeLights, colours, "colours", "Colours of the edges, repeated in order"),
     .type = HD_FIELD_VECTORS, .low = 0.0, .high = 1.0, .least = 1, .most = HD_MAX_EDGE_COLOURS,
     .count_offset = offsetof(HdEdgeLights, colour_count), .name = "edge lights' colour",
     .is_light = true, MEASURE("linear RGB"), EXAMPLE("[[1, 0.1, 0], [0, 0.3, 1]]"), WHITE},
    {AT(HdEdgeLights, intensity, "intensity",
        "Factor of the colour for the light that each casts; 0: it casts none"),
     NUMBER(0.0, HD_MAX_NUMBER), .name = "edge lights' intensity", DEFAULT(0.0)},
    {AT(HdEdgeLights, disc_radius, "disc_radius", "Radius of the visible disc of each light"),
     NUMBER(0.0, HD_MAX_NUMBER), WORLD, .name = "edge lights' disc radius", DEFAULT(0.0)},
    {AT(HdEdgeLights, disc_radiance, "disc_radiance",
        "Factor of the colour for the disc; above 1 its distant images still shine"),
     NUMBER(0.0, HD_MAX_NUMBER), .name = "edge lights' disc radiance", DEFAULT(0.0)},
    FALLOFF(HdEdgeLights),
};
static const HdObjectType edge_lights = TYPE(HdEdgeLights, edge_light_fields, NULL);

static bool has_rim(const void *owner) {
    return ((const HdSolid *)owner)->rim_width > 0.0;
}

static bool has_edge_lights(const void *owner) {
    return ((const HdSolid *)owner)->lights.colour_count > 0;
}

#define ROTATION_TEXT "Rotation about the world's x axis, then its y axis, then its z axis"
#define ROTATION      VECTOR(-HD_MAX_ROTATION, HD_MAX_ROTATION), DEGREES, DEFAULT(0.0)

static const HdField solid_fields[] = {
    {AT(HdSolid, kind, "kind", "One of the five platonic solids"), CHOICE(kinds, HD_TETRAHEDRON),
     REQUIRED},
    {AT(HdSolid, centre, "centre", "Position of the centre"), POSITION, WORLD, DEFAULT(0.0)},
    {AT(HdSolid, circumradius, "circumradius", "Distance from the centre to a vertex"), LENGTH,
     .name = "radius", DEFAULT(1.0)},
    {AT(HdSolid, rotation_degrees, "rotation", ROTATION_TEXT), ROTATION, EXAMPLE("[0, 0, 30]")},
    {AT(HdSolid, face, "material", "Name of the faces' material"), MATERIAL},
    {HERE("rim", "Frame along the edges of every face"), PART(rim), .is_given = has_rim},
    {AT(HdSolid, lights, "edge_lights", "Point lights along the edges"), PART(edge_lights),
     .is_given = has_edge_lights},
};
static const HdObjectType solid = TYPE(HdSolid, solid_fields, NULL);

static const HdField mesh_fields[] = {
    {AT(HdMeshEntry, file, "file", "Wavefront OBJ file, relative to the scene's folder"),
     .type = HD_FIELD_FILE, EXAMPLE("\"teapot.obj\""), REQUIRED},
    {AT(HdMeshEntry, instance.up, "up", "Axis of the object that points up"),
     CHOICE(up_axes, HD_UP_Z)},
    {AT(HdMeshEntry, size, "size",
        "Length of the longest side of its box in object space; the mesh then stands on position"),
     LENGTH, .zero_is_absent = true},
    {AT(HdMeshEntry, instance.position, "position",
        "Position of the mesh's origin in the world; with size, that below the middle of its box"),
     POSITION, WORLD, DEFAULT(0.0)},
    {AT(HdMeshEntry, instance.rotation_degrees, "rotation", ROTATION_TEXT), ROTATION},
    {AT(HdMeshEntry, instance.scale, "scale",
        "Factor from object to world units: one number, or one for each axis of the object. "
        "Negative ones mirror"),
     .type = HD_FIELD_SCALE, .low = HD_MIN_LENGTH, .high = HD_MAX_NUMBER, .has_sign = true, WHITE},
    {AT(HdMeshEntry, normals, "normals",
        "Shading normals: those of the file, flat if it has none; flat; or smooth except at "
        "creases"),
     CHOICE(normals, HD_NORMALS_FILE)},
    {AT(HdMeshEntry, crease_degrees, "crease",
        "Smooth normals keep an edge if its faces meet at a larger angle"),
     NUMBER(0.0, 180.0), DEGREES, DEFAULT(40.0)},
    {AT(HdMeshEntry, instance.material, "material",
        "Name of a material that replaces those of the file, except for Ke and map_Kd"),
     .type = HD_FIELD_MATERIAL, .flag_offset = offsetof(HdMeshEntry, instance.has_material)},
    {AT(HdMeshEntry, ambient, "ambient", "Factor of the file's Ka, which most programs set to 1"),
     NUMBER(0.0, 1.0), DEFAULT(0.0)},
};
static const HdObjectType mesh =
    TYPE(HdMeshEntry, mesh_fields,
         "The vertices of the file are in object space. They are scaled, turned upright, rotated, "
         "then moved. Entries with the same file, normals, crease and ambient share one mesh in "
         "memory.");

static const HdField light_fields[] = {
    {AT(HdLight, position, "position", "Position of the light"), POSITION, WORLD,
     EXAMPLE("[3, -4, 5]"), REQUIRED},
    {AT(HdLight, intensity, "colour", "Colour of the light"), .type = HD_FIELD_UNSCALED, .low = 0.0,
     .high = 1.0, MEASURE("linear RGB"), WHITE},
    {AT(HdLight, intensity, "intensity", "Factor of the colour"), .type = HD_FIELD_FACTOR,
     .low = 0.0, .high = HD_MAX_NUMBER, .is_light = true, DEFAULT(1.0)},
    FALLOFF(HdLight),
};
static const HdObjectType light = TYPE(HdLight, light_fields, NULL);

static const HdField texture_fields[] = {
    {AT(HdSceneFile, texture_path, "file",
        "PNG, JPEG or data file, relative to the scene's folder; \"builtin:floor\" is built in"),
     TEXT, REQUIRED},
    {AT(HdSceneFile, texture_curve, "curve", "Transfer curve of the values in the file"),
     CHOICE(curves, HD_CURVE_SRGB)},
};
static const HdObjectType texture = TYPE(HdSceneFile, texture_fields, NULL);

static bool has_texture(const void *owner) {
    return ((const HdSceneFile *)owner)->texture_path[0] != '\0';
}

static const HdField floor_fields[] = {
    {AT(HdSceneFile, scene.floor.corners, "corners",
        "Corners of a flat, convex quadrilateral, in order; the first is the texture's top "
        "left"),
     .type = HD_FIELD_VECTORS, .low = -HD_MAX_NUMBER, .high = HD_MAX_NUMBER, .least = 4, .most = 4,
     WORLD, EXAMPLE("[[-5, 5, -1], [5, 5, -1], [5, -5, -1], [-5, -5, -1]]"), .name = "corner",
     REQUIRED},
    {AT(HdSceneFile, scene.floor.material, "material", "Name of the floor's material"), MATERIAL},
    {HERE("texture", "Picture that tints the floor"), PART(texture), .is_given = has_texture},
};
static const HdObjectType floor_object = TYPE(HdSceneFile, floor_fields, NULL);

static const HdField environment_fields[] = {
    {AT(HdEnvironment, file, "file",
        "Panorama: PNG, JPEG, OpenEXR, PFM or data file, relative to the scene's folder"),
     .type = HD_FIELD_FILE, EXAMPLE("\"sky.jpg\""), REQUIRED},
    {AT(HdEnvironment, curve, "curve", "Transfer curve of the file; OpenEXR and PFM are linear"),
     CHOICE(curves, HD_CURVE_SRGB)},
    {AT(HdEnvironment, intensity, "intensity", "Factor of the picture"), NUMBER(0.0, HD_MAX_NUMBER),
     DEFAULT(1.0)},
    {AT(HdEnvironment, rotation_degrees, "rotation",
        "Rotation about the z axis; at 0 the picture's middle lies towards the x axis"),
     NUMBER(-HD_MAX_ROTATION, HD_MAX_ROTATION), DEGREES, DEFAULT(0.0)},
};
static const HdObjectType environment = TYPE(HdEnvironment, environment_fields, NULL);

static bool has_environment(const void *owner) {
    return ((const HdSceneFile *)owner)->scene.environment.file != NULL;
}

static const HdField scene_fields[] = {
    {AT(HdSceneFile, schema, "$schema", "Address of the JSON Schema, for editors"), TEXT},
    {AT(HdSceneFile, version, "hedron", "Version of the format"), CHOICE(versions, 1), REQUIRED,
     .is_unseen = true},
    {AT(HdSceneFile, scene, "image", "Size, samples and accuracy of the picture"), PART(image)},
    {AT(HdSceneFile, scene, "camera", "View, and its path in a film"), PART(camera), REQUIRED},
    {HERE("output", "File of the frames and its style"), PART(output), .is_unseen = true},
    {AT(HdSceneFile, scene.background, "background", "Radiance of rays that hit nothing"),
     VECTOR(0.0, HD_MAX_NUMBER), .is_light = true, MEASURE("linear RGB"), DEFAULT(0.0)},
    {AT(HdSceneFile, scene.environment, "environment",
        "Picture all around, added to background; it lights nothing"),
     PART(environment), .is_given = has_environment},
    {HERE("materials", "Materials by their names"), .type = HD_FIELD_MATERIALS,
     .object = &hd_material_fields, .most = HD_MAX_MATERIALS},
    {AT(HdSceneFile, scene.solids, "solids", "Platonic solids"), .type = HD_FIELD_LIST,
     .object = &solid, .most = HD_MAX_SOLIDS,
     .count_offset = offsetof(HdSceneFile, scene.solid_count)},
    {AT(HdSceneFile, mesh_entries, "meshes", "Meshes of triangles, each with its position"),
     .type = HD_FIELD_LIST, .object = &mesh, .most = HD_MAX_INSTANCES,
     .name = "meshes in their places", .count_offset = offsetof(HdSceneFile, mesh_entry_count)},
    {AT(HdSceneFile, scene.lights, "lights", "Point lights; edge lights count towards the limit"),
     .type = HD_FIELD_LIST, .object = &light, .most = HD_MAX_LIGHTS,
     .count_offset = offsetof(HdSceneFile, scene.light_count)},
    {HERE("floor", "Flat floor; none unless given"), PART(floor_object),
     .flag_offset = offsetof(HdSceneFile, scene.floor.present)},
};
const HdObjectType hd_scene_fields = TYPE(HdSceneFile, scene_fields, NULL);

void hd_field_describe(const HdField *field, char out[HD_DESCRIPTION_SIZE]) {
    const bool has_measure = field->measure != NULL;
    snprintf(out, HD_DESCRIPTION_SIZE, "%s%s%s%s", field->about, has_measure ? " (" : "",
             has_measure ? field->measure : "", has_measure ? ")" : "");
}

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
    const void *value = begin + field->offset;
    if (field->type == HD_FIELD_TEXT)
        return begin[field->offset] != '\0';
    if (field->zero_is_absent)
        return field->type == HD_FIELD_INTEGER ? *(const int *)value != 0
                                               : *(const double *)value != 0.0;
    if (field->flag_offset != 0)
        return *(const bool *)(const void *)(begin + field->flag_offset);
    return field->is_given == NULL || field->is_given(owner);
}

void hd_field_name(const HdField *field, char out[HD_FIELD_NAME_SIZE]) {
    snprintf(out, HD_FIELD_NAME_SIZE, "%s", field->name != NULL ? field->name : field->key);
    for (char *c = out; field->name == NULL && *c != '\0'; c++)
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
    if (field->has_sign)
        value = fabs(value);
    const bool from = field->above_low ? value > field->low : value >= field->low;
    const bool to = field->below_high ? value < field->high : value <= field->high;
    return from && to;
}

int hd_field_parts(const HdField *field) {
    static const int parts[HD_FIELD_MATERIALS + 1] = {
        [HD_FIELD_BOOLEAN] = 1, [HD_FIELD_INTEGER] = 1,  [HD_FIELD_NUMBER] = 1,
        [HD_FIELD_FACTOR] = 1,  [HD_FIELD_CHOICE] = 1,   [HD_FIELD_RATE] = 1,
        [HD_FIELD_VECTOR] = 3,  [HD_FIELD_UNSCALED] = 3, [HD_FIELD_VECTORS] = 3,
        [HD_FIELD_SCALE] = 3,   [HD_FIELD_PATH] = 3};
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
    else if (field->type == HD_FIELD_RATE) {
        ((HdOutputStyle *)place)->frames_per_second = (int)numbers[0];
        ((HdOutputStyle *)place)->is_ntsc = numbers[1] != 0.0;
    } else if (field->type == HD_FIELD_FACTOR)
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
        snprintf(out, HD_EXPECTED_SIZE, "%s from %s to %s%s", what, low, high,
                 field->has_sign ? ", or its negative" : "");
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
        [HD_FIELD_NUMBER] = number,
        [HD_FIELD_FACTOR] = number,
        [HD_FIELD_INTEGER] = "an integer",
        [HD_FIELD_RATE] = "an integer or \"n000/1001\", n",
        [HD_FIELD_VECTOR] = vector,
        [HD_FIELD_UNSCALED] = vector,
        [HD_FIELD_SCALE] = "one number or three, each a number"};
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
