/* SPDX-License-Identifier: MIT */
/* Other processes' changes to temporary files just before they are locked. */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>

#include "system/atomic_file.h"
#include "test_folder.h"
#include "wrapped.h"

static HdError error;
static const char *comes_between; /* moved to `to`, or if that is NULL removed */
static const char *to;

static int lock_late(int descriptor, int operation) {
    if (comes_between != NULL)
        assert_int_equal(to != NULL ? rename(comes_between, to) : unlink(comes_between), 0);
    comes_between = NULL;
    return real_flock(descriptor, operation);
}

/* Another run mistook it for a stale one before it was locked. */
TEST(a_file_removed_before_its_lock_is_not_written_to) {
    HdAtomicFile file;
    char first[64];
    snprintf(first, sizeof first, "0.png.tmp-%ld-0", (long)getpid());
    comes_between = first;
    to = NULL;
    assert_int_equal(hd_atomic_file_open(&file, "0.png", &error), HD_OK);
    assert_null(comes_between);
    assert_string_not_equal(file.temporary, first);
    assert_int_equal(hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, &error), HD_OK);
    assert_int_equal(access("0.png", F_OK), 0);
}

/* Another run removed the stale one and gave its name to a file of its own. */
TEST(a_file_that_took_a_stale_files_name_stays) {
    write_bytes("1.png.tmp-1-0", "stale", 5);
    write_bytes("other", "fresh", 5);
    comes_between = "other";
    to = "1.png.tmp-1-0";
    hd_temporary_remove_stale("1.png.tmp-1-0");
    assert_null(comes_between);
    assert_int_equal(access("1.png.tmp-1-0", F_OK), 0);
    hd_temporary_remove_stale("1.png.tmp-1-0");
    assert_int_equal(access("1.png.tmp-1-0", F_OK), -1);
}

/* Removes a file of the process whose lock is held. */
static void remove_locked(pid_t owner, bool is_done) {
    char path[64];
    snprintf(path, sizeof path, "2.mkv.tmp-%ld-0", (long)owner);
    write_bytes(path, "stale", 5);
    const int holder = open(path, O_RDONLY);
    assert_int_equal(flock(holder, LOCK_EX), 0);
    assert_true(hd_temporary_remove_stale(path) == is_done);
    assert_int_equal(access(path, F_OK), 0);
    close(holder);
    assert_true(hd_temporary_remove_stale(path));
    assert_int_equal(access(path, F_OK), -1);
}

/* Its child still writes. */
TEST(a_file_of_an_ended_process_is_tried_again) {
    const pid_t gone = fork();
    if (gone == 0)
        _exit(0);
    assert_int_equal(waitpid(gone, NULL, 0), gone);
    remove_locked(gone, false);
    remove_locked(getpid(), true);
}

/* The file with the final name at the file's and at its folder's sync; and the file's size. */
static bool was_there[2];
static off_t synced_size;
static int syncs;

static int note_sync(int descriptor) {
    struct stat found;
    was_there[syncs % 2] = access("lasting", F_OK) == 0;
    if (syncs++ == 0 && fstat(descriptor, &found) == 0)
        synced_size = found.st_size;
    return real_fsync(descriptor);
}
REPLACE(fsync, note_sync)

/* Another program may replace a file made for it. */
TEST(a_reserved_file_keeps_the_name_of_its_replacement) {
    HdAtomicFile file;
    struct stat found;
    assert_int_equal(hd_atomic_file_reserve(&file, "3.mkv", &error), HD_OK);
    assert_true(file.stream == NULL && file.lock >= 0);
    syncs = 0;
    write_bytes("theirs", "film", 4);
    assert_int_equal(rename("theirs", file.temporary), 0);
    assert_int_equal(hd_atomic_file_commit(&file, HD_DURABLE, &error), HD_OK);
    assert_true(stat("3.mkv", &found) == 0 && found.st_size == 4 && synced_size == 4);
    assert_int_equal(file.lock, -1);
}

static void open_for(HdAtomicFile *file, const char *path) {
    assert_int_equal(hd_atomic_file_open(file, path, &error), HD_OK);
    fputs("new", file->stream);
}

static void expect_failure(HdAtomicFile *file, const char *message) {
    assert_int_equal(hd_atomic_file_commit(file, HD_DURABLE, &error), HD_FAILED);
    expect_contains(error.message, message);
    hd_atomic_file_discard(file);
}

/* The bytes are on the disk before the name is. */
TEST(only_lasting_files_are_synced) {
    HdAtomicFile file;
    syncs = 0;
    assert_int_equal(hd_atomic_file_open(&file, "unsynced", &error), HD_OK);
    assert_int_equal(hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, &error), HD_OK);
    assert_int_equal(syncs, 0);
    assert_int_equal(hd_atomic_file_open(&file, "lasting", &error), HD_OK);
    assert_int_equal(hd_atomic_file_commit(&file, HD_DURABLE, &error), HD_OK);
    assert_int_equal(syncs, 2);
    assert_true(!was_there[0] && was_there[1]);
}

TEST(a_write_that_failed_leaves_the_old_file) {
    HdAtomicFile file;
    struct stat found;
    assert_int_equal(mkdir("old", 0777), 0);
    write_bytes("old/file", "old!", 4);
    open_for(&file, "old/file");
    close(fileno(file.stream));
    expect_failure(&file, "cannot write old/file: Bad file descriptor");
    open_for(&file, "old/file");
    assert_int_equal(fgetc(file.stream), EOF); /* an error whose cause no write reports */
    errno = 0;
    expect_failure(&file, "cannot write old/file: Input/output error");
    assert_int_equal(stat("old/file", &found), 0);
    assert_int_equal(found.st_size, 4);
    assert_int_equal(count_entries("old"), 1);
}

TEST(a_vanished_file_is_named) {
    HdAtomicFile file;
    char message[HD_MAX_PATH + 64];
    open_for(&file, "going/file");
    assert_int_equal(unlink(file.temporary), 0);
    assert_int_equal(hd_atomic_file_check(&file, &error), HD_FAILED);
    snprintf(message, sizeof message, "cannot write going/file: somebody removed %s",
             file.temporary);
    assert_string_equal(error.message, message);
    assert_int_equal(rmdir("going"), 0);
    expect_failure(&file, "cannot write going/file: its folder going/ was removed");
    assert_int_equal(hd_atomic_file_open(&file, "going/other", &error), HD_FAILED);
    expect_contains(error.message, "its folder going/ was removed");
}

TEST(names_that_do_not_fit_are_refused) {
    HdAtomicFile file;
    char name[300];
    memset(name, 'n', sizeof name);
    name[256] = '\0';
    assert_int_equal(hd_atomic_file_open(&file, name, &error), HD_BAD_INPUT);
    expect_contains(error.message, "has 256 bytes, expected at most 255");
    name[255] = '\0';
    open_for(&file, name);
    assert_int_equal(hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, &error), HD_OK);
    static char longest[HD_MAX_PATH + 1];
    memset(longest, 'n', HD_MAX_PATH);
    static const char *const no_files[] = {"folder/", "", ".", longest};
    for (int i = 0; i < 4; i++)
        assert_int_equal(hd_atomic_file_open(&file, no_files[i], &error), HD_BAD_INPUT);
}

REPLACE(flock, lock_late)
