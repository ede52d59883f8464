/* SPDX-License-Identifier: MIT */
/* Scene files are read as they say, and refused with all that is wrong. */
#define _XOPEN_SOURCE 700

#include "input/builtin.h"
#include "scene_text.h"
#include "test_folder.h"

static HdSceneFile file;
static const HdSceneSource plain;

static void expect_vector(HdVec3 actual, double x, double y, double z) {
    expect_near(actual.x, x, 0.0);
    expect_near(actual.y, y, 0.0);
    expect_near(actual.z, z, 0.0);
}

static void expect_default_material(const HdMaterial *material) {
    expect_vector(material->colour, 1.0, 1.0, 1.0);
    expect_vector(material->mirror_tint, 1.0, 1.0, 1.0);
    expect_near(material->ambient, 0.0, 0.0);
    expect_near(material->diffuse, 0.0, 0.0);
    expect_near(material->specular, 0.0, 0.0);
    assert_int_equal(material->shininess, 64);
    expect_near(material->reflection, 0.0, 0.0);
    expect_near(material->transmission, 0.0, 0.0);
    assert_false(material->has_inner_side);
    expect_near(material->index_of_refraction, 1.0, 0.0);
    assert_false(material->lit_from_behind);
}

TEST(test_defaults_of_the_least_scene) {
    expect_scene(&file, least_text, NULL);
    const HdScene *scene = &file.scene;
    assert_int_equal(scene->width, 640);
    assert_int_equal(scene->height, 480);
    assert_int_equal(scene->samples_per_side, 3);
    assert_int_equal(scene->depth, 8);
    expect_near(scene->cutoff, 0.0, 0.0);
    expect_near(scene->exposure, 1.0, 0.0);
    expect_near(scene->field_of_view_degrees, 60.0, 0.0);
    assert_int_equal(scene->frame_count, 1);
    assert_true(scene->eye.is_fixed);
    expect_vector(scene->eye.point, 30.0, 0.0, 0.0);
    assert_true(scene->target.is_fixed);
    expect_vector(scene->target.point, 0.0, 0.0, 0.0);
    expect_vector(scene->background, 0.0, 0.0, 0.0);
    assert_int_equal(scene->solid_count, 0);
    assert_int_equal(scene->light_count, 0);
    assert_false(scene->floor.present);
    assert_string_equal(file.output.path, "");
    assert_int_equal(file.output.style.frames_per_second, 30);
    assert_int_equal(file.output.style.picture.curve, HD_CURVE_SRGB);
    assert_int_equal(file.output.style.picture.bits, 8);
    assert_string_equal(file.texture_path, "");
    hd_scene_file_free(&file);
}

TEST(test_defaults_of_parts) {
    expect_scene(&file,
                 "{\"hedron\": 1, \"camera\": {\"eye\": {}, \"target\": [1, 0, 0]},\n"
                 " \"materials\": {\"m\": {}, \"n\": {\"diffuse\": 1}},\n"
                 " \"solids\": [{\"kind\": \"octahedron\", \"material\": \"m\",\n"
                 "              \"edge_lights\": {\"per_edge\": 2}}],\n"
                 " \"lights\": [{\"position\": [0, 0, 1]}],\n"
                 " \"floor\": {\"corners\": [[-1,1,-9],[1,1,-9],[1,-1,-9],[-1,-1,-9]],\n"
                 "           \"material\": \"n\", \"texture\": {\"file\": \"builtin:floor\"}}}",
                 NULL);
    static const HdCylinderPath origin = {0};
    assert_false(file.scene.eye.is_fixed);
    assert_memory_equal(&file.scene.eye.cylinder, &origin, sizeof origin);
    const HdSolid *solid = &file.scene.solids[0];
    expect_vector(solid->centre, 0.0, 0.0, 0.0);
    expect_near(solid->circumradius, 1.0, 0.0);
    expect_vector(solid->rotation_degrees, 0.0, 0.0, 0.0);
    expect_default_material(&solid->face);
    expect_near(solid->rim_width, 0.0, 0.0);
    assert_int_equal(solid->lights.colour_count, 1);
    expect_vector(solid->lights.colours[0], 1.0, 1.0, 1.0);
    expect_near(solid->lights.intensity, 0.0, 0.0);
    expect_near(solid->lights.disc_radius, 0.0, 0.0);
    expect_near(solid->lights.disc_radiance, 0.0, 0.0);
    expect_near(solid->lights.falloff.distance, 0.0, 0.0);
    expect_near(solid->lights.falloff.end, 0.0, 0.0);
    expect_vector(file.scene.lights[0].intensity, 1.0, 1.0, 1.0);
    expect_near(file.scene.lights[0].falloff.distance, 0.0, 0.0);
    expect_near(file.scene.lights[0].falloff.end, 0.0, 0.0);
    expect_near(file.scene.floor.material.diffuse, 1.0, 0.0);
    assert_int_equal(file.scene.floor.texture.width, 0);
    assert_string_equal(file.texture_path, "builtin:floor");
    assert_int_equal(file.texture_curve, HD_CURVE_SRGB);
    hd_scene_file_free(&file);
}

TEST(test_rich_picture_and_camera) {
    static const double eye[10] = {30.0, 1.0, 0.1, 0.2, 0.3, 2.0, 3.0, 4.0, 0.4, 0.5};
    expect_scene(&file, rich_text, NULL);
    const HdScene *scene = &file.scene;
    assert_int_equal(scene->width, 320);
    assert_int_equal(scene->height, 200);
    assert_int_equal(scene->samples_per_side, 2);
    assert_int_equal(scene->depth, 5);
    expect_near(scene->cutoff, 0.01, 0.0);
    expect_near(scene->exposure, 1.5, 0.0);
    expect_near(scene->field_of_view_degrees, 75.0, 0.0);
    assert_int_equal(scene->frame_count, 24);
    assert_false(scene->eye.is_fixed);
    assert_memory_equal(&scene->eye.cylinder, eye, sizeof eye);
    assert_true(scene->target.is_fixed);
    expect_vector(scene->target.point, 0.5, 0.25, 0.125);
    expect_vector(scene->background, 0.1, 0.2, 3.0);
    assert_string_equal(file.output.path, "out/%04d.png");
    assert_int_equal(file.output.style.frames_per_second, 25);
    assert_int_equal(file.output.style.picture.curve, HD_CURVE_LINEAR);
    assert_int_equal(file.output.style.picture.bits, 16);
    assert_string_equal(file.texture_path, "floor.png");
    assert_int_equal(file.texture_curve, HD_CURVE_LINEAR);
    hd_scene_file_free(&file);
}

TEST(test_rich_material) {
    expect_scene(&file, rich_text, NULL);
    const HdMaterial *glass = &file.scene.solids[0].face;
    expect_vector(glass->colour, 0.9, 0.8, 0.7);
    expect_vector(glass->mirror_tint, 0.6, 0.5, 0.4);
    expect_near(glass->ambient, 0.01, 0.0);
    expect_near(glass->diffuse, 0.02, 0.0);
    expect_near(glass->specular, 0.03, 0.0);
    assert_int_equal(glass->shininess, 65);
    expect_near(glass->reflection, 0.04, 0.0);
    expect_near(glass->transmission, 0.05, 0.0);
    assert_true(glass->has_inner_side);
    expect_near(glass->inner_reflection, 0.06, 0.0);
    expect_near(glass->inner_transmission, 0.07, 0.0);
    expect_near(glass->index_of_refraction, 1.5, 0.0);
    assert_true(glass->lit_from_behind);
    expect_near(file.scene.solids[1].face.diffuse, 0.125, 0.0);
    expect_default_material(&file.scene.solids[1].rim);
    expect_default_material(&file.scene.solids[2].face);
    expect_near(file.scene.floor.material.diffuse, 0.125, 0.0);
    hd_scene_file_free(&file);
}

TEST(test_one_inner_share_alone) {
    expect_scene(&file, rich_text,
                 "materials.glass={\"reflection\": 0.25, \"transmission\": 0.5, "
                 "\"inner_reflection\": 0.125}");
    expect_near(file.scene.solids[0].face.inner_reflection, 0.125, 0.0);
    expect_near(file.scene.solids[0].face.inner_transmission, 0.5, 0.0);
    assert_true(file.scene.solids[0].face.has_inner_side);
    hd_scene_file_free(&file);
    expect_scene(&file, rich_text,
                 "materials.glass={\"reflection\": 0.25, \"transmission\": 0.5, "
                 "\"inner_transmission\": 0}");
    expect_near(file.scene.solids[0].face.inner_reflection, 0.25, 0.0);
    expect_near(file.scene.solids[0].face.inner_transmission, 0.0, 0.0);
    assert_true(file.scene.solids[0].face.has_inner_side);
    hd_scene_file_free(&file);
}

TEST(test_rich_solids) {
    expect_scene(&file, rich_text, NULL);
    assert_int_equal(file.scene.solid_count, 3);
    const HdSolid *solids = file.scene.solids;
    assert_int_equal(solids[0].kind, HD_HEXAHEDRON);
    assert_int_equal(solids[1].kind, HD_ICOSAHEDRON);
    assert_int_equal(solids[2].kind, HD_TETRAHEDRON);
    expect_vector(solids[0].centre, 1.0, 2.0, 3.0);
    expect_near(solids[0].circumradius, 2.0, 0.0);
    expect_vector(solids[0].rotation_degrees, 10.0, 20.0, 30.0);
    assert_int_equal(solids[0].lights.per_edge, 0);
    expect_near(solids[0].rim_width, 0.0, 0.0);
    expect_near(solids[1].rim_width, 0.05, 0.0);
    const HdEdgeLights *lights = &solids[1].lights;
    assert_int_equal(lights->per_edge, 3);
    assert_int_equal(lights->colour_count, 2);
    expect_vector(lights->colours[0], 1.0, 0.0, 0.0);
    expect_vector(lights->colours[1], 0.0, 1.0, 0.5);
    expect_near(lights->intensity, 0.1, 0.0);
    expect_near(lights->disc_radius, 0.02, 0.0);
    expect_near(lights->disc_radiance, 4.0, 0.0);
    expect_near(lights->falloff.distance, 6.0, 0.0);
    expect_near(lights->falloff.end, 0.0, 0.0);
    expect_near(solids[2].lights.falloff.distance, 0.0, 0.0);
    expect_near(solids[2].lights.falloff.end, 7.0, 0.0);
    hd_scene_file_free(&file);
}

TEST(test_rich_lights_and_floor) {
    expect_scene(&file, rich_text, NULL);
    assert_int_equal(file.scene.light_count, 2);
    const HdLight *lights = file.scene.lights;
    expect_vector(lights[0].position, 4.0, 5.0, 6.0);
    expect_vector(lights[0].intensity, 3.0, 1.5, 0.75);
    expect_near(lights[0].falloff.distance, 8.0, 0.0);
    expect_vector(lights[1].intensity, 1.0, 1.0, 1.0);
    expect_near(lights[1].falloff.end, 10.0, 0.0);
    assert_true(file.scene.floor.present);
    expect_vector(file.scene.floor.corners[0], -5.0, 5.0, -20.0);
    expect_vector(file.scene.floor.corners[1], 5.0, 5.0, -20.0);
    expect_vector(file.scene.floor.corners[2], 5.0, -5.0, -20.0);
    expect_vector(file.scene.floor.corners[3], -5.0, -5.0, -20.0);
    hd_scene_file_free(&file);
}

TEST(test_kinds) {
    static const char *const names[] = {"tetrahedron", "cube", "octahedron", "dodecahedron",
                                        "icosahedron"};
    for (int kind = 0; kind < HD_SOLID_KIND_COUNT; kind++) {
        char change[64];
        snprintf(change, sizeof change, "solids[0].kind=%s", names[kind]);
        expect_scene(&file, rich_text, change);
        assert_int_equal(file.scene.solids[0].kind, kind);
        hd_scene_file_free(&file);
    }
}

/* A field of numbers in the rich scene: both ends of its range, and what lies just outside. An end
   that is NULL contradicts the rest of the scene. */
typedef struct Range {
    const char *path, *low, *high, *below, *above, *expected;
} Range;

#define ANY_NUMBER "-1e12", "1e12", "-1.001e12", "1.001e12", "a number from -1e12 to 1e12"
#define SHARE      "0", "1", "-1e-9", "1.000001", "a number from 0 to 1"
#define LIGHT      "0", "1e12", "-1e-300", "1.001e12", "a number from 0 to 1e12"
#define FACTOR     "0", "1e6", "-0.5", "1000001", "a number from 0 to 1e6"
#define LENGTH     "1e-12", "1e12", "9e-13", "1.001e12", "a number from 1e-12 to 1e12"
#define TURN       "-1e6", "1e6", "-1000001", "1000001", "a number from -1e6 to 1e6"

static const Range ranges[] = {
    {"image.width", "1", "65535", "0", "65536", "an integer from 1 to 65535"},
    {"image.height", "1", "65535", "0", "65536", "an integer from 1 to 65535"},
    {"image.samples", "1", "64", "0", "65", "an integer from 1 to 64"},
    {"image.depth", "0", "1000", "-1", "1001", "an integer from 0 to 1000"},
    {"image.cutoff", "0", "0.999999", "-1e-9", "1", "a number of at least 0 and below 1"},
    {"image.exposure", "1e-300", "1e6", "0", "1000001", "a number above 0 and at most 1e6"},
    {"camera.field_of_view", "1e-6", "179", "0", "179.001", "a number above 0 and at most 179"},
    {"camera.frames", "1", "10000000", "0", "10000001", "an integer from 1 to 10000000"},
    {"camera.eye.r0", ANY_NUMBER},
    {"camera.eye.z0", ANY_NUMBER},
    {"camera.eye.phi0", ANY_NUMBER},
    {"camera.eye.r_amplitude", ANY_NUMBER},
    {"camera.eye.z_amplitude", ANY_NUMBER},
    {"camera.eye.r_frequency", ANY_NUMBER},
    {"camera.eye.z_frequency", ANY_NUMBER},
    {"camera.eye.phi_frequency", ANY_NUMBER},
    {"camera.eye.r_phase", ANY_NUMBER},
    {"camera.eye.z_phase", ANY_NUMBER},
    {"camera.target[0]", ANY_NUMBER},
    {"camera.target[1]", ANY_NUMBER},
    {"camera.target[2]", ANY_NUMBER},
    {"output.frames_per_second", "1", "240", "0", "241", "an integer from 1 to 240"},
    {"background[2]", LIGHT},
    {"materials.glass.colour[0]", SHARE},
    {"materials.glass.mirror_tint[1]", SHARE},
    {"materials.glass.ambient", FACTOR},
    {"materials.glass.diffuse", FACTOR},
    {"materials.glass.specular", FACTOR},
    {"materials.glass.shininess", "1", "65536", "0", "65537", "an integer from 1 to 65536"},
    {"materials.glass.reflection", "0", "0.95", "-1e-9", "1.000001", "a number from 0 to 1"},
    {"materials.glass.transmission", "0", "0.96", "-1e-9", "1.000001", "a number from 0 to 1"},
    {"materials.glass.inner_reflection", "0", "0.93", "-1e-9", "1.000001", "a number from 0 to 1"},
    {"materials.glass.inner_transmission", "0", "0.94", "-1e-9", "1.000001",
     "a number from 0 to 1"},
    {"materials.glass.index_of_refraction", "0.1", "10", "0.0999", "10.001",
     "a number from 0.1 to 10"},
    {"solids[1].centre[1]", ANY_NUMBER},
    {"solids[2].circumradius", "1e-12", NULL, "9e-13", "1.001e12", "a number from 1e-12 to 1e12"},
    {"solids[0].rotation[2]", TURN},
    {"solids[1].rim.width", "1e-12", NULL, "0", "1.001e12", "a number from 1e-12 to 1e12"},
    {"solids[1].edge_lights.per_edge", "0", "3332", "-1", "100001", "an integer from 0 to 100000"},
    {"solids[1].edge_lights.colours[1][2]", SHARE},
    {"solids[1].edge_lights.intensity", LIGHT},
    {"solids[1].edge_lights.disc_radius", LIGHT},
    {"solids[1].edge_lights.disc_radiance", LIGHT},
    {"solids[1].edge_lights.falloff_distance", LENGTH},
    {"solids[2].edge_lights.falloff_end", LENGTH},
    {"lights[0].position[0]", ANY_NUMBER},
    {"lights[0].colour[0]", SHARE},
    {"lights[0].intensity", LIGHT},
    {"lights[0].falloff_distance", LENGTH},
    {"lights[1].falloff_end", LENGTH},
    {"floor.corners[0][2]", "-20", "-20", "-1.001e12", "1.001e12", "a number from -1e12 to 1e12"},
};

enum { RANGE_COUNT = sizeof ranges / sizeof ranges[0] };

static void expect_change_accepted(const char *path, const char *value) {
    char change[128];
    if (value == NULL)
        return;
    snprintf(change, sizeof change, "%s=%s", path, value);
    expect_scene(&file, rich_text, change);
    hd_scene_file_free(&file);
}

static void expect_change_refused(const char *path, const char *value, const char *is,
                                  const char *expected) {
    char change[128], message[512];
    snprintf(change, sizeof change, "%s=%s", path, value);
    snprintf(message, sizeof message, "a.json: --set %s: %s is %s, expected %s", change, path, is,
             expected);
    assert_string_equal(expect_refused(rich_text, change, message), message);
}

TEST(test_ranges) {
    for (int i = 0; i < RANGE_COUNT; i++) {
        const Range *range = &ranges[i];
        expect_change_accepted(range->path, range->low);
        expect_change_accepted(range->path, range->high);
        expect_change_refused(range->path, range->below, range->below, range->expected);
        expect_change_refused(range->path, range->above, range->above, range->expected);
    }
}

TEST(test_wrong_types_of_numbers) {
    for (int i = 0; i < RANGE_COUNT; i++) {
        const Range *range = &ranges[i];
        expect_change_refused(range->path, "blue", "a string, \"blue\"", range->expected);
        expect_change_refused(range->path, "null", "null", range->expected);
        expect_change_refused(range->path, "true", "true", range->expected);
        expect_change_refused(range->path, "[1]", "an array of 1 element", range->expected);
        expect_change_refused(range->path, "{}", "an object", range->expected);
        /* No JSON, so strings: there are no such numbers. */
        expect_change_refused(range->path, "NaN", "a string, \"NaN\"", range->expected);
        expect_change_refused(range->path, "-Infinity", "a string, \"-Infinity\"", range->expected);
        if (strncmp(range->expected, "an integer", 10) == 0)
            expect_change_refused(range->path, "1.5", "1.5", range->expected);
    }
}

TEST(test_integers_with_a_point) {
    expect_scene(&file, rich_text, "image.width=1e2");
    assert_int_equal(file.scene.width, 100);
    hd_scene_file_free(&file);
    expect_change_refused("image.width", "1e300", "1e300", "an integer from 1 to 65535");
}

TEST(test_wrong_types_of_other_fields) {
    static const char vector[] = "three numbers, each a number from -1e12 to 1e12";
    static const char path[] = "three numbers, [x, y, z], or an object with the path on a cylinder";
    static const char material[] = "the name of one of the materials";
    static const char text[] = "a string that is not empty";
    expect_change_refused("hedron", "2", "2", "1");
    expect_change_refused("hedron", "\"1\"", "a string, \"1\"", "1");
    expect_change_refused("camera.eye", "3", "3", path);
    expect_change_refused("camera.target", "[1, 2]", "an array of 2 elements", vector);
    expect_change_refused("solids[0].centre", "7", "7", vector);
    expect_change_refused("lights[0].position", "[1,2,3,4]", "an array of 4 elements", vector);
    expect_change_refused("solids[0].kind", "7", "7",
                          "\"tetrahedron\", \"cube\", \"octahedron\", \"dodecahedron\" or "
                          "\"icosahedron\"");
    expect_change_refused("output.curve", "gamma", "a string, \"gamma\"", "\"srgb\" or \"linear\"");
    expect_change_refused("output.bits", "10", "10", "8, 16 or 32");
    expect_change_refused("floor.texture.curve", "null", "null", "\"srgb\" or \"linear\"");
    expect_change_refused("materials.glass.lit_from_behind", "1", "1", "true or false");
    expect_change_refused("solids[0].material", "7", "7", material);
    expect_change_refused("solids[0].material", "steel", "a string, \"steel\"", material);
    expect_refused(rich_text, "solids[0].material=glas",
                   "solids[0].material is a string, \"glas\"; did you mean \"glass\"?");
    expect_change_refused("output.path", "", "a string, \"\"", text);
    expect_change_refused("floor.texture.file", "[]", "an array of 0 elements", text);
    expect_change_refused("image", "[]", "an array of 0 elements", "an object");
    expect_change_refused("solids[0]", "[]", "an array of 0 elements", "an object");
    expect_change_refused("floor", "false", "false", "an object");
    expect_change_refused("lights", "{}", "an object", "an array of objects");
    expect_change_refused("floor.corners", "3", "3", "an array of vectors");
    expect_change_refused("materials", "3", "3", "an object with a material for each name");
}

TEST(test_numbers_of_elements) {
    static char change[1024] = "solids[1].edge_lights.colours=[[0,0,0]";
    expect_refused(rich_text, "solids[1].edge_lights.colours=[]",
                   "solids[1].edge_lights.colours has 0 elements, expected 1 to 30 elements");
    for (int i = 1; i < 30; i++)
        strcat(change, ",[0,0,0]");
    const size_t length = strlen(change);
    strcat(change, "]");
    expect_scene(&file, rich_text, change);
    assert_int_equal(file.scene.solids[1].lights.colour_count, 30);
    hd_scene_file_free(&file);
    strcpy(change + length, ",[0,0,0]]");
    expect_refused(rich_text, change,
                   "solids[1].edge_lights.colours has 31 elements, expected 1 to 30 elements");
    expect_refused(rich_text, "floor.corners=[[0,0,0],[1,0,0],[1,1,0]]",
                   "floor.corners has 3 elements, expected 4 elements");
}

TEST(test_unknown_keys) {
    static const char *const objects[] = {
        "image",        "camera",    "camera.eye",    "output", "materials.glass",
        "solids[0]",    "lights[0]", "solids[1].rim", "floor",  "solids[1].edge_lights",
        "floor.texture"};
    for (size_t i = 0; i < sizeof objects / sizeof objects[0]; i++) {
        char change[128], message[256];
        snprintf(change, sizeof change, "%s.quaternion=1", objects[i]);
        snprintf(message, sizeof message, "%s.quaternion is an unknown key, expected \"",
                 objects[i]);
        expect_refused(rich_text, change, message);
    }
    expect_refused(rich_text, "quaternion=1",
                   "quaternion is an unknown key, expected \"$schema\", \"hedron\", ");
    expect_refused(rich_text, "image.widthh=1",
                   "a.json: --set image.widthh=1: image.widthh is an unknown key; did you mean "
                   "\"width\"?");
    expect_refused(rich_text, "output.x=1",
                   "expected \"path\", \"frames_per_second\", \"curve\" or \"bits\"");
    expect_refused("{\"hedron\": 1, \"camera\": {\"eye\": [1, 0, 0]}, \"a\\u001b.b\": 0}", NULL,
                   "[\"a\\u001b.b\"] is an unknown key");
}

TEST(test_missing_keys) {
    const char *message = expect_refused("{}", NULL, "hedron is missing, expected 1");
    expect_contains(message, "camera is missing, expected an object");
    expect_contains(message, "a.json: 2 problems");
    expect_refused(rich_text, "camera={}", "camera.eye is missing, expected three numbers");
    message = expect_refused(rich_text, "solids[0]={}", "solids[0].kind is missing, expected \"te");
    expect_contains(message, "solids[0].material is missing, expected the name of one of");
    message = expect_refused(rich_text, "solids[1].rim={}", "solids[1].rim.width is missing");
    expect_contains(message, "solids[1].rim.material is missing");
    expect_refused(rich_text, "solids[1].edge_lights={}", "edge_lights.per_edge is missing");
    expect_refused(rich_text, "lights[0]={}", "lights[0].position is missing, expected three");
    message = expect_refused(rich_text, "floor={}", "floor.corners is missing");
    expect_contains(message, "floor.material is missing");
    expect_refused(rich_text, "floor.texture={}", "floor.texture.file is missing, expected a");
}

TEST(test_two_falloffs) {
    expect_refused(rich_text, "lights[0].falloff_end=3",
                   "lights[0].falloff_end is given beside \"falloff_distance\", expected only one");
    expect_refused(rich_text, "solids[1].edge_lights.falloff_end=3",
                   "solids[1].edge_lights.falloff_end is given beside \"falloff_distance\"");
}

TEST(test_no_json) {
    expect_refused("", NULL, "a.json is empty, expected a scene in JSON");
    expect_refused("hello", NULL, "a.json:1:");
    expect_refused("{\"hedron\": 1,\n \"hedron\": 1}", NULL, "a.json:2:9: duplicate object key");
    expect_refused("{\"image\": {\"width\": 1, \"width\": 2}}", NULL, "duplicate object key");
    expect_refused("{\"hedron\": 1} x", NULL, "a.json:1:15: end of file expected");
    expect_refused("{\"hedron\": NaN}", NULL, "a.json:1:14: invalid token");
    expect_refused("{\"hedron\": Infinity}", NULL, "a.json:1:19: invalid token");
    expect_refused("{\"hedron\": 1e999}", NULL, "expected a number that a double can hold");
    expect_refused("{\"hedron\": -1e999}", NULL, "a.json:1:17: real number overflow");
    expect_refused("{\"hedron\": 99999999999999999999}", NULL, "hedron is 1e20, expected 1");
    expect_refused("{\"output\": {\"path\": \"a\\u0000b\"}}", NULL,
                   "a string has the character \\u0000, expected text without it");
    expect_refused("{\"output\": {\"path\": \"\xff\"}}", NULL, "unable to decode byte 0xff");
    expect_refused("[]", NULL, "a.json: the scene is an array of 0 elements, expected an object");
}

TEST(test_zero_bytes) {
    static HdError error;
    static const char text[] = "{\n  \"hedron\": 1,\0}";
    assert_int_equal(parse_scene(&file, text, sizeof text - 1, NULL, 0, &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "a.json:2:15: there is a zero byte, expected JSON text");
}

TEST(test_cut_at_every_byte) {
    static HdError error;
    for (size_t size = 0; size < sizeof rich_text - 2; size++) {
        assert_int_equal(parse_scene(&file, rich_text, size, NULL, 0, &error), HD_BAD_INPUT);
        assert_int_equal(strncmp(error.message, "a.json", 6), 0);
        assert_null(file.scene.solids);
    }
}

TEST(test_every_byte_spoiled) {
    static HdError error;
    static const char spoilers[] = {'"', '[', '}', '9', '-', (char)0x80};
    static char text[sizeof rich_text];
    for (size_t i = 0; i + 1 < sizeof rich_text; i++)
        for (size_t k = 0; k < sizeof spoilers; k++) {
            memcpy(text, rich_text, sizeof text);
            text[i] = spoilers[k];
            const HdStatus status = parse_scene(&file, text, sizeof text - 1, NULL, 0, &error);
            assert_true(status == HD_OK || status == HD_BAD_INPUT);
            hd_scene_file_free(&file);
        }
}

TEST(test_deep_nesting) {
    static char text[100000];
    memset(text, '[', sizeof text - 1);
    expect_refused(text, NULL, "there are too many arrays and objects in each other");
    memcpy(text, "{\"image\":", strlen("{\"image\":"));
    expect_refused(text, NULL, "there are too many arrays and objects in each other");
}

static void expect_too_many(const char *key, const char *element, int count, const char *message) {
    const size_t size = (size_t)count * (strlen(element) + 1) + 128;
    char *text = malloc(size);
    assert_non_null(text);
    size_t used = (size_t)snprintf(
        text, size, "{\"hedron\": 1, \"camera\": {\"eye\": [1, 0, 0]}, \"%s\": [%s", key, element);
    for (int i = 1; i < count; i++)
        used += (size_t)snprintf(text + used, size - used, ",%s", element);
    snprintf(text + used, size - used, "]}");
    assert_string_equal(expect_refused(text, NULL, message), message);
    free(text);
}

TEST(test_too_many_elements) {
    expect_too_many("solids", "{}", 100000,
                    "a.json: solids has 100000 elements, expected at most 256 elements");
    expect_too_many("solids", "{}", 257,
                    "a.json: solids has 257 elements, expected at most 256 elements");
    expect_too_many("lights", "7", 100001,
                    "a.json: lights has 100001 elements, expected at most 100000 elements");
}

TEST(test_too_many_materials) {
    static char text[32768];
    size_t used = (size_t)snprintf(text, sizeof text, "materials={\"a\": {}");
    for (int i = 0; i < 1023; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, ",\"m%d\": {}", i);
    snprintf(text + used, sizeof text - used, "}");
    expect_scene(&file, least_text, text);
    hd_scene_file_free(&file);
    snprintf(text + used, sizeof text - used, ",\"b\": {}}");
    expect_refused(least_text, text, "materials has 1025 materials, expected at most 1024");
}

TEST(test_all_problems_at_once) {
    const char *message =
        expect_refused("{\"hedron\": 1, \"image\": {\"width\": 0, \"depth\": []},\n"
                       " \"camera\": {\"frames\": 1.5}, \"colour\": 3,\n"
                       " \"materials\": {\"my glass\": {\"reflection\": 2}},\n"
                       " \"solids\": [{\"kind\": \"cube\", \"material\": 1},\n"
                       "            {\"material\": \"my glass\"}]}",
                       NULL, "a.json: 8 problems\n");
    expect_contains(message, "\n  image.width is 0, expected an integer from 1 to 65535\n");
    expect_contains(message, "\n  image.depth is an array of 0 elements, expected an integer");
    expect_contains(message, "\n  camera.frames is 1.5, expected an integer");
    expect_contains(message, "\n  camera.eye is missing, expected");
    expect_contains(message, "\n  materials[\"my glass\"].reflection is 2, expected a number");
    expect_contains(message, "\n  solids[0].material is 1, expected the name of one of the");
    expect_contains(message, "\n  solids[1].kind is missing, expected");
    expect_contains(message, "\n  colour is an unknown key, expected \"$schema\", \"hedron\", ");
}

TEST(test_checks_of_the_whole_scene) {
    expect_refused(rich_text, "materials.glass.transmission=0.99", "1.03");
    /* They are told along with what is wrong elsewhere. */
    const HdSceneChange changes[] = {"materials.glass.transmission=0.99", "image.width=0"};
    static HdError error;
    assert_int_equal(parse_scene(&file, rich_text, strlen(rich_text), changes, 2, &error),
                     HD_BAD_INPUT);
    expect_contains(error.message, "1.03");
    expect_contains(error.message, "image.width is 0");
    expect_contains(error.message, "2 problems");
}

/* The sum of a material's shares is told once, with the material's name, however many wear it. */
TEST(test_shares_of_a_material) {
    static const char text[] =
        "{\"hedron\": 1, \"camera\": {\"eye\": [9, 0, 0]},\n"
        " \"materials\": {\"blue glass\": {\"reflection\": 0.5}, \"m\": {\"reflection\": 0.5}},\n"
        " \"solids\": [{\"kind\": \"cube\", \"material\": \"m\"},\n"
        "            {\"kind\": \"cube\", \"material\": \"m\"}]}";
    assert_string_equal(
        expect_refused(text, "materials.m.transmission=0.75", ""),
        "a.json: materials.m: reflection + transmission is 1.25, expected at most 1");
    assert_string_equal(
        expect_refused(text, "materials.blue glass.inner_transmission=0.75", ""),
        "a.json: materials[\"blue glass\"]: inner reflection + transmission is 1.25, expected at "
        "most 1");
    assert_string_equal(
        expect_refused(rich_text, "materials.glass.transmission=0.99", ""),
        "a.json: materials.glass: reflection + transmission is 1.03, expected at most 1");
}

/* A default that stands in for a wrong value makes nothing else look wrong. */
TEST(test_one_problem_stays_one) {
    static const char *const changes[] = {
        "camera.eye=3",
        "camera={}",
        "camera.target=[0,0]",
        "solids[1].circumradius=-1",
        "solids[1].centre=[1,2]",
        "solids[2].centre=7",
        "solids[1].kind=ball",
        "floor.corners=[[0,0,0],[0,0,0],[0,0,0],[0,0,null]]",
        "materials=3",
        "solids[1].rim.width=-1",
        "solids[1]={\"kind\": \"cube\", \"circumradius\": -1, \"material\": \"dark\", \"rim\": "
        "{\"width\": 50, \"material\": \"dark\"}}",
        "solids[1]={\"kind\": \"cube\", \"circumradius\": 5, \"material\": \"dark\", \"centre\": "
        "1}",
    };
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        const char *message = expect_refused(rich_text, changes[i], "a.json: --set ");
        assert_null(strchr(message, '\n'));
    }
}

TEST(test_changes) {
    static HdError error;
    const HdSceneChange changes[] = {
        "image.width=100",       "solids[1].circumradius=3.5",
        "camera.eye=[1,2,3]",    "output.curve=linear",
        "image.width=200",       "floor.texture.file=a=b.png",
        "output.path=\"7.png\"", "materials.glass.colour[1]=0",
        "camera.eye[2]=4",
    };
    assert_int_equal(parse_scene(&file, rich_text, strlen(rich_text), changes, 9, &error), HD_OK);
    assert_int_equal(file.scene.width, 200);
    expect_near(file.scene.solids[1].circumradius, 3.5, 0.0);
    expect_vector(file.scene.eye.point, 1.0, 2.0, 4.0);
    assert_int_equal(file.output.style.picture.curve, HD_CURVE_LINEAR);
    assert_string_equal(file.texture_path, "a=b.png");
    assert_string_equal(file.output.path, "7.png");
    expect_near(file.scene.solids[0].face.colour.y, 0.0, 0.0);
    hd_scene_file_free(&file);
    expect_scene(&file, least_text, "image.width=77");
    assert_int_equal(file.scene.width, 77);
    hd_scene_file_free(&file);
    expect_scene(&file, least_text, "output.path=x.png");
    assert_string_equal(file.output.path, "x.png");
    hd_scene_file_free(&file);
}

/* Messages spell a key in their own way, and name the change all the same. */
TEST(test_changes_of_keys_with_quotes) {
    static const char text[] = "{\"hedron\": 1, \"camera\": {\"eye\": [9, 0, 0]},\n"
                               " \"materials\": {\"blue glass\": {}, \"blue\": {}}}";
    static const char expected[] = "expected a number from 0 to 1";
    char message[256];
    snprintf(message, sizeof message,
             "a.json: --set materials.blue glass.reflection=2: "
             "materials[\"blue glass\"].reflection is 2, %s",
             expected);
    assert_string_equal(expect_refused(text, "materials.blue glass.reflection=2", ""), message);
    static HdError error;
    const HdSceneChange changes[] = {"materials.blue glass={\"reflection\": 2}",
                                     "materials.blue={\"diffuse\": 1}"};
    assert_int_equal(parse_scene(&file, text, strlen(text), changes, 2, &error), HD_BAD_INPUT);
    snprintf(message, sizeof message,
             "a.json: --set materials.blue glass={\"reflection\": 2}: "
             "materials[\"blue glass\"].reflection is 2, %s",
             expected);
    assert_string_equal(error.message, message);
}

TEST(test_changes_that_cannot_be_made) {
    expect_refused(rich_text, "camera.target.r0=3",
                   "a.json: --set camera.target.r0=3: camera.target is an array of 3 elements, "
                   "expected an object");
    expect_refused(rich_text, "solids[3].kind=cube",
                   "--set solids[3].kind=cube: solids is an array of 3 elements, expected an array "
                   "with an element 3");
    expect_refused(rich_text, "image[0]=1", "image is an object, expected an array with an");
    expect_refused(rich_text, "solids.kind=1", "solids is an array of 3 elements, expected an obj");
    expect_refused(least_text, "floor.material=a", "floor is missing, expected it in the scene");
    expect_refused(least_text, "solids[0].kind=cube", "solids is missing");
    expect_refused(rich_text, "lights[0].texture.file=1", "lights[0].texture is missing");
    expect_refused(rich_text, "output.path=\xff", "the value is not UTF-8");
    expect_refused("[]", "image.width=3", "the scene is an array of 0 elements, expected an obj");
}

TEST(test_changes_that_are_not_understood) {
    static const char *const changes[] = {"=",
                                          "=3",
                                          ".image=3",
                                          "image.=3",
                                          "image..width=3",
                                          "solids[=3",
                                          "solids[]=3",
                                          "solids[x]=3",
                                          "solids[0=3",
                                          "solids[-1]=3",
                                          "solids[01]=3",
                                          "solids[0]x=3",
                                          "solids[9999999999]=3",
                                          "[0]=3",
                                          "solids[0].=3"};
    expect_refused(rich_text, "image", "a.json: --set image: there is no sign =, expected PATH");
    expect_refused(rich_text, "", "there is no sign =, expected PATH=VALUE");
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        char message[128];
        snprintf(message, sizeof message, "a.json: --set %s: the path is not understood",
                 changes[i]);
        expect_refused(rich_text, changes[i], message);
    }
}

TEST(test_files) {
    static HdError error;
    assert_int_equal(hd_scene_file_read(&file, "missing.json", &plain, &error), HD_BAD_INPUT);
    expect_contains(error.message, "cannot read the scene missing.json: ");
    assert_int_equal(hd_scene_file_read(&file, "/", &plain, &error), HD_BAD_INPUT);
    expect_contains(error.message, "cannot read the scene /: it is not a regular file");
    write_bytes("empty.json", "", 0);
    assert_int_equal(hd_scene_file_read(&file, "empty.json", &plain, &error), HD_BAD_INPUT);
    expect_contains(error.message, "empty.json is empty");
    assert_int_equal(mkfifo("pipe", 0600), 0);
    assert_int_equal(hd_scene_file_read(&file, "pipe", &plain, &error), HD_BAD_INPUT);
    expect_contains(error.message, "it is not a regular file");
    write_bytes("huge.json", "{", 1);
    assert_int_equal(truncate("huge.json", (off_t)HD_MAX_SCENE_BYTES + 1), 0);
    assert_int_equal(hd_scene_file_read(&file, "huge.json", &plain, &error), HD_BAD_INPUT);
    expect_contains(error.message, "it has 33554433 bytes, expected at most 33554432");
}

static void expect_texture(const char *path, const char *change, const char *expected) {
    static HdError error;
    const HdSceneSource source = {.changes = &change, .change_count = change != NULL};
    assert_int_equal(hd_scene_file_read(&file, path, &source, &error), HD_OK);
    assert_string_equal(file.texture_path, expected);
    hd_scene_file_free(&file);
}

TEST(test_textures_count_from_the_folder) {
    static HdError error;
    assert_int_equal(mkdir("folder", 0700), 0);
    write_bytes("a.json", rich_text, strlen(rich_text));
    write_bytes("folder/a.json", rich_text, strlen(rich_text));
    expect_texture("a.json", NULL, "floor.png");
    expect_texture("folder/a.json", NULL, "folder/floor.png");
    expect_texture("./folder//a.json", NULL, "./folder//floor.png");
    expect_texture("folder/a.json", "floor.texture.file=/b.png", "/b.png");
    expect_texture("folder/a.json", "floor.texture.file=~/b.png", "~/b.png");
    expect_texture("folder/a.json", "floor.texture.file=~", "~");
    expect_texture("folder/a.json", "floor.texture.file=~b/c.png", "folder/~b/c.png");
    expect_texture("folder/a.json", "floor.texture.file=builtin:floor", "builtin:floor");
    static char change[HD_MAX_PATH + 64] = "floor.texture.file=";
    memset(change + strlen(change), 'x', HD_MAX_PATH - 1);
    expect_refused(rich_text, "floor.texture.file=", "expected a string that is not empty");
    expect_scene(&file, rich_text, change);
    hd_scene_file_free(&file);
    const char *changed = change;
    const HdSceneSource source = {.changes = &changed, .change_count = 1};
    assert_int_equal(hd_scene_file_read(&file, "folder/a.json", &source, &error), HD_BAD_INPUT);
    expect_contains(error.message, "floor.texture.file has 4102 bytes with the scene's folder");
    strcat(change, "x");
    expect_refused(rich_text, change, "floor.texture.file has 4096 bytes, expected fewer than");
}

/* The reader passes the curve on: middle grey on it is darker in linear light. */
TEST(test_curve_of_the_texture) {
    static const unsigned char grey[12] = {1, 0, 0, 0, 1, 0, 0, 0, 128, 128, 128, 255};
    static HdError error;
    write_bytes("grey.data", grey, sizeof grey);
    expect_scene(&file, rich_text, "floor.texture={\"file\": \"grey.data\"}");
    assert_int_equal(hd_scene_file_load_texture(&file, &error), HD_OK);
    assert_in_range(file.scene.floor.texture.texels[0], 14100, 14200);
    hd_scene_file_free(&file);
    expect_scene(&file, rich_text, "floor.texture.file=grey.data");
    assert_int_equal(hd_scene_file_load_texture(&file, &error), HD_OK);
    assert_int_equal(file.scene.floor.texture.texels[0], 128 * 257);
    hd_scene_file_free(&file);
}

TEST(test_texture_is_loaded) {
    static HdError error;
    expect_scene(&file, rich_text, "floor.texture.file=builtin:floor");
    assert_int_equal(hd_scene_file_load_texture(&file, &error), HD_OK);
    assert_true(file.scene.floor.texture.width > 0);
    hd_scene_file_free(&file);
    expect_scene(&file, least_text, NULL);
    assert_int_equal(hd_scene_file_load_texture(&file, &error), HD_OK);
    assert_int_equal(file.scene.floor.texture.width, 0);
    hd_scene_file_free(&file);
    expect_scene(&file, rich_text, "floor.texture.file=missing.png");
    assert_int_equal(hd_scene_file_load_texture(&file, &error), HD_BAD_INPUT);
    expect_contains(error.message, "missing.png");
    hd_scene_file_free(&file);
}

TEST(test_relative_textures) {
    static const char *const relative[] = {"a", "a/b", "./a", "~a", "~a/b", "a~/b"};
    static const char *const others[] = {"", "/a", "~", "~/a", HD_BUILTIN_TEXTURE};
    for (size_t i = 0; i < sizeof relative / sizeof *relative; i++)
        assert_true(hd_texture_path_is_relative(relative[i]));
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_false(hd_texture_path_is_relative(others[i]));
}
