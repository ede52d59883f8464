/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* RTLD_NODELETE, dladdr */
#include "system/dynamic_library.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "system/path.h"

/* Libraries stay loaded: NVIDIA's driver has threads of its own, and its compiler leaks memory on
   each unload. */
void *hd_library_open(const char *path) {
    return dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}

void *hd_library_open_as_linked(const char *path) {
    return dlopen(path, RTLD_NOW | RTLD_GLOBAL | RTLD_NODELETE) != NULL ? dlopen(NULL, RTLD_NOW)
                                                                        : NULL;
}

void hd_library_close(void *library) {
    if (library)
        dlclose(library);
}

const char *hd_library_load(void *library, const HdLibrarySymbol *symbols, int count,
                            void *functions) {
    for (int i = 0; i < count; i++) {
        void *address = dlsym(library, symbols[i].name);
        if (!address)
            return symbols[i].name;
        /* POSIX represents both kinds of pointer alike, but C forbids the cast. */
        memcpy((char *)functions + symbols[i].offset, &address, sizeof address);
    }
    return NULL;
}

bool hd_library_path(void *library, const char *symbol, char *path, size_t capacity) {
    Dl_info info;
    void *address = dlsym(library, symbol);
    if (!address || !dladdr(address, &info) || !info.dli_fname)
        return false;
    return (size_t)snprintf(path, capacity, "%s", info.dli_fname) < capacity;
}

void *hd_library_open_adjacent(void *library, const char *symbol, const char *name) {
    char adjacent[HD_MAX_PATH], path[HD_MAX_PATH];
    if (!hd_library_path(library, symbol, adjacent, sizeof adjacent))
        return NULL;
    const size_t folder = hd_folder_length(adjacent);
    if (folder == 0)
        return NULL;
    const int length = snprintf(path, sizeof path, "%.*s%s", (int)folder, adjacent, name);
    return length < HD_MAX_PATH ? hd_library_open(path) : NULL;
}
