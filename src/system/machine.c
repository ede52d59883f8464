/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include "system/machine.h"

#include <fcntl.h>
#include <glob.h>
#include <limits.h>
#include <pthread.h>
#include <sched.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <sys/mman.h>

#include "system/path.h"

enum { CACHE_LINE = 64, LARGE_PAGE = 2 << 20 };

static const double small_machine = 2147483648.0;

double hd_monotonic_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int hd_processor_count(void) {
#ifdef CPU_COUNT
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
#endif
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

double hd_physical_memory(void) {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (double)pages * (double)page : small_machine;
}

int hd_free_descriptors(void) {
    const unsigned long limit = (unsigned long)sysconf(_SC_OPEN_MAX); /* -1: unlimited */
    const int lowest = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (lowest < 0)
        return 0;
    close(lowest);
    return limit > INT_MAX ? INT_MAX : (int)limit - lowest;
}

void *hd_large_allocate(size_t bytes) {
    const size_t unit = bytes >= LARGE_PAGE ? LARGE_PAGE : CACHE_LINE;
    if (bytes > SIZE_MAX - unit)
        return NULL;
    const size_t rounded = bytes < unit ? unit : (bytes + unit - 1) / unit * unit;
    void *memory = aligned_alloc(unit, rounded);
#ifdef MADV_HUGEPAGE
    /* Only a hint: without it the pages are small and slower to get. */
    if (memory != NULL && unit == LARGE_PAGE)
        (void)madvise(memory, rounded, MADV_HUGEPAGE);
#endif
    return memory;
}

static bool is_set(const char *variable) {
    const char *value = getenv(variable);
    return value != NULL && value[0] != '\0';
}

static bool is_connected(const char *path) {
    char text[16] = "";
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return false;
    const bool is_read = fgets(text, sizeof text, file) != NULL;
    fclose(file);
    return is_read && strcmp(text, "connected\n") == 0;
}

bool hd_display_may_be_there(const char *folder) {
    char pattern[HD_MAX_PATH];
    glob_t paths;
    bool is_there = is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
    snprintf(pattern, sizeof pattern, "%s/card*-*/status", folder);
    if (!is_there && glob(pattern, 0, NULL, &paths) == 0) {
        for (size_t i = 0; i < paths.gl_pathc && !is_there; i++)
            is_there = is_connected(paths.gl_pathv[i]);
        globfree(&paths);
    }
    return is_there;
}

enum { MAX_SENTENCES = 8 };

static struct {
    pthread_mutex_t mutex;
    int count;
    char sentences[MAX_SENTENCES][HD_FALLBACK_LENGTH];
} notes = {.mutex = PTHREAD_MUTEX_INITIALIZER};

void hd_fallback_note(const char *format, ...) {
    char text[HD_FALLBACK_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pthread_mutex_lock(&notes.mutex);
    bool is_new = notes.count < MAX_SENTENCES;
    for (int i = 0; i < notes.count; i++)
        is_new &= strcmp(notes.sentences[i], text) != 0;
    if (is_new)
        memcpy(notes.sentences[notes.count++], text, sizeof text);
    pthread_mutex_unlock(&notes.mutex);
}

bool hd_fallback_take(char text[HD_FALLBACK_LENGTH]) {
    pthread_mutex_lock(&notes.mutex);
    bool found = notes.count > 0;
    if (found) {
        memcpy(text, notes.sentences[0], HD_FALLBACK_LENGTH);
        memmove(notes.sentences[0], notes.sentences[1],
                sizeof notes.sentences - sizeof notes.sentences[0]);
        notes.count--;
    }
    pthread_mutex_unlock(&notes.mutex);
    return found;
}
