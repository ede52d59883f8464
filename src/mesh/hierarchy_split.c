/* SPDX-License-Identifier: MIT */
#include "mesh/hierarchy_split.h"

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
    for (int i = 0; i < binning->count; i++) {
        for (int axis = 0; axis < 3; axis++)
            bins->box[i][axis] = hd_bounds_empty();
        bins->count[i] = (HdIntLanes){0, 0, 0, 0};
    }
}

void hd_bins_add(HdBins *bins, const HdBinning *binning, const HdItem *items, int count) {
    const HdLanes unit = binning->unit, origin = binning->origin, scale = binning->scale;
    for (int i = 0; i < count; i++) {
        const HdLanes lower = items[i].lower.lanes, upper = items[i].upper.lanes;
        const HdIntLanes bin =
            __builtin_convertvector((hd_item_centre(&items[i], unit) - origin) * scale, HdIntLanes);
        hd_bounds_add(&bins->box[bin[0]][0], lower, upper);
        bins->count[bin[0]][0]++;
        hd_bounds_add(&bins->box[bin[1]][1], lower, upper);
        bins->count[bin[1]][1]++;
        hd_bounds_add(&bins->box[bin[2]][2], lower, upper);
        bins->count[bin[2]][2]++;
    }
}

void hd_bins_merge(HdBins *bins, const HdBinning *binning, const HdBins *other) {
    for (int i = 0; i < binning->count; i++) {
        for (int axis = 0; axis < 3; axis++)
            hd_bounds_merge(&bins->box[i][axis], &other->box[i][axis]);
        bins->count[i] += other->count[i];
    }
}

/* costs[i] becomes area times items of the bins from the first one to i, for each axis: NaN, where
   there are none. With a `step` of -1 it goes down from the last one. */
static void sum_costs(HdLanes *costs, const HdBins *bins, const HdBinning *binning, int step) {
    const HdBounds none = hd_bounds_empty();
    HdBounds box[3] = {none, none, none};
    HdIntLanes count = {0, 0, 0, 0};
    int bin = step > 0 ? 0 : binning->count - 1;
    for (int i = 1; i < binning->count; i++) {
        for (int axis = 0; axis < 3; axis++)
            hd_bounds_merge(&box[axis], &bins->box[bin][axis]);
        count += bins->count[bin];
        costs[bin] = hd_bounds_areas(box, binning->unit) * __builtin_convertvector(count, HdLanes);
        bin += step;
    }
}

static HdBounds merge_range(const HdBins *bins, int axis, int begin, int end) {
    HdBounds box = hd_bounds_empty();
    for (int i = begin; i < end; i++)
        hd_bounds_merge(&box, &bins->box[i][axis]);
    return box;
}

HdSplit hd_bins_choose(const HdBins *bins, const HdBinning *binning) {
    HdLanes below[HD_MAX_BINS], above[HD_MAX_BINS];
    sum_costs(below, bins, binning, 1);
    sum_costs(above, bins, binning, -1);
    HdBest best = hd_best_none();
    for (int i = 1; i < binning->count; i++)
        hd_best_offer(&best, below[i - 1] + above[i], i);
    HdSplit split = {.axis = hd_best_axis(&best)};
    if (split.axis < 0)
        return split;
    split.bin = best.place[split.axis];
    for (int i = 0; i < split.bin; i++)
        split.left_count += bins->count[i][split.axis];
    split.left = merge_range(bins, split.axis, 0, split.bin);
    split.right = merge_range(bins, split.axis, split.bin, binning->count);
    return split;
}
