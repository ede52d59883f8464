/* SPDX-License-Identifier: MIT */
/* Where the frames of a run go, settled once: pictures, numbered sequences and films, several at
   once. */
#ifndef HD_OUTPUT_OUTPUTS_H
#define HD_OUTPUT_OUTPUTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "base/limits.h"
#include "image/picture.h"
#include "scene/frame_list.h"
#include "system/atomic_file.h"

typedef struct HdOutput {
    const char *name; /* of a film or a picture, or a sequence's pattern; as people wrote it */
    const HdFormat *format;
    bool is_film;
    bool is_numbered; /* a picture for each frame */
} HdOutput;

typedef struct HdOutputPlan {
    HdOutput list[HD_MAX_OUTPUTS];
    int count;
    int film_count;
    HdOutputStyle style;
    HdFrameRequest request;  /* what a frame must hold for all of them */
    bool bears_fingerprints; /* some are pictures of a format that can */
    bool can_resume;         /* frames can be finished before the run (resume.h) */
    bool has_fingerprint; /* those pictures bear their frame's, and films are made by segments that
                             stay when the run is ended */
    uint64_t fingerprint; /* of the run (fingerprint.h), where it has one */
    const char *scene;    /* what pictures say of the run (HdPictureLabel): the caller sets both */
    const char *options;
    bool resumes;            /* frames that are there are finished (resume.h) */
    HdDurability durability; /* of pictures and films; durable, unless the caller says otherwise */
} HdOutputPlan;

/* Checks that the name has an ending that tells what to write; `option` is for the message. */
HdStatus hd_output_check_name(const char *name, const char *option, HdError *error);

/* Finds out what each of the names, 1 to HD_MAX_OUTPUTS, stands for; they must live on. An ending
   that is of no format stands for the data format, as in the classic mode.
   HD_BAD_INPUT where one does not suit the number of frames, or is there twice, whatever the
   spelling, or is of a format that cannot have the style. The plan has no fingerprint yet. */
HdStatus hd_outputs_settle(HdOutputPlan *plan, const char *const *names, int count,
                           const HdOutputStyle *style, int frame_count, HdError *error);

/* Has the pictures that can hold layers get these, a set of HD_LAYER_BIT, besides alpha, which they
   always do. HD_BAD_INPUT, in terms of the option --layers, where no output can, or where they have
   a bound and the scene is not surveyed (hd_scene_has_error_bound). */
HdStatus hd_outputs_add_layers(HdOutputPlan *plan, unsigned layers, bool is_bounded,
                               HdError *error);

/* Has the plan's pictures bear the fingerprint, where they can; with `resumes` those that are there
   are kept, where that can be. Films are made by segments. `fingerprint` is the run's. */
void hd_outputs_set_fingerprint(HdOutputPlan *plan, uint64_t fingerprint, bool resumes);

/* The name that an output has for one frame, as people wrote it, and the file that it stands for.
 */
HdStatus hd_output_name(const HdOutput *output, int number, char out[HD_MAX_PATH], HdError *error);
HdStatus hd_output_file(const HdOutput *output, int number, char out[HD_MAX_PATH], HdError *error);

/* ---- the names of an output's frames, known again in a folder: so that one look at a folder finds
   what is there of them, however many they are ---- */

typedef struct HdFrameNames {
    const HdFrameList *frames; /* ascending, each once */
    char folder[HD_MAX_PATH];  /* of the entries that bear the number; with its last slash; empty:
                                  the  current one */
    char prefix[HD_MAX_PATH];  /* of such an entry's name, up to the number */
    char suffix[HD_MAX_PATH];  /* of its name, after the number */
    char rest[HD_MAX_PATH]; /* of the path after the entry, from its slash on; empty: the entry is
                               the file */
    int digits;             /* of the number at least; 0: there is none, all frames are one file */
} HdFrameNames;

/* The error is that of hd_output_file. `frames` must live on and have a frame. */
HdStatus hd_frame_names_find(HdFrameNames *names, const HdOutput *output, const HdFrameList *frames,
                             HdError *error);

/* The place in the list of the frame whose entry has this name of `length` bytes; negative: none
   has. Of a name that `is_cut` only the begin is known, and it may be any of the frames with such a
   begin. */
int hd_frame_names_place(const HdFrameNames *names, const char *entry, size_t length, bool is_cut);

#endif
