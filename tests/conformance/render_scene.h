/* SPDX-License-Identifier: MIT */
/* Renders a scene, or ends the program: no test can continue without its frame. */
#ifndef HD_CONFORMANCE_RENDER_SCENE_H
#define HD_CONFORMANCE_RENDER_SCENE_H

#include <stdbool.h>

#include "device/renderer.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* A renderer of the frames. */
typedef struct Target {
    HdRenderer *renderer;
    HdPrecision precision;
    bool one_build;   /* whether kernels are built for all scenes of the suite at once, which saves
                         time if building takes most of it; otherwise for each scene's needs */
    bool first_hits;  /* layers that the renderer was opened for and that all frames have */
    char label[1024]; /* name for messages */
} Target;

/* Returns the devices of a backend; if listing fails, prints the reason and returns none. */
int find_devices(const HdBackend *backend, HdDevice devices[HD_MAX_DEVICES]);

/* Prints the message and ends the program with 1. */
_Noreturn void fail(const char *what, const HdError *error);

/* Validates, compiles, uploads and renders a scene. The caller frees the frame. `name` is for
   messages. */
HdFrame render_scene(const Target *target, const HdScene *scene, const HdCamera *camera,
                     const char *name);

#endif
