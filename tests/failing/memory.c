/* SPDX-License-Identifier: MIT */
/* Preloaded, a heap that has an end: FAILING_MEMORY_AT is the number, from 1, of the first
   allocation that fails, of those with at least FAILING_MEMORY_SIZE bytes; FAILING_MEMORY_TIMES is
   how many of them fail, 1 if it is not there. FAILING_MEMORY_COUNT names a file that gets their
   number. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* glibc's own, for dlsym() allocates as well. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long counted;

static long number_of(const char *name, long otherwise) {
    const char *text = getenv(name);
    return text != NULL ? atol(text) : otherwise;
}

static bool fails(size_t size) {
    if ((long)size < number_of("FAILING_MEMORY_SIZE", 1))
        return false;
    long at = number_of("FAILING_MEMORY_AT", 0), number = atomic_fetch_add(&counted, 1) + 1;
    if (at == 0 || number < at || number - at >= number_of("FAILING_MEMORY_TIMES", 1))
        return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size) {
    return fails(size) ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    return fails(count * size) ? NULL : __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size) {
    return fails(size) ? NULL : __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
    return fails(size) ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size) {
    if (fails(size))
        return ENOMEM;
    *memory = __libc_memalign(alignment, size);
    return *memory != NULL ? 0 : ENOMEM;
}

__attribute__((destructor)) static void tell_count(void) {
    const char *name = getenv("FAILING_MEMORY_COUNT");
    int file = name != NULL ? open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    if (file >= 0 && dprintf(file, "%ld\n", atomic_load(&counted)) > 0)
        close(file);
}
