/* SPDX-License-Identifier: MIT */
/* The least and the greatest of each option, and what is beyond. */
#include "device/options.h"

#include "unit_test.h"

static HdError error;

TEST(what_a_device_can_have_is_accepted) {
    static const HdRenderOptions good[] = {
        {.lanes = 0},
        {.lanes = 1},
        {.lanes = 4},
        {.lanes = 8},
        {.lanes = 16},
        {.threads = 1024, .block = 1024, .grid = 1 << 20},
        {.threads = 1, .block = 32, .grid = 1},
        {.registers = 16, .launch_ms = 1.0},
        {.registers = 255, .launch_ms = 10000.0},
        {.pipeline = HD_PIPELINE_WAVEFRONT_UNCOMPACTED},
        {.precision = HD_PRECISION_DOUBLE, .math = HD_MATH_FAST},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        if (hd_render_options_check(&good[i], &error) != HD_OK)
            fail_msg("%s", error.message);
}

TEST(what_none_can_have_is_told) {
    static const struct {
        HdRenderOptions options;
        const char *words;
    } bad[] = {
        {{.lanes = -1}, "lanes must be 1, 4, 8 or 16, not -1"},
        {{.lanes = 2}, "lanes must be 1, 4, 8 or 16, not 2"},
        {{.lanes = 17}, "not 17"},
        {{.threads = -1}, "threads must be 0 to 1024, not -1"},
        {{.threads = 1025}, "not 1025"},
        {{.block = -32}, "multiple of 32 up to 1024, not -32"},
        {{.block = 33}, "not 33"},
        {{.block = 1056}, "not 1056"},
        {{.grid = -1}, "blocks of a grid must be 0 to 1048576, not -1"},
        {{.grid = (1 << 20) + 1}, "not 1048577"},
        {{.registers = 15}, "registers of a thread must be 0 or 16 to 255"},
        {{.registers = -1}, "not -1"},
        {{.registers = 256}, "not 256"},
        {{.launch_ms = 0.5}, "0 or 1 to 10000, not 0.5"},
        {{.launch_ms = 10001.0}, "not 10001"},
        {{.launch_ms = (double)NAN}, "not "},
        {{.pipeline = HD_PIPELINE_COUNT}, "unknown pipeline 4"},
        {{.precision = (HdPrecision)7}, "unknown precision 7"},
        {{.math = (HdMath)2}, "unknown arithmetic 2"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        error.message[0] = '\0';
        if (hd_render_options_check(&bad[i].options, &error) != HD_BAD_INPUT)
            fail_msg("what should be told as '%s' is accepted", bad[i].words);
        expect_contains(error.message, bad[i].words);
    }
}
