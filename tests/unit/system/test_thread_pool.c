/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE

#include <errno.h>
#include <fenv.h>
#include <stdatomic.h>

#include "system/machine.h"
#include "system/thread_pool.h"
#include "unit_test.h"
#include "wrapped.h"

enum { THREADS = 3, ITEMS = 1000 };

static HdError error;
static atomic_int done[ITEMS], not_nearest, not_of_the_pool;

/* Returns whether there is a context: at once, or never. */
static bool must_stop(const void *context) {
    return context != NULL;
}

static void work(void *context, int thread, int item) {
    (void)context;
    atomic_fetch_add(&done[item], 1);
    atomic_fetch_add(&not_nearest, fegetround() != FE_TONEAREST);
    atomic_fetch_add(&not_of_the_pool, thread < 0 || thread >= THREADS);
}

static void expect_round(HdThreadPool *pool) {
    const int before = done[0];
    assert_true(hd_thread_pool_run(pool, ITEMS, work, NULL, must_stop));
    for (int i = 0; i < ITEMS; i++)
        assert_int_equal(done[i], before + 1);
    assert_int_equal(not_nearest, 0);
    assert_int_equal(not_of_the_pool, 0);
}

/* Threads inherit their creator's rounding mode. */
TEST(each_item_is_done_once_and_rounds_as_usual) {
    HdThreadPool *pool;
    assert_int_equal(fesetround(FE_UPWARD), 0);
    const HdStatus status = hd_thread_pool_create(&pool, THREADS, &error);
    fesetround(FE_TONEAREST);
    assert_int_equal(status, HD_OK);
    assert_int_equal(hd_thread_pool_size(pool), THREADS);
    for (int round = 0; round < 3; round++)
        expect_round(pool);
    assert_false(hd_thread_pool_run(pool, ITEMS, work, &error, must_stop));
    assert_int_equal(done[0], 3);
    hd_thread_pool_destroy(pool);
}

/* ---- refusals by the system ---- */

static int threads_left = -1; /* threads until it refuses some; -1: it does not */

static int create_few(pthread_t *thread, const pthread_attr_t *attributes, void *(*begin)(void *),
                      void *argument) {
    if (threads_left == 0)
        return EAGAIN;
    if (threads_left > 0)
        threads_left--;
    return real_pthread_create(thread, attributes, begin, argument);
}
REPLACE(pthread_create, create_few)

static HdStatus create_with(HdThreadPool **pool, int threads) {
    threads_left = threads;
    const HdStatus status = hd_thread_pool_create(pool, THREADS, &error);
    threads_left = -1;
    return status;
}

TEST(the_started_threads_do_the_work) {
    HdThreadPool *pool;
    char note[HD_FALLBACK_LENGTH];
    assert_int_equal(create_with(&pool, 2), HD_OK);
    assert_int_equal(hd_thread_pool_size(pool), 2);
    assert_true(hd_fallback_take(note));
    expect_contains(note, "the system refused threads for tracing (");
    expect_contains(note, "): 2 of 3 do it");
    expect_round(pool);
    hd_thread_pool_destroy(pool);
    assert_int_equal(create_with(&pool, 0), HD_FAILED);
    expect_contains(error.message, "cannot start one of 3 threads: ");
    assert_false(hd_fallback_take(note));
    hd_thread_pool_destroy(NULL);
}
