/* SPDX-License-Identifier: MIT */
#include "mesh/mesh.h"

#include <stdlib.h>

/* An edge of the mesh, from the vertex with the smaller number. */
typedef struct Edge {
    int32_t a, b;
} Edge;

typedef struct Division {
    const HdMesh *mesh;
    int parts; /* parts of each edge */
    int edge_count;
    Edge *edges; /* sorted and unique */
    HdMesh fine; /* result; only the arrays of hd_mesh_allocate */
} Division;

static HdStatus no_memory(const HdMesh *mesh, HdError *error) {
    return hd_fail(error, HD_FAILED, "out of memory: %d triangles cannot be divided so finely",
                   mesh->triangle_count);
}

HdStatus hd_check_divisions(int64_t triangle_count, int divisions, HdError *error) {
    if (divisions < 1)
        return hd_fail(error, HD_BAD_INPUT, "divisions are %d, expected at least 1", divisions);
    if (divisions > HD_MAX_MESH_TRIANGLES ||
        triangle_count > HD_MAX_MESH_TRIANGLES / ((int64_t)divisions * divisions))
        return hd_fail(error, HD_BAD_INPUT,
                       "%lld triangles divided into %d x %d each are too many, expected at most %d "
                       "together",
                       (long long)triangle_count, divisions, divisions, (int)HD_MAX_MESH_TRIANGLES);
    return HD_OK;
}

static int compare_edges(const void *left, const void *right) {
    const Edge *x = left, *y = right;
    if (x->a != y->a)
        return x->a < y->a ? -1 : 1;
    return (x->b > y->b) - (x->b < y->b);
}

static Edge edge_between(int a, int b) {
    return a < b ? (Edge){a, b} : (Edge){b, a};
}

static void list_edges(Division *division) {
    const HdMesh *mesh = division->mesh;
    int count = 0, kept = 0;
    for (int t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            division->edges[count++] =
                edge_between(mesh->corners[t][i], mesh->corners[t][(i + 1) % 3]);
    qsort(division->edges, (size_t)count, sizeof *division->edges, compare_edges);
    for (int i = 0; i < count; i++)
        if (kept == 0 || compare_edges(&division->edges[kept - 1], &division->edges[i]) != 0)
            division->edges[kept++] = division->edges[i];
    division->edge_count = kept;
}

static HdVec3 between(HdVec3 a, HdVec3 b, double share) {
    return hd_add(a, hd_scale(hd_sub(b, a), share));
}

/* Places the old vertices, then parts - 1 on each edge. */
static void place_edge_vertices(Division *division) {
    HdMesh *fine = &division->fine;
    const HdVec3 *old = division->mesh->vertices;
    for (int v = 0; v < division->mesh->vertex_count; v++)
        fine->vertices[fine->vertex_count++] = old[v];
    for (const Edge *edge = division->edges; edge < division->edges + division->edge_count; edge++)
        for (int k = 1; k < division->parts; k++)
            fine->vertices[fine->vertex_count++] =
                between(old[edge->a], old[edge->b], (double)k / division->parts);
}

/* Returns the vertex k parts from vertex a on the way to b. */
static int edge_vertex(const Division *division, int a, int b, int k) {
    if (k == 0 || k == division->parts)
        return k == 0 ? a : b;
    Edge key = edge_between(a, b);
    const Edge *edge = bsearch(&key, division->edges, (size_t)division->edge_count,
                               sizeof *division->edges, compare_edges);
    int number = (int)(edge - division->edges), along = a < b ? k : division->parts - k;
    return division->mesh->vertex_count + number * (division->parts - 1) + along - 1;
}

static void add_triangle(Division *division, int parent, int a, int b, int c) {
    HdMesh *fine = &division->fine;
    int t = fine->triangle_count++;
    fine->corners[t][0] = a;
    fine->corners[t][1] = b;
    fine->corners[t][2] = c;
    fine->material_of[t] = division->mesh->material_of[parent];
    fine->group_of[t] = division->mesh->group_of[parent];
}

/* Fills row r of a triangle: r + 1 vertices from the side to corner 1 to the side to corner 2. */
static void fill_row(Division *division, const int32_t *corner, int r, int32_t *row) {
    HdVec3 *vertices = division->fine.vertices;
    row[0] = edge_vertex(division, corner[0], corner[1], r);
    row[r] = edge_vertex(division, corner[0], corner[2], r);
    for (int k = 1; k < r; k++) {
        if (r == division->parts) {
            row[k] = edge_vertex(division, corner[1], corner[2], k);
            continue;
        }
        row[k] = division->fine.vertex_count++;
        vertices[row[k]] = between(vertices[row[0]], vertices[row[r]], (double)k / r);
    }
}

static void divide_triangle(Division *division, int t, int32_t *upper, int32_t *lower) {
    const int32_t *corner = division->mesh->corners[t];
    fill_row(division, corner, 0, upper);
    for (int r = 1; r <= division->parts; r++) {
        fill_row(division, corner, r, lower);
        for (int k = 0; k < r; k++) {
            add_triangle(division, t, upper[k], lower[k], lower[k + 1]);
            if (k > 0)
                add_triangle(division, t, upper[k - 1], lower[k], upper[k]);
        }
        int32_t *swapped = upper;
        upper = lower;
        lower = swapped;
    }
}

/* `rows` has capacity for two rows. */
static HdStatus divide(Division *division, int32_t *rows, HdError *error) {
    list_edges(division);
    /* A triangle gives parts^2 triangles and (parts - 1) (parts - 2) / 2 inner vertices. */
    const size_t old = (size_t)division->mesh->triangle_count, parts = (size_t)division->parts;
    const size_t vertices = (size_t)division->mesh->vertex_count +
                            (size_t)division->edge_count * (parts - 1) +
                            old * ((parts - 1) * (parts - 2) / 2);
    if (!hd_mesh_allocate(&division->fine, vertices, old * parts * parts))
        return no_memory(division->mesh, error);
    place_edge_vertices(division);
    for (int t = 0; t < division->mesh->triangle_count; t++)
        divide_triangle(division, t, rows, rows + division->parts + 1);
    return HD_OK;
}

HdStatus hd_divide_triangles(HdMesh *mesh, int divisions, HdError *error) {
    HdStatus status = hd_check_divisions(mesh->triangle_count, divisions, error);
    if (status != HD_OK || divisions == 1)
        return status;
    Division division = {.mesh = mesh, .parts = divisions};
    division.edges = malloc(3 * (size_t)mesh->triangle_count * sizeof *division.edges + 1);
    int32_t *rows = malloc(2 * ((size_t)divisions + 1) * sizeof *rows);
    if (division.edges == NULL || rows == NULL)
        status = no_memory(mesh, error);
    else
        status = divide(&division, rows, error);
    if (status == HD_OK) {
        const HdMesh former = *mesh;
        *mesh = division.fine;
        mesh->material_count = former.material_count;
        mesh->materials = former.materials;
        mesh->degenerate_count = former.degenerate_count;
        division.fine = former;
        division.fine.materials = NULL;
    }
    hd_mesh_free(&division.fine);
    free(division.edges);
    free(rows);
    return status;
}
