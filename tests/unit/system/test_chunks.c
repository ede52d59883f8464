/* SPDX-License-Identifier: MIT */
/* Selections in chunks equal those of one call for all items. */
#include <stdlib.h>

#include "system/thread_pool.h"
#include "unit_test.h"

enum { THREADS = 4 };

static HdThreadPool *pool;

static int start_threads(void **state) {
    HdError error;
    (void)state;
    return hd_thread_pool_create(&pool, THREADS, &error) == HD_OK ? 0 : -1;
}

static int end_threads(void **state) {
    (void)state;
    hd_thread_pool_destroy(pool);
    return 0;
}

/* Around the sizes of chunks. */
static const int counts[] = {0, 1, 1023, 1024, 1025, 5000, 256 * 1024, 256 * 1024 + 1, 700001};
enum { COUNTS = sizeof counts / sizeof *counts };

/* Selects few items in some chunks, none or all in others. */
static bool is_chosen(int item) {
    return item / 3000 % 3 == 1 || item % 97 == 5;
}

static int choose(void *context, int first, int end, int *chosen) {
    const int *numbers = context;
    int count = 0;
    assert_true(first < end);
    for (int i = first; i < end; i++) {
        int number = numbers != NULL ? numbers[i] : i;
        if (is_chosen(number))
            chosen[count++] = number;
    }
    return count;
}

static void expect_choice(int count, const int *chosen, int chosen_count) {
    int expected = 0;
    for (int i = 0; i < count; i++)
        if (is_chosen(i)) {
            assert_true(expected < chosen_count);
            assert_int_equal(chosen[expected++], i);
        }
    assert_int_equal(chosen_count, expected);
}

/* In place, too. */
TEST(choices_keep_the_order) {
    for (int c = 0; c < COUNTS; c++) {
        int *chosen = calloc((size_t)counts[c] + 1, sizeof *chosen);
        assert_non_null(chosen);
        expect_choice(counts[c], chosen, hd_chunks_choose(pool, counts[c], choose, NULL, chosen));
        for (int i = 0; i < counts[c]; i++)
            chosen[i] = i;
        expect_choice(counts[c], chosen, hd_chunks_choose(pool, counts[c], choose, chosen, chosen));
        free(chosen);
    }
}

GROUP(start_threads, end_threads)
