/* SPDX-License-Identifier: MIT */
/* Measures the kernels' two hot loops and the arithmetic peak on one thread; with --count, counts
   the instructions that the loops execute. bench/study speed reads the output:

     build SET LANES
     rate NAME UNIT PER_CPU_SECOND           a line for each round
     counted NAME SET LANES SYMBOL AMOUNT    work of the stepped calls, in the unit of its rate
     step NAME OFFSET TIMES                  an instruction of SYMBOL, by its offset
     uncounted NAME                          the system does not allow stepping

   Exit codes: 0 done, 1 a scene cannot be read, 2 wrong usage. */
#define _GNU_SOURCE
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cpu/kernel.h"
#include "input/files.h"
#include "input/scene_file.h"
#include "loops.h"

/* bench/CMakeLists.txt names the builds in HD_BUILDS. */
#define X(build) extern const HdLoops build;
HD_BUILDS
#undef X

/* Numbers of packets and of points: enough to represent the view, few enough for the second-level
   cache. */
enum { MAX_RAYS = 512, MAX_POINTS = 64 };
/* Numbers when stepping, which takes up to 0.2 ms an instruction. */
enum { COUNTED_RAYS = 24, COUNTED_POINTS = 4 };
enum { MAX_SCENES = 16, MAX_MEASURES = 64 };

/* The tables of a scene's first frame. */
typedef struct HdLoopScene {
    const char *name;        /* name of its file, without folder and ending */
    HdSceneTables tables[2]; /* tables for packets; for single lanes */
    HdFrameTables frame;
} HdLoopScene;

typedef struct HdMeasure {
    char name[96];
    const char *unit; /* unit of the work */
    const HdLoops *loops;
    const HdLoopScene *scene; /* NULL: an arithmetic peak */
    HdWork work;
    enum { HD_MEASURE_SEARCH, HD_MEASURE_LIGHT, HD_MEASURE_FMA, HD_MEASURE_MUL_ADD } what;
} HdMeasure;

typedef struct Bench {
    double seconds;
    int rounds;
    bool counts;
    int scene_count, measure_count;
    HdLoopScene scenes[MAX_SCENES]; /* the first has no floor, and rays search it */
    HdMeasure measures[MAX_MEASURES];
} Bench;

/* ---- counting the instructions that a function executes, one by one ---- */

/* Execution counts of instructions, by offset from a function's first one. */
typedef struct HdSteps {
    uint32_t *times; /* owned */
    long size;       /* offsets from 0 to size - 1 are watched */
} HdSteps;

/* The largest function that is watched, in bytes. */
enum { WATCHED_BYTES = 1 << 20 };

#if defined(__linux__) && defined(__x86_64__)

static _Noreturn void run_child(void (*work)(void *), void *context) {
    if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0)
        _exit(1);
    raise(SIGSTOP);
    work(context);
    _exit(0);
}

/* Steps the stopped child to its end. */
static bool trace_and_shade(HdSteps *steps, uintptr_t start, pid_t child) {
    int status;
    while (ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) == 0 &&
           waitpid(child, &status, 0) == child) {
        if (!WIFSTOPPED(status))
            return WIFEXITED(status) && WEXITSTATUS(status) == 0;
        long place =
            ptrace(PTRACE_PEEKUSER, child, (void *)offsetof(struct user_regs_struct, rip), NULL);
        uintptr_t offset = (uintptr_t)place - start;
        if (offset < (uintptr_t)steps->size)
            steps->times[offset]++;
    }
    return false;
}

/* Runs work(context) in a child process, instruction by instruction, and counts those from `start`
   on. Returns false if the system does not allow it. The caller frees `steps->times` either way. */
static bool count_steps(HdSteps *steps, uintptr_t start, void (*work)(void *), void *context) {
    int status;
    steps->size = WATCHED_BYTES;
    steps->times = calloc(WATCHED_BYTES, sizeof *steps->times);
    if (steps->times == NULL)
        return false;
    pid_t child = fork();
    if (child == 0)
        run_child(work, context);
    if (child < 0 || waitpid(child, &status, 0) != child)
        return false;
    return WIFSTOPPED(status) && trace_and_shade(steps, start, child);
}

#else

static bool count_steps(HdSteps *steps, uintptr_t start, void (*work)(void *), void *context) {
    (void)start;
    (void)work;
    (void)context;
    steps->times = NULL;
    steps->size = 0;
    return false;
}

#endif

/* ---- a measurement ---- */

enum { PEAK_ROUNDS = 1 << 16 };

static bool compile(HdLoopScene *scene, HdSceneFile *file, int lanes, HdError *error) {
    HdCamera camera;
    return hd_camera_at(&camera, &file->scene, 0, error) == HD_OK &&
           hd_compile_scene(&scene->tables[0], &file->scene, HD_PRECISION_FLOAT, lanes, error) ==
               HD_OK &&
           hd_compile_scene(&scene->tables[1], &file->scene, HD_PRECISION_FLOAT, 1, error) ==
               HD_OK &&
           hd_compile_frame(&scene->frame, &file->scene, &camera, HD_PRECISION_FLOAT, NULL,
                            error) == HD_OK;
}

/* Reads a scene file for packets of so many lanes, without its floor unless `floor`. Prints the
   problem and returns false on failure. */
static bool read_loop_scene(HdLoopScene *scene, const char *path, bool floor, int lanes) {
    const HdSceneSource source = {.loads_files = true};
    HdSceneFile file;
    HdError error;
    memset(scene, 0, sizeof *scene);
    const char *slash = strrchr(path, '/');
    scene->name = slash == NULL ? path : slash + 1;
    bool done = hd_scene_file_read(&file, path, &source, &error) == HD_OK;
    if (done) {
        file.scene.floor.present = file.scene.floor.present && floor;
        done = compile(scene, &file, lanes, &error);
        hd_scene_file_free(&file);
    }
    if (!done)
        fprintf(stderr, "%s\n", error.message);
    return done;
}

static void free_loop_scene(HdLoopScene *scene) {
    hd_frame_tables_free(&scene->frame);
    for (int i = 0; i < 2; i++)
        hd_scene_tables_free(&scene->tables[i]);
}

/* Returns the table for kernels of so many lanes: those that it was read for, or one. */
static const HdTable *tables_for(const HdLoopScene *scene, int lanes) {
    return scene->tables[lanes == 1].table;
}

/* Does the measurement's work once, and returns its amount in its unit. */
static double run_measure(const HdMeasure *measure) {
    static volatile double kept; /* keeps the compiler from removing the work */
    (void)kept;
    const HdLoops *loops = measure->loops;
    const HdLoopScene *scene = measure->scene;
    double sum = 0, done = (double)PEAK_ROUNDS * HD_PEAK_CHAINS;
    switch (measure->what) {
    case HD_MEASURE_SEARCH:
        kept = (double)loops->search(tables_for(scene, loops->lanes), scene->frame.table,
                                     &measure->work);
        return (double)loops->live_rays(&measure->work);
    case HD_MEASURE_LIGHT:
        done = (double)loops->light(tables_for(scene, loops->lanes), scene->frame.table,
                                    &measure->work, &sum);
        break;
    case HD_MEASURE_FMA:
        sum = loops->multiply_adds(PEAK_ROUNDS);
        break;
    case HD_MEASURE_MUL_ADD:
        sum = loops->multiplications_and_additions(PEAK_ROUNDS);
        break;
    }
    kept = sum;
    return done;
}

/* Returns this thread's seconds: other programs affect them only through caches and clocks. */
static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Returns the work for a second of processor time, measured over at least `seconds`. */
static double rate_of(const HdMeasure *measure, double seconds) {
    run_measure(measure); /* warms the caches */
    double start = processor_seconds(), end = start, done = 0;
    while (end - start < seconds) {
        done += run_measure(measure);
        end = processor_seconds();
    }
    return done / (end - start);
}

/* ---- all measurements ---- */

/* Returns the build for this processor, with its usual lanes or with one lane; ends the program
   with a message if there is none. */
static const HdLoops *find_build(bool one_lane) {
    static const HdLoops *const builds[] = {
#define X(build) &build,
        HD_BUILDS
#undef X
    };
    const char *best = hd_cpu_best_instruction_set();
    if (one_lane && strcmp(best, "avx512") == 0)
        best = "avx2";
    for (size_t i = 0; i < sizeof builds / sizeof *builds; i++)
        if (strcmp(builds[i]->instruction_set, best) == 0 && (!one_lane || builds[i]->lanes == 1))
            return builds[i];
    fprintf(stderr, "no kernels were built for a processor with %s\n", best);
    exit(1);
}

static void add_measure(Bench *bench, HdMeasure measure, const char *group, const char *name) {
    snprintf(measure.name, sizeof measure.name, "%s%s:%s", group,
             bench->counts && measure.loops->lanes == 1 ? "_one_lane" : "", name);
    if (measure.scene != NULL && measure.work.count == 0)
        return;
    bench->measures[bench->measure_count++] = measure;
}

static void add_search(Bench *bench, const HdLoops *loops) {
    const HdLoopScene *scene = &bench->scenes[0];
    HdMeasure measure = {
        .unit = "searches", .loops = loops, .scene = scene, .what = HD_MEASURE_SEARCH};
    measure.work = loops->make_rays(tables_for(scene, loops->lanes), scene->frame.table,
                                    bench->counts ? COUNTED_RAYS : MAX_RAYS);
    add_measure(bench, measure, "search", "meeting");
}

static void add_light(Bench *bench, const HdLoops *loops, const HdLoopScene *scene) {
    char name[64];
    HdMeasure measure = {.unit = "pairs", .loops = loops, .scene = scene, .what = HD_MEASURE_LIGHT};
    measure.work = loops->make_points(tables_for(scene, loops->lanes), scene->frame.table,
                                      bench->counts ? COUNTED_POINTS : MAX_POINTS);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(scene->name, "."), scene->name);
    add_measure(bench, measure, "light", name);
}

static void add_peaks(Bench *bench, const HdLoops *loops) {
    HdMeasure measure = {.unit = "instructions", .loops = loops, .what = HD_MEASURE_FMA};
    add_measure(bench, measure, "peak", "fma");
    measure.what = HD_MEASURE_MUL_ADD;
    add_measure(bench, measure, "peak", "mul_add");
}

static void add_measures(Bench *bench) {
    for (int one_lane = 0; one_lane <= (bench->counts ? 1 : 0); one_lane++) {
        const HdLoops *loops = find_build(one_lane);
        add_search(bench, loops);
        for (int i = 1; i < bench->scene_count; i++)
            add_light(bench, loops, &bench->scenes[i]);
        if (!one_lane)
            add_peaks(bench, loops);
    }
}

static void run_once(void *context) {
    run_measure(context);
}

static void count(HdMeasure *measure) {
    HdSteps steps;
    const HdLoops *loops = measure->loops;
    bool searches = measure->what == HD_MEASURE_SEARCH;
    uintptr_t start = searches ? (uintptr_t)loops->search : (uintptr_t)loops->light;
    if (count_steps(&steps, start, run_once, measure)) {
        printf("counted %s %s %d %s %.0f\n", measure->name, loops->instruction_set, loops->lanes,
               searches ? loops->search_symbol : loops->light_symbol, run_measure(measure));
        for (long i = 0; i < steps.size; i++)
            if (steps.times[i] > 0)
                printf("step %s %ld %lu\n", measure->name, i, (unsigned long)steps.times[i]);
    } else {
        printf("uncounted %s\n", measure->name);
    }
    free(steps.times);
}

static void measure_all(Bench *bench) {
    const HdLoops *loops = find_build(false);
    printf("build %s %d\n", loops->instruction_set, loops->lanes);
    for (int i = 0; i < bench->measure_count && bench->counts; i++)
        if (bench->measures[i].scene != NULL)
            count(&bench->measures[i]);
    for (int round = 0; round < bench->rounds; round++)
        for (int i = 0; i < bench->measure_count; i++)
            printf("rate %s %s %.6e\n", bench->measures[i].name, bench->measures[i].unit,
                   rate_of(&bench->measures[i], bench->seconds));
}

static bool read_scene(Bench *bench, const char *path) {
    HdLoopScene *scene = &bench->scenes[bench->scene_count];
    if (!read_loop_scene(scene, path, bench->scene_count > 0, find_build(false)->lanes)) {
        free_loop_scene(scene);
        return false;
    }
    bench->scene_count++;
    return true;
}

/* Returns 0, or an exit code. */
static int read_arguments(Bench *bench, int count, char **words) {
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--count") == 0)
            bench->counts = true;
        else if (strcmp(words[i], "--seconds") == 0 && i + 1 < count)
            bench->seconds = strtod(words[++i], NULL);
        else if (strcmp(words[i], "--rounds") == 0 && i + 1 < count)
            bench->rounds = atoi(words[++i]);
        else if (words[i][0] == '-' || bench->scene_count == MAX_SCENES)
            return 2;
        else if (!read_scene(bench, words[i]))
            return 1;
    }
    return bench->scene_count > 0 ? 0 : 2;
}

int main(int count, char **words) {
    static Bench bench = {.seconds = 0.2, .rounds = 3};
    int code = read_arguments(&bench, count, words);
    if (code == 2)
        fprintf(stderr,
                "usage: hedron_kernel_rates [--seconds S] [--rounds N] [--count] SCENE.json "
                "[SCENE_WITH_LIGHTS.json...]\n");
    if (code == 0) {
        add_measures(&bench);
        measure_all(&bench);
    }
    for (int i = 0; i < bench.measure_count; i++)
        free(bench.measures[i].work.items);
    for (int i = 0; i < bench.scene_count; i++)
        free_loop_scene(&bench.scenes[i]);
    return code;
}
