/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

#include <jansson.h>

#include "cli/statistics.h"
#include "input/json/json_device_text.h"
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

/* Writes one line about a device of this name, and reads it back. */
static json_t *read_line_about(const char *device_name) {
    HdStatistics statistics;
    HdError error;
    HdDevice device = {.backend = &hd_backend_c, .index = 3};
    HdRunFacts facts = {.scene = &scene, .device = &device, .renderer = "4 lanes"};
    snprintf(device.name, sizeof device.name, "%s", device_name);
    assert_int_equal(open_statistics(&statistics, "new/folder/stats.jsonl", &error), HD_OK);
    assert_int_equal(hd_statistics_add(&statistics, &facts, &stored, &error), HD_OK);
    /* Flushed: it is there before the file is closed. */
    FILE *file = fopen("new/folder/stats.jsonl", "r");
    char line[2048] = "";
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_int_equal(line[strlen(line) - 1], '\n');
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
    assert_int_equal(hd_statistics_close(&statistics, true, &error), HD_OK);
    return json_loads(line, 0, NULL);
}

static json_int_t whole(json_t *object, const char *key) {
    json_t *value = json_object_get(object, key);
    assert_true(json_is_integer(value));
    return json_integer_value(value);
}

static void check_numbers(json_t *line) {
    json_t *seconds = json_object_get(line, "seconds"), *rays = json_object_get(line, "rays");
    assert_int_equal(whole(line, "frame"), 11);
    assert_int_equal(whole(line, "width"), 640);
    assert_int_equal(whole(line, "height"), 480);
    assert_int_equal(whole(line, "samples"), 3);
    assert_int_equal(whole(line, "depth"), 8);
    assert_true(json_real_value(json_object_get(seconds, "prepare")) == 0.5);
    assert_true(json_real_value(json_object_get(seconds, "trace")) == 1.25);
    assert_true(json_is_real(json_object_get(seconds, "copy")));
    assert_true(json_real_value(json_object_get(seconds, "copy")) == 0.0);
    assert_true(json_real_value(json_object_get(seconds, "convert")) == 1e-9);
    assert_true(json_real_value(json_object_get(seconds, "store")) == 3.0);
    assert_true(json_is_real(json_object_get(seconds, "film")));
    assert_true(json_real_value(json_object_get(seconds, "film")) == 0.0);
    assert_int_equal(whole(rays, "primary"), 2764800);
    assert_int_equal(whole(rays, "mirrored"), 5);
    assert_int_equal(whole(rays, "transmitted"), 6);
    assert_int_equal(whole(line, "shadow_tests"), INT64_C(1) << 60);
    assert_int_equal(whole(line, "clamps"), 7);
}

static void check_begins(json_t *line) {
    json_t *began = json_object_get(line, "began");
    assert_int_equal(json_object_size(began), 6);
    assert_true(json_is_real(json_object_get(began, "prepare")));
    assert_true(json_real_value(json_object_get(began, "prepare")) == 0.0);
    assert_true(json_real_value(json_object_get(began, "trace")) == 0.5);
    assert_true(json_real_value(json_object_get(began, "copy")) == 1.75);
    assert_true(json_real_value(json_object_get(began, "convert")) == 2.0);
    assert_true(json_real_value(json_object_get(began, "store")) == 2.5);
    assert_true(json_is_null(json_object_get(began, "film"))); /* there was none */
}

TEST(a_line_has_everything) {
    json_t *line = read_line_about("A \"quoted\" \\ name\twith a tab");
    assert_non_null(line);
    assert_int_equal(json_object_size(line), 15);
    check_numbers(line);
    check_begins(line);
    assert_string_equal(json_string_value(json_object_get(line, "backend")), "c");
    assert_int_equal(whole(line, "index"), 3);
    assert_string_equal(json_string_value(json_object_get(line, "device")),
                        "A \"quoted\" \\ name\twith a tab");
    assert_string_equal(json_string_value(json_object_get(line, "renderer")), "4 lanes");
    json_decref(line);
}

TEST(the_longest_launch_is_told_where_it_is_known) {
    json_t *line = read_line_about("GPU");
    assert_true(json_real_value(json_object_get(line, "longest_launch_ms")) == 62.5);
    json_decref(line);
    stored.times.longest_launch = -1.0;
    line = read_line_about("CPU");
    assert_true(json_is_null(json_object_get(line, "longest_launch_ms")));
    json_decref(line);
    stored.times.longest_launch = 0.0625;
}

TEST(names_in_other_encodings_stay_json) {
    json_t *line = read_line_about("Intel\xae Xeon");
    assert_non_null(line);
    assert_string_equal(json_string_value(json_object_get(line, "device")), "Intel? Xeon");
    json_decref(line);
    line = read_line_about("Intel\xc2\xae Xeon");
    assert_string_equal(json_string_value(json_object_get(line, "device")), "Intel\xc2\xae Xeon");
    json_decref(line);
}

/* Some locale with a decimal comma, made on the spot where none is installed. */
static int has_decimal_comma(void) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (setlocale(LC_ALL, names[i]) != NULL)
            return 1;
    if (system("localedef -i de_DE -f UTF-8 ./de_DE.UTF-8 >localedef.log 2>&1") != 0)
        return 0;
    setenv("LOCPATH", ".", 1);
    return setlocale(LC_ALL, "de_DE.UTF-8") != NULL;
}

TEST(numbers_have_a_point_in_every_locale) {
    char text[16];
    if (!has_decimal_comma())
        skip();
    snprintf(text, sizeof text, "%.1f", 0.5);
    assert_string_equal(text, "0,5");
    json_t *line = read_line_about("device");
    setlocale(LC_ALL, "C");
    assert_non_null(line);
    check_numbers(line);
    json_decref(line);
}

TEST(files_that_take_nothing_are_told) {
    HdStatistics statistics;
    HdError error;
    HdDevice device = {.backend = &hd_backend_c};
    HdRunFacts facts = {.scene = &scene, .device = &device, .renderer = ""};
    assert_int_equal(open_statistics(&statistics, "/dev/null/x", &error), HD_FAILED);
    assert_non_null(strstr(error.message, "/dev/null"));
    assert_int_equal(open_statistics(&statistics, ".", &error), HD_FAILED);
    assert_int_equal(open_statistics(&statistics, "/dev/full", &error), HD_OK);
    assert_int_equal(hd_statistics_add(&statistics, &facts, &stored, &error), HD_FAILED);
    assert_non_null(strstr(error.message, "/dev/full"));
    hd_statistics_close(&statistics, true, &error);
}
