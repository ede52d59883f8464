/* SPDX-License-Identifier: MIT */
/* Where to divide the items of a node, by the surface area heuristic. For src/mesh/hierarchy*.c
   alone. */
#ifndef HD_MESH_HIERARCHY_SPLIT_H
#define HD_MESH_HIERARCHY_SPLIT_H

#include "mesh/hierarchy_items.h"

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
    const float centre = hd_item_centre_on(item, binning->unit[axis], axis);
    return (int)((centre - binning->origin[axis]) * binning->scale[axis]);
}

/* Clears the first binning->count bins, adds items to them, adds other bins to them. */
void hd_bins_clear(HdBins *bins, const HdBinning *binning);
void hd_bins_add(HdBins *bins, const HdBinning *binning, const HdItem *items, int count);
void hd_bins_merge(HdBins *bins, const HdBinning *binning, const HdBins *other);

/* The split of the least cost: the sum of area times items on both sides. */
HdSplit hd_bins_choose(const HdBins *bins, const HdBinning *binning);

#endif
