/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "expect.h"
#include "stages.h"

/* A stage that waits for another one for ever fails by this. */
enum { ITEMS = 200, ROOM = 7, PATIENCE_SECONDS = 60 };

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
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, room, &error), HD_OK);
    assert_int_equal(give_items(stages, &probes[3], room), ITEMS);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(first_not_done(&probes[i]), ITEMS);
        assert_int_equal(probes[i].begun, ITEMS);
        assert_int_equal(probes[i].wrong, 0);
        assert_true(probes[i].most_at_work <= probes[i].threads);
    }
}

static void every_item_goes_through_every_stage(void **state) {
    (void)state;
    run_all(ROOM);
    run_all(1);
    run_all(ITEMS);
}

static void no_items_are_no_work(void **state) {
    (void)state;
    static Probe probes[4];
    HdStage list[4];
    HdStages *stages;
    list_stages(list, probes);
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, ROOM, &error), HD_OK);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
    assert_int_equal(probes[0].begun, 0);
}

/* Whatever stage fails, the items before went through all of them, and none after did. */
static void a_failure_leaves_the_items_before_it(void **state) {
    (void)state;
    static Probe probes[4];
    static const int failing[] = {0, 1, 20};
    for (size_t i = 0; i < 3 * 4; i++) {
        int stage = (int)(i % 4), item = failing[i / 4];
        char expected[32];
        HdStage list[4];
        HdStages *stages;
        list_stages(list, probes);
        probes[stage].fails_at = item;
        assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, ROOM, &error), HD_OK);
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
static void the_first_item_that_failed_counts(void **state) {
    (void)state;
    static Probe probes[4];
    HdStage list[4];
    HdStages *stages;
    list_stages(list, probes);
    probes[0].fails_at = 5;
    probes[2].fails_late_at = 3;
    assert_int_equal(hd_stages_start(&stages, list, 4, ITEMS, ROOM, &error), HD_OK);
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

static void threads_of_a_stage_work_side_by_side(void **state) {
    (void)state;
    const HdStage stage = {.work = gather, .threads = 3};
    HdStages *stages;
    assert_int_equal(hd_stages_start(&stages, &stage, 1, 3, 3, &error), HD_OK);
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

static void giving_overlaps_with_the_work(void **state) {
    (void)state;
    atomic_int given = 0;
    const HdStage stage = {.work = lag_behind, .context = &given, .threads = 1};
    HdStages *stages;
    assert_int_equal(hd_stages_start(&stages, &stage, 1, 20, 2, &error), HD_OK);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(hd_stages_take(stages, &anybody, true), i);
        hd_stages_give(stages, i);
        atomic_fetch_add(&given, 1);
    }
    atomic_fetch_add(&given, 1);
    assert_int_equal(hd_stages_end(stages, &error), HD_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_goes_through_every_stage),
        cmocka_unit_test(no_items_are_no_work),
        cmocka_unit_test(a_failure_leaves_the_items_before_it),
        cmocka_unit_test(the_first_item_that_failed_counts),
        cmocka_unit_test(threads_of_a_stage_work_side_by_side),
        cmocka_unit_test(giving_overlaps_with_the_work),
    };
    alarm(PATIENCE_SECONDS);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
