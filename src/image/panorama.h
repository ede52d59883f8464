/* SPDX-License-Identifier: MIT */
/* Reads a picture of the surroundings, whose light may be brighter than white. */
#ifndef HD_IMAGE_PANORAMA_H
#define HD_IMAGE_PANORAMA_H

#include "image/curve.h"
#include "image/frame.h"

/* Brighter light is clamped: a sun of 1e5 would leave too few of the 65535 steps to the rest. */
#define HD_MAX_PANORAMA_LIGHT 16.0

/* Reads what hd_texture_read does, with `*top` 1. Also reads OpenEXR and PFM
   (hd_picture_reader_open), which are linear: `*top` is their largest value, at most
   HD_MAX_PANORAMA_LIGHT, or 1 if none is positive, and 65535 in a texel stands for it.
   `notes`, unless NULL, gets what was clamped and what is not finite. */
HdStatus hd_panorama_read(HdTexture *texture, double *top, const char *path, HdCurve curve,
                          HdProblems *notes, HdError *error);

#endif
