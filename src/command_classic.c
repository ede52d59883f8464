/* SPDX-License-Identifier: MIT */
#include <inttypes.h>
#include <stdlib.h>

#include "commands.h"
#include "default_scene.h"
#include "interrupt.h"
#include "rendering.h"

/* Far above any classic input, and small enough to read into memory without a thought. */
enum { MAX_INPUT_BYTES = 1 << 20 };

static HdStatus read_standard_input(char **text, size_t *size, HdError *error) {
    *text = malloc(MAX_INPUT_BYTES + 1);
    if (*text == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the input");
    *size = fread(*text, 1, MAX_INPUT_BYTES + 1, stdin);
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted while reading standard input");
    if (ferror(stdin))
        return hd_fail(error, HD_FAILED, "cannot read standard input");
    if (*size > MAX_INPUT_BYTES)
        return hd_fail(error, HD_BAD_INPUT, "standard input is longer than %d bytes",
                       (int)MAX_INPUT_BYTES);
    return HD_OK;
}

static HdStatus print_frame_line(int number, const HdFrame *frame, double seconds, HdError *error) {
    if (printf("%d\t%.3f\t%" PRIu64 "\n", number, seconds * 1e3, hd_frame_rays(frame)) < 0 ||
        fflush(stdout) != 0)
        return hd_fail(error, HD_FAILED, "cannot write to standard output");
    return HD_OK;
}

static HdStatus render_input(const HdOptions *options, const HdClassicInput *input,
                             HdError *error) {
    HdRendering rendering = {
        .scene = &input->scene,
        .output = input->output_pattern,
        .device_kind = options->mode == HD_CLASSIC_CPU ? HD_ONLY_CPU : HD_PREFER_GPU,
        .stored = print_frame_line,
    };
    return hd_render(&rendering, options, error);
}

static HdStatus print_default(const HdOptions *options, HdError *error) {
    HdClassicInput input;
    HdStatus status = hd_default_input(&input, error);
    if (status != HD_OK)
        return status;
    status = hd_apply_scene_options(&input.scene, options, error);
    if (status == HD_OK)
        status = hd_classic_print(stdout, &input, error);
    hd_classic_free(&input);
    return status;
}

static HdStatus trace_standard_input(const HdOptions *options, HdError *error) {
    HdClassicInput input;
    char *text = NULL;
    size_t size = 0;
    HdStatus status = read_standard_input(&text, &size, error);
    if (status == HD_OK)
        status = hd_classic_parse(&input, text, size, "standard input", options->variant, error);
    free(text);
    if (status != HD_OK)
        return status;
    status = hd_apply_scene_options(&input.scene, options, error);
    if (status == HD_OK)
        status = hd_load_floor_texture(&input.scene, input.texture_path, HD_CURVE_LINEAR, error);
    if (status == HD_OK)
        status = render_input(options, &input, error);
    hd_classic_free(&input);
    return status;
}

HdStatus hd_command_classic(const HdOptions *options, HdError *error) {
    if (options->mode == HD_CLASSIC_PRINT)
        return print_default(options, error);
    return trace_standard_input(options, error);
}
