/* SPDX-License-Identifier: MIT */
/* The classic input. Input: a byte that picks the variant, and the text. */
#define _POSIX_C_SOURCE 200809L

#include "input/classic.h"

#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "system/path.h"

static char *print(const HdSceneFile *input, size_t *size) {
    static HdError error;
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    fuzz_expect(out != NULL, "no memory");
    const HdStatus status = hd_classic_print(out, input, &error);
    fuzz_expect(fclose(out) == 0, "no memory");
    fuzz_expect(status == HD_OK, error.message);
    return text;
}

static void expect_to_come_back(const HdSceneFile *input, int variant) {
    static HdError error;
    HdSceneFile again;
    size_t first_size, second_size;
    char *first = print(input, &first_size);
    fuzz_expect(hd_classic_parse(&again, first, first_size, "again", variant, &error) == HD_OK,
                error.message);
    char *second = print(&again, &second_size);
    fuzz_expect(first_size == second_size && memcmp(first, second, first_size) == 0,
                "an input that changes when it is written and read");
    hd_scene_file_free(&again);
    free(first);
    free(second);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    HdSceneFile input;
    char name[HD_MAX_PATH];
    if (size < 1)
        return 0;
    const int variant = 1 + data[0] % HD_CLASSIC_VARIANTS;
    const HdStatus status =
        hd_classic_parse(&input, (const char *)data + 1, size - 1, "a.in", variant, &error);
    fuzz_expect_input_status(status, &error);
    if (status != HD_OK)
        return 0;
    hd_pattern_format(input.output.path, input.scene.frame_count - 1, name, &error);
    fuzz_render_scene(&input.scene);
    expect_to_come_back(&input, variant);
    hd_scene_file_free(&input);
    return 0;
}
