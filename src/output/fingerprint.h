/* SPDX-License-Identifier: MIT */
/* The identity of a run and of its frames: what decides their pixels, as one number. When it is the
   same, so are they. Finished pictures bear their frame's (image/format.h), segments of films are
   named by the run's. */
#ifndef HD_OUTPUT_FINGERPRINT_H
#define HD_OUTPUT_FINGERPRINT_H

#include <stdint.h>

#include "image/picture.h"
#include "input/scene_file.h"
#include "tables/table.h"

/* Of frames of a scene whose files are loaded, as strict arithmetic renders them and PNG pictures
   of that style hold them: every field of the scene file (fields.h) but names of files and
   what becomes of the frames, what the files hold, what the command line changed, precision, curve
   and bits, and the text of this program. Which device renders it, and how, changes no strict
   pixel. */
uint64_t hd_run_fingerprint(const HdSceneFile *file, HdPrecision precision,
                            const HdPictureStyle *style);

/* Of frame `number` of a run whose fingerprint is `run`. */
uint64_t hd_frame_fingerprint(uint64_t run, int number);

/* SHA-256 of the text of the kernels and of what runs them on CPUs, as 64 digits: what differs in
   it may compute at another speed. */
extern const char hd_kernels_hash[];

#endif
