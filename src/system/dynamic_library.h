/* SPDX-License-Identifier: MIT */
/* Libraries that are looked for while the program runs. */
#ifndef HD_SYSTEM_DYNAMIC_LIBRARY_H
#define HD_SYSTEM_DYNAMIC_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>

/* Where a function's address goes within a struct of function pointers. */
typedef struct HdLibrarySymbol {
    const char *name;
    size_t offset;
} HdLibrarySymbol;

/* NULL where there is no such library. `path` is a file, or a name that the loader looks for. */
void *hd_library_open(const char *path);

/* Gives the handle back; the library stays loaded. NULL is allowed. */
void hd_library_close(void *library);

/* Fills the struct at `functions`. Returns the first symbol that is missing, or NULL. */
const char *hd_library_load(void *library, const HdLibrarySymbol *symbols, int count,
                            void *functions);

/* The file that a library was loaded from, which has the given symbol. */
bool hd_library_path(void *library, const char *symbol, char *path, size_t capacity);

/* Opens a library that lies in the same folder as `library`, which has the given symbol; NULL where
   there is none. */
void *hd_library_open_adjacent(void *library, const char *symbol, const char *name);

#endif
