/* SPDX-License-Identifier: MIT */
/* A temporary folder for the tests of the including file, and helpers for its files. Define
   _XOPEN_SOURCE as 700 first. */
#ifndef HD_TEST_FOLDER_H
#define HD_TEST_FOLDER_H

#include <stdio.h>
#include <stdlib.h>

#include <dirent.h>
#include <ftw.h>
#include <sys/stat.h>
#include <unistd.h>

#include "unit_test.h"

static char test_folder[] = "/tmp/hedron-test-XXXXXX";

static inline int remove_entry(const char *path, const struct stat *info, int kind,
                               struct FTW *place) {
    (void)info;
    (void)kind;
    (void)place;
    return remove(path);
}

/* Removes a folder and its contents; returns other than 0 if it cannot. */
static inline int remove_folder(const char *path) {
    return nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

/* The setup and teardown of the file, if it has no others: its tests run in the folder. */
static inline int make_test_folder(void **state) {
    (void)state;
    return mkdtemp(test_folder) == NULL || chdir(test_folder) != 0;
}

static inline int remove_test_folder(void **state) {
    (void)state;
    return chdir("/") != 0 || remove_folder(test_folder) != 0;
}
GROUP(make_test_folder, remove_test_folder)

static inline int count_entries(const char *path) {
    int count = 0;
    DIR *entries = opendir(path);
    assert_non_null(entries);
    while (readdir(entries) != NULL)
        count++;
    closedir(entries);
    return count - 2; /* "." and ".." */
}

static inline void write_bytes(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

#endif
