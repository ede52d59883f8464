/* SPDX-License-Identifier: MIT */
/* What a hierarchy is built from: boxes in vectors of four floats, which any compiler keeps in
   registers. For src/hierarchy*.c alone. */
#ifndef HD_HIERARCHY_ITEMS_H
#define HD_HIERARCHY_ITEMS_H

#include <math.h>
#include <stdint.h>

#include "hierarchy.h"

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
    HdLanes result = b;
    for (int i = 0; i < 4; i++)
        result[i] = a[i] < b[i] ? a[i] : b[i];
    return result;
}

static inline HdLanes hd_greater(HdLanes a, HdLanes b) {
    HdLanes result = b;
    for (int i = 0; i < 4; i++)
        result[i] = a[i] > b[i] ? a[i] : b[i];
    return result;
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

/* The same number as that lane of hd_item_centre. */
static inline float hd_item_centre_on(const HdItem *item, float unit, int axis) {
    return item->lower.parts.xyz[axis] * unit + item->upper.parts.xyz[axis] * unit;
}

/* Half the area in `unit`. The lengths of the edges count a little, so that boxes without an area,
   in a line, or with one too small for a float, are still told apart by their size. */
static inline float hd_bounds_area(const HdBounds *bounds, HdLanes unit) {
    const float tiny = 0x1p-40F;
    const HdLanes edges = bounds->upper * unit - bounds->lower * unit;
    const float x = edges[0], y = edges[1], z = edges[2];
    return x * (y + z) + y * z + tiny * (x + y + z);
}

static inline HdBox hd_bounds_box(const HdBounds *bounds) {
    return (HdBox){{bounds->lower[0], bounds->lower[1], bounds->lower[2]},
                   {bounds->upper[0], bounds->upper[1], bounds->upper[2]}};
}

#endif
