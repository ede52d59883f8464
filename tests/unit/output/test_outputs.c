/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include <stdlib.h>

#include "output/outputs.h"
#include "unit_test.h"

static HdError error;
static HdOutputPlan plan;

static HdStatus settle(const char *first, const char *second, int bits, int frames) {
    const HdOutputStyle style = {.picture = {.curve = HD_CURVE_LINEAR, .bits = bits},
                                 .frames_per_second = 30};
    const char *const names[] = {first, second};
    return hd_outputs_settle(&plan, names, second != NULL ? 2 : 1, &style, frames, &error);
}

TEST(outputs_fit_the_number_of_frames) {
    static const struct {
        const char *first, *second;
        int frames;
        const char *why; /* NULL: they do */
    } cases[] = {{"a.png", NULL, 1, NULL},
                 {"a.mp4", NULL, 1, NULL},
                 {"a.MKV", NULL, 7, NULL},
                 {"a_%04d.png", NULL, 7, NULL},
                 {"a_####.pfm", NULL, 7, NULL},
                 {"a_%d.data", NULL, 1, NULL},
                 {"a.png", NULL, 2, "2 frames"},
                 {"a.pfm", NULL, 7, "'a.pfm'"},
                 {"a_%d.mkv", NULL, 7, "numbered films"},
                 {"a #1/a_##.mkv", NULL, 7, NULL},
                 {"a #1/b.png", NULL, 1, NULL},
                 {"a ##/b.png", NULL, 7, "names one picture"},
                 {"a_##.png", "b.GIF", 7, "b.GIF cannot be linear, because GIF files cannot"},
                 {"%d_%d.png", NULL, 7, "%d_%d.png"},
                 {"100%.png", NULL, 1, "100%.png"},
                 {"a.mp4", "b.png", 2, "'b.png'"},
                 {"a.png", "b.mp4", 2, "'a.png'"},
                 {"a.png", "a.png", 1, "twice"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdStatus status = settle(cases[i].first, cases[i].second, 8, cases[i].frames);
        if (status != (cases[i].why == NULL ? HD_OK : HD_BAD_INPUT))
            fail_msg("%s: status %d", cases[i].first, status);
        if (cases[i].why != NULL)
            expect_contains(error.message, cases[i].why);
    }
}

TEST(layers_are_for_outputs_that_hold_them) {
    const unsigned alpha = HD_LAYER_BIT(HD_LAYER_ALPHA), depth = HD_LAYER_BIT(HD_LAYER_DEPTH),
                   bound = HD_LAYER_BIT(HD_LAYER_BOUND);
    assert_int_equal(settle("a.png", "a.pfm", 8, 1), HD_OK);
    assert_int_equal(plan.request.layers, 0);
    assert_int_equal(hd_outputs_add_layers(&plan, 0, false, &error), HD_OK);
    assert_int_equal(hd_outputs_add_layers(&plan, depth, true, &error), HD_BAD_INPUT);
    expect_contains(error.message, "--layers is for OpenEXR: expected an output that ends in .exr");
    assert_int_equal(settle("a.png", "a.exr", 8, 1), HD_OK);
    assert_int_equal(plan.request.layers, alpha);
    assert_int_equal(hd_outputs_add_layers(&plan, bound | depth, false, &error), HD_BAD_INPUT);
    expect_contains(error.message, "--max-error or --reference");
    assert_int_equal(hd_outputs_add_layers(&plan, depth, false, &error), HD_OK);
    assert_int_equal(plan.request.layers, alpha | depth);
    assert_int_equal(hd_outputs_add_layers(&plan, bound, true, &error), HD_OK);
    assert_int_equal(plan.request.layers, alpha | depth | bound);
}

TEST(a_plan_says_what_frames_must_hold) {
    static const struct {
        const char *first, *second;
        int bits, films;
        bool radiance, can_resume, bears;
    } cases[] = {{"a_%d.png", "b.MKV", 8, 1, false, true, true},
                 {"a_%d.png", NULL, 16, 0, true, true, true},
                 {"a_%d.png", "b_%d.pfm", 8, 0, true, false, true},
                 {"a_%d.pfm", NULL, 8, 0, true, false, false},
                 {"a.mp4", NULL, 8, 1, false, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(settle(cases[i].first, cases[i].second, cases[i].bits, 2), HD_OK);
        assert_int_equal(plan.film_count, cases[i].films);
        assert_int_equal(plan.request.radiance, cases[i].radiance);
        assert_int_equal(plan.can_resume, cases[i].can_resume);
        assert_int_equal(plan.bears_fingerprints, cases[i].bears);
        assert_false(plan.has_fingerprint);
        hd_outputs_set_fingerprint(&plan, 5, false);
        assert_false(plan.resumes);
        hd_outputs_set_fingerprint(&plan, 5, true);
        assert_true(plan.has_fingerprint && plan.fingerprint == 5);
        assert_int_equal(plan.resumes, cases[i].can_resume);
    }
}

TEST(frames_have_files) {
    char file[HD_MAX_PATH];
    assert_int_equal(settle("~/a_###.png", "100%%.#3.mp4", 8, 2), HD_OK);
    assert_int_equal(setenv("HOME", "/home/a%d", 1), 0);
    assert_int_equal(hd_output_file(&plan.list[0], 7, file, &error), HD_OK);
    assert_string_equal(file, "/home/a%d/a_007.png");
    assert_int_equal(hd_output_name(&plan.list[1], 7, file, &error), HD_OK);
    assert_string_equal(file, "100%%.#3.mp4");
    assert_int_equal(settle("#/100%%%#.png", NULL, 8, 1), HD_OK);
    assert_int_equal(hd_output_name(&plan.list[0], 7, file, &error), HD_OK);
    assert_string_equal(file, "#/100%#.png");
}
