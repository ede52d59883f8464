/* SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "input/check.h"
#include "scene_text.h"

static const char good_text[] =
    "{\"hedron\": 1, \"camera\": {\"frames\": 100, \"eye\": {\"r0\": 7}, \"target\": {\"r0\": 1}},"
    "\"materials\": {\"glass\": {\"diffuse\": 0.5, \"reflection\": 0.7, \"transmission\": 0.3},"
    "              \"frame\": {\"reflection\": 0.7}},"
    "\"solids\": [{\"kind\": \"cube\", \"centre\": [1, 2, 3], \"circumradius\": 2, \"material\": "
    "\"glass\","
    "             \"rim\": {\"width\": 0.08, \"material\": \"frame\"},"
    "             \"edge_lights\": {\"per_edge\": 3, \"intensity\": 0.1, \"falloff_distance\": "
    "2}}],"
    "\"lights\": [{\"position\": [0, 0, 9]}, {\"position\": [1, 0, 9]}],"
    "\"floor\": {\"corners\": [[-5, -5, -1], [-5, 5, -1], [5, 5, -1], [5, -5, -1]],"
    "          \"material\": \"glass\"}}";

static HdSceneFile good;

/* A copy of it and a second solid, an icosahedron; tests spoil some values. */
static HdScene scene;
static HdSolid solids[3];
static HdLight lights[2];

static int begin(void **state) {
    (void)state;
    expect_scene(&good, good_text, NULL);
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_file_free(&good);
    return 0;
}

GROUP(begin, end)

static void make(void) {
    scene = good.scene;
    scene.solids = solids;
    scene.solid_count = 2;
    solids[0] = solids[1] = good.scene.solids[0];
    solids[1].kind = HD_ICOSAHEDRON;
    scene.lights = memcpy(lights, good.scene.lights, sizeof lights);
}

/* Returns all problems, a line for each. */
static const char *found(HdNaming naming) {
    static HdProblems problems;
    problems = (HdProblems){0};
    HdSceneChecker checker = {.problems = &problems, .naming = naming};
    hd_check_scene(&checker, &scene);
    return problems.text;
}

#define WITH(change, expectation)                                                                  \
    do {                                                                                           \
        make();                                                                                    \
        change;                                                                                    \
        expectation;                                                                               \
    } while (0)

#define REJECTED(change, part)  WITH(change, expect_contains(found(HD_NAMING_PROSE), part))
#define IN_PROSE(change, lines) WITH(change, assert_string_equal(found(HD_NAMING_PROSE), lines))
#define ACCEPTED(change)        IN_PROSE(change, "")
#define ONE_IS(change, begin)   WITH(change, expect_one(begin))

static void expect_one(const char *begin) {
    const char *lines = found(HD_NAMING_PROSE);
    assert_ptr_equal(strstr(lines, begin), lines);
    assert_int_equal(strcspn(lines, "\n") + 1, strlen(lines));
}

static const double not_a_number = (double)NAN;
static const double infinite = (double)INFINITY;

static void place_mesh(HdInstance instance) {
    static HdMesh mesh = {.upper = {1.0, 1.0, 0.0}};
    static HdInstance placed;
    placed = instance;
    placed.scale = hd_vec3(1.0, 1.0, 1.0);
    scene.meshes = &mesh;
    scene.instances = &placed;
    scene.mesh_count = scene.instance_count = 1;
}

TEST(test_instances) {
    const HdMaterial glass = good.scene.floor.material;
    HdInstance instance = {.material = glass};
    instance.material.reflection = 0.9;
    ACCEPTED(place_mesh(instance));
    instance.has_material = true;
    REJECTED(place_mesh(instance), "mesh 1: reflection + transmission is 1.2");
    instance.material = glass;
    instance.material.index_of_refraction = 10.0;
    ACCEPTED(place_mesh(instance));
    instance.mesh = 1;
    REJECTED(place_mesh(instance), "mesh 1: number of its mesh is 1, expected 0 to 0");
    REJECTED(scene.instance_count = -1, "number of meshes in their places is -1, expected 0 to");
}

/* Ranges are those of scene files, whose tests have all ends. This has each kind of value in each
   part of a scene. */
TEST(test_picture_and_view) {
    ACCEPTED(scene.solid_count = 0; scene.light_count = 0; scene.floor.present = false);
    REJECTED(scene.frame_count = 0, "frame count is 0, expected 1 to 10000000");
    ACCEPTED(scene.width = 65535; scene.height = 8192; scene.samples_per_side = 64);
    REJECTED(scene.width = 65535;
             scene.height = 8193, "65535 x 8193 pixels are too many, expected at most 536870912");
    REJECTED(scene.max_error = 1e-9, "max_error is 1e-09, expected 0, or a number from ");
    REJECTED(scene.background.z = infinite, "background's blue is inf");
}

TEST(test_paths) {
    REJECTED(scene.eye.cylinder.r0 = not_a_number, "eye: r0 is nan");
    REJECTED(scene.target.cylinder.phi_frequency = infinite, "target: phi frequency is inf");
    REJECTED(scene.target.is_fixed = true;
             scene.target.point.y = not_a_number, "target: point y is nan");
    /* Only one of the two descriptions counts. */
    ACCEPTED(scene.eye.is_fixed = true; scene.eye.point.x = 3.0; scene.eye.cylinder.r0 = infinite);
}

TEST(test_materials) {
    REJECTED(solids[1].face.colour.x = 1.5, "solid 2: colour's red is 1.5, expected");
    REJECTED(solids[1].face.index_of_refraction = 0.0, "solid 2: index of refraction is 0");
    REJECTED(scene.floor.material.index_of_refraction = not_a_number,
             "floor: index of refraction is nan, expected 1, since only a solid's faces can ref");
    REJECTED(solids[0].rim.index_of_refraction = 1.5, "solid 1: rim index of refraction is 1.5");
    REJECTED(solids[0].rim.transmission = 0.2,
             "solid 1: rim transmission is 0.2, expected 0, since");
    REJECTED(solids[0].rim.has_inner_side = true;
             solids[0].rim.inner_transmission = 0.2,
             "solid 1: rim inner transmission is 0.2, expected 0");
    ACCEPTED(solids[0].rim.has_inner_side = true; solids[0].rim.inner_reflection = 0.2);
    ACCEPTED(solids[0].rim.transmission = 0.2; solids[0].rim.shininess = 0;
             solids[0].rim.index_of_refraction = 1.5; solids[0].rim_width = 0.0);
}

TEST(test_sums_of_each_side) {
    REJECTED(scene.floor.material.reflection = 0.8, "floor: reflection + transmission is 1.1");
    REJECTED(solids[0].face.reflection = 0.7000001, "solid 1: reflection + transmission is 1.0");
    /* The sum of decimal numbers may be just above 1. */
    ACCEPTED(solids[0].face.reflection = 0.7 + 1e-10);
    REJECTED(scene.floor.material.has_inner_side = true, "floor: its material has an inner side");
    REJECTED(solids[1].face.has_inner_side = true; solids[1].face.inner_reflection = 0.5;
             solids[1].face.inner_transmission = 0.75,
             "solid 2: inner reflection + transmission is 1.25, expected at most 1");
    ACCEPTED(solids[0].face.inner_reflection = not_a_number);
}

TEST(test_solids) {
    REJECTED(scene.solid_count = -1, "number of solids is -1, expected 0 to 256");
    REJECTED(solids[0].centre.z = infinite, "solid 1: centre z is inf");
    /* The cube's face is a square with the side 2 R / sqrt(3), the icosahedron's is a triangle with
       the side R / 0.95105651629515. */
    const double cube = 2.0 / sqrt(3.0), triangle = 2.0 / 0.95105651629515357 / sqrt(12.0);
    REJECTED(solids[0].rim_width = -0.1, "solid 1: rim width is -0.1");
    REJECTED(solids[0].rim_width = cube + 1e-9, "solid 1: rim width is 1.1547");
    ACCEPTED(solids[0].rim_width = cube - 1e-9);
    REJECTED(solids[1].rim_width = triangle + 1e-9, "solid 2: rim width is 0.607");
    ACCEPTED(solids[1].rim_width = triangle - 1e-9);
}

TEST(test_lights_and_those_of_edges) {
    REJECTED(lights[1].position.x = infinite, "light 2: position x is inf");
    REJECTED(lights[1].falloff = ((HdFalloff){2.0, 3.0}),
             "light 2: falloff distance is 2 and falloff end is 3, expected one of them");
    ACCEPTED(lights[0].falloff.end = 1e-12; solids[0].lights.falloff.distance = 0.0);
    REJECTED(solids[0].lights.disc_radiance = not_a_number, "edge lights' disc radiance is nan");
    REJECTED(solids[1].lights.falloff.end = 3.0, "solid 2: falloff distance is 2 and falloff");
    REJECTED(solids[1].lights.colour_count = 0, "number of edge lights' colours is 0, expe");
    REJECTED(solids[0].lights.colour_count = 30; solids[0].lights.colours[29].y = 1.5,
                                                 "solid 1: edge lights' colour 30's green is 1.5");
    ACCEPTED(solids[0].lights.colours[1].x = -1.0);
    /* Without lights there is nothing to colour. */
    ACCEPTED(solids[0].lights.per_edge = 0; solids[0].lights.disc_radius = not_a_number);
    make();
    lights[0].falloff.end = 0.5;
    assert_int_equal(hd_scene_light_count(&scene), 2 + 36 + 90);
    assert_int_equal(hd_scene_endless_light_count(&scene), 1 + 36 + 90);
    solids[0].lights.intensity = 0.0;
    assert_int_equal(hd_scene_endless_light_count(&scene), 1 + 90);
    /* 12 and 30 edges, 2 other lights: 12 * 8331 + 30 * 0 + 2 = 99974. */
    ACCEPTED(solids[0].lights.per_edge = 8331; solids[1].lights.per_edge = 0);
    REJECTED(solids[0].lights.per_edge = 8331;
             solids[1].lights.per_edge = 1, "is 100004, expected at most 100000");
    IN_PROSE(
        solids[0].lights.per_edge = 8334,
        "solid 1: number of lights per edge is 8334, which makes 100008 lights on its 12 edges, "
        "expected at most 100000 lights in the scene\n");
}

static void set_corner(int i, double x, double y, double z) {
    scene.floor.corners[i] = hd_vec3(x, y, z);
}

TEST(test_floor) {
    REJECTED(set_corner(2, 5.0, infinite, -1.0), "floor: corner 3 y is inf");
    /* The diagonal is 14.1: 1e-5 of it is 1.4e-4. */
    ACCEPTED(set_corner(2, 5.0, 5.0, -1.0002));
    REJECTED(set_corner(2, 5.0, 5.0, -1.0004), "expected four corners in one plane");
    REJECTED(set_corner(2, 0.0, 0.0, -1.0), "floor: corner 3 is not a convex corner");
    REJECTED(set_corner(1, 5.0, 5.0, -1.0);
             set_corner(2, -5.0, 5.0, -1.0),
             "floor: its corners enclose no area or its sides cross");
    /* Crossed sides of unequal length leave an area, but no convex corner. */
    REJECTED(set_corner(1, 9.0, 5.0, -1.0);
             set_corner(2, -5.0, 5.0, -1.0), "is not a convex corner");
    ACCEPTED(for (int i = 0; i < 4; i++) set_corner(i, 0.0, 0.0, 0.0); scene.floor.present = false);
    ACCEPTED(scene.floor.texture.width = 2; scene.floor.texture.height = 3);
    REJECTED(scene.floor.texture.width = 2, "floor: texture height is 0");
    /* Both ways round, and of all sizes. */
    for (double size = 1e-9; size < 1e11; size *= 1e5)
        for (int turn = 1; turn <= 3; turn += 2)
            ACCEPTED(for (int i = 0; i < 4; i++) scene.floor.corners[i * turn % 4] =
                         hd_scale(good.scene.floor.corners[i], size));
}

/* One mistake gives one line, even if other checks need the value. */
TEST(test_no_problem_follows_from_another) {
    ONE_IS(solids[1].kind = HD_SOLID_KIND_COUNT; solids[1].face.index_of_refraction = 1.5;
           solids[1].rim_width = 100.0, "solid 2: kind is 5, expected 0 to 4\n");
    ONE_IS(solids[0].circumradius = not_a_number;
           solids[1].face.index_of_refraction = 1.5, "solid 1: radius is nan");
    ONE_IS(solids[1].face.reflection = 1.5, "solid 2: reflection is 1.5");
    ONE_IS(solids[0].lights.per_edge = 1000000, "solid 1: number of lights per edge is 1000000");
    ONE_IS(solids[0].lights.colour_count = 1000000,
           "solid 1: number of edge lights' colours is 1000000");
    ONE_IS(scene.frame_count = 0; scene.target = scene.eye, "frame count is 0");
    ONE_IS(scene.floor.corners[0].z = infinite; scene.solid_count = 1;
           solids[0].face.index_of_refraction = 1.5, "floor: corner 1 z is inf");
}

static HdPath standing_at(double x, double y, double z) {
    return (HdPath){.is_fixed = true, .point = hd_vec3(x, y, z)};
}

TEST(test_the_eye_never_at_the_target) {
    IN_PROSE(scene.target = scene.eye, "frame 0: the eye is at the target (7, 0, 0), expected "
                                       "two different points\n");
    /* A negative r is the other side of the axis. */
    REJECTED(scene.eye.cylinder.phi_frequency = 1.0;
             scene.target.cylinder.r0 = -7.0, "frame 50: the eye is at the target");
    /* The heights meet at three quarters of the turn. */
    REJECTED(scene.target = scene.eye; scene.eye.cylinder.z_amplitude = 4.0;
             scene.eye.cylinder.z_frequency = 1.0;
             scene.target.cylinder.z0 = -4.0, "frame 75: the eye is at the target");
    ACCEPTED(scene.target = scene.eye; scene.eye.cylinder.z_amplitude = 4.0;
             scene.eye.cylinder.z_frequency = 1.0; scene.target.cylinder.z0 = -4.1);
}

/* Puts two cubes with edges 2 long side by side on the floor, `apart` between their centres. */
static void set_cubes(double apart, double height) {
    for (int i = 0; i < 2; i++) {
        solids[i].kind = HD_HEXAHEDRON;
        solids[i].centre = hd_vec3(i * apart, 0.0, height);
        solids[i].circumradius = sqrt(3.0);
    }
}

/* In glass also bubbles of index 1 refract. */
static void add_cube_around(double index) {
    scene.solid_count = 3;
    solids[2] = solids[0];
    solids[2].circumradius = 6.0;
    solids[2].face.index_of_refraction = index;
}

TEST(test_refracting_solids_overlap_what_is_opaque_or_within) {
    ACCEPTED(set_cubes(1.5, -0.5));
    ACCEPTED(set_cubes(2.0, 0.0); solids[0].face.index_of_refraction = 1.5);
    IN_PROSE(set_cubes(1.5, 0.0);
             solids[1].face.index_of_refraction = 1.5,
             "solid 2 (cube): it refracts and overlaps solid 1 (cube), 0.5 deep; move them apart, "
             "or one wholly into the other, clear of its faces\n");
    /* One within the other, an opaque one, or the floor may overlap. */
    ACCEPTED(set_cubes(0.0, 0.0); solids[0].circumradius = 1.0;
             solids[0].face.index_of_refraction = solids[1].face.index_of_refraction = 1.5);
    ACCEPTED(set_cubes(1.5, -0.5); solids[1].face.index_of_refraction = 1.5;
             solids[0].face.transmission = solids[0].face.inner_transmission = 0.0);

    /* The eye may be inside. */
    ACCEPTED(set_cubes(2.5, 0.0); solids[0].face.index_of_refraction = 1.5;
             scene.eye = standing_at(0.0, 0.0, 0.0));
    /* Rotated, the cube's edges stick out. */
    REJECTED(set_cubes(2.0, 0.0); solids[1].face.index_of_refraction = 1.5;
             solids[1].rotation_degrees.z = 45.0,
             "solid 2 (cube): it refracts and overlaps solid 1 (cube), 0.414 deep; move");
    REJECTED(set_cubes(1.5, 0.0); add_cube_around(1.5), "solid 1 (cube): it refracts and overlaps");
    ACCEPTED(set_cubes(1.5, 0.0); add_cube_around(1.0));
}

TEST(test_deep_trees) {
    static const struct {
        int depth;
        double cutoff, max_error;
        bool is_deep;
    } rows[] = {{400, 0.01, 0.0, false}, /* the cut-off ends them */
                {400, 0.0, 0.0, true},
                {400, 0.01, 1.0, true},
                {20, 0.01, 1.0, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        scene = (HdScene){
            .depth = rows[i].depth, .cutoff = rows[i].cutoff, .max_error = rows[i].max_error};
        assert_int_equal(hd_scene_has_deep_trees(&scene), rows[i].is_deep);
        assert_int_equal(hd_scene_has_error_bound(&scene), rows[i].max_error > 0.0);
        hd_scene_drop_error_bound(&scene);
        assert_false(hd_scene_has_error_bound(&scene));
        assert_int_equal(hd_scene_has_deep_trees(&scene), rows[i].is_deep && i == 1);
    }
}

/* An error in one place, or an earlier one, suppresses no other check. A pair is reported once,
   even if both refract. */
TEST(test_no_problem_hides_another) {
    static HdProblems problems;
    make();
    set_cubes(1.5, -0.25);
    solids[0].face.index_of_refraction = solids[1].face.index_of_refraction = 1.5;
    scene.eye = scene.target = standing_at(1.0, 2.0, 3.0);
    scene.width = 0;
    lights[0].intensity.y = -1.0;
    solids[0].rim.reflection = -1.0;
    solids[1].face.transmission = 0.5;
    hd_problem(&problems, "an earlier one");
    HdSceneChecker checker = {.problems = &problems, .naming = HD_NAMING_JSON};
    hd_check_scene(&checker, &scene);
    assert_int_equal(problems.count, 7);
    assert_string_equal(
        problems.text,
        "an earlier one\n"
        "width is 0, expected 1 to 65535\n"
        "lights[0]: intensity's green is -1, expected a number from 0 to 1000000000000\n"
        "solids[0].rim: reflection is -1, expected a number from 0 to 1\n"
        "solids[1]: reflection + transmission is 1.2, expected at most 1\n"
        "camera: frame 0: the eye is at the target (1, 2, 3), expected two different points\n"
        "solids[0] (cube): it refracts and overlaps solids[1] (cube), 0.5 deep; move them apart, "
        "or one wholly into the other, clear of its faces\n");
}
