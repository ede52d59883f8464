/* SPDX-License-Identifier: MIT */
/* Solids and the floor as triangles. */
#include <stdio.h>
#include <stdlib.h>

#include "scene/triangulate/solid.h"
#include "unit_test.h"

static const char *const kind_names[] = {"tetrahedron", "hexahedron", "octahedron", "dodecahedron",
                                         "icosahedron"};

/* Of what is drawn on a face, in circumradii. */
static const double least_length = 1e-8;

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
    {0.04, 0.009, 50, 3}, /* many */
    {1e-6, 1e-6, 2, 2},   /* hardly to be seen */
    {1e-10, 1e-10, 2, 2}, /* not to be told from nothing */
};
enum { PATTERNS = sizeof patterns / sizeof patterns[0] };

static double random_share(void) {
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) * 0x1p-53;
}

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

static HdMesh triangulate(const HdSolid *solid, int disc_sides, int divisions) {
    HdMesh mesh;
    HdError error;
    if (hd_triangulate_solid(&mesh, solid, disc_sides, divisions, &error) != HD_OK)
        fail_msg("%s: %s", kind_names[solid->kind], error.message);
    return mesh;
}

static HdVec3 corner_of(const HdMesh *mesh, int triangle, int corner) {
    return mesh->vertices[mesh->corners[triangle][corner]];
}

/* Half the cross product of two edges: along the normal, as long as the area. */
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

/* Each directed edge once, and once the other way; every vertex used; no hole, no handle. */
static void expect_closed(const HdMesh *mesh) {
    int count = 3 * mesh->triangle_count, used = 0;
    int64_t *there = malloc((size_t)count * sizeof *there);
    int64_t *back = malloc((size_t)count * sizeof *back);
    char *is_used = calloc((size_t)mesh->vertex_count, 1);
    for (int i = 0; i < count; i++) {
        int a = mesh->corners[i / 3][i % 3], b = mesh->corners[i / 3][(i + 1) % 3];
        assert_in_range(a, 0, mesh->vertex_count - 1);
        there[i] = (int64_t)a << 32 | b;
        back[i] = (int64_t)b << 32 | a;
        used += !is_used[a];
        is_used[a] = 1;
    }
    qsort(there, (size_t)count, sizeof *there, compare_pairs);
    qsort(back, (size_t)count, sizeof *back, compare_pairs);
    assert_memory_equal(there, back, (size_t)count * sizeof *there);
    for (int i = 1; i < count; i++)
        assert_true(there[i - 1] < there[i]);
    assert_int_equal(used, mesh->vertex_count);
    assert_int_equal(mesh->vertex_count - count / 2 + mesh->triangle_count, 2);
    free(there);
    free(back);
    free(is_used);
}

static bool is_within_edge(HdVec3 point, HdVec3 a, HdVec3 b) {
    HdVec3 way = hd_sub(b, a), offset = hd_sub(point, a);
    double along = hd_dot(way, offset) / hd_dot(way, way);
    return along > 0.0 && along < 1.0 && hd_length(hd_sub(offset, hd_scale(way, along))) < 1e-13;
}

/* No two vertices at one place, none within an edge. */
static void expect_no_corner_within_an_edge(const HdMesh *mesh) {
    for (int t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            if (mesh->corners[t][i] > mesh->corners[t][(i + 1) % 3])
                continue; /* the other triangle's turn */
            HdVec3 a = corner_of(mesh, t, i), b = corner_of(mesh, t, (i + 1) % 3);
            HdVec3 middle = hd_scale(hd_add(a, b), 0.5);
            double reach = 0.5 * hd_length(hd_sub(b, a)) + 2e-9;
            for (int v = 0; v < mesh->vertex_count; v++) {
                HdVec3 offset = hd_sub(mesh->vertices[v], middle);
                if (v == mesh->corners[t][i] || v == mesh->corners[t][(i + 1) % 3] ||
                    hd_dot(offset, offset) > reach * reach) /* most are far from the edge */
                    continue;
                assert_true(hd_length(hd_sub(mesh->vertices[v], a)) > 1e-9);
                if (is_within_edge(mesh->vertices[v], a, b))
                    fail_msg("vertex %d lies within an edge of triangle %d", v, t);
            }
        }
}

/* Each triangle has an area and lies in the face that its group names, outer side out. */
static void expect_on_faces(const HdMesh *mesh, const HdSolid *solid) {
    HdPlatonic shape;
    hd_platonic(solid->kind, &shape);
    hd_platonic_rotate(&shape, solid->rotation_degrees);
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

/* Sums by material. */
static void measure(const HdMesh *mesh, double *areas) {
    for (int m = 0; m < mesh->material_count; m++)
        areas[m] = 0.0;
    for (int t = 0; t < mesh->triangle_count; t++) {
        assert_in_range(mesh->material_of[t], 0, mesh->material_count - 1);
        areas[mesh->material_of[t]] += hd_length(area_vector(mesh, t));
    }
}

enum { MOST_MATERIALS = HD_SOLID_MATERIAL_DISCS + 2 * HD_MAX_EDGE_COLOURS };

/* The share of a face that is nearer to an edge than the rim is wide. */
static double rim_share(const HdPlatonic *shape, double width) {
    double half = 0.5 * shape->edge_length;
    double left = 1.0 - width / sqrt(1.0 - shape->inradius * shape->inradius - half * half);
    return left > 0.0 ? 1.0 - left * left : 1.0;
}

/* A face's area by the formula for regular polygons, from the number of its sides and the length
   of an edge. */
static double surface_of(const HdPlatonic *shape) {
    double sides = 2.0 * shape->edge_count / shape->face_count;
    return shape->face_count * sides * shape->edge_length * shape->edge_length /
           (4.0 * tan(acos(-1.0) / sides));
}

static bool discs_are_apart(const HdPlatonic *shape, const Pattern *pattern) {
    double spacing = shape->edge_length / (pattern->per_edge + 1e-9);
    return pattern->disc_radius * 4.1 < spacing;
}

static void expect_areas(const HdMesh *mesh, const HdSolid *solid, const Pattern *pattern) {
    HdPlatonic shape;
    double areas[MOST_MATERIALS], all = 0.0, discs = 0.0, rim;
    hd_platonic(solid->kind, &shape);
    measure(mesh, areas);
    double unit = solid->circumradius * solid->circumradius, surface = unit * surface_of(&shape);
    rim = areas[HD_SOLID_MATERIAL_RIM];
    for (int m = 0; m < mesh->material_count; m++) {
        bool is_disc = m >= HD_SOLID_MATERIAL_DISCS;
        all += areas[m];
        discs += is_disc ? areas[m] : 0.0;
        rim += is_disc && mesh->materials[m].passes_as == HD_SOLID_MATERIAL_RIM ? areas[m] : 0.0;
    }
    expect_near(all, surface, 1e-12 * surface);
    double width = pattern->rim_width > least_length ? pattern->rim_width : 0.0;
    expect_near(rim, surface * rim_share(&shape, width), 1e-12 * surface);
    if (discs_are_apart(&shape, pattern)) {
        double radius = pattern->disc_radius;
        int count = radius > least_length ? shape.edge_count * pattern->per_edge : 0;
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
    assert_int_equal(face->passes_as, -1);
    assert_int_equal(rim->passes_as, -1);
    assert_string_equal(face->name, "face");
    assert_string_equal(rim->name, "rim");
    for (int i = 0; i < 2 * colours; i++) {
        const HdMeshMaterial *disc = &mesh->materials[HD_SOLID_MATERIAL_DISCS + i];
        HdVec3 radiance = hd_scale(solid->lights.colours[i / 2], solid->lights.disc_radiance);
        assert_memory_equal(&disc->emission, &radiance, sizeof radiance);
        assert_true(disc->material.diffuse == 0.0 && disc->material.transmission == 0.0);
        assert_int_equal(disc->passes_as,
                         i % 2 == 1 ? HD_SOLID_MATERIAL_RIM : HD_SOLID_MATERIAL_FACE);
    }
}

/* What the kernels' rule (surface.h) says of a point relative to the centre. */
typedef struct Shown {
    int edge; /* whose disc is seen; -1: none */
    int on_rim;
} Shown;

/* With other widths than the solid's. */
static Shown by_rule(const HdSolid *solid, const HdPlatonic *shape, int face, HdVec3 point,
                     double rim_width, double disc_radius) {
    double nearest = -HUGE_VAL;
    for (int f = 0; f < shape->face_count; f++)
        if (f != face)
            nearest = fmax(nearest, hd_dot(shape->face_normal[f], point) -
                                        shape->inradius * solid->circumradius);
    Shown shown = {-1, rim_width > 0.0 && -rim_width * shape->sine_of_dihedral < nearest};
    int count = solid->lights.per_edge;
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
            shown.edge = e;
    }
    return shown;
}

/* Whether somewhat larger or smaller discs and rims would show another edge's disc or rim there;
   a polygon lies between two such discs. */
static bool is_near_a_border(const HdSolid *solid, const HdPlatonic *shape, int face, HdVec3 point,
                             double vagueness) {
    double rim = solid->rim_width, disc = solid->lights.disc_radius;
    Shown shown = by_rule(solid, shape, face, point, rim, disc);
    for (int k = 0; k < 4; k++) {
        double change = k & 1 ? vagueness : -vagueness, shift = k & 2 ? 3e-9 : -3e-9;
        Shown other = by_rule(solid, shape, face, point, rim > 0.0 ? rim + shift : 0.0,
                              disc * (1.0 + change) + shift);
        if (other.edge != shown.edge || other.on_rim != shown.on_rim)
            return true;
    }
    return false;
}

static HdVec3 random_point(const HdMesh *mesh, int triangle) {
    double s = random_share(), u = random_share();
    HdVec3 a = corner_of(mesh, triangle, 0);
    HdVec3 to_b = hd_sub(corner_of(mesh, triangle, 1), a);
    HdVec3 to_c = hd_sub(corner_of(mesh, triangle, 2), a);
    if (s + u > 1.0) {
        s = 1.0 - s;
        u = 1.0 - u;
    }
    return hd_add(a, hd_add(hd_scale(to_b, s), hd_scale(to_c, u)));
}

/* How far the border of a regular polygon is from that of a disc of radius 1 with its area. */
static double off_disc(int sides) {
    double part = acos(-1.0) / sides, corner = sqrt(2.0 * part / sin(2.0 * part));
    return fmax(corner - 1.0, 1.0 - corner * cos(part));
}

/* Random points of the triangles, but those so near to a border that a polygon may be on the other
   side of it than the disc; that is few points. */
static void expect_rule(const HdMesh *mesh, const HdSolid *solid, int disc_sides) {
    enum { POINTS = 2000 };
    HdPlatonic shape;
    double vagueness = 1.1 * off_disc(disc_sides);
    hd_platonic(solid->kind, &shape);
    hd_platonic_rotate(&shape, solid->rotation_degrees);
    double all = 0.0, vague = 0.0;
    for (int i = 0; i < POINTS; i++) {
        int t = (int)(random_share() * mesh->triangle_count), face = mesh->group_of[t] - 1;
        double area = hd_length(area_vector(mesh, t));
        HdVec3 point = random_point(mesh, t);
        all += area;
        if (is_near_a_border(solid, &shape, face, point, vagueness)) {
            vague += area;
            continue;
        }
        Shown shown =
            by_rule(solid, &shape, face, point, solid->rim_width, solid->lights.disc_radius);
        int disc = HD_SOLID_MATERIAL_DISCS + 2 * (shown.edge % solid->lights.colour_count);
        int expected = shown.edge >= 0 ? disc + shown.on_rim
                       : shown.on_rim  ? HD_SOLID_MATERIAL_RIM
                                       : HD_SOLID_MATERIAL_FACE;
        if (mesh->material_of[t] != expected)
            fail_msg("%s, rim %g, discs %g, %d an edge: triangle %d of face %d has material %d, "
                     "expected %d",
                     kind_names[solid->kind], solid->rim_width, solid->lights.disc_radius,
                     solid->lights.per_edge, t, face, mesh->material_of[t], expected);
    }
    if (!(vague < 0.25 * all))
        fail_msg("%g of %g is too near to borders", vague, all);
}

static void for_every_solid(void (*expect)(const HdSolid *solid, const Pattern *pattern)) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++)
        for (int i = 0; i < PATTERNS; i++) {
            HdSolid solid = solid_with(kind, &patterns[i]);
            expect(&solid, &patterns[i]);
        }
}

static void expect_sound(const HdSolid *solid, const Pattern *pattern) {
    HdMesh mesh = triangulate(solid, 16, 1);
    expect_closed(&mesh);
    expect_on_faces(&mesh, solid);
    expect_areas(&mesh, solid, pattern);
    expect_materials(&mesh, solid, pattern->per_edge > 0 && pattern->disc_radius > least_length);
    if (mesh.triangle_count < 1000)
        expect_no_corner_within_an_edge(&mesh);
    hd_mesh_free(&mesh);
}

TEST(test_closed_and_as_large_as_the_solid) {
    for_every_solid(expect_sound);
}

static void expect_material_of_points(const HdSolid *solid, const Pattern *pattern) {
    (void)pattern;
    HdMesh mesh = triangulate(solid, 16, 1);
    expect_rule(&mesh, solid, 16);
    hd_mesh_free(&mesh);
    mesh = triangulate(solid, 64, 1);
    expect_rule(&mesh, solid, 64);
    hd_mesh_free(&mesh);
}

TEST(test_materials_follow_the_rule_of_the_kernels) {
    for_every_solid(expect_material_of_points);
}

/* Whatever the lengths are; discs of up to a third of an edge among them. */
TEST(test_any_lengths) {
    for (int i = 0; i < 200; i++) {
        Pattern pattern = {0.3 * random_share() * random_share(),
                           1e-7 + 0.5 * pow(random_share(), 3.0), (int)(1.0 + 7.0 * random_share()),
                           (int)(1.0 + 29.0 * random_share())};
        HdSolid solid = solid_with((HdSolidKind)(i % HD_SOLID_KIND_COUNT), &pattern);
        int sides = 8 + 2 * (i % 7);
        HdMesh mesh = triangulate(&solid, sides, 1);
        expect_closed(&mesh);
        expect_on_faces(&mesh, &solid);
        expect_areas(&mesh, &solid, &pattern);
        expect_rule(&mesh, &solid, sides);
        hd_mesh_free(&mesh);
    }
}

/* Triangles between them are long and thin. */
TEST(test_tiny_discs) {
    for (int i = 0; i < 20 * HD_SOLID_KIND_COUNT; i++) {
        Pattern pattern = {0.02, pow(10.0, -7.0 + 0.1 * (i % 20)), 6, 1};
        HdSolid solid = solid_with((HdSolidKind)(i / 20), &pattern);
        HdMesh mesh = triangulate(&solid, 18, 1);
        expect_closed(&mesh);
        expect_on_faces(&mesh, &solid);
        expect_areas(&mesh, &solid, &pattern);
        hd_mesh_free(&mesh);
    }
}

/* As wide as the circle in a face, up to rounding and by a little more or less. */
TEST(test_rims_that_leave_next_to_nothing) {
    for (int i = 0; i < 5 * HD_SOLID_KIND_COUNT; i++) {
        static const double differences[] = {0.0, 1e-16, -1e-16, 1e-10, -1e-10};
        HdPlatonic shape;
        hd_platonic((HdSolidKind)(i / 5), &shape);
        double half = 0.5 * shape.edge_length;
        Pattern pattern = {sqrt(1.0 - shape.inradius * shape.inradius - half * half), 0.0, 0, 1};
        pattern.rim_width += differences[i % 5];
        HdSolid solid = solid_with((HdSolidKind)(i / 5), &pattern);
        HdMesh mesh = triangulate(&solid, 16, 1);
        expect_closed(&mesh);
        expect_areas(&mesh, &solid, &pattern);
        hd_mesh_free(&mesh);
    }
}

TEST(test_bare_faces_have_no_needless_triangles) {
    static const int expected[] = {4, 12, 8, 36, 20};
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdSolid solid = solid_with(kind, &patterns[0]);
        HdMesh mesh = triangulate(&solid, 16, 1);
        assert_int_equal(mesh.triangle_count, expected[kind]);
        hd_mesh_free(&mesh);
    }
}

/* A half disc of n sides has n / 2 + 1 corners, those on the edge among them; a rim p inside. */
TEST(test_no_more_vertices_than_borders_have) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdSolid solid = solid_with(kind, &patterns[3]);
        HdPlatonic shape;
        hd_platonic(kind, &shape);
        HdMesh mesh = triangulate(&solid, 16, 1);
        int discs = shape.edge_count * solid.lights.per_edge;
        assert_int_equal(mesh.vertex_count,
                         shape.vertex_count + 2 * shape.edge_count + discs * (2 + 2 * 7));
        hd_mesh_free(&mesh);
    }
}

/* Discs of lights so near to each other are cut off half way to the next light. */
TEST(test_discs_that_overlap_cost_no_more) {
    const Pattern apart = {0.04, 0.009, 50, 3}, overlapping = {0.04, 0.05, 50, 3};
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdSolid first = solid_with(kind, &apart), second = solid_with(kind, &overlapping);
        HdMesh more = triangulate(&first, 16, 1), less = triangulate(&second, 16, 1);
        assert_true(less.triangle_count < more.triangle_count);
        hd_mesh_free(&more);
        hd_mesh_free(&less);
    }
}

TEST(test_divisions) {
    for (HdSolidKind kind = HD_TETRAHEDRON; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdSolid solid = solid_with(kind, &patterns[4]);
        HdMesh coarse = triangulate(&solid, 8, 1);
        double areas[MOST_MATERIALS], fine_areas[MOST_MATERIALS];
        measure(&coarse, areas);
        for (int n = 2; n < 6; n++) {
            HdMesh fine = triangulate(&solid, 8, n);
            assert_int_equal(fine.triangle_count, coarse.triangle_count * n * n);
            expect_closed(&fine);
            expect_on_faces(&fine, &solid);
            measure(&fine, fine_areas);
            for (int m = 0; m < coarse.material_count; m++)
                expect_near(fine_areas[m], areas[m], 1e-11);
            for (int t = 0; t < fine.triangle_count; t++) {
                int parent = t / (n * n);
                expect_near(hd_length(area_vector(&fine, t)) * n * n,
                            hd_length(area_vector(&coarse, parent)), 1e-12);
                assert_int_equal(fine.material_of[t], coarse.material_of[parent]);
                assert_int_equal(fine.group_of[t], coarse.group_of[parent]);
            }
            if (n == 3)
                expect_no_corner_within_an_edge(&fine);
            hd_mesh_free(&fine);
        }
        hd_mesh_free(&coarse);
    }
}

TEST(test_the_same_every_time) {
    HdSolid solid = solid_with(HD_DODECAHEDRON, &patterns[11]);
    HdMesh a = triangulate(&solid, 16, 2), b = triangulate(&solid, 16, 2);
    assert_int_equal(a.vertex_count, b.vertex_count);
    assert_int_equal(a.triangle_count, b.triangle_count);
    assert_memory_equal(a.vertices, b.vertices, (size_t)a.vertex_count * sizeof *a.vertices);
    assert_memory_equal(a.corners, b.corners, (size_t)a.triangle_count * sizeof *a.corners);
    hd_mesh_free(&a);
    hd_mesh_free(&b);
}

static void expect_refused(int disc_sides, int divisions, const char *message) {
    HdSolid solid = solid_with(HD_HEXAHEDRON, &patterns[3]);
    HdMesh mesh;
    HdError error;
    assert_int_equal(hd_triangulate_solid(&mesh, &solid, disc_sides, divisions, &error),
                     HD_BAD_INPUT);
    assert_string_equal(error.message, message);
    assert_int_equal(mesh.vertex_count, 0);
    assert_null(mesh.materials);
}

TEST(test_bad_numbers) {
    expect_refused(15, 1, "discs have 15 sides, expected an even number from 8 to 256");
    expect_refused(6, 1, "discs have 6 sides, expected an even number from 8 to 256");
    expect_refused(258, 1, "discs have 258 sides, expected an even number from 8 to 256");
    expect_refused(16, 0, "divisions are 0, expected at least 1");
    expect_refused(16, 3000,
                   "2364 triangles divided into 3000 x 3000 each are too many, expected at most "
                   "100000000 together");
    expect_refused(16, INT32_MAX,
                   "1 triangles divided into 2147483647 x 2147483647 each are too many, expected "
                   "at most 100000000 together");
}

static HdFloor floor_with(HdVec3 a, HdVec3 b, HdVec3 c, HdVec3 d) {
    return (HdFloor){
        .present = true, .corners = {a, b, c, d}, .material = {.diffuse = 0.5, .shininess = 7}};
}

static const double floor_corner_uvs[4][2] = {{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}};

/* Of an edge that only one triangle has, the vertices lie on the floor's border. */
static void expect_floor(const HdFloor *floor, int divisions, double area) {
    HdMesh mesh;
    HdError error;
    assert_int_equal(hd_triangulate_floor(&mesh, floor, divisions, &error), HD_OK);
    assert_int_equal(mesh.triangle_count, 2 * divisions * divisions);
    assert_int_equal(mesh.vertex_count, (divisions + 1) * (divisions + 1));
    assert_int_equal(mesh.uv_count, mesh.vertex_count);
    assert_int_equal(mesh.material_count, 1);
    assert_null(mesh.materials[0].texture);
    assert_int_equal(mesh.materials[0].passes_as, -1);
    assert_int_equal(mesh.materials[0].material.shininess, 7);
    const HdVec3 *c = floor->corners;
    HdVec3 normal = hd_normalize(hd_cross(hd_sub(c[2], c[0]), hd_sub(c[3], c[1])));
    HdVec3 centre = hd_scale(hd_add(hd_add(c[0], c[1]), hd_add(c[2], c[3])), 0.25);
    double sum = 0.0;
    for (int t = 0; t < mesh.triangle_count; t++) {
        sum += hd_dot(normal, area_vector(&mesh, t));
        assert_true(hd_dot(normal, area_vector(&mesh, t)) > 0.0);
        assert_int_equal(mesh.group_of[t], 1);
        for (int i = 0; i < 3; i++) {
            const double *uv = mesh.uvs[mesh.corner_uvs[t][i]];
            double s = uv[0], v = 1.0 - uv[1]; /* downwards */
            HdVec3 expected = hd_scale(centre, -1.0);
            expected = hd_add(expected, hd_scale(c[0], (1.0 - s) * (1.0 - v)));
            expected = hd_add(expected, hd_scale(c[1], s * (1.0 - v)));
            expected = hd_add(expected, hd_scale(c[2], s * v));
            expected = hd_add(expected, hd_scale(c[3], (1.0 - s) * v));
            expect_near(hd_length(hd_sub(expected, corner_of(&mesh, t, i))), 0.0, 1e-14);
        }
    }
    expect_near(sum, area, 1e-13 * area);
    for (int i = 0; i < 4; i++) {
        bool is_there = false;
        for (int k = 0; k < mesh.vertex_count; k++)
            is_there =
                is_there || (hd_length(hd_sub(hd_sub(c[i], centre), mesh.vertices[k])) < 1e-14 &&
                             mesh.uvs[k][0] == floor_corner_uvs[i][0] &&
                             mesh.uvs[k][1] == floor_corner_uvs[i][1]);
        assert_true(is_there);
    }
    hd_mesh_free(&mesh);
}

TEST(test_floor) {
    HdFloor square = floor_with(hd_vec3(-1.0, 3.0, -1.0), hd_vec3(3.0, 3.0, -1.0),
                                hd_vec3(3.0, -1.0, -1.0), hd_vec3(-1.0, -1.0, -1.0));
    HdFloor uneven = floor_with(hd_vec3(0.0, 0.0, 2.0), hd_vec3(4.0, 0.0, 2.0),
                                hd_vec3(3.0, 2.0, 2.0), hd_vec3(1.0, 2.0, 2.0));
    for (int n = 1; n < 6; n++) {
        expect_floor(&square, n, 16.0);
        expect_floor(&uneven, n, 6.0);
    }
    HdMesh mesh;
    HdError error;
    assert_int_equal(hd_triangulate_floor(&mesh, &square, 0, &error), HD_BAD_INPUT);
    assert_int_equal(hd_triangulate_floor(&mesh, &square, 8000, &error), HD_BAD_INPUT);
    assert_null(mesh.materials);
}
