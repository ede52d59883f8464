/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "fuzz.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_FILES = 4, PATH_SIZE = 256 };

static char folder[PATH_SIZE / 2];
static char paths[MAX_FILES][PATH_SIZE];

static int remove_entry(const char *path, const struct stat *found, int kind, struct FTW *walk) {
    (void)found;
    (void)kind;
    (void)walk;
    return remove(path);
}

static void remove_folder(void) {
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

void fuzz_expect(int holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "fuzz target: %s\n", what);
    abort();
}

/* Makes the folder in memory if possible: campaigns write millions of files. */
static void make_folder(void) {
    const char *memory = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    snprintf(folder, sizeof folder, "%s/hedron-fuzz-XXXXXX", memory);
    fuzz_expect(mkdtemp(folder) != NULL, "no folder for files");
    atexit(remove_folder);
}

/* Returns the place of the path with that name, or a free one. */
static char *path_of(const char *name) {
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    for (int i = 0; i < MAX_FILES; i++) {
        if (paths[i][0] == '\0')
            memcpy(paths[i], path, sizeof path);
        if (strcmp(paths[i], path) == 0)
            return paths[i];
    }
    fuzz_expect(0, "more files than there is room for");
    return NULL;
}

const char *fuzz_file(const char *name, const void *data, size_t size) {
    if (folder[0] == '\0')
        make_folder();
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    fuzz_expect(file != NULL, "no file");
    fuzz_expect(fwrite(data, 1, size, file) == size, "a file that is not written");
    fuzz_expect(fclose(file) == 0, "a file that is not closed");
    return path;
}

char *fuzz_text(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    fuzz_expect(text != NULL, "no memory");
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

void fuzz_expect_input_status(HdStatus status, const HdError *error) {
    fuzz_expect(status == HD_OK || status == HD_BAD_INPUT, error->message);
}
