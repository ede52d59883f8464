/* SPDX-License-Identifier: MIT */
#include <fenv.h>
#include <stdatomic.h>

#include "expect.h"
#include "system/thread_pool.h"

enum { THREADS = 3, ITEMS = 1000 };

static HdError error;
static atomic_int done[ITEMS], not_nearest, not_of_the_pool;

static bool never(const void *context) {
    (void)context;
    return false;
}

static bool at_once(const void *context) {
    (void)context;
    return true;
}

static void work(void *context, int thread, int item) {
    (void)context;
    atomic_fetch_add(&done[item], 1);
    atomic_fetch_add(&not_nearest, fegetround() != FE_TONEAREST);
    atomic_fetch_add(&not_of_the_pool, thread < 0 || thread >= THREADS);
}

/* Threads inherit how their maker rounds. */
static void each_item_is_done_once_and_rounds_as_usual(void **state) {
    (void)state;
    HdThreadPool *pool;
    assert_int_equal(fesetround(FE_UPWARD), 0);
    const HdStatus status = hd_thread_pool_create(&pool, THREADS, &error);
    fesetround(FE_TONEAREST);
    assert_int_equal(status, HD_OK);
    assert_int_equal(hd_thread_pool_size(pool), THREADS);
    for (int round = 1; round <= 3; round++) {
        assert_true(hd_thread_pool_run(pool, ITEMS, work, NULL, never));
        for (int i = 0; i < ITEMS; i++)
            assert_int_equal(done[i], round);
    }
    assert_false(hd_thread_pool_run(pool, ITEMS, work, NULL, at_once));
    assert_int_equal(done[0], 3);
    assert_int_equal(not_nearest, 0);
    assert_int_equal(not_of_the_pool, 0);
    hd_thread_pool_destroy(pool);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_item_is_done_once_and_rounds_as_usual),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
