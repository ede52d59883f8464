/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include "system/machine.h"

#include <stdint.h>
#include <stdlib.h>

#include <sys/mman.h>

enum { CACHE_LINE = 64, LARGE_PAGE = 2 << 20 };

void *hd_large_allocate(size_t bytes) {
    const size_t unit = bytes >= LARGE_PAGE ? LARGE_PAGE : CACHE_LINE;
    if (bytes > SIZE_MAX - unit)
        return NULL;
    const size_t rounded = bytes < unit ? unit : (bytes + unit - 1) / unit * unit;
    void *memory = aligned_alloc(unit, rounded);
#ifdef MADV_HUGEPAGE
    /* Only a wish: without it the memory is as good, but slower to get. */
    if (memory != NULL && unit == LARGE_PAGE)
        (void)madvise(memory, rounded, MADV_HUGEPAGE);
#endif
    return memory;
}
