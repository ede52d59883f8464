/* SPDX-License-Identifier: MIT */
#include "scene/platonic.h"
#include "unit_test.h"

static const double tolerance = 4e-15;

/* Closed forms from H. S. M. Coxeter, Regular Polytopes, table I, for the circumradius 1. */
typedef struct Known {
    int faces, vertices, edges;
    double edge_length, inradius, cosine_of_dihedral;
} Known;

static Known known(HdSolidKind kind) {
    const double root5 = sqrt(5.0), phi = (1.0 + root5) / 2.0;
    const double round = sqrt((5.0 + 2.0 * root5) / 15.0);
    switch (kind) {
    case HD_TETRAHEDRON:
        return (Known){4, 4, 6, sqrt(8.0 / 3.0), 1.0 / 3.0, 1.0 / 3.0};
    case HD_HEXAHEDRON:
        return (Known){6, 8, 12, 2.0 / sqrt(3.0), 1.0 / sqrt(3.0), 0.0};
    case HD_OCTAHEDRON:
        return (Known){8, 6, 12, sqrt(2.0), 1.0 / sqrt(3.0), -1.0 / 3.0};
    case HD_DODECAHEDRON:
        return (Known){12, 20, 30, 2.0 / (sqrt(3.0) * phi), round, -1.0 / root5};
    default:
        return (Known){20, 12, 30, 1.0 / sqrt((5.0 + root5) / 8.0), round, -root5 / 3.0};
    }
}

/* Both ends of an edge lie on both of its faces, which meet at the dihedral angle. */
static void expect_edges(const HdPlatonic *solid, const Known *expected) {
    for (int e = 0; e < solid->edge_count; e++) {
        const HdPlatonicEdge edge = solid->edge[e];
        const HdVec3 along = hd_sub(solid->vertex[edge.vertex[0]], solid->vertex[edge.vertex[1]]);
        assert_true(edge.vertex[0] < edge.vertex[1] && edge.face[0] < edge.face[1]);
        for (int i = 0; i < 4; i++)
            expect_near(
                hd_dot(solid->face_normal[edge.face[i & 1]], solid->vertex[edge.vertex[i >> 1]]),
                solid->inradius, tolerance);
        expect_near(hd_length(along), expected->edge_length, tolerance);
        /* The angle between outward normals is the dihedral angle's supplement. */
        expect_near(hd_dot(solid->face_normal[edge.face[0]], solid->face_normal[edge.face[1]]),
                    -expected->cosine_of_dihedral, tolerance);
        for (int i = 0; i < e; i++)
            assert_memory_not_equal(solid->edge[i].vertex, edge.vertex, sizeof edge.vertex);
    }
}

TEST(test_solids) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic solid;
        hd_platonic(kind, &solid);
        const Known expected = known(kind);
        const double cosine = expected.cosine_of_dihedral;
        assert_int_equal(solid.face_count, expected.faces);
        assert_int_equal(solid.vertex_count, expected.vertices);
        assert_int_equal(solid.edge_count, expected.edges);
        expect_near(solid.edge_length, expected.edge_length, tolerance);
        expect_near(solid.inradius, expected.inradius, tolerance);
        expect_near(solid.sine_of_dihedral, sqrt(1.0 - cosine * cosine), tolerance);
        expect_edges(&solid, &expected);
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

static const HdVec3 rotations[] = {{30.0, 0.0, 0.0},   {0.0, -75.0, 0.0},    {0.0, 0.0, 123.0},
                                   {10.0, 20.0, 30.0}, {-200.0, 400.0, 1e6}, {1e-7, 0.0, -1e-7}};
enum { ROTATIONS = sizeof rotations / sizeof rotations[0] };

/* The rotated axes against the matrices, multiplied out with the C library's sine and cosine; they
   keep lengths and angles. */
TEST(test_rotations) {
    const double degree = acos(-1.0) / 180.0;
    for (int i = 0; i < ROTATIONS; i++) {
        const double a = rotations[i].x * degree, b = rotations[i].y * degree;
        const double c = rotations[i].z * degree;
        const HdVec3 x = turned(hd_vec3(1.0, 0.0, 0.0), rotations[i]);
        const HdVec3 y = turned(hd_vec3(0.0, 1.0, 0.0), rotations[i]);
        const HdVec3 z = turned(hd_vec3(0.0, 0.0, 1.0), rotations[i]);
        expect_vector(x, cos(c) * cos(b), sin(c) * cos(b), -sin(b), 1e-11);
        expect_vector(z, cos(c) * sin(b) * cos(a) + sin(c) * sin(a),
                      sin(c) * sin(b) * cos(a) - cos(c) * sin(a), cos(b) * cos(a), 1e-11);
        expect_near(hd_dot(x, x), 1.0, 1e-15);
        expect_near(hd_dot(y, y), 1.0, 1e-15);
        const HdVec3 across = hd_cross(x, y); /* right-handed still */
        expect_vector(z, across.x, across.y, across.z, 1e-15);
    }
}

/* To the last bit, signs of zeros among them. */
TEST(test_turned_by_nothing) {
    const HdVec3 point = turned(hd_vec3(-0.0, -0.0, -0.0), hd_vec3(-0.0, 0.0, -0.0));
    assert_true(signbit(point.x) && signbit(point.y) && signbit(point.z));
}
