/* SPDX-License-Identifier: MIT */
#include "view/split.h"

#include <stdlib.h>
#include <string.h>

#include "view/scale.h"

static int scaled_difference(const uint8_t *a, const uint8_t *b, int gain, uint8_t *out) {
    int largest = 0;
    for (int c = 0; c < 3; c++) {
        const int apart = a[c] > b[c] ? a[c] - b[c] : b[c] - a[c];
        largest = apart > largest ? apart : largest;
        out[c] = (uint8_t)(apart * gain < 255 ? apart * gain : 255);
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
            const int apart = scaled_difference(pixels + x, pixels + across + x, gain, below + x);
            figures->largest = apart > figures->largest ? apart : figures->largest;
            differing += apart > 0;
        }
    }
    figures->share = (double)differing / ((double)width * height);
}

HdStatus hd_split_compose(HdViewImage *out, const HdViewImage *first, const HdViewImage *second,
                          int gain, HdSplitFigures *figures, HdError *error) {
    const int width = first->width, height = first->height;
    *figures = (HdSplitFigures){.is_unlike = second->width != width || second->height != height};
    HdStatus status = hd_view_image_resize(out, 2 * width, 2 * height, error);
    if (status != HD_OK || width == 0)
        return status;
    memset(out->rgba, 0, 16 * (size_t)width * (size_t)height);
    hd_scale_rgba(first->rgba, width, height, out->rgba, width, height, 8 * width);
    hd_scale_rgba(second->width > 0 ? second->rgba : NULL, second->width, second->height,
                  out->rgba + 4 * (size_t)width, width, height, 8 * width);
    fill_difference(out, gain, figures);
    return HD_OK;
}
