/* SPDX-License-Identifier: MIT */
/* Builds one subtree of a hierarchy on one thread. For src/mesh/hierarchy*.c alone. */
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

/* Whether a group must be halved, because its leaves would come too deep otherwise. */
bool hd_group_is_deep(const HdGroup *group, const HdHierarchyOptions *options);

#endif
