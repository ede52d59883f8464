/* SPDX-License-Identifier: MIT */
/* Libraries loaded at run time. */
#ifndef HD_SYSTEM_DYNAMIC_LIBRARY_H
#define HD_SYSTEM_DYNAMIC_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>

/* offset of a function's pointer in a struct of function pointers */
typedef struct HdLibrarySymbol {
    const char *name;
    size_t offset;
} HdLibrarySymbol;

/* Opens a file, or a name that the loader searches for; returns NULL if there is no such
   library. */
void *hd_library_open(const char *path);

/* As hd_library_open, but finds a symbol where a program would that is linked with the library:
   first in libraries that a user preloads. */
void *hd_library_open_as_linked(const char *path);

/* Releases the handle; the library stays loaded. NULL is allowed. */
void hd_library_close(void *library);

/* Fills the struct at `functions`; returns the first missing symbol, or NULL. */
const char *hd_library_load(void *library, const HdLibrarySymbol *symbols, int count,
                            void *functions);

/* Finds the file of a library that has the given symbol. */
bool hd_library_path(void *library, const char *symbol, char *path, size_t capacity);

/* Opens a library in the folder of `library`, which has the given symbol; returns NULL if there is
   none. */
void *hd_library_open_adjacent(void *library, const char *symbol, const char *name);

#endif
