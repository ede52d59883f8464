/* SPDX-License-Identifier: MIT */
/* Triangulates solids and the floor. */
#include <stdio.h>
#include <stdlib.h>

#include "scene/triangulate.h"
#include "unit_test.h"

/* Sizes of the drawing on a face, in circumradii. */
static const double min_length = 1e-8;

/* In units of the circumradius. */
typedef struct Pattern {
    double rim_width, disc_radius;
    int per_edge, colour_count;
} Pattern;

static const Pattern patterns[] = {
    {0.0, 0.0, 0, 1},     /* bare */
    {0.04, 0.0, 0, 1},    /* rim alone */
    {0.0, 0.02, 3, 1},    /* discs alone */
    {0.04, 0.02, 6, 3},   /* discs on the rim */
    {0.02, 0.05, 2, 2},   /* discs larger than the rim */
    {0.03, 0.03, 4, 30},  /* discs as large as the rim is wide */
    {0.04, 0.0, 5, 1},    /* lights without discs */
    {0.04, 0.02, 0, 1},   /* discs without lights */
    {0.9, 0.02, 3, 3},    /* everything is rim */
    {0.02, 0.2, 4, 4},    /* discs that overlap, round corners as well */
    {0.05, 0.6, 1, 5},    /* discs that reach other faces */
    {0.05, 0.6, 3, 30},   /* and overlap */
    {0.05, 5.0, 3, 30},   /* discs that cover the whole solid */
    {0.04, 0.02, 20, 3},  /* many */
    {0.02, 3e-5, 2, 1},   /* tiny, with long and thin triangles between */
    {1e-6, 1e-6, 2, 2},   /* barely visible */
    {1e-10, 1e-10, 2, 2}, /* indistinguishable from nothing */
};
enum { PATTERNS = sizeof patterns / sizeof patterns[0] };

static HdSolid solid_with(HdSolidKind kind, const Pattern *pattern) {
    static const double circumradius = 1.7;
    HdSolid solid = {
        .kind = kind,
        .centre = {10.0, -20.0, 30.0},
        .circumradius = circumradius,
        .rotation_degrees = {20.0, -35.0, 70.0},
        .face = {.colour = {0.1, 0.2, 0.3}, .transmission = 0.5, .index_of_refraction = 1.5},
        .rim = {.colour = {0.3, 0.2, 0.1}, .ambient = 0.25, .index_of_refraction = 1.0},
        .rim_width = pattern->rim_width * circumradius,
        .lights = {.per_edge = pattern->per_edge,
                   .colour_count = pattern->colour_count,
                   .disc_radius = pattern->disc_radius * circumradius,
                   .disc_radiance = 2.0},
    };
    for (int i = 0; i < pattern->colour_count; i++)
        solid.lights.colours[i] = hd_vec3(0.5, i / 30.0, 0.25);
    return solid;
}

static HdVec3 corner_of(const HdMesh *mesh, int triangle, int corner) {
    return mesh->vertices[mesh->corners[triangle][corner]];
}

/* Returns half the cross product of two edges: along the normal, as long as the area. */
static HdVec3 area_vector(const HdMesh *mesh, int triangle) {
    HdVec3 a = corner_of(mesh, triangle, 0);
    return hd_scale(
        hd_cross(hd_sub(corner_of(mesh, triangle, 1), a), hd_sub(corner_of(mesh, triangle, 2), a)),
        0.5);
}

static int compare_pairs(const void *left, const void *right) {
    const int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
    return (a > b) - (a < b);
}

/* Expects each directed edge once, and once the other way; no hole, no handle, no unused vertex. */
static void expect_closed(const HdMesh *mesh) {
    const size_t count = 3 * (size_t)mesh->triangle_count;
    int64_t *edges = malloc(count * sizeof *edges);
    for (size_t i = 0; i < count; i++) {
        const int32_t *corners = mesh->corners[i / 3];
        assert_in_range(corners[i % 3], 0, mesh->vertex_count - 1);
        edges[i] = (int64_t)corners[i % 3] << 32 | corners[(i + 1) % 3];
    }
    qsort(edges, count, sizeof *edges, compare_pairs);
    for (size_t i = 0; i < count; i++) {
        const int64_t back = (edges[i] & INT32_MAX) << 32 | edges[i] >> 32;
        assert_true(i == 0 || edges[i - 1] < edges[i]);
        assert_non_null(bsearch(&back, edges, count, sizeof *edges, compare_pairs));
    }
    assert_int_equal(mesh->vertex_count - (int)count / 2 + mesh->triangle_count, 2);
    free(edges);
}

/* Expects each triangle to have an area and lie in the face that its group names, outer side
   out. */
static void expect_on_faces(const HdMesh *mesh, const HdSolid *solid) {
    HdPlatonic shape = hd_solid_shape(solid);
    for (int t = 0; t < mesh->triangle_count; t++) {
        int face = mesh->group_of[t] - 1;
        assert_in_range(face, 0, shape.face_count - 1);
        HdVec3 normal = shape.face_normal[face], area = area_vector(mesh, t);
        assert_true(hd_dot(area, normal) > 0.0);
        for (int i = 0; i < 3; i++)
            expect_near(hd_dot(normal, corner_of(mesh, t, i)), shape.inradius * solid->circumradius,
                        1e-14);
    }
}

enum { MAX_MATERIALS = HD_SOLID_MATERIAL_DISCS + 2 * HD_MAX_EDGE_COLOURS };

/* Returns the share of a face that is nearer to an edge than the rim is wide. */
static double rim_share(const HdPlatonic *shape, double width) {
    double half = 0.5 * shape->edge_length;
    double left = 1.0 - width / sqrt(1.0 - shape->inradius * shape->inradius - half * half);
    return left > 0.0 ? 1.0 - left * left : 1.0;
}

/* Returns a face's area by the formula for regular polygons, from the number of its sides and the
   length of an edge. */
static double surface_of(const HdPlatonic *shape) {
    double sides = 2.0 * shape->edge_count / shape->face_count;
    return shape->face_count * sides * shape->edge_length * shape->edge_length /
           (4.0 * tan(acos(-1.0) / sides));
}

static void expect_areas(const HdMesh *mesh, const HdSolid *solid, const Pattern *pattern) {
    HdPlatonic shape;
    double areas[MAX_MATERIALS], all = 0.0, discs = 0.0, rim;
    hd_platonic(solid->kind, &shape);
    for (int m = 0; m < mesh->material_count; m++)
        areas[m] = 0.0;
    for (int t = 0; t < mesh->triangle_count; t++)
        areas[mesh->material_of[t]] += hd_length(area_vector(mesh, t));
    double unit = solid->circumradius * solid->circumradius, surface = unit * surface_of(&shape);
    rim = areas[HD_SOLID_MATERIAL_RIM];
    for (int m = 0; m < mesh->material_count; m++) {
        bool is_disc = m >= HD_SOLID_MATERIAL_DISCS;
        all += areas[m];
        discs += is_disc ? areas[m] : 0.0;
        rim += is_disc && mesh->materials[m].passes_as == HD_SOLID_MATERIAL_RIM ? areas[m] : 0.0;
    }
    expect_near(all, surface, 1e-12 * surface);
    double width = pattern->rim_width > min_length ? pattern->rim_width : 0.0;
    expect_near(rim, surface * rim_share(&shape, width), 1e-12 * surface);
    if (pattern->disc_radius * 4.1 < shape.edge_length / (pattern->per_edge + 1e-9)) {
        double radius = pattern->disc_radius;
        int count = radius > min_length ? shape.edge_count * pattern->per_edge : 0;
        expect_near(discs, unit * count * acos(-1.0) * radius * radius, 1e-12 * surface);
    }
}

static void expect_materials(const HdMesh *mesh, const HdSolid *solid, bool has_discs) {
    int colours = has_discs ? solid->lights.colour_count : 0;
    assert_int_equal(mesh->material_count, HD_SOLID_MATERIAL_DISCS + 2 * colours);
    const HdMeshMaterial *face = &mesh->materials[HD_SOLID_MATERIAL_FACE];
    const HdMeshMaterial *rim = &mesh->materials[HD_SOLID_MATERIAL_RIM];
    assert_memory_equal(&face->material, &solid->face, sizeof solid->face);
    assert_memory_equal(&rim->material, &solid->rim, sizeof solid->rim);
    assert_true(face->passes_as == -1 && rim->passes_as == -1);
    for (int i = 0; i < 2 * colours; i++) {
        const HdMeshMaterial *disc = &mesh->materials[HD_SOLID_MATERIAL_DISCS + i];
        HdVec3 radiance = hd_scale(solid->lights.colours[i / 2], solid->lights.disc_radiance);
        assert_memory_equal(&disc->emission, &radiance, sizeof radiance);
        assert_true(disc->material.diffuse == 0.0 && disc->material.transmission == 0.0);
        assert_int_equal(disc->passes_as,
                         i % 2 == 1 ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE);
    }
}

/* Returns the kernels' result (surface.h) for a point relative to the centre, with other widths
   than the solid's. It is twice the number of the edge whose disc is visible, or -2, and 1 more on
   the rim. */
static int by_rule(const HdSolid *solid, const HdPlatonic *shape, int face, HdVec3 point,
                   double rim_width, double disc_radius) {
    double nearest = -HUGE_VAL;
    for (int f = 0; f < shape->face_count; f++)
        if (f != face)
            nearest = fmax(nearest, hd_dot(shape->face_normal[f], point) -
                                        shape->inradius * solid->circumradius);
    const bool on_rim = rim_width > 0.0 && -rim_width * shape->sine_of_dihedral < nearest;
    const int count = solid->lights.per_edge;
    int shown = on_rim - 2;
    if (count == 0 || !(-disc_radius * shape->sine_of_dihedral < nearest))
        return shown;
    double length = shape->edge_length * solid->circumradius;
    for (int e = 0; e < shape->edge_count; e++) {
        HdVec3 a = hd_scale(shape->vertex[shape->edge[e].vertex[0]], solid->circumradius);
        HdVec3 b = hd_scale(shape->vertex[shape->edge[e].vertex[1]], solid->circumradius);
        HdVec3 direction = hd_normalize(hd_sub(b, a));
        double along = hd_dot(hd_sub(point, a), direction);
        double cell = fmin(fmax(floor(along / length * count), 0.0), count - 1.0);
        HdVec3 light = hd_add(a, hd_scale(direction, (cell + 0.5) / count * length));
        if (hd_length(hd_sub(point, light)) < disc_radius)
            shown = 2 * e + on_rim;
    }
    return shown;
}

/* Returns the distance between the borders of a regular polygon and of a disc of radius 1 with its
   area. */
static double off_disc(int sides) {
    double part = acos(-1.0) / sides, corner = sqrt(2.0 * part / sin(2.0 * part));
    return fmax(corner - 1.0, 1.0 - corner * cos(part));
}

/* Checks a point in each of many triangles, except those that slightly larger or smaller discs and
   rims would change: a polygon may lie on the other side of the border. That is little of the
   surface. */
static void expect_rule(const HdMesh *mesh, const HdSolid *solid, int disc_sides) {
    HdPlatonic shape = hd_solid_shape(solid);
    const double vagueness = 1.1 * off_disc(disc_sides);
    const double rim = solid->rim_width, disc = solid->lights.disc_radius;
    double all = 0.0, vague = 0.0;
    for (int t = 0; t < mesh->triangle_count; t += 1 + mesh->triangle_count / 400) {
        HdVec3 inside = hd_scale(corner_of(mesh, t, 0), 0.5);
        inside = hd_add(inside, hd_scale(corner_of(mesh, t, 1), 0.3));
        inside = hd_add(inside, hd_scale(corner_of(mesh, t, 2), 0.2));
        const int face = mesh->group_of[t] - 1;
        const int shown = by_rule(solid, &shape, face, inside, rim, disc);
        const int expected =
            shown >= 0    ? HD_SOLID_MATERIAL_DISCS + shown % (2 * solid->lights.colour_count)
            : shown == -1 ? HD_SOLID_MATERIAL_RIM
                          : HD_SOLID_MATERIAL_FACE;
        bool is_vague = false;
        for (int k = 0; k < 4; k++) {
            double change = k & 1 ? vagueness : -vagueness, shift = k & 2 ? 3e-9 : -3e-9;
            is_vague |= by_rule(solid, &shape, face, inside, rim > 0.0 ? rim + shift : 0.0,
                                disc * (1.0 + change) + shift) != shown;
        }
        all += hd_length(area_vector(mesh, t));
        vague += is_vague ? hd_length(area_vector(mesh, t)) : 0.0;
        if (!is_vague && mesh->material_of[t] != expected)
            fail_msg("kind %d, rim %g, discs %g, %d an edge: triangle %d of face %d has material "
                     "%d, expected %d",
                     (int)solid->kind, rim, disc, solid->lights.per_edge, t, face,
                     mesh->material_of[t], expected);
    }
    assert_true(vague < 0.25 * all);
}

static void expect_sound(HdSolidKind kind, const Pattern *pattern, int disc_sides, int divisions) {
    static const int bare_triangles[] = {4, 12, 8, 36, 20};
    HdSolid solid = solid_with(kind, pattern);
    HdPlatonic shape = hd_solid_shape(&solid);
    HdMesh mesh;
    HdError error;
    assert_int_equal(hd_triangulate_solid(&mesh, &solid, disc_sides, divisions, &error), HD_OK);
    /* Slightly more than needed. Half a disc of n sides has n / 2 + 1 corners, those on the edge
       among them; a rim p inside. */
    if (pattern == &patterns[0])
        assert_int_equal(mesh.triangle_count, bare_triangles[kind] * divisions * divisions);
    if (pattern == &patterns[3] && disc_sides == 16)
        assert_in_range(mesh.vertex_count, 0,
                        2 * (shape.vertex_count + shape.edge_count * (2 + 6 * (2 + 2 * 7))));
    expect_closed(&mesh);
    expect_on_faces(&mesh, &solid);
    expect_areas(&mesh, &solid, pattern);
    expect_materials(&mesh, &solid, pattern->per_edge > 0 && pattern->disc_radius > min_length);
    expect_rule(&mesh, &solid, disc_sides);
    hd_mesh_free(&mesh);
}

/* Closed, as large as the solid, with the kernels' materials. Tetrahedra, which take least time,
   have rounder discs, except tiny ones, whose sides would be too short. */
TEST(test_patterns) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        static const double differences[] = {0.0, 1e-16, -1e-16, 1e-10, -1e-10};
        HdPlatonic shape;
        hd_platonic(kind, &shape);
        for (int i = 0; i < PATTERNS; i++) {
            bool is_round = kind == HD_TETRAHEDRON && patterns[i].disc_radius > 1e-4;
            expect_sound(kind, &patterns[i], is_round ? 64 : 16,
                         i % 4 == 0 ? 2 + (int)kind % 2 : 1);
        }
        /* Rims as wide as the circle in a face, up to rounding and by a little more or less. */
        const double half = 0.5 * shape.edge_length;
        for (int i = 0; i < 5; i++) {
            Pattern pattern = {sqrt(1.0 - shape.inradius * shape.inradius - half * half), 0.0, 0,
                               1};
            pattern.rim_width += differences[i];
            expect_sound(kind, &pattern, 16, 1);
        }
    }
}

TEST(test_bad_numbers) {
    static const struct {
        int disc_sides, divisions;
        const char *message;
    } cases[] = {
        {15, 1, "discs have 15 sides, expected an even number from 8 to 256"},
        {6, 1, "discs have 6 sides, expected an even number from 8 to 256"},
        {258, 1, "discs have 258 sides, expected an even number from 8 to 256"},
        {16, 0, "divisions are 0, expected at least 1"},
        {16, 3000,
         "4528 triangles divided into 3000 x 3000 each are too many, expected at most 100000000 "
         "together"},
        {16, INT32_MAX,
         "4528 triangles divided into 2147483647 x 2147483647 each are too many, expected at most "
         "100000000 together"}};
    const HdSolid solid = solid_with(HD_HEXAHEDRON, &patterns[3]);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        HdMesh mesh;
        HdError error;
        assert_int_equal(
            hd_triangulate_solid(&mesh, &solid, cases[i].disc_sides, cases[i].divisions, &error),
            HD_BAD_INPUT);
        assert_string_equal(error.message, cases[i].message);
        assert_null(mesh.materials);
    }
}

/* Expects each triangle where its texture coordinates say, and all of them to cover the floor. */
static void expect_floor(const HdFloor *floor, int divisions, double area) {
    HdMesh mesh;
    HdError error;
    assert_int_equal(hd_triangulate_floor(&mesh, floor, divisions, &error), HD_OK);
    assert_int_equal(mesh.triangle_count, 2 * divisions * divisions);
    assert_int_equal(mesh.vertex_count, (divisions + 1) * (divisions + 1));
    assert_true(mesh.uv_count == mesh.vertex_count && mesh.materials[0].passes_as == -1);
    assert_int_equal(mesh.materials[0].material.shininess, 7);
    const HdVec3 *c = floor->corners;
    HdVec3 normal = hd_normalize(hd_cross(hd_sub(c[2], c[0]), hd_sub(c[3], c[1])));
    HdVec3 centre = hd_floor_centre(floor);
    double sum = 0.0;
    for (int t = 0; t < mesh.triangle_count; t++) {
        sum += hd_dot(normal, area_vector(&mesh, t));
        assert_true(hd_dot(normal, area_vector(&mesh, t)) > 0.0);
        assert_int_equal(mesh.group_of[t], 1);
        for (int i = 0; i < 3; i++) {
            const double *uv = mesh.uvs[mesh.corner_uvs[t][i]];
            double s = uv[0], v = 1.0 - uv[1]; /* downwards */
            double shares[4] = {(1.0 - s) * (1.0 - v), s * (1.0 - v), s * v, (1.0 - s) * v};
            HdVec3 expected = hd_scale(centre, -1.0);
            for (int k = 0; k < 4; k++)
                expected = hd_add(expected, hd_scale(c[k], shares[k]));
            expect_near(hd_length(hd_sub(expected, corner_of(&mesh, t, i))), 0.0, 1e-14);
        }
    }
    expect_near(sum, area, 1e-13 * area);
    hd_mesh_free(&mesh);
}

TEST(test_floor) {
    const HdFloor square = {.corners = {{-1, 3, -1}, {3, 3, -1}, {3, -1, -1}, {-1, -1, -1}},
                            .material.shininess = 7};
    const HdFloor uneven = {.corners = {{0, 0, 2}, {4, 0, 2}, {3, 2, 2}, {1, 2, 2}},
                            .material.shininess = 7};
    for (int n = 1; n < 4; n++) {
        expect_floor(&square, n, 16.0);
        expect_floor(&uneven, n, 6.0);
    }
    HdMesh mesh;
    HdError error;
    assert_int_equal(hd_triangulate_floor(&mesh, &square, 0, &error), HD_BAD_INPUT);
    assert_null(mesh.materials);
}
