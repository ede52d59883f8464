/* SPDX-License-Identifier: MIT */
#include <string.h>

#include "mesh/hierarchy_subtree.h"

/* A few items, and their order along each axis. A range of places holds the same items on every
   axis, so that a split reorders within its range only. */
typedef struct Sweep {
    HdSubtree *subtree;
    HdItem items[HD_MAX_SWEEP];
    float centre[HD_MAX_SWEEP][4];
    uint8_t sorted[3][HD_MAX_SWEEP];
} Sweep;

/* By insertion, so stable. */
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

/* costs[i] becomes area times items of the group's first i + 1 along each axis; with a `step` of -1
   of the last ones, from the i-th on. */
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

static HdBounds bound(const Sweep *sweep, const uint8_t *sorted, int count) {
    HdBounds box = hd_bounds_empty();
    for (int i = 0; i < count; i++)
        hd_bounds_add(&box, sweep->items[sorted[i]].lower.lanes,
                      sweep->items[sorted[i]].upper.lanes);
    return box;
}

/* Puts the items of the first `left_count` places on `axis` first on the other axes too. */
static void divide(Sweep *sweep, int begin, int count, int axis, int left_count) {
    bool is_left[HD_MAX_SWEEP];
    for (int i = 0; i < count; i++)
        is_left[sweep->sorted[axis][begin + i]] = i < left_count;
    for (int other = 0; other < 3; other++) {
        if (other == axis)
            continue;
        uint8_t *sorted = sweep->sorted[other] + begin, right[HD_MAX_SWEEP];
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

/* Two items have one split only; the axis is the one that tells them apart best. */
static int farthest_axis(const Sweep *sweep, int begin) {
    const float *a = sweep->centre[sweep->sorted[0][begin]];
    const float *b = sweep->centre[sweep->sorted[0][begin + 1]];
    int farthest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabsf(a[axis] - b[axis]) > fabsf(a[farthest] - b[farthest]))
            farthest = axis;
    return farthest;
}

/* Whether the centres of all items are at one place on the axis. */
static bool is_flat(const Sweep *sweep, int begin, int count, int axis) {
    const uint8_t *sorted = sweep->sorted[axis] + begin;
    return !(sweep->centre[sorted[0]][axis] < sweep->centre[sorted[count - 1]][axis]);
}

static int choose(const Sweep *sweep, int begin, int count, int *left_count) {
    *left_count = count / 2;
    if (count == 2)
        return farthest_axis(sweep, begin);
    HdLanes below[HD_MAX_SWEEP], above[HD_MAX_SWEEP];
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

static HdBranch build(Sweep *sweep, const HdGroup *group, int begin) {
    if (group->count == 1)
        return hd_subtree_leaf(group, hd_bounds_area(&group->box, sweep->subtree->unit));
    HdGroup left = {.first = group->first}, right;
    const int axis = choose(sweep, begin, group->count, &left.count);
    divide(sweep, begin, group->count, axis, left.count);
    const uint8_t *sorted = sweep->sorted[axis] + begin;
    right.first = group->first + left.count;
    right.count = group->count - left.count;
    left.box = bound(sweep, sorted, left.count);
    right.box = bound(sweep, sorted + left.count, right.count);
    const int number = hd_subtree_add_node(sweep->subtree, axis, &left.box, &right.box);
    const HdBranch first = build(sweep, &left, begin);
    const HdBranch second = build(sweep, &right, begin + left.count);
    return hd_subtree_join(sweep->subtree, group, number, first, second);
}

HdBranch hd_subtree_sweep(HdSubtree *subtree, const HdGroup *group) {
    if (group->count <= 1)
        return hd_subtree_leaf(group, hd_bounds_area(&group->box, subtree->unit));
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
    const HdBranch branch = build(&sweep, group, 0);
    for (int i = 0; i < group->count; i++)
        items[i] = sweep.items[sweep.sorted[0][i]];
    return branch;
}
