/* SPDX-License-Identifier: MIT */
#include "image/frame.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/limits.h"
#include "system/machine.h"

const char *const hd_layer_names[] = {"depth", "normal", "object", "bound", NULL};

HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error) {
    return hd_frame_create_with(frame, width, height, HD_RADIANCE_FLOATS, error);
}

HdStatus hd_frame_create_with(HdFrame *frame, int width, int height, int floats, HdError *error) {
    memset(frame, 0, sizeof *frame);
    frame->rgb = calloc((size_t)width * (size_t)height * (size_t)floats, sizeof *frame->rgb);
    if (frame->rgb == NULL)
        return HD_NO_ROOM(error, "a frame of %d x %d pixels", width, height);
    frame->width = width;
    frame->height = height;
    frame->floats = floats;
    return HD_OK;
}

HdStatus hd_frame_check_size(const HdFrame *frame, HdError *error) {
    if (frame->width < 1 || frame->width > HD_MAX_IMAGE_SIDE || frame->height < 1 ||
        frame->height > HD_MAX_IMAGE_SIDE)
        return hd_fail(error, HD_BAD_INPUT, "a picture of %d x %d pixels, expected 1..%d each",
                       frame->width, frame->height, HD_MAX_IMAGE_SIDE);
    return HD_OK;
}

HdStatus hd_frame_add_rgba(HdFrame *frame, HdError *error) {
    HD_TRY(hd_frame_check_size(frame, error));
    frame->rgba = calloc((size_t)frame->width * (size_t)frame->height, 4);
    if (frame->rgba == NULL)
        return HD_NO_ROOM(error, "a picture of %d x %d pixels", frame->width, frame->height);
    return HD_OK;
}

static int first_floats_of(unsigned layers) {
    const unsigned first_hit = HD_LAYER_BIT(HD_LAYER_DEPTH) | HD_LAYER_BIT(HD_LAYER_NORMAL) |
                               HD_LAYER_BIT(HD_LAYER_OBJECT);
    if ((layers & first_hit) != 0)
        return HD_MAX_FIRST_FLOATS;
    return (layers & HD_LAYER_BIT(HD_LAYER_ALPHA)) != 0 ? 1 : 0;
}

static int bound_floats_of(unsigned layers) {
    return (layers & HD_LAYER_BIT(HD_LAYER_BOUND)) != 0 ? 1 : 0;
}

size_t hd_layer_bytes(unsigned layers) {
    return sizeof(float) * (size_t)(first_floats_of(layers) + bound_floats_of(layers));
}

HdStatus hd_frame_add_layers(HdFrame *frame, unsigned layers, HdError *error) {
    const size_t pixels = (size_t)frame->width * (size_t)frame->height;
    const int first = first_floats_of(layers), bounds = bound_floats_of(layers);
    if (first > 0)
        frame->first = calloc(pixels * (size_t)first, sizeof *frame->first);
    if (bounds > 0)
        frame->bounds = calloc(pixels, sizeof *frame->bounds);
    if ((first > 0 && frame->first == NULL) || (bounds > 0 && frame->bounds == NULL))
        return HD_NO_ROOM(error, "the layers of %d x %d pixels", frame->width, frame->height);
    frame->layers = layers;
    frame->first_floats = first;
    return HD_OK;
}

void hd_frame_encode(const HdFrame *frame, HdCurve curve) {
    hd_curve_encode_rgba(curve, frame->rgb, (size_t)frame->width * (size_t)frame->height,
                         frame->rgba);
}

void hd_frame_free(HdFrame *frame) {
    free(frame->rgb);
    free(frame->rgba);
    free(frame->first);
    free(frame->bounds);
    memset(frame, 0, sizeof *frame);
}

void hd_frame_set_counts(HdFrame *frame, int samples, const HdRayCounts *counts, int count) {
    frame->primary_rays = (uint64_t)frame->width * (uint64_t)frame->height * (uint64_t)samples;
    frame->mirrored_rays = frame->transmitted_rays = 0;
    frame->shadow_tests = frame->clamps = 0;
    for (int i = 0; i < count; i++) {
        frame->mirrored_rays += counts[i].mirrored_rays;
        frame->transmitted_rays += counts[i].transmitted_rays;
        frame->shadow_tests += counts[i].shadow_tests;
        frame->clamps += counts[i].clamps;
    }
}

uint64_t hd_frame_rays(const HdFrame *frame) {
    return frame->primary_rays + frame->mirrored_rays + frame->transmitted_rays;
}

uint64_t hd_frame_hash(const HdFrame *frame) {
    const size_t values = (size_t)frame->width * (size_t)frame->height * (size_t)frame->floats;
    const int32_t size[] = {frame->width, frame->height};
    const uint64_t counts[] = {hd_frame_rays(frame), frame->shadow_tests, frame->clamps};
    uint64_t hash = hd_hash_numbers(HD_HASH_START, size, sizeof size, sizeof *size);
    hash = hd_hash_numbers(hash, counts, sizeof counts, sizeof *counts);
    return hd_hash_numbers(hash, frame->rgb, values * sizeof *frame->rgb, sizeof *frame->rgb);
}

HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error) {
    if (width < 1 || width > HD_MAX_TEXTURE_SIDE || height < 1 || height > HD_MAX_TEXTURE_SIDE)
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture %s has %lu x %lu pixels, expected 1..%d each", name,
                       (unsigned long)width, (unsigned long)height, HD_MAX_TEXTURE_SIDE);
    if ((uint64_t)width * height > HD_MAX_TEXTURE_PIXELS)
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture %s has %lu x %lu pixels, expected at most %d in all", name,
                       (unsigned long)width, (unsigned long)height, HD_MAX_TEXTURE_PIXELS);
    texture->texels =
        hd_large_allocate((size_t)width * (size_t)height * 3 * sizeof *texture->texels);
    if (texture->texels == NULL)
        return HD_NO_ROOM(error, "the texture %s of %lu x %lu pixels", name, (unsigned long)width,
                          (unsigned long)height);
    texture->width = (int)width;
    texture->height = (int)height;
    return HD_OK;
}

void hd_texture_clear(HdTexture *texture) {
    free(texture->texels);
    *texture = (HdTexture){0};
}
