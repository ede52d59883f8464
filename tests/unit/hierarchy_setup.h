/* SPDX-License-Identifier: MIT */
/* What the tests of hierarchies start from: a pool of two threads, and allocations that fail when
   they are asked to. Each test program includes it once. */
#ifndef HD_HIERARCHY_SETUP_H
#define HD_HIERARCHY_SETUP_H

#include <stdlib.h>

#include "mesh/hierarchy.h"
#include "system/machine.h"
#include "unit_test.h"
#include "wrapped.h"

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

static int start_pool(void **state) {
    (void)state;
    return hd_thread_pool_create(&pool, 2, &error) != HD_OK;
}

static int end_pool(void **state) {
    (void)state;
    hd_thread_pool_destroy(pool);
    return 0;
}

#endif
