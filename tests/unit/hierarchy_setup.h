/* SPDX-License-Identifier: MIT */
/* What the tests of hierarchies start from: a pool of two threads, allocations that fail when they
   are asked to, and boxes. */
#ifndef HD_HIERARCHY_SETUP_H
#define HD_HIERARCHY_SETUP_H

#include <stdlib.h>

#include "mesh/hierarchy.h"
#include "system/machine.h"
#include "unit_test.h"
#include "wrapped.h"

static const HdHierarchyOptions usual = {1.0F, 4};
static HdError error;
static HdThreadPool *pool;

/* The allocation with this number fails. -1: none. */
static int failing_allocation = -1, allocations;

static void *allocate_or_fail(size_t bytes) {
    if (allocations++ == failing_allocation)
        return NULL;
    return aligned_alloc(64, (bytes + 63) / 64 * 64);
}
REPLACE(hd_large_allocate, allocate_or_fail)

/* Lets each allocation fail in turn, until all are made; returns how many those are. */
static int fail_each(HdStatus (*attempt)(void)) {
    int failing = 0;
    for (HdStatus status = HD_FAILED; status != HD_OK;) {
        allocations = 0;
        failing_allocation = failing++;
        status = attempt();
        failing_allocation = -1;
        if (status != HD_OK) {
            assert_int_equal(status, HD_FAILED);
            expect_contains(error.message, "out of memory: no room for ");
        }
    }
    assert_int_equal(failing - 1, allocations);
    return allocations;
}

static int start_pool(void **state) {
    (void)state;
    return hd_thread_pool_create(&pool, 2, &error) != HD_OK;
}

static int end_pool(void **state) {
    (void)state;
    hd_thread_pool_destroy(pool);
    return 0;
}
GROUP(start_pool, end_pool)

static HdHierarchy build(const HdBox *boxes, int count, const HdHierarchyOptions *options) {
    HdHierarchy hierarchy;
    if (hd_hierarchy_build(&hierarchy, boxes, count, options, pool, &error) != HD_OK)
        fail_msg("%s", error.message);
    return hierarchy;
}

static double half_area(const HdBox *box) {
    const double x = (double)box->upper[0] - (double)box->lower[0];
    const double y = (double)box->upper[1] - (double)box->lower[1];
    const double z = (double)box->upper[2] - (double)box->lower[2];
    return x * (y + z) + y * z;
}

/* The next of a fixed row of numbers, from 0 to below 1. */
static double next_number(uint64_t *state) {
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 40) * 0x1p-24;
}

/* Boxes with corners within `size` of a place in the cube of +-1, everything times `scale`. */
static inline HdBox *random_boxes(int count, double size, double scale, uint64_t seed) {
    HdBox *boxes = malloc((size_t)count * sizeof *boxes);
    for (int i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double at = 2.0 * next_number(&seed) - 1.0;
            const double extent = size * next_number(&seed);
            boxes[i].lower[axis] = (float)(scale * at);
            boxes[i].upper[axis] = (float)(scale * (at + extent));
        }
    return boxes;
}

/* Small boxes in few dense places of very different sizes. */
static inline HdBox *clustered_boxes(int count) {
    enum { CLUSTERS = 7 };
    HdBox *boxes = malloc((size_t)count * sizeof *boxes);
    uint64_t seed = 77;
    for (int i = 0; i < count; i++) {
        const int cluster = i % CLUSTERS;
        const double spread = pow(0.2, cluster);
        for (int axis = 0; axis < 3; axis++) {
            uint64_t of_cluster = (uint64_t)(cluster * 3 + axis + 1) * 0x9E3779B97F4A7C15U;
            const double centre = 2.0 * next_number(&of_cluster) - 1.0;
            const double at = centre + spread * (next_number(&seed) - 0.5);
            boxes[i].lower[axis] = (float)at;
            boxes[i].upper[axis] = (float)(at + 0.05 * spread * next_number(&seed));
        }
    }
    return boxes;
}

enum { DEEP_BOXES = 17 * 6 };

/* Points on the axes, each 64 times nearer to the origin than the last: the outermost point is in a
   bin of its own and all others share one, so that each split takes one point away. */
static void fill_deep(HdBox boxes[DEEP_BOXES]) {
    for (int i = 0; i < DEEP_BOXES; i++) {
        const int axis = i % 6 / 2;
        boxes[i] = (HdBox){{0}, {0}};
        boxes[i].lower[axis] = boxes[i].upper[axis] =
            ldexpf(i % 2 == 0 ? 1.0F : -1.0F, -6 * (i / 6));
    }
}

#endif
