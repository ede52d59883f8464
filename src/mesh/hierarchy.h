/* SPDX-License-Identifier: MIT */
/* Bounding volume hierarchies, built by the surface area heuristic. */
#ifndef HD_MESH_HIERARCHY_H
#define HD_MESH_HIERARCHY_H

#include <stdint.h>

#include "base/error.h"
#include "system/thread_pool.h"

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
    float node_cost; /* of visiting a node, in units of testing an item; at least 0 */
    int max_in_leaf; /* 1 .. HD_MAX_LEAF */
} HdHierarchyOptions;

/* Node 0 is the root. A parent comes before its children, which follow it depth first. */
typedef struct HdHierarchy {
    int node_count;
    HdBuildNode *nodes; /* owned */
    int32_t *order;     /* owned; each item once, in the order of the leaves */
    int depth;          /* most nodes on a way from the root to a leaf: no traversal that goes on
                           with one child has more than `depth` others waiting, leaves counted */
} HdHierarchy;

/* Builds a hierarchy over `count` boxes, 1 to HD_MAX_HIERARCHY_ITEMS, finite and with lower <=
   upper, by binned splits (Wald 2007, On fast Construction of SAH-based Bounding Volume
   Hierarchies) on the pool's threads; of few boxes every split is tried. Items share a leaf where
   that costs no more than the nodes that would divide them. The result depends on the boxes and the
   options alone. Where all centres are at one place, or the depth is near its bound of
   HD_MAX_HIERARCHY_DEPTH, items are halved in the middle of their order. One item, or few, still
   make a root: its second child is then a leaf of no items, whose box is empty (lower > upper).

   On the way it takes at most 128 bytes for each box, and at most 8 MB more; what it returns takes
   60 for each node, which is at most one less than the boxes, and 4 for each box. HD_FAILED: out of
   memory. HD_INTERRUPTED: a signal came (interrupt.h). Then `hierarchy` is empty. */
HdStatus hd_hierarchy_build(HdHierarchy *hierarchy, const HdBox *boxes, int count,
                            const HdHierarchyOptions *options, HdThreadPool *pool, HdError *error);

void hd_hierarchy_free(HdHierarchy *hierarchy);

/* The same hierarchy with up to `width` children for each node: bounds are lower x, y, z of all
   children, then upper x, y, z, so 6 * width floats for each node; children as above, in the order
   of their items, and behind them those that are missing: leaves of no items with an empty box.
   Nodes stand as in HdHierarchy. */
typedef struct HdWideHierarchy {
    int node_count, width;
    float *bounds;    /* owned; node_count * 6 * width, aligned to 64 bytes */
    int32_t *child;   /* owned; node_count * width */
    int32_t *root_of; /* owned; for each node of the binary hierarchy the wide node with the same
                         items below it; -1: there is none */
    int depth;        /* most nodes on a way from the root to a leaf: no traversal that goes on
                         with one child has more than (width - 1) * depth others waiting */
} HdWideHierarchy;

/* Merges nodes with their children, of those at hand always the one with the largest area, until
   `width` (2 to 16) children are gathered or only leaves are left (Wald, Benthin and Boulos 2008,
   Getting Rid of Packets). HD_FAILED: out of memory; then `wide` is empty. */
HdStatus hd_hierarchy_widen(HdWideHierarchy *wide, const HdHierarchy *hierarchy, int width,
                            HdError *error);
void hd_wide_hierarchy_free(HdWideHierarchy *wide);

#endif
