/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "measures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "input/check.h"
#include "input/files.h"
#include "input/scene_file.h"

enum { PEAK_ROUNDS = 1 << 16 };

static bool compile(HdLoopScene *scene, HdSceneFile *file, int lanes, HdError *error) {
    HdCamera camera;
    HdProblems problems = {0};
    return hd_scene_file_load_texture(file, error) == HD_OK &&
           hd_scene_file_load_meshes(file, &problems, NULL, error) == HD_OK &&
           hd_problems_status(&problems, scene->name, error) == HD_OK &&
           hd_scene_validate(&file->scene, error) == HD_OK &&
           hd_camera_at(&camera, &file->scene, 0, error) == HD_OK &&
           hd_compile_scene(&scene->tables[0], &file->scene, HD_PRECISION_FLOAT, lanes, error) ==
               HD_OK &&
           hd_compile_scene(&scene->tables[1], &file->scene, HD_PRECISION_FLOAT, 1, error) ==
               HD_OK &&
           hd_compile_frame(&scene->frame, &file->scene, &camera, HD_PRECISION_FLOAT, error) ==
               HD_OK;
}

bool hd_loop_scene_read(HdLoopScene *scene, const char *path, bool floor, int lanes) {
    HdSceneSource source = {0};
    HdSceneFile file;
    HdError error;
    memset(scene, 0, sizeof *scene);
    const char *slash = strrchr(path, '/');
    scene->name = slash == NULL ? path : slash + 1;
    bool done = hd_scene_file_read(&file, path, &source, &error) == HD_OK;
    if (done) {
        file.scene.floor.present = file.scene.floor.present && floor;
        if (!file.scene.floor.present)
            file.texture_path[0] = '\0';
        done = compile(scene, &file, lanes, &error);
        hd_scene_file_free(&file);
    }
    if (!done)
        fprintf(stderr, "%s\n", error.message);
    return done;
}

void hd_loop_scene_free(HdLoopScene *scene) {
    hd_frame_tables_free(&scene->frame);
    for (int i = 0; i < 2; i++)
        hd_scene_tables_free(&scene->tables[i]);
}

const HdTable *hd_loop_scene_tables(const HdLoopScene *scene, int lanes) {
    return scene->tables[lanes == 1].table;
}

void hd_work_free(HdWork *work) {
    free(work->items);
    work->items = NULL;
    work->count = 0;
}

double hd_measure_run(const HdMeasure *measure) {
    static volatile double kept; /* so that no work is in vain */
    (void)kept;
    const HdLoops *loops = measure->loops;
    const HdLoopScene *scene = measure->scene;
    double sum = 0, done = (double)PEAK_ROUNDS * HD_PEAK_CHAINS;
    switch (measure->what) {
    case HD_MEASURE_SEARCH:
        kept = (double)loops->search(hd_loop_scene_tables(scene, loops->lanes), scene->frame.table,
                                     &measure->work);
        return (double)loops->live_rays(&measure->work);
    case HD_MEASURE_LIGHT:
        done = (double)loops->light(hd_loop_scene_tables(scene, loops->lanes), scene->frame.table,
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

/* Of this thread: what others do to the machine is not in it, but for caches and clocks. */
static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double hd_measure_rate(const HdMeasure *measure, double seconds) {
    hd_measure_run(measure); /* warms the caches */
    double start = processor_seconds(), end = start, done = 0;
    while (end - start < seconds) {
        done += hd_measure_run(measure);
        end = processor_seconds();
    }
    return done / (end - start);
}
