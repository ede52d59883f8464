/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include <stdio.h>

#include <jansson.h>

#include "cli/statistics.h"
#include "input/json.h"
#include "render/backends.h"
#include "test_folder.h"

static const HdScene scene = {.samples_per_side = 3, .depth = 8};
static const HdFrame frame = {
    .width = 640,
    .height = 480,
    .primary_rays = 2764800,
    .mirrored_rays = 5,
    .transmitted_rays = 6,
    .shadow_tests = UINT64_C(1) << 60,
    .clamps = 7,
};
static HdStoredFrame stored = {
    .number = 11,
    .done = 1,
    .frame = &frame,
    .times = {.prepare = {0.0, 0.5},
              .trace = {0.5, 1.25},
              .copy = {1.75, 0.0},
              .convert = {2.0, 1e-9},
              .store = {2.5, 3.0},
              .film = {-1.0, 0.0},
              .longest_launch = 0.0625},
};

static HdStatus open_statistics(HdStatistics *statistics, const char *path, HdError *error) {
    const HdOutputPlan none = {.count = 0};
    assert_int_equal(hd_statistics_settle(statistics, path, NULL, &none, 0, error), HD_OK);
    return hd_statistics_open(statistics, error);
}

/* Writes one line about a device of this name, and reads it back: it matches except for the name
   and the longest launch. */
static void expect_line(const char *name, const char *expected_name, const char *longest_ms) {
    HdStatistics statistics;
    HdError error;
    HdDevice device = {.backend = &hd_backend_c, .index = 3};
    char line[2048] = "", expected[2048];
    snprintf(device.name, sizeof device.name, "%s", name);
    assert_int_equal(open_statistics(&statistics, "new/folder/stats.jsonl", &error), HD_OK);
    assert_int_equal(hd_statistics_add(&statistics, &scene, &device, "4 lanes", &stored, &error),
                     HD_OK);
    /* Flushed: it is there before the file is closed. */
    FILE *file = fopen("new/folder/stats.jsonl", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(line[strlen(line) - 1], '\n');
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
    assert_int_equal(hd_statistics_close(&statistics, HD_DURABLE, HD_OK, &error), HD_OK);
    snprintf(expected, sizeof expected,
             "{\"frame\": 11, \"backend\": \"c\", \"index\": 3, \"device\": \"%s\",\n"
             "\"renderer\": \"4 lanes\", \"width\": 640, \"height\": 480, \"samples\": 3, "
             "\"depth\": 8,\n"
             "\"seconds\": {\"prepare\": 0.5, \"trace\": 1.25, \"copy\": 0.0, \"convert\": 1e-9, "
             "\"store\": 3.0, \"film\": 0.0},\n"
             "\"began\": {\"prepare\": 0.0, \"trace\": 0.5, \"copy\": 1.75, \"convert\": 2.0, "
             "\"store\": 2.5, \"film\": null},\n"
             "\"longest_launch_ms\": %s, \"shadow_tests\": 1152921504606846976, \"clamps\": 7,\n"
             "\"rays\": {\"primary\": 2764800, \"mirrored\": 5, \"transmitted\": 6}}",
             expected_name, longest_ms);
    json_t *read = json_loads(line, 0, NULL), *right = json_loads(expected, 0, NULL);
    assert_non_null(right);
    if (!json_equal(read, right))
        fail_msg("the line is %s, expected %s", line, expected);
    json_decref(read);
    json_decref(right);
}

TEST(a_line_has_every_value) {
    expect_line("A \"quoted\" \\ name\twith a tab", "A \\\"quoted\\\" \\\\ name\\twith a tab",
                "62.5");
    expect_line("Intel\xae Xeon", "Intel? Xeon", "62.5"); /* another encoding stays JSON */
    expect_line("Intel\xc2\xae Xeon", "Intel\xc2\xae Xeon", "62.5");
    stored.times.longest_launch = -1.0;
    expect_line("CPU", "CPU", "null");
    stored.times.longest_launch = 0.0625;
}

TEST(files_that_accept_nothing_are_reported) {
    HdStatistics statistics;
    HdError error;
    HdDevice device = {.backend = &hd_backend_c};
    assert_int_equal(open_statistics(&statistics, "/dev/null/x", &error), HD_FAILED);
    expect_contains(error.message, "/dev/null");
    assert_int_equal(open_statistics(&statistics, ".", &error), HD_FAILED);
    assert_int_equal(open_statistics(&statistics, "/dev/full", &error), HD_OK);
    assert_int_equal(hd_statistics_add(&statistics, &scene, &device, "", &stored, &error),
                     HD_FAILED);
    expect_contains(error.message, "/dev/full");
    hd_statistics_close(&statistics, HD_DURABLE, HD_OK, &error);
}
