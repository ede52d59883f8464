/* SPDX-License-Identifier: MIT */
#include "flights.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "render_scene.h"
#include "scenes.h"

enum { ROUNDS = 5, CAMERAS = 2 };

/* Two views, so that no frame can be taken for its neighbour. */
typedef struct Views {
    HdFrameTables tables[CAMERAS];
    HdFrame alone[CAMERAS];
} Views;

static const char *const names[] = {"everything", "three-overlapping"};
static const HdFrameWish wishes[ROUNDS] = {
    {.curve = HD_CURVE_SRGB}, {.radiance = true},         {.curve = HD_CURVE_LINEAR},
    {.curve = HD_CURVE_SRGB}, {.curve = HD_CURVE_LINEAR},
};

static void build(const char *name, HdScene *scene, HdCamera *camera) {
    for (int i = 0; i < conformance_frame_count; i++)
        if (strcmp(conformance_frames[i].name, name) == 0)
            conformance_frames[i].build(scene, camera);
}

/* The second view is the first scene's, upside down. */
static void turn(HdCamera *camera) {
    for (int i = 0; i < 3; i++) {
    X = -camera->right[i];
        camera->down[i] = -camera->down[i];
    }
}
