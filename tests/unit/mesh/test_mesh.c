/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "base/trigonometry.h"
#include "mesh/mesh.h"
#include "unit_test.h"

/* Returns a copy that the mesh may free. */
static void *copy(const void *bytes, size_t size) {
    void *result = malloc(size);
    assert_non_null(result);
    memcpy(result, bytes, size);
    return result;
}

static HdMesh make_mesh(const HdVec3 *vertices, int vertex_count, const int32_t (*corners)[3],
                        int triangle_count) {
    HdMesh mesh = {.vertex_count = vertex_count, .triangle_count = triangle_count};
    mesh.vertices = copy(vertices, (size_t)vertex_count * sizeof *vertices);
    mesh.corners = copy(corners, (size_t)triangle_count * sizeof *corners);
    return mesh;
}

TEST(triangles_without_an_area_are_reported) {
    static const struct {
        bool has_area;
        HdVec3 at[3];
    } cases[] = {
        {true, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
        {false, {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}},
        {false, {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}},
        /* Collinear except for the rounding of tenths and thirds. */
        {false, {{0.1, 0.2, 0.3}, {0.3, 0.6, 0.9}, {0.7, 1.4, 2.1}}},
        /* Thin and small ones have an area, at any scale. */
        {true, {{0, 0, 0}, {1e-12, 0, 0}, {0.5e-12, 1e-21, 0}}},
        {false, {{0, 0, 0}, {1e-12, 0, 0}, {0.5e-12, 1e-29, 0}}},
        {true, {{0, 0, 0}, {1e12, 0, 0}, {0.5e12, 1e3, 0}}},
        {false, {{0, 0, 0}, {1e12, 0, 0}, {0.5e12, 1e-5, 0}}},
        /* Far from the origin the area is less certain. */
        {true, {{1e12, 0, 0}, {1e12 + 1, 0, 0}, {1e12, 1, 0}}},
        {false, {{1e12, 0, 0}, {1e12 + 1, 0, 0}, {1e12, 1e-5, 0}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int32_t corners[1][3] = {{0, 1, 2}};
        HdMesh mesh = make_mesh(cases[i].at, 3, corners, 1);
        hd_mesh_drop_degenerate(&mesh);
        if (mesh.triangle_count != cases[i].has_area || mesh.degenerate_count == cases[i].has_area)
            fail_msg("triangle %zu", i);
        hd_mesh_free(&mesh);
    }
}

TEST(a_triangles_data_moves_with_it) {
    const HdVec3 vertices[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    const int32_t corners[5][3] = {{0, 1, 1}, {0, 1, 2}, {0, 1, 3}, {1, 3, 2}, {2, 0, 2}};
    const int32_t normals[5][3] = {{0, 1, 2}, {10, 11, 12}, {20, 21, 22}, {30, 31, 32}, {0, 0, 0}};
    const int32_t uvs[5][3] = {{0, 1, 2}, {13, 14, 15}, {0, 0, 0}, {33, 34, 35}, {0, 0, 0}};
    const int32_t materials[5] = {0, 1, 2, 3, 4};
    const uint8_t groups[5] = {5, 6, 7, 8, 9};
    HdMesh mesh = make_mesh(vertices, 4, corners, 5);
    mesh.degenerate_count = 2;
    mesh.corner_normals = copy(normals, sizeof normals);
    mesh.corner_uvs = copy(uvs, sizeof uvs);
    mesh.material_of = copy(materials, sizeof materials);
    mesh.group_of = copy(groups, sizeof groups);
    hd_mesh_drop_degenerate(&mesh);
    assert_int_equal(mesh.triangle_count, 2);
    assert_int_equal(mesh.degenerate_count, 5);
    for (int i = 0; i < 2; i++) {
        const int before = 1 + 2 * i;
        assert_memory_equal(mesh.corners[i], corners[before], sizeof *corners);
        assert_memory_equal(mesh.corner_normals[i], normals[before], sizeof *normals);
        assert_memory_equal(mesh.corner_uvs[i], uvs[before], sizeof *uvs);
        assert_int_equal(mesh.material_of[i], materials[before]);
        assert_int_equal(mesh.group_of[i], groups[before]);
    }
    hd_mesh_free(&mesh);
    assert_null(mesh.corners);
    assert_int_equal(mesh.triangle_count, 0);
    hd_mesh_free(&mesh);
}

TEST(the_box_holds_all_triangles) {
    const HdVec3 vertices[4] = {{100, 0, 0}, {1, -5, 3}, {4, 2, -6}, {-2, 0, 1}};
    const int32_t corners[1][3] = {{1, 2, 3}};
    const HdVec3 expected[2] = {{-2, -5, -6}, {4, 2, 3}};
    HdMesh mesh = make_mesh(vertices, 4, corners, 1);
    HdThreadPool *pool;
    HdError error;
    assert_int_equal(hd_thread_pool_create(&pool, 1, &error), HD_OK);
    assert_int_equal(hd_mesh_build(&mesh, pool, &error), HD_OK);
    assert_memory_equal(&mesh.lower, &expected[0], sizeof *expected);
    assert_memory_equal(&mesh.upper, &expected[1], sizeof *expected);
    hd_thread_pool_destroy(pool);
    hd_mesh_free(&mesh);
}

/* Far from the origin; the last vertex, which is farthest, has no triangle. */
TEST(the_reach_is_that_of_the_farthest_corner) {
    enum { VERTICES = 900 };
    HdVec3 vertices[VERTICES + 1] = {[VERTICES] = {6e6, 6e6, 6e6}};
    int32_t corners[VERTICES / 3][3];
    HdThreadPool *pool;
    HdError error;
    for (int i = 0; i < VERTICES; i++) {
        vertices[i] = hd_vec3(5.4e6 + i * 7919 % 65536, 5.4e6 + i * 104729 % 65521, i * 31 % 997);
        corners[i / 3][i % 3] = i;
    }
    HdMesh mesh = make_mesh(vertices, VERTICES + 1, corners, VERTICES / 3);
    assert_int_equal(hd_thread_pool_create(&pool, 1, &error), HD_OK);
    assert_int_equal(hd_mesh_build(&mesh, pool, &error), HD_OK);
    hd_thread_pool_destroy(pool);
    for (int i = 0; i < 100; i++) {
        const HdVec3 direction = hd_vec3(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 1.5);
        double most = -HUGE_VAL;
        for (int k = 0; k < VERTICES; k++)
            most = fmax(most, hd_dot(direction, hd_sub(vertices[k], hd_mesh_centre(&mesh))));
        expect_near(hd_mesh_reach(&mesh, direction), most / hd_mesh_half_side(&mesh), 1e-12);
    }
    hd_mesh_free(&mesh);
}

TEST(angles_are_correct) {
    const HdVec3 x = {1.0, 0.0, 0.0};
    for (int i = 0; i <= 3600; i++) {
        const double angle = HD_PI * i / 3600.0;
        const HdVec3 other = hd_vec3(3.0 * cos(angle), 1.8 * sin(angle), 2.4 * sin(angle));
        expect_near(hd_angle(x, other), angle, 2e-15);
        expect_near(hd_angle(other, hd_scale(x, 1e-9)), angle, 2e-15);
    }
    assert_true(hd_angle(x, hd_vec3(0.0, 0.0, 0.0)) == 0.0);
    assert_true(hd_angle(x, hd_scale(x, -2.0)) == HD_PI);
    expect_near(hd_angle(hd_vec3(1, 1, 0), hd_vec3(1, 1, 1e-9)), 1e-9 / sqrt(2.0), 1e-24);
}

/* Makes a cube whose 12 triangles have vertices of their own, at 8 places. */
static HdMesh make_cube(void) {
    static const double sides[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    HdVec3 vertices[36];
    int32_t corners[12][3];
    for (int i = 0; i < 36; i++) {
        const int axis = i / 12;
        double at[3];
        at[axis] = i / 6 % 2 ? 1.0 : -1.0;
        at[(axis + 1) % 3] = at[axis] * sides[i % 6][0];
        at[(axis + 2) % 3] = sides[i % 6][1];
        vertices[i] = hd_vec3(at[0], at[1], at[2]);
        corners[i / 3][i % 3] = i;
    }
    return make_mesh(vertices, 36, (const int32_t(*)[3])corners, 12);
}

static HdVec3 face_normal(const HdMesh *mesh, int triangle) {
    const int32_t *corners = mesh->corners[triangle];
    const HdVec3 a = mesh->vertices[corners[0]];
    return hd_normalize(
        hd_cross(hd_sub(mesh->vertices[corners[1]], a), hd_sub(mesh->vertices[corners[2]], a)));
}

static void expect_vector(HdVec3 actual, HdVec3 expected) {
    expect_near(actual.x, expected.x, 1e-15);
    expect_near(actual.y, expected.y, 1e-15);
    expect_near(actual.z, expected.z, 1e-15);
}

static void smooth(HdMesh *mesh, double crease_degrees) {
    HdError error = {0};
    assert_int_equal(hd_mesh_smooth(mesh, crease_degrees, &error), HD_OK);
}

static void expect_normals(const HdMesh *mesh, int count, bool is_smooth) {
    assert_int_equal(mesh->normal_count, count);
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            expect_vector(mesh->normals[mesh->corner_normals[i][k]],
                          is_smooth ? hd_normalize(mesh->vertices[mesh->corners[i][k]])
                                    : face_normal(mesh, i));
}

/* Three faces meet at a corner with a right angle each, however they are cut into triangles. */
TEST(smoothing_weights_by_angle_and_leaves_creases) {
    HdMesh mesh = make_cube();
    static const double creases[] = {91.0, 89.0, 180.0, 0.0};
    for (int i = 0; i < 4; i++) { /* except the first, over the existing normals */
        smooth(&mesh, creases[i]);
        expect_normals(&mesh, i % 2 == 0 ? 8 : 24, i % 2 == 0);
    }
    hd_mesh_free(&mesh);
}

/* A roof whose two sides meet at 60 degrees, and touch a third triangle in one point alone. */
TEST(triangles_that_share_only_a_point_are_not_smoothed) {
    const HdVec3 vertices[6] = {
        {0, 0, 0},  {0, 2, 0},  {1, 1, -0.57735026918962584}, {-1, 1, -0.57735026918962584},
        {1, -1, 0}, {-1, -1, 0}};
    const int32_t corners[3][3] = {{0, 2, 1}, {0, 1, 3}, {0, 5, 4}};
    HdMesh mesh = make_mesh(vertices, 6, corners, 3);
    smooth(&mesh, 61.0);
    assert_int_equal(mesh.corner_normals[0][0], mesh.corner_normals[1][0]);
    assert_int_equal(mesh.corner_normals[0][2], mesh.corner_normals[1][1]);
    assert_int_not_equal(mesh.corner_normals[2][0], mesh.corner_normals[0][0]);
    expect_vector(mesh.normals[mesh.corner_normals[0][0]], hd_vec3(0, 0, 1));
    smooth(&mesh, 59.0);
    assert_int_not_equal(mesh.corner_normals[0][0], mesh.corner_normals[1][0]);
    expect_vector(mesh.normals[mesh.corner_normals[0][0]], face_normal(&mesh, 0));
    hd_mesh_free(&mesh);
}

TEST(odd_triangles_do_no_harm) {
    /* 0 and -0 are one place; the second triangle has no area; 40 more lie on one edge. */
    HdVec3 vertices[46] = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {-0.0, -0.0, 0}, {0.5, -1, 0}};
    int32_t corners[43][3] = {{0, 1, 2}, {0, 1, 1}, {1, 3, 4}};
    vertices[5] = hd_vec3(1, 0, -0.0);
    for (int i = 0; i < 40; i++) {
        vertices[6 + i] = hd_vec3(0.5, cos(i / 7.0), sin(i / 7.0));
        corners[3 + i][0] = 0;
        corners[3 + i][1] = 5;
        corners[3 + i][2] = 6 + i;
    }
    HdMesh mesh = make_mesh(vertices, 46, (const int32_t(*)[3])corners, 3);
    smooth(&mesh, 10.0);
    assert_int_equal(mesh.normal_count, 4);
    assert_int_equal(mesh.corner_normals[0][0], mesh.corner_normals[2][1]);
    assert_int_equal(mesh.corner_normals[1][0], -1);
    assert_int_equal(mesh.corner_normals[1][2], -1);
    hd_mesh_free(&mesh);
    mesh = make_mesh(vertices, 46, (const int32_t(*)[3])corners, 43);
    smooth(&mesh, 180.0);
    for (int i = 0; i < mesh.normal_count; i++)
        expect_near(hd_length(mesh.normals[i]), 1.0, 1e-15);
    hd_mesh_free(&mesh);
    mesh = (HdMesh){0};
    smooth(&mesh, 30.0);
    assert_int_equal(mesh.normal_count, 0);
    hd_mesh_free(&mesh);
}
