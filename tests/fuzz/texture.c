/* SPDX-License-Identifier: MIT */
/* Textures: PNG, JPEG, or else the data format. Input: a byte that selects the curve, and the
   file. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "image/picture.h"

/* Allocating more takes the campaign's time. */
enum { MAX_PIXELS = 1 << 20 };

static void touch(const HdTexture *texture) {
    const size_t count = (size_t)texture->width * (size_t)texture->height * 3;
    static volatile uint16_t sum;
    for (size_t i = 0; i < count; i++)
        sum = (uint16_t)(sum + texture->texels[i]);
}

/* Returns the largest number of pixels in a JPEG's frame headers: SOF0 to SOF15, its length, its
   bits, and two bytes each of height and width. */
static uint64_t pixels_of_jpeg(const unsigned char *bytes, size_t size) {
    uint64_t most = 0;
    for (size_t i = 0; i + 9 <= size; i++) {
        if (bytes[i] != 0xff || (bytes[i + 1] & 0xf0) != 0xc0)
            continue;
        const uint64_t height = (uint64_t)bytes[i + 5] << 8 | bytes[i + 6];
        const uint64_t width = (uint64_t)bytes[i + 7] << 8 | bytes[i + 8];
        most = height * width > most ? height * width : most;
    }
    return most;
}

static bool is_small(unsigned char *bytes, size_t size) {
    return (hd_format_png.begins(bytes, size) ? fuzz_mend_png(bytes, size)
                                              : pixels_of_jpeg(bytes, size)) <= MAX_PIXELS;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    HdTexture texture;
    if (size < 1)
        return 0;
    unsigned char *bytes = (unsigned char *)fuzz_text(data + 1, size - 1);
    const HdCurve curve = (data[0] & 1) != 0 ? HD_CURVE_LINEAR : HD_CURVE_SRGB;
    if (is_small(bytes, size - 1)) {
        const HdStatus status =
            hd_texture_decode(&texture, bytes, size - 1, "a.png", curve, &error);
        fuzz_expect_input_status(status, &error);
        if (status == HD_OK)
            touch(&texture);
        hd_texture_clear(&texture);
    }
    free(bytes);
    return 0;
}
