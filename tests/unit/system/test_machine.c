/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* processors */
#include "system/machine.h"

#include <fcntl.h>
#include <sched.h>

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include "system/processor.h"
#include "test_folder.h"

TEST(a_desktop_or_a_connected_screen_is_detected) {
    static const char *const variables[] = {"DISPLAY", "WAYLAND_DISPLAY"};
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    for (int i = 0; i < 2; i++) {
        setenv(variables[i], "", 1);
        assert_false(hd_display_may_be_there("."));
        setenv(variables[i], "0", 1);
        assert_true(hd_display_may_be_there("."));
        unsetenv(variables[i]);
    }
    assert_true(mkdir("card0-HDMI-A-1", 0700) == 0 && mkdir("card0-DP-1", 0700) == 0);
    write_bytes("card0-HDMI-A-1/status", "disconnected\n", 13);
    assert_false(hd_display_may_be_there("."));
    write_bytes("card0-DP-1/status", "connected\n", 10);
    assert_true(hd_display_may_be_there("."));
    assert_false(hd_display_may_be_there("/no/such/folder"));
}

TEST(only_allowed_processors_count) {
    cpu_set_t all, one;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    assert_int_equal(hd_processor_count(), CPU_COUNT(&all));
    CPU_ZERO(&one);
    CPU_SET((size_t)sched_getcpu(), &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    assert_int_equal(hd_processor_count(), 1);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
}

#define CORE(implementer, part) "CPU implementer\t: " implementer "\nCPU part\t: " part "\n"

TEST(processors_are_named_by_model_or_by_arms_parts) {
    static const char *const cases[][3] = {
        /* /proc/cpuinfo, the device tree's model, the name */
        {"processor\t: 0\nmodel name\t: AMD EPYC\n\nmodel name\t: no\n", "", "AMD EPYC"},
        {CORE("0x41", "0xd05") CORE("0x41", "0xd05") CORE("0x41", "0xd0b"), "ROCK 5B",
         "Cortex-A55, Cortex-A76 (ROCK 5B)"},
        {CORE("0x61", "0x022") CORE("0x61", "0x023"), "", "Apple M1"},
        {"model name\t: ARMv7 Processor rev 4 (v7l)\n" CORE("0x41", "0xc07"), "", "Cortex-A7"},
        {CORE("0x99", "0xfff"), "", "ARM core 0x99-0xfff"},
        {"model name\t:\n", "A board", "A board"},
        {"", "", "processor"}};
    char name[64];
    assert_true(mkdir("proc", 0700) == 0 && mkdir("proc/device-tree", 0700) == 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_bytes("proc/cpuinfo", cases[i][0], strlen(cases[i][0]));
        write_bytes("proc/device-tree/model", cases[i][1], strlen(cases[i][1]) + 1);
        hd_processor_name(".", name, sizeof name);
        assert_string_equal(name, cases[i][2]);
    }
}

TEST(big_and_little_cores_are_counted) {
    const int all = hd_processor_count(), first = sched_getcpu();
    char path[80];
    assert_int_equal(hd_processor_cores(".").big, all);
    assert_int_equal(system("for cpu in /sys/devices/system/cpu/cpu[0-9]*; do mkdir -p .$cpu; "
                            "echo 512 >.$cpu/cpu_capacity; done"),
                     0);
    snprintf(path, sizeof path, "sys/devices/system/cpu/cpu%d/cpu_capacity", first);
    write_bytes(path, "1024\n", 5);
    const HdCores found = hd_processor_cores(".");
    assert_int_equal(found.big, 1);
    assert_int_equal(found.little, all - 1);
}

TEST(memory_is_the_systems) {
    struct sysinfo found;
    assert_int_equal(sysinfo(&found), 0);
    const double bytes = (double)found.totalram * (double)found.mem_unit;
    expect_near(hd_physical_memory(), bytes, 0.1 * bytes);
}

TEST(free_descriptors_are_counted) {
    struct rlimit before, limit;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    limit = before;
    const int lowest = open("/dev/null", O_RDONLY);
    limit.rlim_cur = (rlim_t)lowest + 3;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    for (int i = 0; i < 2; i++)
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
