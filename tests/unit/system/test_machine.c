/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "system/machine.h"

#include "test_folder.h"

static int begin(void **state) {
    (void)state;
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    return mkdir("card0-HDMI-A-1", 0700) != 0 || mkdir("card0-DP-1", 0700) != 0;
}

static int end(void **state) {
    (void)state;
    return remove_folder("card0-HDMI-A-1") != 0 || remove_folder("card0-DP-1") != 0;
}

static void a_desktop_has_one(void **state) {
    (void)state;
    assert_false(hd_display_may_be_there("."));
    setenv("DISPLAY", "", 1);
    assert_false(hd_display_may_be_there("."));
    setenv("DISPLAY", ":0", 1);
    assert_true(hd_display_may_be_there("."));
    unsetenv("DISPLAY");
    setenv("WAYLAND_DISPLAY", "wayland-0", 1);
    assert_true(hd_display_may_be_there("."));
}

static void one_that_is_plugged_in_is_seen(void **state) {
    (void)state;
    write_bytes("card0-HDMI-A-1/status", "disconnected\n", 13);
    assert_false(hd_display_may_be_there("."));
    write_bytes("card0-DP-1/status", "connected\n", 10);
    assert_true(hd_display_may_be_there("."));
    assert_false(hd_display_may_be_there("/no/such/folder"));
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, begin, end)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_desktop_has_one),
        TEST(one_that_is_plugged_in_is_seen),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
