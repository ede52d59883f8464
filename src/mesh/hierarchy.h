/* SPDX-License-Identifier: MIT */
/* Bounding volume hierarchies, built by the surface area heuristic. */
#ifndef HD_MESH_HIERARCHY_H
#define HD_MESH_HIERARCHY_H

#include <stdint.h>

#include "base/error.h"
#include "system/thread_pool.h"

/* An axis-parallel box in floats. */
typedef struct HdBox {
    float lower[3], upper[3];
} HdBox;

/* A node with two children. A child >= 0 is a node; otherwise ~child is first * 16 + count of a
   leaf with the items order[first .. first + count - 1]. The centres of the first child's items are
   not above those of the second on `axis`, unless the depth forced a halving. */
typedef struct HdBuildNode {
    HdBox box[2]; /* tight boxes of the children */
    int32_t child[2];
    int32_t axis;
} HdBuildNode;

enum { HD_LEAF_SHIFT = 4, HD_MAX_LEAF = 15, HD_MAX_HIERARCHY_ITEMS = (1 << 27) - 1 };

enum { HD_MAX_HIERARCHY_DEPTH = 64 };

typedef struct HdHierarchyOptions {
    float node_cost; /* cost of visiting a node, in item tests; at least 0 */
    int max_in_leaf; /* 1 .. HD_MAX_LEAF */
} HdHierarchyOptions;

/* Node 0 is the root. Parents precede their children, depth first. */
typedef struct HdHierarchy {
    int node_count;
    HdBuildNode *nodes; /* owned */
    int32_t *order;     /* owned; each item once, in the order of the leaves */
    int depth; /* most nodes on a path from the root to a leaf: depth-first traversal keeps at most
                  `depth` pending children, leaves included */
} HdHierarchy;

/* Builds a hierarchy over `count` finite boxes with lower <= upper, 1 to HD_MAX_HIERARCHY_ITEMS, on
   the pool's threads. Uses binned splits (Wald 2007, On fast Construction of SAH-based Bounding
   Volume Hierarchies); tries every split of a few boxes. Items share a leaf if that costs no more
   than the nodes dividing them. The result depends on the boxes and the options only. Halves the
   items in their order if all centres coincide or the depth nears HD_MAX_HIERARCHY_DEPTH. A single
   leaf still gets a root, whose second child is an empty leaf with an empty box (lower > upper).
   Working memory: at most 128 bytes a box and 8 MB. Result: 60 bytes a node, with fewer nodes than
   boxes unless there is one box, and 4 bytes a box. HD_FAILED: out of memory. HD_INTERRUPTED: a
   signal came (interrupt.h). `hierarchy` is then empty. */
HdStatus hd_hierarchy_build(HdHierarchy *hierarchy, const HdBox *boxes, int count,
                            const HdHierarchyOptions *options, HdThreadPool *pool, HdError *error);

void hd_hierarchy_free(HdHierarchy *hierarchy);

/* A hierarchy with up to `width` children a node. Bounds are 6 * width floats: lower x, y, z of all
   children, then upper x, y, z. Children are as above, in the order of their items, then empty
   leaves with empty boxes up to `width`. Nodes are ordered as in HdHierarchy. */
typedef struct HdWideHierarchy {
    int node_count, width;
    float *bounds;    /* owned; node_count * 6 * width, aligned to 64 bytes */
    int32_t *child;   /* owned; node_count * width */
    int32_t *root_of; /* owned; for each node of the binary hierarchy the wide node with the same
                         items; -1: none */
    int depth; /* most nodes on a path from the root to a leaf: depth-first traversal keeps at most
                  (width - 1) * depth pending children */
} HdWideHierarchy;

/* Merges nodes with their children, the largest area first, until `width` (2 to 16) children or
   only leaves remain (Wald, Benthin and Boulos 2008, Getting Rid of Packets). HD_FAILED: out of
   memory; `wide` is then empty. */
HdStatus hd_hierarchy_widen(HdWideHierarchy *wide, const HdHierarchy *hierarchy, int width,
                            HdError *error);
void hd_wide_hierarchy_free(HdWideHierarchy *wide);

#endif
