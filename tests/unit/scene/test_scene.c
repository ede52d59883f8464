/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "input/check.h"
#include "scene/scene.h"
#include "unit_test.h"

/* A valid scene; each test spoils one value of it. */
typedef struct Fixture {
    HdScene scene;
    HdSolid solids[2];
    HdLight lights[2];
} Fixture;

static HdMaterial good_material(void) {
    return (HdMaterial){.colour = {0.2, 0.5, 1.0},
                        .mirror_tint = {1.0, 1.0, 1.0},
                        .diffuse = 0.5,
                        .specular = 0.3,
                        .shininess = 64,
                        .reflection = 0.7,
                        .transmission = 0.3,
                        .index_of_refraction = 1.0};
}

static HdMaterial opaque_material(void) {
    HdMaterial material = good_material();
    material.transmission = 0.0;
    return material;
}

static HdSolid good_solid(HdSolidKind kind) {
    return (HdSolid){.kind = kind,
                     .centre = {1.0, 2.0, 3.0},
                     .circumradius = 2.0,
                     .face = good_material(),
                     .rim_width = 0.08,
                     .rim = opaque_material(),
                     .lights = {.per_edge = 3,
                                .colour_count = 1,
                                .colours = {{1.0, 0.5, 0.25}},
                                .intensity = 0.1,
                                .falloff = {.distance = 2.0},
                                .disc_radius = 0.04,
                                .disc_radiance = 4.0}};
}

static void make(Fixture *f) {
    *f = (Fixture){.solids = {good_solid(HD_HEXAHEDRON), good_solid(HD_ICOSAHEDRON)},
                   .lights = {{.position = {0.0, 0.0, 9.0}, .intensity = {1.0, 1.0, 1.0}},
                              {.position = {1.0, 0.0, 9.0}, .intensity = {2.0, 0.0, 0.0}}}};
    f->scene = (HdScene){
        .frame_count = 100,
        .eye = {.cylinder = {.r0 = 7.0}},
        .target = {.cylinder = {.r0 = 1.0}},
        .field_of_view_degrees = 90.0,
        .width = 640,
        .height = 480,
        .samples_per_side = 4,
        .depth = 6,
        .exposure = 1.0,
        .solid_count = 2,
        .light_count = 2,
        .floor = {
            .present = true,
            .corners = {{-5.0, -5.0, -1.0}, {-5.0, 5.0, -1.0}, {5.0, 5.0, -1.0}, {5.0, -5.0, -1.0}},
            .material = good_material()}};
    f->scene.solids = f->solids;
    f->scene.lights = f->lights;
}

static void expect_accepted(const Fixture *f) {
    static HdError error;
    if (hd_scene_validate(&f->scene, &error) != HD_OK)
        fail_msg("%s", error.message);
}

static void expect_rejected(const Fixture *f, const char *message) {
    static HdError error;
    error.message[0] = '\0';
    const HdStatus status = hd_scene_validate(&f->scene, &error);
    expect_contains(error.message, message);
    assert_int_equal(status, HD_BAD_INPUT);
    assert_int_equal(error.status, HD_BAD_INPUT);
}

#define ACCEPTED(change)                                                                           \
    do {                                                                                           \
        Fixture f;                                                                                 \
        make(&f);                                                                                  \
        change;                                                                                    \
        expect_accepted(&f);                                                                       \
    } while (0)

#define REJECTED(change, message)                                                                  \
    do {                                                                                           \
        Fixture f;                                                                                 \
        make(&f);                                                                                  \
        change;                                                                                    \
        expect_rejected(&f, message);                                                              \
    } while (0)

/* All that is found, a line for each. */
static void expect_problems(const Fixture *f, HdNaming naming, const char *lines) {
    static HdProblems problems;
    problems = (HdProblems){0};
    hd_scene_check(&f->scene, naming, &problems);
    assert_string_equal(problems.text, lines);
    int count = 0;
    for (const char *at = lines; *at != '\0'; at++)
        count += *at == '\n';
    assert_int_equal(problems.count, count);
}

#define PROBLEMS(change, naming, lines)                                                            \
    do {                                                                                           \
        Fixture f;                                                                                 \
        make(&f);                                                                                  \
        change;                                                                                    \
        expect_problems(&f, naming, lines);                                                        \
    } while (0)

#define IN_PROSE(change, lines) PROBLEMS(change, HD_NAMING_PROSE, lines)
#define IN_JSON(change, lines)  PROBLEMS(change, HD_NAMING_JSON, lines)

static const double not_a_number = (double)NAN;
static const double infinite = (double)INFINITY;

static void place_mesh(Fixture *f) {
    static HdMesh mesh = {.lower = {-1.0, -2.0, 0.0}, .upper = {1.0, 3.0, 0.0}};
    static HdInstance instance;
    instance = (HdInstance){.scale = {1.0, 1.0, 1.0}};
    f->scene.meshes = &mesh;
    f->scene.instances = &instance;
    f->scene.mesh_count = f->scene.instance_count = 1;
}

#define PLACED_WRONG(change, message) REJECTED((place_mesh(&f), change), "mesh 1: " message)

TEST(test_instances) {
    ACCEPTED(place_mesh(&f));
    PLACED_WRONG(f.scene.instances->mesh = 1, "number of its mesh is 1, expected 0 to 0");
    PLACED_WRONG(f.scene.instances->mesh = -1, "number of its mesh is -1, expected 0 to 0");
    PLACED_WRONG(f.scene.instances->position.y = 2e12, "position y is 2000000000000, expected");
    PLACED_WRONG(f.scene.instances->position.x = not_a_number, "position x is nan, expected");
    PLACED_WRONG(f.scene.instances->rotation_degrees.z = -2e6, "rotation z is -2000000, expected");
    PLACED_WRONG(f.scene.instances->scale.x = 0.0, "scale x is 0, expected a number from 1e-12");
    PLACED_WRONG(f.scene.instances->scale.z = infinite, "scale z is inf, expected a number from");
    PLACED_WRONG(f.scene.instances->scale.y = 1e12, "longest side of its mesh, scaled, is "
                                                    "5000000000000, expected");
    ACCEPTED((place_mesh(&f), f.scene.instances->material.reflection = 2.0));
    PLACED_WRONG((f.scene.instances->has_material = true,
                  f.scene.instances->material = good_material(),
                  f.scene.instances->material.reflection = 0.9),
                 "reflection + transmission is 1.2, expected at most 1");
    PLACED_WRONG((f.scene.instances->has_material = true,
                  f.scene.instances->material = good_material(),
                  f.scene.instances->material.index_of_refraction = 11.0),
                 "index of refraction is 11, expected a number from 0.1 to 10");
    REJECTED(f.scene.instance_count = -1, "number of meshes in their places is -1, expected 0 to");
}

TEST(test_a_good_scene) {
    ACCEPTED((void)0);
    ACCEPTED(f.scene.solid_count = 0; f.scene.light_count = 0; f.scene.floor.present = false);
}

TEST(test_picture) {
    REJECTED(f.scene.frame_count = 0, "frame count is 0, expected 1 to 10000000");
    REJECTED(f.scene.frame_count = 10000001, "frame count is 10000001");
    ACCEPTED(f.scene.frame_count = 10000000);
    REJECTED(f.scene.width = 0, "width is 0, expected 1 to 65535");
    REJECTED(f.scene.width = 65536, "width is 65536");
    REJECTED(f.scene.height = -1, "height is -1, expected 1 to 65535");
    REJECTED(f.scene.height = 65536, "height is 65536");
    ACCEPTED(f.scene.width = 65535; f.scene.height = 8192; f.scene.samples_per_side = 64);
    REJECTED(f.scene.width = 65535;
             f.scene.height = 8193, "65535 x 8193 pixels are too many, expected at most 536870912");
    REJECTED(f.scene.samples_per_side = 0, "samples per side is 0, expected 1 to 64");
    REJECTED(f.scene.samples_per_side = 65, "samples per side is 65");
    REJECTED(f.scene.depth = -1, "depth is -1, expected 0 to 1000");
    REJECTED(f.scene.depth = 1001, "depth is 1001");
    ACCEPTED(f.scene.depth = 0);
    ACCEPTED(f.scene.depth = 1000);
}

TEST(test_view_cutoff_exposure_background) {
    REJECTED(f.scene.field_of_view_degrees = 0.0, "field of view is 0, expected more than 0");
    REJECTED(f.scene.field_of_view_degrees = 179.5, "field of view is 179.5");
    REJECTED(f.scene.field_of_view_degrees = not_a_number, "field of view is nan");
    ACCEPTED(f.scene.field_of_view_degrees = 179.0);
    REJECTED(f.scene.cutoff = -0.1, "cutoff is -0.1, expected at least 0");
    REJECTED(f.scene.cutoff = 1.0, "cutoff is 1, expected at least 0 and less than 1");
    REJECTED(f.scene.cutoff = not_a_number, "cutoff is");
    ACCEPTED(f.scene.cutoff = 0.999);
    REJECTED(f.scene.exposure = 0.0, "exposure is 0, expected more than 0");
    REJECTED(f.scene.exposure = 1000001.0, "exposure is 1000001");
    REJECTED(f.scene.exposure = not_a_number, "exposure is");
    REJECTED(f.scene.exposure = infinite, "exposure is inf");
    ACCEPTED(f.scene.exposure = 1e6);
    REJECTED(f.scene.background.y = -1.0, "background's green is -1");
    REJECTED(f.scene.background.z = infinite, "background's blue is inf");
}

TEST(test_paths) {
    REJECTED(f.scene.eye.cylinder.r0 = not_a_number, "eye: r0 is nan");
    REJECTED(f.scene.eye.cylinder.z0 = infinite, "eye: z0 is inf");
    REJECTED(f.scene.eye.cylinder.phi0 = -infinite, "eye: phi0 is -inf");
    REJECTED(f.scene.eye.cylinder.r_amplitude = 1e13, "eye: r amplitude is 10000000000000");
    REJECTED(f.scene.eye.cylinder.z_amplitude = infinite, "eye: z amplitude is inf");
    REJECTED(f.scene.target.cylinder.r_frequency = infinite, "target: r frequency is inf");
    REJECTED(f.scene.target.cylinder.z_frequency = infinite, "target: z frequency is inf");
    REJECTED(f.scene.target.cylinder.phi_frequency = infinite, "target: phi frequency is inf");
    REJECTED(f.scene.target.cylinder.r_phase = infinite, "target: r phase is inf");
    REJECTED(f.scene.target.cylinder.z_phase = infinite, "target: z phase is inf");
}

TEST(test_materials) {
    REJECTED(f.solids[1].face.colour.x = 1.5,
             "solid 2: colour's red is 1.5, expected a number from 0 to 1");
    REJECTED(f.solids[0].face.colour.y = -0.5, "solid 1: colour's green is -0.5");
    REJECTED(f.solids[0].face.colour.z = not_a_number, "solid 1: colour's blue is nan");
    REJECTED(f.solids[0].face.mirror_tint.y = 2.0, "solid 1: mirror tint's green is 2");
    REJECTED(f.solids[0].face.ambient = -1.0, "solid 1: ambient is -1");
    REJECTED(f.solids[0].face.diffuse = infinite, "solid 1: diffuse is inf");
    REJECTED(f.solids[0].face.specular = -0.1, "solid 1: specular is -0.1");
    REJECTED(f.solids[0].face.shininess = 0, "solid 1: shininess is 0, expected 1 to 65536");
    REJECTED(f.solids[0].face.shininess = 65537, "solid 1: shininess is 65537");
    ACCEPTED(f.solids[0].face.shininess = 65536);
    REJECTED(f.solids[0].face.reflection = -0.1, "solid 1: reflection is -0.1");
    REJECTED(f.solids[0].face.transmission = 1.1, "solid 1: transmission is 1.1");
    REJECTED(f.scene.floor.material.diffuse = -1.0, "floor: diffuse is -1");
    REJECTED(f.solids[0].rim.shininess = 0, "solid 1: rim shininess is 0");
    ACCEPTED(f.solids[0].rim.shininess = 0; f.solids[0].rim_width = 0.0);
}

TEST(test_reflection_and_transmission) {
    REJECTED(f.solids[1].face.transmission = 0.6,
             "solid 2: reflection + transmission is 1.3, expected at most 1");
    REJECTED(f.scene.floor.material.reflection = 0.8, "floor: reflection + transmission is 1.1");
    REJECTED(f.solids[0].face.reflection = 0.7000001, "solid 1: reflection + transmission is 1.0");
    for (int tenths = 0; tenths <= 100; tenths++) {
        Fixture f;
        make(&f);
        f.solids[0].face.reflection = tenths * 0.01;
        f.solids[0].face.transmission = (100 - tenths) * 0.01;
        expect_accepted(&f);
    }
    /* Decimal numbers whose sum in double is just above 1. */
    ACCEPTED(f.solids[0].face.reflection = 0.7 + 1e-10);
}

TEST(test_solids) {
    REJECTED(f.scene.solid_count = -1, "number of solids is -1, expected 0 to 256");
    REJECTED(f.scene.solid_count = 257, "number of solids is 257");
    REJECTED(f.solids[1].kind = HD_SOLID_KIND_COUNT, "solid 2: kind is 5, expected 0 to 4");
    REJECTED(f.solids[0].centre.z = infinite, "solid 1: centre z is inf");
    REJECTED(f.solids[0].circumradius = 0.0, "solid 1: radius is 0");
    REJECTED(f.solids[0].circumradius = -1.0, "solid 1: radius is -1");
    REJECTED(f.solids[0].circumradius = infinite, "solid 1: radius is inf");
}

TEST(test_rim) {
    /* The cube's face is a square with the side 2 R / sqrt(3). */
    const double cube = 2.0 / sqrt(3.0);
    REJECTED(f.solids[0].rim_width = -0.1, "solid 1: rim width is -0.1");
    REJECTED(f.solids[0].rim_width = not_a_number, "solid 1: rim width is nan");
    REJECTED(f.solids[0].rim_width = cube + 1e-9, "solid 1: rim width is 1.1547");
    ACCEPTED(f.solids[0].rim_width = cube - 1e-9);
    REJECTED(f.solids[0].rim.transmission = 0.2, "solid 1: rim transmission is 0.2");
    ACCEPTED(f.solids[0].rim.transmission = 0.2; f.solids[0].rim_width = 0.0);
    /* The icosahedron's is a triangle with the side R / 0.95105651629515. */
    const double triangle = 2.0 / 0.95105651629515357 / sqrt(12.0);
    REJECTED(f.solids[1].rim_width = triangle + 1e-9, "solid 2: rim width is 0.607");
    ACCEPTED(f.solids[1].rim_width = triangle - 1e-9);
}

TEST(test_edge_lights) {
    REJECTED(f.solids[0].lights.per_edge = -1, "solid 1: number of lights per edge is -1");
    REJECTED(f.solids[0].lights.intensity = -1.0, "solid 1: edge lights' intensity is -1");
    REJECTED(f.solids[0].lights.falloff.distance = -1.0, "solid 1: falloff distance is -1");
    ACCEPTED(f.solids[0].lights.falloff.distance = 0.0);
    REJECTED(f.solids[0].lights.falloff.distance = not_a_number, "falloff distance is nan");
    REJECTED(f.solids[0].lights.disc_radius = -0.1, "solid 1: edge lights' disc radius is -0.1");
    REJECTED(f.solids[0].lights.disc_radiance = not_a_number,
             "solid 1: edge lights' disc radiance is nan");
}

TEST(test_lights) {
    REJECTED(f.scene.light_count = -1, "number of lights is -1");
    REJECTED(f.scene.light_count = 100001, "number of lights is 100001");
    REJECTED(f.lights[1].position.x = infinite, "light 2: position x is inf");
    REJECTED(f.lights[1].intensity.y = -1.0, "light 2: intensity's green is -1");
    REJECTED(f.lights[0].falloff.distance = -1.0, "light 1: falloff distance is -1");
}

TEST(test_all_lights_together) {
    /* 12 and 30 edges, 2 other lights: 12 * 8331 + 30 * 0 + 2 = 99974. */
    ACCEPTED(f.solids[0].lights.per_edge = 8331; f.solids[1].lights.per_edge = 0);
    REJECTED(f.solids[0].lights.per_edge = 8331;
             f.solids[1].lights.per_edge = 1, "is 100004, expected at most 100000");
    /* Each of the two alone has too many. */
    IN_PROSE(
        f.solids[0].lights.per_edge = 8334;
        f.solids[1].lights.per_edge = 100000,
        "solid 1: number of lights per edge is 8334, which makes 100008 lights on its 12 edges, "
        "expected at most 100000 lights in the scene\n"
        "solid 2: number of lights per edge is 100000, which makes 3000000 lights on its 30 "
        "edges, expected at most 100000 lights in the scene\n");
}

static void set_corner(Fixture *f, int i, double x, double y, double z) {
    f->scene.floor.corners[i] = hd_vec3(x, y, z);
}

TEST(test_floor) {
    REJECTED(set_corner(&f, 2, 5.0, infinite, -1.0), "floor: corner 3 y is inf");
    /* The diagonal is 14.1: 1e-5 of it is 1.4e-4. */
    ACCEPTED(set_corner(&f, 2, 5.0, 5.0, -1.0002));
    REJECTED(set_corner(&f, 2, 5.0, 5.0, -1.0004), "expected four corners in one plane");
    REJECTED(set_corner(&f, 2, 5.0, 5.0, 3.0), "expected four corners in one plane");
    REJECTED(set_corner(&f, 2, -4.0, -4.0, -1.0), "is not a convex corner");
    /* Three corners on a line: a triangle. */
    REJECTED(set_corner(&f, 2, 0.0, 0.0, -1.0), "floor: corner 3 is not a convex corner");
    REJECTED(set_corner(&f, 1, -5.0, -5.0, -1.0), "not a convex corner");
    REJECTED(set_corner(&f, 1, 5.0, 5.0, -1.0);
             set_corner(&f, 2, -5.0, 5.0, -1.0),
             "floor: its corners enclose no area or its sides cross");
    REJECTED(for (int i = 0; i < 4; i++) set_corner(&f, i, i, 2.0 * i, -1.0),
             "floor: its corners enclose no area");
    REJECTED(for (int i = 0; i < 4; i++) set_corner(&f, i, 1.0, 1.0, 1.0),
             "floor: its corners enclose no area");
    ACCEPTED(for (int i = 0; i < 4; i++) set_corner(&f, i, 0.0, 0.0, 0.0);
             f.scene.floor.present = false);
}

/* Crossed sides of unequal length leave an area, but no convex corner. */
TEST(test_crossed_floor) {
    REJECTED(set_corner(&f, 1, 9.0, 5.0, -1.0);
             set_corner(&f, 2, -5.0, 5.0, -1.0), "is not a convex corner");
}

TEST(test_floor_both_ways_round_and_at_all_sizes) {
    for (double size = 1e-9; size < 1e11; size *= 10.0) {
        Fixture f;
        make(&f);
        for (int i = 0; i < 4; i++)
            f.scene.floor.corners[i] = hd_scale(f.scene.floor.corners[i], size);
        expect_accepted(&f);
        const HdVec3 second = f.scene.floor.corners[1];
        f.scene.floor.corners[1] = f.scene.floor.corners[3];
        f.scene.floor.corners[3] = second;
        expect_accepted(&f);
    }
}

TEST(test_texture) {
    ACCEPTED(f.scene.floor.texture.width = 2; f.scene.floor.texture.height = 3);
    REJECTED(f.scene.floor.texture.width = -1, "floor: texture width is -1");
    REJECTED(f.scene.floor.texture.width = 2, "floor: texture height is 0");
    REJECTED(f.scene.floor.texture.width = 65536;
             f.scene.floor.texture.height = 1, "floor: texture width is 65536");
}

TEST(test_fixed_paths) {
    ACCEPTED(f.scene.eye.is_fixed = true; f.scene.eye.point = hd_vec3(-1e12, 1e12, 1e12));
    REJECTED(f.scene.eye.is_fixed = true;
             f.scene.eye.point.x = infinite, "eye: point x is inf, expected a number from -10000");
    REJECTED(f.scene.target.is_fixed = true;
             f.scene.target.point.y = not_a_number, "target: point y is nan");
    REJECTED(f.scene.target.is_fixed = true; f.scene.target.point.z = 1.1e12, "target: point z is");
    /* Only one of the two descriptions counts. */
    ACCEPTED(f.scene.eye.is_fixed = true; f.scene.eye.point.x = 3.0;
             f.scene.eye.cylinder.r0 = not_a_number);
    ACCEPTED(f.scene.eye.point.x = not_a_number);
}

TEST(test_inner_sides) {
    REJECTED(f.scene.floor.material.has_inner_side = true, "floor: its material has an inner side");
    ACCEPTED(f.solids[0].face.has_inner_side = true; f.solids[0].face.inner_reflection = 0.25;
             f.solids[0].face.inner_transmission = 0.75);
    REJECTED(f.solids[0].face.has_inner_side = true;
             f.solids[0].face.inner_reflection = -0.1, "solid 1: inner reflection is -0.1");
    REJECTED(f.solids[0].face.has_inner_side = true;
             f.solids[0].face.inner_transmission = not_a_number,
             "solid 1: inner transmission is nan, expected a number from 0 to 1");
    REJECTED(f.solids[1].face.has_inner_side = true; f.solids[1].face.inner_reflection = 0.5;
             f.solids[1].face.inner_transmission = 0.75,
             "solid 2: inner reflection + transmission is 1.25, expected at most 1");
    REJECTED(f.scene.floor.material.has_inner_side = true;
             f.scene.floor.material.inner_reflection = 2.0, "floor: inner reflection is 2");
    /* Each side is a sum of its own. */
    ACCEPTED(f.solids[0].face.has_inner_side = true; f.solids[0].face.inner_reflection = 1.0);
    ACCEPTED(f.solids[0].face.inner_reflection = not_a_number);
}

TEST(test_refraction) {
    const double good[4] = {0.1, 1.0, 1.5, 10.0};
    for (int i = 0; i < 4; i++)
        ACCEPTED(f.scene.solid_count = 1; f.scene.floor.present = false;
                 f.solids[0].face.index_of_refraction = good[i]);
    REJECTED(f.solids[1].face.index_of_refraction = 0.0,
             "solid 2: index of refraction is 0, expected a number from 0.1 to 10");
    REJECTED(f.solids[0].face.index_of_refraction = 10.5, "solid 1: index of refraction is 10.5");
    REJECTED(f.solids[0].face.index_of_refraction = not_a_number, "index of refraction is nan");
    REJECTED(f.solids[0].rim.index_of_refraction = 1.5,
             "solid 1: rim index of refraction is 1.5, expected 1, since only a solid's faces can "
             "refract");
    ACCEPTED(f.solids[0].rim.index_of_refraction = 1.5; f.solids[0].rim_width = 0.0);
    REJECTED(f.scene.floor.material.index_of_refraction = 1.5,
             "floor: index of refraction is 1.5, expected 1, since only a solid's faces");
    REJECTED(f.scene.floor.material.index_of_refraction = not_a_number,
             "floor: index of refraction is nan");
}

TEST(test_rims_are_opaque_on_both_sides) {
    REJECTED(f.solids[0].rim.has_inner_side = true;
             f.solids[0].rim.inner_transmission = 0.2,
             "solid 1: rim inner transmission is 0.2, expected 0, since rims are opaque");
    ACCEPTED(f.solids[0].rim.has_inner_side = true; f.solids[0].rim.inner_reflection = 0.2);
    ACCEPTED(f.solids[0].rim.inner_transmission = 0.2);
}

TEST(test_falloff) {
    const HdFalloff good[5] = {{0.0, 0.0}, {1e-12, 0.0}, {1e12, 0.0}, {0.0, 1e-12}, {0.0, 1e12}};
    for (int i = 0; i < 5; i++)
        ACCEPTED(f.lights[0].falloff = f.solids[0].lights.falloff = good[i]);
    REJECTED(f.lights[0].falloff.end = -1.0, "light 1: falloff end is -1, expected a number from");
    REJECTED(f.lights[0].falloff.end = 1e-13, "light 1: falloff end is 1e-13");
    REJECTED(f.lights[0].falloff.end = not_a_number, "light 1: falloff end is nan");
    REJECTED(f.lights[0].falloff.end = infinite, "light 1: falloff end is inf");
    REJECTED(f.lights[0].falloff.distance = 1e-13, "light 1: falloff distance is 1e-13");
    REJECTED(f.lights[1].falloff = ((HdFalloff){2.0, 3.0}),
             "light 2: falloff distance is 2 and falloff end is 3, expected one of them");
    REJECTED(f.solids[1].lights.falloff.end = 3.0,
             "solid 2: falloff distance is 2 and falloff end is 3, expected one of them");
}

TEST(test_edge_colours) {
    REJECTED(f.solids[1].lights.colour_count = 0,
             "solid 2: number of edge lights' colours is 0, expected 1 to 30");
    REJECTED(f.solids[1].lights.colour_count = 31, "number of edge lights' colours is 31");
    ACCEPTED(f.solids[1].lights.colour_count = 30);
    REJECTED(f.solids[0].lights.colour_count = 30;
             f.solids[0].lights.colours[29].y = 1.5,
             "solid 1: edge lights' colour 30's green is 1.5, expected a number from 0 to 1");
    REJECTED(f.solids[0].lights.colours[0].z = not_a_number, "edge lights' colour 1's blue is nan");
    ACCEPTED(f.solids[0].lights.colours[1].x = -1.0);
    /* Without lights there is nothing to colour. */
    ACCEPTED(f.solids[0].lights = (HdEdgeLights){0});
    ACCEPTED(f.solids[0].lights.per_edge = 0; f.solids[0].lights.disc_radius = not_a_number);
}

TEST(test_rotation) {
    ACCEPTED(f.solids[0].rotation_degrees = hd_vec3(1e6, -1e6, 0.5));
    REJECTED(f.solids[0].rotation_degrees.x = 1000001.0,
             "solid 1: rotation x is 1000001, expected a number from -1000000 to 1000000");
    REJECTED(f.solids[1].rotation_degrees.y = not_a_number, "solid 2: rotation y is nan");
    REJECTED(f.solids[1].rotation_degrees.z = -infinite, "solid 2: rotation z is -inf");
}

TEST(test_every_problem_is_told) {
    IN_PROSE((void)0, "");
    IN_JSON((void)0, "");
    IN_PROSE(f.scene.width = 0; f.solids[1].circumradius = -1.0; f.solids[1].face.diffuse = -2.0;
             f.solids[0].rim.ambient = -3.0; f.lights[1].intensity.x = -4.0;
             f.scene.floor.material.specular = -5.0;
             f.scene.eye.cylinder.r0 = not_a_number,
             "eye: r0 is nan, expected a number from -1000000000000 to 1000000000000\n"
             "width is 0, expected 1 to 65535\n"
             "light 2: intensity's red is -4, expected a number from 0 to 1000000000000\n"
             "solid 1: rim ambient is -3, expected a number from 0 to 1000000\n"
             "solid 2: radius is -1, expected a number from 1e-12 to 1000000000000\n"
             "solid 2: diffuse is -2, expected a number from 0 to 1000000\n"
             "floor: specular is -5, expected a number from 0 to 1000000\n");
}

TEST(test_names_as_in_json) {
    IN_JSON(f.scene.field_of_view_degrees = 0.0; f.scene.eye.is_fixed = true;
            f.scene.eye.point.z = 2e12; f.scene.target.cylinder.r_phase = 2e12;
            f.lights[0].intensity.y = -1.0; f.solids[0].rim.reflection = -1.0;
            f.solids[1].face.transmission = 0.5;
            set_corner(&f, 3, 2e12, 0.0, 0.0),
            "camera: field of view is 0, expected more than 0 and at most 179 degrees\n"
            "camera.eye: point z is 2000000000000, expected a number from -1000000000000 to "
            "1000000000000\n"
            "camera.target: r phase is 2000000000000, expected a number from -1000000000000 to "
            "1000000000000\n"
            "lights[0]: intensity's green is -1, expected a number from 0 to 1000000000000\n"
            "solids[0].rim: reflection is -1, expected a number from 0 to 1\n"
            "solids[1]: reflection + transmission is 1.2, expected at most 1\n"
            "floor: corner 4 x is 2000000000000, expected a number from -1000000000000 to "
            "1000000000000\n");
}

/* One mistake makes one line, also where other checks need the value. */
TEST(test_no_problem_follows_from_another) {
    IN_PROSE(f.solids[1].kind = HD_SOLID_KIND_COUNT; f.solids[1].face.index_of_refraction = 1.5;
             f.solids[1].rim_width = 100.0, "solid 2: kind is 5, expected 0 to 4\n");
    IN_PROSE(f.solids[1].centre.x = not_a_number;
             f.solids[1].face.index_of_refraction = 1.5,
             "solid 2: centre x is nan, expected a number from -1000000000000 to 1000000000000\n");
    IN_PROSE(f.solids[0].circumradius = not_a_number;
             f.solids[1].face.index_of_refraction = 1.5,
             "solid 1: radius is nan, expected a number from 1e-12 to 1000000000000\n");
    IN_PROSE(f.solids[1].face.reflection = 1.5,
             "solid 2: reflection is 1.5, expected a number from 0 to 1\n");
    IN_PROSE(f.scene.solid_count = 1000, "number of solids is 1000, expected 0 to 256\n");
    IN_PROSE(f.scene.light_count = 1000000, "number of lights is 1000000, expected 0 to 100000\n");
    IN_PROSE(f.solids[0].lights.per_edge = 1000000,
             "solid 1: number of lights per edge is 1000000, expected 0 to 100000\n");
    IN_PROSE(f.solids[0].lights.colour_count = 1000000,
             "solid 1: number of edge lights' colours is 1000000, expected 1 to 30\n");
    IN_PROSE(f.scene.frame_count = 0;
             f.scene.target = f.scene.eye, "frame count is 0, expected 1 to 10000000\n");
    IN_PROSE(f.scene.floor.corners[0].z = infinite; f.scene.solid_count = 1;
             f.solids[0].face.index_of_refraction = 1.5,
             "floor: corner 1 z is inf, expected a number from -1000000000000 to 1000000000000\n");
}

static HdPath standing_at(double x, double y, double z) {
    return (HdPath){.is_fixed = true, .point = hd_vec3(x, y, z)};
}

TEST(test_the_eye_never_at_the_target) {
    IN_PROSE(f.scene.target = f.scene.eye, "frame 0: the eye is at the target (7, 0, 0), expected "
                                           "two different points\n");
    IN_JSON(f.scene.eye = f.scene.target = standing_at(1.0, 2.0, 3.0),
            "camera: frame 0: the eye is at the target (1, 2, 3), expected two different points\n");
    /* Half way round, 100 frames a turn; the first such frame is told. */
    REJECTED(f.scene.eye.cylinder.phi_frequency = 1.0;
             f.scene.target = standing_at(-7.0, 0.0, 0.0), "frame 50: the eye is at the target");
    /* A negative r is the other side of the axis. */
    REJECTED(f.scene.eye.cylinder.phi_frequency = 1.0;
             f.scene.target.cylinder.r0 = -7.0, "frame 50: the eye is at the target");
    /* Only the oscillations let the two meet: at a quarter of the turn, or at three quarters. */
    REJECTED(f.scene.eye.cylinder.r_amplitude = -6.0;
             f.scene.eye.cylinder.r_frequency = 1.0, "frame 25: the eye is at the target");
    REJECTED(f.scene.target = f.scene.eye; f.scene.eye.cylinder.z_amplitude = 4.0;
             f.scene.eye.cylinder.z_frequency = 1.0;
             f.scene.target.cylinder.z0 = -4.0, "frame 75: the eye is at the target");
    ACCEPTED(f.scene.target = f.scene.eye; f.scene.eye.cylinder.z_amplitude = 4.0;
             f.scene.eye.cylinder.z_frequency = 1.0; f.scene.target.cylinder.z0 = -4.1);
}

static void place(HdSolid *solid, HdSolidKind kind, double x, double y, double z) {
    solid->kind = kind;
    solid->centre = hd_vec3(x, y, z);
    solid->circumradius = sqrt(3.0); /* a cube's edges are 2 long */
}

/* Two cubes side by side on the floor, `apart` between their centres. */
static void set_cubes(Fixture *f, double apart, double height) {
    place(&f->solids[0], HD_HEXAHEDRON, 0.0, 0.0, height);
    place(&f->solids[1], HD_HEXAHEDRON, apart, 0.0, height);
}

TEST(test_refracting_solids_overlap_nothing) {
    ACCEPTED(set_cubes(&f, 1.5, -0.5));
    ACCEPTED(set_cubes(&f, 2.0, 0.0); f.solids[0].face.index_of_refraction = 1.5);
    IN_PROSE(set_cubes(&f, 1.5, 0.0);
             f.solids[0].face.index_of_refraction = 1.5,
             "solid 1 (cube): it refracts and overlaps solid 2 (cube), 0.5 deep; move them apart "
             "or give it an index of refraction of 1\n");
    IN_JSON(
        set_cubes(&f, 1.5, 0.0);
        f.solids[1].face.index_of_refraction = 1.5,
        "solids[1] (cube): it refracts and overlaps solids[0] (cube), 0.5 deep; move them apart "
        "or give it index_of_refraction 1\n");
    /* A pair is told once, whether one refracts or both do. */
    IN_PROSE(set_cubes(&f, 1.5, -0.25); f.solids[0].face.index_of_refraction = 1.5;
             f.solids[1].face.index_of_refraction = 0.5,
             "solid 1 (cube): it refracts and overlaps solid 2 (cube), 0.5 deep; move them apart "
             "or give it an index of refraction of 1\n"
             "solid 1 (cube): it refracts and overlaps the floor, 0.25 deep; move them apart or "
             "give it an index of refraction of 1\n"
             "solid 2 (cube): it refracts and overlaps the floor, 0.25 deep; move them apart or "
             "give it an index of refraction of 1\n");
    ACCEPTED(set_cubes(&f, 2.5, -0.25); f.solids[0].face.index_of_refraction = 1.5;
             f.scene.floor.present = false);
    /* The eye may be inside. */
    ACCEPTED(set_cubes(&f, 2.5, 0.0); f.solids[0].face.index_of_refraction = 1.5;
             f.scene.eye = standing_at(0.0, 0.0, 0.0));
    /* Turned, the cube's edges stick out. */
    REJECTED(set_cubes(&f, 2.0, 0.0); f.solids[1].face.index_of_refraction = 1.5;
             f.solids[1].rotation_degrees.z = 45.0,
             "solid 2 (cube): it refracts and overlaps solid 1 (cube), 0.414 deep; move");
}

TEST(test_free_clears) {
    HdScene scene = {.solid_count = 1, .light_count = 1};
    scene.solids = calloc(1, sizeof *scene.solids);
    scene.lights = calloc(1, sizeof *scene.lights);
    scene.floor.texture = (HdTexture){1, 1, calloc(3, sizeof(uint16_t))};
    hd_scene_free(&scene);
    assert_null(scene.solids);
    assert_null(scene.lights);
    assert_null(scene.floor.texture.texels);
    assert_int_equal(scene.solid_count, 0);
    hd_scene_free(&scene);
}

TEST(test_deep_trees) {
    HdScene scene = {.depth = 400, .cutoff = 0.01};
    assert_false(hd_scene_has_deep_trees(&scene)); /* the cut-off ends them */
    scene.cutoff = 0.0;
    assert_true(hd_scene_has_deep_trees(&scene));
    scene.cutoff = 0.01;
    scene.max_error = 1.0;
    assert_true(hd_scene_has_deep_trees(&scene));
    scene.depth = 20;
    assert_false(hd_scene_has_deep_trees(&scene));
    scene.depth = 400;
    hd_scene_drop_survey(&scene);
    assert_false(hd_scene_has_deep_trees(&scene));
}

/* What is wrong in one place, or was before, keeps no other check from being made. */
TEST(test_no_problem_hides_another) {
    static HdProblems problems;
    Fixture f;
    make(&f);
    set_cubes(&f, 1.5, -0.25);
    f.solids[0].face.index_of_refraction = 1.5;
    f.scene.target = f.scene.eye;
    f.scene.width = 0;
    hd_problem(&problems, "an earlier one");
    hd_scene_check(&f.scene, HD_NAMING_JSON, &problems);
    assert_int_equal(problems.count, 5);
    assert_string_equal(
        problems.text,
        "an earlier one\n"
        "width is 0, expected 1 to 65535\n"
        "camera: frame 0: the eye is at the target (7, 0, 0), expected two different points\n"
        "solids[0] (cube): it refracts and overlaps solids[1] (cube), 0.5 deep; move them apart "
        "or give it index_of_refraction 1\n"
        "solids[0] (cube): it refracts and overlaps the floor, 0.25 deep; move them apart or give "
        "it index_of_refraction 1\n");
}

TEST(test_counts_of_lights) {
    Fixture fixture;
    HdScene *scene = &fixture.scene;
    make(&fixture);
    scene->solids[0].lights.per_edge = 3;
    scene->solids[1].lights.per_edge = 0;
    const int edges = hd_edge_light_count(&scene->solids[0]);
    assert_true(edges > 0 && edges % 3 == 0);
    assert_int_equal(hd_edge_light_count(&scene->solids[1]), 0);
    assert_int_equal(hd_scene_light_count(scene), scene->light_count + edges);
    for (int i = 0; i < scene->light_count; i++)
        scene->lights[i].falloff.end = 0.5;
    scene->solids[0].lights.falloff.end = 0.0;
    scene->solids[0].lights.intensity = 1.0;
    assert_int_equal(hd_scene_endless_light_count(scene), edges);
    scene->solids[0].lights.intensity = 0.0;
    assert_int_equal(hd_scene_endless_light_count(scene), 0);
    scene->lights[0].falloff.end = 0.0;
    assert_int_equal(hd_scene_endless_light_count(scene), 1);
}

TEST(test_where_and_how_it_is_looked_at) {
    const HdFloor floor = {
        .corners = {{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, 8.0}}};
    const HdVec3 centre = hd_floor_centre(&floor);
    assert_true(centre.x == 1.25 && centre.y == 0.5 && centre.z == 2.0);
    HdScene scene = {.sampling = HD_SAMPLING_GRID};
    assert_false(hd_scene_is_surveyed(&scene));
    scene.max_error = 0.5;
    assert_true(hd_scene_is_surveyed(&scene));
    HdMesh meshes[] = {{.triangle_count = 3}, {.triangle_count = 4}};
    scene.meshes = meshes;
    scene.mesh_count = 2;
    assert_int_equal(hd_scene_triangle_count(&scene), 7);
}
