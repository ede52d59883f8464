/* SPDX-License-Identifier: MIT */
/* The classic task's input: numbers and paths in a fixed order, separated by white space:
     number of frames
     output path with one %d
     width height field-of-view
     the eye's path and the target's, each: r0 z0 phi0, amplitudes of r and z, frequencies of r, z
       and phi, phases of r and z
     three solids, each: centre(3) colour(3) radius reflection transparency lights-per-edge
     floor: four corners(12) texture-path tint(3) reflection
     number of lights (0 to 4), then each: position(3) colour(3)
     depth, square root of the number of rays per pixel
   The variant, 1 to 10, which is not in the text, decides the kinds of the solids. */
#ifndef HD_INPUT_CLASSIC_H
#define HD_INPUT_CLASSIC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"
#include "input/scene_file.h"

enum {
    HD_CLASSIC_SOLIDS = 3,
    HD_CLASSIC_MAX_LIGHTS = 4,
    HD_CLASSIC_VARIANTS = 10,
    HD_CLASSIC_DEFAULT_VARIANT = 4
};

/* Returns whether the text may be a classic input: its first character beyond white space is a
   digit, '+', '-' or '.'. That holds for every classic input and for no scene file, which begins
   with '{'. The text needs no terminating zero; `size` may be 0. */
bool hd_classic_may_be(const char *text, size_t size);

/* Parses `size` bytes of text, which need no terminating zero. Fills in what the classic input
   leaves open: materials, rims, edge lights, linear curves. `name` is the text's name in messages.
   Keeps paths as written and does not read the texture. On failure `input` is empty. */
HdStatus hd_classic_parse(HdSceneFile *input, const char *text, size_t size, const char *name,
                          int variant, HdError *error);

/* Writes the same format; it reads back as the same numbers. Fails with HD_BAD_INPUT if the format
   cannot hold the scene: not three solids, no floor, more than four lights, or a path with white
   space. Other properties of materials and lights are lost. */
HdStatus hd_classic_print(FILE *out, const HdSceneFile *input, HdError *error);

#endif
