/* SPDX-License-Identifier: MIT */
/* Path patterns. Input: a byte that selects a frame's number, and the pattern. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "image/picture.h"
#include "system/path.h"

static void check_name(const char *name, const char *pattern) {
    const size_t length = strlen(name);
    fuzz_expect(length < HD_MAX_PATH, "a name without its end");
    fuzz_expect(length <= strlen(pattern) + 16, "a name that is too long for its pattern");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    char name[HD_MAX_PATH], home[HD_MAX_PATH];
    if (size < 1)
        return 0;
    char *pattern = fuzz_text(data + 1, size - 1);
    const int frame = data[0] * 39215; /* up to the highest number of a frame */
    const HdStatus is_pattern = hd_pattern_check(pattern, &error);
    fuzz_expect_input_status(is_pattern, &error);
    fuzz_expect(is_pattern != HD_OK || hd_pattern_has_number(pattern),
                "a pattern that has no number");
    if (hd_pattern_format(pattern, frame, name, &error) == HD_OK)
        check_name(name, pattern);
    if (hd_pattern_format_single(pattern, name, &error) == HD_OK) {
        check_name(name, pattern);
        fuzz_expect(is_pattern != HD_OK, "a name that is a pattern too");
    }
    if (hd_path_expand_home(pattern, home, &error) == HD_OK)
        hd_format_of(home);
    free(pattern);
    return 0;
}
