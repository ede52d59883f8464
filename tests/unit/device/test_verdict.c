/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "device/verdict.h"

#include "test_folder.h"

static char difference[32];

static bool get(const char *device, const char *driver) {
    return hd_verdict_get(device, driver, difference, sizeof difference);
}

TEST(the_last_verdict_of_a_device_and_a_driver_counts) {
    setenv("HEDRON_CACHE", "cache", 1);
    assert_false(get("card", "1.2"));
    hd_verdict_put("card", "1.2", "what it computes is wrong");
    hd_verdict_put("card", "1.2", "");
    hd_verdict_put("other card", "1.2", "");
    hd_verdict_put("other card", "1.2", "1 + 1 is 3");
    assert_true(get("card", "1.2"));
    assert_string_equal(difference, "");
    assert_true(get("other card", "1.2"));
    assert_string_equal(difference, "1 + 1 is 3");
    assert_false(get("card", "1.3"));
    assert_string_equal(difference, "");
    assert_false(get("1.2", "card"));
}
