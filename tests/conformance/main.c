/* SPDX-License-Identifier: MIT */
/* The conformance suite: renders the fixed list of frames on every backend, device and lane count
   that opens, in float and double. It demands one hash for each frame and precision, the committed
   one, and another one of the first hits, which need general kernels. Then it renders with the
   other pipeline and with other launches (variants.h), and checks frames in flight
   (frames_in_flight.h).

   --write-golden FILE writes the first renderer's hashes instead. --backend, --lanes, --precision
   and --threads leave out the others. --one-build builds no scene's own kernels. --few renders only
   the frames that the least of the variants render, and checks no truths. --ptx 61 makes CUDA
   compile to PTX for compute_61, which the driver compiles for the device: so the text for a Pascal
   card runs on any newer one.

   --brief shortens the suite. Only a few frames are rendered by a scene's own kernels, by more
   lanes than a processor's default, and by variants that differ only in how the work is cut, which
   double leaves out. With more lanes than the default no scene has its own kernels, with fewer none
   has them in plain C, and compiled kernels then render no frame with an error bound. In double,
   compiled kernels leave out all lanes but one and the default, unless --lanes asks for others, and
   CPUs that work as GPUs.

   Exit codes: 0 equal, 1 differences, 2 wrong usage, 77 nothing of --backend opens. */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../options.h"
#include "base/hash.h"
#include "device/renderer.h"
#include "frames_in_flight.h"
#include "image/picture.h"
#include "render/backends.h"
#include "render_scene.h"
#include "truths.h"
#include "variants.h"
#include "verify/golden.h"

enum { MAX_FRAMES = 64, MAX_NAME = 64 };
/* Lane count at which each scene has its own kernels, if a CPU's are compiled for it. */
enum { OWN_BUILDS = 8 };

static const char usage[] =
    "usage: hedron_conformance [--write-golden FILE] [--math strict|fast]\n"
    "                          [--backend cuda|opencl|c] [--lanes 1|2|4|8|16]\n"
    "                          [--precision float|double] [--threads 1|2]\n"
    "                          [--one-build] [--few] [--brief] [--pictures FOLDER]\n"
    "                          [--ptx ARCHITECTURE] (of CUDA; 61: compute_61, a Pascal card's)\n";

/* Selections of frames; those with an error bound have kernels of their own. */
typedef enum Frames { FEW, NOT_BOUNDED, EVERY } Frames;

typedef struct Golden {
    HdGoldenHashes hashes[MAX_FRAMES][2];
    bool known[MAX_FRAMES][2];
} Golden;

typedef struct Options {
    const char *write_golden, *pictures;
    const HdBackend *backend; /* NULL: all */
    int lanes, precision;     /* an index into lane_counts, an HdPrecision; or ALL */
    int threads;              /* number of threads less one; or ALL */
    bool one_build, few, brief;
    int math;
    int ptx_arch; /* 0: machine code */
} Options;

typedef struct Tally {
    int renderers, frames, different, truths, untrue;
} Tally;

/* Reads the committed hashes; every frame must be there. */
static bool read_golden(Golden *golden) {
    bool good = true;
    for (int i = 0; i < hd_golden_frame_count; i++)
        for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++) {
            const char *name = hd_golden_frames[i].name;
            golden->known[i][p] =
                hd_golden_find_hashes(name, (HdPrecision)p, &golden->hashes[i][p]);
            if (!golden->known[i][p])
                fprintf(stderr, "tests/golden/frames.txt has no hashes of the frame '%s'\n", name);
            good = good && golden->known[i][p];
        }
    return good;
}

static void print_line(FILE *file, const Golden *golden, int frame) {
    const HdGoldenHashes *hash = golden->hashes[frame];
    fprintf(file, "%-20s %016" PRIx64 " %016" PRIx64 " %016" PRIx64 " %016" PRIx64 "\n",
            hd_golden_frames[frame].name, hash[0].frame, hash[1].frame, hash[0].first_hits,
            hash[1].first_hits);
}

static bool write_golden(const Golden *golden, const char *path) {
    for (int i = 0; i < hd_golden_frame_count; i++)
        if (!golden->known[i][HD_PRECISION_FLOAT] || !golden->known[i][HD_PRECISION_DOUBLE]) {
            fprintf(stderr, "%s: not written, for a precision was not rendered\n", path);
            return false;
        }
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
        return false;
    }
    for (int i = 0; i < hd_golden_frame_count; i++)
        print_line(file, golden, i);
    bool good = !ferror(file);
    good = fclose(file) == 0 && good;
    if (!good)
        fprintf(stderr, "%s: cannot be written\n", path);
    return good;
}

static void save_picture(const Options *options, const char *name, const HdFrame *frame) {
    HdError error;
    const HdPictureStyle style = {HD_CURVE_LINEAR, 8, false};
    char path[4096];
    if (options->pictures == NULL)
        return;
    snprintf(path, sizeof path, "%s/%s.png", options->pictures, name);
    if (hd_picture_write(frame, &style, path, &error) != HD_OK)
        fail(path, &error);
}

static HdGoldenHashes render_hashes(const Target *target, int number, const Options *options) {
    HdScene scene;
    HdCamera camera;
    HdError error;
    const char *name = hd_golden_frames[number].name;
    if (hd_golden_build(&hd_golden_frames[number], &scene, &camera, &error) != HD_OK)
        fail(name, &error);
    HdFrame frame = render_scene(target, &scene, &camera, name);
    const size_t firsts = (size_t)frame.width * (size_t)frame.height * (size_t)frame.first_floats;
    HdGoldenHashes hashes = {.frame = hd_frame_hash(&frame)};
    if (target->first_hits)
        hashes.first_hits = hd_hash_numbers(HD_HASH_START, frame.first,
                                            firsts * sizeof *frame.first, sizeof *frame.first);
    save_picture(options, name, &frame);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
    return hashes;
}

static void compare_hash(const Target *target, const char *name, uint64_t hash, uint64_t expected,
                         Tally *tally) {
    if (expected == hash)
        return;
    tally->different++;
    printf("DIFFERENT %-20s %016" PRIx64 ", expected %016" PRIx64 " on %s\n", name, hash, expected,
           target->label);
}

/* The first renderer, plain C's, knows all of it. */
static void compare_frame(const Target *target, int number, const Options *options, Golden *golden,
                          Tally *tally) {
    const HdPrecision precision = target->precision;
    const char *name = hd_golden_frames[number].name;
    const HdGoldenHashes hashes = render_hashes(target, number, options);
    HdGoldenHashes *expected = &golden->hashes[number][precision];
    char first[MAX_NAME];
    if (!golden->known[number][precision]) {
        *expected = hashes;
        golden->known[number][precision] = true;
    }
    tally->frames++;
    compare_hash(target, name, hashes.frame, expected->frame, tally);
    snprintf(first, sizeof first, "%s, met first,", name);
    if (target->first_hits)
        compare_hash(target, first, hashes.first_hits, expected->first_hits, tally);
}

static bool is_bounded(int frame) {
    HdScene scene;
    HdCamera camera;
    HdError error;
    if (hd_golden_build(&hd_golden_frames[frame], &scene, &camera, &error) != HD_OK)
        fail(hd_golden_frames[frame].name, &error);
    bool bounded = hd_scene_has_error_bound(&scene);
    hd_scene_free(&scene);
    return bounded;
}

/* Frames with an error bound come last, because kernels are built again for them. */
static void compare_frames(const Target *target, Frames frames, const Options *options,
                           Golden *golden, Tally *tally) {
    int different = tally->different, compared = tally->frames;
    for (int bounded = 0; bounded <= (frames != NOT_BOUNDED); bounded++)
        for (int i = 0; i < hd_golden_frame_count; i++)
            if ((frames != FEW || is_variant_frame(hd_golden_frames[i].name)) &&
                is_bounded(i) == bounded)
                compare_frame(target, i, options, golden, tally);
    printf("%-4s %2d frames  %s\n", different == tally->different ? "same" : "DIFF",
           tally->frames - compared, target->label);
    fflush(stdout);
}

static bool is_left_out(const Options *options, const HdRenderOptions *wanted) {
    return options->threads != ALL && wanted->threads != options->threads + 1;
}

/* Renders all frames and checks the truths, or only some of the frames. Looks for first hits if
   requested of the renderer. */
static void check_renderer(const HdDevice *device, const HdRenderOptions *wanted, Frames frames,
                           bool one_build, const Options *options, Golden *golden, Tally *tally) {
    HdError error;
    HdRenderOptions chosen = *wanted;
    Target target = {
        .precision = wanted->precision, .one_build = one_build, .first_hits = wanted->first_hits};
    char text[256], ptx[32] = "";
    const char *precision = precision_names[wanted->precision];
    if (is_left_out(options, wanted))
        return;
    chosen.test.ptx_arch = options->ptx_arch;
    if (options->ptx_arch > 0)
        snprintf(ptx, sizeof ptx, ", PTX for compute_%d", options->ptx_arch);
    HdStatus status = hd_renderer_open(&target.renderer, device, &chosen, &error);
    if (status == HD_UNAVAILABLE) {
        printf("skip            %s %s, %d lanes, %s: %s\n", device->backend->name, device->name,
               wanted->lanes, precision, error.message);
        return;
    }
    if (status != HD_OK)
        fail(device->name, &error);
    hd_renderer_describe(target.renderer, text, (int)sizeof text);
    snprintf(target.label, sizeof target.label, "%-6s %-6s %s (%s)%s%s", device->backend->name,
             precision, device->name, text, ptx, one_build ? ", one build" : "");
    if (frames != FEW)
        check_truths(&target, &tally->truths, &tally->untrue);
    check_frames_in_flight(&target, &tally->frames, &tally->different);
    compare_frames(&target, frames, options, golden, tally);
    tally->renderers++;
    hd_renderer_close(target.renderer);
}

/* Returns the largest lane count that renders all frames: with --brief a processor's default. */
static int max_lanes_for_all(const HdDevice *device, HdPrecision precision,
                             const Options *options) {
    const HdRenderOptions wanted = {.precision = precision};
    HdRenderer *renderer;
    HdError error;
    if (!options->brief || !device->is_cpu)
        return lane_counts[LANE_COUNTS - 1];
    if (hd_renderer_open(&renderer, device, &wanted, &error) != HD_OK)
        fail(device->name, &error);
    int lanes = hd_renderer_lanes(renderer);
    hd_renderer_close(renderer);
    return lanes;
}

/* There one kernel more costs nothing. */
static bool needs_no_build(const HdDevice *device) {
    return device->backend->functions->kernels == NULL;
}

static void check_lanes(const HdDevice *device, HdPrecision precision, const Options *options,
                        Golden *golden, Tally *tally) {
    int max_for_all = max_lanes_for_all(device, precision, options);
    for (int i = 0; i < (device->is_cpu ? LANE_COUNTS : 1); i++) {
        if (options->lanes != ALL && options->lanes != i)
            continue;
        HdRenderOptions wanted = {
            .lanes = lane_counts[i],
            .threads = 1 + i % 2,
            .precision = precision,
            .math = (HdMath)options->math,
            .pipeline = HD_PIPELINE_MEGA,
        };
        bool compiles = device->is_cpu && !needs_no_build(device);
        if (options->brief && options->lanes == ALL && compiles &&
            precision == HD_PRECISION_DOUBLE && i > 0 && lane_counts[i] != max_for_all)
            continue;
        bool has_own = compiles ? lane_counts[i] == OWN_BUILDS
                                : !options->brief || lane_counts[i] == max_for_all;
        bool own_builds = !options->one_build && lane_counts[i] <= max_for_all && has_own;
        Frames frames = options->few || lane_counts[i] > max_for_all ? FEW : EVERY;
        if (frames == EVERY && options->brief && compiles && lane_counts[i] < max_for_all)
            frames = NOT_BOUNDED;
        wanted.first_hits = true;
        if (options->brief || !own_builds)
            check_renderer(device, &wanted, frames, true, options, golden, tally);
        wanted.first_hits = needs_no_build(device);
        if (own_builds)
            check_renderer(device, &wanted, options->brief ? FEW : frames, false, options, golden,
                           tally);
    }
}

static void check_variants(const HdDevice *device, HdPrecision precision, const Options *options,
                           Golden *golden, Tally *tally) {
    for (int i = 0; i < variant_count; i++) {
        const Variant *variant = &variants[i];
        bool only_cut = options->brief &&
                        ((variant->frames & ONLY_CUT) != 0 || variant->kind == FOR_CPUS_AS_GPUS);
        if (options->lanes != ALL || !variant_suits(variant, device) ||
            (only_cut && precision == HD_PRECISION_DOUBLE))
            continue;
        HdRenderOptions wanted = variant->options;
        wanted.precision = precision;
        wanted.math = (HdMath)options->math;
        wanted.first_hits = needs_no_build(device) || (variant->frames & FIRST_HITS) != 0;
        bool only_few = options->few || only_cut || !(variant->frames & EVERY_FRAME);
        check_renderer(device, &wanted, only_few ? FEW : EVERY, true, options, golden, tally);
    }
}

static void check_device(const HdDevice *device, const Options *options, Golden *golden,
                         Tally *tally) {
    for (int p = HD_PRECISION_FLOAT; p <= HD_PRECISION_DOUBLE; p++)
        if (options->precision == ALL || options->precision == p) {
            check_lanes(device, (HdPrecision)p, options, golden, tally);
            check_variants(device, (HdPrecision)p, options, golden, tally);
        }
}

static void check_backend(const HdBackend *backend, const Options *options, Golden *golden,
                          Tally *tally) {
    HdDevice devices[HD_MAX_DEVICES];
    int count = find_devices(backend, devices);
    for (int i = 0; i < count; i++)
        check_device(&devices[i], options, golden, tally);
}

static bool parse(Options *options, int count, char **arguments) {
    static const char *const maths[] = {"strict", "fast", NULL}, *const threads[] = {"1", "2",
                                                                                     NULL};
    const Option list[] = {
        {"--write-golden", .text = &options->write_golden},
        {"--pictures", .text = &options->pictures},
        {"--backend", .backend = &options->backend},
        {"--math", .number = &options->math, .choices = maths},
        {"--lanes", .number = &options->lanes, .choices = lane_names},
        {"--precision", .number = &options->precision, .choices = precision_names},
        {"--threads", .number = &options->threads, .choices = threads},
        {"--ptx", .number = &options->ptx_arch},
        {"--one-build", .flag = &options->one_build},
        {"--few", .flag = &options->few},
        {"--brief", .flag = &options->brief},
        {.name = NULL},
    };
    if (!parse_options(list, count, arguments))
        return false;
    if (options->ptx_arch > 0)
        options->backend = &hd_backend_cuda;
    return true;
}

static void print_hashes(const Golden *golden) {
    printf("\n%-20s %-16s %-16s %-16s %-16s\n", "frame", "float", "double", "first hits",
           "in double");
    for (int i = 0; i < hd_golden_frame_count; i++)
        print_line(stdout, golden, i);
}

int main(int count, char **arguments) {
    Options options = {.math = HD_MATH_STRICT, .lanes = ALL, .precision = ALL, .threads = ALL};
    Golden golden = {0};
    Tally tally = {0};
    if (!parse(&options, count, arguments)) {
        fputs(usage, stderr);
        return EXIT_USAGE;
    }
    if (hd_golden_frame_count > MAX_FRAMES) {
        fprintf(stderr, "%d frames, expected at most %d: raise MAX_FRAMES\n", hd_golden_frame_count,
                (int)MAX_FRAMES);
        return 1;
    }
    if (options.write_golden == NULL && !read_golden(&golden))
        return 1;
    /* The plain C backend first: it always exists. */
    for (int i = HD_BACKEND_COUNT - 1; i >= 0; i--)
        if (options.backend == NULL || options.backend == hd_backends[i])
            check_backend(hd_backends[i], &options, &golden, &tally);
    if (tally.renderers == 0) {
        printf("\nnothing was rendered\n");
        return options.backend != NULL ? EXIT_SKIPPED : 1;
    }
    print_hashes(&golden);
    printf("\n%d renderers, %d frames, %d different; %d truths, %d untrue\n", tally.renderers,
           tally.frames, tally.different, tally.truths, tally.untrue);
    if (tally.different > 0 || tally.untrue > 0)
        return 1;
    return options.write_golden != NULL && !write_golden(&golden, options.write_golden) ? 1 : 0;
}
