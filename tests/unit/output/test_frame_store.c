/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "output/frame_store.h"

#include <time.h>

#include "fake_programs.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"
#include "system/machine.h"

/* Frames of one colour, brighter and brighter, in one or two outputs. */
enum { WIDTH = 40, HEIGHT = 30, FRAMES = 30, FIRST = 100 };

static HdError error;
static HdOutputPlan outputs;
static int numbers[FRAMES];
static const HdFrameList frames = {.frames = numbers, .count = FRAMES};
static HdResume resume;
static HdFrameStorePlan plan;
static HdFrameStore *store;
static struct {
    int calls, finished;
    int fails_at; /* the call that fails; -1: none */
    bool is_as_expected;
    HdFrameTimes last;
} seen;

/* Notes the frame, and whether its first picture already exists. */
static HdStatus note_stored(void *context, const HdStoredFrame *stored, HdError *failure) {
    char name[HD_MAX_PATH];
    assert_null(context);
    hd_output_file(&outputs.list[0], stored->number, name, failure);
    seen.is_as_expected &= stored->number == FIRST + seen.calls && stored->done == seen.calls + 1 &&
                           (stored->was_finished || stored->worker == seen.calls % 3) &&
                           access(name, R_OK) == 0 && stored->frame->width == WIDTH;
    seen.finished += stored->was_finished;
    seen.last = stored->times;
    return seen.calls++ == seen.fails_at ? hd_fail(failure, HD_FAILED, "nobody listens") : HD_OK;
}

static HdStatus start(const char *first, const char *second, int fails_at, bool resumes) {
    const HdOutputStyle style = {{HD_CURVE_SRGB, 8, false}, 30, false};
    const char *const names[] = {first, second};
    hd_resume_free(&resume);
    hd_known_folders_forget(); /* removes another test's file */
    memset(&seen, 0, sizeof seen);
    seen.fails_at = fails_at;
    seen.is_as_expected = true;
    assert_int_equal(
        hd_outputs_settle(&outputs, names, second != NULL ? 2 : 1, &style, FRAMES, &error), HD_OK);
    outputs.durability = HD_WITHOUT_SYNC;
    hd_outputs_set_fingerprint(&outputs, 1, resumes);
    assert_int_equal(hd_resume_find(&resume, &outputs, &frames, &error), HD_OK);
    plan = (HdFrameStorePlan){.outputs = &outputs,
                              .resume = &resume,
                              .width = WIDTH,
                              .height = HEIGHT,
                              .workers = 1,
                              .start = hd_monotonic_seconds(),
                              .stored = note_stored};
    return hd_frame_store_start(&store, &plan, &error);
}

static int take(void) {
    const HdClaimer claimer = {.ahead = 2};
    return hd_stages_claim(hd_frame_store_stages(store), &claimer, true);
}

/* Submits the frame once it fits, or until nobody wants it any more. */
static void give(int place) {
    HdFrameTimes *times;
    if (!hd_stages_wait(hd_frame_store_stages(store), place))
        return;
    HdFrame *frame = hd_frame_store_frame(store, place, place % 3, &times);
    frame->is_encoded = false;
    for (int value = 0; value < WIDTH * HEIGHT * 3; value++)
        frame->rgb[value] = (float)place / FRAMES;
    times->trace = (HdSpan){hd_monotonic_seconds() - plan.start, 0.0};
    hd_stages_submit(hd_frame_store_stages(store), place);
}

/* Stores frames until there are no more or the store wants no more. */
static HdStatus store_frames(const char *first, const char *second, int fails_at, bool resumes) {
    int place;
    assert_int_equal(start(first, second, fails_at, resumes), HD_OK);
    while ((place = take()) >= 0)
        give(place);
    const HdStatus status = hd_frame_store_end(store, HD_OK, &error);
    assert_true(seen.is_as_expected);
    return status;
}

/* Expects as many files as note_stored saw, and nothing else, and removes the folder. */
static void expect_files(int count) {
    assert_int_equal(count_entries("run"), count);
    assert_int_equal(remove_folder("run"), 0);
}

/* A frame whose second picture cannot be written has no first one either. */
TEST(a_picture_that_cannot_be_written_ends_it) {
    mkdir("other", 0777);
    mkdir("other/107.data", 0777);
    assert_int_equal(store_frames("run/%d.data", "other/%d.data", -1, false), HD_BAD_INPUT);
    expect_contains(error.message, "other/107.data");
    assert_int_equal(seen.calls, 7);
    assert_true(seen.last.convert.began < 0.0 && seen.last.film.began < 0.0);
    expect_files(7);
    assert_int_equal(count_entries("other"), 8);
}

TEST(an_interruption_reports_the_kept_frames) {
    static const struct {
        const char *name;
        bool resumes;
        const char *message;
    } cases[] = {
        {"run/%d.png", true, "frames kept: 100-101; the same command goes on with 102-129"},
        {"run/%d.png", false,
         "frames kept: 100-101; the same command without --again goes on with 102-129"},
        {"run/%d.data", true, "frames kept: 100-101; --frames 102-129 renders the others"},
        {"run/a.mkv", true, "the same command renders all frames again"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char expected[160];
        fake_films(WIDTH * HEIGHT * 4, 0);
        assert_int_equal(start(cases[i].name, NULL, -1, cases[i].resumes), HD_OK);
        for (int k = 0; k < 2; k++)
            give(take());
        assert_int_equal(hd_frame_store_end(store, HD_INTERRUPTED, &error), HD_INTERRUPTED);
        snprintf(expected, sizeof expected, "interrupted after 2 of 30 frames; %s",
                 cases[i].message);
        assert_string_equal(error.message, expected);
        expect_files(i < 3 ? 2 : 0);
    }
}

TEST(a_failed_start_leaves_nothing) {
    assert_int_equal(start("/dev/null/a_%d.data", "three/a_%d.data", -1, false), HD_FAILED);
    assert_null(store);
    assert_int_not_equal(access("three", F_OK), 0);
}

static void check_film(void) {
    static uint8_t bytes[FRAMES * WIDTH * HEIGHT * 4 + 1];
    assert_int_equal(read_bytes("films/film.mkv", bytes, sizeof bytes), sizeof bytes - 1);
    for (int i = 0; i < FRAMES; i++) {
        const uint8_t *pixel = bytes + (size_t)i * WIDTH * HEIGHT * 4;
        assert_true(i == 0 ? pixel[0] == 0 : pixel[0] > pixel[-4]);
    }
    assert_int_equal(remove("films/film.mkv"), 0);
}

/* A continued run reads finished frames back. */
TEST(films_and_pictures_are_written_together) {
    struct stat kept;
    fake_films(WIDTH * HEIGHT * 4, 0);
    assert_int_equal(store_frames("run/%d.png", "films/film.mkv", -1, false), HD_OK);
    assert_int_equal(seen.calls, FRAMES);
    assert_true(seen.last.trace.began >= 0.0);
    assert_true(seen.last.store.began >= seen.last.trace.began);
    assert_true(seen.last.store.seconds > 0.0);
    assert_true(seen.last.convert.began >= seen.last.trace.began);
    assert_true(seen.last.film.began >= seen.last.convert.began + seen.last.convert.seconds - 1e-6);
    check_film();
    assert_true(remove("run/103.png") == 0 && remove("run/104.png") == 0);
    assert_int_equal(link("run/100.png", "kept"), 0);
    assert_int_equal(store_frames("run/%d.png", "films/film.mkv", -1, true), HD_OK);
    assert_int_equal(seen.finished, FRAMES - 2);
    assert_true(stat("kept", &kept) == 0 && kept.st_nlink == 2); /* it was not written again */
    check_film();
    expect_files(FRAMES);
    /* The film of a run whose listener fails leaves no file. */
    assert_int_equal(store_frames("run/%d.data", "films/film.mkv", 10, false), HD_FAILED);
    assert_string_equal(error.message, "nobody listens");
    assert_int_equal(seen.calls, 11);
    assert_int_equal(count_entries("films"), 0);
    assert_true(count_entries("run") >= 11); /* those that waited with it have their names too */
    remove_folder("run");
}

static int begin_group(void **state) {
    hd_interrupt_install();
    for (int i = 0; i < FRAMES; i++)
        numbers[i] = FIRST + i;
    return make_folder_for_programs(state);
}

GROUP(begin_group, remove_test_folder)
