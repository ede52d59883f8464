/* SPDX-License-Identifier: MIT */
#include "mesh/hierarchy_subtree.h"

#include <string.h>

#include "mesh/hierarchy_split.h"

int hd_subtree_add_node(HdSubtree *subtree, int axis, const HdBounds *left, const HdBounds *right) {
    HdBuildNode *node = &subtree->nodes[subtree->node_count];
    node->box[0] = hd_bounds_box(left);
    node->box[1] = hd_bounds_box(right);
    node->axis = axis;
    return subtree->node_count++;
}

HdBranch hd_subtree_leaf(const HdGroup *group, float area) {
    return (HdBranch){~(group->first << HD_LEAF_SHIFT | group->count), 0,
                      area * (float)group->count};
}

HdBranch hd_subtree_join(HdSubtree *subtree, const HdGroup *group, int number, HdBranch left,
                         HdBranch right) {
    const HdHierarchyOptions *options = subtree->options;
    const float area = hd_bounds_area(&group->box, subtree->unit);
    const HdBranch leaf = hd_subtree_leaf(group, area);
    const float cost = options->node_cost * area + left.cost + right.cost;
    if (group->count <= options->most_in_leaf && !(cost < leaf.cost)) {
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
    for (int count = group->count; count > options->most_in_leaf; count -= count / 2)
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

/* Stable. Every item is written to both sides, and only one of them goes on: which side it is
   cannot be foretold, and a branch taken wrongly takes longer than a copy. */
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

/* Divides the group and returns the axis. A function of its own, so that the bins are not on the
   stack once for each level. */
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

/* A sweep of n items makes at most n - 1 nodes below each other. */
static bool can_sweep(const HdGroup *group) {
    return group->count <= HD_MAX_SWEEP && group->depth + group->count <= HD_MAX_HIERARCHY_DEPTH;
}

HdBranch hd_subtree_build(HdSubtree *subtree, const HdGroup *group) {
    if (can_sweep(group))
        return hd_subtree_sweep(subtree, group);
    if (group->count == 1 || group->depth > HD_MAX_HIERARCHY_DEPTH)
        return hd_subtree_leaf(group, hd_bounds_area(&group->box, subtree->unit));
    HdGroup sides[2];
    const int axis = divide(subtree, group, sides);
    const int number = hd_subtree_add_node(subtree, axis, &sides[0].box, &sides[1].box);
    const HdBranch left = hd_subtree_build(subtree, &sides[0]);
    const HdBranch right = hd_subtree_build(subtree, &sides[1]);
    return hd_subtree_join(subtree, group, number, left, right);
}
