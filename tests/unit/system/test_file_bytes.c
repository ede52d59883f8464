/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <signal.h>
#include <sys/time.h>

#include "system/path.h"
#include "test_folder.h"

static HdError error;
static int ends[2];

static void feed(int unused) {
    (void)unused;
    if (write(ends[1], "late", 4) != 4)
        _exit(3);
}

/* The signal comes while there is nothing to read yet, and ends the call. */
TEST(a_signal_does_not_end_a_read) {
    const struct sigaction action = {.sa_handler = feed};
    const struct itimerval soon = {.it_value.tv_usec = 20000};
    char bytes[4] = "";
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
    assert_int_equal(setitimer(ITIMER_REAL, &soon, NULL), 0);
    assert_int_equal(hd_read_fully(ends[0], bytes, sizeof bytes), 4);
    assert_memory_equal(bytes, "late", 4);
    close(ends[1]);
    assert_int_equal(hd_read_fully(ends[0], bytes, sizeof bytes), 0);
    close(ends[0]);
    assert_int_equal(hd_read_fully(ends[0], bytes, sizeof bytes), -1);
}

static void expect_refused(const char *path, int64_t most, const char *reason) {
    unsigned char *bytes = (unsigned char *)"";
    size_t size;
    assert_int_equal(hd_file_read(path, "scene", most, &bytes, &size, &error), HD_BAD_INPUT);
    assert_null(bytes);
    expect_contains(error.message, reason);
}

TEST(files_are_read_up_to_a_size) {
    unsigned char *bytes;
    size_t size;
    const int open_before = count_entries("/proc/self/fd");
    write_bytes("five", "a\0bcd", 5);
    write_bytes("six", "abcdef", 6);
    assert_int_equal(mkfifo("pipe", 0600), 0);
    write_bytes("empty", "", 0);
    for (int i = 0; i < 2; i++) {
        const char *path = i == 0 ? "empty" : "five";
        assert_int_equal(hd_file_read(path, "scene", 5, &bytes, &size, &error), HD_OK);
        assert_int_equal(size, 5 * i);
        assert_memory_equal(bytes, "a\0bcd", size);
        free(bytes);
    }
    expect_refused("six", 5, "cannot read the scene six: it has 6 bytes, expected at most 5");
    expect_refused("none", 5, "cannot read the scene none: No such file");
    expect_refused("pipe", 5, "cannot read the scene pipe: it is not a regular file");
    /* Like files of the system's own state: more bytes than reported. */
    assert_int_equal(access("/sys/kernel/uevent_seqnum", R_OK), 0);
    expect_refused("/sys/kernel/uevent_seqnum", 1 << 20, " of 4096 bytes");
    expect_contains(error.message, "it ended after ");
    assert_int_equal(count_entries("/proc/self/fd"), open_before);
}
