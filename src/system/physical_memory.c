/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include "system/physical_memory.h"

#include <unistd.h>

static const double small_machine = 2147483648.0;

double hd_physical_memory(void) {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (double)pages * (double)page : small_machine;
}
