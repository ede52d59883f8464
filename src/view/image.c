/* SPDX-License-Identifier: MIT */
#include "view/image.h"

#include <stdlib.h>
#include <string.h>

void hd_view_image_free(HdViewImage *image) {
    free(image->rgba);
    *image = (HdViewImage){.width = 0};
}

/* Copies the nearest pixels into a part of a picture, whose rows are `stride` pixels apart. */
static void copy_fitted(const HdViewImage *source, uint8_t *target, int width, int height,
                        int stride) {
    for (int y = 0; y < height; y++, target += 4 * (size_t)stride) {
        const size_t row = (size_t)((int64_t)y * source->height / height);
        const uint8_t *pixels = source->rgba + 4 * row * (size_t)source->width;
        for (int x = 0; x < width; x++)
            memcpy(target + 4 * (size_t)x, pixels + 4 * ((int64_t)x * source->width / width), 4);
    }
}

HdStatus hd_view_image_resize(HdViewImage *image, int width, int height, HdError *error) {
    if (image->width == width && image->height == height)
        return HD_OK;
    uint8_t *rgba = calloc(4 * (size_t)width, (size_t)height);
    if (rgba == NULL)
        return HD_NO_ROOM(error, "a picture to show");
    if (image->width > 0)
        copy_fitted(image, rgba, width, height, width);
    free(image->rgba);
    image->rgba = rgba;
    image->width = width;
    image->height = height;
    return HD_OK;
}

static int scaled_difference(const uint8_t *a, const uint8_t *b, int gain, uint8_t *out) {
    int largest = 0;
    for (int c = 0; c < 3; c++) {
        const int difference = a[c] > b[c] ? a[c] - b[c] : b[c] - a[c];
        largest = difference > largest ? difference : largest;
        out[c] = (uint8_t)(difference * gain < 255 ? difference * gain : 255);
    }
    out[3] = 255;
    return largest;
}

static void fill_difference(HdViewImage *out, int gain, HdSplitFigures *figures) {
    const int width = out->width / 2, height = out->height / 2;
    const size_t row = 4 * (size_t)out->width, across = 4 * (size_t)width;
    int64_t differing = 0;
    for (int y = 0; y < height; y++) {
        const uint8_t *pixels = out->rgba + row * (size_t)y;
        uint8_t *below = out->rgba + row * (size_t)(y + height);
        for (size_t x = 0; x < across; x += 4) {
            const int difference =
                scaled_difference(pixels + x, pixels + across + x, gain, below + x);
            figures->largest = difference > figures->largest ? difference : figures->largest;
            differing += difference > 0;
        }
    }
    figures->share = (double)differing / ((double)width * height);
}

HdStatus hd_view_image_split(HdViewImage *out, const HdViewImage *first, const HdViewImage *second,
                             int gain, HdSplitFigures *figures, HdError *error) {
    const int width = first->width, height = first->height;
    *figures = (HdSplitFigures){.is_unlike = second->width != width || second->height != height};
    HdStatus status = hd_view_image_resize(out, 2 * width, 2 * height, error);
    if (status != HD_OK || width == 0)
        return status;
    memset(out->rgba, 0, 16 * (size_t)width * (size_t)height);
    copy_fitted(first, out->rgba, width, height, 2 * width);
    if (second->width > 0)
        copy_fitted(second, out->rgba + 4 * (size_t)width, width, height, 2 * width);
    fill_difference(out, gain, figures);
    return HD_OK;
}
