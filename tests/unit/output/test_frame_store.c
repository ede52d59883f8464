/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include <stdbool.h>
#include <time.h>

#include "output/frame_store.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "test_folder.h"

enum { WIDTH = 40, HEIGHT = 30, FRAMES = 30, FIRST = 100 };

static HdError error;

typedef struct Listener {
    int calls;
    int fails_at; /* the call that fails; -1: none */
    bool in_order;
    bool was_there; /* each frame's pictures, when it was told of */
    int stored;     /* frames, by what it was told last */
    HdFrameTimes last;
} Listener;

static HdStatus note_stored(void *context, const HdStoredFrame *stored, HdError *failure) {
    Listener *listener = context;
    char name[64];
    snprintf(name, sizeof name, "run/%d.data", stored->number);
    if (stored->number != FIRST + listener->calls || stored->tracer != listener->calls % 3 ||
        stored->done != listener->calls + 1)
        listener->in_order = false;
    if (access(name, R_OK) != 0 || stored->frame->width != WIDTH)
        listener->was_there = false;
    listener->last = stored->times;
    listener->stored = stored->done;
    if (listener->calls++ == listener->fails_at)
        return hd_fail(failure, HD_FAILED, "the listener failed");
    return HD_OK;
}

/* What a run is about: frames FIRST to FIRST + FRAMES - 1 in one or two outputs. */
typedef struct Setup {
    HdOutputPlan outputs;
    int numbers[FRAMES];
    HdFrameList frames;
    HdResume resume;
    HdFrameStorePlan plan;
} Setup;

static HdStatus start(HdFrameStore **store, Setup *setup, const char *first, const char *second,
                      Listener *listener) {
    const HdOutputStyle style = {.picture = {.curve = HD_CURVE_SRGB, .bits = 8},
                                 .frames_per_second = 30};
    const char *const names[] = {first, second};
    for (int i = 0; i < FRAMES; i++)
        setup->numbers[i] = FIRST + i;
    setup->frames = (HdFrameList){.frames = setup->numbers, .count = FRAMES};
    hd_known_folders_forget(); /* that of another test is gone */
    *listener = (Listener){.fails_at = listener->fails_at, .in_order = true, .was_there = true};
    assert_int_equal(
        hd_outputs_settle(&setup->outputs, names, second != NULL ? 2 : 1, &style, FRAMES, &error),
        HD_OK);
    assert_int_equal(hd_resume_find(&setup->resume, &setup->outputs, &setup->frames, &error),
                     HD_OK);
    setup->plan = (HdFrameStorePlan){.outputs = &setup->outputs,
                                     .resume = &setup->resume,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .tracers = 1,
                                     .start = hd_monotonic_seconds(),
                                     .durability = HD_DURABLE,
                                     .stored = note_stored,
                                     .context = listener};
    return hd_frame_store_start(store, &setup->plan, &error);
}

static int take(HdFrameStore *store) {
    const HdTaker taker = {.ahead = 2};
    return hd_stages_take(hd_frame_store_stages(store), &taker, true);
}

/* The frame has room. */
static void give(HdFrameStore *store, const Setup *setup, int place) {
    HdFrameTimes *times;
    HdFrame *frame = hd_frame_store_frame(store, place, place % 3, &times);
    for (int value = 0; value < WIDTH * HEIGHT * 3; value++)
        frame->rgb[value] = (float)place / FRAMES;
    times->trace = (HdSpan){hd_monotonic_seconds() - setup->plan.start, 0.0};
    hd_stages_give(hd_frame_store_stages(store), place);
}

/* Stores frames until there are no more or the store wants no more. */
static HdStatus store_frames(Listener *listener, const char *second_output) {
    Setup setup;
    HdFrameStore *store;
    int place;
    assert_int_equal(start(&store, &setup, "run/%d.data", second_output, listener), HD_OK);
    while ((place = take(store)) >= 0)
        if (hd_stages_wait(hd_frame_store_stages(store), place))
            give(store, &setup, place);
    HdStatus status = hd_frame_store_end(store, HD_OK, &error);
    hd_resume_free(&setup.resume);
    assert_true(listener->in_order);
    assert_true(listener->was_there);
    return status;
}

/* The byte that pictures have everywhere tells which frame they show. */
static int byte_of(int number) {
    char name[64];
    snprintf(name, sizeof name, "run/%d.data", number);
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 8, SEEK_SET), 0);
    int byte = fgetc(file);
    fclose(file);
    return byte;
}

TEST(frames_are_stored_in_order) {
    Listener listener = {.fails_at = -1};
    assert_int_equal(store_frames(&listener, "run/%d.png"), HD_OK);
    assert_int_equal(listener.stored, FRAMES);
    assert_int_equal(listener.calls, FRAMES);
    assert_int_equal(count_entries("run"), 2 * FRAMES);
    assert_int_equal(byte_of(FIRST), 0);
    for (int i = 1; i < FRAMES; i++)
        assert_true(byte_of(FIRST + i) > byte_of(FIRST + i - 1));
    assert_true(listener.last.trace.began >= 0.0);
    assert_true(listener.last.store.began >= listener.last.trace.began);
    assert_true(listener.last.store.seconds > 0.0);
    assert_true(listener.last.convert.began < 0.0 && listener.last.film.began < 0.0);
    assert_int_equal(remove_folder("run"), 0);
}

static void check_first_frames(int count) {
    char name[64];
    for (int i = 0; i < FRAMES; i++) {
        snprintf(name, sizeof name, "run/%d.data", FIRST + i);
        assert_int_equal(access(name, F_OK) == 0, i < count);
    }
    assert_int_equal(count_entries("run"), count);
    assert_int_equal(remove_folder("run"), 0);
}

/* Those that waited with the last one have their names too. */
static void check_frames_of_a_listener_that_failed(int count) {
    const int named = count_entries("run");
    assert_true(named >= count);
    check_first_frames(named);
}

TEST(a_listener_that_fails_ends_it) {
    Listener listener = {.fails_at = 4};
    assert_int_equal(store_frames(&listener, NULL), HD_FAILED);
    assert_string_equal(error.message, "the listener failed");
    assert_int_equal(listener.stored, 5);
    assert_int_equal(listener.calls, 5);
    check_frames_of_a_listener_that_failed(5);
}

TEST(a_picture_that_cannot_be_written_ends_it) {
    Listener listener = {.fails_at = -1};
    mkdir("other", 0777);
    mkdir("other/107.data", 0777);
    assert_int_equal(store_frames(&listener, "other/%d.data"), HD_BAD_INPUT);
    expect_contains(error.message, "other/107.data");
    assert_int_equal(listener.stored, 7);
    assert_int_equal(listener.calls, 7);
    check_first_frames(7);
    assert_int_equal(count_entries("other"), 8);
    assert_int_equal(remove_folder("other"), 0);
}

TEST(an_interruption_tells_how_far_it_came) {
    Listener listener = {.fails_at = -1};
    Setup setup;
    HdFrameStore *store;
    assert_int_equal(start(&store, &setup, "run/%d.data", NULL, &listener), HD_OK);
    for (int i = 0; i < 2; i++) {
        int place = take(store);
        assert_true(hd_stages_wait(hd_frame_store_stages(store), place));
        give(store, &setup, place);
    }
    assert_int_equal(hd_frame_store_end(store, HD_INTERRUPTED, &error), HD_INTERRUPTED);
    assert_string_equal(error.message, "interrupted after 2 of 30 frames");
    hd_resume_free(&setup.resume);
    check_first_frames(2);
}

static void wait_for_entries(const char *folder, int count) {
    while (access(folder, F_OK) != 0 || count_entries(folder) < count)
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

/* A frame is given, but not the one before it. */
TEST(what_is_not_published_goes) {
    Listener listener = {.fails_at = -1};
    Setup setup;
    HdFrameStore *store;
    if (hd_processor_count() < 2) /* which writes frames in order */
        skip();
    assert_int_equal(start(&store, &setup, "four/a_%d.data", "four/a_%d.png", &listener), HD_OK);
    assert_int_equal(count_entries("four"), 0);
    for (int i = 0; i < 2; i++)
        assert_true(hd_stages_wait(hd_frame_store_stages(store), take(store)));
    give(store, &setup, 1);
    wait_for_entries("four", 2);
    assert_int_equal(count_entries("four"), 2);
    assert_int_not_equal(access("four/a_101.data", F_OK), 0);
    hd_stages_give_back(hd_frame_store_stages(store), 0);
    assert_int_equal(hd_frame_store_end(store, HD_OK, &error), HD_OK);
    hd_resume_free(&setup.resume);
    assert_int_equal(listener.calls, 0);
    assert_int_equal(count_entries("four"), 0);
}

TEST(what_cannot_be_begun_leaves_nothing) {
    Listener listener = {.fails_at = -1};
    Setup setup;
    HdFrameStore *store;
    assert_int_equal(start(&store, &setup, "/dev/null/a_%d.data", "three/a_%d.data", &listener),
                     HD_FAILED);
    assert_null(store);
    hd_resume_free(&setup.resume);
    assert_int_not_equal(access("three", F_OK), 0);
}

/* Of a frame whose second picture cannot be written the first is not there either. */
TEST(the_first_failure_ends_it) {
    Listener listener = {.fails_at = -1};
    Setup setup;
    HdFrameStore *store;
    assert_int_equal(start(&store, &setup, "five/%d.data", "six/%d.data", &listener), HD_OK);
    assert_int_equal(rmdir("six"), 0);
    int place = take(store);
    assert_true(hd_stages_wait(hd_frame_store_stages(store), place));
    give(store, &setup, place);
    assert_int_equal(hd_frame_store_end(store, HD_OK, &error), HD_FAILED);
    hd_resume_free(&setup.resume);
    assert_int_equal(listener.calls, 0);
    assert_int_equal(count_entries("five"), 0);
    assert_int_not_equal(access("six", F_OK), 0);
}

static bool has_ffmpeg(void) {
    return system("command -v ffmpeg >ffmpeg.log 2>&1 && command -v ffprobe >ffmpeg.log 2>&1") == 0;
}

/* FFV1 keeps every byte. */
static void check_order_in_film(const char *film) {
    char command[256];
    int last = -1;
    snprintf(command, sizeof command,
             "ffmpeg -v error -y -i %s -f rawvideo -pix_fmt rgb24 film.raw >ffmpeg.log 2>&1", film);
    assert_int_equal(system(command), 0);
    FILE *file = fopen("film.raw", "rb");
    assert_non_null(file);
    for (int i = 0; i < FRAMES; i++) {
        int byte = fgetc(file);
        assert_true(byte > last);
        last = byte;
        assert_int_equal(fseek(file, WIDTH * HEIGHT * 3 - 1, SEEK_CUR), 0);
    }
    fclose(file);
}

TEST(films_and_pictures_go_side_by_side) {
    Listener listener = {.fails_at = -1};
    if (!has_ffmpeg())
        skip();
    assert_int_equal(store_frames(&listener, "film.mkv"), HD_OK);
    assert_int_equal(listener.stored, FRAMES);
    assert_true(listener.last.convert.began >= listener.last.trace.began);
    assert_true(listener.last.film.began >=
                listener.last.convert.began + listener.last.convert.seconds - 1e-6);
    check_order_in_film("film.mkv");
    check_first_frames(FRAMES);
    /* A film with a failing listener leaves no file. */
    listener.fails_at = 10;
    assert_int_equal(store_frames(&listener, "other.mkv"), HD_FAILED);
    assert_int_not_equal(access("other.mkv", F_OK), 0);
    check_frames_of_a_listener_that_failed(11);
}

AT_START(hd_interrupt_install)
