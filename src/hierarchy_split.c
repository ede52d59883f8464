/* SPDX-License-Identifier: MIT */
#include "hierarchy_split.h"

#include <stdbool.h>

HdBinning hd_binning_of(const HdGroup *group, HdLanes unit) {
    HdBinning binning = {.unit = unit, .origin = group->centres.lower};
    binning.count = 8 + group->count / 16;
    if (binning.count > HD_MAX_BINS)
        binning.count = HD_MAX_BINS;
    for (int axis = 0; axis < 3; axis++) {
        /* Below that the scale would overflow. With a little less than the count, rounding never
           takes the last centre beyond the last bin. */
        const float width = group->centres.upper[axis] - group->centres.lower[axis];
        if (width > 0x1p-100F)
            binning.scale[axis] = (float)binning.count * 0.9999F / width;
    }
    return binning;
}

void hd_bins_clear(HdBins *bins, const HdBinning *binning) {
    for (int i = 0; i < binning->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            bins->box[i][axis] = hd_bounds_empty();
            bins->count[i][axis] = 0;
        }
}

void hd_bins_add(HdBins *bins, const HdBinning *binning, const HdItem *items, int count) {
    const HdLanes unit = binning->unit, origin = binning->origin, scale = binning->scale;
    for (int i = 0; i < count; i++) {
        const HdLanes lower = items[i].lower.lanes, upper = items[i].upper.lanes;
        const HdIntLanes bin = __builtin_convertvector(
            (hd_item_centre(&items[i], unit) - origin) * scale, HdIntLanes);
        hd_bounds_add(&bins->box[bin[0]][0], lower, upper);
        bins->count[bin[0]][0]++;
        hd_bounds_add(&bins->box[bin[1]][1], lower, upper);
        bins->count[bin[1]][1]++;
        hd_bounds_add(&bins->box[bin[2]][2], lower, upper);
        bins->count[bin[2]][2]++;
    }
}

void hd_bins_merge(HdBins *bins, const HdBinning *binning, const HdBins *other) {
    for (int i = 0; i < binning->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            hd_bounds_merge(&bins->box[i][axis], &other->box[i][axis]);
            bins->count[i][axis] += other->count[i][axis];
        }
}

/* Area times items of all bins from each one on, for each axis. */
static void sum_from_above(float costs[][3], const HdBins *bins, const HdBinning *binning) {
    HdBounds box[3] = {hd_bounds_empty(), hd_bounds_empty(), hd_bounds_empty()};
    int32_t count[3] = {0, 0, 0};
    for (int i = binning->count - 1; i > 0; i--)
        for (int axis = 0; axis < 3; axis++) {
            hd_bounds_merge(&box[axis], &bins->box[i][axis]);
            count[axis] += bins->count[i][axis];
            costs[i][axis] = hd_bounds_area(&box[axis], binning->unit) * (float)count[axis];
        }
}

static HdBounds merge_range(const HdBins *bins, int axis, int begin, int end) {
    HdBounds box = hd_bounds_empty();
    for (int i = begin; i < end; i++)
        hd_bounds_merge(&box, &bins->box[i][axis]);
    return box;
}

HdSplit hd_bins_choose(const HdBins *bins, const HdBinning *binning) {
    float above[HD_MAX_BINS][3];
    sum_from_above(above, bins, binning);
    HdSplit split = {.axis = -1};
    float least = INFINITY;
    HdBounds box[3] = {hd_bounds_empty(), hd_bounds_empty(), hd_bounds_empty()};
    int32_t count[3] = {0, 0, 0};
    for (int i = 1; i < binning->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            hd_bounds_merge(&box[axis], &bins->box[i - 1][axis]);
            count[axis] += bins->count[i - 1][axis];
            /* NaN, and so not less, where all items are on one side: no items times no area. */
            const float cost =
                hd_bounds_area(&box[axis], binning->unit) * (float)count[axis] + above[i][axis];
            if (cost < least) {
                least = cost;
                split.axis = axis;
                split.bin = i;
                split.left_count = count[axis];
            }
        }
    if (split.axis >= 0) {
        split.left = merge_range(bins, split.axis, 0, split.bin);
        split.right = merge_range(bins, split.axis, split.bin, binning->count);
    }
    return split;
}
