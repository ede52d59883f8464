/* SPDX-License-Identifier: MIT */
#include "base/text.h"
#include "unit_test.h"

#include <stdlib.h>

TEST(numbers_read_back) {
    static const struct {
        double value;
        const char *exact, *brief;
    } numbers[] = {{0.1, "0.1", "0.1"},
                   {0.07, "0.07", "0.07"}, /* 16 digits would be one too many */
                   {1e12, "1000000000000", "1e12"},
                   {1e-12, "1e-12", "1e-12"},
                   {-1e6, "-1000000", "-1e6"},
                   {100.0, "100", "100"},
                   {1.0 / 3.0, "0.3333333333333333", "0.3333333333333333"},
                   {0.1 + 0.2, "0.30000000000000004", "0.30000000000000004"},
                   {-0.0, "-0.0", "-0"},
                   {1e100, "1e+100", "1e100"},
                   {1e300, "1e+300", "1e300"}};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[HD_NUMBER_SIZE];
        hd_exact_number(numbers[i].value, text);
        assert_string_equal(text, numbers[i].exact);
        assert_true(strtod(text, NULL) == numbers[i].value);
        hd_short_number(numbers[i].value, text);
        assert_string_equal(text, numbers[i].brief);
        assert_true(strtod(text, NULL) == numbers[i].value);
    }
}
