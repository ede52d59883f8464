/* SPDX-License-Identifier: MIT */
/* Loads the library of the test itself, which exists. */
#define _POSIX_C_SOURCE 200809L
#include "system/dynamic_library.h"

#include <dlfcn.h>
#include <unistd.h>

#include "system/path.h"
#include "unit_test.h"

static const char symbol[] = "_assert_true";

typedef struct Functions {
    void *unused;
    void (*fail)(const char *, int);
    void (*skip)(const char *, int);
} Functions;

static const HdLibrarySymbol symbols[] = {{"_fail", offsetof(Functions, fail)},
                                          {"_skip", offsetof(Functions, skip)},
                                          {"_no_such", offsetof(Functions, unused)},
                                          {"_nor_this", offsetof(Functions, unused)}};

static char path[HD_MAX_PATH];
static void *library;

static int find_library(void **state) {
    (void)state;
    void *program = dlopen(NULL, RTLD_NOW);
    assert_non_null(program);
    assert_true(hd_library_path(program, symbol, path, sizeof path));
    assert_int_equal(dlclose(program), 0);
    assert_int_equal(access(path, R_OK), 0);
    library = hd_library_open(path);
    return library == NULL;
}

static int leave_library(void **state) {
    (void)state;
    hd_library_close(library);
    hd_library_close(NULL);
    return 0;
}

TEST(functions_and_its_file_are_found) {
    Functions functions = {0};
    char found[HD_MAX_PATH];
    assert_null(hd_library_load(library, symbols, 2, &functions));
    assert_true(functions.fail == _fail && functions.skip == _skip);
    assert_string_equal(hd_library_load(library, symbols, 4, &functions), "_no_such");
    assert_null(functions.unused);
    const size_t length = strlen(path);
    assert_true(hd_library_path(library, symbol, found, length + 1));
    assert_string_equal(found, path);
    assert_false(hd_library_path(library, symbol, found, length));
    assert_false(hd_library_path(library, "_no_such", found, sizeof found));
}

static void expect_beside(const char *name) {
    void *again = hd_library_open_adjacent(library, symbol, name);
    assert_ptr_equal(again, library);
    hd_library_close(again);
}

TEST(a_library_in_its_own_folder_is_opened) {
    const char *name = strrchr(path, '/') + 1;
    expect_beside(name);
    assert_null(hd_library_open_adjacent(library, symbol, "no_such.so"));
    assert_null(hd_library_open_adjacent(library, "_no_such", name));
    assert_null(hd_library_open("no_such.so"));
    /* A name that is too long; cut, it would be that of the library. */
    char long_name[HD_MAX_PATH + 2] = "";
    const char *end = name - 1;
    const size_t cut = HD_MAX_PATH - 1 - (size_t)(end + 1 - path);
    memset(long_name, '/', cut);
    memcpy(long_name, "./", 2);
    memcpy(long_name + cut - strlen(end), end, strlen(end));
    expect_beside(long_name);
    memcpy(long_name + cut, "xx", 3);
    assert_null(hd_library_open_adjacent(library, symbol, long_name));
}

GROUP(find_library, leave_library)
