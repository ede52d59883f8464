/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include "expect.h"
#include "system/file_bytes.h"

static int ends[2];

static void feed(int unused) {
    (void)unused;
    if (write(ends[1], "late", 4) != 4)
        _exit(3);
}

/* The signal comes while there is nothing to read yet, and ends the call. */
static void a_signal_does_not_end_a_read(void **state) {
    (void)state;
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_signal_does_not_end_a_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
