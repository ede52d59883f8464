/* SPDX-License-Identifier: MIT */
/* Helpers for preloaded libraries; _GNU_SOURCE comes before the first header. */
#ifndef FAILING_REAL_H
#define FAILING_REAL_H

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

/* Sets the pointer at `function` to the function of that name behind this library's. */
static inline void find_real(const char *name, void *function) {
    void *found = dlsym(RTLD_NEXT, name);
    memcpy(function, &found, sizeof found);
}

/* Returns the number in an environment variable. */
static inline long number_of(const char *name, long otherwise) {
    const char *text = getenv(name);
    return text != NULL ? atol(text) : otherwise;
}

#endif
