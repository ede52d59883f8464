/* SPDX-License-Identifier: MIT */
/* Frames whose pixels are known from mathematics. Truths that random scenes show as well are left
   to an independent ray tracer (tests/reference). */
#ifndef HD_CONFORMANCE_TRUTHS_H
#define HD_CONFORMANCE_TRUTHS_H

#include <stdbool.h>

#include "render_scene.h"
#include "scene/camera.h"
#include "scene/scene.h"

typedef struct Check {
    const Target *target;
    int checked, failed;
    double tolerance;         /* relative */
    const char *failed_truth; /* the last failed truth: only its first wrong pixel is printed */
} Check;

HdFrame render(const Check *check, const HdScene *scene, const HdCamera *camera);

/* Renders likewise, and frees the scene. */
HdFrame render_last(const Check *check, HdScene *scene, const HdCamera *camera);
void expect(Check *check, const char *truth, int x, int y, double found, double expected);

/* Fails unless enough pixels were compared: a truth about no pixel proves nothing. */
void expect_compared(Check *check, const char *truth, int compared, int at_least);

/* Returns one of the three channels, 0 being red. */
double channel_of(const HdFrame *frame, int x, int y, int channel);
double red(const HdFrame *frame, int x, int y);

/* Returns the direction through the point (x, y), in pixels from the upper left corner. */
HdVec3 direction_at(const HdScene *scene, const HdCamera *camera, double x, double y);

HdVec3 grey(double value);

/* Returns the solid's unit shape, rotated as in the scene. */
HdPlatonic shape_of(const HdSolid *solid);

/* Returns a material that emits its colour and nothing else. */
HdMaterial glowing(double radiance);

/* Renders every truth with an open renderer and prints those that fail. */
void check_truths(const Target *target, int *checked, int *failed);

/* Each checks the truths of one theme. */
void check_first_hits(Check *check);
void check_geometry(Check *check);
void check_refraction(Check *check);
void check_invariance(Check *check);

#endif
