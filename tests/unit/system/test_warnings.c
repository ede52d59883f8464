/* SPDX-License-Identifier: MIT */
#include "system/machine.h"

#include "unit_test.h"

TEST(sentences_come_once_and_in_their_order) {
    char text[HD_FALLBACK_LENGTH];
    assert_false(hd_fallback_take(text));
    hd_fallback_note("%d of %d", 1, 2);
    hd_fallback_note("other");
    hd_fallback_note("1 of 2");
    static const char *const expected[] = {"1 of 2", "other", "1 of 2"};
    for (int i = 0; i < 3; i++) {
        assert_true(hd_fallback_take(text));
        assert_string_equal(text, expected[i]);
        if (i == 0)
            hd_fallback_note("1 of 2");
    }
    assert_false(hd_fallback_take(text));
}

TEST(what_does_not_fit_is_dropped) {
    char text[HD_FALLBACK_LENGTH];
    for (int i = 0; i < 10; i++)
        hd_fallback_note("%-600d", i);
    for (int i = 0; i < 8; i++) {
        assert_true(hd_fallback_take(text));
        assert_int_equal(strlen(text), HD_FALLBACK_LENGTH - 1);
        assert_int_equal(text[0], '0' + i);
    }
    assert_false(hd_fallback_take(text));
}
