/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/hierarchy.h"
#include "system/machine.h"

enum { MAX_WIDTH = 16 };

/* Each ancestor of a wide node leaves at most width - 1 others waiting. */
enum { MAX_WAITING = HD_MAX_HIERARCHY_DEPTH * (MAX_WIDTH - 1) + 1 };

/* A node of the binary hierarchy that becomes a wide node. */
typedef struct Waiting {
    int node, depth;
} Waiting;

/* Until all wide nodes are known, a child is its place in the binary hierarchy: twice the parent's
   number, plus 1 for the second child. */
enum { MISSING = -1 };

static const HdBox *box_at(const HdHierarchy *hierarchy, int place) {
    return &hierarchy->nodes[place / 2].box[place % 2];
}

static int32_t child_at(const HdHierarchy *hierarchy, int place) {
    return hierarchy->nodes[place / 2].child[place % 2];
}

static double half_area(const HdBox *box) {
    const double x = (double)box->upper[0] - (double)box->lower[0];
    const double y = (double)box->upper[1] - (double)box->lower[1];
    const double z = (double)box->upper[2] - (double)box->lower[2];
    return x * (y + z) + y * z;
}

/* Places of a wide node's children, in the order of their items. */
typedef struct Children {
    int count;
    int32_t places[MAX_WIDTH];
    double areas[MAX_WIDTH]; /* negative: a leaf */
} Children;

/* Replaces `node`, at index `at`, by its two children. */
static void open_node(Children *children, int at, const HdHierarchy *hierarchy, int node) {
    for (int i = children->count++; i > at + 1; i--) {
        children->places[i] = children->places[i - 1];
        children->areas[i] = children->areas[i - 1];
    }
    for (int side = 0; side < 2; side++) {
        const int place = 2 * node + side;
        const bool is_leaf = child_at(hierarchy, place) < 0;
        children->places[at + side] = place;
        children->areas[at + side] = is_leaf ? -1.0 : half_area(box_at(hierarchy, place));
    }
}

static int find_largest(const Children *children) {
    int largest = 0;
    for (int i = 1; i < children->count; i++)
        if (children->areas[i] > children->areas[largest])
            largest = i;
    return largest;
}

static Children gather(const HdHierarchy *hierarchy, int node, int width) {
    Children children = {.count = 1};
    open_node(&children, 0, hierarchy, node);
    while (children.count < width) {
        const int largest = find_largest(&children);
        if (children.areas[largest] < 0.0)
            break;
        open_node(&children, largest, hierarchy, child_at(hierarchy, children.places[largest]));
    }
    return children;
}

/* Chooses all wide nodes, depth first. */
static void merge(HdWideHierarchy *wide, const HdHierarchy *hierarchy) {
    Waiting waiting[MAX_WAITING];
    int waiting_count = 0;
    waiting[waiting_count++] = (Waiting){0, 1};
    while (waiting_count > 0) {
        const Waiting current = waiting[--waiting_count];
        const int number = wide->node_count++;
        wide->root_of[current.node] = number;
        if (wide->depth < current.depth)
            wide->depth = current.depth;
        const Children children = gather(hierarchy, current.node, wide->width);
        int32_t *places = wide->child + (size_t)number * (size_t)wide->width;
        for (int i = 0; i < wide->width; i++)
            places[i] = i < children.count ? children.places[i] : MISSING;
        for (int i = children.count - 1; i >= 0; i--)
            if (child_at(hierarchy, places[i]) >= 0)
                waiting[waiting_count++] =
                    (Waiting){child_at(hierarchy, places[i]), current.depth + 1};
    }
}

/* Replaces places by boxes and node numbers. */
static void fill_node(HdWideHierarchy *wide, const HdHierarchy *hierarchy, int number) {
    const int width = wide->width;
    float *bounds = wide->bounds + (size_t)number * 6 * (size_t)width;
    int32_t *children = wide->child + (size_t)number * (size_t)width;
    for (int i = 0; i < width; i++) {
        HdBox box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        int32_t child = ~0;
        if (children[i] != MISSING) {
            box = *box_at(hierarchy, children[i]);
            child = child_at(hierarchy, children[i]);
        }
        children[i] = child < 0 ? child : wide->root_of[child];
        for (int axis = 0; axis < 3; axis++) {
            bounds[axis * width + i] = box.lower[axis];
            bounds[(3 + axis) * width + i] = box.upper[axis];
        }
    }
}

static bool widen(HdWideHierarchy *wide, const HdHierarchy *hierarchy) {
    const size_t width = (size_t)wide->width, max_nodes = (size_t)hierarchy->node_count;
    wide->root_of = hd_large_allocate(max_nodes * sizeof *wide->root_of);
    /* A few times as many nodes as needed; untouched memory costs nothing. */
    wide->child = hd_large_allocate(max_nodes * width * sizeof *wide->child);
    if (wide->root_of == NULL || wide->child == NULL)
        return false;
    for (int i = 0; i < hierarchy->node_count; i++)
        wide->root_of[i] = -1;
    merge(wide, hierarchy);
    const size_t count = (size_t)wide->node_count;
    int32_t *shrunk = realloc(wide->child, count * width * sizeof *shrunk);
    if (shrunk != NULL)
        wide->child = shrunk;
    wide->bounds = hd_large_allocate(count * 6 * width * sizeof *wide->bounds);
    if (wide->bounds == NULL)
        return false;
    for (int i = 0; i < wide->node_count; i++)
        fill_node(wide, hierarchy, i);
    return true;
}

HdStatus hd_hierarchy_widen(HdWideHierarchy *wide, const HdHierarchy *hierarchy, int width,
                            HdError *error) {
    *wide = (HdWideHierarchy){.width = width};
    if (widen(wide, hierarchy))
        return HD_OK;
    hd_wide_hierarchy_free(wide);
    return HD_NO_ROOM(error, "%d nodes of %d children", hierarchy->node_count, width);
}

void hd_wide_hierarchy_free(HdWideHierarchy *wide) {
    free(wide->bounds);
    free(wide->child);
    free(wide->root_of);
    *wide = (HdWideHierarchy){0};
}
