/* SPDX-License-Identifier: MIT */
/* The least and the greatest of each option, and what is beyond. */
#include "device/options.h"

#include "unit_test.h"

TEST(what_a_device_can_have_is_accepted_and_else_told) {
    static const struct {
        HdRenderOptions options;
        const char *words; /* NULL: it is accepted */
    } cases[] = {
        {{.lanes = 0}, NULL},
        {{.lanes = 1}, NULL},
        {{.lanes = 4}, NULL},
        {{.lanes = 8}, NULL},
        {{.lanes = 16}, NULL},
        {{.lanes = -1}, "lanes must be 1, 4, 8 or 16, not -1"},
        {{.lanes = 2}, "not 2"},
        {{.lanes = 17}, "not 17"},
        {{.threads = 1, .block = 32, .grid = 1}, NULL},
        {{.threads = 1024, .block = 1024, .grid = 1 << 20}, NULL},
        {{.threads = -1}, "threads must be 0 to 1024, not -1"},
        {{.threads = 1025}, "not 1025"},
        {{.block = -32}, "multiple of 32 up to 1024, not -32"},
        {{.block = 33}, "not 33"},
        {{.block = 1056}, "not 1056"},
        {{.grid = -1}, "blocks of a grid must be 0 to 1048576, not -1"},
        {{.grid = (1 << 20) + 1}, "not 1048577"},
        {{.registers = 16, .launch_ms = 1.0}, NULL},
        {{.registers = 255, .launch_ms = 10000.0}, NULL},
        {{.registers = 15}, "registers of a thread must be 0 or 16 to 255"},
        {{.registers = -1}, "not -1"},
        {{.registers = 256}, "not 256"},
        {{.launch_ms = 0.5}, "0 or 1 to 10000, not 0.5"},
        {{.launch_ms = 10001.0}, "not 10001"},
        {{.launch_ms = (double)NAN}, "not "},
        {{.pipeline = HD_PIPELINE_WAVEFRONT_UNCOMPACTED}, NULL},
        {{.pipeline = HD_PIPELINE_COUNT}, "unknown pipeline 4"},
        {{.precision = HD_PRECISION_DOUBLE, .math = HD_MATH_FAST}, NULL},
        {{.precision = (HdPrecision)7}, "unknown precision 7"},
        {{.math = (HdMath)2}, "unknown arithmetic 2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        HdError error = {.message = "it is accepted"};
        const HdStatus status = hd_render_options_check(&cases[i].options, &error);
        if (cases[i].words != NULL)
            expect_contains(error.message, cases[i].words);
        if (status != (cases[i].words == NULL ? HD_OK : HD_BAD_INPUT))
            fail_msg("case %zu: %s", i, error.message);
    }
}
