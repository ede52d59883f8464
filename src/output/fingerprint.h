/* SPDX-License-Identifier: MIT */
/* Fingerprints of a run and of its frames: numbers that identify everything that decides their
   pixels. Finished pictures contain their frame's (image/format.h); names of film segments contain
   the run's. */
#ifndef HD_OUTPUT_FINGERPRINT_H
#define HD_OUTPUT_FINGERPRINT_H

#include <stdint.h>

#include "image/picture.h"
#include "input/scene_file.h"
#include "tables/table.h"

/* Returns the fingerprint of a scene whose files are loaded, rendered with strict arithmetic to PNG
   pictures of that style. It covers every field of the scene file (fields.h) except file names and
   output settings. It also covers the files' contents, changes by the command line, precision,
   curve, bits and the program's source text. The device and its settings do not matter, for they
   change no strict pixel. */
uint64_t hd_run_fingerprint(const HdSceneFile *file, HdPrecision precision,
                            const HdPictureStyle *style);

/* Returns the fingerprint of frame `number` of the run. */
uint64_t hd_frame_fingerprint(uint64_t run, int number);

/* SHA-256, in 64 digits, of the source text of the kernels and of their CPU execution. Measured
   speeds are comparable only if it is equal. */
extern const char hd_kernels_hash[];

#endif
