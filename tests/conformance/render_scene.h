/* SPDX-License-Identifier: MIT */
/* Renders a scene, or ends the program: no test can go on without its frame. */
#ifndef HD_CONFORMANCE_RENDER_SCENE_H
#define HD_CONFORMANCE_RENDER_SCENE_H

#include "backend.h"
#include "camera.h"
#include "scene.h"

/* Prints the message and ends the program with 1. */
_Noreturn void fail(const char *what, const HdError *error);

/* Validates, compiles, uploads and renders. The caller frees the frame. `name` is for messages. */
HdFrame render_scene(HdRenderer *renderer, const HdScene *scene, const HdCamera *camera,
                     HdPrecision precision, const char *name);

#endif
