/* SPDX-License-Identifier: MIT */
/* Which frames of a run are finished already: those whose pictures are all there, whole, and marked
   with the fingerprint that they would get (mark.h). */
#ifndef HD_OUTPUT_RESUME_H
#define HD_OUTPUT_RESUME_H

#include <stdbool.h>

#include "base/error.h"
#include "image/frame.h"
#include "output/outputs.h"
#include "scene/frame_list.h"

typedef struct HdResume {
    const HdFrameList *all;
    HdFrameList missing; /* the frames that have to be rendered */
    bool *is_finished;   /* owned; by place in `all` */
    int finished_count;
    int first_missing; /* place in `all`; so many frames before it are finished */
} HdResume;

/* Looks at the pictures of a settled plan. No frame counts as finished where the plan does not
   resume. The list must live on. HD_INTERRUPTED where a signal came (interrupt.h). To be freed in
   any case. */
HdStatus hd_resume_find(HdResume *resume, const HdOutputPlan *plan, const HdFrameList *frames,
                        HdError *error);

/* Reads a finished frame back into `frame`, encoded (`rgba`), as films take it. HD_FAILED where its
   picture has changed since. */
HdStatus hd_resume_load(const HdOutputPlan *plan, int number, HdFrame *frame, HdError *error);

void hd_resume_free(HdResume *resume);

#endif
