/* SPDX-License-Identifier: MIT */
/* Statistics: a line of JSON for each frame (docs/reference/statistics.md). */
#ifndef HD_CLI_STATISTICS_H
#define HD_CLI_STATISTICS_H

#include <stdio.h>

#include "base/error.h"
#include "device/renderer.h"
#include "run/sequence.h"
#include "scene/scene.h"
#include "system/path.h"

typedef struct HdStatistics {
    FILE *stream;           /* open stream, or NULL */
    char name[HD_MAX_PATH]; /* file name, or its name in messages; "": no statistics */
    bool is_standard_output;
} HdStatistics;

/* Chooses the file: "-" is standard output, NULL none. Refuses a file that the run reads or writes
   otherwise, and one that begins as JSON but not as statistics do: if FILE is forgotten, a scene
   comes next. Opens nothing. `scene` may be NULL. */
HdStatus hd_statistics_settle(HdStatistics *statistics, const char *path, const char *scene,
                              const HdOutputPlan *plan, int frame_number, HdError *error);

/* Truncates the file, if one is wanted; makes missing folders. */
HdStatus hd_statistics_open(HdStatistics *statistics, HdError *error);

/* Writes and flushes one line. Numbers have a decimal point in every locale. `line` is what the
   renderer's description (hd_renderer_describe). */
HdStatus hd_statistics_add(HdStatistics *statistics, const HdScene *scene, const HdDevice *device,
                           const char *line, const HdStoredFrame *stored, HdError *error);

/* Closes the file, if it is open. With HD_DURABLE the file and its name are on the disk afterwards.
   `before` is the run's status: a failure is returned, with its error unchanged. */
HdStatus hd_statistics_close(HdStatistics *statistics, HdDurability durability, HdStatus before,
                             HdError *error);

#endif
