/* SPDX-License-Identifier: MIT */
/* Renders random scenes by a backend and by plain C and compares the bytes:

       hedron_random_scenes [--backend NAME] [--device N] [--precision float|double]
                            [--pipeline NAME] [--lanes N] [--block N] [--registers N] [--ptx ARCH]
                            [--seed N] [--scenes N] [--kind N] [--general] [--threads N]

   --general renders every scene by kernels that do everything, --kind those of one kind alone. A
   seed makes the same scene everywhere. Exits 0 where all are equal, 1 where one differs, 2 where
   it is called wrongly, 77 where the backend has no such device. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "certify/random_test.h"
#include "system/machine.h"

enum { EXIT_USAGE = 2, EXIT_SKIPPED = 77 };

static HdRandomTest test = {.scenes = 240, .kind = -1, .options.pipeline = HD_PIPELINE_MEGA};
static const HdBackend *backend = &hd_backend_c;
static int device;

static int index_of(const char *name, const char *const *names) {
    for (int i = 0; names[i] != NULL; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

static bool parse_option(const char *name, const char *value) {
    static const char *const precisions[] = {"float", "double", NULL};
    static const struct {
        const char *name;
        int *number;
    } numbers[] = {{"--device", &device},
                   {"--lanes", &test.options.lanes},
                   {"--block", &test.options.block},
                   {"--registers", &test.options.registers},
                   {"--ptx", &test.options.test.ptx_arch},
                   {"--scenes", &test.scenes},
                   {"--kind", &test.kind},
                   {"--threads", &test.threads}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strcmp(name, numbers[i].name) == 0)
            return (*numbers[i].number = atoi(value)) >= 0;
    int choice = -1;
    if (strcmp(name, "--backend") == 0)
        return (backend = hd_backend_find(value)) != NULL;
    if (strcmp(name, "--seed") == 0)
        return sscanf(value, "%" SCNu64, &test.seed) == 1;
    if (strcmp(name, "--precision") == 0 && (choice = index_of(value, precisions)) >= 0)
        test.options.precision = (HdPrecision)choice;
    else if (strcmp(name, "--pipeline") == 0 && (choice = index_of(value, hd_pipeline_names)) >= 0)
        test.options.pipeline = (HdPipeline)choice;
    return choice >= 0;
}

int main(int count, char **arguments) {
    static HdDevice devices[HD_MAX_DEVICES];
    static HdRandomResult result;
    HdError error;
    int found = 0;
    for (int i = 1; i < count; i++) {
        if (strcmp(arguments[i], "--general") == 0) {
            test.general = true;
        } else if (i + 1 < count && parse_option(arguments[i], arguments[i + 1])) {
            i++;
        } else {
            fprintf(stderr, "hedron_random_scenes: not understood: %s\n", arguments[i]);
            return EXIT_USAGE;
        }
    }
    if (hd_backend_enumerate(backend, devices, HD_MAX_DEVICES, &found, &error) != HD_OK ||
        device >= found) {
        printf("skip %s: no device %d\n", backend->name, device);
        return EXIT_SKIPPED;
    }
    test.device = &devices[device];
    const double start = hd_monotonic_seconds();
    const HdStatus status = hd_random_test(&test, &result, &error);
    const double seconds = hd_monotonic_seconds() - start;
    if (status != HD_OK)
        fprintf(stderr, "hedron_random_scenes: %s\n", error.message);
    if (result.text[0] != '\0')
        printf("DIFFERENT %s\n", result.text);
    printf("%s, %s: %d scenes from seed %" PRIu64 ", %d different, %.1f scenes/s\n",
           test.device->name, test.options.precision == HD_PRECISION_FLOAT ? "float" : "double",
           result.scenes, test.seed, result.different, result.scenes / seconds);
    return status == HD_OK && result.different == 0 ? 0 : 1;
}
