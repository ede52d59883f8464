/* SPDX-License-Identifier: MIT */
#include "device/options.h"

#define IS(number) || lanes == (number)

HdStatus hd_render_options_check(const HdRenderOptions *options, HdError *error) {
    int lanes = options->lanes;
    if (!(lanes == 0 HD_LANE_COUNTS(IS)))
        return hd_fail(error, HD_BAD_INPUT,
                       "the number of lanes must be " HD_LANE_COUNTS_IN_WORDS ", not %d", lanes);
    if (options->threads < 0 || options->threads > HD_MAX_THREADS)
        return hd_fail(error, HD_BAD_INPUT, "the number of threads must be 0 to %d, not %d",
                       (int)HD_MAX_THREADS, options->threads);
    int block = options->block;
    if (block < 0 || block > HD_MAX_BLOCK || block % HD_BLOCK_STEP != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "the threads of a block must be 0 or a multiple of %d up to %d, not %d",
                       (int)HD_BLOCK_STEP, (int)HD_MAX_BLOCK, block);
    if (options->grid < 0 || options->grid > HD_MAX_GRID)
        return hd_fail(error, HD_BAD_INPUT, "the blocks of a grid must be 0 to %d, not %d",
                       (int)HD_MAX_GRID, options->grid);
    int registers = options->registers;
    if (registers != 0 && (registers < HD_MIN_REGISTERS || registers > HD_MAX_REGISTERS))
        return hd_fail(error, HD_BAD_INPUT,
                       "the registers of a thread must be 0 or %d to %d, not %d",
                       (int)HD_MIN_REGISTERS, (int)HD_MAX_REGISTERS, registers);
    if (options->launch_ms != 0.0 &&
        !(options->launch_ms >= HD_MIN_LAUNCH_MS && options->launch_ms <= HD_MAX_LAUNCH_MS))
        return hd_fail(error, HD_BAD_INPUT,
                       "the milliseconds of a launch must be 0 or %d to %d, not %g",
                       (int)HD_MIN_LAUNCH_MS, (int)HD_MAX_LAUNCH_MS, options->launch_ms);
    if ((int)options->pipeline < 0 || options->pipeline >= HD_PIPELINE_COUNT)
        return hd_fail(error, HD_BAD_INPUT, "unknown pipeline %d", (int)options->pipeline);
    if (options->precision != HD_PRECISION_FLOAT && options->precision != HD_PRECISION_DOUBLE)
        return hd_fail(error, HD_BAD_INPUT, "unknown precision %d", (int)options->precision);
    if (options->math != HD_MATH_STRICT && options->math != HD_MATH_FAST)
        return hd_fail(error, HD_BAD_INPUT, "unknown arithmetic %d", (int)options->math);
    return HD_OK;
}

bool hd_pipeline_is_wavefront(HdPipeline pipeline) {
    return pipeline == HD_PIPELINE_WAVEFRONT || pipeline == HD_PIPELINE_WAVEFRONT_UNCOMPACTED;
}

const char *const hd_pipeline_names[HD_PIPELINE_COUNT + 1] = {"auto", "mega", "wavefront",
                                                              "wavefront-uncompacted", NULL};
