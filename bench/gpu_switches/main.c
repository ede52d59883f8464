/* SPDX-License-Identifier: MIT */
/* Measures the switches for GPUs, interleaved in one process: every switch renders the scene's
   first frame once a round, and the bytes must be those of the first switch.

       hedron_gpu_switches [--backend NAME] [--device NUMBER] [--double] [--rounds N] [--seconds S]
                           [--only NAME,...] [--without NAME,...] [--threads N] SCENE [CHANGE...]

   A CHANGE is KEY=VALUE, as after --set. Prints

     scene NAME WIDTH HEIGHT RAYS
     time SWITCH MEDIAN Q1 Q3 RATIO      ms of tracing; multiple of the first switch
     kernels SWITCH SECONDS DESCRIPTION  time of compiling
     skip SWITCH REASON

   Exit codes: 0 done, 1 bytes differ or something failed, 2 wrong usage, 77 no such device. No
   round begins after S seconds of rendering (120). */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/renderer.h"
#include "input/check.h"
#include "input/files.h"
#include "input/scene_file.h"
#include "render/backends.h"
#include "render/frame.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "verify/trust.h"

enum { MAX_ROUNDS = 99, MAX_CHANGES = 32, MAX_SWITCHES = 64, SKIPPED = 77, USAGE = 2 };

/* A switch and what it changes of the program's own choice. */
typedef struct Switch {
    const char *name;
    HdPipeline pipeline;
    int registers, block; /* limits; 0: the program's choice */
    size_t queue_bytes;   /* memory of the wavefront; 0: the program's choice */
    bool is_bounded;      /* applies to scenes with an error bound only */
    bool is_cuda;         /* applies to CUDA only */
} Switch;

#define MEGA      .pipeline = HD_PIPELINE_MEGA
#define WAVEFRONT .pipeline = HD_PIPELINE_WAVEFRONT

#define GIB ((size_t)1 << 30)

/* The first one is the base of all comparisons. */
static const Switch switches[] = {
    {"mega", MEGA},
    {"registers-64", MEGA, .registers = 64, .is_cuda = true},
    {"registers-80", MEGA, .registers = 80, .is_cuda = true},
    {"registers-96", MEGA, .registers = 96, .is_cuda = true},
    {"registers-128", MEGA, .registers = 128, .is_cuda = true},
    {"block-32", MEGA, .block = 32},
    {"block-64", MEGA, .block = 64},
    {"block-256", MEGA, .block = 256},
    {"registers-64+block-32", MEGA, .registers = 64, .block = 32, .is_cuda = true},
    {"wavefront", WAVEFRONT},
    {"wavefront-4GiB", WAVEFRONT, .queue_bytes = 4 * GIB, .is_bounded = true},
    {"wavefront-16GiB", WAVEFRONT, .queue_bytes = 16 * GIB, .is_bounded = true},
};
enum { SWITCH_COUNT = sizeof switches / sizeof *switches };

typedef struct Bench {
    const HdBackend *backend;
    int number, rounds, threads;
    double seconds;
    const char *only, *without; /* names between commas; NULL: all, none */
    HdPrecision precision;
    HdDevice device;
    HdSceneFile file;
    HdCamera camera;
    HdFrame frame;
} Bench;

/* A switch with its renderer and times. */
typedef struct Contender {
    const Switch *is;
    HdFrameMaker maker;
    HdStatus status;
    HdError error;
    double build_seconds, ms[MAX_ROUNDS];
    int count;
} Contender;

/* ---- scene ---- */

static HdStatus read_scene(Bench *bench, const char *path, const HdSceneChange *changes, int count,
                           HdError *error) {
    HdSceneFile *file = &bench->file;
    const HdSceneSource source = {.changes = changes, .change_count = count, .loads_files = true};
    HD_TRY(hd_scene_file_read(file, path, &source, error));
    HD_TRY(hd_camera_at(&bench->camera, &file->scene, 0, error));
    return hd_frame_create(&bench->frame, file->scene.width, file->scene.height, error);
}

/* ---- contenders ---- */

static HdStatus open_contender(Contender *contender, const Bench *bench, HdError *error) {
    const Switch *is = contender->is;
    const HdRenderOptions options = {
        .block = is->block,
        .registers = is->registers,
        .precision = bench->precision,
        .pipeline = is->pipeline,
        .test = {.queue_bytes = is->queue_bytes},
    };
    HdFrameMaker *maker = &contender->maker;
    *maker = (HdFrameMaker){.scene = &bench->file.scene, .request = {true, HD_CURVE_SRGB, 0}};
    HD_TRY(hd_renderer_open(&maker->renderer, &bench->device, &options, error));
    HD_TRY(hd_put_scene(maker->renderer, maker->scene, NULL, error));
    return hd_frame_maker_open(maker, error);
}

typedef struct Opening {
    const Bench *bench;
    Contender *contenders;
} Opening;

static void open_one(void *context, int thread, int item) {
    const Opening *opening = context;
    Contender *contender = &opening->contenders[item];
    double start = hd_monotonic_seconds();
    (void)thread;
    contender->status = open_contender(contender, opening->bench, &contender->error);
    contender->build_seconds = hd_monotonic_seconds() - start;
}

static bool is_interrupted(const void *context) {
    (void)context;
    return hd_interrupt_signal() != 0;
}

/* Opens the first one alone, as it probes the device's arithmetic; the others side by side. */
static HdStatus open_all(const Bench *bench, Contender *contenders, int count, HdError *error) {
    Opening opening = {bench, contenders}, others = {bench, contenders + 1};
    HdThreadPool *pool;
    HD_TRY(hd_thread_pool_create(&pool, bench->threads, error));
    open_one(&opening, 0, 0);
    hd_thread_pool_run(pool, count - 1, open_one, &others, is_interrupted);
    hd_thread_pool_destroy(pool);
    return HD_OK;
}

/* ---- rounds ---- */

static bool render(Contender *contender, Bench *bench, uint64_t *hash) {
    HdFrameInFlight in_flight;
    HdStatus status =
        hd_frame_prepare(&contender->maker, &bench->camera, &in_flight, &contender->error);
    if (status == HD_OK)
        status = hd_frame_begin(&contender->maker, &in_flight, &contender->error);
    if (status == HD_OK)
        status = hd_frame_end(&contender->maker, &in_flight, &bench->frame, &contender->error);
    contender->status = status;
    *hash = status == HD_OK ? hd_frame_hash(&bench->frame) : 0;
    return status == HD_OK;
}

/* Runs a round; round -1 warms up. */
static int run_round(Bench *bench, Contender *contenders, int count, int round,
                     uint64_t *expected) {
    int different = 0;
    for (int i = 0; i < count; i++) {
        Contender *contender = &contenders[i];
        uint64_t hash;
        if (contender->status != HD_OK || !render(contender, bench, &hash))
            continue;
        if (*expected == 0)
            *expected = hash;
        if (hash != *expected) {
            printf("DIFFERENT %s %016" PRIx64 ", expected %016" PRIx64 "\n", contender->is->name,
                   hash, *expected);
            different++;
        }
        if (round >= 0)
            contender->ms[contender->count++] = 1000.0 * bench->frame.trace_seconds;
    }
    return different;
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double quantile(const Contender *contender, double q) {
    double place = q * (contender->count - 1);
    int below = (int)place, above = below + 1 < contender->count ? below + 1 : below;
    return contender->ms[below] + (place - below) * (contender->ms[above] - contender->ms[below]);
}

static void print_times(Contender *contenders, int count) {
    double first = 0.0;
    for (int i = 0; i < count; i++) {
        Contender *contender = &contenders[i];
        if (contender->count == 0)
            continue;
        qsort(contender->ms, (size_t)contender->count, sizeof *contender->ms, compare);
        double median = quantile(contender, 0.5);
        first = first > 0.0 ? first : median;
        printf("time %-24s %9.4f %9.4f %9.4f %7.3f\n", contender->is->name, median,
               quantile(contender, 0.25), quantile(contender, 0.75), median / first);
    }
}

/* Returns the number of pictures that differ or failed. */
static int measure(Bench *bench, Contender *contenders, int count) {
    uint64_t expected = 0;
    int wrong = run_round(bench, contenders, count, -1, &expected);
    printf("scene %d %d %" PRIu64 "\n", bench->frame.width, bench->frame.height,
           hd_frame_rays(&bench->frame));
    double start = hd_monotonic_seconds();
    for (int round = 0; round < bench->rounds; round++) {
        if (round > 0 && hd_monotonic_seconds() - start > bench->seconds)
            break;
        wrong += run_round(bench, contenders, count, round, &expected);
    }
    for (int i = 0; i < count; i++) {
        char text[512];
        if (contenders[i].status != HD_OK) {
            printf("skip %s %s\n", contenders[i].is->name, contenders[i].error.message);
        } else {
            hd_renderer_describe(contenders[i].maker.renderer, text, (int)sizeof text);
            printf("kernels %s %.1f %s\n", contenders[i].is->name, contenders[i].build_seconds,
                   text);
        }
        wrong += contenders[i].status != HD_OK && contenders[i].status != HD_UNAVAILABLE;
    }
    print_times(contenders, count);
    return wrong;
}

/* ---- command line ---- */

/* Returns whether the name is in a list separated by commas. */
static bool is_named(const char *names, const char *name) {
    size_t length = strlen(name);
    for (const char *at = names; at != NULL; at = strchr(at, ',')) {
        at += *at == ',';
        if (strncmp(at, name, length) == 0 && (at[length] == ',' || at[length] == '\0'))
            return true;
    }
    return false;
}

static bool is_wanted(const Bench *bench, const Switch *is) {
    bool is_cuda = strcmp(bench->backend->name, "cuda") == 0;
    bool is_bounded = hd_scene_has_error_bound(&bench->file.scene);
    if ((is->is_cuda && !is_cuda) || (is->is_bounded && !is_bounded))
        return false;
    return (bench->only == NULL || is_named(bench->only, is->name)) &&
           (bench->without == NULL || !is_named(bench->without, is->name));
}

static bool find_device(Bench *bench) {
    HdDevice devices[HD_MAX_DEVICES];
    HdError error;
    int count = 0;
    if (hd_backend_enumerate(bench->backend, devices, HD_MAX_DEVICES, &count, &error) != HD_OK)
        printf("skip %s\n", error.message);
    for (int i = 0; i < count; i++)
        if (devices[i].index == bench->number && !devices[i].is_cpu) {
            bench->device = devices[i];
            return true;
        }
    return false;
}

static bool parse_option(Bench *bench, const char *name, const char *value) {
    if (strcmp(name, "--backend") == 0)
        return (bench->backend = hd_backend_find(value)) != NULL;
    if (strcmp(name, "--device") == 0)
        bench->number = atoi(value);
    else if (strcmp(name, "--rounds") == 0)
        bench->rounds = atoi(value);
    else if (strcmp(name, "--threads") == 0)
        bench->threads = atoi(value);
    else if (strcmp(name, "--seconds") == 0)
        bench->seconds = strtod(value, NULL);
    else if (strcmp(name, "--only") == 0)
        bench->only = value;
    else if (strcmp(name, "--without") == 0)
        bench->without = value;
    else
        return false;
    return bench->rounds > 0 && bench->rounds <= MAX_ROUNDS && bench->threads > 0;
}

/* Returns the scene's index among the arguments; 0 if they are wrong. */
static int parse(Bench *bench, int argc, char **argv) {
    int i = 1;
    for (; i < argc && strncmp(argv[i], "--", 2) == 0; i++) {
        if (strcmp(argv[i], "--double") == 0)
            bench->precision = HD_PRECISION_DOUBLE;
        else if (i + 1 >= argc || !parse_option(bench, argv[i], argv[i + 1]))
            return 0;
        else
            i++;
    }
    return i < argc && argc - i - 1 <= MAX_CHANGES ? i : 0;
}

int main(int argc, char **argv) {
    static Contender contenders[MAX_SWITCHES];
    static Bench bench;
    HdError error;
    int count = 0;
    bench = (Bench){.rounds = 7, .seconds = 120.0, .threads = hd_processor_count()};
    bench.backend = hd_backend_find("cuda");
    int scene = parse(&bench, argc, argv);
    if (scene == 0) {
        fprintf(stderr, "usage: hedron_gpu_switches [--backend NAME] [--device NUMBER] [--double] "
                        "[--rounds N] [--seconds S] [--only NAME,...] [--without NAME,...] "
                        "[--threads N] SCENE [KEY=VALUE...]\n");
        return USAGE;
    }
    if (!find_device(&bench))
        return SKIPPED;
    HdStatus status = read_scene(&bench, argv[scene], (const HdSceneChange *)(argv + scene + 1),
                                 argc - scene - 1, &error);
    for (int i = 0; i < SWITCH_COUNT; i++)
        if (status == HD_OK && is_wanted(&bench, &switches[i]))
            contenders[count++].is = &switches[i];
    if (status == HD_OK && count > 0)
        status = open_all(&bench, contenders, count, &error);
    if (status != HD_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    int wrong = count > 0 ? measure(&bench, contenders, count) : 0;
    for (int i = 0; i < count; i++) {
        hd_frame_maker_close(&contenders[i].maker);
        hd_renderer_close(contenders[i].maker.renderer);
    }
    hd_frame_free(&bench.frame);
    hd_scene_file_free(&bench.file);
    return wrong > 0 ? 1 : 0;
}
