/* SPDX-License-Identifier: MIT */
/* Temporary files of killed runs are removed, and all others stay. */
#define _XOPEN_SOURCE   700
#define _DEFAULT_SOURCE /* flock */

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <time.h>

#include "output/resume.h"
#include "system/atomic_file.h"
#include "test_folder.h"

static HdError error;
static int numbers[] = {0, 1, 12};
static const HdFrameList frames = {.frames = numbers, .count = 3};

static void remove_stale(const char *first, const char *second) {
    const HdOutputStyle style = {.picture = {.bits = 8}};
    const char *const names[] = {first, second};
    HdOutputPlan plan;
    assert_int_equal(hd_outputs_settle(&plan, names, 2, &style, frames.count, &error), HD_OK);
    hd_stale_files_remove(&plan, &frames);
}

static void expect_there(const char *path, bool expected) {
    if ((access(path, F_OK) == 0) != expected)
        fail_msg("%s is %s", path, expected ? "gone" : "still there");
}

TEST(files_of_the_run_are_removed) {
    static const char *const names[] = {
        /* these are removed */
        "a/0001.png.tmp-4000000-0", "a/0012.png.tmp-1-17", "film.mp4.tmp-99-3",
        "film.mp4.part-0-a.tmp-999999999-1",
        /* another frame's, and a file of no frame */
        "a/0002.png.tmp-4000000-0", "a/0001.png", "a/0001.png.tmp-1", "a/0001.png.tmp-1-",
        "a/0001.png.tmp-x-0", "a/0001.png.tmp-1-0x", "a/0001.png.tmp- 1-0", "a/0001.png.tmp-1--1",
        "a/00001.png.tmp-1-0", "a/0001.pngs.tmp-1-0", "film.mp4", "other.mp4.tmp-1-0",
        "film.mp4.part-0-a", "other.mp4.part-0-a.tmp-1-0"};
    const int count = sizeof names / sizeof *names;
    assert_int_equal(mkdir("a", 0777), 0);
    for (int i = 0; i < count; i++)
        write_bytes(names[i], "", 0);
    remove_stale("a/%04d.png", "film.mp4");
    for (int i = 0; i < count; i++)
        expect_there(names[i], i >= 4);
}

/* A file of a killed process of this number, or of another machine. */
TEST(an_existing_file_is_left_alone) {
    char taken[64];
    HdAtomicFile file;
    assert_int_equal(mkdir("e", 0777), 0);
    snprintf(taken, sizeof taken, "e/0.png.tmp-%ld-0", (long)getpid());
    write_bytes(taken, "theirs", 6);
    assert_int_equal(hd_atomic_file_open(&file, "e/0.png", &error), HD_OK);
    assert_string_not_equal(file.temporary, taken);
    assert_int_equal(hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, &error), HD_OK);
    struct stat found;
    assert_int_equal(stat(taken, &found), 0);
    assert_int_equal(found.st_size, 6);
    assert_int_equal(count_entries("e"), 2);
}

TEST(numbered_folders_are_searched_and_kept) {
    assert_int_equal(mkdir("d", 0777), 0);
    assert_int_equal(mkdir("d/0.png.tmp-1-0", 0777), 0);
    assert_int_equal(symlink("../a", "d/1.png.tmp-1-0"), 0);
    remove_stale("d/%d.png", "film.mkv");
    assert_int_equal(count_entries("d"), 2);
    assert_true(mkdir("take 1", 0777) == 0 && mkdir("take 2", 0777) == 0);
    write_bytes("take 1/x.png.tmp-5-0", "", 0);
    write_bytes("take 2/x.png.tmp-5-0", "", 0);
    remove_stale("take %d/x.png", "none/film.mkv");
    expect_there("take 1/x.png.tmp-5-0", false);
    expect_there("take 2/x.png.tmp-5-0", true);
    expect_there("none", false);
}

/* A child of a killed run still has the lock for a while. */
TEST(orphans_are_waited_for) {
    const struct timespec while_it_ends = {.tv_nsec = 100000000};
    char path[64];
    const pid_t gone = fork();
    if (gone == 0)
        _exit(0);
    assert_int_equal(waitpid(gone, NULL, 0), gone);
    snprintf(path, sizeof path, "film.mp4.tmp-%ld-0", (long)gone);
    write_bytes(path, "", 0);
    const int lock = open(path, O_RDONLY);
    assert_int_equal(flock(lock, LOCK_EX), 0);
    const pid_t orphan = fork();
    if (orphan == 0) {
        nanosleep(&while_it_ends, NULL);
        _exit(0);
    }
    close(lock);
    remove_stale("film.mp4", "a/%d.png");
    expect_there(path, false);
    assert_int_equal(waitpid(orphan, NULL, 0), orphan);
}
