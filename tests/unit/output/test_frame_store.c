/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include <stdbool.h>

#include "output/frame_store.h"
#include "system/atomic_file.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "test_folder.h"

enum { WIDTH = 40, HEIGHT = 30, FRAMES = 30, FIRST = 100, PATIENCE_SECONDS = 600 };

static HdError error;

typedef struct Listener {
    int calls;
    int fails_at; /* the call that fails; -1: none */
    bool in_order;
    bool was_there; /* each frame's pictures, when it was told of */
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
    if (listener->calls++ == listener->fails_at)
        return hd_fail(failure, HD_FAILED, "the listener failed");
    return HD_OK;
}

/* Stores frames until there are no more or the store wants no more. */
static HdStatus store_frames(Listener *listener, const char *second_output, int *stored) {
    HdOutputPlan plan = {
        .names = {"run/%d.data", second_output},
        .count = second_output != NULL ? 2 : 1,
        .style = {.picture = {.curve = HD_CURVE_SRGB, .bits = 8}, .frames_per_second = 30},
    };
    int numbers[FRAMES];
    HdFrameList frames = {.frames = numbers, .count = FRAMES};
    HdFrameStorePlan store_plan = {.frames = &frames,
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .tracers = 1,
                                   .start = hd_monotonic_seconds(),
                                   .stored = note_stored,
                                   .context = listener};
    HdFrameStore *store;
    HdFrameTimes *times;
    int place;
    for (int i = 0; i < FRAMES; i++)
        numbers[i] = FIRST + i;
    hd_known_folders_forget(); /* that of another test is gone */
    *listener = (Listener){.fails_at = listener->fails_at, .in_order = true, .was_there = true};
    assert_int_equal(hd_outputs_open(&store_plan.outputs, &plan, WIDTH, HEIGHT, &error), HD_OK);
    assert_int_equal(hd_frame_store_start(&store, &store_plan, &error), HD_OK);
    while ((place = hd_frame_store_take(store, NULL, NULL, true)) >= 0) {
        if (!hd_frame_store_wait(store, place))
            continue;
        HdFrame *frame = hd_frame_store_frame(store, place, &times);
        for (int value = 0; value < WIDTH * HEIGHT * 3; value++)
            frame->rgb[value] = (float)place / FRAMES;
        times->trace = (HdSpan){hd_monotonic_seconds() - store_plan.start, 0.0};
        hd_frame_store_give(store, place, place % 3);
    }
    HdStatus status = hd_frame_store_end(store, stored, &error);
    HdError ignored;
    if (status == HD_OK)
        assert_int_equal(hd_outputs_close(store_plan.outputs, &ignored), HD_OK);
    else
        hd_outputs_abort(store_plan.outputs);
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

static void frames_are_stored_in_order(void **state) {
    (void)state;
    Listener listener = {.fails_at = -1};
    int stored;
    assert_int_equal(store_frames(&listener, "run/%d.png", &stored), HD_OK);
    assert_int_equal(stored, FRAMES);
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

static void a_listener_that_fails_ends_it(void **state) {
    (void)state;
    Listener listener = {.fails_at = 4};
    int stored;
    assert_int_equal(store_frames(&listener, NULL, &stored), HD_FAILED);
    assert_string_equal(error.message, "the listener failed");
    assert_int_equal(stored, 5);
    assert_int_equal(listener.calls, 5);
    check_first_frames(5);
}

static void a_picture_that_cannot_be_written_ends_it(void **state) {
    (void)state;
    Listener listener = {.fails_at = -1};
    int stored;
    mkdir("other", 0777);
    mkdir("other/107.data", 0777);
    assert_int_equal(store_frames(&listener, "other/%d.data", &stored), HD_BAD_INPUT);
    expect_contains(error.message, "other/107.data");
    assert_int_equal(stored, 7);
    assert_int_equal(listener.calls, 7);
    check_first_frames(7);
    assert_int_equal(count_entries("other"), 8);
    assert_int_equal(remove_folder("other"), 0);
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

static void films_and_pictures_go_side_by_side(void **state) {
    (void)state;
    Listener listener = {.fails_at = -1};
    int stored;
    if (!has_ffmpeg())
        skip();
    assert_int_equal(store_frames(&listener, "film.mkv", &stored), HD_OK);
    assert_int_equal(stored, FRAMES);
    assert_true(listener.last.convert.began >= listener.last.trace.began);
    assert_true(listener.last.film.began >=
                listener.last.convert.began + listener.last.convert.seconds - 1e-6);
    check_order_in_film("film.mkv");
    check_first_frames(FRAMES);
    /* A film with a failing listener leaves no file. */
    listener.fails_at = 10;
    assert_int_equal(store_frames(&listener, "other.mkv", &stored), HD_FAILED);
    assert_int_not_equal(access("other.mkv", F_OK), 0);
    check_first_frames(11);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_stored_in_order),
        cmocka_unit_test(a_listener_that_fails_ends_it),
        cmocka_unit_test(a_picture_that_cannot_be_written_ends_it),
        cmocka_unit_test(films_and_pictures_go_side_by_side),
    };
    hd_interrupt_install();
    alarm(PATIENCE_SECONDS);
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
