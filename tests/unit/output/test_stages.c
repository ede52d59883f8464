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

/* A stage that waits for another one for ever fails by this. */
enum { ITEMS = 200, ROOM = 7 };

typedef struct Probe {
    HdStages *stages;
    int threads;
    int fails_at, fails_late_at; /* -1: never */
    const struct Probe *before;  /* what must be done with an item first; NULL: nothing */
    atomic_int begun, ended;
    atomic_int at_work, most_at_work;
    atomic_int wrong; /* items that came too early or out of order */
    atomic_bool done[ITEMS];
} Probe;

static HdError error;

static void nap(int milliseconds) {
    struct timespec time = {.tv_nsec = milliseconds * 1000000L};
    nanosleep(&time, NULL);
}

static void note_most(Probe *probe) {
    int now = atomic_fetch_add(&probe->at_work, 1) + 1;
    int most = atomic_load(&probe->most_at_work);
    while (now > most && !atomic_compare_exchange_weak(&probe->most_at_work, &most, now))
        continue;
}

static HdStatus work(void *context, int item, HdError *failure) {
    Probe *probe = context;
    HdStatus status = HD_OK;
    note_most(probe);
    if (atomic_fetch_add(&probe->begun, 1) != item && probe->threads == 1)
        atomic_fetch_add(&probe->wrong, 1);
    if (probe->before != NULL && !atomic_load(&probe->before->done[item]))
        atomic_fetch_add(&probe->wrong, 1);
    if (item % 16 == probe->threads)
        nap(1);
    if (item == probe->fails_late_at)
        nap(100);
    if (item == probe->fails_at || item == probe->fails_late_at)
        status = hd_fail(failure, item == probe->fails_at ? HD_FAILED : HD_BAD_INPUT,
                         "item %d failed", item);
    else
        atomic_store(&probe->done[item], true);
    atomic_fetch_add(&probe->ended, 1);
    atomic_fetch_sub(&probe->at_work, 1);
    return status;
}

static HdStage stage_of(Probe *probe, unsigned after) {
    return (HdStage){.work = work, .context = probe, .threads = probe->threads, .after = after};
}

/* A conversion, then a film beside pictures, then what needs them both. */
static void list_stages(HdStage list[4], Probe probes[4]) {
    static const int threads[4] = {1, 1, 3, 1};
    for (int i = 0; i < 4; i++)
        probes[i] = (Probe){.threads = threads[i], .fails_at = -1, .fails_late_at = -1};
    probes[1].before = &probes[0];
    probes[3].before = &probes[2];
    list[0] = stage_of(&probes[0], 0);
    list[1] = stage_of(&probes[1], 1);
    list[2] = stage_of(&probes[2], 0);
    list[3] = stage_of(&probes[3], 7);
}

static const HdTaker anybody = {.wants = NULL};

static int give_items_from(HdStages *stages, int first) {
    int given = first, item;
    while ((item = hd_stages_take(stages, &anybody, true)) >= 0) {
        assert_int_equal(item, given);
        hd_stages_give(stages, item);
        given++;
    }
    return given;
}

/* Gives items until all are given or one failed; returns how many. */
static int give_items(HdStages *stages, const Probe *last, int room) {
    int given = 0, item;
    while ((item = hd_stages_take(stages, &anybody, true)) >= 0) {
        assert_int_equal(item, given);
        assert_true(item - atomic_load(&last->ended) < room);
        hd_stages_give(stages, item);
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

static void run_all(int room) {
    static Probe probes[4];
    HdStage list[4];
    HdStages *stages;
    list_stages(list, probes);
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, NULL, room, &error), HD_OK);
    assert_int_equal(give_items(stages, &probes[3], room), ITEMS);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(first_not_done(&probes[i]), ITEMS);
        assert_int_equal(probes[i].begun, ITEMS);
        assert_int_equal(probes[i].wrong, 0);
        assert_true(probes[i].most_at_work <= probes[i].threads);
    }
}

TEST(every_item_goes_through_every_stage) {
    run_all(ROOM);
    run_all(1);
    run_all(ITEMS);
}

/* Every third item, and many at the end, are there without anybody who makes them. */
TEST(what_is_ready_needs_nobody) {
    static Probe probes[4];
    static bool ready[ITEMS];
    HdStage list[4];
    HdStages *stages;
    (void)state;
    for (int i = 0; i < ITEMS; i++)
        ready[i] = i % 3 == 0 || i > ITEMS / 2;
    for (int room = 1; room <= ITEMS; room += ITEMS - 1) {
        int item, before = -1;
        list_stages(list, probes);
        assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, ready, room, &error), HD_OK);
        while ((item = hd_stages_take(stages, &anybody, true)) >= 0) {
            assert_true(item > before && !ready[item]);
            assert_true(hd_stages_wait(stages, item));
            hd_stages_give(stages, item);
            before = item;
        }
        assert_int_equal(hd_stages_end(stages, &error), HD_OK);
        for (int i = 0; i < 4; i++) {
            assert_int_equal(first_not_done(&probes[i]), ITEMS);
            assert_int_equal(probes[i].wrong, 0);
        }
    }
}

/* Nobody takes anything, for nothing is missing. */
TEST(all_may_be_ready) {
    static Probe probes[4];
    static bool ready[ITEMS];
    HdStage list[4];
    HdStages *stages;
    (void)state;
    memset(ready, true, sizeof ready);
    list_stages(list, probes);
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, ready, ROOM, &error), HD_OK);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(first_not_done(&probes[3]), ITEMS);
}

TEST(no_items_are_no_work) {
    static Probe probes[4];
    HdStage list[4];
    HdStages *stages;
    list_stages(list, probes);
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, NULL, ROOM, &error), HD_OK);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[0].begun, 0);
}

/* Whatever stage fails, the items before went through all of them, and none after did. */
TEST(a_failure_leaves_the_items_before_it) {
    static Probe probes[4];
    static const int failing[] = {0, 1, 20};
    for (size_t i = 0; i < 3 * 4; i++) {
        int stage = (int)(i % 4), item = failing[i / 4];
        char expected[32];
        HdStage list[4];
        HdStages *stages;
        list_stages(list, probes);
        probes[stage].fails_at = item;
        assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, NULL, ROOM, &error), HD_OK);
        assert_true(give_items(stages, &probes[3], ROOM) <= item + ROOM);
        assert_false(hd_stages_wait(stages, item));
        assert_int_equal(hd_stages_take(stages, &anybody, false), -1);
        assert_int_equal(hd_stages_end(stages, &error), HD_FAILED);
        snprintf(expected, sizeof expected, "item %d failed", item);
        assert_string_equal(error.message, expected);
        for (int other = 0; other < 4; other++)
            assert_true(first_not_done(&probes[other]) >= item);
        assert_int_equal(first_not_done(&probes[3]), item);
        assert_true(probes[3].ended <= item + 1);
    }
}

/* An item that fails while an earlier one is still at work does not hide that one's failure. */
TEST(the_first_item_that_failed_counts) {
    static Probe probes[4];
    HdStage list[4];
    HdStages *stages;
    list_stages(list, probes);
    probes[0].fails_at = 5;
    probes[2].fails_late_at = 3;
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, NULL, ROOM, &error), HD_OK);
    give_items(stages, &probes[3], ROOM);
    assert_int_equal(hd_stages_end(stages, &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "item 3 failed");
    assert_int_equal(first_not_done(&probes[3]), 3);
}

static atomic_int gathered;

/* Ends only where three items are at work at once. */
static HdStatus gather(void *context, int item, HdError *failure) {
    (void)context;
    (void)item;
    (void)failure;
    atomic_fetch_add(&gathered, 1);
    while (atomic_load(&gathered) < 3)
        nap(1);
    return HD_OK;
}

TEST(threads_of_a_stage_work_side_by_side) {
    const HdStage stage = {.work = gather, .threads = 3};
    HdStages *stages;
    assert_int_equal(hd_stages_start(&stages, &stage, 1, 3, NULL, 3, &error), HD_OK);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(hd_stages_take(stages, &anybody, true), i);
        hd_stages_give(stages, i);
    }
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
}

/* The stage goes on with an item only when another one was given: the giver does not wait for it.
 */
static HdStatus lag_behind(void *context, int item, HdError *failure) {
    const atomic_int *given = context;
    (void)failure;
    while (atomic_load(given) < item + 2)
        nap(1);
    return HD_OK;
}

TEST(giving_overlaps_with_the_work) {
    atomic_int given = 0;
    const HdStage stage = {.work = lag_behind, .context = &given, .threads = 1};
    HdStages *stages;
    assert_int_equal(hd_stages_start(&stages, &stage, 1, 20, NULL, 2, &error), HD_OK);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(hd_stages_take(stages, &anybody, true), i);
        hd_stages_give(stages, i);
        atomic_fetch_add(&given, 1);
    }
    atomic_fetch_add(&given, 1);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
}

/* ---- several takers ---- */

static HdStages *start_probes(Probe probes[4], int room) {
    HdStage list[4];
    HdStages *stages;
    list_stages(list, probes);
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, NULL, room, &error), HD_OK);
    return stages;
}

static void take_in_order(HdStages *stages, int first, int count) {
    for (int i = first; i < first + count; i++)
        assert_int_equal(hd_stages_take(stages, &anybody, false), i);
}

/* The third stage has several threads and keeps no order: it does not wait for the first item. */
TEST(items_are_given_in_any_order) {
    static Probe probes[4];
    HdStages *stages = start_probes(probes, ROOM);
    take_in_order(stages, 0, 4);
    for (int i = 3; i > 0; i--)
        hd_stages_give(stages, i);
    while (!(probes[2].done[1] && probes[2].done[2] && probes[2].done[3]))
        nap(1);
    assert_int_equal(probes[0].begun + probes[1].begun + probes[3].begun, 0);
    hd_stages_give(stages, 0);
    assert_int_equal(give_items_from(stages, 4), ITEMS);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(first_not_done(&probes[i]), ITEMS);
        assert_int_equal(probes[i].wrong, 0);
    }
}

TEST(what_is_given_back_comes_first) {
    static Probe probes[4];
    HdStages *stages = start_probes(probes, ROOM);
    take_in_order(stages, 0, 5);
    hd_stages_give_back(stages, 3);
    hd_stages_give_back(stages, 1);
    take_in_order(stages, 1, 1);
    take_in_order(stages, 3, 1);
    take_in_order(stages, 5, 1);
    for (int i = 0; i < 6; i++)
        hd_stages_give(stages, i);
    assert_int_equal(give_items_from(stages, 6), ITEMS);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[3].ended, ITEMS);
}

TEST(nobody_takes_what_has_no_room) {
    static Probe probes[4];
    const HdTaker alone = {.ahead = 2};
    HdStages *stages = start_probes(probes, ROOM);
    take_in_order(stages, 0, ROOM);
    assert_int_equal(hd_stages_take(stages, &anybody, false), -1);
    assert_int_equal(hd_stages_take(stages, &alone, false), ROOM);
    assert_int_equal(hd_stages_take(stages, &alone, false), ROOM + 1);
    assert_int_equal(hd_stages_take(stages, &alone, false), -1);
    hd_stages_give(stages, 0);
    assert_true(hd_stages_wait(stages, ROOM)); /* once the first one is gone */
    assert_int_equal(hd_stages_take(stages, &alone, false), ROOM + 2);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[3].ended, 1);
}

static bool likes_what_is_left(void *context, int left) {
    int *liked = context;
    return left == *liked;
}

TEST(takers_choose_by_what_is_left) {
    static Probe probes[4];
    int liked = ROOM;
    const HdTaker chooser = {.wants = likes_what_is_left, .context = &liked};
    HdStages *stages = start_probes(probes, ROOM);
    assert_int_equal(hd_stages_take(stages, &chooser, false), 0);
    liked = 1;
    assert_int_equal(hd_stages_take(stages, &chooser, false), -1);
    hd_stages_give(stages, 0);
    for (int i = 1; i < ITEMS - 2; i++) {
        assert_int_equal(hd_stages_take(stages, &anybody, true), i);
        hd_stages_give(stages, i);
    }
    assert_int_equal(hd_stages_take(stages, &anybody, true), ITEMS - 2);
    assert_int_equal(hd_stages_take(stages, &chooser, true), ITEMS - 1);
    hd_stages_give_back(stages, ITEMS - 2);
    hd_stages_give_back(stages, ITEMS - 1);
    liked = 2;
    assert_int_equal(hd_stages_take(stages, &chooser, false), ITEMS - 2);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[3].ended, ITEMS - 2);
}

typedef struct Waiting {
    HdStages *stages;
    atomic_int wants, asked;
    int item;
    pthread_t thread;
} Waiting;

static bool wants_now(void *context, int left) {
    Waiting *waiting = context;
    (void)left;
    atomic_fetch_add(&waiting->asked, 1);
    return atomic_load(&waiting->wants);
}

static void *wait_for_item(void *context) {
    Waiting *waiting = context;
    const HdTaker taker = {.wants = wants_now, .context = waiting};
    waiting->item = hd_stages_take(waiting->stages, &taker, true);
    return NULL;
}

/* Starts somebody who waits, and wants nothing yet. */
static void start_waiting(Waiting *waiting, HdStages *stages) {
    *waiting = (Waiting){.stages = stages, .item = -2};
    assert_int_equal(pthread_create(&waiting->thread, NULL, wait_for_item, waiting), 0);
    while (atomic_load(&waiting->asked) == 0)
        nap(1);
}

static void expect_waiting_gets(Waiting *waiting, int item) {
    assert_int_equal(pthread_join(waiting->thread, NULL), 0);
    assert_int_equal(waiting->item, item);
}

TEST(takers_that_wait_are_asked_again) {
    static Probe probes[4];
    Waiting waiting;
    HdStages *stages = start_probes(probes, ROOM);
    start_waiting(&waiting, stages);
    atomic_store(&waiting.wants, 1);
    hd_stages_ask_again(stages);
    expect_waiting_gets(&waiting, 0);
    /* Something is given back. */
    start_waiting(&waiting, stages);
    atomic_store(&waiting.wants, 1);
    hd_stages_give_back(stages, 0);
    expect_waiting_gets(&waiting, 0);
    /* Nothing will come any more. */
    start_waiting(&waiting, stages);
    hd_stages_stop(stages);
    expect_waiting_gets(&waiting, -1);
    assert_false(hd_stages_wait(stages, 0));
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[0].begun, 0);
}

/* Items before the one that failed are still wanted, and nobody leaves before they are given. */
TEST(what_comes_before_a_failure_is_wanted) {
    static Probe probes[4];
    Waiting waiting;
    HdError failure;
    HdStages *stages = start_probes(probes, ROOM);
    take_in_order(stages, 0, 5);
    hd_fail(&failure, HD_BAD_INPUT, "item 3 cannot be");
    hd_stages_fail(stages, 3, &failure);
    hd_fail(&failure, HD_FAILED, "nor can item 4");
    hd_stages_fail(stages, 4, &failure);
    assert_false(hd_stages_wait(stages, 3));
    assert_true(hd_stages_wait(stages, 2));
    assert_int_equal(hd_stages_take(stages, &anybody, false), -1);
    hd_stages_give(stages, 0);
    hd_stages_give(stages, 2);
    hd_stages_give_back(stages, 4);
    hd_stages_give_back(stages, 1);
    start_waiting(&waiting, stages);
    take_in_order(stages, 1, 1);
    hd_stages_give(stages, 1);
    expect_waiting_gets(&waiting, -1);
    assert_int_equal(hd_stages_end(stages, &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "item 3 cannot be");
    assert_int_equal(probes[3].ended, 3);
    assert_int_equal(first_not_done(&probes[3]), 3);
}

TEST(a_gap_ends_it) {
    static Probe probes[4];
    HdStages *stages = start_probes(probes, ROOM);
    take_in_order(stages, 0, 5);
    for (int i = 0; i < 5; i++)
        if (i != 2)
            hd_stages_give(stages, i);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[3].ended, 2);
    assert_int_equal(probes[0].ended, 2);
}
