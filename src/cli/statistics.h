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
    FILE *stream;           /* NULL: it is not open */
    char name[HD_MAX_PATH]; /* of the file, or for messages; "": none are wanted */
    bool is_standard_output;
} HdStatistics;

/* "-" is standard output, NULL: none are wanted. Refuses a file that the run reads or writes
   otherwise, and one that begins as JSON but not as statistics do: where FILE is forgotten, a scene
   comes next. Nothing is opened. `scene` may be NULL. */
HdStatus hd_statistics_settle(HdStatistics *statistics, const char *path, const char *scene,
                              const HdOutputPlan *plan, int frame_number, HdError *error);

/* Truncates the file, if one is wanted; makes missing folders. */
HdStatus hd_statistics_open(HdStatistics *statistics, HdError *error);

/* Writes and flushes one line. Numbers have a decimal point in every locale. `line` is what the
   renderer said of itself (hd_renderer_describe). */
HdStatus hd_statistics_add(HdStatistics *statistics, const HdScene *scene, const HdDevice *device,
                           const char *line, const HdStoredFrame *stored, HdError *error);

/* Ends what was opened, if it was. With HD_DURABLE the file and its name are on the disk
   afterwards. `before` is how the run ended, which comes back where it failed, with its error
   untouched. */
HdStatus hd_statistics_close(HdStatistics *statistics, HdDurability durability, HdStatus before,
                             HdError *error);

#endif
