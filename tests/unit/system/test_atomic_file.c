/* SPDX-License-Identifier: MIT */
/* What another process may do to temporary files just before they are locked. */
#define _GNU_SOURCE

#include <sys/file.h>
#include <sys/syscall.h>

#include "system/atomic_file.h"
#include "test_folder.h"

static HdError error;
static const char *comes_between; /* is moved to `to`, or where that is NULL removed */
static const char *to;

/* In place of the C library's. */
int flock(int descriptor, int operation) {
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_that_was_removed_before_its_lock_is_not_written_to),
        cmocka_unit_test(one_that_took_the_name_of_a_stale_one_stays),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
