/* SPDX-License-Identifier: MIT */
/* What another process may do to temporary files just before they are locked. */
#define _GNU_SOURCE

#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include "system/atomic_file.h"
#include "test_folder.h"

static HdError error;
static const char *comes_between; /* is moved to `to`, or where that is NULL removed */
static const char *to;
static int glances, holder = -1; /* the lock's, closed after so many */

/* In place of the C library's. */
int flock(int descriptor, int operation) {
    if (glances > 0 && --glances == 0)
        close(holder);
    if (comes_between != NULL)
        assert_int_equal(to != NULL ? rename(comes_between, to) : unlink(comes_between), 0);
    comes_between = NULL;
    return (int)syscall(SYS_flock, descriptor, operation);
}

/* Another run took it for a stale one before it was locked. */
static void one_that_was_removed_before_its_lock_is_not_written_to(void **state) {
    (void)state;
    HdAtomicFile file;
    char first[64];
    snprintf(first, sizeof first, "0.png.tmp-%ld-0", (long)getpid());
    comes_between = first;
    to = NULL;
    assert_int_equal(hd_atomic_file_open(&file, "0.png", &error), HD_OK);
    assert_null(comes_between);
    assert_string_not_equal(file.temporary, first);
    assert_int_equal(hd_atomic_file_commit(&file, HD_FLEETING, &error), HD_OK);
    assert_int_equal(access("0.png", F_OK), 0);
}

/* Another run removed the stale one and gave its name to a file of its own. */
static void one_that_took_the_name_of_a_stale_one_stays(void **state) {
    (void)state;
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

static void make_locked(const char *path) {
    write_bytes(path, "stale", 5);
    holder = open(path, O_RDONLY);
    assert_int_equal(flock(holder, LOCK_EX), 0);
}

/* What it had started still writes. */
static void that_of_a_process_that_is_gone_is_waited_for(void **state) {
    (void)state;
    char path[64];
    const pid_t gone = fork();
    if (gone == 0)
        _exit(0);
    assert_int_equal(waitpid(gone, NULL, 0), gone);
    snprintf(path, sizeof path, "2.mkv.tmp-%ld-0", (long)gone);
    make_locked(path);
    glances = 3;
    hd_temporary_remove_stale(path);
    assert_int_equal(glances, 0);
    assert_int_equal(access(path, F_OK), -1);
}

static void that_of_a_living_process_is_not(void **state) {
    (void)state;
    char path[64];
    snprintf(path, sizeof path, "3.mkv.tmp-%ld-0", (long)getpid());
    make_locked(path);
    glances = 2;
    hd_temporary_remove_stale(path);
    assert_int_equal(glances, 1);
    assert_int_equal(access(path, F_OK), 0);
    close(holder);
    glances = 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_that_was_removed_before_its_lock_is_not_written_to),
        cmocka_unit_test(one_that_took_the_name_of_a_stale_one_stays),
        cmocka_unit_test(that_of_a_process_that_is_gone_is_waited_for),
        cmocka_unit_test(that_of_a_living_process_is_not),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
