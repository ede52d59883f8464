/* SPDX-License-Identifier: MIT */
/* A line of JSON about each frame (docs/formats.md). */
#ifndef HD_CLI_STATISTICS_H
#define HD_CLI_STATISTICS_H

#include <stdio.h>

#include "base/error.h"
#include "device/renderer.h"
#include "render/sequence.h"
#include "scene/scene.h"
#include "system/path.h"

/* What is the same for every frame that a device traced. */
typedef struct HdRunFacts {
    const HdScene *scene;
    const HdDevice *device;
    const char *renderer; /* hd_renderer_describe's line */
} HdRunFacts;

typedef struct HdStatistics {
    FILE *stream;
    char name[HD_MAX_PATH]; /* for messages */
} HdStatistics;

/* Refuses a file that the run reads or writes otherwise, and one that begins as JSON but not as
   statistics do: where FILE is forgotten, a scene comes next. Nothing is opened for writing. */
HdStatus hd_statistics_check(const char *path, const char *scene, const HdOutputPlan *plan,
                             int frame_number, HdError *error);

/* Opens a file anew, "-" being standard output; makes missing folders. */
HdStatus hd_statistics_open(HdStatistics *statistics, const char *path, HdError *error);

/* Writes and flushes one line. Numbers have a decimal point in every locale. */
HdStatus hd_statistics_add(HdStatistics *statistics, const HdRunFacts *facts,
                           const HdStoredFrame *stored, HdError *error);

HdStatus hd_statistics_close(HdStatistics *statistics, HdError *error);

#endif
