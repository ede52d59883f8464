/* SPDX-License-Identifier: MIT */
/* Outputs of a run, settled once: pictures, numbered sequences and films, several in one run. */
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
    const char *name; /* name of a film or picture, or a sequence's pattern, as the user wrote it */
    const HdFormat *format;
    bool is_film;
    bool is_numbered; /* one picture per frame */
} HdOutput;

typedef struct HdOutputPlan {
    HdOutput list[HD_MAX_OUTPUTS];
    int count;
    int film_count;
    HdOutputStyle style;
    HdFrameRequest request;  /* contents of a frame that satisfy all outputs */
    bool has_layers;         /* some outputs can hold layers */
    bool bears_fingerprints; /* formats of some pictures can */
    bool can_resume;         /* frames can be finished before the run (resume.h) */
    bool has_fingerprint; /* those pictures bear their frame's, and films are made in segments that
                             stay if the run is interrupted */
    uint64_t fingerprint; /* fingerprint of the run (fingerprint.h), if any */
    const char *scene;    /* label of the pictures (HdPictureLabel), set by the caller */
    const char *options;
    HdCrop crop;
    HdVec3 background;
    bool resumes;            /* existing frames count as finished (resume.h) */
    HdDurability durability; /* durability of the files; durable unless the caller changes it */
} HdOutputPlan;

/* Checks that the name's ending is that of a format; the message names `option`. */
HdStatus hd_output_check_name(const char *name, const char *option, HdError *error);

/* Settles the outputs of 1 to HD_MAX_OUTPUTS names, which must live on. An unknown ending means the
   data format, as in the classic mode. Fails with HD_BAD_INPUT if a name does not suit the number
   of frames, if two names mean the same file, or if a format cannot have the style. The plan has no
   fingerprint yet. */
HdStatus hd_outputs_settle(HdOutputPlan *plan, const char *const *names, int count,
                           const HdOutputStyle *style, int frame_count, HdError *error);

/* Adds layers, a set of HD_LAYER_BIT, to pictures that can hold them; alpha is always there. Fails
   with HD_BAD_INPUT, in terms of --layers, if no output can hold them, or if they include a bound
   and the scene has none (hd_scene_has_error_bound). */
HdStatus hd_outputs_add_layers(HdOutputPlan *plan, unsigned layers, bool is_bounded,
                               HdError *error);

/* Gives pictures that can bear it the run's fingerprint, and makes films in segments. With
   `resumes`, keeps finished ones if possible. */
void hd_outputs_set_fingerprint(HdOutputPlan *plan, uint64_t fingerprint, bool resumes);

/* Write the output's name for one frame, as the user wrote it, and its file. */
HdStatus hd_output_name(const HdOutput *output, int number, char out[HD_MAX_PATH], HdError *error);
HdStatus hd_output_file(const HdOutput *output, int number, char out[HD_MAX_PATH], HdError *error);

/* ---- recognises the names of an output's frames in a folder, so that one listing finds all that
   exist ---- */

typedef struct HdFrameNames {
    const HdFrameList *frames; /* ascending, without repetition */
    char folder[HD_MAX_PATH];  /* folder of the entries with the number, with its last slash; empty:
                                  the current one */
    char prefix[HD_MAX_PATH];  /* start of the entry's name, before the number */
    char suffix[HD_MAX_PATH];  /* end of its name, after the number */
    char rest[HD_MAX_PATH]; /* path after the entry, from its slash on; empty: the entry is the file
                             */
    int digits;             /* least number of digits; 0: no number, all frames are one file */
} HdFrameNames;

/* Fills `names`; errors as hd_output_file. `frames` must live on and not be empty. */
HdStatus hd_frame_names_find(HdFrameNames *names, const HdOutput *output, const HdFrameList *frames,
                             HdError *error);

/* Returns the list index of the frame whose entry has this name of `length` bytes, or a negative
   number. Of a name that `is_cut` only the start is known; the result is then any frame whose name
   starts so. */
int hd_frame_names_place(const HdFrameNames *names, const char *entry, size_t length, bool is_cut);

#endif
