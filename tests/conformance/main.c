/* SPDX-License-Identifier: MIT */
/* The conformance suite: renders the fixed list of frames on every backend, device and lane count
   that opens, in float and double, and demands one hash for each frame and precision, the committed
   one.

   hedron_conformance [--golden FILE] [--write-golden] [--math strict|fast] [--backend NAME]
                      [--pictures FOLDER] */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backend.h"
#include "scenes.h"
#include "truths.h"

enum { MAX_FRAMES = 64, MAX_NAME = 64 };

static const char *const precision_names[2] = {"float", "double"};

typedef struct Golden {
    uint64_t hash[MAX_FRAMES][2];
    bool known[MAX_FRAMES][2];
    bool fixed; /* read from a file; otherwise the first renderer's hashes count */
} Golden;

typedef struct Options {
    const char *golden, *backend, *pictures;
    bool write_golden;
    HdMath math;
} Options;

typedef struct Tally {
    int renderers, frames, different, truths, untrue;
} Tally;

static int frame_number(const char *name) {
    for (int i = 0; i < conformance_frame_count; i++)
        if (strcmp(conformance_frames[i].name, name) == 0)
            return i;
    return -1;
}

static bool read_golden(Golden *golden, const char *path) {
    char name[MAX_NAME];
    uint64_t hash[2];
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        return false;
    }
    while (fscanf(file, "%63s %" SCNx64 " %" SCNx64, name, &hash[0], &hash[1]) == 3) {
        int frame = frame_number(name);
        if (frame < 0)
            continue;
        for (int p = 0; p < 2; p++) {
            golden->hash[frame][p] = hash[p];
            golden->known[frame][p] = true;
        }
    }
    fclose(file);
    golden->fixed = true;
    return true;
}

static bool write_golden(const Golden *golden, const char *path) {
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
        return false;
    }
    for (int i = 0; i < conformance_frame_count; i++)
        fprintf(file, "%-20s %016" PRIx64 " %016" PRIx64 "\n", conformance_frames[i].name,
                golden->hash[i][0], golden->hash[i][1]);
    return fclose(file) == 0;
}

static void fail(const char *what, const HdError *error) {
    fprintf(stderr, "%s: %s\n", what, error->message);
    exit(1);
}

static void save_picture(const Options *options, const char *name, const HdFrame *frame) {
    HdError error;
    HdImage8 image;
    char path[4096];
    if (options->pictures == NULL)
        return;
    snprintf(path, sizeof path, "%s/%s.png", options->pictures, name);
    if (hd_image8_create(&image, frame->width, frame->height, &error) != HD_OK)
        fail(name, &error);
    hd_frame_to_image8(frame, &image);
    if (hd_image8_write(&image, path, &error) != HD_OK)
        fail(path, &error);
    hd_image8_free(&image);
}

static uint64_t render_hash(HdRenderer *renderer, int number, HdPrecision precision,
                            const Options *options) {
    HdError error;
    HdScene scene;
    HdCamera camera;
    HdFrame frame;
    HdSceneTables tables;
    HdFrameTables view;
    const char *name = conformance_frames[number].name;
    conformance_frames[number].build(&scene, &camera);
    if (hd_scene_validate(&scene, &error) != HD_OK ||
        hd_compile_scene(&tables, &scene, precision, &error) != HD_OK ||
        hd_compile_frame(&view, &scene, &camera, precision, &error) != HD_OK ||
        hd_frame_create(&frame, scene.width, scene.height, &error) != HD_OK ||
        hd_renderer_upload(renderer, &tables, &error) != HD_OK ||
        hd_renderer_render(renderer, &view, &frame, &error) != HD_OK)
        fail(name, &error);
    uint64_t hash = hd_frame_hash(&frame);
    save_picture(options, name, &frame);
    hd_frame_free(&frame);
    hd_frame_tables_free(&view);
    hd_scene_tables_free(&tables);
    hd_scene_free(&scene);
    return hash;
}

static void compare_frames(HdRenderer *renderer, const char *label, HdPrecision precision,
                           const Options *options, Golden *golden, Tally *tally) {
    int different = 0;
    for (int i = 0; i < conformance_frame_count; i++) {
        uint64_t hash = render_hash(renderer, i, precision, options);
        uint64_t *expected = &golden->hash[i][precision];
        if (!golden->known[i][precision] && !golden->fixed) {
            *expected = hash;
            golden->known[i][precision] = true;
        }
        tally->frames++;
        if (!golden->known[i][precision] || *expected != hash) {
            different++;
            printf("DIFFERENT %-20s %016" PRIx64 ", expected %016" PRIx64 " on %s\n",
                   conformance_frames[i].name, hash, *expected, label);
        }
    }
    tally->different += different;
    printf("%-4s %2d frames  %s\n", different == 0 ? "same" : "DIFF", conformance_frame_count,
           label);
    fflush(stdout);
}

static void check_renderer(const HdDevice *device, int lanes, int threads, HdPrecision precision,
                           const Options *options, Golden *golden, Tally *tally) {
    HdError error;
    HdRenderer *renderer;
    char text[256], label[1024];
    HdRenderOptions wanted = {
        .lanes = lanes, .threads = threads, .precision = precision, .math = options->math};
    HdStatus status = hd_renderer_open(&renderer, device, &wanted, &error);
    if (status == HD_UNAVAILABLE) {
        printf("skip            %s %s, %d lanes, %s: %s\n", device->backend->name, device->name,
               lanes, precision_names[precision], error.message);
        return;
    }
    if (status != HD_OK)
        fail(device->name, &error);
    hd_renderer_describe(renderer, text, (int)sizeof text);
    snprintf(label, sizeof label, "%-6s %-6s %s (%s)", device->backend->name,
             precision_names[precision], device->name, text);
    compare_frames(renderer, label, precision, options, golden, tally);
    check_truths(renderer, precision, label, &tally->truths, &tally->untrue);
    tally->renderers++;
    hd_renderer_close(renderer);
}

static void check_device(const HdDevice *device, const Options *options, Golden *golden,
                         Tally *tally) {
    static const int lane_counts[] = {1, 4, 8, 16};
    for (int precision = HD_FLOAT; precision <= HD_DOUBLE_PRECISION; precision++)
        for (int i = 0; i < (device->is_cpu ? 4 : 1); i++)
            check_renderer(device, lane_counts[i], 1 + i % 2, (HdPrecision)precision, options,
                           golden, tally);
}

static void check_backend(const HdBackend *backend, const Options *options, Golden *golden,
                          Tally *tally) {
    HdDevice devices[HD_MAX_DEVICES];
    HdError error;
    int count = 0;
    HdStatus status = backend->enumerate(devices, HD_MAX_DEVICES, &count, &error);
    if (status != HD_OK)
        printf("skip            %s: %s\n", backend->name, error.message);
    for (int i = 0; status == HD_OK && i < count; i++)
        check_device(&devices[i], options, golden, tally);
}

static bool parse_options(Options *options, int count, char **arguments) {
    for (int i = 1; i < count; i++) {
        const char *name = arguments[i];
        if (strcmp(name, "--write-golden") == 0) {
            options->write_golden = true;
            continue;
        }
        const char *value = i + 1 < count ? arguments[++i] : NULL;
        if (value == NULL)
            return false;
        if (strcmp(name, "--golden") == 0)
            options->golden = value;
        else if (strcmp(name, "--backend") == 0)
            options->backend = value;
        else if (strcmp(name, "--pictures") == 0)
            options->pictures = value;
        else if (strcmp(name, "--math") == 0)
            options->math = strcmp(value, "fast") == 0 ? HD_MATH_FAST : HD_MATH_STRICT;
        else
            return false;
    }
    return true;
}

static void print_hashes(const Golden *golden) {
    printf("\n%-20s %-16s %-16s\n", "frame", "float", "double");
    for (int i = 0; i < conformance_frame_count; i++)
        printf("%-20s %016" PRIx64 " %016" PRIx64 "\n", conformance_frames[i].name,
               golden->hash[i][0], golden->hash[i][1]);
}

int main(int count, char **arguments) {
    Options options = {.math = HD_MATH_STRICT};
    Golden golden = {.fixed = false};
    Tally tally = {0};
    if (!parse_options(&options, count, arguments)) {
        fprintf(stderr, "usage: hedron_conformance [--golden FILE] [--write-golden] "
                        "[--math strict|fast] [--backend NAME] [--pictures FOLDER]\n");
        return 2;
    }
    if (options.golden != NULL && !options.write_golden && !read_golden(&golden, options.golden))
        return 1;
    /* The plain C backend first: it is always there. */
    for (int i = HD_BACKEND_COUNT - 1; i >= 0; i--)
        if (options.backend == NULL || strcmp(hd_backends[i]->name, options.backend) == 0)
            check_backend(hd_backends[i], &options, &golden, &tally);
    print_hashes(&golden);
    printf("\n%d renderers, %d frames, %d different; %d truths, %d untrue\n", tally.renderers,
           tally.frames, tally.different, tally.truths, tally.untrue);
    if (options.write_golden && !write_golden(&golden, options.golden))
        return 1;
    return tally.renderers > 0 && tally.different == 0 && tally.untrue == 0 ? 0 : 1;
}
