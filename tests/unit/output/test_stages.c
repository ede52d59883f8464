/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "output/stages.h"
#include "unit_test.h"

/* A stage that waits for another one for ever fails by this timeout. */
enum { ITEMS = 200, ROOM = 7 };

typedef struct Probe {
    int threads;
    int fails_at, fails_late_at; /* -1: never */
    int gathers;                 /* items that must be at work at once before one continues */
    const struct Probe *before;  /* the stage that must precede; NULL: none */
    atomic_int begun, ended, at_work;
    atomic_int wrong; /* items that came too early, out of order, or too many at once */
    atomic_bool done[ITEMS];
} Probe;

static HdError error;

static void nap(int milliseconds) {
    nanosleep(&(struct timespec){.tv_nsec = milliseconds * 1000000L}, NULL);
}

static HdStatus work(void *context, int item, HdError *failure) {
    Probe *probe = context;
    const bool fails = item == probe->fails_at || item == probe->fails_late_at;
    probe->wrong += probe->at_work++ >= probe->threads;
    probe->wrong += probe->begun++ != item && probe->threads == 1;
    probe->wrong += probe->before != NULL && !probe->before->done[item];
    while (probe->begun < probe->gathers)
        nap(1);
    if (item % 16 == probe->threads)
        nap(1);
    if (item == probe->fails_late_at)
        nap(100);
    probe->done[item] = !fails;
    probe->ended++;
    probe->at_work--;
    return fails ? hd_fail(failure, HD_FAILED, "item %d failed", item) : HD_OK;
}

/* A conversion, then a film beside pictures, then a stage that needs both. */
static Probe probes[4];
static const int threads[4] = {1, 1, 3, 1};
static const unsigned after[4] = {0, 1, 0, 7};
static HdStages *stages;
static int capacity;
static const bool none_ready[ITEMS];

/* Faults may be added to the probes afterwards, before items are submitted. */
static void start(const bool *ready, int capacity_of_stages) {
    HdStage list[4];
    for (int i = 0; i < 4; i++) {
        probes[i] = (Probe){.threads = threads[i], .fails_at = -1, .fails_late_at = -1};
        list[i] = (HdStage){
            .work = work, .context = &probes[i], .threads = threads[i], .after = after[i]};
    }
    probes[1].before = &probes[0];
    probes[3].before = &probes[2];
    capacity = capacity_of_stages;
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, ready, capacity, &error), HD_OK);
}

static const HdClaimer anybody = {.wants = NULL};

/* Submits items from that one on until all are submitted or one failed; returns their number. */
static int submit_items_from(int first) {
    int given = first, item;
    while ((item = hd_stages_claim(stages, &anybody, true)) >= 0) {
        assert_int_equal(item, given);
        assert_true(item - probes[3].ended < capacity);
        hd_stages_submit(stages, item);
        given++;
    }
    return given;
}

static int first_not_done(const Probe *probe) {
    int item = 0;
    while (item < ITEMS && probe->done[item])
        item++;
    return item;
}

/* Items before that one passed all stages, and none after it reached the last one. */
static void expect_end(HdStatus status, int done) {
    assert_int_equal(hd_stages_end(stages, &error), status);
    for (int i = 0; i < 4; i++) {
        assert_true(first_not_done(&probes[i]) >= done);
        assert_int_equal(probes[i].wrong, 0);
    }
    assert_int_equal(first_not_done(&probes[3]), done);
    assert_true(probes[3].begun <= done + (status != HD_OK));
}

/* Nobody makes any of them, or every third one and many at the end, or all. */
TEST(every_item_goes_through_every_stage) {
    static const int rooms[] = {ROOM, 1, ITEMS};
    static bool ready[ITEMS];
    for (int k = 0; k < 9; k++) {
        int item, before = -1;
        for (int i = 0; i < ITEMS; i++)
            ready[i] = k >= 6 || (k >= 3 && (i % 3 == 0 || i > ITEMS / 2));
        start(ready, rooms[k % 3]);
        while ((item = hd_stages_claim(stages, &anybody, true)) >= 0) {
            assert_true(item > before && !ready[item] && item - probes[3].ended < capacity);
            assert_true(hd_stages_wait(stages, item));
            hd_stages_submit(stages, item);
            before = item;
        }
        expect_end(HD_OK, ITEMS);
    }
}

TEST(a_failure_of_any_stage_leaves_the_items_before_it) {
    static const int failing[] = {0, 1, 20};
    for (int i = 0; i < 3 * 4; i++) {
        const int item = failing[i / 4];
        char expected[32];
        start(none_ready, ROOM);
        probes[i % 4].fails_at = item;
        assert_true(submit_items_from(0) <= item + ROOM);
        assert_false(hd_stages_wait(stages, item));
        assert_int_equal(hd_stages_claim(stages, &anybody, false), -1);
        expect_end(HD_FAILED, item);
        snprintf(expected, sizeof expected, "item %d failed", item);
        assert_string_equal(error.message, expected);
    }
    /* An item that fails while an earlier one is at work does not hide that one's failure. */
    start(none_ready, ROOM);
    probes[0].fails_at = 5;
    probes[2].fails_late_at = 3;
    submit_items_from(0);
    expect_end(HD_FAILED, 3);
    assert_string_equal(error.message, "item 3 failed");
}

/* ---- several workers ---- */

static void claim_in_order(int first, int count) {
    for (int i = first; i < first + count; i++)
        assert_int_equal(hd_stages_claim(stages, &anybody, false), i);
}

/* The third stage has several threads that work side by side and keep no order: it does not wait
   for the first item. */
TEST(items_may_be_submitted_in_any_order) {
    start(none_ready, ROOM);
    probes[2].gathers = 3;
    claim_in_order(0, 4);
    for (int i = 3; i > 0; i--)
        hd_stages_submit(stages, i);
    while (!(probes[2].done[1] && probes[2].done[2] && probes[2].done[3]))
        nap(1);
    assert_int_equal(probes[0].begun + probes[1].begun + probes[3].begun, 0);
    hd_stages_submit(stages, 0);
    assert_int_equal(submit_items_from(4), ITEMS);
    expect_end(HD_OK, ITEMS);
}

TEST(nobody_claims_an_item_without_capacity) {
    const HdClaimer singles = {.ahead = 2};
    start(none_ready, ROOM);
    claim_in_order(0, ROOM);
    assert_int_equal(hd_stages_claim(stages, &anybody, false), -1);
    assert_int_equal(hd_stages_claim(stages, &singles, false), ROOM);
    assert_int_equal(hd_stages_claim(stages, &singles, false), ROOM + 1);
    assert_int_equal(hd_stages_claim(stages, &singles, false), -1);
    hd_stages_submit(stages, 0);
    assert_true(hd_stages_wait(stages, ROOM)); /* after the first one is gone */
    assert_int_equal(hd_stages_claim(stages, &singles, false), ROOM + 2);
    expect_end(HD_OK, 1);
}

typedef struct Waiting {
    atomic_bool wants;
    atomic_int asked, left;
    int item;
    pthread_t thread;
} Waiting;

static bool wants_now(void *context, int left) {
    Waiting *waiting = context;
    waiting->left = left;
    waiting->asked++;
    return waiting->wants;
}

static void *wait_for_item(void *context) {
    Waiting *waiting = context;
    const HdClaimer claimer = {.wants = wants_now, .context = waiting};
    waiting->item = hd_stages_claim(stages, &claimer, true);
    return NULL;
}

/* Starts a thread that waits, and wants nothing yet. */
static void start_waiting(Waiting *waiting) {
    *waiting = (Waiting){.item = -2};
    assert_int_equal(pthread_create(&waiting->thread, NULL, wait_for_item, waiting), 0);
    while (waiting->asked == 0)
        nap(1);
}

static void expect_waiting_gets(Waiting *waiting, int item) {
    assert_int_equal(pthread_join(waiting->thread, NULL), 0);
    assert_int_equal(waiting->item, item);
}

TEST(waiting_threads_are_asked_again) {
    Waiting waiting;
    start(none_ready, ROOM);
    start_waiting(&waiting);
    waiting.wants = true;
    hd_stages_wake(stages);
    expect_waiting_gets(&waiting, 0);
    /* An item is released. */
    start_waiting(&waiting);
    assert_int_equal(waiting.left, ROOM); /* items that it may choose from */
    waiting.wants = true;
    hd_stages_release(stages, 0);
    expect_waiting_gets(&waiting, 0);
    /* No item will come any more. */
    start_waiting(&waiting);
    hd_stages_stop(stages);
    expect_waiting_gets(&waiting, -1);
    assert_false(hd_stages_wait(stages, 0));
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[0].begun, 0);
}

/* Items before the one that failed are still wanted, and nobody leaves before they are
   submitted. */
TEST(items_before_a_failure_are_wanted) {
    Waiting waiting;
    HdError failure;
    start(none_ready, ROOM);
    claim_in_order(0, 5);
    hd_fail(&failure, HD_BAD_INPUT, "item 3 cannot be");
    hd_stages_fail(stages, 3, &failure);
    hd_fail(&failure, HD_FAILED, "nor can item 4");
    hd_stages_fail(stages, 4, &failure);
    assert_false(hd_stages_wait(stages, 3));
    assert_true(hd_stages_wait(stages, 2));
    assert_int_equal(hd_stages_claim(stages, &anybody, false), -1);
    hd_stages_submit(stages, 0);
    hd_stages_submit(stages, 2);
    hd_stages_release(stages, 4);
    hd_stages_release(stages, 1);
    start_waiting(&waiting);
    claim_in_order(1, 1);
    hd_stages_submit(stages, 1);
    expect_waiting_gets(&waiting, -1);
    expect_end(HD_BAD_INPUT, 3);
    assert_string_equal(error.message, "item 3 cannot be");
    assert_int_equal(probes[3].ended, 3);
}

TEST(a_missing_item_ends_it) {
    start(none_ready, ROOM);
    claim_in_order(0, 5);
    for (int i = 0; i < 5; i++)
        if (i != 2)
            hd_stages_submit(stages, i);
    expect_end(HD_OK, 2);
}
