/* SPDX-License-Identifier: MIT */
/* What a hierarchy is built from, boxes in vectors of four floats, which any compiler keeps in
   registers; where items are divided; and how one thread builds a subtree. For
   src/mesh/hierarchy*.c alone. */
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

/* The tag of `lower` is the item's number with the bits of HD_ITEM_TAG set: as a float it is then a
   normal number, which costs no more than others where all lanes are computed with. */
typedef struct HdItem {
    HdCorner lower, upper;
} HdItem;

enum { HD_ITEM_TAG = 0x40000000 };

/* The fourth lane is of no account. */
typedef struct HdBounds {
    HdLanes lower, upper;
} HdBounds;

/* Items that lie side by side, to become a leaf or a node at `depth` (the root's is 1). */
typedef struct HdGroup {
    int first, count, depth;
    HdBounds box;     /* about their boxes */
    HdBounds centres; /* about their centres, in the unit of hd_item_centre */
} HdGroup;

/* Where either is NaN the result is b. Written so that it becomes one instruction. */
static inline HdLanes hd_lesser(HdLanes a, HdLanes b) {
    return (HdLanes){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1],
                     a[2] < b[2] ? a[2] : b[2], a[3] < b[3] ? a[3] : b[3]};
}

static inline HdLanes hd_greater(HdLanes a, HdLanes b) {
    return (HdLanes){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1],
                     a[2] > b[2] ? a[2] : b[2], a[3] > b[3] ? a[3] : b[3]};
}

static inline HdBounds hd_bounds_empty(void) {
    return (HdBounds){{INFINITY, INFINITY, INFINITY, INFINITY},
                      {-INFINITY, -INFINITY, -INFINITY, -INFINITY}};
}

static inline void hd_bounds_add(HdBounds *bounds, HdLanes lower, HdLanes upper) {
    bounds->lower = hd_lesser(lower, bounds->lower);
    bounds->upper = hd_greater(upper, bounds->upper);
}

static inline void hd_bounds_merge(HdBounds *bounds, const HdBounds *other) {
    hd_bounds_add(bounds, other->lower, other->upper);
}

/* Twice the centre, times `unit`: a power of two by which no coordinate is above 1, so that nothing
   overflows; 0 in the fourth lane. */
static inline HdLanes hd_item_centre(const HdItem *item, HdLanes unit) {
    return item->lower.lanes * unit + item->upper.lanes * unit;
}

/* Half the areas of three boxes in `unit`, one in each lane. The lengths of the edges count a
   little, so that boxes without an area, in a line, or with one too small for a float, are still
   told apart by their size. */
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

/* Of candidates on three axes the cheapest so far, and its place. */
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
    best->cost = hd_lesser(cost, best->cost);
    best->place = (cheaper & place) | (~cheaper & best->place);
}

/* The cheapest axis; -1: none. */
static inline int hd_best_axis(const HdBest *best) {
    int least = best->cost[0] < INFINITY ? 0 : -1;
    for (int axis = 1; axis < 3; axis++)
        if (best->cost[axis] < (least < 0 ? INFINITY : best->cost[least]))
            least = axis;
    return least;
}

static inline HdBox hd_bounds_box(const HdBounds *bounds) {
    return (HdBox){{bounds->lower[0], bounds->lower[1], bounds->lower[2]},
                   {bounds->upper[0], bounds->upper[1], bounds->upper[2]}};
}

/* ---- where to divide the items of a node, by the surface area heuristic ---- */

enum { HD_MAX_BINS = 32 };

/* The same slices of equal width on each axis, over the centres of a group. */
typedef struct HdBinning {
    HdLanes unit, origin, scale; /* a scale of 0: all centres are at one place on that axis */
    int count;
} HdBinning;

/* What falls into each slice, on each axis. */
typedef struct HdBins {
    HdBounds box[HD_MAX_BINS][3];
    HdIntLanes count[HD_MAX_BINS]; /* lane for axis */
} HdBins;

/* Items whose bin on `axis` is less than `bin` go left. */
typedef struct HdSplit {
    int axis; /* -1: all centres are at one place */
    int bin, left_count;
    HdBounds left, right; /* boxes about the items of the two sides */
} HdSplit;

HdBinning hd_binning_of(const HdGroup *group, HdLanes unit);

static inline int hd_bin_on(const HdBinning *binning, const HdItem *item, int axis) {
    const float unit = binning->unit[axis]; /* as hd_item_centre */
    const float centre = item->lower.parts.xyz[axis] * unit + item->upper.parts.xyz[axis] * unit;
    return (int)((centre - binning->origin[axis]) * binning->scale[axis]);
}

/* Clears the first binning->count bins, adds items to them, adds other bins to them. */
void hd_bins_clear(HdBins *bins, const HdBinning *binning);
void hd_bins_add(HdBins *bins, const HdBinning *binning, const HdItem *items, int count);
void hd_bins_merge(HdBins *bins, const HdBinning *binning, const HdBins *other);

/* The split of the least cost: the sum of area times items on both sides. */
HdSplit hd_bins_choose(const HdBins *bins, const HdBinning *binning);

/* ---- a subtree ---- */

/* Where a subtree is built. */
typedef struct HdSubtree {
    const HdHierarchyOptions *options;
    HdLanes unit;
    HdItem *items;      /* of all subtrees; put into the order of the leaves */
    HdItem *spare;      /* as many, for work */
    HdBuildNode *nodes; /* room for one less than the subtree's items, at least */
    int node_count;     /* so far */
} HdSubtree;

/* What became of a group. */
typedef struct HdBranch {
    int32_t child; /* as in HdBuildNode, counted from the subtree's first node */
    int height;    /* most nodes on a way down from here; 0: a leaf */
    float cost;    /* of a ray that meets the box, times its area */
} HdBranch;

/* The cheapest of a leaf and the nodes below `group`. */
HdBranch hd_subtree_build(HdSubtree *subtree, const HdGroup *group);

/* Whether a group must be halved, because its leaves would come too deep otherwise. */
bool hd_group_is_deep(const HdGroup *group, const HdHierarchyOptions *options);

#endif
