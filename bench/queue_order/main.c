/* SPDX-License-Identifier: MIT */
/* What it gives to sort a wavefront's queue, on one thread. bench/study pipelines reads the output:

     build SET LANES
     order SCENE BATCH ORDER FIRST_RAYS RAYS BUNDLES TOUCHED MET     BATCH in samples
     time SCENE BATCH ORDER FIRST TRACE KEY SORT                     seconds; a line for each round

   BUNDLES and what follows are 0 for the order `product`. With --record it writes what every ray of
   the one scene's frame adds to the picture (order.h), and prints nothing.

   Ends with 0, 1 where a scene cannot be read or orders give different sums, 2 where it is called
   wrongly. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../kernel_rates/measures.h"
#include "order.h"

#define HD_BUILD_TYPE HdOrderBuild
#include "../kernel_rates/builds.h"

static const char *const order_names[HD_ORDER_COUNT] = {
    "product", "uncompacted", "appended", "segments", "touched", "touched_face", "met",
};

enum { MOST_SCENES = 8 };

/* Samples of a batch: an item of the headline scene, and what caches of the second and third level
   may hold. None is larger than all samples together. */
static const int batch_samples[] = {256, 4096, 65536};
enum { BATCH_SIZES = sizeof batch_samples / sizeof batch_samples[0] };

typedef struct Study {
    int rounds;
    int most_samples;
    const char *record;
    int scene_count;
    HdLoopScene scenes[MOST_SCENES];
} Study;

static bool run_order(const HdOrderBuild *build, const HdLoopScene *scene, HdBatches batches,
                      HdQueueOrder order, bool counts, HdOrderResult *result) {
    if (build->run(hd_loop_scene_tables(scene, build->lanes), scene->frame.table, order, batches,
                   counts, result))
        return true;
    fprintf(stderr, "hedron_queue_order: there is no memory for batches of %d\n", batches.samples);
    return false;
}

static bool count_order(const HdOrderBuild *build, const HdLoopScene *scene, HdBatches batches,
                        HdQueueOrder order, uint64_t *digest) {
    HdOrderResult result;
    if (!run_order(build, scene, batches, order, true, &result))
        return false;
    if (order > 0 && result.digest != *digest) {
        fprintf(stderr, "hedron_queue_order: %s, batches of %d: the order %s gives other sums\n",
                scene->name, batches.samples, order_names[order]);
        return false;
    }
    *digest = result.digest;
    printf("order %s %d %s %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n",
           scene->name, batches.samples, order_names[order], result.first_rays, result.rays,
           result.bundles, result.touched, result.met);
    return true;
}

static bool time_order(const HdOrderBuild *build, const HdLoopScene *scene, HdBatches batches,
                       HdQueueOrder order) {
    HdOrderResult result;
    if (!run_order(build, scene, batches, order, false, &result))
        return false;
    printf("time %s %d %s %.6e %.6e %.6e %.6e\n", scene->name, batches.samples, order_names[order],
           result.first_seconds, result.trace_seconds, result.key_seconds, result.sort_seconds);
    return true;
}

/* Every order once a round, so that a slow minute of the machine meets all of them. Round 0 counts
   and compares. */
static bool study_scene(const Study *study, const HdOrderBuild *build, const HdLoopScene *scene) {
    uint64_t digests[BATCH_SIZES] = {0};
    for (int round = 0; round <= study->rounds; round++)
        for (int size = 0; size < BATCH_SIZES; size++) {
            if (batch_samples[size] > study->most_samples)
                continue;
            HdBatches batches = {batch_samples[size], study->most_samples};
            for (int order = 0; order < HD_ORDER_COUNT; order++)
                if (!(round == 0
                          ? count_order(build, scene, batches, (HdQueueOrder)order, digests + size)
                          : time_order(build, scene, batches, (HdQueueOrder)order)))
                    return false;
        }
    return true;
}

static bool record(const HdOrderBuild *build, const HdLoopScene *scene, const char *path) {
    FILE *file = fopen(path, "wb");
    bool done = file != NULL &&
                build->record(hd_loop_scene_tables(scene, build->lanes), scene->frame.table, file);
    if (file != NULL && fclose(file) != 0)
        done = false;
    if (!done)
        fprintf(stderr, "hedron_queue_order: cannot write %s, or there is no memory\n", path);
    return done;
}

static bool read_scene(Study *study, const char *path) {
    HdLoopScene *scene = &study->scenes[study->scene_count];
    if (!hd_loop_scene_read(scene, path, true, find_build(false)->lanes)) {
        hd_loop_scene_free(scene);
        return false;
    }
    study->scene_count++;
    return true;
}

/* 0, or an exit code. */
static int read_arguments(Study *study, int count, char **words) {
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--rounds") == 0 && i + 1 < count)
            study->rounds = atoi(words[++i]);
        else if (strcmp(words[i], "--samples") == 0 && i + 1 < count)
            study->most_samples = atoi(words[++i]);
        else if (strcmp(words[i], "--record") == 0 && i + 1 < count)
            study->record = words[++i];
        else if (words[i][0] == '-' || study->scene_count == MOST_SCENES)
            return 2;
        else if (!read_scene(study, words[i]))
            return 1;
    }
    bool right = study->most_samples > 0 &&
                 (study->record == NULL ? study->scene_count > 0 : study->scene_count == 1);
    return right ? 0 : 2;
}

int main(int count, char **words) {
    static Study study = {.rounds = 3, .most_samples = 1 << 19};
    int code = read_arguments(&study, count, words);
    const HdOrderBuild *build = find_build(false);
    if (code == 2)
        fprintf(stderr, "usage: hedron_queue_order [--rounds N] [--samples N] SCENE.json...\n"
                        "       hedron_queue_order --record FILE SCENE.json\n");
    if (code == 0 && study.record != NULL)
        code = record(build, &study.scenes[0], study.record) ? 0 : 1;
    else if (code == 0)
        printf("build %s %d\n", build->instruction_set, build->lanes);
    for (int i = 0; code == 0 && study.record == NULL && i < study.scene_count; i++)
        code = study_scene(&study, build, &study.scenes[i]) ? 0 : 1;
    for (int i = 0; i < study.scene_count; i++)
        hd_loop_scene_free(&study.scenes[i]);
    return code;
}
