/* SPDX-License-Identifier: MIT */
/* Finds results of earlier runs. A frame is finished if all its pictures are complete and bear its
   fingerprint. Each film must also have it in a complete segment, or be able to read it back from a
   picture. */
#ifndef HD_OUTPUT_RESUME_H
#define HD_OUTPUT_RESUME_H

#include <stdbool.h>

#include "base/error.h"
#include "image/frame.h"
#include "output/film.h"
#include "output/outputs.h"
#include "scene/frame_list.h"

typedef struct HdResume {
    const HdFrameList *all;
    HdFrameList missing; /* frames to render */
    bool *is_finished;   /* owned; by index in `all` */
    int finished_count;
    HdSegments films[HD_MAX_OUTPUTS]; /* segments by output */
    int first_missing;                /* number of finished frames at the start of `all` */
} HdResume;

/* Examines the pictures and films of a settled plan; no frame is finished unless the plan resumes.
   The list must live on. Fails with HD_INTERRUPTED after a signal (interrupt.h). Free `resume` also
   after a failure. */
HdStatus hd_resume_find(HdResume *resume, const HdOutputPlan *plan, const HdFrameList *frames,
                        HdError *error);

/* Returns whether the output is a film that lacks the frame at list index `item`. */
bool hd_resume_film_lacks(const HdResume *resume, int output, int item);

/* Returns whether each of the plan's films has the frame, or can get it from a picture. */
bool hd_resume_keeps(const HdResume *resume, const HdOutputPlan *plan, int item);

/* Reads a finished frame back into `frame`, encoded (`rgba`) as films need it. Fails with HD_FAILED
   if its picture has changed. */
HdStatus hd_resume_load(const HdOutputPlan *plan, int number, HdFrame *frame, HdError *error);

void hd_resume_free(HdResume *resume);

/* Removes temporary files (atomic_file.h) of dead processes for these frames' outputs and for
   segments of their films. Keeps those of live processes, which have them locked; this includes
   other machines if the file system shares locks. If a dead writer's child process still locks one,
   waits up to 10 s in all, or until an interrupt. Files that cannot be examined or removed stay. */
void hd_stale_files_remove(const HdOutputPlan *plan, const HdFrameList *frames);

#endif
