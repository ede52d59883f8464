/* SPDX-License-Identifier: MIT */
/* A rendered frame: linear radiance or encoded values, layers and ray counts. */
#ifndef HD_IMAGE_FRAME_H
#define HD_IMAGE_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "image/curve.h"

/* Contents of a picture besides radiance. hd_layer_names selects all but alpha. */
typedef enum HdLayer {
    HD_LAYER_DEPTH,
    HD_LAYER_NORMAL,
    HD_LAYER_OBJECT,
    HD_LAYER_BOUND, /* scenes with an error bound only */
    HD_LAYER_ALPHA
} HdLayer;

/* A set of layers combines these bits. */
#define HD_LAYER_BIT(layer) (1u << (layer))

extern const char *const hd_layer_names[]; /* by HdLayer; NULL-terminated */

/* Requested contents of a frame's pixels. */
typedef struct HdFrameRequest {
    bool radiance;   /* fill `rgb` */
    HdCurve curve;   /* otherwise 8 bits on this curve suffice, if the device can encode them */
    unsigned layers; /* layers that `first` and `bounds` must hold */
} HdFrameRequest;

/* Floats of a pixel; HD_BOUNDED_FLOATS for scenes with an error bound. */
enum { HD_RADIANCE_FLOATS = 3, HD_BOUNDED_FLOATS = 4 };

/* Indices into HdFrame.first: alpha alone, or all properties of the first hit in this order,
   which are 0 without a hit. */
enum {
    HD_FIRST_ALPHA,  /* share of the pixel's samples whose primary ray hits an object */
    HD_FIRST_DEPTH,  /* distance along the ray through the pixel's centre */
    HD_FIRST_NORMAL, /* unit normal there, towards the viewer */
    HD_FIRST_OBJECT = HD_FIRST_NORMAL + 3, /* solids, floor, meshes, from 1 */
    HD_MAX_FIRST_FLOATS
};

typedef struct HdFrame {
    int width, height;
    int floats; /* floats of a pixel: HD_RADIANCE_FLOATS or HD_BOUNDED_FLOATS */
    float *rgb; /* owned; width * height * floats, row by row from the top; radiance times exposure;
                   with an error bound also the bound of the omitted light */
    uint8_t *rgba;   /* owned; width * height * 4: r, g, b and an alpha of 255, as from
                        hd_curve_encode8; NULL: radiance must be requested */
    bool is_encoded; /* the device filled `rgba` and left `rgb` undefined; otherwise it filled `rgb`
                        only */
    uint64_t primary_rays, mirrored_rays, transmitted_rays; /* closest-hit searches */
    uint64_t shadow_tests; /* pairs of a point and a light that may reach it */
    uint64_t clamps;       /* contributions cut to 2^16 */
    double trace_seconds;  /* seconds on the device without copies */
    double longest_launch; /* longest kernel launch in seconds; negative: unknown, or no GPU */
    bool has_bound;        /* error bound of the omitted light, in 1/255 */
    double largest_bound, mean_bound;
    unsigned layers;  /* HD_LAYER_BIT of the allocated layers */
    int first_floats; /* floats of a pixel in `first`: 0, 1 or HD_MAX_FIRST_FLOATS */
    float *first;     /* owned; first hits of the primary rays; NULL: not requested */
    float *bounds;    /* owned; with an error bound a pixel's maximum error in 1/255 from omitted
                         light; NULL: not requested */
} HdFrame;

/* Counts of a part of a frame, laid out as the kernels' RayCounts; as in HdFrame. */
typedef struct HdRayCounts {
    uint64_t mirrored_rays, transmitted_rays, shadow_tests, clamps;
} HdRayCounts;
_Static_assert(sizeof(HdRayCounts) == 32, "the kernels count in 32 bytes");

/* Creates a frame without `rgba`. */
HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error);

/* As hd_frame_create, with this many floats a pixel. */
HdStatus hd_frame_create_with(HdFrame *frame, int width, int height, int floats, HdError *error);

/* Fails if a side is not in 1..65535, the range of picture files. */
HdStatus hd_frame_check_size(const HdFrame *frame, HdError *error);

/* Allocates `rgba`. */
HdStatus hd_frame_add_rgba(HdFrame *frame, HdError *error);

/* Allocates the layers. */
HdStatus hd_frame_add_layers(HdFrame *frame, unsigned layers, HdError *error);

/* Returns the bytes of the layers a pixel. */
size_t hd_layer_bytes(unsigned layers);

/* Fills `rgba` from the radiance of a frame of HD_RADIANCE_FLOATS. */
void hd_frame_encode(const HdFrame *frame, HdCurve curve);

/* Frees what the frame owns; freeing it twice is allowed. */
void hd_frame_free(HdFrame *frame);

/* Sets the frame's counts to the sums of its parts; every sample has one primary ray. */
void hd_frame_set_counts(HdFrame *frame, int samples, const HdRayCounts *counts, int count);

/* Returns the rays of all kinds. */
uint64_t hd_frame_rays(const HdFrame *frame);

/* Returns a 64-bit hash (FNV-1a) of size, radiance and counts of rays, shadow tests and clamps.
   Frames are equal if their hashes are. */
uint64_t hd_frame_hash(const HdFrame *frame);

enum { HD_MAX_TEXTURE_PIXELS = 1 << 28 };

/* Linear values, 16 bits a channel, row by row from the top: r, g, b, r, g, b, ... */
typedef struct HdTexture {
    int width, height;
    uint16_t *texels;  /* owned; width * height * 3 */
    bool is_cut_short; /* its file ends early; the decoder made up the rest */
    bool is_mask;      /* three times the opacity, not colours */
} HdTexture;

/* Checks the size against HD_MAX_TEXTURE_SIDE and the limit above, and allocates uninitialised
   texels. `name` is for messages. */
HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error);

/* Frees what the texture owns and clears it; a clear one is allowed. */
void hd_texture_clear(HdTexture *texture);

#endif
