/* SPDX-License-Identifier: MIT */
/* Golden frames: a fixed list of small frames that every device must render to the same bytes, and
   their hashes. */
#ifndef HD_VERIFY_GOLDEN_H
#define HD_VERIFY_GOLDEN_H

#include "scene/camera.h"
#include "scene/scene.h"
#include "tables/table.h"

typedef struct HdGoldenFrame {
    const char *name;
    bool (*base)(HdScene *scene, HdCamera *camera, double variant); /* false: out of memory */
    double variant; /* argument of the base: kind of its solid, or distance of its solids */

    /* Differences from the base: numbers of the scene and the camera; 0 keeps the base's. */
    int width, height, samples_per_side; /* set together, or not at all */
    int depth;
    double reflection, transmission; /* of all solids' faces, if one is not 0 */
    HdVec3 eye, target;              /* used if `degrees` is not 0 */
    double degrees;                  /* field of view */
    bool is_far;                     /* moves everything away from the origin */
    void (*change)(HdScene *scene);  /* changes the rest, last; NULL: no change */

    bool tests_build; /* tests compiled kernels that can render it (trust.h) */
} HdGoldenFrame;

extern const HdGoldenFrame hd_golden_frames[];
extern const int hd_golden_frame_count;

/* Needs of all golden frames together, so that devices that compile kernels do so once. */
extern const HdSceneTables hd_golden_needs;

/* Returns the frame of that name, or NULL. */
const HdGoldenFrame *hd_golden_find(const char *name);

/* Builds a frame's scene, which the caller frees. */
HdStatus hd_golden_build(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera,
                         HdError *error);

/* Hashes of a frame in one precision. */
typedef struct HdGoldenHashes {
    uint64_t frame;      /* hd_frame_hash */
    uint64_t first_hits; /* of HdFrame.first, with all properties of the first hit */
} HdGoldenHashes;

/* Reads a frame's hashes from the list, a line "NAME FRAME-IN-FLOAT FRAME-IN-DOUBLE
   FIRST-HITS-IN-FLOAT FIRST-HITS-IN-DOUBLE" for each. Returns false, and zeros, for others. */
bool hd_golden_find_hashes(const char *name, HdPrecision precision, HdGoldenHashes *hashes);

#endif
