/* SPDX-License-Identifier: MIT */
#include "input/json/json_memory.h"

#include <jansson.h>
#include <stdatomic.h>
#include <stdlib.h>

static atomic_bool failed;

static void *allocate(size_t bytes) {
    void *memory = malloc(bytes);
    if (memory == NULL)
        atomic_store(&failed, true);
    return memory;
}

void hd_json_memory_watch(void) {
    atomic_store(&failed, false);
    json_set_alloc_funcs(allocate, free);
}

bool hd_json_memory_failed(void) {
    return atomic_load(&failed);
}
