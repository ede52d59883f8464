/* SPDX-License-Identifier: MIT */
/* Builds bounding volume hierarchies by the surface area heuristic. */
#ifndef HD_HIERARCHY_H
#define HD_HIERARCHY_H

#include <stdint.h>

#include "error.h"
#include "thread_pool.h"

/* An axis-parallel box, in floats. */
typedef struct HdBox {
    float lower[3], upper[3];
} HdBox;

/* A node with two children. A child that is not negative is the number of a node; otherwise ~child
   is first * 16 + count of a leaf: its items are order[first .. first + count - 1]. The first child
   lies lower on `axis`. */
typedef struct HdBuildNode {
    HdBox box[2]; /* of the children */
    int32_t child[2];
    int32_t axis;
} HdBuildNode;

enum { HD_LEAF_SHIFT = 4, HD_MAX_LEAF = 15 };

/* Node 0 is the root. A parent comes before its children, which follow it depth first. */
typedef struct HdHierarchy {
    int node_count;
    HdBuildNode *nodes; /* owned */
    int32_t *order;     /* owned; each item once, in the order of the leaves */
    int depth;          /* most nodes on a way from the root to a leaf: no traversal that goes on
                           with one child has more than `depth` others waiting */
} HdHierarchy;

typedef struct HdHierarchyOptions {
    float node_cost;  /* of visiting a node, in units of testing an item */
    int most_in_leaf; /* 1 .. HD_MAX_LEAF */
} HdHierarchyOptions;

/* Builds a hierarchy over `count` >= 1 boxes, finite and not empty, by binned splits (Wald 2007, On
   fast Construction of SAH-based Bounding Volume Hierarchies) on the pool's threads. The result
   depends on the boxes and the options alone. Where no split helps or the depth is near its bound
   of HD_MAX_HIERARCHY_DEPTH, items are halved at their median. One item, or few, still make a root:
   its second child is then a leaf of no items, whose box is empty (lower > upper). */
HdStatus hd_hierarchy_build(HdHierarchy *hierarchy, const HdBox *boxes, int count,
                            const HdHierarchyOptions *options, HdThreadPool *pool, HdError *error);

enum { HD_MAX_HIERARCHY_DEPTH = 64 };

void hd_hierarchy_free(HdHierarchy *hierarchy);

/* The same hierarchy with up to `width` children for each node: bounds are lower x, y, z of all
   children, then upper x, y, z, so 6 * width floats for each node; children as above, those that
   are missing leaves of no items with an empty box. */
typedef struct HdWideHierarchy {
    int node_count, width;
    float *bounds;    /* owned; node_count * 6 * width, aligned to 64 bytes */
    int32_t *child;   /* owned; node_count * width */
    int32_t *root_of; /* owned; for each node of the binary hierarchy the wide node with the same
                         items below it; -1: there is none */
    int depth;        /* likewise */
} HdWideHierarchy;

/* Merges nodes with their children, those of the largest area first (Wald, Benthin and Boulos 2008,
   Getting Rid of Packets). */
HdStatus hd_hierarchy_widen(HdWideHierarchy *wide, const HdHierarchy *hierarchy, int width,
                            HdError *error);
void hd_wide_hierarchy_free(HdWideHierarchy *wide);

#endif
