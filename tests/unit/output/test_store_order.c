/* SPDX-License-Identifier: MIT */
/* The order in which bytes, names and reports of frames reach the disk and the user. */
#define _XOPEN_SOURCE   700
#define _DEFAULT_SOURCE /* syscall */
#include <errno.h>

#include "output/frame_store.h"
#include "system/machine.h"
#include "test_folder.h"
#include "wrapped.h"

enum { FRAMES = 12, FINISHED = 3, NOBODY = -1, FOLDER = -2 };

static HdError error;
static int numbers[FRAMES], missing[FRAMES - 1];
static const HdFrameList frames = {.frames = numbers, .count = FRAMES};
static HdOutputPlan outputs;

/* Events on the disk, by frame; only the last stage's thread notes them. */
static struct {
    bool bytes[FRAMES], name[FRAMES];
    int syncs, reported;
    bool is_as_expected;
} done;

/* Frames, or FOLDER, or NOBODY. */
static struct { int sync_fails, name_is_taken, report_fails; } faults;

static bool is_there(int number) {
    char path[32];
    snprintf(path, sizeof path, "out/%d.data", number);
    return access(path, F_OK) == 0;
}

static int note_sync(int descriptor) {
    char link[64], path[1000] = "";
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    if (readlink(link, path, sizeof path - 1) < 0)
        return -1;
    const char *name = strrchr(path, '/') + 1;
    const bool is_file = strstr(name, ".tmp-") != NULL;
    const int number = is_file ? atoi(name) : FOLDER;
    done.syncs++;
    if (is_file) {
        done.is_as_expected &= !is_there(number);
        done.bytes[number] = true;
    } else if (strcmp(name, "out") == 0) {
        for (int i = 0; i < FRAMES; i++)
            done.name[i] = is_there(i);
    }
    if (is_file && number == faults.name_is_taken) {
        snprintf(path, sizeof path, "out/%d.data", number);
        mkdir(path, 0777);
    }
    errno = EIO;
    return number == faults.sync_fails ? -1 : real_fsync(descriptor);
}

static HdStatus tell(void *context, const HdStoredFrame *stored, HdError *failure) {
    const int number = stored->number;
    const bool is_durable = outputs.durability == HD_DURABLE;
    (void)context;
    done.is_as_expected &= number == done.reported++ && is_there(number) &&
                           stored->was_finished == (number == FINISHED) &&
                           stored->frame->rgb == NULL && stored->frame->rgba == NULL &&
                           stored->frame->width == 2;
    if (is_durable)
        done.is_as_expected &= done.name[number] && (done.bytes[number] || stored->was_finished);
    return number == faults.report_fails ? hd_fail(failure, HD_FAILED, "nobody listens") : HD_OK;
}

static void trace_all(HdFrameStore *store) {
    const HdClaimer claimer = {.ahead = 2};
    HdStages *stages = hd_frame_store_stages(store);
    HdFrameTimes *times;
    int place;
    while ((place = hd_stages_claim(stages, &claimer, true)) >= 0) {
        if (!hd_stages_wait(stages, place))
            continue;
        memset(hd_frame_store_frame(store, place, 0, &times)->rgb, 0, 6 * sizeof(float));
        hd_stages_submit(stages, place);
    }
}

static HdStatus store_frames(HdDurability durability) {
    static const char *const name = "out/%d.data";
    const HdOutputStyle style = {{HD_CURVE_SRGB, 8, false}, 30, false};
    bool is_finished[FRAMES] = {[FINISHED] = true};
    HdResume resume = {.all = &frames,
                       .missing = {.frames = missing, .count = FRAMES - 1},
                       .is_finished = is_finished,
                       .finished_count = 1};
    HdFrameStore *store;
    memset(&done, 0, sizeof done);
    done.is_as_expected = true;
    remove_folder("out");
    assert_int_equal(mkdir("out", 0777), 0);
    write_bytes("out/3.data", "x", 1);
    hd_known_folders_forget();
    assert_int_equal(hd_outputs_settle(&outputs, &name, 1, &style, FRAMES, &error), HD_OK);
    outputs.durability = durability;
    const HdFrameStorePlan plan = {.outputs = &outputs,
                                   .resume = &resume,
                                   .width = 2,
                                   .height = 1,
                                   .workers = 1,
                                   .start = hd_monotonic_seconds(),
                                   .stored = tell};
    assert_int_equal(hd_frame_store_start(&store, &plan, &error), HD_OK);
    trace_all(store);
    const HdStatus status = hd_frame_store_end(store, HD_OK, &error);
    assert_true(done.is_as_expected);
    return status;
}

TEST(bytes_precede_names_and_names_precede_reports) {
    assert_int_equal(store_frames(HD_DURABLE), HD_OK);
    assert_int_equal(done.reported, FRAMES);
    assert_int_equal(count_entries("out"), FRAMES);
    assert_true(done.syncs > FRAMES);
    assert_int_equal(store_frames(HD_WITHOUT_SYNC), HD_OK);
    assert_int_equal(done.reported, FRAMES);
    assert_int_equal(done.syncs, 0);
}

/* Frames before the one that failed are stored; later ones leave nothing. If reporting failed,
   those that waited with it have their names. */
TEST(a_failure_ends_it_there) {
    static const struct {
        int sync_fails, name_is_taken, report_fails;
        const char *why;
        int reported, there; /* negative: at least as many */
    } cases[] = {
        {6, NOBODY, NOBODY, "cannot write out/6.data to the disk: Input/output error", 6, 6},
        {FOLDER, NOBODY, NOBODY, "cannot write out to the disk: Input/output error", 0, -2},
        {NOBODY, 6, NOBODY, "out/6.data", 6, 7},
        {NOBODY, NOBODY, 6, "nobody listens", 7, -7},
        {8, NOBODY, 6, "nobody listens", 7, -7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        faults.sync_fails = cases[i].sync_fails;
        faults.name_is_taken = cases[i].name_is_taken;
        faults.report_fails = cases[i].report_fails;
        assert_int_equal(store_frames(HD_DURABLE), HD_FAILED);
        expect_contains(error.message, cases[i].why);
        assert_int_equal(done.reported, cases[i].reported);
        int there = 0;
        for (int k = 0; k < FRAMES; k++)
            there += is_there(k);
        assert_int_equal(count_entries("out"), there);
        /* The finished one always exists. */
        if (cases[i].there >= 0)
            assert_int_equal(there, cases[i].there);
        else
            assert_true(there >= -cases[i].there);
    }
}

static int begin(void **state) {
    (void)state;
    for (int i = 0; i < FRAMES; i++)
        numbers[i] = i;
    for (int i = 0; i < FRAMES - 1; i++)
        missing[i] = i < FINISHED ? i : i + 1;
    faults.sync_fails = faults.name_is_taken = faults.report_fails = NOBODY;
    return 0;
}

EACH(begin, NULL)
REPLACE(fsync, note_sync)
