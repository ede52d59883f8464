/* SPDX-License-Identifier: MIT */
/* The golden frames: a fixed list of small frames that every device must render to the same bytes,
   and the hashes of these. */
#ifndef HD_VERIFY_GOLDEN_H
#define HD_VERIFY_GOLDEN_H

#include "scene/camera.h"
#include "scene/scene.h"
#include "tables/table.h"

typedef struct HdGoldenFrame {
    const char *name;
    bool (*base)(HdScene *scene, HdCamera *camera, double variant); /* false: no memory is left */
    double variant; /* of the base: the kind of its solid, or how far its solids are apart */

    /* What differs from the base: numbers as a scene's and a camera's, those of 0 do not. */
    int width, height, samples_per_side; /* all of them, or none */
    int depth;
    double reflection, transmission; /* of all solids' faces, if one of them is not 0 */
    HdVec3 eye, target;              /* if there are degrees */
    double degrees;                  /* of the field of view */
    bool is_far;                     /* everything, from the origin */
    void (*change)(HdScene *scene);  /* of the rest, at last; NULL: there is none */

    bool proves; /* kernels prove themselves by it if they can render it (trust.h) */
} HdGoldenFrame;

extern const HdGoldenFrame hd_golden_frames[];
extern const int hd_golden_frame_count;

/* What all golden frames need of the kernels, so that devices which compile them do so once. */
extern const HdSceneTables hd_golden_needs;

/* NULL: none has that name. */
const HdGoldenFrame *hd_golden_find(const char *name);

/* Builds a frame's scene, which the caller frees. */
HdStatus hd_golden_build(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera,
                         HdError *error);

/* Of a frame in one precision. */
typedef struct HdGoldenHashes {
    uint64_t frame;      /* hd_frame_hash */
    uint64_t first_hits; /* of HdFrame.first, with all that is known of the first hit */
} HdGoldenHashes;

/* Reads a frame's hashes from what is committed, a line "NAME FRAME-IN-FLOAT FRAME-IN-DOUBLE
   FIRST-HITS-IN-FLOAT FIRST-HITS-IN-DOUBLE" for each; false, and 0, where it is not among them. */
bool hd_golden_find_hashes(const char *name, HdPrecision precision, HdGoldenHashes *hashes);

#endif
