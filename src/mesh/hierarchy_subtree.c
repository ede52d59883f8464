/* SPDX-License-Identifier: MIT */
#include "mesh/hierarchy_subtree.h"

#include <string.h>

HdBinning hd_binning_of(const HdGroup *group, HdLanes unit) {
    HdBinning binning = {.unit = unit, .origin = group->centres.lower};
    binning.count = 8 + group->count / 16;
    if (binning.count > HD_MAX_BINS)
        binning.count = HD_MAX_BINS;
    for (int axis = 0; axis < 3; axis++) {
        /* A smaller width would overflow the scale. A factor slightly below the count keeps a
           rounded last centre within the last bin. */
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

/* Sets costs[i] for each axis to area times items of the bins up to i, or, with a `step` of -1,
   from i on. NaN: no items. */
static void sum_bin_costs(HdLanes *costs, const HdBins *bins, const HdBinning *binning, int step) {
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
    sum_bin_costs(below, bins, binning, 1);
    sum_bin_costs(above, bins, binning, -1);
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

enum { MAX_SWEPT = 12 };

/* Adds a node and returns its number. */
static int add_node(HdSubtree *subtree, int axis, const HdBounds *left, const HdBounds *right) {
    HdBuildNode *node = &subtree->nodes[subtree->node_count];
    node->box[0] = hd_bounds_box(left);
    node->box[1] = hd_bounds_box(right);
    node->axis = axis;
    return subtree->node_count++;
}

static HdBranch leaf_of(const HdGroup *group, float area) {
    return (HdBranch){~(group->first << HD_LEAF_SHIFT | group->count), 0,
                      area * (float)group->count};
}

/* Returns the cheaper of a leaf, if its items are few enough, and node `number` with two branches.
   Choosing the leaf drops that node and all after it. */
static HdBranch join(HdSubtree *subtree, const HdGroup *group, int number, HdBranch left,
                     HdBranch right) {
    const HdHierarchyOptions *options = subtree->options;
    const float area = hd_bounds_area(&group->box, subtree->unit);
    const HdBranch leaf = leaf_of(group, area);
    const float cost = options->node_cost * area + left.cost + right.cost;
    if (group->count <= options->max_in_leaf && !(cost < leaf.cost)) {
        subtree->node_count = number;
        return leaf;
    }
    subtree->nodes[number].child[0] = left.child;
    subtree->nodes[number].child[1] = right.child;
    const int height = left.height > right.height ? left.height : right.height;
    return (HdBranch){number, height + 1, cost};
}

bool hd_group_is_deep(const HdGroup *group, const HdHierarchyOptions *options) {
    int levels = 0;
    for (int count = group->count; count > options->max_in_leaf; count -= count / 2)
        levels++;
    return group->depth + levels > HD_MAX_HIERARCHY_DEPTH;
}

static void bound(HdGroup *group, const HdItem *items, HdLanes unit) {
    group->box = group->centres = hd_bounds_empty();
    for (int i = group->first; i < group->first + group->count; i++) {
        const HdLanes centre = hd_item_centre(&items[i], unit);
        hd_bounds_add(&group->box, items[i].lower.lanes, items[i].upper.lanes);
        hd_bounds_add(&group->centres, centre, centre);
    }
}

static void halve(const HdSubtree *subtree, const HdGroup *group, HdGroup sides[2]) {
    sides[1].count = group->count / 2;
    sides[0].count = group->count - sides[1].count;
    sides[1].first = group->first + sides[0].count;
    for (int side = 0; side < 2; side++)
        bound(&sides[side], subtree->items, subtree->unit);
}

/* Partitions stably. Writes each item to both sides and advances one of them: a mispredicted branch
   takes longer than a copy. */
static void partition(const HdSubtree *subtree, const HdGroup *group, const HdBinning *binning,
                      const HdSplit *split, HdGroup sides[2]) {
    HdItem *items = subtree->items + group->first, *right = subtree->spare + group->first;
    HdBounds centres[2] = {hd_bounds_empty(), hd_bounds_empty()};
    int lefts = 0, rights = 0;
    for (int i = 0; i < group->count; i++) {
        const HdItem item = items[i];
        const int is_right = hd_bin_on(binning, &item, split->axis) >= split->bin;
        const HdLanes centre = hd_item_centre(&item, subtree->unit);
        items[lefts] = right[rights] = item;
        lefts += 1 - is_right;
        rights += is_right;
        hd_bounds_add(&centres[is_right], centre, centre);
    }
    memcpy(items + lefts, right, (size_t)rights * sizeof *right);
    sides[0].count = lefts;
    sides[1].count = rights;
    sides[1].first = group->first + lefts;
    sides[0].box = split->left;
    sides[1].box = split->right;
    sides[0].centres = centres[0];
    sides[1].centres = centres[1];
}

/* Divides the group and returns the axis. A separate function keeps the bins off the stack of the
   recursion. */
static int divide(const HdSubtree *subtree, const HdGroup *group, HdGroup sides[2]) {
    sides[0].first = group->first;
    sides[0].depth = sides[1].depth = group->depth + 1;
    if (!hd_group_is_deep(group, subtree->options)) {
        HdBins bins;
        const HdBinning binning = hd_binning_of(group, subtree->unit);
        hd_bins_clear(&bins, &binning);
        hd_bins_add(&bins, &binning, subtree->items + group->first, group->count);
        const HdSplit split = hd_bins_choose(&bins, &binning);
        if (split.axis >= 0) {
            partition(subtree, group, &binning, &split, sides);
            return split.axis;
        }
    }
    halve(subtree, group, sides);
    return 0;
}

/* Few items, and their order along each axis. A range of places holds the same items on every axis,
   so a split reorders within its range only. */
typedef struct Sweep {
    HdSubtree *subtree;
    HdItem items[MAX_SWEPT];
    float centre[MAX_SWEPT][4];
    uint8_t sorted[3][MAX_SWEPT];
} Sweep;

/* Sorts by insertion, which is stable. */
static void sort(Sweep *sweep, int count, int axis) {
    uint8_t *sorted = sweep->sorted[axis];
    for (int i = 0; i < count; i++) {
        const float centre = sweep->centre[i][axis];
        int at = i;
        for (; at > 0 && centre < sweep->centre[sorted[at - 1]][axis]; at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = (uint8_t)i;
    }
}

/* Sets costs[i] for each axis to area times items of the group's first i + 1, or, with a `step` of
   -1, from the i-th on. */
static void sum_costs(HdLanes *costs, const Sweep *sweep, int begin, int count, int step) {
    const HdBounds none = hd_bounds_empty();
    HdBounds box[3] = {none, none, none};
    int at = step > 0 ? 0 : count - 1;
    for (int i = 1; i < count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const HdItem *item = &sweep->items[sweep->sorted[axis][begin + at]];
            hd_bounds_add(&box[axis], item->lower.lanes, item->upper.lanes);
        }
        costs[at] = hd_bounds_areas(box, sweep->subtree->unit) * (float)i;
        at += step;
    }
}

static HdBounds bound_range(const Sweep *sweep, const uint8_t *sorted, int count) {
    HdBounds box = hd_bounds_empty();
    for (int i = 0; i < count; i++)
        hd_bounds_add(&box, sweep->items[sorted[i]].lower.lanes,
                      sweep->items[sorted[i]].upper.lanes);
    return box;
}

/* Moves the items of the first `left_count` places on `axis` to the front on the other axes too. */
static void divide_sweep(Sweep *sweep, int begin, int count, int axis, int left_count) {
    bool is_left[MAX_SWEPT];
    for (int i = 0; i < count; i++)
        is_left[sweep->sorted[axis][begin + i]] = i < left_count;
    for (int other = 0; other < 3; other++) {
        if (other == axis)
            continue;
        uint8_t *sorted = sweep->sorted[other] + begin, right[MAX_SWEPT];
        int lefts = 0, rights = 0;
        for (int i = 0; i < count; i++) {
            const uint8_t item = sorted[i];
            sorted[lefts] = right[rights] = item;
            lefts += is_left[item];
            rights += !is_left[item];
        }
        memcpy(sorted + lefts, right, (size_t)rights);
    }
}

/* Returns the axis that separates two items best; they have one split only. */
static int farthest_axis(const Sweep *sweep, int begin) {
    const float *a = sweep->centre[sweep->sorted[0][begin]];
    const float *b = sweep->centre[sweep->sorted[0][begin + 1]];
    int farthest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabsf(a[axis] - b[axis]) > fabsf(a[farthest] - b[farthest]))
            farthest = axis;
    return farthest;
}

/* Returns whether the centres of all items coincide on the axis. */
static bool is_flat(const Sweep *sweep, int begin, int count, int axis) {
    const uint8_t *sorted = sweep->sorted[axis] + begin;
    return !(sweep->centre[sorted[0]][axis] < sweep->centre[sorted[count - 1]][axis]);
}

static int choose(const Sweep *sweep, int begin, int count, int *left_count) {
    *left_count = count / 2;
    if (count == 2)
        return farthest_axis(sweep, begin);
    HdLanes below[MAX_SWEPT], above[MAX_SWEPT];
    sum_costs(below, sweep, begin, count, 1);
    sum_costs(above, sweep, begin, count, -1);
    HdBest best = hd_best_none();
    for (int i = 1; i < count; i++)
        hd_best_offer(&best, below[i - 1] + above[i], i);
    for (int axis = 0; axis < 3; axis++)
        if (is_flat(sweep, begin, count, axis))
            best.cost[axis] = INFINITY;
    const int axis = hd_best_axis(&best);
    if (axis < 0)
        return 0;
    *left_count = best.place[axis];
    return axis;
}

static HdBranch build_sweep(Sweep *sweep, const HdGroup *group, int begin) {
    if (group->count == 1)
        return leaf_of(group, hd_bounds_area(&group->box, sweep->subtree->unit));
    HdGroup left = {.first = group->first}, right;
    const int axis = choose(sweep, begin, group->count, &left.count);
    divide_sweep(sweep, begin, group->count, axis, left.count);
    const uint8_t *sorted = sweep->sorted[axis] + begin;
    right.first = group->first + left.count;
    right.count = group->count - left.count;
    left.box = bound_range(sweep, sorted, left.count);
    right.box = bound_range(sweep, sorted + left.count, right.count);
    const int number = add_node(sweep->subtree, axis, &left.box, &right.box);
    const HdBranch first = build_sweep(sweep, &left, begin);
    const HdBranch second = build_sweep(sweep, &right, begin + left.count);
    return join(sweep->subtree, group, number, first, second);
}

/* As hd_subtree_build for at most MAX_SWEPT items; tries all splits. Ignores the depth. */
static HdBranch sweep_group(HdSubtree *subtree, const HdGroup *group) {
    HdItem *items = subtree->items + group->first;
    Sweep sweep;
    sweep.subtree = subtree;
    for (int i = 0; i < group->count; i++) {
        sweep.items[i] = items[i];
        const HdLanes centre = hd_item_centre(&items[i], subtree->unit);
        memcpy(sweep.centre[i], &centre, sizeof centre);
    }
    for (int axis = 0; axis < 3; axis++)
        sort(&sweep, group->count, axis);
    const HdBranch branch = build_sweep(&sweep, group, 0);
    for (int i = 0; i < group->count; i++)
        items[i] = sweep.items[sweep.sorted[0][i]];
    return branch;
}

HdBranch hd_subtree_build(HdSubtree *subtree, const HdGroup *group) {
    /* A sweep of n items nests at most n - 1 nodes. */
    if (group->count <= MAX_SWEPT && group->depth + group->count <= HD_MAX_HIERARCHY_DEPTH)
        return sweep_group(subtree, group);
    if (group->count == 1 || group->depth > HD_MAX_HIERARCHY_DEPTH)
        return leaf_of(group, hd_bounds_area(&group->box, subtree->unit));
    HdGroup sides[2];
    const int axis = divide(subtree, group, sides);
    const int number = add_node(subtree, axis, &sides[0].box, &sides[1].box);
    const HdBranch left = hd_subtree_build(subtree, &sides[0]);
    const HdBranch right = hd_subtree_build(subtree, &sides[1]);
    return join(subtree, group, number, left, right);
}
