/* SPDX-License-Identifier: MIT */
/* Textures: PNG, or else the data format. Input: a byte that picks the curve, and the file. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "image/picture.h"
#include "image/png.h"
#include "png_sums.h"

/* Allocating more takes the campaign's time. */
enum { MOST_PIXELS = 1 << 20 };

static void touch(const HdTexture *texture) {
    const size_t count = (size_t)texture->width * (size_t)texture->height * 3;
    static volatile uint16_t sum;
    for (size_t i = 0; i < count; i++)
        sum = (uint16_t)(sum + texture->texels[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    HdTexture texture;
    if (size < 1)
        return 0;
    unsigned char *bytes = (unsigned char *)fuzz_text(data + 1, size - 1);
    const HdCurve curve = (data[0] & 1) != 0 ? HD_CURVE_LINEAR : HD_CURVE_SRGB;
    const bool is_small =
        !hd_image_is_png(bytes, size - 1) || fuzz_mend_png(bytes, size - 1) <= MOST_PIXELS;
    if (is_small) {
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
