/* SPDX-License-Identifier: MIT */
#include "scene/platonic.h"
#include "unit_test.h"

static const double tolerance = 4e-15;

/* Closed forms from H. S. M. Coxeter, Regular Polytopes, table I, for the circumradius 1. */
typedef struct Known {
    int faces, vertices, edges, sides_of_a_face;
    double edge_length, inradius, cosine_of_dihedral;
} Known;

static Known known(HdSolidKind kind) {
    const double root5 = sqrt(5.0);
    const double phi = (1.0 + root5) / 2.0;
    switch (kind) {
    case HD_TETRAHEDRON:
        return (Known){4, 4, 6, 3, sqrt(8.0 / 3.0), 1.0 / 3.0, 1.0 / 3.0};
    case HD_HEXAHEDRON:
        return (Known){6, 8, 12, 4, 2.0 / sqrt(3.0), 1.0 / sqrt(3.0), 0.0};
    case HD_OCTAHEDRON:
        return (Known){8, 6, 12, 3, sqrt(2.0), 1.0 / sqrt(3.0), -1.0 / 3.0};
    case HD_DODECAHEDRON:
        return (Known){
            12, 20, 30, 5, 2.0 / (sqrt(3.0) * phi), sqrt((5.0 + 2.0 * root5) / 15.0), -1.0 / root5};
    default:
        return (Known){20,
                       12,
                       30,
                       3,
                       1.0 / sqrt((5.0 + root5) / 8.0),
                       sqrt((5.0 + 2.0 * root5) / 15.0),
                       -root5 / 3.0};
    }
}

TEST(test_counts_and_euler) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic solid;
        hd_platonic(kind, &solid);
        const Known expected = known(kind);
        assert_int_equal(solid.face_count, expected.faces);
        assert_int_equal(solid.vertex_count, expected.vertices);
        assert_int_equal(solid.edge_count, expected.edges);
        assert_int_equal(solid.vertex_count - solid.edge_count + solid.face_count, 2);
    }
}

TEST(test_measures) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic solid;
        hd_platonic(kind, &solid);
        const Known expected = known(kind);
        const double cosine = expected.cosine_of_dihedral;
        expect_near(solid.edge_length, expected.edge_length, tolerance);
        expect_near(solid.inradius, expected.inradius, tolerance);
        expect_near(solid.sine_of_dihedral, sqrt(1.0 - cosine * cosine), tolerance);
    }
}

TEST(test_vertices_lie_on_the_unit_sphere_about_the_origin) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic solid;
        hd_platonic(kind, &solid);
        HdVec3 sum = {0.0, 0.0, 0.0};
        for (int i = 0; i < solid.vertex_count; i++) {
            expect_near(hd_length(solid.vertex[i]), 1.0, tolerance);
            sum = hd_add(sum, solid.vertex[i]);
            for (int j = 0; j < i; j++)
                assert_true(hd_length(hd_sub(solid.vertex[i], solid.vertex[j])) >
                            solid.edge_length - tolerance);
        }
        expect_near(hd_length(sum), 0.0, tolerance);
    }
}

/* Each face touches as many vertices as it has sides, and none lies above it. */
TEST(test_faces) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic solid;
        hd_platonic(kind, &solid);
        for (int f = 0; f < solid.face_count; f++) {
            int touched = 0;
            expect_near(hd_length(solid.face_normal[f]), 1.0, tolerance);
            for (int v = 0; v < solid.vertex_count; v++) {
                const double distance = hd_dot(solid.face_normal[f], solid.vertex[v]);
                assert_true(distance <= solid.inradius + tolerance);
                touched += distance >= solid.inradius - tolerance;
            }
            assert_int_equal(touched, known(kind).sides_of_a_face);
        }
    }
}

/* Both ends of an edge lie on both of its faces, which meet at the dihedral angle. */
TEST(test_edges) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic solid;
        hd_platonic(kind, &solid);
        for (int e = 0; e < solid.edge_count; e++) {
            const HdPlatonicEdge edge = solid.edge[e];
            const HdVec3 a = solid.vertex[edge.vertex[0]], b = solid.vertex[edge.vertex[1]];
            const HdVec3 m = solid.face_normal[edge.face[0]], n = solid.face_normal[edge.face[1]];
            assert_true(edge.vertex[0] < edge.vertex[1] && edge.face[0] < edge.face[1]);
            expect_near(hd_length(hd_sub(a, b)), known(kind).edge_length, tolerance);
            expect_near(hd_dot(m, a), solid.inradius, tolerance);
            expect_near(hd_dot(m, b), solid.inradius, tolerance);
            expect_near(hd_dot(n, a), solid.inradius, tolerance);
            expect_near(hd_dot(n, b), solid.inradius, tolerance);
            /* The angle between outward normals is the dihedral angle's supplement. */
            expect_near(hd_dot(m, n), -known(kind).cosine_of_dihedral, tolerance);
            for (int i = 0; i < e; i++)
                assert_false(solid.edge[i].vertex[0] == edge.vertex[0] &&
                             solid.edge[i].vertex[1] == edge.vertex[1]);
        }
    }
}

static int has_point(const HdVec3 *points, int count, HdVec3 wanted) {
    for (int i = 0; i < count; i++)
        if (hd_length(hd_sub(points[i], wanted)) < tolerance)
            return 1;
    return 0;
}

TEST(test_orientations) {
    const double c = 1.0 / sqrt(3.0);
    const double phi = (1.0 + sqrt(5.0)) / 2.0;
    const double length = sqrt(1.0 + phi * phi);
    HdPlatonic solid;
    hd_platonic(HD_TETRAHEDRON, &solid);
    assert_true(has_point(solid.vertex, 4, hd_vec3(c, c, c)));
    assert_true(has_point(solid.vertex, 4, hd_vec3(c, -c, -c)));
    hd_platonic(HD_HEXAHEDRON, &solid);
    assert_true(has_point(solid.face_normal, 6, hd_vec3(0.0, 0.0, 1.0)));
    assert_true(has_point(solid.face_normal, 6, hd_vec3(-1.0, 0.0, 0.0)));
    hd_platonic(HD_OCTAHEDRON, &solid);
    assert_true(has_point(solid.vertex, 6, hd_vec3(0.0, -1.0, 0.0)));
    hd_platonic(HD_DODECAHEDRON, &solid);
    for (int i = 0; i < 8; i++)
        assert_true(has_point(solid.vertex, 20,
                              hd_vec3((i & 4) ? c : -c, (i & 2) ? c : -c, (i & 1) ? c : -c)));
    assert_true(has_point(solid.face_normal, 12, hd_vec3(0.0, 1.0 / length, phi / length)));
    hd_platonic(HD_ICOSAHEDRON, &solid);
    assert_true(has_point(solid.vertex, 12, hd_vec3(0.0, 1.0 / length, phi / length)));
    assert_true(has_point(solid.vertex, 12, hd_vec3(-phi / length, 0.0, 1.0 / length)));
    assert_true(has_point(solid.vertex, 12, hd_vec3(1.0 / length, -phi / length, 0.0)));
}

TEST(test_the_same_every_time) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic first, second;
        memset(&first, 0xff, sizeof first);
        memset(&second, 0x00, sizeof second);
        hd_platonic(kind, &first);
        hd_platonic(kind, &second);
        assert_memory_equal(first.vertex, second.vertex, sizeof first.vertex);
        assert_memory_equal(first.face_normal, second.face_normal, sizeof first.face_normal);
        assert_memory_equal(first.edge, second.edge, sizeof first.edge);
    }
}

static HdVec3 turned(HdVec3 point, HdVec3 degrees) {
    HdPlatonic solid = {.vertex_count = 1, .vertex = {point}};
    hd_platonic_rotate(&solid, degrees);
    return solid.vertex[0];
}

static void expect_vector(HdVec3 actual, double x, double y, double z, double off) {
    expect_near(actual.x, x, off);
    expect_near(actual.y, y, off);
    expect_near(actual.z, z, off);
}

TEST(test_quarter_turns) {
    const HdVec3 x = {1.0, 0.0, 0.0}, y = {0.0, 1.0, 0.0}, z = {0.0, 0.0, 1.0};
    const double off = 1e-15;
    expect_vector(turned(y, hd_vec3(90.0, 0.0, 0.0)), 0.0, 0.0, 1.0, off);
    expect_vector(turned(z, hd_vec3(0.0, 90.0, 0.0)), 1.0, 0.0, 0.0, off);
    expect_vector(turned(x, hd_vec3(0.0, 0.0, 90.0)), 0.0, 1.0, 0.0, off);
    expect_vector(turned(x, hd_vec3(90.0, 0.0, 0.0)), 1.0, 0.0, 0.0, off);
    expect_vector(turned(y, hd_vec3(0.0, 90.0, 0.0)), 0.0, 1.0, 0.0, off);
    expect_vector(turned(z, hd_vec3(0.0, 0.0, 90.0)), 0.0, 0.0, 1.0, off);
    /* About x first: y to z; then about y: z to x; then about z: x to y. */
    expect_vector(turned(y, hd_vec3(90.0, 90.0, 0.0)), 1.0, 0.0, 0.0, off);
    expect_vector(turned(z, hd_vec3(0.0, 90.0, 90.0)), 0.0, 1.0, 0.0, off);
    expect_vector(turned(y, hd_vec3(90.0, 0.0, 90.0)), 0.0, 0.0, 1.0, off);
    expect_vector(turned(y, hd_vec3(90.0, 90.0, 90.0)), 0.0, 1.0, 0.0, off);
}

static const HdVec3 rotations[] = {{30.0, 0.0, 0.0},   {0.0, -75.0, 0.0},    {0.0, 0.0, 123.0},
                                   {10.0, 20.0, 30.0}, {-200.0, 400.0, 1e6}, {1e-7, 0.0, -1e-7}};
enum { ROTATIONS = sizeof rotations / sizeof rotations[0] };

TEST(test_rotations_keep_lengths_and_angles) {
    for (int i = 0; i < ROTATIONS; i++) {
        const HdVec3 x = turned(hd_vec3(1.0, 0.0, 0.0), rotations[i]);
        const HdVec3 y = turned(hd_vec3(0.0, 1.0, 0.0), rotations[i]);
        const HdVec3 z = turned(hd_vec3(0.0, 0.0, 1.0), rotations[i]);
        expect_near(hd_dot(x, x), 1.0, 1e-15);
        expect_near(hd_dot(y, y), 1.0, 1e-15);
        expect_near(hd_dot(z, z), 1.0, 1e-15);
        const HdVec3 across = hd_cross(x, y); /* right-handed still */
        expect_vector(z, across.x, across.y, across.z, 1e-15);
    }
}

/* Against the matrices, multiplied out with the C library's sine and cosine. */
TEST(test_rotations_follow_the_formula) {
    const double degree = acos(-1.0) / 180.0;
    for (int i = 0; i < ROTATIONS; i++) {
        const double a = rotations[i].x * degree, b = rotations[i].y * degree;
        const double c = rotations[i].z * degree;
        const HdVec3 x = turned(hd_vec3(1.0, 0.0, 0.0), rotations[i]);
        const HdVec3 z = turned(hd_vec3(0.0, 0.0, 1.0), rotations[i]);
        expect_vector(x, cos(c) * cos(b), sin(c) * cos(b), -sin(b), 1e-11);
        expect_vector(z, cos(c) * sin(b) * cos(a) + sin(c) * sin(a),
                      sin(c) * sin(b) * cos(a) - cos(c) * sin(a), cos(b) * cos(a), 1e-11);
    }
}

TEST(test_turned_by_nothing) {
    const HdVec3 nothing[2] = {{0.0, 0.0, 0.0}, {-0.0, 0.0, -0.0}};
    const HdVec3 point = turned(hd_vec3(-0.0, -0.0, -0.0), nothing[0]); /* signs are kept, too */
    assert_true(signbit(point.x) && signbit(point.y) && signbit(point.z));
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++)
        for (int i = 0; i < 2; i++) {
            HdPlatonic before, after;
            hd_platonic(kind, &before);
            hd_platonic(kind, &after);
            hd_platonic_rotate(&after, nothing[i]);
            assert_memory_equal(before.vertex, after.vertex, sizeof before.vertex);
            assert_memory_equal(before.face_normal, after.face_normal, sizeof before.face_normal);
        }
}

static void expect_edges_on_their_faces(const HdPlatonic *solid) {
    for (int e = 0; e < solid->edge_count; e++)
        for (int i = 0; i < 4; i++)
            expect_near(hd_dot(solid->face_normal[solid->edge[e].face[i & 1]],
                               solid->vertex[solid->edge[e].vertex[i >> 1]]),
                        solid->inradius, tolerance);
}

TEST(test_turned_solids_hold_together) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++)
        for (int i = 0; i < ROTATIONS; i++) {
            HdPlatonic solid, plain;
            hd_platonic(kind, &plain);
            hd_platonic(kind, &solid);
            hd_platonic_rotate(&solid, rotations[i]);
            expect_edges_on_their_faces(&solid);
            assert_memory_equal(solid.edge, plain.edge, sizeof solid.edge);
            for (int v = 0; v < solid.vertex_count; v++) {
                const HdVec3 vertex = turned(plain.vertex[v], rotations[i]);
                expect_vector(solid.vertex[v], vertex.x, vertex.y, vertex.z, 0.0);
            }
        }
}
