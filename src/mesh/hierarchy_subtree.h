/* SPDX-License-Identifier: MIT */
/* Data and functions of building a hierarchy: boxes in vectors of four floats, which compilers keep
   in registers; choice of splits; subtrees, built by one thread. For src/mesh/hierarchy*.c only. */
#ifndef HD_MESH_HIERARCHY_SUBTREE_H
#define HD_MESH_HIERARCHY_SUBTREE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "mesh/hierarchy.h"

typedef float HdLanes __attribute__((vector_size(16)));
typedef int32_t HdIntLanes __attribute__((vector_size(16)));

typedef union HdCorner {
    HdLanes lanes;
    struct {
        float xyz[3];
        int32_t tag;
    } parts;
} HdCorner;

/* The tag of `lower` is the item's number with the bits of HD_ITEM_TAG set. Read as a float it is a
   normal number, so arithmetic on all lanes is not slowed down. */
typedef struct HdItem {
    HdCorner lower, upper;
} HdItem;

enum { HD_ITEM_TAG = 0x40000000 };

/* The fourth lane is unused. */
typedef struct HdBounds {
    HdLanes lower, upper;
} HdBounds;

/* Adjacent items that become a leaf or a node at `depth` (the root's is 1). */
typedef struct HdGroup {
    int first, count, depth;
    HdBounds box;     /* bounds of their boxes */
    HdBounds centres; /* bounds of their centres, in the unit of hd_item_centre */
} HdGroup;

/* Returns b if either is NaN, so that it compiles to one instruction. */
static inline HdLanes hd_min_lanes(HdLanes a, HdLanes b) {
    return (HdLanes){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1],
                     a[2] < b[2] ? a[2] : b[2], a[3] < b[3] ? a[3] : b[3]};
}

static inline HdLanes hd_max_lanes(HdLanes a, HdLanes b) {
    return (HdLanes){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1],
                     a[2] > b[2] ? a[2] : b[2], a[3] > b[3] ? a[3] : b[3]};
}

static inline HdBounds hd_bounds_empty(void) {
    return (HdBounds){{INFINITY, INFINITY, INFINITY, INFINITY},
                      {-INFINITY, -INFINITY, -INFINITY, -INFINITY}};
}

static inline void hd_bounds_add(HdBounds *bounds, HdLanes lower, HdLanes upper) {
    bounds->lower = hd_min_lanes(lower, bounds->lower);
    bounds->upper = hd_max_lanes(upper, bounds->upper);
}

static inline void hd_bounds_merge(HdBounds *bounds, const HdBounds *other) {
    hd_bounds_add(bounds, other->lower, other->upper);
}

/* Returns twice the centre times `unit`, a power of two that scales all coordinates to at most 1,
   so that nothing overflows. The fourth lane is 0. */
static inline HdLanes hd_item_centre(const HdItem *item, HdLanes unit) {
    return item->lower.lanes * unit + item->upper.lanes * unit;
}

/* Returns half the areas of three boxes in `unit`, one a lane. Edge lengths add a little: boxes in
   a line or with an area too small for a float still differ in size. */
static inline HdLanes hd_bounds_areas(const HdBounds boxes[3], HdLanes unit) {
    const HdLanes a = boxes[0].upper * unit - boxes[0].lower * unit;
    const HdLanes b = boxes[1].upper * unit - boxes[1].lower * unit;
    const HdLanes c = boxes[2].upper * unit - boxes[2].lower * unit;
    const HdLanes x = {a[0], b[0], c[0], c[3]};
    const HdLanes y = {a[1], b[1], c[1], c[3]};
    const HdLanes z = {a[2], b[2], c[2], c[3]};
    return x * (y + z) + y * z + 0x1p-40F * (x + y + z);
}

static inline float hd_bounds_area(const HdBounds *bounds, HdLanes unit) {
    const HdLanes edges = bounds->upper * unit - bounds->lower * unit;
    const float x = edges[0], y = edges[1], z = edges[2];
    return x * (y + z) + y * z + 0x1p-40F * (x + y + z);
}

/* The cheapest candidate so far on each axis, and its place. */
typedef struct HdBest {
    HdLanes cost;
    HdIntLanes place;
} HdBest;

static inline HdBest hd_best_none(void) {
    return (HdBest){{INFINITY, INFINITY, INFINITY, INFINITY}, {0, 0, 0, 0}};
}

/* NaN is never cheaper. */
static inline void hd_best_offer(HdBest *best, HdLanes cost, int place) {
    const HdIntLanes cheaper = cost < best->cost;
    best->cost = hd_min_lanes(cost, best->cost);
    best->place = (cheaper & place) | (~cheaper & best->place);
}

/* Returns the cheapest axis; -1: none. */
static inline int hd_best_axis(const HdBest *best) {
    int cheapest = best->cost[0] < INFINITY ? 0 : -1;
    for (int axis = 1; axis < 3; axis++)
        if (best->cost[axis] < (cheapest < 0 ? INFINITY : best->cost[cheapest]))
            cheapest = axis;
    return cheapest;
}

static inline HdBox hd_bounds_box(const HdBounds *bounds) {
    return (HdBox){{bounds->lower[0], bounds->lower[1], bounds->lower[2]},
                   {bounds->upper[0], bounds->upper[1], bounds->upper[2]}};
}

/* ---- choice of a split, by the surface area heuristic ---- */

enum { HD_MAX_BINS = 32 };

/* Slices of equal width on each axis, over the centres of a group. */
typedef struct HdBinning {
    HdLanes unit, origin, scale; /* a scale of 0: all centres coincide on that axis */
    int count;
} HdBinning;

/* Contents of each slice on each axis. */
typedef struct HdBins {
    HdBounds box[HD_MAX_BINS][3];
    HdIntLanes count[HD_MAX_BINS]; /* one lane an axis */
} HdBins;

/* A split: items whose bin on `axis` is less than `bin` go left. */
typedef struct HdSplit {
    int axis; /* -1: all centres coincide */
    int bin, left_count;
    HdBounds left, right; /* bounds of the items of the two sides */
} HdSplit;

HdBinning hd_binning_of(const HdGroup *group, HdLanes unit);

static inline int hd_bin_on(const HdBinning *binning, const HdItem *item, int axis) {
    const float unit = binning->unit[axis]; /* same rounding as hd_item_centre */
    const float centre = item->lower.parts.xyz[axis] * unit + item->upper.parts.xyz[axis] * unit;
    return (int)((centre - binning->origin[axis]) * binning->scale[axis]);
}

/* Clear the first binning->count bins; add items; add other bins. */
void hd_bins_clear(HdBins *bins, const HdBinning *binning);
void hd_bins_add(HdBins *bins, const HdBinning *binning, const HdItem *items, int count);
void hd_bins_merge(HdBins *bins, const HdBinning *binning, const HdBins *other);

/* Returns the split with the least sum of area times items on both sides. */
HdSplit hd_bins_choose(const HdBins *bins, const HdBinning *binning);

/* ---- a subtree ---- */

/* State of building a subtree. */
typedef struct HdSubtree {
    const HdHierarchyOptions *options;
    HdLanes unit;
    HdItem *items;      /* shared by all subtrees; sorted into the order of the leaves */
    HdItem *spare;      /* work space of the same size */
    HdBuildNode *nodes; /* capacity for at least the subtree's items less one */
    int node_count;     /* nodes so far */
} HdSubtree;

/* Result of building a group. */
typedef struct HdBranch {
    int32_t child; /* as in HdBuildNode, relative to the subtree's first node */
    int height;    /* most nodes on a path down from here; 0: a leaf */
    float cost;    /* cost of a ray that meets the box, times its area */
} HdBranch;

/* Builds the cheapest of a leaf and the nodes below `group`. */
HdBranch hd_subtree_build(HdSubtree *subtree, const HdGroup *group);

/* Returns whether a group must be halved to limit the depth of its leaves. */
bool hd_group_is_deep(const HdGroup *group, const HdHierarchyOptions *options);

#endif
