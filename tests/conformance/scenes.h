/* SPDX-License-Identifier: MIT */
/* The fixed list of small frames that every backend must render to the same bytes. */
#ifndef HD_CONFORMANCE_SCENES_H
#define HD_CONFORMANCE_SCENES_H

#include "scene/camera.h"
#include "scene/scene.h"

typedef struct ConformanceFrame {
    const char *name;
    /* Fills an empty scene and camera. The caller frees the scene. */
    void (*build)(HdScene *scene, HdCamera *camera);
} ConformanceFrame;

extern const ConformanceFrame conformance_frames[];
extern const int conformance_frame_count;

#endif
