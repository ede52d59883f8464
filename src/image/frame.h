/* SPDX-License-Identifier: MIT */
/* A rendered frame: linear radiance, or what files store of it, and what was counted on the way. */
#ifndef HD_IMAGE_FRAME_H
#define HD_IMAGE_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "image/curve.h"

/* What pictures may hold beside radiance. All but alpha can be asked for, by hd_layer_names. */
typedef enum HdLayer {
    HD_LAYER_DEPTH,
    HD_LAYER_NORMAL,
    HD_LAYER_OBJECT,
    HD_LAYER_SAMPLES,
    HD_LAYER_BOUND, /* of surveyed scenes alone */
    HD_LAYER_ALPHA
} HdLayer;

/* A set of layers has the bits of its members. */
#define HD_LAYER_BIT(layer) (1u << (layer))

extern const char *const hd_layer_names[]; /* by HdLayer; NULL ends them */

/* What is wanted of a frame's pixels. */
typedef struct HdFrameRequest {
    bool radiance;   /* `rgb` must be filled */
    HdCurve curve;   /* without it: 8 bits on this curve will do, where the device makes them */
    unsigned layers; /* what `first` and `effort` must have room for */
} HdFrameRequest;

/* Of a pixel; those of surveyed scenes. */
enum { HD_RADIANCE_FLOATS = 3, HD_BOUNDED_FLOATS = 4 };

/* Of HdFrame.first: alpha alone, or all that is known of the first hit, in this order. */
enum {
    HD_FIRST_ALPHA,  /* the share of the pixel's samples whose ray from the eye meets anything */
    HD_FIRST_DEPTH,  /* of the ray through the pixel's middle: from the eye to what it meets */
    HD_FIRST_NORMAL, /* three numbers: of the surface there, unit, turned to where it is seen from
                      */
    HD_FIRST_OBJECT = HD_FIRST_NORMAL + 3, /* its number, from 1 on: solids in the scene's order,
                                              the floor if there is one, then meshes. Depth, normal
                                              and number are 0 where nothing is met */
    HD_MAX_FIRST_FLOATS
};

/* Of HdFrame.effort. */
enum { HD_EFFORT_SAMPLES, HD_EFFORT_BOUND, HD_EFFORT_FLOATS };

typedef struct HdFrame {
    int width, height;
    int floats;      /* of a pixel: HD_RADIANCE_FLOATS or HD_BOUNDED_FLOATS */
    float *rgb;      /* owned; width * height * floats, row by row from the top; radiance times
                        exposure; of surveyed scenes also a bound of what was left out */
    uint8_t *rgba;   /* owned; width * height * 4: r, g, b and an alpha of 255, as hd_curve_encode8
                        makes them; NULL: radiance must be wished for */
    bool is_encoded; /* the device filled `rgba`, and `rgb` is worth nothing; otherwise it filled
                        `rgb` and left `rgba` alone */
    uint64_t primary_rays, mirrored_rays, transmitted_rays; /* closest-hit searches */
    uint64_t shadow_tests; /* pairs of a point and a light that may reach it */
    uint64_t clamps;       /* contributions cut to 2^16 */
    double trace_seconds;  /* on the device, copies left out */
    double longest_launch; /* seconds, of a GPU's kernel; negative: not known, or on no GPU */
    bool has_bound;        /* of a surveyed scene: what was left out, in steps of 255 */
    double largest_bound, mean_bound;
    unsigned layers;  /* of HD_LAYER_BIT, that there is room for */
    int first_floats; /* of a pixel in `first`: 0, 1 or HD_MAX_FIRST_FLOATS */
    float *first;     /* owned; what the eye's rays meet first; NULL: not asked for */
    float *effort;    /* owned; HD_EFFORT_FLOATS for each pixel: its samples, and of surveyed scenes
                         by how many steps of 255 it can be off at most for what was left out; NULL:
                         not asked for */
} HdFrame;

/* What the kernels count in a part of a frame, laid out as their RayCounts; as in HdFrame. */
typedef struct HdRayCounts {
    uint64_t mirrored_rays, transmitted_rays, shadow_tests, clamps;
} HdRayCounts;
_Static_assert(sizeof(HdRayCounts) == 32, "the kernels count in 32 bytes");

/* A frame without `rgba`. */
HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error);

/* The same for so many floats of a pixel. */
HdStatus hd_frame_create_with(HdFrame *frame, int width, int height, int floats, HdError *error);

/* Fails where a side is not in 1..65535, as no picture may have it. */
HdStatus hd_frame_check_size(const HdFrame *frame, HdError *error);

/* Gives a frame of such a size `rgba`. */
HdStatus hd_frame_add_rgba(HdFrame *frame, HdError *error);

/* Gives a frame room for those layers. */
HdStatus hd_frame_add_layers(HdFrame *frame, unsigned layers, HdError *error);

/* The bytes that this takes for each pixel. */
size_t hd_layer_bytes(unsigned layers);

/* Says in `effort`, if there is any, that each pixel took so many samples. */
void hd_frame_fill_samples(HdFrame *frame, int samples);

/* Fills `rgba` from the radiance of a frame of HD_RADIANCE_FLOATS. */
void hd_frame_encode(const HdFrame *frame, HdCurve curve);

/* A frame that is free may be freed. */
void hd_frame_free(HdFrame *frame);

/* Sets the frame's counts to the sums of those of its parts; every sample has one primary ray. */
void hd_frame_set_counts(HdFrame *frame, int samples, const HdRayCounts *counts, int count);

/* Rays of all kinds. */
uint64_t hd_frame_rays(const HdFrame *frame);

/* A 64-bit hash (FNV-1a) of size, radiance and counts of rays, shadow tests and clamps: two frames
   are the same when their hashes are. */
uint64_t hd_frame_hash(const HdFrame *frame);

enum { HD_MAX_TEXTURE_PIXELS = 1 << 28 };

/* Linear values, 16 bits a channel, row by row from the top: r, g, b, r, g, b, ... */
typedef struct HdTexture {
    int width, height;
    uint16_t *texels; /* owned; width * height * 3 */
} HdTexture;

/* Checks the size against HD_MAX_TEXTURE_SIDE and the limit above and allocates the texels, which
   are not cleared. `name` is for messages. */
HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error);

/* Frees what the texture owns and clears it; it may be clear already. */
void hd_texture_clear(HdTexture *texture);

#endif
