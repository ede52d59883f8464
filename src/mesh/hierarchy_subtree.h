/* SPDX-License-Identifier: MIT */
/* Builds one subtree of a hierarchy on one thread. For src/hierarchy*.c alone. */
#ifndef HD_MESH_HIERARCHY_SUBTREE_H
#define HD_MESH_HIERARCHY_SUBTREE_H

#include <stdbool.h>

#include "mesh/hierarchy_items.h"

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

/* The same for at most HD_MAX_SWEEP items, which are divided at the best of all places between
   them. It does not look at the depth. */
HdBranch hd_subtree_sweep(HdSubtree *subtree, const HdGroup *group);

enum { HD_MAX_SWEEP = 12 };

/* Adds a node and returns its number. */
int hd_subtree_add_node(HdSubtree *subtree, int axis, const HdBounds *left, const HdBounds *right);

HdBranch hd_subtree_leaf(const HdGroup *group, float area);

/* The cheaper one: a leaf of all items, if they are few enough, in which case the node and what
   came after it is dropped; or node `number` with two branches. */
HdBranch hd_subtree_join(HdSubtree *subtree, const HdGroup *group, int number, HdBranch left,
                         HdBranch right);

/* Whether a group must be halved, because its leaves would come too deep otherwise. */
bool hd_group_is_deep(const HdGroup *group, const HdHierarchyOptions *options);

#endif
