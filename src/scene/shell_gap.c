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
    return hd_boxes_meet(a->lower, a->upper, b->lower, b->upper);
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
    double slope[2], per_slope[2]; /* and its reciprocal */
    Box near;                      /* what is about the point, in the mesh's own coordinates */
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
static bool clip(double span[2], double from, double per_slope, double lower, double upper) {
    const double a = (lower - from) * per_slope, b = (upper - from) * per_slope;
    span[0] = fmax(span[0], fmin(a, b));
    span[1] = fmin(span[1], fmax(a, b));
    return span[0] <= span[1];
}

static bool meets_box(const Line *line, Box box) {
    const double rounding = 1e-9;
    box = enlarged(box, rounding);
    double span[2] = {box.lower.z - line->point.z, box.upper.z - line->point.z};
    return span[0] <= span[1] &&
           clip(span, line->point.x, line->per_slope[0], box.lower.x, box.upper.x) &&
           clip(span, line->point.y, line->per_slope[1], box.lower.y, box.upper.y);
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

static Line line_through(HdVec3 point, const double slope[2], const HdMesh *mesh) {
    const double half = hd_mesh_half_side(mesh), rounding = 1e-9;
    const HdVec3 own = hd_add(hd_mesh_centre(mesh), hd_scale(point, half));
    return (Line){point,
                  {slope[0], slope[1]},
                  {1.0 / slope[0], 1.0 / slope[1]},
                  enlarged((Box){own, own}, rounding * half)};
}

/* Returns false if out of memory. Leaves out shells whose box does not hold the point. */
static bool hit_leaf(const HdPlacedMesh *placed, const Line *line, int32_t leaf, int but,
                     Hits *hits) {
    const int first = leaf >> HD_LEAF_SHIFT, count = leaf & HD_MAX_LEAF;
    for (int i = first; i < first + count; i++) {
        const int32_t triangle = placed->mesh->tree.order[i];
        Hit hit = {.shell = placed->shells->shell_of[triangle]};
        const HdShell *shell = &placed->shells->shells[hit.shell];
        if (hit.shell != but &&
            hd_boxes_meet(shell->lower, shell->upper, line->near.lower, line->near.upper) &&
            meets_triangle(line, placed->mesh, triangle, &hit.side) &&
            !hd_append(&hits->list, sizeof hit, &hits->count, &hits->capacity, &hit))
            return false;
    }
    return true;
}

static bool hit_triangles(const HdPlacedMesh *placed, const Line *line, int but, Hits *hits,
                          int64_t *work) {
    int32_t waiting[HD_MAX_HIERARCHY_DEPTH + 2] = {0};
    for (int count = 1; count > 0;) {
        const int32_t child = waiting[--count];
        --*work;
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

bool hd_shells_around(const HdPlacedMesh *around, HdVec3 point, int but, HdShellList *list,
                      int64_t *work) {
    Hits hits = {0};
    bool has_memory = true, is_sure = false;
    for (int i = 0; i < LINE_COUNT && has_memory && !is_sure; i++) {
        const Line line = line_through(point, slopes[i], around->mesh);
        hits.count = 0;
        has_memory = hit_triangles(around, &line, but, &hits, work);
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
    const HdHierarchy *inner, *outer;
    double least;    /* distance that is too near, in the coordinates of `around` */
    HdPlacement map; /* from the coordinates of `within` */
    bool is_same;    /* the map changes nothing */
    int64_t *work;
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

static bool leaves_are_clear(const Gap *gap, int32_t inner_leaf, int32_t outer_leaf) {
    const int32_t *inner = gap->inner->order + (inner_leaf >> HD_LEAF_SHIFT);
    const int32_t *outer = gap->outer->order + (outer_leaf >> HD_LEAF_SHIFT);
    for (int i = 0; i < (inner_leaf & HD_MAX_LEAF); i++)
        for (int j = 0; j < (outer_leaf & HD_MAX_LEAF); j++) {
            const Triangle a = triangle_of(gap, gap->within, inner[i]);
            const Triangle b = triangle_of(gap, gap->around, outer[j]);
            --*gap->work;
            if (!are_separate(&a, &b, gap->least))
                return false;
        }
    return true;
}

/* A node or a leaf, as HdBuildNode names it, and its box in the coordinates of `around`. */
typedef struct Branch {
    int32_t child;
    Box box;
} Branch;

static Branch branch_of(const Gap *gap, bool is_inner, int32_t node, int number) {
    const HdBuildNode *of = &(is_inner ? gap->inner : gap->outer)->nodes[node];
    const Box box = box_of_child(&of->box[number]);
    return (Branch){of->child[number],
                    is_inner && !gap->is_same ? placed_box(&gap->map, box) : box};
}

/* Goes down the larger box first. */
static bool branches_are_clear(const Gap *gap, const Branch *inner, const Branch *outer) {
    const Box near = enlarged(inner->box, gap->least);
    if (--*gap->work <= 0)
        return false;
    if (!boxes_meet(&near, &outer->box))
        return true;
    if (inner->child < 0 && outer->child < 0)
        return leaves_are_clear(gap, ~inner->child, ~outer->child);
    const bool is_inner = outer->child < 0 || (inner->child >= 0 && half_diagonal(inner->box) >
                                                                        half_diagonal(outer->box));
    for (int i = 0; i < 2; i++) {
        const Branch part = branch_of(gap, is_inner, is_inner ? inner->child : outer->child, i);
        if (!branches_are_clear(gap, is_inner ? &part : inner, is_inner ? outer : &part))
            return false;
    }
    return true;
}

/* Returns the box of a shell in the coordinates of `around`. */
static Box box_between(const HdPlacedMesh *within, int shell, const HdPlacedMesh *around) {
    const Box box = box_of_shell(within, shell);
    if (within == around)
        return box;
    const HdPlacement map = map_between(within, around);
    return placed_box(&map, box);
}

bool hd_shell_boxes_meet(const HdPlacedMesh *a, int first, const HdPlacedMesh *b, int second) {
    const Box box = box_between(a, first, b), other = box_of_shell(b, second);
    return boxes_meet(&box, &other);
}

static bool is_in_box(HdVec3 at, const Box *box) {
    return hd_boxes_meet(at, at, box->lower, box->upper);
}

bool hd_shell_fits(const HdPlacedMesh *within, int inner, const HdPlacedMesh *around, int outer) {
    const Box box = box_of_shell(around, outer);
    if (within == around) {
        const Box same = box_of_shell(within, inner);
        return is_in_box(same.lower, &box) && is_in_box(same.upper, &box);
    }
    const HdShell *shell = &within->shells->shells[inner];
    const int32_t *triangle = within->shells->triangles + shell->first;
    const HdPlacement map = map_between(within, around);
    for (int i = 0; i < shell->count; i++)
        for (int k = 0; k < 3; k++)
            if (!is_in_box(hd_place(&map, hd_mesh_corner(within->mesh, triangle[i], k)), &box))
                return false;
    return true;
}

bool hd_shells_are_clear(const HdPlacedMesh *within, int inner, const HdPlacedMesh *around,
                         int outer, double gap, int64_t *work) {
    const Box box = box_of_shell(around, outer);
    const Gap between = {within,
                         around,
                         hd_shell_tree(within->shells, within->mesh, inner),
                         hd_shell_tree(around->shells, around->mesh, outer),
                         gap * half_diagonal(box),
                         map_between(within, around),
                         within == around,
                         work};
    return branches_are_clear(&between, &(Branch){0, box_between(within, inner, around)},
                              &(Branch){0, box});
}
