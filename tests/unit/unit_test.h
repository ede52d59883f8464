/* SPDX-License-Identifier: MIT */
/* Header of each file of unit tests: cmocka, further assertions, and the registration of tests,
   which main.c runs file by file. */
#ifndef HD_UNIT_TEST_H
#define HD_UNIT_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

typedef int (*UnitFixture)(void **state);

/* Internal; use the macros below. `file`: __BASE_FILE__. */
void unit_add_test(const char *file, const char *name, CMUnitTestFunction test, UnitFixture setup,
                   UnitFixture teardown);
void unit_set_group(const char *file, UnitFixture setup, UnitFixture teardown);
void unit_set_each(const char *file, UnitFixture setup, UnitFixture teardown);
void unit_add_start(const char *file, void (*start)(void));
void unit_add_program(const char *name, int (*program)(void));

/* The root folder of the source tree, and this program. */
extern const char *unit_project;
extern const char *unit_program;

#define UNIT_REGISTER(name, call)                                                                  \
    __attribute__((constructor)) static void register_##name(void) {                               \
        call;                                                                                      \
    }

/* TEST(name) { ... }: one test. TEST_WITH: with its own setup and teardown, either of which may be
 * NULL. */
#define TEST_WITH(name, setup, teardown)                                                           \
    static void name(void **state);                                                                \
    UNIT_REGISTER(name, unit_add_test(__BASE_FILE__, #name, name, setup, teardown))                \
    static void name(void **state __attribute__((unused)))
#define TEST(name) TEST_WITH(name, NULL, NULL)

/* Runs before all else of the file, in its process. */
#define AT_START(start) UNIT_REGISTER(start, unit_add_start(__BASE_FILE__, start))
/* While tests of the file run, calls of `function`, which wrapped.h has, go to `replacement`. */
#define REPLACE(function, replacement)                                                             \
    static void replace_##function(void) {                                                         \
        replaced_##function = (replacement);                                                       \
    }                                                                                              \
    AT_START(replace_##function)

/* Run once before and after all tests of the file, which do not see its state; the last GROUP
   counts. */
#define GROUP(setup, teardown)                                                                     \
    UNIT_REGISTER(setup##_##teardown, unit_set_group(__BASE_FILE__, setup, teardown))
/* Run before and after each TEST of the file. */
#define EACH(setup, teardown) UNIT_REGISTER(each, unit_set_each(__BASE_FILE__, setup, teardown))
/* Started under this name, or with it as the first argument, the test program is this program
   instead. */
#define INSTEAD_OF(name, program) UNIT_REGISTER(program, unit_add_program(name, program))

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
