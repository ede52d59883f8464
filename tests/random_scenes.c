/* SPDX-License-Identifier: MIT */
/* Renders random scenes on a backend and on plain C and compares the bytes:

       hedron_random_scenes [--backend NAME] [--device N] [--precision float|double]
                            [--pipeline NAME] [--lanes N] [--block N] [--registers N] [--ptx ARCH]
                            [--seed N] [--scenes N] [--kind N] [--general] [--threads N]

   --general renders every scene by general kernels, --kind those of one kind alone. A seed makes
   the same scene everywhere. Exit codes: 0 equal, 1 differences, 2 wrong usage, 77 the backend has
   no such device. */
#include <inttypes.h>
#include <stdio.h>

#include "options.h"
#include "render/backends.h"
#include "system/machine.h"
#include "verify/random_scenes.h"

typedef struct Options {
    const HdBackend *backend;
    int device, precision, pipeline;
    HdRandomTest test;
} Options;

static bool parse(Options *options, int count, char **arguments) {
    HdRandomTest *test = &options->test;
    const Option list[] = {
        {"--backend", .backend = &options->backend},
        {"--device", .number = &options->device},
        {"--precision", .number = &options->precision, .choices = precision_names},
        {"--pipeline", .number = &options->pipeline, .choices = hd_pipeline_names},
        {"--lanes", .number = &test->options.lanes},
        {"--block", .number = &test->options.block},
        {"--registers", .number = &test->options.registers},
        {"--ptx", .number = &test->options.test.ptx_arch},
        {"--seed", .seed = &test->seed},
        {"--scenes", .number = &test->scenes},
        {"--kind", .number = &test->kind},
        {"--threads", .number = &test->threads},
        {"--general", .flag = &test->general},
        {.name = NULL},
    };
    if (!parse_options(list, count, arguments))
        return false;
    test->options.precision = (HdPrecision)options->precision;
    test->options.pipeline = (HdPipeline)options->pipeline;
    return true;
}

static int run(const HdRandomTest *test) {
    static HdRandomResult result;
    HdError error;
    double seconds = -hd_monotonic_seconds();
    HdStatus status = hd_random_test(test, &result, &error);
    seconds += hd_monotonic_seconds();
    if (status != HD_OK)
        fprintf(stderr, "hedron_random_scenes: %s\n", error.message);
    if (result.text[0] != '\0')
        printf("DIFFERENT %s\n", result.text);
    printf("%s, %s: %d scenes from seed %" PRIu64 ", %d different, %.1f scenes/s\n",
           test->device->name, precision_names[test->options.precision], result.scenes, test->seed,
           result.different, result.scenes / seconds);
    return status == HD_OK && result.different == 0 ? 0 : 1;
}

int main(int count, char **arguments) {
    static HdDevice devices[HD_MAX_DEVICES];
    HdError error;
    int found = 0;
    Options options = {.backend = &hd_backend_c,
                       .pipeline = HD_PIPELINE_MEGA,
                       .test = {.scenes = 240, .kind = -1}};
    if (!parse(&options, count, arguments))
        return EXIT_USAGE;
    if (hd_backend_enumerate(options.backend, devices, HD_MAX_DEVICES, &found, &error) != HD_OK ||
        options.device >= found) {
        printf("skip %s: no device %d\n", options.backend->name, options.device);
        return EXIT_SKIPPED;
    }
    options.test.device = &devices[options.device];
    return run(&options.test);
}
