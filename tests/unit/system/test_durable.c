/* SPDX-License-Identifier: MIT */
/* Synced files, and the effects of a failing disk. */
#define _GNU_SOURCE

#include "system/atomic_file.h"

#include <errno.h>
#include <fcntl.h>

#include "test_folder.h"
#include "wrapped.h"

static HdError error;
static int answers[4]; /* results of the next syncs, as errno has them; 0: done */
static int calls;
static char synced_names[1000]; /* synced folders below the test's, each with a space behind it */

static void report_name(int descriptor) {
    char link[64], name[500];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, name, sizeof name - 1);
    assert_true(length > 0);
    name[length] = '\0';
    const size_t top = strlen(test_folder);
    const char *rest = strncmp(name, test_folder, top) == 0 ? name + top : name;
    strcat(strcat(synced_names, *rest == '\0' ? "." : rest), " ");
}

static int answer_sync(int descriptor) {
    report_name(descriptor);
    errno = calls < 4 ? answers[calls] : 0;
    calls++;
    return errno == 0 ? 0 : -1;
}

static int begin(void **state) {
    (void)state;
    memset(answers, 0, sizeof answers);
    synced_names[0] = '\0';
    calls = 0;
    hd_known_folders_forget();
    mkdir("a", 0777);
    mkdir("a/b", 0777);
    mkdir("a/c", 0777);
    return 0;
}

static void expect_synced(const char *path, const char *names) {
    synced_names[0] = '\0';
    assert_int_equal(hd_sync_folder(path, &error), HD_OK);
    assert_string_equal(synced_names, names);
}

TEST(folders_are_synced_up_to_a_synced_one) {
    expect_synced("a/b/1.png", "/a/b /a . ");
    expect_synced("a/b/2.png", "/a/b ");
    expect_synced("a/c/1.png", "/a/c /a ");
    expect_synced("1.png", ". ");
    expect_synced("a//b//1.png", "/a/b /a . ");
    hd_known_folders_forget();
    expect_synced("a/b/1.png", "/a/b /a . ");
    expect_synced("/1.png", "/ ");
    expect_synced("//tmp/1.png", "/tmp / ");
}

/* A target without a disk needs none. */
TEST(a_sync_that_a_signal_ends_is_begun_again) {
    static const int reasons[] = {EINTR, EINVAL, ENOTSUP, ENOSYS, EROFS};
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++) {
        calls = 0;
        answers[0] = answers[1] = reasons[i];
        assert_int_equal(hd_sync_file(STDIN_FILENO, "x", &error), HD_OK);
        assert_int_equal(calls, reasons[i] == EINTR ? 3 : 1);
    }
}

TEST(a_failing_disk_is_reported) {
    answers[0] = EDQUOT;
    answers[2] = EIO;
    assert_int_equal(hd_sync_file(STDIN_FILENO, "a/1.png", &error), HD_FAILED);
    assert_string_equal(error.message, "cannot write a/1.png to the disk: Disk quota exceeded");
    assert_int_equal(hd_sync_folder("a/b/1.png", &error), HD_FAILED);
    assert_string_equal(error.message, "cannot write a to the disk: Input/output error");
    expect_synced("a/b/2.png", "/a/b "); /* which was */
    expect_synced("a/1.png", "/a . ");   /* which was not */
    assert_int_equal(hd_sync_folder("a/none/1.png", &error), HD_FAILED);
    assert_string_equal(error.message,
                        "cannot write a/none to the disk: No such file or directory");
}

TEST(a_folder_that_may_not_be_read_is_left_out) {
    const uid_t user = geteuid();
    assert_int_equal(chmod("a/b", 0300), 0);
    if (user == 0)
        assert_int_equal(seteuid(65534), 0);
    const HdStatus status = hd_sync_folder("a/b/1.png", &error);
    assert_int_equal(seteuid(user), 0);
    assert_int_equal(status, HD_OK);
    assert_null(strstr(synced_names, "/b"));
    assert_int_equal(chmod("a/b", 0700), 0);
}

EACH(begin, NULL)
REPLACE(fsync, answer_sync)
