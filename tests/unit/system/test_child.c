/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "system/child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>

#include "test_folder.h"

static HdError error;
static HdChild child;
static char how[64];

static int begin(void **state) {
    (void)state;
    error = (HdError){0};
    return 0;
}

static HdStatus start(const char *script, int lock) {
    const char *const arguments[] = {"/bin/sh", "-c", script, NULL};
    return hd_child_start(&child, arguments, true, lock, &error);
}

static void run(const char *script) {
    assert_int_equal(start(script, -1), HD_OK);
    assert_true(child.pid > 0 && child.input >= 0 && child.output >= 0);
}

static void expect_none(void) {
    assert_int_equal(child.pid, 0);
    assert_int_equal(child.input, -1);
    assert_int_equal(child.output, -1);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static void expect_end(bool is_good, const char *words) {
    assert_true(hd_child_end(&child, 60000, how) == is_good);
    assert_string_equal(how, words);
    expect_none();
}

/* Signals that were ignored, such as by nohup, stay ignored; our own handling of lost readers does
   not. */
TEST(the_end_and_the_output_are_reported) {
    static const struct {
        const char *script, *how, *said;
    } cases[] = {
        {"exit 3", "exit code 3", "(nothing)"},
        {"kill -9 $$", "signal 9", "(nothing)"},
        /* It closes its output before it ends. */
        {"exec >&- 2>&-; sleep 0.1; exit 4", "exit code 4", "(nothing)"},
        {"printf ' a\\nb \\r\\n\\n'", "exit code 0", " a\nb"},
        {"printf '\\n \\n'", "exit code 0", "(nothing)"},
        {"kill -HUP $$; echo here; kill -PIPE $$; echo there", "signal 13", "here"},
    };
    signal(SIGPIPE, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        run(cases[i].script);
        expect_end(strcmp(cases[i].how, "exit code 0") == 0, cases[i].how);
        assert_string_equal(hd_child_tail(&child), cases[i].said);
    }
    signal(SIGPIPE, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
}

TEST(sent_bytes_are_echoed) {
    enum { SIZE = 3 << 20 };
    uint8_t *bytes = malloc(SIZE);
    assert_non_null(bytes);
    for (size_t i = 0; i < SIZE; i++)
        bytes[i] = (uint8_t)('a' + i % 26);
    run("tee copy; echo ' end' >&2; echo; echo ' '"); /* it writes as much as it reads */
    assert_true(hd_child_send(&child, bytes, SIZE, 60000));
    expect_end(true, "exit code 0");
    assert_int_equal(child.tail_length, HD_CHILD_MAX_TAIL);
    assert_int_equal(strlen(hd_child_tail(&child)), HD_CHILD_MAX_TAIL - 4);
    expect_contains(hd_child_tail(&child) + HD_CHILD_MAX_TAIL - 8, " end");
    struct stat found;
    assert_int_equal(stat("copy", &found), 0);
    assert_int_equal(found.st_size, SIZE);
    run("exec <&-; echo gone"); /* it does not read */
    assert_false(hd_child_send(&child, bytes, SIZE, 60000));
    expect_end(true, "exit code 0");
    assert_string_equal(hd_child_tail(&child), "gone");
    free(bytes);
}

/* The check comes every 0.2 s. */
TEST(a_hanging_program_is_killed) {
    static const uint8_t bytes[1 << 20];
    run("sleep 1000");
    assert_false(hd_child_end(&child, 300, how));
    assert_string_equal(how, "signal 9");
    assert_true(child.is_stuck);
    run("sleep 1000");
    assert_false(hd_child_send(&child, bytes, sizeof bytes, 1000));
    assert_true(child.is_stuck);
    hd_child_stop(&child);
    expect_none();
}

/* It reads, then it writes: each for longer than the timeout, but with shorter pauses. */
TEST(a_working_program_is_waited_for) {
    static const uint8_t bytes[12 << 17];
    run("for i in 1 2 3 4 5 6; do sleep 0.22; head -c 262144 >/dev/null; done; "
        "for i in 1 2 3 4 5 6; do sleep 0.22; echo; done");
    assert_true(hd_child_send(&child, bytes, sizeof bytes, 1000));
    assert_true(hd_child_end(&child, 1000, how));
    assert_false(child.is_stuck);
}

TEST(a_lock_and_three_streams_are_all_it_has) {
    const int lock = open("lock", O_RDWR | O_CREAT, 0600), other = dup(lock);
    assert_true(lock > 2 && other > 2);
    assert_int_equal(fcntl(lock, F_SETFD, FD_CLOEXEC), 0);
    assert_int_equal(fcntl(other, F_SETFD, FD_CLOEXEC), 0);
    assert_int_equal(start("readlink /proc/$$/fd/* | grep -c lock; readlink /proc/$$/fd/[012] | "
                           "grep -c socket",
                           lock),
                     HD_OK);
    expect_end(true, "exit code 0");
    assert_string_equal(hd_child_tail(&child), "1\n3");
    const char *const arguments[] = {"/bin/sh", "-c", "readlink /proc/$$/fd/0", NULL};
    assert_int_equal(hd_child_start(&child, arguments, false, -1, &error), HD_OK);
    assert_int_equal(child.input, -1);
    expect_end(true, "exit code 0");
    assert_string_equal(hd_child_tail(&child), "/dev/null");
    close(lock);
    close(other);
}

TEST(the_whole_group_is_stopped) {
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(start("sleep 1000 & sleep 1000", ends[1]), HD_OK);
    close(ends[1]);
    hd_child_stop(&child);
    assert_int_equal(read(ends[0], &byte, 1), 0); /* nobody has the other end */
    close(ends[0]);
    hd_child_stop(&child);
}

static void expect_no_start(const char *path, HdStatus status, const char *reason) {
    const char *const arguments[] = {path, NULL};
    assert_int_equal(hd_child_start(&child, arguments, true, -1, &error), status);
    expect_contains(error.message, reason);
    expect_none();
}

TEST(a_failed_start_is_reported) {
    write_bytes("text", "no program", 10);
    expect_no_start("./none", HD_UNAVAILABLE, "cannot start ./none: No such file");
    expect_no_start("./text", HD_UNAVAILABLE, "cannot start ./text: Permission denied");
    assert_int_equal(chmod("text", 0700), 0);
    expect_no_start("./text", HD_UNAVAILABLE, "Exec format error");
    assert_int_equal(symlink("loop", "loop"), 0);
    expect_no_start("./loop", HD_FAILED, "Too many levels");
}

TEST(programs_are_found_in_order) {
    static const char *const cases[][2] = {{"x:y:z:", "z/tool"}, {"x::z", "./tool"}, {"x:y", NULL}};
    char path[HD_MAX_PATH], old[HD_MAX_PATH];
    snprintf(old, sizeof old, "%s", getenv("PATH"));
    assert_true(mkdir("x", 0700) == 0 && mkdir("y", 0700) == 0 && mkdir("z", 0700) == 0);
    assert_true(mkdir("x/tool", 0700) == 0);
    write_bytes("y/tool", "", 0);
    write_bytes("z/tool", "", 0);
    write_bytes("tool", "", 0);
    assert_true(chmod("z/tool", 0700) == 0 && chmod("tool", 0700) == 0);
    for (int i = 0; i < 3; i++) {
        setenv("PATH", cases[i][0], 1);
        if (hd_child_find("tool", path, &error) == HD_OK)
            assert_string_equal(path, cases[i][1]);
        else
            assert_null(cases[i][1]);
    }
    expect_contains(error.message, "found no program \"tool\" in PATH");
    unsetenv("PATH");
    assert_int_equal(hd_child_find("sh", path, &error), HD_OK);
    assert_int_equal(access(path, X_OK), 0);
    setenv("PATH", old, 1);
}

EACH(begin, NULL)
