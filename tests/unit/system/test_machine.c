/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* processors */
#include "system/machine.h"

#include <fcntl.h>
#include <sched.h>
#include <time.h>

#include <sys/resource.h>

#include "test_folder.h"

static int begin(void **state) {
    (void)state;
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    return mkdir("card0-HDMI-A-1", 0700) != 0 || mkdir("card0-DP-1", 0700) != 0;
}

static int end(void **state) {
    (void)state;
    return remove_folder("card0-HDMI-A-1") != 0 || remove_folder("card0-DP-1") != 0;
}

TEST(a_desktop_or_what_is_plugged_in_is_seen) {
    static const char *const variables[] = {"DISPLAY", "WAYLAND_DISPLAY"};
    for (int i = 0; i < 2; i++) {
        setenv(variables[i], "", 1);
        assert_false(hd_display_may_be_there("."));
        setenv(variables[i], "0", 1);
        assert_true(hd_display_may_be_there("."));
        unsetenv(variables[i]);
    }
    write_bytes("card0-HDMI-A-1/status", "disconnected\n", 13);
    assert_false(hd_display_may_be_there("."));
    write_bytes("card0-DP-1/status", "connected\n", 10);
    assert_true(hd_display_may_be_there("."));
    assert_false(hd_display_may_be_there("/no/such/folder"));
}

TEST(processors_are_those_it_may_run_on) {
    cpu_set_t all, first;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    assert_int_equal(hd_processor_count(), CPU_COUNT(&all));
    CPU_ZERO(&first);
    for (size_t i = 0; CPU_COUNT(&first) == 0; i++)
        if (CPU_ISSET(i, &all))
            CPU_SET(i, &first);
    assert_int_equal(sched_setaffinity(0, sizeof first, &first), 0);
    assert_int_equal(hd_processor_count(), 1);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
}

TEST(memory_and_time_are_the_systems) {
    double kib = 0.0;
    char line[100];
    struct timespec now;
    FILE *file = fopen("/proc/meminfo", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    fclose(file);
    assert_int_equal(sscanf(line, "MemTotal: %lf", &kib), 1);
    expect_near(hd_physical_memory(), 1024.0 * kib, 0.1 * 1024.0 * kib);
    clock_gettime(CLOCK_MONOTONIC, &now);
    const double told = hd_monotonic_seconds();
    const double before = (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
    clock_gettime(CLOCK_MONOTONIC, &now);
    assert_true(before <= told);
    assert_true(told <= (double)now.tv_sec + 1e-9 * (double)now.tv_nsec);
}

TEST(free_descriptors_are_counted) {
    struct rlimit before, limit;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    limit = before;
    const int lowest = open("/dev/null", O_RDONLY);
    limit.rlim_cur = (rlim_t)lowest + 3;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    assert_int_equal(hd_free_descriptors(), 2);
    assert_int_equal(hd_free_descriptors(), 2);
    limit.rlim_cur = (rlim_t)lowest + 1;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    assert_int_equal(hd_free_descriptors(), 0);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
    close(lowest);
}

TEST(memory_is_aligned) {
    static const size_t sizes[] = {0, 1, 64, 65, (2 << 20) - 1, 2 << 20, (2 << 20) + 1};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned char *memory = hd_large_allocate(sizes[i]);
        assert_non_null(memory);
        assert_int_equal((uintptr_t)memory % (sizes[i] < 2 << 20 ? 64 : 2 << 20), 0);
        memset(memory, 1, sizes[i]);
        free(memory);
    }
    assert_null(hd_large_allocate(SIZE_MAX));
    assert_null(hd_large_allocate(SIZE_MAX - (2 << 20) + 1));
}

EACH(begin, end)
