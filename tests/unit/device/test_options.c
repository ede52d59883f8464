/* SPDX-License-Identifier: MIT */
/* The least and the greatest of each option, and what is beyond. */
#include "device/options.h"

#include "unit_test.h"

static HdError error;

static void expect_good(HdRenderOptions options) {
    assert_int_equal(hd_render_options_check(&options, &error), HD_OK);
}

static void expect_bad(HdRenderOptions options, const char *words) {
    assert_int_equal(hd_render_options_check(&options, &error), HD_BAD_INPUT);
    expect_contains(error.message, words);
}

TEST(what_a_device_can_have_is_accepted) {
    expect_good((HdRenderOptions){0});
    for (int lanes = 0; lanes <= 17; lanes++)
        if (lanes == 0 || lanes == 1 || lanes == 4 || lanes == 8 || lanes == 16)
            expect_good((HdRenderOptions){.lanes = lanes});
        else
            expect_bad((HdRenderOptions){.lanes = lanes}, "lanes must be 1, 4, 8 or 16, not ");
    expect_good((HdRenderOptions){.threads = 1024, .block = 1024, .grid = 1 << 20});
    expect_good((HdRenderOptions){.threads = 1, .block = 32, .grid = 1});
    expect_good((HdRenderOptions){.registers = 16, .launch_ms = 1.0});
    expect_good((HdRenderOptions){.registers = 255, .launch_ms = 10000.0});
    expect_good((HdRenderOptions){.precision = HD_PRECISION_DOUBLE, .math = HD_MATH_FAST});
    for (int i = 0; i < HD_PIPELINE_COUNT; i++)
        expect_good((HdRenderOptions){.pipeline = (HdPipeline)i});
}

TEST(what_none_can_have_is_told) {
    expect_bad((HdRenderOptions){.lanes = -1}, "lanes");
    expect_bad((HdRenderOptions){.threads = -1}, "threads must be 0 to 1024, not -1");
    expect_bad((HdRenderOptions){.threads = 1025}, "not 1025");
    expect_bad((HdRenderOptions){.block = -32}, "multiple of 32 up to 1024, not -32");
    expect_bad((HdRenderOptions){.block = 33}, "not 33");
    expect_bad((HdRenderOptions){.block = 1056}, "not 1056");
    expect_bad((HdRenderOptions){.grid = -1}, "blocks of a grid must be 0 to 1048576, not -1");
    expect_bad((HdRenderOptions){.grid = (1 << 20) + 1}, "not 1048577");
    expect_bad((HdRenderOptions){.registers = 15}, "registers of a thread must be 0 or 16 to 255");
    expect_bad((HdRenderOptions){.registers = -1}, "not -1");
    expect_bad((HdRenderOptions){.registers = 256}, "not 256");
    expect_bad((HdRenderOptions){.launch_ms = 0.5}, "0 or 1 to 10000, not 0.5");
    expect_bad((HdRenderOptions){.launch_ms = 10001.0}, "not 10001");
    expect_bad((HdRenderOptions){.launch_ms = (double)NAN}, "not ");
    expect_bad((HdRenderOptions){.pipeline = HD_PIPELINE_COUNT}, "unknown pipeline 4");
    expect_bad((HdRenderOptions){.precision = (HdPrecision)7}, "unknown precision 7");
    expect_bad((HdRenderOptions){.math = (HdMath)2}, "unknown arithmetic 2");
}

TEST(pipelines_have_names) {
    static const bool is_wavefront[] = {false, false, true, true};
    for (int i = 0; i < HD_PIPELINE_COUNT; i++)
        assert_true(hd_pipeline_is_wavefront((HdPipeline)i) == is_wavefront[i]);
    assert_string_equal(hd_pipeline_names[HD_PIPELINE_WAVEFRONT_UNCOMPACTED],
                        "wavefront-uncompacted");
    assert_null(hd_pipeline_names[HD_PIPELINE_COUNT]);
}
