/* SPDX-License-Identifier: MIT */
/* The golden frames: their scenes, and the hashes of their bytes. */
#ifndef HD_CERTIFY_GOLDEN_H
#define HD_CERTIFY_GOLDEN_H

#include "certify/golden_scenes.h"
#include "device/options.h"

/* The committed hashes (hd_frame_hash): a line "NAME FLOAT DOUBLE" for each frame. */
const char *hd_golden_text(void);

/* Reads a frame's hash; false where none is committed. */
bool hd_golden_hash(const char *name, HdPrecision precision, uint64_t *hash);

/* Builds a frame's scene, which the caller frees. The builders end the program where there is no
   memory; so HD_FAILED where there is less than they need. */
HdStatus hd_golden_build(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera,
                         HdError *error);

#endif
