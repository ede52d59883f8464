/* SPDX-License-Identifier: MIT */
#include "view/scale.h"

#include <stddef.h>
#include <string.h>

/* Where the source's pixels for number `i` of `count` begin; the next number's begin ends them. */
static int begin_of(int i, int count, int source) {
    return (int)((int64_t)i * source / count);
}

static int end_of(int i, int count, int source) {
    const int begin = begin_of(i, count, source), end = begin_of(i + 1, count, source);
    return end > begin ? end : begin + 1;
}

static void mean_of(const uint8_t *source, int source_width, const int box[4], uint8_t out[4]) {
    unsigned sums[3] = {0, 0, 0};
    const unsigned count = (unsigned)((box[1] - box[0]) * (box[3] - box[2]));
    for (int y = box[2]; y < box[3]; y++)
        for (int x = box[0]; x < box[1]; x++)
            for (int c = 0; c < 3; c++)
                sums[c] += source[4 * ((size_t)y * (size_t)source_width + (size_t)x) + (size_t)c];
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)((sums[c] + count / 2) / count);
    out[3] = 255;
}

void hd_scale_rgba(const uint8_t *source, int source_width, int source_height, uint8_t *target,
                   int width, int height, int stride) {
    for (int y = 0; y < height; y++) {
        uint8_t *row = target + (size_t)y * (size_t)stride;
        if (source == NULL) {
            memset(row, 0, 4 * (size_t)width);
            continue;
        }
        for (int x = 0; x < width; x++) {
            const int box[4] = {begin_of(x, width, source_width), end_of(x, width, source_width),
                                begin_of(y, height, source_height),
                                end_of(y, height, source_height)};
            mean_of(source, source_width, box, row + 4 * (size_t)x);
        }
    }
}
