/* SPDX-License-Identifier: MIT */
/* The order in which bytes, names and words of frames are on the disk and told. */
#define _XOPEN_SOURCE   700
#define _DEFAULT_SOURCE /* syscall */
#include "output/publisher.h"

#include <errno.h>
#include <sys/syscall.h>

#include "test_folder.h"
#include "wrapped.h"

enum { MOST = 3 };

static HdError error;
static HdPublisher *publisher;
static HdOutputPlan outputs;
static HdPublisherPlan plan;

/* ---- what happens, as text: "F1" a file's bytes, "D" a folder, "T1" a frame that is told ---- */

static char events[1000];
static int syncs, fails_at; /* the sync of this number fails */
static int tell_fails_at;   /* the frame of this number fails to be told */

static void note(const char *event) {
    const size_t length = strlen(events);
    snprintf(events + length, sizeof events - length, "%s%s", length > 0 ? " " : "", event);
}

static int note_sync(int descriptor) {
    char link[64], path[1000] = "", event[64];
    struct stat found;
    fstat(descriptor, &found);
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    if (readlink(link, path, sizeof path - 1) < 0)
        return -1;
    const char *name = strrchr(path, '/') + 1;
    if (S_ISDIR(found.st_mode))
        note(strcmp(name, "out") == 0 ? "D" : "U");
    else {
        snprintf(event, sizeof event, "F%.1s%s", name, strstr(name, ".tmp-") == NULL ? "!" : "");
        note(event);
    }
    if (++syncs == fails_at) {
        errno = EIO;
        return -1;
    }
    return real_fsync(descriptor);
}

static HdStatus tell(void *context, const HdStoredFrame *stored, HdError *failure) {
    char event[64];
    assert_ptr_equal(context, &plan);
    assert_null(stored->frame->rgb);
    assert_null(stored->frame->rgba);
    assert_int_equal(stored->frame->width, 100 + stored->number);
    snprintf(event, sizeof event, "T%d%s", stored->number, stored->was_finished ? "+" : "");
    note(event);
    return stored->number == tell_fails_at ? hd_fail(failure, HD_FAILED, "nobody listens") : HD_OK;
}

/* ---- frames ---- */

static int begin(void **state) {
    (void)state;
    events[0] = '\0';
    syncs = fails_at = 0;
    tell_fails_at = -1;
    remove_folder("out");
    outputs = (HdOutputPlan){
        .count = 2,
        .list = {{.name = "out/%d.data", .format = &hd_format_data, .is_numbered = true},
                 {.name = "film.mkv", .format = &hd_format_mkv, .is_film = true}}};
    plan = (HdPublisherPlan){.outputs = &outputs,
                             .durability = HD_DURABLE,
                             .most = MOST,
                             .stored = tell,
                             .context = &plan};
    hd_known_folders_forget();
    return mkdir("out", 0777) != 0 || hd_publisher_create(&publisher, &plan, &error) != HD_OK;
}

static int end(void **state) {
    (void)state;
    hd_publisher_free(publisher);
    publisher = NULL;
    return 0;
}

static HdStatus add_one(int number, bool was_finished) {
    HdAtomicFile files[HD_MAX_OUTPUTS];
    float rgb[3];
    char path[100];
    const HdFrame frame = {.width = 100 + number, .height = 1, .rgb = rgb};
    const HdStoredFrame stored = {.number = number, .frame = &frame, .was_finished = was_finished};
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        files[i].lock = -1;
    if (!was_finished) {
        snprintf(path, sizeof path, "out/%d.data", number);
        assert_int_equal(hd_atomic_file_open(&files[0], path, &error), HD_OK);
        fputs("bytes", files[0].stream);
        assert_int_equal(hd_atomic_file_close(&files[0], &error), HD_OK);
    }
    const HdStatus status = hd_publisher_add(publisher, &stored, files, &error);
    for (int i = 0; i < HD_MAX_OUTPUTS && status == HD_OK; i++)
        assert_int_equal(files[i].lock, -1);
    hd_atomic_file_discard(&files[0]);
    return status;
}

static void add(int first, int last) {
    for (int i = first; i <= last; i++)
        assert_int_equal(add_one(i, false), HD_OK);
}

static void settle(const char *expected) {
    assert_int_equal(hd_publisher_settle(publisher, &error), HD_OK);
    assert_string_equal(events, expected);
}

/* The numbers of the frames that are there under their names; nothing else is. */
static void expect_there(const char *numbers) {
    char path[100];
    for (const char *number = numbers; *number != '\0'; number++) {
        snprintf(path, sizeof path, "out/%c.data", *number);
        assert_int_equal(access(path, F_OK), 0);
    }
    assert_int_equal(count_entries("out"), strlen(numbers));
}

TEST(bytes_come_before_names_and_names_before_words) {
    add(1, 3);
    assert_string_equal(events, "");
    assert_int_equal(count_entries("out"), 3); /* under other names */
    assert_int_not_equal(access("out/1.data", F_OK), 0);
    settle("F1 F2 F3 D U T1 T2 T3");
    expect_there("123");
    settle("F1 F2 F3 D U T1 T2 T3"); /* nothing waits */
    add(4, 4);
    settle("F1 F2 F3 D U T1 T2 T3 F4 D T4"); /* what is above the folder is there */
    /* Finished frames are synced by name, for which every folder is. */
    events[0] = '\0';
    assert_int_equal(add_one(2, true), HD_OK);
    settle("D T2+");
}

/* Of three frames. The failure of the earliest one counts. */
TEST(a_failure_ends_it_there) {
    static const char no_listener[] = "nobody listens";
    static const struct {
        int fails_at, tell_fails_at; /* as above */
        const char *blocked, *why, *events, *there;
    } cases[] = {
        {2, -1, NULL, "cannot write out/2.data to the disk: Input/output error", "F1 F2 D U T1",
         "1"},
        {4, -1, NULL, "cannot write out to the disk: Input/output error", "F1 F2 F3 D", "123"},
        {-1, -1, "out/2.data", "out/2.data", "F1 F2 F3 D U T1", "12"},
        {-1, 2, NULL, no_listener, "F1 F2 F3 D U T1 T2", "123"},
        {3, 1, NULL, no_listener, "F1 F2 F3 D U T1", "12"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        end(NULL);
        begin(NULL);
        add(1, 3);
        fails_at = cases[i].fails_at;
        tell_fails_at = cases[i].tell_fails_at;
        if (cases[i].blocked != NULL)
            mkdir(cases[i].blocked, 0777);
        assert_int_not_equal(hd_publisher_settle(publisher, &error), HD_OK);
        expect_contains(error.message, cases[i].why);
        assert_string_equal(events, cases[i].events);
        expect_there(cases[i].there);
    }
}

TEST(a_frame_too_many_settles_those_before) {
    add(1, 3);
    tell_fails_at = 1;
    assert_int_equal(add_one(4, false), HD_FAILED);
    assert_string_equal(error.message, "nobody listens");
    expect_there("123");
    tell_fails_at = -1;
    add(5, 8);
    end(NULL);
    expect_there("123567"); /* the one that waited is gone */
}

EACH(begin, end)
REPLACE(fsync, note_sync)
