/* SPDX-License-Identifier: MIT */
/* The golden frames: their scenes, and the hashes of their bytes. */
#ifndef HD_VERIFY_GOLDEN_H
#define HD_VERIFY_GOLDEN_H

#include "device/options.h"
#include "verify/golden_scenes.h"

/* What all golden frames need of the kernels, so that devices which compile them do so once. */
extern const HdSceneTables hd_golden_needs;

/* Of a frame in one precision. */
typedef struct HdGoldenHashes {
    uint64_t frame;      /* hd_frame_hash */
    uint64_t first_hits; /* of HdFrame.first, with all that is known of the first hit */
} HdGoldenHashes;

/* What is committed: a line "NAME FRAME-IN-FLOAT FRAME-IN-DOUBLE FIRST-HITS-IN-FLOAT
   FIRST-HITS-IN-DOUBLE" for each frame. */
const char *hd_golden_text(void);

/* Reads a frame's hashes; false where none are committed. */
bool hd_golden_find_hashes(const char *name, HdPrecision precision, HdGoldenHashes *hashes);

/* Builds a frame's scene, which the caller frees. The builders end the program where there is no
   memory; so HD_FAILED where there is less than they need. */
HdStatus hd_golden_build(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera,
                         HdError *error);

#endif
