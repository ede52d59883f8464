/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "system/interrupt.h"

#include <signal.h>
#include <sys/wait.h>

#include "base/limits.h"
#include "system/path.h"
#include "test_folder.h"

/* As many as all outputs of a run have in flight, except a removed one: its place stays taken. */
enum { FILES = 32 * HD_MAX_OUTPUTS - 1, GROUPS = 2 * HD_MAX_OUTPUTS };

static char *name_of(int i) {
    static char path[32];
    snprintf(path, sizeof path, "%d.tmp", i);
    return path;
}

static void add(int i) {
    write_bytes(name_of(i), "x", 1);
    hd_cleanup_add_file(name_of(i));
}

TEST(all_unforgotten_files_are_removed_once) {
    for (int i = 0; i < FILES; i++)
        add(i);
    for (int i = 1; i < FILES; i += 2) {
        hd_cleanup_forget_file(name_of(i));
        hd_cleanup_forget_file("none");
    }
    for (int i = FILES; i < FILES + FILES / 2; i++) /* which take the free places */
        add(i);
    hd_cleanup_remove();
    assert_int_equal(count_entries("."), FILES / 2);
    assert_int_equal(access("1.tmp", F_OK), 0);
    write_bytes("0.tmp", "another's", 9);
    hd_cleanup_remove();
    assert_int_equal(access("0.tmp", F_OK), 0);
}

TEST(names_that_do_not_fit_are_not_remembered) {
    char path[HD_MAX_PATH + 1];
    memset(path, '/', sizeof path);
    memcpy(path, ".", 1);
    memcpy(path + HD_MAX_PATH - 4, "long", 5);
    write_bytes("long", "x", 1);
    hd_cleanup_add_file(path);
    hd_cleanup_remove();
    assert_int_equal(access("long", F_OK), 0);
    memcpy(path + HD_MAX_PATH - 5, "long", 5);
    hd_cleanup_add_file(path);
    hd_cleanup_remove();
    assert_int_not_equal(access("long", F_OK), 0);
}

static void expect_killed(pid_t child) {
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST(groups_are_killed_unless_forgotten) {
    pid_t groups[GROUPS];
    alarm(60); /* where nothing is killed */
    for (int i = 0; i < GROUPS; i++) {
        groups[i] = fork();
        assert_true(groups[i] >= 0);
        if (groups[i] == 0)
            for (;;)
                pause();
        assert_int_equal(setpgid(groups[i], groups[i]), 0);
        hd_cleanup_add_group(groups[i]);
    }
    hd_cleanup_forget_group(groups[GROUPS - 1]);
    hd_cleanup_forget_group(groups[0]);
    hd_cleanup_remove();
    for (int i = 1; i < GROUPS - 1; i++)
        expect_killed(groups[i]);
    for (int i = 0; i < GROUPS; i += GROUPS - 1) {
        assert_int_equal(waitpid(groups[i], NULL, WNOHANG), 0);
        assert_int_equal(kill(groups[i], SIGKILL), 0);
        expect_killed(groups[i]);
    }
    alarm(0);
}
