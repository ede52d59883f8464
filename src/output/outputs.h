/* SPDX-License-Identifier: MIT */
/* Where the frames of a run go: pictures, numbered sequences and films, several at once. */
#ifndef HD_OUTPUT_OUTPUTS_H
#define HD_OUTPUT_OUTPUTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "base/limits.h"
#include "image/frame.h"
#include "image/output_style.h"
#include "output/video.h"
#include "system/path.h"

typedef struct HdOutputPlan {
    const char *names[HD_MAX_OUTPUTS]; /* films, patterns of sequences, or pictures' names */
    int count;
    HdOutputStyle style;
    bool is_marked;       /* PNG pictures get a mark (picture_mark.h) */
    uint64_t fingerprint; /* of the run (frame_fingerprint.h), where they do */
    bool resumes;         /* frames whose marked pictures are there are finished (resume.h) */
} HdOutputPlan;

/* Checks that the name has an ending that tells what to write; `option` is for the message. */
HdStatus hd_output_check_name(const char *name, const char *option, HdError *error);

/* Checks that each output suits the number of frames, and that none is there twice, whatever the
   spelling. */
HdStatus hd_outputs_check(const HdOutputPlan *plan, int frame_count, HdError *error);

/* The name that an output of an accepted plan has for one frame, as people wrote it, and the file
   that it stands for. */
HdStatus hd_output_name(const char *name, int number, char out[HD_MAX_PATH], HdError *error);
HdStatus hd_output_file(const char *name, int number, char out[HD_MAX_PATH], HdError *error);

/* Whether some of the outputs are PNG pictures. */
bool hd_outputs_have_png(const HdOutputPlan *plan);

/* What a frame must hold for all outputs of the plan. */
HdFrameWish hd_outputs_wish(const HdOutputPlan *plan);

typedef struct HdOutputs HdOutputs;

/* Finds out before the first frame whether its pictures can be written, which makes their folders.
 */
HdStatus hd_outputs_probe(const HdOutputPlan *plan, int first_number, HdError *error);

/* Starts the films of a plan that was accepted; the plan must live on. On failure nothing is left
   behind. */
HdStatus hd_outputs_open(HdOutputs **outputs, const HdOutputPlan *plan, int width, int height,
                         HdError *error);

/* The plan that was opened. */
const HdOutputPlan *hd_outputs_plan(const HdOutputs *outputs);

/* The film that output `index` of the plan is; NULL: pictures. */
HdVideo *hd_outputs_film(const HdOutputs *outputs, int index);

/* How many of the outputs are films. */
int hd_outputs_film_count(const HdOutputs *outputs);

/* Ends the films and frees `outputs` in every case. A film that fails takes those after it with it;
   those before it stay. */
HdStatus hd_outputs_close(HdOutputs *outputs, HdError *error);

/* Drops the films and frees `outputs`; pictures stay. NULL is allowed. */
void hd_outputs_abort(HdOutputs *outputs);

#endif
