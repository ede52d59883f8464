/* SPDX-License-Identifier: MIT */
/* Pictures for comparison, row by row: PNG, OpenEXR and PFM. */
#include <stdlib.h>

#include "fuzz.h"
#include "image/difference.h"
#include "image/picture.h"

/* Reading more takes the campaign's time. */
enum { MAX_PIXELS = 1 << 20 };

static HdStatus read_rows(HdPictureReader *reader, HdError *error) {
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    if ((uint64_t)facts->width * (uint64_t)facts->height > MAX_PIXELS)
        return HD_OK;
    HdPictureValue *values = malloc((size_t)facts->width * 3 * sizeof *values);
    fuzz_expect(values != NULL, "no memory");
    HdStatus status = hd_picture_reader_start(reader, facts->curve, error);
    HdChannelDifference difference = {0};
    for (int y = 0; y < facts->height && status == HD_OK; y++) {
        status = hd_picture_reader_next(reader, values, error);
        for (int i = 0; i < facts->further && status == HD_OK; i++)
            for (int x = 0; x < facts->width; x++)
                hd_channel_difference_add(&difference, hd_picture_reader_further(reader, i)[x],
                                          0.0F, x, y);
    }
    free(values);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    HdPictureReader *reader;
    unsigned char *bytes = (unsigned char *)fuzz_text(data, size);
    if (hd_format_png.begins(bytes, size))
        fuzz_mend_png(bytes, size);
    HdStatus status = hd_picture_reader_open(&reader, fuzz_file("picture", bytes, size), &error);
    fuzz_expect_input_status(status, &error);
    if (status == HD_OK) {
        fuzz_expect_input_status(read_rows(reader, &error), &error);
        hd_picture_reader_close(reader);
    }
    free(bytes);
    return 0;
}
