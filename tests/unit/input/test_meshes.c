/* SPDX-License-Identifier: MIT */
/* Meshes of scene files: sharing between entries, their normals and textures, and errors. */
#define _XOPEN_SOURCE 700

#include <math.h>

#include "input/files.h"
#include "scene/placement.h"
#include "scene_text.h"
#include "test_folder.h"

#define SCENE(meshes)                                                                              \
    "{\"hedron\": 1, \"camera\": {\"eye\": [30, 0, 0]},\n"                                         \
    " \"materials\": {\"m\": {\"ambient\": 0.5}}, \"meshes\": [" meshes "]}"

static HdSceneFile file;
static HdProblems problems, notes;
static bool is_strict;
static HdError error;

static void expect_vector(HdVec3 actual, double x, double y, double z) {
    expect_near(actual.x, x, 0.0);
    expect_near(actual.y, y, 0.0);
    expect_near(actual.z, z, 0.0);
}

static void write_text(const char *path, const char *text) {
    write_bytes(path, text, strlen(text));
}

static HdStatus load(const char *text) {
    problems = notes = (HdProblems){.count = 0};
    expect_scene(&file, text, NULL);
    file.is_strict = is_strict;
    return hd_scene_file_load_meshes(&file, &problems, &notes, &error);
}

static void expect_loaded(const char *text) {
    if (load(text) != HD_OK)
        fail_msg("%s", error.message);
    assert_string_equal(problems.text, "");
}

static void expect_problems(const char *text, const char *expected) {
    assert_int_equal(load(text), HD_OK);
    assert_string_equal(problems.text, expected);
    assert_null(file.scene.meshes);
    assert_null(file.scene.instances);
    assert_int_equal(file.scene.mesh_count + file.scene.instance_count, 0);
    hd_scene_file_free(&file);
}

/* Returns the normal at the first corner, which both triangles have. */
static HdVec3 first_normal(const HdMesh *mesh) {
    return hd_normalize(mesh->normals[mesh->corner_normals[0][0]]);
}

/* Two triangles that meet at a right angle, and one without an area. */
static const char corner_text[] = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nvn 0 0 1\n"
                                  "f 1//1 2//1 3//1\nf 1 4 2\nf 1 1 2\n";

TEST(test_entries_share_meshes) {
    write_text("a.obj", corner_text);
    write_text("b.obj", corner_text);
    expect_loaded(
        SCENE("{\"file\": \"b.obj\"}, {\"file\": \"a.obj\", \"position\": [1, 2, 3]},\n"
              "{\"file\": \"b.obj\", \"scale\": 3, \"material\": \"m\"},\n"
              "{\"file\": \"a.obj\", \"normals\": \"smooth\"},\n"
              "{\"file\": \"a.obj\", \"normals\": \"smooth\", \"crease\": 91},\n"
              "{\"file\": \"a.obj\", \"normals\": \"smooth\", \"crease\": 40, \"scale\": 2},\n"
              "{\"file\": \"a.obj\", \"normals\": \"flat\"},\n"
              "{\"file\": \"a.obj\", \"normals\": \"flat\", \"crease\": 3, \"scale\": 2},\n"
              "{\"file\": \"b.obj\", \"material\": \"m\"}"));
    expect_contains(notes.text, "meshes: 1 of them is in the place of an earlier one");
    static const int meshes[] = {0, 1, 0, 2, 3, 2, 4, 4};
    const HdScene *scene = &file.scene;
    assert_int_equal(scene->mesh_count, 5);
    assert_int_equal(scene->instance_count, 8);
    for (int i = 0; i < 8; i++)
        assert_int_equal(scene->instances[i].mesh, meshes[i]);
    expect_vector(scene->instances[1].position, 1.0, 2.0, 3.0);
    expect_vector(scene->instances[2].scale, 3.0, 3.0, 3.0);
    assert_true(scene->instances[2].has_material);
    expect_near(scene->instances[2].material.ambient, 0.5, 0.0);
    assert_int_equal(hd_scene_triangle_count(scene), 10);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(scene->meshes[i].degenerate_count, 1);
        assert_true(scene->meshes[i].tree.node_count > 0);
        expect_vector(scene->meshes[i].upper, 2.0, 2.0, 2.0);
    }
    /* the first one's are those of the file; two creases below and above the corner; none */
    expect_vector(first_normal(&scene->meshes[0]), 0.0, 0.0, 1.0);
    assert_int_equal(scene->meshes[0].corner_normals[1][0], -1);
    expect_near(first_normal(&scene->meshes[2]).z, 1.0, 1e-12);
    expect_near(first_normal(&scene->meshes[3]).z, sqrt(0.5), 1e-12);
    expect_near(first_normal(&scene->meshes[3]).y, sqrt(0.5), 1e-12);
    assert_null(scene->meshes[4].normals);
    assert_null(scene->meshes[4].corner_normals);
    hd_scene_file_free(&file);
    assert_null(file.mesh_entries);
}

TEST(test_every_wrong_file_is_reported) {
    write_text("a.obj", corner_text);
    write_text("bad.obj", "v 0 0 0\nv 1 0 x\nf 1 2 2\n");
    write_text("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    expect_problems(
        SCENE("{\"file\": \"a.obj\"}, {\"file\": \"no.obj\"}, {\"file\": \"bad.obj\"},\n"
              "{\"file\": \"no.obj\"}, {\"file\": \"line.obj\"}"),
        "meshes[1].file: cannot read the mesh no.obj: No such file or directory\n"
        "meshes[2].file: bad.obj: line 2: number 3 of a vertex is 'x', expected a decimal number\n"
        "meshes[4].file: line.obj: none of its 1 triangles has an area\n");
    write_text("small.obj", "v 0 0 0\nv 1e-3 0 0\nv 0 1e-3 0\nf 1 2 3\n");
    write_text("far.obj", "v 1e6 0 0\nv 1000100 0 0\nv 1e6 100 0\nf 1 2 3\n");
    expect_problems(SCENE("{\"file\": \"far.obj\", \"scale\": 1.9e6},"
                          "{\"file\": \"small.obj\", \"scale\": 1e-12},"
                          "{\"file\": \"far.obj\", \"scale\": 3e6}"),
                    "meshes[1]: longest side of its mesh, scaled, is 1.00000004749745e-15, "
                    "expected a number from 5e-13 to 2000000000000\n"
                    "meshes[2]: farthest coordinate of its mesh, scaled, is 3000300000000, "
                    "expected a number from 0 to 2000000000000\n");
}

/* Ka counts only as far as the scene asks. */
TEST(test_ambient_and_strictness) {
    write_text("k.mtl", "newmtl k\nKa 1 1 1\nKd nan\nPr 1\n");
    write_text("k.obj", "mtllib k.mtl\nusemtl k\nf 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf\n");
    expect_loaded(SCENE("{\"file\": \"k.obj\"}, {\"file\": \"k.obj\", \"ambient\": 0.5},"
                        "{\"file\": \"k.obj\", \"ambient\": 0, \"position\": [1, 0, 0]}"));
    for (int i = 0; i < 2; i++)
        expect_near(file.scene.meshes[i].materials[0].material.ambient, 0.5 * i, 0.0);
#define SHORT  "k.obj: line 3: a face has 1 corner, expected at least 3; it is left out (2 times)\n"
#define WRONG  "k.mtl: line 3: Kd has 'nan', expected a decimal number; the line is left out\n"
#define UNUSED "k.mtl: line 4: Pr is not used\n"
    assert_string_equal(notes.text, UNUSED SHORT WRONG UNUSED SHORT WRONG);
    hd_scene_file_free(&file);
    is_strict = true;
    expect_problems(SCENE("{\"file\": \"k.obj\"}"),
                    "meshes[0].file: " SHORT "meshes[0].file: " WRONG);
    assert_string_equal(notes.text, UNUSED);
    is_strict = false;
}

/* The box of the corner is (0, 0, 0) to (2, 2, 2); that of its corners, turned, is smaller. */
TEST(meshes_are_fitted_and_seen) {
    static const struct {
        const char *keys;
        double lower[3], upper[3];
        HdSight sight;
    } cases[] = {
        {"\"position\": [1, 2, 3]", {1, 2, 3}, {3, 4, 5}, HD_SIGHT_WHOLE},
        {"\"up\": \"y\"", {0, -2, 0}, {2, 0, 2}, HD_SIGHT_WHOLE},
        {"\"scale\": [-1, 1, 3]", {-2, 0, 0}, {0, 2, 6}, HD_SIGHT_WHOLE},
        {"\"size\": 1, \"position\": [5, 6, 7]", {4.5, 5.5, 7}, {5.5, 6.5, 8}, HD_SIGHT_WHOLE},
        {"\"size\": 6, \"up\": \"y\", \"scale\": [2, -1, 1], \"position\": [0, 0, -9]",
         {-3, -1.5, -9},
         {3, 1.5, -6},
         HD_SIGHT_WHOLE},
        {"\"size\": 2, \"rotation\": [0, 180, 0]", {-1, -1, 0}, {1, 1, 2}, HD_SIGHT_WHOLE},
        {"\"size\": 2, \"rotation\": [45, 0, 0]",
         {-1, -M_SQRT2, 0},
         {1, M_SQRT2, M_SQRT2},
         HD_SIGHT_WHOLE},
        {"\"position\": [31, 0, 0]", {31, 0, 0}, {33, 2, 2}, HD_SIGHT_NONE},
        {"\"position\": [29, -1, -1]", {29, -1, -1}, {31, 1, 1}, HD_SIGHT_PART},
        {"\"position\": [0, 0, 12]", {0, 0, 12}, {2, 2, 14}, HD_SIGHT_PART},
        {"\"position\": [0, 0, 14]", {0, 0, 14}, {2, 2, 16}, HD_SIGHT_NONE},
        {"\"position\": [0, -20, 0]", {0, -20, 0}, {2, -18, 2}, HD_SIGHT_NONE},
    };
    write_text("a.obj", corner_text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        HdVec3 lower, upper;
        HdCamera camera;
        snprintf(text, sizeof text, SCENE("{\"file\": \"a.obj\", %s}"), cases[i].keys);
        expect_loaded(text);
        hd_instance_box(&file.scene, 0, &lower, &upper);
        const double *low = cases[i].lower, *high = cases[i].upper;
        expect_near(hd_largest(hd_sub(lower, hd_vec3(low[0], low[1], low[2]))), 0.0, 1e-12);
        expect_near(hd_largest(hd_sub(upper, hd_vec3(high[0], high[1], high[2]))), 0.0, 1e-12);
        assert_int_equal(hd_camera_at(&camera, &file.scene, 0, &error), HD_OK);
        if (hd_instance_sight(&file.scene, 0, &camera) != cases[i].sight)
            fail_msg("%s: sight", cases[i].keys);
        hd_scene_file_free(&file);
    }
}

static const char textured_text[] = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                    "usemtl grey\nf 1 2 3\nusemtl too\nf 1 2 4\n"
                                    "usemtl none\nf 1 3 4\nusemtl plain\nf 2 3 4\n";
static const char library_text[] = "newmtl grey\nmap_Kd grey.data\nnewmtl too\nmap_Kd grey.data\n"
                                   "newmtl none\nKd 0.5 0.25 1\nmap_Kd none.png\nnewmtl plain\n";

TEST(test_textures) {
    static const unsigned char grey[12] = {1, 0, 0, 0, 1, 0, 0, 0, 128, 128, 128, 255};
    assert_int_equal(mkdir("t", 0700), 0);
    write_text("t/t.obj", textured_text);
    write_text("t/t.mtl", library_text);
    write_bytes("t/grey.data", grey, sizeof grey);
    expect_loaded(
        SCENE("{\"file\": \"t/t.obj\"}, {\"file\": \"t/t.obj\", \"normals\": \"smooth\"}"));
    assert_string_equal(notes.text, "cannot read the texture t/none.png: No such file or "
                                    "directory; materials with this texture use their colour "
                                    "only\n");
    assert_int_equal(file.scene.picture_count, 1);
    assert_false(file.scene.pictures[0].is_clamped);
    assert_in_range(file.scene.pictures[0].texture.texels[0], 14100, 14200); /* on sRGB's curve */
    static const char *const names[] = {"grey", "too", "none", "plain"};
    for (int i = 0; i < 2; i++) {
        const HdMesh *mesh = &file.scene.meshes[i];
        for (int k = 0; k < 4; k++) {
            const int material = mesh->material_of[k];
            assert_string_equal(mesh->materials[material].name, names[k]);
            assert_int_equal(mesh->materials[material].picture, k < 2 ? 0 : -1);
        }
        expect_vector(mesh->materials[mesh->material_of[2]].material.colour, 0.5, 0.25, 1.0);
    }
    hd_scene_file_free(&file);
    /* A picture that repeats in one place and not in another; a mask. */
    write_text("t/u.obj", "mtllib u.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.5 0.5\nvt 1.5 0\n"
                          "usemtl in\nf 1/1 2/1 3/1\nusemtl out\nf 1/1 2/2 4/1\n");
    write_text("t/u.mtl", "newmtl in\nmap_Kd grey.data\nmap_d grey.data\nnewmtl out\n"
                          "map_Kd grey.data\nmap_d none.png\n");
    expect_loaded(SCENE("{\"file\": \"t/u.obj\"}"));
    assert_int_equal(file.scene.picture_count, 3);
    const HdMeshMaterial *in = file.scene.meshes[0].materials, *out = in + 1;
    const HdPicture *pictures = file.scene.pictures;
    assert_int_equal(pictures[in->picture].is_clamped - pictures[out->picture].is_clamped, 1);
    assert_true(pictures[in->mask_picture].texture.texels[0] == 128 * 257 && out->mask_picture < 0);
    expect_contains(notes.text, "materials with this mask have no holes");
    hd_scene_file_free(&file);
    write_text("t/none.png", "this is no picture");
    expect_loaded(SCENE("{\"file\": \"t/t.obj\"}"));
    expect_contains(notes.text, "t/none.png is neither PNG, JPEG nor the data format");
    assert_int_equal(file.scene.picture_count, 1);
    hd_scene_file_free(&file);
}
