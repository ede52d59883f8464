/* SPDX-License-Identifier: MIT */
/* Lists of frames. Input: two bytes, the length of the sequence, and the list. */
#include <stdlib.h>

#include "fuzz.h"
#include "scene/frame_list.h"

static void check_list(const HdFrameList *list, int frame_count) {
    fuzz_expect(list->count >= 1 && list->count <= frame_count, "a list of a wrong length");
    for (int i = 0; i < list->count; i++)
        fuzz_expect(list->frames[i] > (i > 0 ? list->frames[i - 1] : -1) &&
                        list->frames[i] < frame_count,
                    "a list that does not ascend within the sequence");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    HdFrameList list;
    if (size < 2)
        return 0;
    const int frame_count = data[0] << 8 | data[1];
    char *text = fuzz_text(data + 2, size - 2);
    const HdStatus status = hd_frame_list_parse(&list, text, frame_count, &error);
    fuzz_expect_input_status(status, &error);
    if (status == HD_OK)
        check_list(&list, frame_count);
    hd_frame_list_free(&list);
    free(text);
    return 0;
}
