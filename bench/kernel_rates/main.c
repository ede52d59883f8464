/* SPDX-License-Identifier: MIT */
/* Rates of the kernels' two hot loops on one thread, and the arithmetic peak beside them; or, with
   --count, the instructions that the loops execute. bench/study speed reads the output:

     build SET LANES
     rate NAME UNIT PER_CPU_SECOND           a line for each round
     counted NAME SET LANES SYMBOL AMOUNT    work that was stepped through, in the unit of its rate
     step NAME OFFSET TIMES                  an instruction of SYMBOL, as far from its first one
     uncounted NAME                          the system does not let a process be stepped

   Ends with 0, 1 where a scene cannot be read, 2 where it is called wrongly. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/kernel.h"
#include "measures.h"
#include "steps.h"

/* bench/CMakeLists.txt names the builds in HD_BUILDS. */
#define X(build) extern const HdLoops build;
HD_BUILDS
#undef X

/* Bundles of rays and of points: enough to be like the view, few enough for the second-level cache.
 */
enum { MOST_RAYS = 512, MOST_POINTS = 64 };
/* What is stepped through, which takes up to 0.2 ms an instruction. */
enum { COUNTED_RAYS = 24, COUNTED_POINTS = 4 };
enum { MOST_SCENES = 16, MOST_MEASURES = 64 };

typedef struct Bench {
    double seconds;
    int rounds;
    bool counts;
    int scene_count, measure_count;
    HdLoopScene scenes[MOST_SCENES]; /* the first has no floor, and rays search it */
    HdMeasure measures[MOST_MEASURES];
} Bench;

/* The build for this processor, with the lanes that it takes by itself or with one; where there is
   none, the program ends with a sentence. */
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
    fprintf(stderr, "the kernels were built for another processor than one with %s\n", best);
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
    measure.work = loops->make_rays(hd_loop_scene_tables(scene, loops->lanes), scene->frame.table,
                                    bench->counts ? COUNTED_RAYS : MOST_RAYS);
    add_measure(bench, measure, "search", "meeting");
}

static void add_light(Bench *bench, const HdLoops *loops, const HdLoopScene *scene) {
    char name[64];
    HdMeasure measure = {.unit = "pairs", .loops = loops, .scene = scene, .what = HD_MEASURE_LIGHT};
    measure.work = loops->make_points(hd_loop_scene_tables(scene, loops->lanes), scene->frame.table,
                                      bench->counts ? COUNTED_POINTS : MOST_POINTS);
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
    hd_measure_run(context);
}

static void count(HdMeasure *measure) {
    HdSteps steps;
    const HdLoops *loops = measure->loops;
    bool searches = measure->what == HD_MEASURE_SEARCH;
    uintptr_t start = searches ? (uintptr_t)loops->search : (uintptr_t)loops->light;
    if (hd_count_steps(&steps, start, run_once, measure)) {
        printf("counted %s %s %d %s %.0f\n", measure->name, loops->instruction_set, loops->lanes,
               searches ? loops->search_symbol : loops->light_symbol, hd_measure_run(measure));
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
                   hd_measure_rate(&bench->measures[i], bench->seconds));
}

static bool read_scene(Bench *bench, const char *path) {
    HdLoopScene *scene = &bench->scenes[bench->scene_count];
    if (!hd_loop_scene_read(scene, path, bench->scene_count > 0, find_build(false)->lanes)) {
        hd_loop_scene_free(scene);
        return false;
    }
    bench->scene_count++;
    return true;
}

/* 0, or an exit code. */
static int read_arguments(Bench *bench, int count, char **words) {
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--count") == 0)
            bench->counts = true;
        else if (strcmp(words[i], "--seconds") == 0 && i + 1 < count)
            bench->seconds = strtod(words[++i], NULL);
        else if (strcmp(words[i], "--rounds") == 0 && i + 1 < count)
            bench->rounds = atoi(words[++i]);
        else if (words[i][0] == '-' || bench->scene_count == MOST_SCENES)
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
        hd_work_free(&bench.measures[i].work);
    for (int i = 0; i < bench.scene_count; i++)
        hd_loop_scene_free(&bench.scenes[i]);
    return code;
}
