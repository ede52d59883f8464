/* SPDX-License-Identifier: MIT */
#include "scene/shell_gap.h"

#include <stdlib.h>

#include "base/growth.h"

/* ---- between placements ---- */

/* Returns the map from the coordinates of `within` to those of `around`. */
static HdPlacement map_between(const HdPlacedMesh *within, const HdPlacedMesh *around) {
    HdPlacement back = {.start = {0}}, map;
    hd_invert_columns(around->to.columns, back.columns);
    for (int i = 0; i < 3; i++)
        map.columns[i] = hd_place(&back, within->to.columns[i]);
    map.start = hd_place(&back, hd_sub(within->to.start, around->to.start));
    return map;
}

HdVec3 hd_point_between(const HdPlacedMesh *within, const HdPlacedMesh *around, HdVec3 point) {
    if (within == around)
        return point;
    const HdPlacement map = map_between(within, around);
    return hd_place(&map, point);
}

/* ---- boxes ---- */

typedef struct Box {
    HdVec3 lower, upper;
} Box;

static Box box_of_child(const HdBox *box) {
    return (Box){hd_vec3((double)box->lower[0], (double)box->lower[1], (double)box->lower[2]),
                 hd_vec3((double)box->upper[0], (double)box->upper[1], (double)box->upper[2])};
}

static Box enlarged(Box box, double by) {
    const HdVec3 margin = hd_vec3(by, by, by);
    return (Box){hd_sub(box.lower, margin), hd_add(box.upper, margin)};
}

static Box placed_box(const HdPlacement *map, Box box) {
    const HdVec3 middle = hd_place(map, hd_scale(hd_add(box.lower, box.upper), 0.5));
    const HdVec3 half = hd_placed_half(map, hd_scale(hd_sub(box.upper, box.lower), 0.5));
    return (Box){hd_sub(middle, half), hd_add(middle, half)};
}

static bool boxes_meet(const Box *a, const Box *b) {
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y &&
           b->lower.y <= a->upper.y && a->lower.z <= b->upper.z && b->lower.z <= a->upper.z;
}

static Box box_of_mesh(const HdMesh *mesh) {
    const HdVec3 half = hd_scale(hd_sub(mesh->upper, mesh->lower), 0.5 / hd_mesh_half_side(mesh));
    return (Box){hd_scale(half, -1.0), half};
}

static Box box_of_shell(const HdPlacedMesh *placed, int shell) {
    const HdMesh *mesh = placed->mesh;
    const HdVec3 middle = hd_mesh_centre(mesh);
    const HdShell *of = &placed->shells->shells[shell];
    const double scale = 1.0 / hd_mesh_half_side(mesh);
    return (Box){hd_scale(hd_sub(of->lower, middle), scale),
                 hd_scale(hd_sub(of->upper, middle), scale)};
}

static double half_diagonal(Box box) {
    return 0.5 * hd_length(hd_sub(box.upper, box.lower));
}

/* ---- which shells hold a point ---- */

/* A line through the point: x and y grow by `slope` times z. Directions are such that edges of
   models seldom meet them. */
typedef struct Line {
    HdVec3 point;
    double slope[2];
} Line;

static const double slopes[][2] = {{0.31830989, 0.14142136},  {-0.27182818, 0.57721566},
                                   {0.69314718, -0.41421356}, {-0.61803399, -0.73205081},
                                   {0.05772157, 0.91596559},  {0.83462684, 0.26149721}};

enum { LINE_COUNT = sizeof slopes / sizeof *slopes };

/* A triangle on the line; `side` is 1 above the point, -1 below it, 0 if rounding decides. */
typedef struct Hit {
    int32_t shell, side;
} Hit;

typedef struct Hits {
    int count, capacity;
    Hit *list; /* owned */
} Hits;

/* Narrows the part `span` of the line to where a coordinate is between two bounds. */
static bool clip(double span[2], double from, double slope, double lower, double upper) {
    if (slope == 0.0)
        return lower <= from && from <= upper;
    const double a = (lower - from) / slope, b = (upper - from) / slope;
    span[0] = fmax(span[0], fmin(a, b));
    span[1] = fmin(span[1], fmax(a, b));
    return span[0] <= span[1];
}

static bool meets_box(const Line *line, Box box) {
    const double rounding = 1e-9;
    box = enlarged(box, rounding);
    double span[2] = {box.lower.z - line->point.z, box.upper.z - line->point.z};
    return span[0] <= span[1] &&
           clip(span, line->point.x, line->slope[0], box.lower.x, box.upper.x) &&
           clip(span, line->point.y, line->slope[1], box.lower.y, box.upper.y);
}

/* Returns whether the line meets the triangle, and if so its side. Triangles that share an edge
   compute its term alike but for the sign, so each line meets one of two. */
static bool meets_triangle(const Line *line, const HdMesh *mesh, int32_t triangle, int32_t *side) {
    const double rounding = 1e-14;
    double x[3], y[3], z[3], term[3], sum = 0.0, height = 0.0;
    bool is_sure = true;
    for (int k = 0; k < 3; k++) {
        const HdVec3 at = hd_sub(hd_mesh_corner(mesh, triangle, k), line->point);
        x[k] = at.x - line->slope[0] * at.z;
        y[k] = at.y - line->slope[1] * at.z;
        z[k] = at.z;
    }
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        term[k] = x[a] * y[b] - y[a] * x[b];
        const bool is_near =
            fabs(term[k]) <= rounding * (fabs(x[a]) + fabs(y[a]) + fabs(x[b]) + fabs(y[b]));
        is_sure &= !is_near;
        positive += is_near || term[k] > 0.0;
        negative += is_near || term[k] < 0.0;
        sum += term[k];
        height += term[k] * z[k];
    }
    if (positive < 3 && negative < 3)
        return false;
    *side = !is_sure || height == 0.0 ? 0 : height / sum > 0.0 ? 1 : -1;
    return true;
}

/* Returns false if out of memory. */
static bool hit_leaf(const HdPlacedMesh *placed, const Line *line, int32_t leaf, int but,
                     Hits *hits) {
    const int first = leaf >> HD_LEAF_SHIFT, count = leaf & HD_MAX_LEAF;
    for (int i = first; i < first + count; i++) {
        const int32_t triangle = placed->mesh->tree.order[i];
        Hit hit = {.shell = placed->shells->shell_of[triangle]};
        if (hit.shell != but && meets_triangle(line, placed->mesh, triangle, &hit.side) &&
            !hd_append(&hits->list, sizeof hit, &hits->count, &hits->capacity, &hit))
            return false;
    }
    return true;
}

static bool hit_triangles(const HdPlacedMesh *placed, const Line *line, int but, Hits *hits) {
    int32_t waiting[2 * HD_MAX_HIERARCHY_DEPTH + 2] = {0};
    for (int count = 1; count > 0;) {
        const int32_t child = waiting[--count];
        if (child < 0) {
            if (!hit_leaf(placed, line, ~child, but, hits))
                return false;
            continue;
        }
        const HdBuildNode *node = &placed->mesh->tree.nodes[child];
        for (int i = 0; i < 2; i++)
            if (meets_box(line, box_of_child(&node->box[i])))
                waiting[count++] = node->child[i];
    }
    return true;
}

static int compare_hits(const void *first, const void *second) {
    const Hit *a = first, *b = second;
    return (a->shell > b->shell) - (a->shell < b->shell);
}

/* Lists the shells that the line meets an odd number of times on either side. Returns whether
   rounding decided nothing. */
static bool list_odd(const Hits *hits, HdShellList *list, bool *has_memory) {
    bool is_sure = true;
    list->count = 0;
    for (int i = 0, end; i < hits->count; i = end) {
        int sides[3] = {0};
        for (end = i; end < hits->count && hits->list[end].shell == hits->list[i].shell; end++)
            sides[hits->list[end].side + 1]++;
        is_sure &= sides[1] == 0;
        if (sides[0] % 2 == 1 && sides[1] == 0 && sides[2] % 2 == 1)
            *has_memory &= hd_append(&list->shells, sizeof *list->shells, &list->count,
                                     &list->capacity, &hits->list[i].shell);
    }
    return is_sure;
}

bool hd_shells_around(const HdPlacedMesh *around, HdVec3 point, int but, HdShellList *list) {
    Hits hits = {0};
    bool has_memory = true, is_sure = false;
    for (int i = 0; i < LINE_COUNT && has_memory && !is_sure; i++) {
        const Line line = {point, {slopes[i][0], slopes[i][1]}};
        hits.count = 0;
        has_memory = hit_triangles(around, &line, but, &hits);
        if (hits.count > 0)
            qsort(hits.list, (size_t)hits.count, sizeof *hits.list, compare_hits);
        is_sure = list_odd(&hits, list, &has_memory);
    }
    free(hits.list);
    return has_memory;
}

/* ---- the gap between two shells ---- */

typedef struct Gap {
    const HdPlacedMesh *within, *around;
    int inner, outer;
    double least;    /* distance that is too near, in the coordinates of `around` */
    HdPlacement map; /* from the coordinates of `within` */
    bool is_same;    /* the map changes nothing */
    Box reach;       /* of what is compared within, enlarged by the distance */
} Gap;

typedef struct Triangle {
    HdVec3 corner[3], edge[3], normal;
} Triangle;

static Triangle triangle_of(const Gap *gap, const HdPlacedMesh *placed, int32_t number) {
    Triangle triangle;
    for (int k = 0; k < 3; k++) {
        triangle.corner[k] = hd_mesh_corner(placed->mesh, number, k);
        if (placed == gap->within && !gap->is_same)
            triangle.corner[k] = hd_place(&gap->map, triangle.corner[k]);
    }
    for (int k = 0; k < 3; k++)
        triangle.edge[k] = hd_sub(triangle.corner[(k + 1) % 3], triangle.corner[k]);
    triangle.normal = hd_cross(triangle.edge[0], triangle.edge[1]);
    return triangle;
}

/* Returns whether the projections on an axis are farther apart than `least`. */
static bool separates(HdVec3 axis, const Triangle *a, const Triangle *b, double least) {
    const double a0 = hd_dot(axis, a->corner[0]), a1 = hd_dot(axis, a->corner[1]),
                 a2 = hd_dot(axis, a->corner[2]), b0 = hd_dot(axis, b->corner[0]),
                 b1 = hd_dot(axis, b->corner[1]), b2 = hd_dot(axis, b->corner[2]);
    const double distance = fmax(fmin(a0, fmin(a1, a2)) - fmax(b0, fmax(b1, b2)),
                                 fmin(b0, fmin(b1, b2)) - fmax(a0, fmax(a1, a2)));
    return distance > least * hd_length(axis);
}

/* Tries the axes of contact.c, and for triangles in one plane those across their edges. */
static bool are_separate(const Triangle *a, const Triangle *b, double least) {
    static const HdVec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int i = 0; i < 3; i++)
        if (separates(axes[i], a, b, least))
            return true;
    if (separates(a->normal, a, b, least) || separates(b->normal, a, b, least))
        return true;
    for (int i = 0; i < 3; i++)
        if (separates(hd_cross(a->edge[i], a->normal), a, b, least) ||
            separates(hd_cross(b->edge[i], b->normal), a, b, least))
            return true;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (separates(hd_cross(a->edge[i], b->edge[j]), a, b, least))
                return true;
    return false;
}

/* Returns whether the triangle of each belongs to what is compared. */
static bool is_compared(const Gap *gap, int32_t inner_triangle, int32_t outer_triangle) {
    const int inner = gap->within->shells->shell_of[inner_triangle];
    const int outer = gap->around->shells->shell_of[outer_triangle];
    if (gap->inner != HD_ANY_SHELL)
        return inner == gap->inner && outer == gap->outer;
    return !gap->is_same || inner != outer;
}

static bool leaves_are_clear(const Gap *gap, int32_t inner_leaf, int32_t outer_leaf) {
    const int32_t *inner = gap->within->mesh->tree.order + (inner_leaf >> HD_LEAF_SHIFT);
    const int32_t *outer = gap->around->mesh->tree.order + (outer_leaf >> HD_LEAF_SHIFT);
    for (int i = 0; i < (inner_leaf & HD_MAX_LEAF); i++)
        for (int j = 0; j < (outer_leaf & HD_MAX_LEAF); j++) {
            if (!is_compared(gap, inner[i], outer[j]))
                continue;
            const Triangle a = triangle_of(gap, gap->within, inner[i]);
            const Triangle b = triangle_of(gap, gap->around, outer[j]);
            if (!are_separate(&a, &b, gap->least))
                return false;
        }
    return true;
}

/* A node or a leaf, as HdBuildNode names it, and its box in the coordinates of `around`. */
typedef struct Branch {
    int32_t child, shell; /* the shell of all its triangles, -1: several */
    Box box;
} Branch;

static Branch branch_of(const Gap *gap, const HdPlacedMesh *placed, int32_t node, int number) {
    const HdBuildNode *of = &placed->mesh->tree.nodes[node];
    const Box box = box_of_child(&of->box[number]);
    const bool is_moved = placed == gap->within && !gap->is_same;
    return (Branch){of->child[number], placed->shells->shell_below[node][number],
                    is_moved ? placed_box(&gap->map, box) : box};
}

/* Returns whether nothing of the branches is compared. */
static bool are_others(const Gap *gap, const Branch *inner, const Branch *outer) {
    if (gap->inner == HD_ANY_SHELL)
        return gap->is_same && inner->shell >= 0 && inner->shell == outer->shell;
    return (inner->shell >= 0 && inner->shell != gap->inner) ||
           (outer->shell >= 0 && outer->shell != gap->outer);
}

/* Goes down the larger box first. */
static bool branches_are_clear(const Gap *gap, const Branch *inner, const Branch *outer) {
    const Box near = enlarged(inner->box, gap->least);
    if (!boxes_meet(&near, &outer->box) || !boxes_meet(&outer->box, &gap->reach) ||
        !boxes_meet(&inner->box, &gap->reach) || are_others(gap, inner, outer))
        return true;
    if (inner->child < 0 && outer->child < 0)
        return leaves_are_clear(gap, ~inner->child, ~outer->child);
    const bool is_inner = outer->child < 0 || (inner->child >= 0 && half_diagonal(inner->box) >
                                                                        half_diagonal(outer->box));
    for (int i = 0; i < 2; i++) {
        const Branch part = is_inner ? branch_of(gap, gap->within, inner->child, i)
                                     : branch_of(gap, gap->around, outer->child, i);
        if (!branches_are_clear(gap, is_inner ? &part : inner, is_inner ? outer : &part))
            return false;
    }
    return true;
}

bool hd_shells_are_clear(const HdPlacedMesh *within, int inner, const HdPlacedMesh *around,
                         int outer, double gap) {
    const bool is_any = inner == HD_ANY_SHELL;
    const Box whole[2] = {box_of_mesh(within->mesh), box_of_mesh(around->mesh)};
    Gap work = {within, around, inner, outer, .is_same = within == around};
    work.least = gap * half_diagonal(is_any ? whole[1] : box_of_shell(around, outer));
    work.map = map_between(within, around);
    Branch all[2] = {{0, -1, whole[0]}, {0, -1, whole[1]}};
    work.reach = is_any ? whole[0] : box_of_shell(within, inner);
    if (!work.is_same) {
        all[0].box = placed_box(&work.map, all[0].box);
        work.reach = placed_box(&work.map, work.reach);
    }
    work.reach = enlarged(work.reach, work.least);
    return branches_are_clear(&work, &all[0], &all[1]);
}
