/* SPDX-License-Identifier: MIT */
#include "frame.h"

#include <stdlib.h>
#include <string.h>

HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error) {
    memset(frame, 0, sizeof *frame);
    frame->rgb = calloc((size_t)width * (size_t)height * 3, sizeof *frame->rgb);
    if (frame->rgb == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a frame of %d x %d pixels",
                       width, height);
    frame->width = width;
    frame->height = height;
    return HD_OK;
}

void hd_frame_free(HdFrame *frame) {
    free(frame->rgb);
    memset(frame, 0, sizeof *frame);
}

static uint8_t to_byte(float value) {
    if (!(value > 0.0f))
        return 0;
    if (value >= 1.0f)
        return 255;
    return (uint8_t)(value * 255.0f + 0.5f);
}

void hd_frame_to_image8(const HdFrame *frame, HdImage8 *image) {
    size_t count = (size_t)frame->width * (size_t)frame->height;
    for (size_t i = 0; i < count; i++) {
        const float *rgb = frame->rgb + 3 * i;
        uint8_t *rgba = image->rgba + 4 * i;
        rgba[0] = to_byte(rgb[0]);
        rgba[1] = to_byte(rgb[1]);
        rgba[2] = to_byte(rgb[2]);
        rgba[3] = 255;
    }
}

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

uint64_t hd_frame_hash(const HdFrame *frame) {
    uint64_t hash = 14695981039346656037u;
    int32_t size[2] = {frame->width, frame->height};
    uint64_t counts[3] = {frame->rays, frame->shadow_tests, frame->clamps};
    size_t values = (size_t)frame->width * (size_t)frame->height * 3;
    hash = hash_bytes(hash, size, sizeof size);
    hash = hash_bytes(hash, counts, sizeof counts);
    return hash_bytes(hash, frame->rgb, values * sizeof *frame->rgb);
}
