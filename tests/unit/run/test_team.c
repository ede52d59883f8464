/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include <errno.h>
#include <pthread.h>
#include <signal.h>

#include "fake_backend.h"
#include "run/sequence.h"
#include "scene/camera.h"
#include "small_scene.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "test_folder.h"
#include "wrapped.h"

/* More frames than a store has space for. */
enum { DEVICES = 3, FRAMES = 36, POINTS = 4 };

/* The events so far. */
static struct {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    int events[DEVICES][POINTS];
    int collecting; /* devices that do */
    int failed, dropped, signals;
    int stored;
} history = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

static HdError error;
static HdScene scene;
static int frame_numbers[FRAMES];
static HdFrameList frames;
static int makers[FRAMES]; /* device that traced the frame; -1: it was not stored */
static int dropped_ones[DEVICES];
static char dropped_why[512];
static int the_cpu; /* the device that is a CPU; the others are GPUs */

/* A device's action at a point on its visit number `count`, after waiting until a number of the
   history, which only this thread reads otherwise, is large enough. */
typedef struct Rule {
    FakePoint point;
    int count; /* 0: nothing happens */
    const int *until;
    int least;
    enum { GO_ON, FAIL, RAISE_SIGNAL } then;
} Rule;
static Rule rules[DEVICES];

static HdStatus follow_rules(FakePoint point, int index, HdError *failure) {
    const Rule *rule = &rules[index];
    pthread_mutex_lock(&history.mutex);
    const int count = ++history.events[index][point];
    const bool is_here = count == rule->count && point == rule->point;
    history.collecting += point == FAKE_COLLECT && count == 1;
    pthread_cond_broadcast(&history.changed);
    while (is_here && rule->until != NULL && *rule->until < rule->least)
        pthread_cond_wait(&history.changed, &history.mutex);
    const bool fails = is_here && rule->then == FAIL;
    history.failed += fails;
    if (is_here && rule->then == RAISE_SIGNAL)
        history.signals += raise(SIGTERM) == 0;
    pthread_cond_broadcast(&history.changed);
    pthread_mutex_unlock(&history.mutex);
    return fails ? hd_fail(failure, HD_FAILED, "it fails") : HD_OK;
}

static void note_uploaded(void *context, int renderer, const HdSceneTables *tables) {
    (void)context;
    assert_true(renderer >= 0 && renderer < DEVICES && tables->plane_count > 0);
}

static void note_dropped(void *context, int renderer, const HdError *why) {
    (void)context;
    pthread_mutex_lock(&history.mutex);
    dropped_ones[history.dropped++] = renderer;
    snprintf(dropped_why, sizeof dropped_why, "%.400s", why->message);
    pthread_cond_broadcast(&history.changed);
    pthread_mutex_unlock(&history.mutex);
}

static HdStatus note_stored(void *context, const HdStoredFrame *stored, HdError *failure) {
    (void)context;
    (void)failure;
    pthread_mutex_lock(&history.mutex);
    bool in_order = stored->number == frame_numbers[history.stored];
    makers[history.stored++] = stored->worker;
    pthread_cond_broadcast(&history.changed);
    pthread_mutex_unlock(&history.mutex);
    return in_order ? HD_OK : hd_fail(failure, HD_FAILED, "frame %d is early", stored->number);
}

static int begin(void **state) {
    (void)state;
    memset(&fake, 0, sizeof fake);
    memset(history.events, 0, sizeof history.events);
    history.collecting = history.failed = history.dropped = history.stored = 0;
    the_cpu = -1;
    memset(rules, 0, sizeof rules);
    fake.event = follow_rules;
    for (int i = 0; i < FRAMES; i++) {
        frame_numbers[i] = i;
        makers[i] = -1;
    }
    frames = (HdFrameList){.frames = frame_numbers, .count = FRAMES};
    if (small_scene(&scene, "hexahedron", &error) != HD_OK)
        return 1;
    scene.frame_count = FRAMES;
    scene.eye = (HdPath){.cylinder = {.r0 = 3.0, .z0 = 1.0, .phi_frequency = 1.0}};
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_free(&scene);
    return access("run", F_OK) == 0 ? remove_folder("run") : 0;
}

static void begin_again(void) {
    end(NULL);
    begin(NULL);
}

/* Number of threads that a sequence may start, and has left; negative: any number. */
static int threads_for_sequence = -1, threads_allowed = -1, threads_left;

/* The arithmetic is fast, so that the kernels do not test themselves first. */
static HdStatus render(const char *output, int count) {
    const HdRenderOptions options = {.threads = 1, .math = HD_MATH_FAST};
    const HdOutputStyle style = {.picture = {.curve = HD_CURVE_SRGB, .bits = 8},
                                 .frames_per_second = 30};
    HdOutputPlan plan;
    HdResume resume;
    HdDeviceTeam team = {.count = count};
    HdSequence sequence = {
        .scene = &scene,
        .resume = &resume,
        .outputs = &plan,
        .team = &team,
        .uploaded = note_uploaded,
        .dropped = note_dropped,
        .stored = note_stored,
    };
    assert_int_equal(hd_outputs_settle(&plan, &output, 1, &style, frames.count, &error), HD_OK);
    assert_int_equal(hd_resume_find(&resume, &plan, &frames, &error), HD_OK);
    for (int i = 0; i < count; i++) {
        HdTeamDevice *member = &team.list[i];
        member->device = fake_device();
        member->device.index = i;
        member->device.is_cpu = i == the_cpu;
        assert_int_equal(hd_renderer_open(&member->renderer, &member->device, &options, &error),
                         HD_OK);
    }
    threads_allowed = threads_for_sequence;
    HdStatus status = hd_sequence_render(&sequence, &error);
    threads_left = threads_allowed;
    threads_allowed = -1;
    hd_close_devices(&team);
    hd_resume_free(&resume);
    return status;
}

static int count_made_by(int device) {
    int count = 0;
    for (int i = 0; i < FRAMES; i++)
        count += makers[i] == device;
    return count;
}

static void expect_all_made(int devices, int dropped) {
    assert_int_equal(render("run/%d.data", devices), HD_OK);
    assert_int_equal(history.stored, frames.count);
    assert_int_equal(history.dropped, dropped);
    int made = 0;
    for (int i = 0; i < devices; i++)
        made += count_made_by(i);
    assert_int_equal(made, frames.count);
    assert_int_equal(count_entries("run"), frames.count);
}

static void hold_all(void) {
    for (int i = 0; i < DEVICES; i++)
        rules[i] = (Rule){FAKE_COLLECT, 1, &history.collecting, DEVICES, GO_ON};
}

TEST(devices_share_the_frames) {
    for (int mean = 0; mean < 2; mean++) {
        begin_again();
        scene.max_error = mean;
        hold_all();
        expect_all_made(DEVICES, 0);
        for (int i = 0; i < DEVICES; i++)
            assert_true(count_made_by(i) > 0);
    }
}

/* The GPU finishes nothing before the CPU has rendered something, which can only be its
   estimate. */
TEST(a_cpu_with_gpus_estimates_its_pace) {
    the_cpu = 1;
    rules[0] = (Rule){FAKE_COLLECT, 1, &history.events[1][FAKE_COLLECT], 1, GO_ON};
    expect_all_made(2, 0);
}

/* The second device fails; the first one finishes nothing before. */
TEST(others_trace_a_failed_devices_frames) {
    const struct {
        FakePoint point;
        int count, made;
    } cases[] = {{FAKE_UPLOAD, 1, 0}, {FAKE_SUBMIT, 1, 0},  {FAKE_SUBMIT, 2, 1},
                 {FAKE_SUBMIT, 3, 2}, {FAKE_COLLECT, 1, 0}, {FAKE_COLLECT, 2, 1},
                 {FAKE_COLLECT, 5, 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin_again();
        rules[0] = (Rule){FAKE_COLLECT, 1, &history.failed, 1, GO_ON};
        rules[1] = (Rule){cases[i].point, cases[i].count, NULL, 0, FAIL};
        expect_all_made(2, 1);
        assert_int_equal(dropped_ones[0], 1);
        assert_string_equal(dropped_why, "fake: it fails");
        assert_int_equal(count_made_by(1), cases[i].made);
    }
}

/* Lets the second device fail with its first frame after the other one has made so many. */
static void fail_second_after(int made) {
    rules[0] = (Rule){FAKE_COLLECT, 1, &history.events[1][FAKE_COLLECT], 1, GO_ON};
    rules[1] = (Rule){FAKE_COLLECT, 1, &history.events[0][FAKE_COLLECT], made, FAIL};
}

/* The first device has made all that it can beside the second one's, of a few frames or of more
   than the store has space for, and is still needed. A device must not hold a later frame that
   waits for its next one. */
TEST(a_late_failure_stops_nobody) {
    enum { MAX_ENCODERS = 16, SPARE = 12 }; /* which decide the capacity */
    const int processors = hd_processor_count();
    const int room = (processors < MAX_ENCODERS ? processors : MAX_ENCODERS) + SPARE;
    for (int k = 0; k < 2; k++) {
        begin_again();
        frames.count = k == 0 ? 8 : FRAMES;
        fail_second_after((k == 0 ? 8 : room) - 1);
        expect_all_made(2, 1);
        assert_int_equal(count_made_by(1), 0);
    }
}

/* The others continue first. A single device's message is used unchanged. */
TEST(all_devices_failing_is_an_error) {
    const struct {
        int devices;
        FakePoint point;
        int count, stored;
    } cases[] = {{DEVICES, FAKE_UPLOAD, 1, 0},  {DEVICES, FAKE_SUBMIT, 1, 0},
                 {DEVICES, FAKE_COLLECT, 1, 0}, {1, FAKE_UPLOAD, 1, 0},
                 {1, FAKE_SUBMIT, 4, 3},        {1, FAKE_COLLECT, 4, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin_again();
        for (int k = 0; k < cases[i].devices; k++)
            rules[k] = (Rule){cases[i].point, cases[i].count, &history.dropped, k, FAIL};
        assert_int_equal(render("run/%d.data", cases[i].devices), HD_FAILED);
        assert_string_equal(error.message,
                            cases[i].devices == 1
                                ? "fake: it fails"
                                : "no device is left, for the last one failed: fake: it fails");
        assert_int_equal(history.dropped, cases[i].devices - 1);
        for (int k = 0; k < history.dropped; k++)
            assert_int_equal(dropped_ones[k], k);
        assert_int_equal(history.stored, cases[i].stored);
        if (access("run", F_OK) == 0)
            assert_int_equal(count_entries("run"), cases[i].stored);
    }
}

/* The eye is at the target in that frame. */
static void expect_spoilt(int frame, int devices, int dropped) {
    char expected[64];
    scene.target =
        (HdPath){.is_fixed = true, .point = hd_path_point(&scene.eye, frame, scene.frame_count)};
    assert_int_equal(render("run/%d.data", devices), HD_BAD_INPUT);
    snprintf(expected, sizeof expected, "frame %d: the eye is at the target", frame);
    expect_contains(error.message, expected);
    assert_int_equal(history.stored, frame);
    assert_int_equal(history.dropped, dropped);
    assert_int_equal(count_entries("run"), frame);
}

TEST(an_impossible_frame_ends_it_for_all) {
    for (int mean = 0; mean < 2; mean++) {
        begin_again();
        scene.max_error = mean;
        hold_all();
        expect_spoilt(7, DEVICES, 0);
    }
    begin_again();
    fail_second_after(4); /* the frames before are still made */
    expect_spoilt(5, 2, 1);
}

/* ---- the system refuses threads ---- */

static int create_few(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                      void *argument) {
    if (threads_allowed == 0)
        return EAGAIN;
    if (threads_allowed > 0)
        threads_allowed--;
    return real_pthread_create(thread, attributes, run, argument);
}
REPLACE(pthread_create, create_few)

/* With fewer and fewer threads first devices are missing, then all of them; without any the store
   cannot begin. */
TEST(devices_without_a_thread_are_dropped) {
    enum { ENOUGH = 1000 };
    static const char *const errors[] = {
        NULL, "no device is left, for the last one failed: ", "for the outputs: "};
    threads_for_sequence = ENOUGH;
    assert_int_equal(render("run/%d.data", 2), HD_OK);
    const int needed = ENOUGH - threads_left;
    for (int missing = 1; missing <= 3; missing++) {
        begin_again();
        threads_for_sequence = missing < 3 ? needed - missing : 0;
        HdStatus status = render("run/%d.data", 2);
        threads_for_sequence = -1;
        assert_int_equal(status, missing == 1 ? HD_OK : HD_FAILED);
        assert_int_equal(history.dropped, missing < 3);
        if (missing < 3)
            expect_contains(dropped_why, "cannot start a thread for the device: ");
        if (missing == 1)
            assert_int_equal(count_entries("run"), FRAMES);
        else
            expect_contains(error.message, errors[missing - 1]);
    }
}

/* ---- a signal, which the program remembers for ever ---- */

TEST(a_signal_ends_it_for_all) {
    rules[0] = (Rule){FAKE_COLLECT, 3, NULL, 0, RAISE_SIGNAL};
    rules[1] = (Rule){FAKE_COLLECT, 1, &history.signals, 1, GO_ON};
    assert_int_equal(render("run/%d.data", 2), HD_INTERRUPTED);
    assert_true(history.stored < 3 && history.dropped == 0);
    assert_int_equal(count_entries("run"), history.stored);
}

EACH(begin, end)

AT_START(hd_interrupt_install)
