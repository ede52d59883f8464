/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "output/outputs.h"
#include "output/parcel.h"
#include "test_folder.h"

static HdError error;

static HdOutputPlan plan_of(const char *first, const char *second) {
    HdOutputPlan plan = {
        .names = {first, second},
        .count = second != NULL ? 2 : 1,
        .style = {.picture = {.curve = HD_CURVE_LINEAR, .bits = 8}, .frames_per_second = 30},
    };
    return plan;
}

static void check_accepted(const char *name, int frames) {
    HdOutputPlan plan = plan_of(name, NULL);
    assert_int_equal(hd_outputs_check(&plan, frames, &error), HD_OK);
}

static void check_refused(const char *first, const char *second, int frames, const char *part) {
    HdOutputPlan plan = plan_of(first, second);
    assert_int_equal(hd_outputs_check(&plan, frames, &error), HD_BAD_INPUT);
    expect_contains(error.message, part);
}

static void outputs_suit_the_number_of_frames(void **state) {
    (void)state;
    check_accepted("a.png", 1);
    check_accepted("a.mp4", 1);
    check_accepted("a.GIF", 7);
    check_accepted("a_%04d.png", 7);
    check_accepted("a_####.pfm", 7);
    check_accepted("a_%d.data", 1);
    check_refused("a.png", NULL, 2, "2 frames");
    check_refused("a.pfm", NULL, 7, "'a.pfm'");
    check_refused("a_%d.mkv", NULL, 7, "numbered films");
    check_refused("a_##.gif", NULL, 7, "numbered films");
    check_refused("%d_%d.png", NULL, 7, "%d_%d.png");
    check_refused("%s.png", NULL, 7, "%s.png");
    check_refused("100%.png", NULL, 1, "100%.png");
}

static void every_output_is_checked(void **state) {
    (void)state;
    check_refused("a.mp4", "b.png", 2, "'b.png'");
    check_refused("a.png", "a.png", 1, "twice");
}

static void names_tell_what_to_write(void **state) {
    (void)state;
    static const char *const good[] = {"a.png", "a.DATA", "a.pfm", "a.mp4", "a.mkv", "a.gif"};
    static const char *const bad[] = {"", "a", "a.jpg", "png", "a.png/", "a.png.txt"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        assert_int_equal(hd_output_check_name(good[i], "--output", &error), HD_OK);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(hd_output_check_name(bad[i], "--output", &error), HD_BAD_INPUT);
        expect_contains(error.message, "--output");
    }
}

static void store(HdParcel *parcel, int number) {
    assert_int_equal(hd_parcel_write(parcel, number, &error), HD_OK);
    assert_int_equal(hd_parcel_publish(parcel, &error), HD_OK);
}

static void one_frame_goes_everywhere(void **state) {
    (void)state;
    HdOutputPlan plan = plan_of("one/a_%d.data", "two/a.pfm");
    HdOutputs *outputs;
    HdParcel *parcel;
    assert_int_equal(hd_outputs_open(&outputs, &plan, 3, 2, &error), HD_OK);
    assert_null(hd_outputs_film(outputs, 0));
    assert_int_equal(hd_parcel_create(&parcel, outputs, 3, 2, &error), HD_OK);
    assert_int_equal(hd_parcel_frame(parcel)->width, 3);
    store(parcel, 5);
    store(parcel, 6);
    hd_parcel_free(parcel);
    assert_int_equal(hd_outputs_close(outputs, &error), HD_OK);
    assert_int_equal(count_entries("one"), 2);
    assert_int_equal(access("one/a_5.data", R_OK), 0);
    assert_int_equal(access("one/a_6.data", R_OK), 0);
    assert_int_equal(count_entries("two"), 1);
}

static void what_is_not_published_goes(void **state) {
    (void)state;
    HdOutputPlan plan = plan_of("four/a_%d.data", "four/a_%d.png");
    HdOutputs *outputs;
    HdParcel *parcel;
    assert_int_equal(hd_outputs_open(&outputs, &plan, 3, 2, &error), HD_OK);
    assert_int_equal(hd_parcel_create(&parcel, outputs, 3, 2, &error), HD_OK);
    assert_int_equal(hd_parcel_write(parcel, 5, &error), HD_OK);
    assert_int_equal(count_entries("four"), 2);
    assert_int_not_equal(access("four/a_5.data", F_OK), 0);
    hd_parcel_free(parcel);
    hd_parcel_free(NULL);
    assert_int_equal(count_entries("four"), 0);
    assert_int_equal(hd_outputs_close(outputs, &error), HD_OK);
}

static void the_first_failure_ends_it(void **state) {
    (void)state;
    HdOutputPlan plan = plan_of("/dev/null/a_%d.data", "three/a.data");
    HdOutputs *outputs;
    HdParcel *parcel;
    assert_int_equal(hd_outputs_open(&outputs, &plan, 3, 2, &error), HD_OK);
    assert_int_equal(hd_parcel_create(&parcel, outputs, 3, 2, &error), HD_OK);
    assert_int_equal(hd_parcel_write(parcel, 0, &error), HD_FAILED);
    hd_parcel_free(parcel);
    hd_outputs_abort(outputs);
    hd_outputs_abort(NULL);
    assert_int_not_equal(access("three", F_OK), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outputs_suit_the_number_of_frames),
        cmocka_unit_test(every_output_is_checked),
        cmocka_unit_test(names_tell_what_to_write),
        cmocka_unit_test(one_frame_goes_everywhere),
        cmocka_unit_test(what_is_not_published_goes),
        cmocka_unit_test(the_first_failure_ends_it),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
