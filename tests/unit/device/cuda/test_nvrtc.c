/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "device/cuda/nvrtc.h"

#include <fcntl.h>

#include "test_folder.h"

static HdError error;
static char library[600];

static HdStatus check(int arch, int driver_major) {
    return hd_nvrtc_check("some device", arch, driver_major, &error);
}

static int begin(void **state) {
    (void)state;
    setenv("HEDRON_CACHE", "cache", 1);
    setenv("HEDRON_NVRTC", "/no/such/library.so", 1);
    snprintf(library, sizeof library, "%s/library.so", test_folder);
    write_bytes(library, "not a library", 13);
    return 0;
}

static int end(void **state) {
    (void)state;
    remove_folder("cache");
    return 0;
}

/* The library is no library, so that it cannot have been loaded. */
static void what_is_remembered_is_not_loaded(void **state) {
    (void)state;
    assert_int_equal(check(61, 12), HD_UNAVAILABLE);
    hd_nvrtc_remember(library, 61, 12);
    assert_int_equal(check(61, 12), HD_OK);
    assert_int_equal(check(75, 12), HD_UNAVAILABLE);
    assert_int_equal(check(61, 13), HD_UNAVAILABLE);
    setenv("HEDRON_NVRTC", "/no/other/library.so", 1);
    assert_int_equal(check(61, 12), HD_UNAVAILABLE);
}

static void a_library_that_changed_is_looked_at(void **state) {
    (void)state;
    const struct timespec other[2] = {{.tv_sec = 1000}, {.tv_sec = 1000}};
    hd_nvrtc_remember(library, 61, 12);
    write_bytes(library, "longer than before", 18);
    assert_int_equal(check(61, 12), HD_UNAVAILABLE);
    hd_nvrtc_remember(library, 61, 12);
    assert_int_equal(check(61, 12), HD_OK);
    assert_int_equal(utimensat(AT_FDCWD, library, other, 0), 0);
    assert_int_equal(check(61, 12), HD_UNAVAILABLE);
    hd_nvrtc_remember(library, 61, 12);
    assert_int_equal(remove(library), 0);
    assert_int_equal(check(61, 12), HD_UNAVAILABLE);
    expect_contains(error.message, "/no/such/library.so");
}

static void without_a_cache_it_is_loaded_each_time(void **state) {
    (void)state;
    setenv("HEDRON_CACHE", "off", 1);
    hd_nvrtc_remember(library, 61, 12);
    assert_int_equal(check(61, 12), HD_UNAVAILABLE);
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, begin, end)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(what_is_remembered_is_not_loaded),
        TEST(a_library_that_changed_is_looked_at),
        TEST(without_a_cache_it_is_loaded_each_time),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
