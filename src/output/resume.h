/* SPDX-License-Identifier: MIT */
/* What earlier runs left. Which frames of a run are finished already: those whose pictures are all
   there, whole, and bear the fingerprint that they would get, and which are in a whole
   segment of each film (film.h), or can be read back for it. */
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
    HdFrameList missing; /* the frames that have to be rendered */
    bool *is_finished;   /* owned; by place in `all` */
    int finished_count;
    HdSegments films[HD_MAX_OUTPUTS]; /* by output */
    int first_missing;                /* place in `all`; so many frames before it are finished */
} HdResume;

/* Looks at the pictures and films of a settled plan. No frame counts as finished where the plan
   does not resume. The list must live on. HD_INTERRUPTED where a signal came (interrupt.h). To be
   freed in any case. */
HdStatus hd_resume_find(HdResume *resume, const HdOutputPlan *plan, const HdFrameList *frames,
                        HdError *error);

/* Whether the output is a film and lacks the frame at that place of the list. */
bool hd_resume_film_lacks(const HdResume *resume, int output, int item);

/* Whether the films of the plan, if there are any, need the frame no more, or can get it from a
   picture. */
bool hd_resume_keeps(const HdResume *resume, const HdOutputPlan *plan, int item);

/* Reads a finished frame back into `frame`, encoded (`rgba`), as films take it. HD_FAILED where its
   picture has changed since. */
HdStatus hd_resume_load(const HdOutputPlan *plan, int number, HdFrame *frame, HdError *error);

void hd_resume_free(HdResume *resume);

/* Removes the temporary files (atomic_file.h) of these frames' outputs, and of segments of their
   films, whose writer is gone. Those of a living process stay, for it has them locked: on other
   machines too where the file system shares its locks. Where something that a writer had started
   still has one locked, waits for that, up to 10 s in all, or an interrupt. What cannot be looked
   at or removed stays too. */
void hd_stale_files_remove(const HdOutputPlan *plan, const HdFrameList *frames);

#endif
