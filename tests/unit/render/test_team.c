/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include <errno.h>
#include <pthread.h>
#include <signal.h>

#include "device/self_test_scenes.h"
#include "fake_backend.h"
#include "render/sequence.h"
#include "scene/camera.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "test_folder.h"
#include "wrapped.h"

/* More frames than a store has room for. */
enum { DEVICES = 3, FRAMES = 36, POINTS = 4 };

/* What happened so far. Devices that must take part wait for each other here. */
static struct {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    int events[DEVICES][POINTS];
    int failed, dropped;
    int stored;
} history = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

static HdError error;
static HdScene scene;
static int frame_numbers[FRAMES];
static HdFrameList frames;
static int makers[FRAMES]; /* who traced the frame; -1: it was not stored */
static int dropped_ones[DEVICES];
static char dropped_why[512];
static int the_cpu; /* which device is one; the others are GPUs */

typedef bool Happened(void);

static void wait_until(Happened *happened) {
    while (!happened())
        pthread_cond_wait(&history.changed, &history.mutex);
}

static HdStatus fail_here(HdError *failure) {
    history.failed++;
    return hd_fail(failure, HD_FAILED, "it fails");
}

/* What a test does at a point, which it may let fail; the history is its own meanwhile. */
typedef HdStatus Script(FakePoint point, int index, int count, HdError *failure);
static Script *script;

static HdStatus follow_script(FakePoint point, int index, HdError *failure) {
    pthread_mutex_lock(&history.mutex);
    int count = ++history.events[index][point];
    pthread_cond_broadcast(&history.changed);
    HdStatus status = script != NULL ? script(point, index, count, failure) : HD_OK;
    pthread_cond_broadcast(&history.changed);
    pthread_mutex_unlock(&history.mutex);
    return status;
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
    makers[history.stored++] = stored->tracer;
    pthread_cond_broadcast(&history.changed);
    pthread_mutex_unlock(&history.mutex);
    return in_order ? HD_OK : hd_fail(failure, HD_FAILED, "frame %d is early", stored->number);
}

static int begin(void **state) {
    (void)state;
    memset(&fake, 0, sizeof fake);
    memset(history.events, 0, sizeof history.events);
    history.failed = history.dropped = history.stored = 0;
    the_cpu = -1;
    script = NULL;
    fake.event = follow_script;
    for (int i = 0; i < FRAMES; i++) {
        frame_numbers[i] = i;
        makers[i] = -1;
    }
    frames = (HdFrameList){.frames = frame_numbers, .count = FRAMES};
    if (hd_self_test_scene(&scene, HD_SELF_TEST_SOLID, false, false, &error) != HD_OK)
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

/* A sequence may start so many threads, and has so many left; negative: any number. */
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

static bool is_same_file(const char *a, const char *b) {
    FILE *files[2] = {fopen(a, "rb"), fopen(b, "rb")};
    char bytes[2][4096];
    size_t sizes[2];
    for (int i = 0; i < 2; i++) {
        assert_non_null(files[i]);
        sizes[i] = fread(bytes[i], 1, sizeof bytes[i], files[i]);
        fclose(files[i]);
    }
    assert_true(sizes[0] > 0 && sizes[0] < sizeof bytes[0]);
    return sizes[0] == sizes[1] && memcmp(bytes[0], bytes[1], sizes[0]) == 0;
}

/* The folder has the first `count` frames, as one device makes them, and nothing else. */
static void expect_first_frames(int count) {
    const bool is_surveyed = scene.sampling == HD_SAMPLING_ADAPTIVE;
    const char *alone = is_surveyed ? "adaptive/%d.data" : "grid/%d.data";
    if (access(is_surveyed ? "adaptive" : "grid", F_OK) != 0) {
        script = NULL;
        history.stored = 0;
        frames.count = FRAMES;
        assert_int_equal(render(alone, 1), HD_OK);
    }
    assert_int_equal(count_entries("run"), count);
    for (int i = 0; i < count; i++) {
        char name[64], expected[64];
        snprintf(name, sizeof name, "run/%d.data", i);
        snprintf(expected, sizeof expected, is_surveyed ? "adaptive/%d.data" : "grid/%d.data", i);
        assert_true(is_same_file(name, expected));
    }
    assert_true(count < 2 || !is_same_file("run/0.data", "run/1.data"));
}

static int count_made_by(int device) {
    int count = 0;
    for (int i = 0; i < FRAMES; i++)
        count += makers[i] == device;
    return count;
}

/* ---- each at its own pace ---- */

static Happened *awaited;
static bool all_wait;

/* The first device, or each of them, finishes nothing before something happened. */
static HdStatus hold(FakePoint point, int index, int count, HdError *failure) {
    (void)failure;
    if (point == FAKE_COLLECT && count == 1 && (index == 0 || all_wait))
        wait_until(awaited);
    return HD_OK;
}

static HdStatus render_held(int devices, Happened *until, bool holds_all) {
    script = hold;
    awaited = until;
    all_wait = holds_all;
    return render("run/%d.data", devices);
}

static bool all_collect(void) {
    for (int i = 0; i < DEVICES; i++)
        if (history.events[i][FAKE_COLLECT] == 0)
            return false;
    return true;
}

TEST(devices_share_the_frames) {
    for (int survey = 0; survey < 2; survey++) {
        begin_again();
        scene.sampling = survey ? HD_SAMPLING_ADAPTIVE : HD_SAMPLING_GRID;
        scene.max_error = survey;
        assert_int_equal(render_held(DEVICES, all_collect, true), HD_OK);
        assert_int_equal(history.stored, FRAMES);
        for (int i = 0; i < DEVICES; i++)
            assert_true(count_made_by(i) > 0);
        assert_int_equal(count_made_by(0) + count_made_by(1) + count_made_by(2), FRAMES);
        assert_int_equal(history.dropped, 0);
        expect_first_frames(FRAMES);
    }
}

enum { AHEAD = 8 };

static bool second_is_ahead(void) {
    return history.events[1][FAKE_COLLECT] > AHEAD;
}

TEST(a_fast_device_does_not_wait_for_a_slow_one) {
    assert_int_equal(render_held(2, second_is_ahead, false), HD_OK);
    assert_true(count_made_by(0) > 0);
    assert_true(count_made_by(1) >= AHEAD);
    expect_first_frames(FRAMES);
}

static bool second_collects(void) {
    return history.events[1][FAKE_COLLECT] > 0;
}

/* The GPU finishes nothing before the CPU has rendered something, which can only be its estimate.
 */
TEST(a_cpu_beside_gpus_estimates_its_pace) {
    the_cpu = 1;
    assert_int_equal(render_held(2, second_collects, false), HD_OK);
    assert_int_equal(history.stored, FRAMES);
    assert_int_equal(history.dropped, 0);
    expect_first_frames(FRAMES);
}

/* ---- a device that fails ---- */

static FakePoint failing_point;
static int failing_count;

static bool one_failed(void) {
    return history.failed > 0;
}

/* The second device fails; the first one finishes nothing before. */
static HdStatus fail_second(FakePoint point, int index, int count, HdError *failure) {
    if (index == 1 && point == failing_point && count == failing_count)
        return fail_here(failure);
    if (index == 0 && point == FAKE_COLLECT && count == 1)
        wait_until(one_failed);
    return HD_OK;
}

TEST(others_trace_what_a_failed_device_had) {
    const struct {
        FakePoint point;
        int count, most_made;
    } cases[] = {{FAKE_UPLOAD, 1, 0},
                 {FAKE_SUBMIT, 1, 0},
                 {FAKE_SUBMIT, 3, 2},
                 {FAKE_COLLECT, 1, 0},
                 {FAKE_COLLECT, 5, 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin_again();
        failing_point = cases[i].point;
        failing_count = cases[i].count;
        script = fail_second;
        assert_int_equal(render("run/%d.data", 2), HD_OK);
        assert_int_equal(history.dropped, 1);
        assert_int_equal(dropped_ones[0], 1);
        assert_string_equal(dropped_why, "fake: it fails");
        assert_int_equal(history.stored, FRAMES);
        assert_int_equal(count_made_by(1), cases[i].most_made);
        assert_int_equal(count_made_by(0), FRAMES - cases[i].most_made);
        expect_first_frames(FRAMES);
    }
}

static bool first_has_the_rest(void) {
    return history.events[0][FAKE_COLLECT] >= frames.count - 1;
}

static Happened *fails_after;

/* The second device fails with its first frame, once something happened. */
static HdStatus fail_second_later(FakePoint point, int index, int count, HdError *failure) {
    if (point != FAKE_COLLECT || count > 1)
        return HD_OK;
    wait_until(index == 0 ? second_collects : fails_after);
    return index == 0 ? HD_OK : fail_here(failure);
}

static HdStatus render_failing_after(Happened *happened) {
    script = fail_second_later;
    fails_after = happened;
    return render("run/%d.data", 2);
}

TEST(a_device_that_has_done_its_part_is_still_there) {
    frames.count = 8;
    assert_int_equal(render_failing_after(first_has_the_rest), HD_OK);
    assert_int_equal(history.stored, 8);
    assert_int_equal(history.dropped, 1);
    assert_int_equal(count_made_by(0), 8);
    expect_first_frames(8);
}

/* What the store has room for beside the second device's first frame. */
static int room_beside(void) {
    enum { MOST_ENCODERS = 16, SPARE = 12 };
    int processors = hd_processor_count();
    return (processors < MOST_ENCODERS ? processors : MOST_ENCODERS) + SPARE - 1;
}

static bool store_is_full(void) {
    return history.events[0][FAKE_COLLECT] >= room_beside();
}

/* A device must not hold a later frame that waits for the one that it is to make now. */
TEST(a_failure_while_the_store_is_full_stops_nobody) {
    assert_int_equal(render_failing_after(store_is_full), HD_OK);
    assert_int_equal(history.stored, FRAMES);
    assert_int_equal(history.dropped, 1);
    assert_int_equal(count_made_by(0), FRAMES);
    expect_first_frames(FRAMES);
}

/* The others go on first. */
static HdStatus fail_everywhere(FakePoint point, int index, int count, HdError *failure) {
    if (point != failing_point || count < failing_count)
        return HD_OK;
    while (history.dropped < index)
        pthread_cond_wait(&history.changed, &history.mutex);
    return fail_here(failure);
}

/* The words of one alone are its own. */
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
        failing_point = cases[i].point;
        failing_count = cases[i].count;
        script = fail_everywhere;
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
            expect_first_frames(cases[i].stored);
    }
}

/* ---- what no device is to blame for ---- */

/* The eye is at the target in that frame. */
static void spoil_frame(int frame) {
    scene.target =
        (HdPath){.is_fixed = true, .point = hd_path_point(&scene.eye, frame, scene.frame_count)};
}

static void expect_spoilt(int frame, int dropped) {
    char expected[64];
    snprintf(expected, sizeof expected, "frame %d: the eye is at the target", frame);
    expect_contains(error.message, expected);
    assert_int_equal(history.stored, frame);
    assert_int_equal(history.dropped, dropped);
    assert_int_equal(count_entries("run"), frame);
}

TEST(a_frame_that_cannot_be_ends_it_for_all) {
    for (int survey = 0; survey < 2; survey++) {
        begin_again();
        scene.sampling = survey ? HD_SAMPLING_ADAPTIVE : HD_SAMPLING_GRID;
        spoil_frame(7);
        assert_int_equal(render_held(DEVICES, all_collect, true), HD_BAD_INPUT);
        expect_spoilt(7, 0);
    }
}

/* All that can be made beside the second device's. */
static bool first_has_four(void) {
    return history.events[0][FAKE_COLLECT] >= 4;
}

/* The first device has met the frame that cannot be, or is about to, and is still needed. */
TEST(frames_before_one_that_cannot_be_are_made) {
    spoil_frame(5);
    assert_int_equal(render_failing_after(first_has_four), HD_BAD_INPUT);
    expect_spoilt(5, 1);
}

TEST(a_picture_that_cannot_be_stored_ends_it_for_all) {
    mkdir("run", 0777);
    mkdir("run/5.data", 0777);
    assert_int_equal(render_held(DEVICES, all_collect, true), HD_BAD_INPUT);
    expect_contains(error.message, "run/5.data");
    assert_int_equal(history.stored, 5);
    assert_int_equal(history.dropped, 0);
    assert_int_equal(count_entries("run"), 6);
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

/* With fewer and fewer threads: first devices are missed, then all of them; without any it is the
   store that cannot begin. */
TEST(devices_without_a_thread_are_dropped) {
    enum { ENOUGH = 1000 };
    threads_for_sequence = ENOUGH;
    assert_int_equal(render("run/%d.data", 2), HD_OK);
    const int needed = ENOUGH - threads_left;
    for (int missing = 1; missing <= 3; missing++) {
        begin_again();
        threads_for_sequence = missing < 3 ? needed - missing : 0;
        HdStatus status = render("run/%d.data", 2);
        threads_for_sequence = -1;
        assert_int_equal(status, missing == 1 ? HD_OK : HD_FAILED);
        assert_int_equal(history.dropped, missing < 3 ? 1 : 0);
        if (missing < 3)
            expect_contains(dropped_why, "cannot start a thread for the device: ");
        if (missing == 1)
            expect_first_frames(FRAMES);
        if (missing == 2)
            expect_contains(error.message, "no device is left, for the last one failed: ");
        if (missing == 3)
            expect_contains(error.message, "for the outputs: ");
    }
}

/* ---- a signal, which the program remembers for ever ---- */

static bool is_signalled(void) {
    return hd_interrupt_signal() != 0;
}

static HdStatus interrupt(FakePoint point, int index, int count, HdError *failure) {
    (void)failure;
    if (point == FAKE_COLLECT && index == 0 && count == 3) {
        raise(SIGTERM);
        pthread_cond_broadcast(&history.changed);
    }
    if (point == FAKE_COLLECT && index == 1 && count == 1)
        wait_until(is_signalled);
    return HD_OK;
}

TEST(a_signal_ends_it_for_all) {
    char expected[64];
    script = interrupt;
    assert_int_equal(render("run/%d.data", 2), HD_INTERRUPTED);
    assert_true(history.stored < 3);
    assert_int_equal(history.dropped, 0);
    snprintf(expected, sizeof expected, "interrupted after %d of %d frames", history.stored,
             FRAMES);
    assert_string_equal(error.message, expected);
    assert_int_equal(count_entries("run"), history.stored);
}

EACH(begin, end)

AT_START(hd_interrupt_install)
