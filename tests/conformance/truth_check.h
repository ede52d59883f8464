/* SPDX-License-Identifier: MIT */
/* What the truths are written with: render, look at pixels, compare, count. */
#ifndef HD_CONFORMANCE_TRUTH_CHECK_H
#define HD_CONFORMANCE_TRUTH_CHECK_H

#include <stdbool.h>

#include "render_scene.h"
#include "scene/camera.h"
#include "scene/scene.h"

typedef struct Check {
    const Target *target;
    int checked, failed;
    double tolerance; /* relative */
    bool quiet;       /* only the first wrong pixel of a truth is printed */
} Check;

/* Starts a truth. */
void begin(Check *check);
HdFrame render(const Check *check, const HdScene *scene, const HdCamera *camera);

/* The same for a scene that is needed no more: it is freed. */
HdFrame render_last(const Check *check, HdScene *scene, const HdCamera *camera);
void expect(Check *check, const char *truth, int x, int y, double found, double expected);

/* A truth about no pixel is none. */
void expect_compared(Check *check, const char *truth, int compared, int at_least);

/* One of the three channels, 0 being red. */
double channel_of(const HdFrame *frame, int x, int y, int channel);
double red(const HdFrame *frame, int x, int y);

/* The direction through the point (x, y), counted in pixels from the upper left corner. */
HdVec3 direction_at(const HdScene *scene, const HdCamera *camera, double x, double y);

HdVec3 grey(double value);

/* The solid's unit shape, turned as it is in the scene. */
HdPlatonic shape_of(const HdSolid *solid);

/* A surface that shows its colour and nothing else. */
HdMaterial glowing(double radiance);

#endif
