/* SPDX-License-Identifier: MIT */
#include "mesh/shells.h"

#include <stdlib.h>

#include "mesh/places.h"

static HdStatus no_memory(const HdMesh *mesh, HdError *error) {
    return HD_NO_ROOM(error, "the shells of %d triangles", mesh->triangle_count);
}

/* Returns the places of the vertices, which the caller frees; NULL: out of memory. */
static int32_t *list_places(const HdMesh *mesh, int *count) {
    int32_t *place_of = malloc((size_t)mesh->vertex_count * sizeof *place_of);
    if (place_of != NULL && hd_find_places(mesh, place_of, count))
        return place_of;
    free(place_of);
    return NULL;
}

/* ---- joining ---- */

/* Returns the root of a place's tree, and shortens the way to it. */
static int32_t root_of(int32_t *parent, int32_t place) {
    while (parent[place] != place)
        place = parent[place] = parent[parent[place]];
    return place;
}

/* The lower root stays, so the trees do not depend on the order of joining. */
static void join(int32_t *parent, int32_t a, int32_t b) {
    a = root_of(parent, a);
    b = root_of(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

static void join_triangles(const HdMesh *mesh, const int32_t *place_of, int32_t *parent) {
    for (int i = 0; i < mesh->triangle_count; i++) {
        const int32_t *corner = mesh->corners[i];
        join(parent, place_of[corner[0]], place_of[corner[1]]);
        join(parent, place_of[corner[0]], place_of[corner[2]]);
    }
}

/* Numbers the shells; `number` has a 0 for each root. */
static void number_shells(HdShells *shells, const HdMesh *mesh, const int32_t *place_of,
                          int32_t *parent, int32_t *number) {
    for (int i = 0; i < mesh->triangle_count; i++) {
        const int32_t root = root_of(parent, place_of[mesh->corners[i][0]]);
        if (number[root] == 0)
            number[root] = ++shells->count;
        shells->shell_of[i] = number[root] - 1;
    }
}

static void box_shells(HdShells *shells, const HdMesh *mesh) {
    for (int i = 0; i < mesh->triangle_count; i++) {
        HdShell *shell = &shells->shells[shells->shell_of[i]];
        for (int k = 0; k < 3; k++) {
            const HdVec3 at = mesh->vertices[mesh->corners[i][k]];
            shell->lower = hd_minimum(shell->lower, at);
            shell->upper = hd_maximum(shell->upper, at);
        }
        shell->count++;
    }
}

static void list_triangles(HdShells *shells, const HdMesh *mesh) {
    int32_t first = 0;
    for (int i = 0; i < shells->count; i++) {
        HdShell *shell = &shells->shells[i];
        shell->first = first;
        first += shell->count;
        shell->count = 0;
    }
    for (int i = 0; i < mesh->triangle_count; i++) {
        HdShell *shell = &shells->shells[shells->shell_of[i]];
        shells->triangles[shell->first + shell->count++] = i;
    }
}

static bool find(HdShells *shells, const HdMesh *mesh, const int32_t *place_of, int32_t *parent,
                 int32_t *number, int place_count) {
    shells->shell_of = malloc((size_t)mesh->triangle_count * sizeof *shells->shell_of);
    shells->triangles = malloc((size_t)mesh->triangle_count * sizeof *shells->triangles);
    if (parent == NULL || number == NULL || shells->shell_of == NULL || shells->triangles == NULL)
        return false;
    for (int32_t i = 0; i < place_count; i++)
        parent[i] = i;
    join_triangles(mesh, place_of, parent);
    number_shells(shells, mesh, place_of, parent, number);
    shells->shells = calloc((size_t)shells->count, sizeof *shells->shells);
    if (shells->shells == NULL)
        return false;
    for (int i = 0; i < shells->count; i++)
        shells->shells[i] = (HdShell){.lower = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                                      .upper = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    box_shells(shells, mesh);
    list_triangles(shells, mesh);
    return true;
}

HdStatus hd_shells_find(HdShells *shells, const HdMesh *mesh, HdError *error) {
    *shells = (HdShells){0};
    int place_count = 0;
    int32_t *place_of = list_places(mesh, &place_count);
    if (place_of == NULL)
        return no_memory(mesh, error);
    int32_t *parent = malloc((size_t)place_count * sizeof *parent);
    int32_t *number = calloc((size_t)place_count, sizeof *number);
    const bool is_done = find(shells, mesh, place_of, parent, number, place_count);
    free(place_of);
    free(parent);
    free(number);
    if (is_done)
        return HD_OK;
    hd_shells_free(shells);
    return no_memory(mesh, error);
}

/* ---- measuring ---- */

/* Directed edges of triangles: the places that each joins, plus 1; 0: a free row. */
typedef struct Edges {
    uint64_t *rows;
    size_t mask;
} Edges;

static uint64_t *find_edge(const Edges *edges, uint64_t edge) {
    size_t at = (size_t)hd_mix_bits(edge) & edges->mask;
    while (edges->rows[at] != 0 && edges->rows[at] != edge)
        at = (at + 1) & edges->mask;
    return &edges->rows[at];
}

static uint64_t edge_of(const HdMesh *mesh, const int32_t *place_of, int triangle, int from,
                        int to) {
    const int32_t *corner = mesh->corners[triangle];
    return ((uint64_t)(place_of[corner[from % 3]] + 1) << 32) |
           (uint64_t)(place_of[corner[to % 3]] + 1);
}

/* A shell is open if an edge occurs twice in one direction, or only in one. */
static void find_open(HdShells *shells, const HdMesh *mesh, const int32_t *place_of,
                      const Edges *edges) {
    for (int i = 0; i < 3 * mesh->triangle_count; i++) {
        const uint64_t edge = edge_of(mesh, place_of, i / 3, i % 3, i % 3 + 1);
        uint64_t *row = find_edge(edges, edge);
        if (*row == edge)
            shells->shells[shells->shell_of[i / 3]].is_closed = false;
        *row = edge;
    }
    for (int i = 0; i < 3 * mesh->triangle_count; i++)
        if (*find_edge(edges, edge_of(mesh, place_of, i / 3, i % 3 + 1, i % 3)) == 0)
            shells->shells[shells->shell_of[i / 3]].is_closed = false;
}

static void add_volumes(HdShells *shells, const HdMesh *mesh) {
    for (int i = 0; i < mesh->triangle_count; i++) {
        const HdVec3 a = hd_mesh_corner(mesh, i, 0), b = hd_mesh_corner(mesh, i, 1),
                     c = hd_mesh_corner(mesh, i, 2);
        shells->shells[shells->shell_of[i]].volume += hd_dot(a, hd_cross(b, c)) / 6.0;
    }
}

HdStatus hd_shells_measure(HdShells *shells, const HdMesh *mesh, HdError *error) {
    if (shells->are_measured)
        return HD_OK;
    size_t capacity = 2;
    while (capacity < 4 * (size_t)mesh->triangle_count)
        capacity *= 2;
    int place_count;
    int32_t *place_of = list_places(mesh, &place_count);
    Edges edges = {.rows = calloc(capacity, sizeof *edges.rows), .mask = capacity - 1};
    shells->are_measured = place_of != NULL && edges.rows != NULL;
    if (shells->are_measured) {
        for (int i = 0; i < shells->count; i++)
            shells->shells[i].is_closed = true;
        find_open(shells, mesh, place_of, &edges);
        add_volumes(shells, mesh);
    }
    free(place_of);
    free(edges.rows);
    return shells->are_measured ? HD_OK : no_memory(mesh, error);
}

HdStatus hd_shell_build(HdShells *shells, const HdMesh *mesh, int shell, HdThreadPool *pool,
                        HdError *error) {
    HdShell *of = &shells->shells[shell];
    if (hd_shell_tree(shells, mesh, shell)->node_count > 0)
        return HD_OK;
    return hd_mesh_build_tree(&of->tree, mesh, shells->triangles + of->first, of->count, pool,
                              error);
}

void hd_shells_free(HdShells *shells) {
    for (int i = 0; shells->shells != NULL && i < shells->count; i++)
        hd_hierarchy_free(&shells->shells[i].tree);
    free(shells->shells);
    free(shells->shell_of);
    free(shells->triangles);
    *shells = (HdShells){0};
}
