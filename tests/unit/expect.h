/* SPDX-License-Identifier: MIT */
/* cmocka, and the assertions that it lacks. */
#ifndef HD_EXPECT_H
#define HD_EXPECT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define expect_near(actual, expected, tolerance)                                                   \
    do {                                                                                           \
        const double expect_actual = (actual), expect_expected = (expected);                       \
        if (!(fabs(expect_actual - expect_expected) <= (tolerance)))                               \
            fail_msg("%s is %.17g, expected %.17g", #actual, expect_actual, expect_expected);      \
    } while (0)

#define expect_contains(text, part)                                                                \
    do {                                                                                           \
        if (strstr((text), (part)) == NULL)                                                        \
            fail_msg("'%s' does not contain '%s'", (text), (part));                                \
    } while (0)

#endif
