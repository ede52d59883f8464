/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "base/limits.h"
#include "base/text.h"
#include "input/check.h"
#include "mesh/mesh.h"
#include "test_folder.h"

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static const size_t much = (size_t)1 << 30;

static HdProblems notes;
static HdError error;

static void write_text(const char *path, const char *text) {
    write_bytes(path, text, strlen(text));
}

static HdStatus read_file(HdMesh *mesh, const char *path, size_t most) {
    memset(&notes, 0, sizeof notes);
    memset(&error, 0, sizeof error);
    return hd_mesh_read_obj(mesh, path, most, &notes, &notes, &error);
}

static HdMesh read_bytes(const void *bytes, size_t size) {
    HdMesh mesh;
    write_bytes("a.obj", bytes, size);
    if (read_file(&mesh, "a.obj", much) != HD_OK)
        fail_msg("%s", error.message);
    return mesh;
}

static HdMesh read_text(const char *text) {
    return read_bytes(text, strlen(text));
}

/* Expects the whole message. */
static void expect_refused_bytes(const void *bytes, size_t size, const char *message) {
    HdMesh mesh;
    write_bytes("a.obj", bytes, size);
    assert_int_equal(read_file(&mesh, "a.obj", much), HD_BAD_INPUT);
    assert_string_equal(error.message, message);
    assert_null(mesh.vertices);
    assert_null(mesh.materials);
    assert_int_equal(mesh.triangle_count, 0);
}

static void expect_refused(const char *text, const char *message) {
    expect_refused_bytes(text, strlen(text), message);
}

TEST(all_parts_of_a_face_are_read) {
    HdMesh mesh = read_text("v -1.5 +2 .5e1 1.0\nv 1 0 0 0.5 0.5 0.5\nv\t0\t1\t-0.25E-1\n"
                            "vt 0.25 0.5 0\nvt 0.75\nvn 0 0 2\nvn 0 0 0\n"
                            "v 0 0 9\nf 1/1/1 2/2/1 3//2\nf 4 2/1 1//1\nf -3/-1/-2 -2/ -1//\n");
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.triangle_count, 3);
    assert_true(mesh.vertices[0].x == -1.5 && mesh.vertices[0].y == 2 && mesh.vertices[0].z == 5);
    assert_true(mesh.vertices[2].z == (double)-0.025f);
    assert_int_equal(mesh.uv_count, 2);
    assert_true(mesh.uvs[0][0] == 0.25 && mesh.uvs[0][1] == 0.5);
    assert_true(mesh.uvs[1][0] == 0.75 && mesh.uvs[1][1] == 0.0);
    assert_int_equal(mesh.normal_count, 2);
    assert_true(mesh.normals[0].z == 2.0);
    const int32_t corners[3][3] = {{0, 1, 2}, {3, 1, 0}, {1, 2, 3}};
    assert_memory_equal(mesh.corners, corners, sizeof corners);
    const int32_t uvs[3][3] = {{0, 1, -1}, {-1, 0, -1}, {1, -1, -1}};
    const int32_t normals[3][3] = {{0, 0, -1}, {-1, -1, 0}, {0, -1, -1}};
    assert_memory_equal(mesh.corner_uvs, uvs, sizeof uvs);
    assert_memory_equal(mesh.corner_normals, normals, sizeof normals);
    assert_null(mesh.material_of);
    assert_null(mesh.group_of);
    assert_int_equal(mesh.material_count, 1);
    hd_mesh_free(&mesh);

    /* The largest numbers, and values that no face uses. */
    mesh = read_text("v 1e12 -1000000000000 0\nv 12345678.9e-3 1E+2 0\nv 0 0 0.1e-11\n"
                     "vn 0 0 1\nvt 0 0\nf 1 2 3\n");
    assert_true(mesh.vertices[0].x == (double)1e12f && mesh.vertices[0].y == (double)-1e12f);
    assert_true(mesh.vertices[1].x == (double)12345.6789f && mesh.vertices[1].y == 100.0);
    expect_near(mesh.vertices[2].z, 1e-12, 1e-19);
    assert_null(mesh.normals);
    assert_null(mesh.corner_normals);
    assert_null(mesh.uvs);
    assert_null(mesh.corner_uvs);
    assert_int_equal(mesh.normal_count + mesh.uv_count, 0);
    hd_mesh_free(&mesh);
}

/* Each is the same triangle. */
TEST(lines_come_in_many_forms) {
    static const char *const texts[] = {
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
        "\xef\xbb\xbf# mark\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "\t v \t0  0\t0 \n\n  v 1 0 0 # x\n v 0 1 0 # y\n\t f\t1\t2 3 # 4 5\n",
        "v 0 \\\n 0 0\nv 1 0 \\\r\n0\nv 0 1 0\nf 1\\\n2\\\n3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\\",
        "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",
        "# \\\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a\ng b c\ns off\nf 1 2 3\n",
        "v 0.000000000000000000 0 0e99\nv 1 0 1e-32\nv 0 10000000000e-10 0\nf 1 2 3",
        "v 0 0 0\nv 1 0 0.5e-4294967296\nv 0 1 0\nf 1 2 3",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\x1a",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\x1a\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        HdMesh mesh = read_text(texts[i]);
        assert_int_equal(mesh.vertex_count, 3);
        assert_int_equal(mesh.triangle_count, 1);
        assert_memory_equal(mesh.corners, ((int32_t[]){0, 1, 2}), sizeof *mesh.corners);
        assert_true(mesh.vertices[1].x == 1.0 && mesh.vertices[2].y == 1.0);
        assert_true(mesh.vertices[1].z == 0.0 && mesh.vertices[2].z == 0.0);
        assert_int_equal(notes.count, 0); /* a file that names no material lacks none */
        hd_mesh_free(&mesh);
    }
}

TEST(utf_16_is_read_by_its_mark) {
    static const char text[] = "# \xe9\n" TRIANGLE "f 1 2 3\n";
    for (size_t order = 0; order < 2; order++) {
        char wide[2 * sizeof text] = {order == 0 ? '\xff' : '\xfe', order == 0 ? '\xfe' : '\xff'};
        for (size_t i = 0; i + 1 < sizeof text; i++)
            wide[2 + 2 * i + order] = text[i];
        HdMesh mesh = read_bytes(wide, sizeof wide);
        assert_true(mesh.triangle_count == 1 && mesh.vertices[1].x == 1.0);
        hd_mesh_free(&mesh);
    }
}

/* Comments and lines around the sizes of all buffers. */
TEST(long_lines_and_comments_pass) {
    static char text[600000];
    static const size_t sizes[] = {HD_OBJ_MAX_LINE, 65536, 131072, 262144};
    size_t used;
    for (size_t i = 0; i < 4 * sizeof sizes / sizeof *sizes; i++) {
        used = sizes[i / 4] + i % 4 - 2;
        memset(text, 'x', used);
        text[0] = '#';
        used += (size_t)sprintf(text + used, "\n%s#\nf 1 2 3\nf 1 2 9\nf 1 2 9\n", TRIANGLE);
        expect_refused_bytes(text, used,
                             "a.obj: line 7: a face names vertex 9, and there are 3 vertices");
    }
    /* A long polygon, and one that is too long. */
    const int most = HD_OBJ_MAX_LINE / 6;
    used = 0;
    for (int i = 0; i < 11000; i++)
        used += (size_t)sprintf(text + used, "v %.9f %.9f 0\n", cos(i * 5.7e-4), sin(i * 5.7e-4));
    const size_t before = used;
    used += (size_t)sprintf(text + used, "f");
    for (int i = 0; i < most - 1; i++)
        used += (size_t)sprintf(text + used, " %5d", i + 1);
    HdMesh mesh = read_bytes(text, used);
    assert_int_equal(mesh.triangle_count + mesh.degenerate_count, most - 3);
    hd_mesh_free(&mesh);
    while (used <= before + HD_OBJ_MAX_LINE + 8)
        used += (size_t)sprintf(text + used, " 1");
    expect_refused_bytes(text, used, "a.obj: line 11001: it is longer than 65000 bytes");
    memcpy(text + before + 5000, " \\\n ", 4);
    expect_refused_bytes(text, used,
                         "a.obj: line 11001: with its continuations it is longer than 65000 bytes");
}

TEST(files_that_cannot_be_read_are_distinguished) {
    /* The first byte of a process' memory is at no address. */
    static const char *const files[][2] = {{"missing.obj", "No such file or directory"},
                                           {"folder", "Is a directory"},
                                           {"pipe", "it is not a regular file"},
                                           {"/proc/self/mem", "Input/output error"}};
    char message[128];
    assert_int_equal(mkdir("folder", 0700), 0);
    assert_int_equal(mkfifo("pipe", 0600), 0);
    for (int i = 0; i < 4; i++) {
        HdMesh mesh;
        assert_int_equal(read_file(&mesh, files[i][0], much), HD_BAD_INPUT);
        snprintf(message, sizeof message, "cannot read the mesh %s: %s", files[i][0], files[i][1]);
        assert_string_equal(error.message, message);
    }
}

TEST(a_file_that_is_not_obj_is_reported) {
#define NO_FACES                                                                                   \
    "cannot read the mesh a.obj: it has no faces, so it is empty or no OBJ file (of other "        \
    "formats, such as STL, PLY and glTF, Blender or assimp can make one)"
    expect_refused("", NO_FACES);
    expect_refused("<!DOCTYPE html>\n<p>", NO_FACES);
    expect_refused(TRIANGLE, "cannot read the mesh a.obj: it has vertices, but no faces");
    expect_refused_bytes("v 0 0 0\n\0f", 10,
                         "a.obj: line 2: it has a NUL byte, so it is no OBJ file");
    expect_refused_bytes("# \0\n", 4, NO_FACES); /* zero bytes behind the last line */
    expect_refused("\x89PNG\r\n\x1a\n",
                   "a.obj: line 1: it begins with byte 0x89, so it is no OBJ file");
    expect_refused("v 0 0 0\n\x1b[0m 1",
                   "a.obj: line 2: it begins with byte 0x1b, so it is no OBJ file");
}

TEST(wrong_numbers_are_reported) {
    static const struct {
        const char *expected, *numbers[12];
    } wrong[] = {
        {"a decimal number",
         {"nan", "inf", "-", ".", "1e", "1e+", "1.2.3", "1,5", "0x10", "1f", "--1"}},
        {"a number from -1e12 to 1e12", {"1.1e12", "-1000000000001", "1e25", "1e4294967296"}},
        {"a power of ten from -19 to 19", {"0.000000000000000000001e20", "10000000000e-20"}},
        {"a number of at most 64 characters",
         {"0.00000000000000000000000000000000000000000000000000000000000000001"}},
    };
    static const char *const statements[][4] = {
        {"v 0", "0\nf 1 2 4\n", "vertex", ""},
        {"vn 0", "0\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\n", "normal", "; its corners are flat\n"},
        {"vt 0", "\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n", "texture coordinate", "; it becomes 0\n"}};
    char text[256], message[512];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (const char *const *number = wrong[i].numbers; *number != NULL; number++)
            for (int k = 0; k < 3; k++) {
                snprintf(text, sizeof text, "%s%s %s %s", TRIANGLE, statements[k][0], *number,
                         statements[k][1]);
                snprintf(message, sizeof message,
                         "a.obj: line 4: number 2 of a %s is '%s', expected %s%s", statements[k][2],
                         *number, wrong[i].expected, statements[k][3]);
                if (k == 0) {
                    expect_refused(text, message);
                    continue;
                }
                HdMesh mesh = read_text(text);
                assert_string_equal(notes.text, message);
                assert_int_equal(mesh.corner_normals[0][0], k == 1 ? -1 : 0);
                assert_true(mesh.uvs[0][0] == 0.0 && mesh.uvs[0][1] == 0.0);
                hd_mesh_free(&mesh);
            }
    expect_refused(TRIANGLE "v\nv 1\nf 1 2 5\n",
                   "a.obj: line 5: a vertex that a face uses, expected three decimal numbers");
    expect_refused("\n\nv 1 2\nf 1 1 1\n",
                   "a.obj: line 3: number 3 of a vertex is '', expected a decimal number");
    expect_refused("v 1 2 # 3\nf 1 1 1\n",
                   "a.obj: line 1: number 3 of a vertex is '#', expected a decimal number");
}

#define BACK " counted back from here"

TEST(wrong_faces_are_reported) {
    static const struct {
        const char *face, *problem;
    } wrong[] = {
        {"f 1 2 4", "a face names vertex 4, and there are 3 vertices"},
        {"f 1/2 2/1 3/1", "a face names texture coordinate 2, and there are 1 texture coordinates"},
        {"f 1//1 2//1 3//7", "a face names normal 7, and there are 1 normals"},
        {"f 1 2 -4", "corner '-4' of a face names vertex -4, expected 1 and up, or -1 to -3" BACK},
        {"f 1 2 0", "corner '0' of a face names vertex 0, expected 1 and up, or -1 to -3" BACK},
        {"f 1 2 3//-2",
         "corner '3//-2' of a face names normal -2, expected 1 and up, or -1 to -1" BACK},
    };
    static const char *const corners[] = {
        "x",   "1.5",   "1e3",         "+1",         "1/2/3/4",       "/1",    "1/-", "-",
        "--1", "1//-/", "12345678901", "2147483648", "1/99999999999", "a\xff", "nan"};
    char text[512], message[512], shown[32];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        snprintf(text, sizeof text, "%svn 0 0 1\nvt 0 0\n%s\n", TRIANGLE, wrong[i].face);
        snprintf(message, sizeof message, "a.obj: line 6: %s", wrong[i].problem);
        expect_refused(text, message);
    }
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++) {
        snprintf(text, sizeof text, "%svt 1 1\nvt 1 1\nvn 1 1 1\nvn 1 1 1\nvn 1 1 1\nf 1 2 %s\n",
                 TRIANGLE, corners[i]);
        hd_escape(corners[i], shown, sizeof shown);
        snprintf(message, sizeof message,
                 "a.obj: line 9: corner '%s' of a face, expected numbers of a vertex, texture "
                 "coordinate and normal as 1, 1/2, 1//3 or 1/2/3",
                 shown);
        expect_refused(text, message);
    }
    expect_refused(TRIANGLE "f 1 2 2\nf 1 1 1\n", "a.obj: none of its 2 triangles has an area");
}

#define NOT_GIVEN "; it counts as not given"

/* A wrong item costs only itself, with one note for each kind. */
TEST(wrong_items_are_skipped) {
    static const char *const cases[][2] = {
        {"f 1\nf 1 2\nf\nf # 1 2 3\nf 1 2 3",
         "a face has 1 corner, expected at least 3; it is left out (4 times)"},
        {"f 1/1 2/2 3",
         "a face names a texture coordinate, and there are none" NOT_GIVEN " (2 times)"},
        {"f 1//7 2 3", "a face names a normal, and there are none" NOT_GIVEN},
        {"f 1//-1 2 3", "corner '1//-1' of a face names normal -1, expected 1 and up" NOT_GIVEN},
        {"f 1/0 2/0 3/1\nvt 1 1",
         "corner '1/0' of a face names texture coordinate 0, expected 1 and "
         "up" NOT_GIVEN " (2 times)"},
        {"usemtl\nusemtl a\x07\nf 1 2 3",
         "usemtl has no usable name, expected a name; the default material applies (2 times)"},
        {"v nan 0 0\nf 1 2 3",
         "number 1 of a vertex is 'nan', expected a decimal number; no face uses it"},
        {"mtllib \nf 1 2 3", "mtllib has no usable name, expected a name; it is left out"}};
    char text[512];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text, "%s%s\n", TRIANGLE, cases[i][0]);
        HdMesh mesh = read_text(text);
        snprintf(text, sizeof text, "a.obj: line 4: %s\n", cases[i][1]);
        assert_string_equal(notes.text, text);
        assert_true(mesh.normals == NULL && (mesh.uvs == NULL || mesh.corner_uvs[0][0] == -1));
        assert_string_equal(mesh.materials[0].name, "default");
        hd_mesh_free(&mesh);
    }
}

TEST(vertices_keep_their_digits) {
    HdMesh mesh = read_text("v 500000.125 5400000.123 0\nv 500001.1 5400000 0\n"
                            "v 500000 5400001 0.1\nf 1 2 3\n");
    assert_true(mesh.vertices[0].y == 5400000.123 && mesh.vertices[1].x == 500001.1);
    hd_mesh_free(&mesh);
    mesh = read_text("v 2.1 0 0\nv 1 0 0\nv 1.5 0 0.1\nf 1 2 3\n"); /* 3.8 half sides away */
    assert_true(mesh.vertices[0].x == (double)2.1f && mesh.vertices[2].z == (double)0.1f);
    hd_mesh_free(&mesh);
}

TEST(polygons_become_triangles) {
    HdMesh mesh =
        read_text("v 0 0 0\nv 4 -2 0\nv 1 0 0\nv 4 2 0\nusemtl a\nf 1 2 3 4\n"
                  "usemtl b\nf 4 3 2\nv 0 0 5\nv 1 0 5\nv 1 1 5\nv 0 1 5\nf -4 -3 -2 -1\n");
    assert_int_equal(mesh.triangle_count, 5);
    const int32_t corners[5][3] = {{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {4, 5, 6}, {4, 6, 7}};
    assert_memory_equal(mesh.corners, corners, sizeof corners);
    const int32_t materials[5] = {0, 0, 1, 1, 1};
    assert_memory_equal(mesh.material_of, materials, sizeof materials);
    hd_mesh_free(&mesh);
    static char text[100000];
    size_t used = 0;
    for (int i = 0; i < 1026; i++)
        used += (size_t)sprintf(text + used, "v %.6f %.6f 0\n", (1 + i % 2) * cos(i * 6.124e-3),
                                (1 + i % 2) * sin(i * 6.124e-3));
    used += (size_t)sprintf(text + used, "f 1 3 5\nf");
    for (int i = 0; i < 1026; i++)
        used += (size_t)sprintf(text + used, " %d", i + 1);
    expect_refused_bytes(text, used,
                         "a.obj: face 2 is not convex and has 1026 corners, expected at most 1024");
}

/* Reads one triangle below the statements. */
static HdMesh read_triangle(const char *statements) {
    char text[600];
    snprintf(text, sizeof text, "%s" TRIANGLE "f 1 2 3\n", statements);
    return read_text(text);
}

/* Reads one triangle of material m as the library `text` describes it. */
static HdMeshMaterial read_material(const char *text) {
    HdProblems problems = {0};
    write_text("a.mtl", text);
    HdMesh mesh = read_triangle("mtllib a.mtl\nusemtl m\n");
    assert_int_equal(mesh.material_count, 1);
    assert_string_equal(mesh.materials[0].name, "m");
    const HdMeshMaterial material = mesh.materials[0];
    const HdMaterial *m = &material.material;
    HdSceneChecker checker = {.problems = &problems};
    hd_check_material(&checker, m, true);
    assert_int_equal(problems.count, 0);
    assert_false(m->has_inner_side || m->lit_from_behind);
    hd_mesh_free(&mesh);
    return material;
}

#define OF_M "a.obj: material 'm': "
#define CLEAR                                                                                      \
    "a.obj: material 'm' is invisible except for its tint: d is 0 (or Tr 1), so all light passes " \
    "straight through"

/* Statements of the material m, the result (colour | mirror tint | ambient, diffuse, specular,
   shininess | reflection, transmission, index of refraction | emission), and the note that they
   cause. */
static const char *const material_cases[][3] = {
    {"", "1 1 1 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0"},
    /* Nothing passes, so Ni does not count. */
    {"Ka 0.1 0.2 0.6\nKd 0.5 0.25 0.125\nKs 0.2 0.4 0.6\nKe 3 2 1\nNs 96.6\nNi 1.5",
     "0.5 0.25 0.125 | 1 1 1 | 0.3 1 0.4 97 | 0 0 1 | 3 2 1"},
    {"Kd .5\nKs .3\nillum 1", "0.5 0.5 0.5 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0"},
    {"Ks 0.2 0.4 0.3\nillum 3", "1 1 1 | 0.5 1 0.75 | 0 1 0.3 64 | 0.4 0 1 | 0 0 0"},
    {"Kd 0.5 0.5 1\nd 0.25\nNi 1.5", "0.5 0.5 1 | 1 1 1 | 0 0.25 0 64 | 0 0.75 1.5 | 0 0 0"},
    /* Only models 6 and 7 refract; only they ask for Tf. */
    {"d 0.25\nNi 1.5\nillum 4\nTf 1 1 1", "1 1 1 | 1 1 1 | 0 0.25 0 64 | 0 0.75 1 | 0 0 0"},
    {"Ni 1.5\nillum 4\nTf 1 1 1", "1 1 1 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0"},
    {"Ni 1.5\nillum 6\nTf 0.25 0.5 0", "1 1 1 | 1 1 1 | 0 0.5 0 64 | 0 0.5 1.5 | 0 0 0"},
    {"Ni 1.25\nillum 7\nd 0.75\nTf 1 1 1", "1 1 1 | 1 1 1 | 0 0.75 0 64 | 0 0.25 1.25 | 0 0 0"},
    /* Black glass is seen through its filter. */
    {"Kd 0 0 0\nillum 7\nTf 0.4 0.8 0.2", "0.5 1 0.25 | 1 1 1 | 0 0 0 64 | 0 0.8 1 | 0 0 0"},
    /* Tr is the inverse of d, and only counts without it. */
    {"d 0.75\nTr 0.5", "1 1 1 | 1 1 1 | 0 0.75 0 64 | 0 0.25 1 | 0 0 0"},
    /* Together with the mirror at most all. */
    {"Ks 1 1 1\nd 0\nillum 7", "1 1 1 | 1 1 1 | 0 0 1 64 | 0.5 0.5 1 | 0 0 0",
     OF_M "Ks reflects 1 and d or Tf transmits 1, expected at most 1 together, and both "
          "are divided by 2"},
    /* Corrected values; without a highlight the exponent does not matter. */
    {"Kd 2 1 0", "1 1 0 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0",
     OF_M "Kd is 2, expected 0 to 1, and becomes 1"},
    {"Ka 0 1.5 0.5", "1 1 1 | 1 1 1 | 0.5 1 0 64 | 0 0 1 | 0 0 0",
     OF_M "Ka is 1.5, expected 0 to 1, and becomes 1"},
    {"Ks 0.5 0 4", "1 1 1 | 1 1 1 | 0 1 0.5 64 | 0 0 1 | 0 0 0",
     OF_M "Ks is 4, expected 0 to 1, and becomes 1"},
    {"Tf 1 1 7", "1 1 1 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0",
     OF_M "Tf is 7, expected 0 to 1, and becomes 1"},
    {"Ke 0 -1 0", "1 1 1 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0",
     OF_M "Ke is -1, expected 0 to 1000000000000, and becomes 0"},
    {"Ns 0", "1 1 1 | 1 1 1 | 0 1 0 1 | 0 0 1 | 0 0 0"},
    {"Ks 1\nNs 0", "1 1 1 | 1 1 1 | 0 1 1 1 | 0 0 1 | 0 0 0",
     OF_M "Ns is 0, expected 1 to 65536, and becomes 1"},
    {"Ks 1\nNs 1e9", "1 1 1 | 1 1 1 | 0 1 1 65536 | 0 0 1 | 0 0 0",
     OF_M "Ns is 1e+09, expected 1 to 65536, and becomes 65536"},
    {"d 1.5", "1 1 1 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0",
     OF_M "d is 1.5, expected 0 to 1, and becomes 1"},
    {"Tr 1.5", "1 1 1 | 1 1 1 | 0 0 0 64 | 0 1 1 | 0 0 0",
     "a.mtl: line 2: Tr is 1.5, expected 0 to 1; the nearer of them is used\n" CLEAR},
    /* Libraries that hide their mesh; with refraction it is seen. */
    {"Tr 1\nNs 0\nillum 2", "1 1 1 | 1 1 1 | 0 0 0 1 | 0 1 1 | 0 0 0", CLEAR},
    {"d 0\nNi 1.5", "1 1 1 | 1 1 1 | 0 0 0 64 | 0 1 1.5 | 0 0 0"},
    {"Kd 0\nillum 4\nTf 1\nmap_Kd a.png", "0 0 0 | 1 1 1 | 0 1 0 64 | 0 0 1 | 0 0 0",
     "a.obj: material 'm' is black: Kd is 0 0 0, by which its texture is multiplied"},
    {"d 0.5\nNi 0", "1 1 1 | 1 1 1 | 0 0.5 0 64 | 0 0.5 0.1 | 0 0 0",
     OF_M "Ni is 0, expected 0.1 to 10, and becomes 0.1"},
};

TEST(materials_are_mapped) {
    char text[256];
    for (size_t i = 0; i < sizeof material_cases / sizeof *material_cases; i++) {
        const char *const *expected = material_cases[i];
        snprintf(text, sizeof text, "newmtl m\n%s\n", expected[0]);
        const HdMeshMaterial found = read_material(text);
        const HdMaterial *m = &found.material;
        const HdVec3 c = m->colour, t = m->mirror_tint, e = found.emission;
        snprintf(text, sizeof text, "%g %g %g | %g %g %g | %g %g %g %d | %g %g %g | %g %g %g", c.x,
                 c.y, c.z, t.x, t.y, t.z, m->ambient, m->diffuse, m->specular, m->shininess,
                 m->reflection, m->transmission, m->index_of_refraction, e.x, e.y, e.z);
        if (strcmp(text, expected[1]) != 0)
            fail_msg("'%s' becomes %s", expected[0], text);
        snprintf(text, sizeof text, "%s\n", expected[2] != NULL ? expected[2] : "");
        assert_string_equal(notes.text, expected[2] != NULL ? text : "");
    }
    for (int illum = 0; illum <= 10; illum++) {
        snprintf(text, sizeof text, "newmtl m\nKs 1 1 1\nTf 0 0 0\nillum %d\n", illum);
        const HdMaterial m = read_material(text).material;
        assert_true(m.reflection == (illum >= 3 && illum <= 9 ? 1.0 : 0.0));
        assert_true(m.specular == (illum >= 2 ? 1.0 : 0.0));
    }
    /* The d of another material does not count. */
    assert_true(read_material("newmtl n\nd 1\nnewmtl m\nTr 0.75\n").material.transmission == 0.75);
}

TEST(unused_statements_are_noted) {
    static const struct {
        const char *statements, *notes;
    } cases[] = {
        {"map_Ks a.png\nmap_Ks b.png\nmap_Bump c.png",
         "2: map_Ks is not used\na.mtl: line 4: map_Bump is not used"},
        {"map_K\nmap_N\nd\n",
         "2: map_K is not used\na.mtl: line 3: map_N is not used\n"
         "a.mtl: line 4: d has '', expected a decimal number; the line is left out"},
        {"Kd spectral x.rfl",
         "2: Kd has 'spectral', expected a decimal number; the line is left out"},
        {"Ks 1 nan 1", "2: Ks has 'nan', expected a decimal number; the line is left out"},
        {"d -halo 0.5", "2: d has '-halo', expected a decimal number; the line is left out"},
        {"illum 99999999999", "2: illum is '99999999999', expected 0 to 10; the line is left out"},
        {"illum -1", "2: illum is '-1', expected 0 to 10; the line is left out"},
        {"illum x", "2: illum is 'x', expected 0 to 10; the line is left out"},
        {"\x1b[1m 1", "2: it has no statement of a material library"},
        {"newmtl", "2: newmtl has no usable name, expected a name; it is left out"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "newmtl m\n%s\n", cases[i].statements);
        read_material(text);
        snprintf(text, sizeof text, "a.mtl: line %s\n", cases[i].notes);
        assert_string_equal(notes.text, text);
    }
    /* Statements before the first material belong to none; a material of no library is white. */
    const HdMaterial white = read_material("Kd 0 0 0\nnewmtl m\n").material;
    const HdMaterial none = read_material("").material;
    assert_memory_equal(&none, &white, sizeof white);
    assert_true(white.colour.x == 1.0);
    assert_string_equal(notes.text, "a.obj: no material library defines 'm', so the default "
                                    "applies: white, opaque\n");
    HdMesh mesh = read_text("l 1 2\n" TRIANGLE "p 1\nf 1 2 3\n");
    expect_contains(notes.text,
                    "a.obj: line 1: statements such as 'l' are not used, only faces (f) are\n");
    assert_int_equal(notes.count, 1);
    hd_mesh_free(&mesh);
}

/* The first library that defines a material counts; order and repetition do not matter. */
TEST(materials_are_found_by_name) {
    write_text("a.mtl", "newmtl white wood \r\nKd 0.5 0 0\r\nnewmtl b\rKd 0 0.5 0\r"
                        "newmtl b\nKd 0 0 1\nnewmtl unused\n");
    write_text("my lib.mtl", "newmtl b\nKd 0 1 1\nnewmtl c\nKd 0 0.25 0");
    HdMesh mesh = read_text("f 1 2 3\nusemtl b\nf 1 2 4\nmtllib a.mtl\t \nmtllib my lib.mtl\n"
                            "mtllib a.mtl\nusemtl c\nf 1 2 5\nusemtl  white wood\nf 1 2 6\n"
                            "usemtl b\nf 1 2 7\nusemtl d\nf 1 2 8\nusemtl d\nf 1 2 9\n" TRIANGLE
                            "v 0 2 0\nv 0 3 0\nv 0 4 0\nv 0 5 0\nv 0 6 0\nv 0 7 0\n");
    const char *const names[5] = {"default", "b", "c", "white wood", "d"};
    const int32_t materials[7] = {0, 1, 2, 3, 1, 4, 4};
    assert_int_equal(mesh.material_count, 5);
    for (int i = 0; i < 5; i++)
        assert_string_equal(mesh.materials[i].name, names[i]);
    assert_memory_equal(mesh.material_of, materials, sizeof materials);
    const HdVec3 colours[5] = {{1, 1, 1}, {0, 0.5, 0}, {0, 0.25, 0}, {0.5, 0, 0}, {1, 1, 1}};
    for (int i = 0; i < 5; i++)
        assert_memory_equal(&mesh.materials[i].material.colour, &colours[i], sizeof *colours);
    assert_string_equal(
        notes.text, "a.obj: no material library defines 'default' and others that faces name, so "
                    "the default applies: white, opaque\n");
    hd_mesh_free(&mesh);
}

TEST(too_many_materials_are_refused) {
    FILE *file = fopen("many.obj", "wb");
    HdMesh mesh;
    assert_non_null(file);
    fputs(TRIANGLE, file);
    for (int i = 0; i < HD_MAX_MESH_MATERIALS; i++)
        fprintf(file, "usemtl %d\nv 0 %d 1\nf 1 2 -1\n", i, i);
    fflush(file);
    assert_int_equal(read_file(&mesh, "many.obj", much), HD_OK);
    assert_int_equal(mesh.material_count, HD_MAX_MESH_MATERIALS);
    assert_int_equal(mesh.material_of[HD_MAX_MESH_MATERIALS - 1], HD_MAX_MESH_MATERIALS - 1);
    hd_mesh_free(&mesh);
    fputs("usemtl x\n", file);
    fclose(file);
    assert_int_equal(read_file(&mesh, "many.obj", much), HD_BAD_INPUT);
    assert_string_equal(error.message, "many.obj: line 196612: there are more materials than fit, "
                                       "expected at most 65536");
}

/* Faces count as one if their corners are at the same places, one after the other. */
TEST(faces_with_the_same_corners_count_once) {
    static const struct {
        const char *faces;
        int triangles, dropped;
    } rows[] = {{"f 1 2 3\nf 3 1 2\nf 1 3 2\nf 5 2 3\n", 1, 3}, /* vertex 5 is at -0 0 0 */
                {"f 1 2 4 3\nf 2 4 3 1\nf 3 4 2 1\nf 1 2 3\n", 3, 2},
                {"f 1 2 3\nf 1 2 4\nf 1 2 6\n", 3, 0},
                {"f 1 2 4 3\nf 1 4 2 3\n", 4, 0}, /* the same four in another order */
                {"f 1 2 3\nf 1 2 3 3\nf 1 2 2\nf 1 2 2\n", 2, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[256], note[64];
        snprintf(text, sizeof text, TRIANGLE "v 1 1 0\nv -0 0 0\nv 1 1 1e-9\n%s", rows[i].faces);
        HdMesh mesh = read_text(text);
        snprintf(note, sizeof note, "a.obj: %d of its faces coincide", rows[i].dropped);
        assert_int_equal(mesh.triangle_count, rows[i].triangles);
        assert_int_equal(strstr(notes.text, note) != NULL, rows[i].dropped > 0);
        hd_mesh_free(&mesh);
    }
}

/* Expects `note` as the only one. */
static void expect_note_of(const char *statements, const char *note) {
    HdMesh mesh = read_triangle(statements);
    assert_int_equal(notes.count, 1);
    notes.text[strcspn(notes.text, "\n")] = '\0';
    assert_string_equal(notes.text, note);
    hd_mesh_free(&mesh);
}

#define BELOW    "in this file's folder or below it"
#define RELATIVE "relative to this file's folder"

TEST(libraries_stay_in_the_folder) {
    assert_int_equal(mkdir("sub", 0700), 0);
    assert_int_equal(mkdir("sub/deeper", 0700), 0);
    write_text("outer.mtl", "newmtl m\nKd 0 0 0\n");
    write_text("sub/deeper/in.mtl", "newmtl m\nmap_Kd pic\\wood 1.png\n");
    write_text("sub/b.obj",
               "mtllib deeper\\in.mtl\nmtllib ../outer.mtl\nusemtl m\n" TRIANGLE "f 1 2 3\n");
    HdMesh mesh;
    assert_int_equal(read_file(&mesh, "sub/b.obj", much), HD_OK);
    assert_string_equal(mesh.materials[0].texture, "sub/deeper/pic/wood 1.png");
    assert_string_equal(notes.text, "sub/b.obj: the material library '../outer.mtl' is not read, "
                                    "expected a name in this file's folder or below it\n");
    hd_mesh_free(&mesh);

    expect_note_of("mtllib none.mtl\nmtllib none.mtl\n",
                   "a.obj: cannot read the material library none.mtl: No such file or directory");
    expect_note_of("mtllib sub\n",
                   "a.obj: cannot read the material library sub: it is not a regular file");
    write_bytes("zero.mtl", "newmtl m\0x", 10);
    expect_note_of("mtllib zero.mtl\n",
                   "zero.mtl: it has a NUL byte, so it is no material library");
    write_text("empty.mtl", "");
    mesh = read_triangle("mtllib empty.mtl\n");
    assert_int_equal(notes.count, 0);
    hd_mesh_free(&mesh);

    static char many[8192];
    size_t used = 0;
    for (int i = 0; i < 65; i++)
        used += (size_t)sprintf(many + used, "mtllib none%d.mtl\n", i);
    sprintf(many + used, TRIANGLE "f 1 2 3\n");
    mesh = read_text(many);
    assert_string_equal(
        notes.text, "a.obj: cannot read the material library none0.mtl: No such file or directory "
                    "(64 times)\na.obj: the material library 'none64.mtl' is not read, expected no "
                    "more than 64 libraries\n");
    hd_mesh_free(&mesh);
}

/* Expects a material with the map; NULL: none. */
static void expect_texture(const char *library, const char *map, const char *texture) {
    char text[128];
    snprintf(text, sizeof text, "newmtl m\nmap_Kd  %s \n", map);
    write_text(library, text);
    snprintf(text, sizeof text, "mtllib %s\nusemtl m\n", library);
    HdMesh mesh = read_triangle(text);
    if (texture == NULL)
        assert_null(mesh.materials[0].texture);
    else
        assert_string_equal(mesh.materials[0].texture, texture);
    hd_mesh_free(&mesh);
}

TEST(textures_stay_in_the_folder) {
    static const char *const wrong[][2] = {
        {"/etc/passwd", "a name " RELATIVE},
        {"../a.png", "a name " BELOW},
        {"a/../../b.png", "a name " BELOW},
        {"", "a name"},
        {"a\x1b.png", "a name without control characters"},
        {"a\x7f.png", "a name without control characters"},
        {"-wide", "options of the format with their values"},
    };
    char text[256], shown[64];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        hd_escape(wrong[i][0], shown, sizeof shown);
        expect_texture("a.mtl", wrong[i][0], NULL);
        snprintf(text, sizeof text,
                 "a.mtl: line 2: map_Kd is '%s', expected %s; the line is left out\n", shown,
                 wrong[i][1]);
        assert_string_equal(notes.text, text);
    }
    /* Neither the home folder nor a texture of the program. */
    static const char *const names[] = {"~/a.png", "builtin:floor", "..a/b..png", "a..b"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(text, sizeof text, "./%s", names[i]);
        expect_texture("a.mtl", names[i], text);
        assert_int_equal(notes.count, 0);
    }
    assert_int_equal(mkdir("-dash", 0700), 0);
    expect_texture("-dash/a.mtl", "b.png", "./-dash/b.png");
}

#define ELSEWHERE(name, path) "the material library '" name "' is not there; " path " is read"

/* Names with comments, quotes, other letter case, or folders of another machine. */
TEST(files_are_found_beside_the_mesh) {
    static const char *const cases[][2] = {
        {"l.mtl # comment", ""},
        {"none.mtl l.mtl # two", "cannot read the material library none.mtl: No such file"},
        {"C:\\me\\l.mtl", ELSEWHERE("C:\\me\\l.mtl", "l.mtl")},
        {"../x/deep/l.mtl", ELSEWHERE("../x/deep/l.mtl", "deep/l.mtl")},
        {"L.MTL", ELSEWHERE("L.MTL", "l.mtl")}};
    static const char library[] = "\xef\xbb\xbfnewmtl m # r\nmap_Kd ../wood.png\nKd 0.5\n\0\x1a";
    char text[256];
    assert_int_equal(mkdir("deep", 0700), 0);
    write_text("wood.png", "");
    write_text("deep/l.mtl", "newmtl m\nmap_Kd \"D:\\x\\Wood.png\" # c\nKd 0.5 # grey\n");
    write_bytes("l.mtl", library, sizeof library);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text, "mtllib %s\nusemtl m # a\n", cases[i][0]);
        HdMesh mesh = read_triangle(text);
        const HdMeshMaterial *material = &mesh.materials[mesh.material_of[0]];
        assert_true(material->material.colour.x == 0.5);
        assert_string_equal(material->texture, "./wood.png");
        expect_contains(notes.text, cases[i][1]);
        assert_int_equal(notes.count, cases[i][1][0] != '\0' ? 2 : 1);
        hd_mesh_free(&mesh);
    }
}

/* Texture, mask, u and v of corners at (0.5, 0.25), whether clamped, and notes. */
TEST(options_of_textures_move_them) {
    static const char *const cases[][2] = {
        {"map_Kd -s 2 3 1 a.png", "./a.png - 1 0.75 1 0"},
        {"map_Kd -o 0.25 -s 2 a.png", "./a.png - 1.25 0.25 0 0"},
        {"map_Kd -clamp on -o 4 5 6", "./6 - 4.5 5.25 1 0"},
        {"map_Kd -blendu on -mm 0 1 -texres 64 -type sphere -imfchan r -t 1 2 3 a b.png",
         "./a b.png - 0.5 0.25 1 0"},
        {"map_Kd -mm 0 a.png", "- - 0.5 0.25 1 1"},
        {"map_d -s 4 m.png\nmap_Kd -s 2 a.png", "./a.png ./m.png 1 0.25 1 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[256];
        snprintf(text, sizeof text, "newmtl n\nnewmtl m\n%s\n", cases[i][0]);
        write_text("a.mtl", text);
        HdMesh mesh = read_text("mtllib a.mtl\nvt 0.5 0.25\nvt 2 2\n" TRIANGLE
                                "v 0 0 1\nv 1 1 1\nusemtl n\nf 1/2 2/2 3/1\n"
                                "usemtl m\nf 1/1 2/1 4/1\nf 1 2 5\n");
        const HdMeshMaterial *m = &mesh.materials[1];
        const double *uv = mesh.uvs[mesh.corner_uvs[1][2]];
        snprintf(text, sizeof text, "%s %s %g %g %d %d", m->texture ? m->texture : "-",
                 m->mask ? m->mask : "-", uv[0], uv[1], m->is_clamped, notes.count);
        assert_string_equal(text, cases[i][1]);
        assert_true(mesh.uvs[mesh.corner_uvs[0][2]][0] == 0.5); /* shared before */
        assert_true(mesh.corner_uvs[2][0] == -1 && !mesh.materials[0].is_clamped);
        hd_mesh_free(&mesh);
    }
}

TEST(colours_of_vertices_are_light) {
    static const char *const lines[] = {"", " 0 0.5 1", " 0 127.5 255", " -1 255 0 1", " 1 1 x"};
    static const HdVec3 light[] = {{1, 1, 1}, {0, 0.214041, 1}, {0, 0.214041, 1}, {0, 1, 0}};
    for (int i = 1; i < 4; i++) {
        char text[128];
        snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0%s\nv 0 1 0%s\nf 1 2 3\n", lines[i],
                 lines[4 * (i % 2)]);
        HdMesh mesh = read_text(text);
        assert_true(mesh.colours[0].x == 1.0 && mesh.colours[2].y == 1.0);
        assert_true(hd_length(hd_sub(mesh.colours[1], light[i])) < 1e-6);
        hd_mesh_free(&mesh);
    }
}

/* Every limit gives an error or a mesh, and beyond some limit always a mesh. */
TEST(memory_is_limited) {
    const int open_before = count_entries("/proc/self/fd");
    write_text("a.mtl", "newmtl m\nmap_Kd a.png\nKd 1 1 1\nnewmtl n\nKd 1 1 1\n");
    FILE *file = fopen("big.obj", "wb");
    size_t least = 0;
    assert_non_null(file);
    fputs("mtllib a.mtl\nusemtl m\nvt 0 0\nvn 0 0 1\n", file);
    for (int i = 0; i < 3000; i++)
        fprintf(file, "v %d 0 0\nv %d 1 0\nv %d 0 1\nusemtl n%d\nf -1/1/1 -2/1/1 -3/1/1\n", i, i, i,
                i % 7);
    fclose(file);
    for (size_t most = 0; most < 4000000; most += most < 1900000 ? 77777 : 20011) {
        HdMesh mesh;
        const HdStatus status = read_file(&mesh, "big.obj", most);
        if (status == HD_OK) {
            least = least == 0 ? most : least;
            assert_int_equal(mesh.triangle_count, 3000);
            for (int i = 0; i < mesh.vertex_count; i++)
                assert_true(mesh.vertices[i].x == i / 3);
        } else {
            char expected[128];
            assert_int_equal(status, HD_BAD_INPUT);
            assert_int_equal(least, 0);
            snprintf(expected, sizeof expected,
                     "big.obj: reading it needs more than the %zu bytes of memory allowed", most);
            assert_string_equal(error.message, expected);
            assert_null(mesh.vertices);
        }
        hd_mesh_free(&mesh);
    }
    assert_in_range(least, 1900000, 3900000);
    assert_int_equal(count_entries("/proc/self/fd"), open_before);
}

/* Files whose names and first words are not those of OBJ. */
TEST(other_files_are_not_quoted) {
    static const char *const cases[][2] = {
        {"root:x:0 hidden\nf password\n", "corner '...' of a face"},
        {"root:x:0 hidden\n", "it has no faces"},
        {"v password\nf 1 1 1\n", "number 1 of a vertex is '...'"},
        {"v 0 0 0\nf 1 1 x\n", "corner 'x' of a face"},
    };
    for (int i = 0; i < 4; i++) {
        HdMesh mesh;
        write_text("secret", cases[i][0]);
        assert_int_equal(read_file(&mesh, "secret", much), HD_BAD_INPUT);
        expect_contains(error.message, cases[i][1]);
        if (i < 2)
            expect_contains(notes.text, "statements such as '...'");
    }
}
