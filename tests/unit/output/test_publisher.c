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
        note(strcmp(name, "out") == 0 ? "D" : strcmp(name, "in") == 0 ? "I" : "U");
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
    return 0;
}

static HdStatus add_to(const char *folder, int number, bool was_finished) {
    HdAtomicFile files[HD_MAX_OUTPUTS];
    float rgb[3];
    char path[100];
    const HdFrame frame = {.width = 100 + number, .height = 1, .rgb = rgb};
    const HdStoredFrame stored = {.number = number, .frame = &frame, .was_finished = was_finished};
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        files[i].lock = -1;
    if (!was_finished) {
        snprintf(path, sizeof path, "%s/%d.data", folder, number);
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

static HdStatus add(int number) {
    return add_to("out", number, false);
}

static HdStatus settle(void) {
    return hd_publisher_settle(publisher, &error);
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
    for (int i = 1; i <= 3; i++)
        assert_int_equal(add(i), HD_OK);
    assert_string_equal(events, "");
    assert_int_equal(count_entries("out"), 3); /* under other names */
    assert_int_not_equal(access("out/1.data", F_OK), 0);
    assert_int_equal(settle(), HD_OK);
    assert_string_equal(events, "F1 F2 F3 D U T1 T2 T3");
    expect_there("123");
    assert_int_equal(settle(), HD_OK); /* nothing waits */
    assert_string_equal(events, "F1 F2 F3 D U T1 T2 T3");
    assert_int_equal(add(4), HD_OK);
    assert_int_equal(settle(), HD_OK); /* what is above the folder is there */
    assert_string_equal(events, "F1 F2 F3 D U T1 T2 T3 F4 D T4");
}

TEST(as_many_wait_as_may) {
    for (int i = 1; i <= 4; i++)
        assert_int_equal(add(i), HD_OK);
    assert_string_equal(events, "F1 F2 F3 D U T1 T2 T3");
    hd_publisher_free(publisher);
    publisher = NULL;
    expect_there("123"); /* the one that waited is gone */
}

TEST(without_durability_nothing_is_synced) {
    plan.durability = HD_FLEETING;
    hd_publisher_free(publisher);
    assert_int_equal(hd_publisher_create(&publisher, &plan, &error), HD_OK);
    assert_int_equal(add(1), HD_OK);
    assert_int_equal(settle(), HD_OK);
    assert_string_equal(events, "T1");
    expect_there("1");
}

TEST(finished_frames_are_synced_by_name) {
    write_bytes("out/1.data", "x", 1);
    assert_int_equal(add_to("out", 1, true), HD_OK);
    assert_int_equal(add(2), HD_OK);
    assert_int_equal(settle(), HD_OK);
    assert_string_equal(events, "F2 D U T1+ T2");
}

TEST(every_folder_is_synced) {
    outputs.list[0].name = "out/in/%d.data";
    mkdir("out/in", 0777);
    assert_int_equal(add_to("out/in", 1, false), HD_OK);
    assert_int_equal(settle(), HD_OK);
    assert_string_equal(events, "F1 I D U T1");
}

TEST(a_disk_that_says_no_ends_it_at_that_frame) {
    for (int i = 1; i <= 3; i++)
        assert_int_equal(add(i), HD_OK);
    fails_at = 2;
    assert_int_equal(settle(), HD_FAILED);
    expect_contains(error.message, "cannot write out/2.data to the disk: Input/output error");
    assert_string_equal(events, "F1 F2 D U T1");
    expect_there("1");
}

TEST(names_that_are_not_on_the_disk_are_not_told) {
    assert_int_equal(add(1), HD_OK);
    assert_int_equal(add(2), HD_OK);
    fails_at = 3;
    assert_int_equal(settle(), HD_FAILED);
    expect_contains(error.message, "cannot write out to the disk: Input/output error");
    assert_string_equal(events, "F1 F2 D");
}

TEST(a_name_that_is_taken_ends_it_there) {
    for (int i = 1; i <= 3; i++)
        assert_int_equal(add(i), HD_OK);
    mkdir("out/2.data", 0777);
    assert_int_not_equal(settle(), HD_OK);
    expect_contains(error.message, "out/2.data");
    assert_string_equal(events, "F1 F2 F3 D U T1");
    expect_there("12");
}

TEST(who_does_not_listen_ends_it_with_names_given) {
    for (int i = 1; i <= 3; i++)
        assert_int_equal(add(i), HD_OK);
    tell_fails_at = 2;
    assert_int_equal(settle(), HD_FAILED);
    assert_string_equal(error.message, "nobody listens");
    assert_string_equal(events, "F1 F2 F3 D U T1 T2");
    expect_there("123");
}

TEST(the_first_failure_counts) {
    for (int i = 1; i <= 3; i++)
        assert_int_equal(add(i), HD_OK);
    fails_at = 3;
    tell_fails_at = 1; /* an earlier frame */
    assert_int_equal(settle(), HD_FAILED);
    assert_string_equal(error.message, "nobody listens");
    assert_int_equal(add(4), HD_OK);
    tell_fails_at = 4;
    assert_int_equal(add(5), HD_OK);
    assert_int_equal(add(6), HD_OK);
    assert_int_equal(add(7), HD_FAILED); /* which settles those before */
    hd_publisher_free(publisher);
    publisher = NULL;
    expect_there("12456");
}

EACH(begin, end)
REPLACE(fsync, note_sync)
