/* SPDX-License-Identifier: MIT */
/* Computes smooth normals. At each place, triangles that share an uncreased edge form a class
   with one normal. Every sum runs in the order of the triangles, so the bytes depend on the mesh
   only. */
#include <stdlib.h>
#include <string.h>

#include "base/trigonometry.h"
#include "mesh/places.h"

enum {
    /* Limits how many of the following triangles at an edge each is compared with: proper meshes
       have two, and thousands must not take millions of comparisons. */
    MAX_AT_EDGE = 16
};

/* Tolerance of the cosine between two normals for rounding. */
static const double cosine_tolerance = 1e-12;

/* A corner of a triangle, listed by its place. */
typedef struct Incident {
    int32_t corner; /* 3 times the triangle plus 0..2 */
    int32_t class;  /* an incident of the same class; its own number for the first */
    HdVec3 normal;  /* unit normal of the triangle; 0: no area */
    double angle;
    int32_t place_of_normal; /* for the first of a class; -1: none */
    HdVec3 sum;
} Incident;

/* An edge from the place to another one, in one triangle. */
typedef struct Edge {
    int32_t other;    /* the place at its far end */
    int32_t incident; /* the triangle's */
} Edge;

typedef struct Smoother {
    const HdMesh *mesh;
    double min_cosine;
    int place_count;
    int32_t *place_of; /* place of each vertex */
    int32_t *begin;    /* first index into `corners` of each place; one more for the end */
    int32_t *corners;  /* corners, place by place */
    int max_incidents;
    Incident *incidents;
    Edge *edges;
    HdVec3 *normals;
    int normal_count;
    int32_t (*corner_normals)[3];
} Smoother;

static void *allocate(size_t count, size_t size) {
    return malloc(count > 0 ? count * size : size);
}

static int32_t place_at(const Smoother *smoother, int32_t corner) {
    return smoother->place_of[smoother->mesh->corners[corner / 3][corner % 3]];
}

/* Lists the corners of each place, in ascending order. */
static void list_corners(Smoother *smoother) {
    const int32_t corner_count = 3 * smoother->mesh->triangle_count;
    int32_t *begin = smoother->begin;
    memset(begin, 0, ((size_t)smoother->place_count + 1) * sizeof *begin);
    for (int32_t i = 0; i < corner_count; i++)
        begin[place_at(smoother, i) + 1]++;
    for (int i = 0; i < smoother->place_count; i++) {
        if (begin[i + 1] > smoother->max_incidents)
            smoother->max_incidents = begin[i + 1];
        begin[i + 1] += begin[i];
    }
    for (int32_t i = 0; i < corner_count; i++)
        smoother->corners[begin[place_at(smoother, i)]++] = i;
    /* Each begin is now its place's end, which is the begin of the next. */
    memmove(begin + 1, begin, (size_t)smoother->place_count * sizeof *begin);
    begin[0] = 0;
}

static HdVec3 corner_point(const Smoother *smoother, int32_t triangle, int side) {
    return smoother->mesh->vertices[smoother->mesh->corners[triangle][side % 3]];
}

static Incident make_incident(const Smoother *smoother, int32_t corner, int32_t number) {
    const int32_t triangle = corner / 3;
    const HdVec3 point = corner_point(smoother, triangle, corner % 3);
    const HdVec3 next = hd_sub(corner_point(smoother, triangle, corner % 3 + 1), point);
    const HdVec3 last = hd_sub(corner_point(smoother, triangle, corner % 3 + 2), point);
    const HdVec3 across = hd_cross(next, last);
    const double length = hd_length(across);
    Incident incident = {.corner = corner, .class = number, .place_of_normal = -1};
    if (length > 0.0) {
        incident.normal = hd_scale(across, 1.0 / length);
        incident.angle = hd_angle(next, last);
    }
    return incident;
}

static int compare_edges(const void *first, const void *second) {
    const Edge *a = first, *b = second;
    if (a->other != b->other)
        return a->other < b->other ? -1 : 1;
    return (a->incident > b->incident) - (a->incident < b->incident);
}

static int32_t class_of(Incident *incidents, int32_t number) {
    while (incidents[number].class != number) {
        incidents[number].class = incidents[incidents[number].class].class;
        number = incidents[number].class;
    }
    return number;
}

/* The first incident represents its class. */
static void merge_classes(Incident *incidents, int32_t a, int32_t b) {
    const int32_t first = class_of(incidents, a), second = class_of(incidents, b);
    if (first < second)
        incidents[second].class = first;
    else
        incidents[first].class = second;
}

static void unite_at_edges(const Smoother *smoother, int edge_count) {
    const Edge *edges = smoother->edges;
    Incident *incidents = smoother->incidents;
    for (int i = 0; i < edge_count; i++) {
        for (int j = i + 1; j < edge_count && j <= i + MAX_AT_EDGE; j++) {
            if (edges[j].other != edges[i].other)
                break;
            const Incident *a = &incidents[edges[i].incident], *b = &incidents[edges[j].incident];
            if (hd_dot(a->normal, b->normal) >= smoother->min_cosine)
                merge_classes(incidents, edges[i].incident, edges[j].incident);
        }
    }
}

/* Skips triangles without an area, which have no normal to compare. */
static int list_edges(const Smoother *smoother, int incident_count) {
    int count = 0;
    for (int32_t i = 0; i < incident_count; i++) {
        const int32_t corner = smoother->incidents[i].corner;
        const int32_t first = corner - corner % 3;
        if (smoother->incidents[i].angle == 0.0)
            continue;
        for (int32_t side = 1; side <= 2; side++)
            smoother->edges[count++] = (Edge){place_at(smoother, first + (corner + side) % 3), i};
    }
    qsort(smoother->edges, (size_t)count, sizeof *smoother->edges, compare_edges);
    return count;
}

static bool is_zero(HdVec3 a) {
    return a.x == 0.0 && a.y == 0.0 && a.z == 0.0;
}

static void add_normals(Smoother *smoother, int incident_count) {
    Incident *incidents = smoother->incidents;
    for (int32_t i = 0; i < incident_count; i++) {
        Incident *class = &incidents[class_of(incidents, i)];
        class->sum = hd_add(class->sum, hd_scale(incidents[i].normal, incidents[i].angle));
    }
    for (int32_t i = 0; i < incident_count; i++) {
        if (incidents[i].class != i || is_zero(incidents[i].sum))
            continue;
        incidents[i].place_of_normal = smoother->normal_count;
        smoother->normals[smoother->normal_count++] = hd_normalize(incidents[i].sum);
    }
    for (int32_t i = 0; i < incident_count; i++) {
        const int32_t corner = incidents[i].corner;
        smoother->corner_normals[corner / 3][corner % 3] =
            incidents[class_of(incidents, i)].place_of_normal;
    }
}

static void smooth_place(Smoother *smoother, int place) {
    const int32_t begin = smoother->begin[place];
    const int count = smoother->begin[place + 1] - begin;
    for (int32_t i = 0; i < count; i++)
        smoother->incidents[i] = make_incident(smoother, smoother->corners[begin + i], i);
    unite_at_edges(smoother, list_edges(smoother, count));
    add_normals(smoother, count);
}

static bool prepare(Smoother *smoother) {
    const size_t vertices = (size_t)smoother->mesh->vertex_count;
    const size_t corners = 3 * (size_t)smoother->mesh->triangle_count;
    smoother->place_of = allocate(vertices, sizeof *smoother->place_of);
    smoother->begin = allocate(vertices + 1, sizeof *smoother->begin);
    smoother->corners = allocate(corners, sizeof *smoother->corners);
    /* At most one normal for each corner; untouched memory costs nothing. */
    smoother->normals = allocate(corners, sizeof *smoother->normals);
    smoother->corner_normals = allocate(corners, sizeof(int32_t));
    if (smoother->place_of == NULL || smoother->begin == NULL || smoother->corners == NULL ||
        smoother->normals == NULL || smoother->corner_normals == NULL ||
        !hd_find_places(smoother->mesh, smoother->place_of, &smoother->place_count))
        return false;
    list_corners(smoother);
    const size_t max_incidents = (size_t)smoother->max_incidents;
    smoother->incidents = allocate(max_incidents, sizeof *smoother->incidents);
    smoother->edges = allocate(2 * max_incidents, sizeof *smoother->edges);
    return smoother->incidents != NULL && smoother->edges != NULL;
}

/* Moves the results to the mesh. */
static void take_normals(Smoother *smoother, HdMesh *mesh) {
    const size_t count = (size_t)smoother->normal_count;
    HdVec3 *normals = realloc(smoother->normals, (count > 0 ? count : 1) * sizeof *normals);
    free(mesh->normals);
    free(mesh->corner_normals);
    mesh->normals = normals != NULL ? normals : smoother->normals;
    mesh->normal_count = smoother->normal_count;
    mesh->corner_normals = smoother->corner_normals;
    smoother->normals = NULL;
    smoother->corner_normals = NULL;
}

static double min_cosine(double crease_degrees) {
    double sine, cosine;
    if (crease_degrees >= 180.0)
        return -2.0; /* below every cosine: no creases */
    hd_sine_cosine(crease_degrees * (HD_PI / 180.0), &sine, &cosine);
    return cosine - cosine_tolerance;
}

HdStatus hd_mesh_smooth(HdMesh *mesh, double crease_degrees, HdError *error) {
    Smoother smoother = {.mesh = mesh, .min_cosine = min_cosine(crease_degrees)};
    HdStatus status = HD_OK;
    if (prepare(&smoother)) {
        for (int i = 0; i < smoother.place_count; i++)
            smooth_place(&smoother, i);
        take_normals(&smoother, mesh);
    } else {
        status = HD_NO_ROOM(error, "the normals of %d triangles", mesh->triangle_count);
    }
    free(smoother.place_of);
    free(smoother.begin);
    free(smoother.corners);
    free(smoother.incidents);
    free(smoother.edges);
    free(smoother.normals);
    free(smoother.corner_normals);
    return status;
}
