/* SPDX-License-Identifier: MIT */
/* Renders a scene, or ends the program: no test can go on without its frame. */
#ifndef HD_CONFORMANCE_RENDER_SCENE_H
#define HD_CONFORMANCE_RENDER_SCENE_H

#include <stdbool.h>

#include "device/renderer.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* What renders the frames. */
typedef struct Target {
    HdRenderer *renderer;
    HdPrecision precision;
    bool one_build;   /* the kernels are built for all scenes of the suite at once, which saves time
                         where building takes most of it; otherwise for what each scene needs */
    bool first_hits;  /* the renderer was opened for these, and frames come with all of them */
    char label[1024]; /* for messages */
} Target;

/* The devices of a backend; where they cannot be listed the reason is printed, and there are none.
 */
int find_devices(const HdBackend *backend, HdDevice devices[HD_MAX_DEVICES]);

/* Prints the message and ends the program with 1. */
_Noreturn void fail(const char *what, const HdError *error);

/* Validates, compiles, uploads and renders. The caller frees the frame. `name` is for messages. */
HdFrame render_scene(const Target *target, const HdScene *scene, const HdCamera *camera,
                     const char *name);

#endif
