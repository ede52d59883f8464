/* SPDX-License-Identifier: MIT */
/* The fixed list of small frames that every device must render to the same bytes. */
#ifndef HD_VERIFY_GOLDEN_SCENES_H
#define HD_VERIFY_GOLDEN_SCENES_H

#include "scene/camera.h"
#include "scene/scene.h"

typedef struct HdGoldenFrame {
    const char *name;
    /* Fills an empty scene and camera. The caller frees the scene. */
    void (*build)(HdScene *scene, HdCamera *camera);
} HdGoldenFrame;

extern const HdGoldenFrame hd_golden_frames[];
extern const int hd_golden_frame_count;

#endif
