/* SPDX-License-Identifier: MIT */
/* Boxes and nodes of bounding volume hierarchies. */
#ifndef HD_MESH_HIERARCHY_NODE_H
#define HD_MESH_HIERARCHY_NODE_H

#include <stdint.h>

/* An axis-parallel box, in floats. */
typedef struct HdBox {
    float lower[3], upper[3];
} HdBox;

/* A node with two children. A child that is not negative is the number of a node; otherwise ~child
   is first * 16 + count of a leaf: its items are order[first .. first + count - 1]. The centres of
   the first child's items lie lower on `axis`, or at the same place, unless it was halved because
   of its depth. */
typedef struct HdBuildNode {
    HdBox box[2]; /* of the children: no larger than what is in them */
    int32_t child[2];
    int32_t axis;
} HdBuildNode;

enum { HD_LEAF_SHIFT = 4, HD_MAX_LEAF = 15, HD_MAX_HIERARCHY_ITEMS = (1 << 27) - 1 };

enum { HD_MAX_HIERARCHY_DEPTH = 64 };

typedef struct HdHierarchyOptions {
    float node_cost;  /* of visiting a node, in units of testing an item; at least 0 */
    int most_in_leaf; /* 1 .. HD_MAX_LEAF */
} HdHierarchyOptions;

#endif
