/* SPDX-License-Identifier: MIT */
#include "scene/platonic.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/trigonometry.h"

typedef struct Points {
    int count;
    HdVec3 point[HD_MAX_VERTICES];
} Points;

static void add_point(Points *points, double x, double y, double z) {
    points->point[points->count++] = hd_normalize(hd_vec3(x, y, z));
}

/* Adds the even corners of the cube, or their opposites. */
static void add_tetrahedron(Points *points, double sign) {
    add_point(points, sign, sign, sign);
    add_point(points, sign, -sign, -sign);
    add_point(points, -sign, sign, -sign);
    add_point(points, -sign, -sign, sign);
}

static void add_cube(Points *points) {
    for (int i = 0; i < 8; i++)
        add_point(points, (i & 4) ? -1.0 : 1.0, (i & 2) ? -1.0 : 1.0, (i & 1) ? -1.0 : 1.0);
}

static void add_axes(Points *points) {
    for (int i = 0; i < 2; i++) {
        const double sign = i ? -1.0 : 1.0;
        add_point(points, sign, 0.0, 0.0);
        add_point(points, 0.0, sign, 0.0);
        add_point(points, 0.0, 0.0, sign);
    }
}

/* Adds (0, +-a, +-b) and its cyclic permutations. */
static void add_rectangles(Points *points, double a, double b) {
    for (int i = 0; i < 4; i++) {
        const double p = (i & 2) ? -a : a;
        const double q = (i & 1) ? -b : b;
        add_point(points, 0.0, p, q);
        add_point(points, q, 0.0, p);
        add_point(points, p, q, 0.0);
    }
}

static void list_vertices(HdSolidKind kind, Points *points) {
    const double phi = (1.0 + sqrt(5.0)) / 2.0;
    points->count = 0;
    if (kind == HD_TETRAHEDRON)
        add_tetrahedron(points, 1.0);
    if (kind == HD_OCTAHEDRON)
        add_axes(points);
    if (kind == HD_HEXAHEDRON || kind == HD_DODECAHEDRON)
        add_cube(points);
    if (kind == HD_DODECAHEDRON) /* of both orientations the dual of the icosahedron below */
        add_rectangles(points, phi, 1.0 / phi);
    if (kind == HD_ICOSAHEDRON)
        add_rectangles(points, 1.0, phi);
}

static bool is_opposite(HdVec3 a, HdVec3 b) {
    return a.x == -b.x && a.y == -b.y && a.z == -b.z;
}

/* Puts opposite points next to each other; the first of each pair keeps its order. */
static void pair_opposites(Points *points) {
    for (int i = 0; i < points->count; i += 2) {
        int other = i + 1;
        while (!is_opposite(points->point[i], points->point[other]))
            other++;
        const HdVec3 opposite = points->point[other];
        for (int j = other; j > i + 1; j--)
            points->point[j] = points->point[j - 1];
        points->point[i + 1] = opposite;
    }
}

/* The face normals are the vertices of the dual. */
static void list_normals(HdSolidKind kind, Points *points) {
    static const HdSolidKind duals[HD_SOLID_KIND_COUNT + 1] = {[HD_HEXAHEDRON] = HD_OCTAHEDRON,
                                                               [HD_OCTAHEDRON] = HD_HEXAHEDRON,
                                                               [HD_DODECAHEDRON] = HD_ICOSAHEDRON,
                                                               [HD_ICOSAHEDRON] = HD_DODECAHEDRON};
    if (kind == HD_TETRAHEDRON) { /* its own dual, inverted */
        points->count = 0;
        add_tetrahedron(points, -1.0);
    } else {
        list_vertices(duals[kind], points);
        pair_opposites(points);
    }
}

/* Returns a bit for each face that the vertex lies on. */
static uint32_t faces_at(const HdPlatonic *solid, int vertex) {
    uint32_t faces = 0;
    for (int i = 0; i < solid->face_count; i++) {
        const double distance = hd_dot(solid->face_normal[i], solid->vertex[vertex]);
        if (fabs(distance - solid->inradius) < 1e-9)
            faces |= UINT32_C(1) << i;
    }
    return faces;
}

/* Two vertices that share exactly two faces are the ends of the edge between these faces. */
static void find_edges(HdPlatonic *solid) {
    for (int a = 0; a < solid->vertex_count; a++)
        for (int b = a + 1; b < solid->vertex_count; b++) {
            const uint32_t shared = faces_at(solid, a) & faces_at(solid, b);
            HdPlatonicEdge edge = {.vertex = {a, b}};
            int count = 0;
            for (int i = 0; i < solid->face_count; i++)
                if ((shared >> i) & 1U)
                    edge.face[count++ % 2] = i;
            if (count == 2)
                solid->edge[solid->edge_count++] = edge;
        }
}

void hd_platonic(HdSolidKind kind, HdPlatonic *solid) {
    Points vertices = {.count = 0}, normals = {.count = 0};
    *solid = (HdPlatonic){0};
    list_vertices(kind, &vertices);
    list_normals(kind, &normals);
    solid->vertex_count = vertices.count;
    for (int i = 0; i < vertices.count; i++)
        solid->vertex[i] = vertices.point[i];
    solid->face_count = normals.count;
    for (int i = 0; i < normals.count; i++)
        solid->face_normal[i] = normals.point[i];
    for (int i = 0; i < vertices.count; i++)
        solid->inradius = fmax(solid->inradius, hd_dot(vertices.point[i], normals.point[0]));
    find_edges(solid);

    const HdPlatonicEdge first = solid->edge[0];
    solid->edge_length =
        hd_length(hd_sub(solid->vertex[first.vertex[0]], solid->vertex[first.vertex[1]]));
    solid->sine_of_dihedral =
        hd_length(hd_cross(solid->face_normal[first.face[0]], solid->face_normal[first.face[1]]));
}

/* Rotates about the axis that follows `u` and `v` in the cyclic order x, y, z. */
static void rotate_plane(double *u, double *v, double sine, double cosine) {
    const double turned = cosine * *u - sine * *v;
    *v = sine * *u + cosine * *v;
    *u = turned;
}

void hd_rotate_points(HdVec3 *points, int count, HdVec3 degrees) {
    HdVec3 sine, cosine;
    if (degrees.x == 0.0 && degrees.y == 0.0 && degrees.z == 0.0)
        return;
    hd_sine_cosine(degrees.x * (HD_PI / 180.0), &sine.x, &cosine.x);
    hd_sine_cosine(degrees.y * (HD_PI / 180.0), &sine.y, &cosine.y);
    hd_sine_cosine(degrees.z * (HD_PI / 180.0), &sine.z, &cosine.z);
    for (int i = 0; i < count; i++) {
        rotate_plane(&points[i].y, &points[i].z, sine.x, cosine.x);
        rotate_plane(&points[i].z, &points[i].x, sine.y, cosine.y);
        rotate_plane(&points[i].x, &points[i].y, sine.z, cosine.z);
    }
}

void hd_platonic_rotate(HdPlatonic *solid, HdVec3 degrees) {
    hd_rotate_points(solid->vertex, solid->vertex_count, degrees);
    hd_rotate_points(solid->face_normal, solid->face_count, degrees);
}

#define NAME_OF(kind, name) name,

const char *hd_solid_kind_name(HdSolidKind kind) {
    static const char *const names[] = {HD_SOLID_KINDS(NAME_OF)};
    return names[kind];
}
