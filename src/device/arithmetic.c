/* SPDX-License-Identifier: MIT */
#include "device/arithmetic.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "device/kernel_source.h"
#include "system/cache_folder.h"

enum { KEY_LENGTH = 1024, LINE_LENGTH = 600 };

/* A line for each precision: "float: " and one of these, or a word of what is wrong. */
static const char kind[] = "arithmetic", right[] = "right", by_fma[] = "right with division by fma",
                  wrong[] = "wrong: ";
static const char *const precisions[] = {"\nfloat: ", "\ndouble: "};

/* Both lines. */
static void read_entry(const char *device, const char *driver, char key[KEY_LENGTH],
                       char lines[2][LINE_LENGTH]) {
    char text[2 * LINE_LENGTH + 32];
    HdError ignored;
    uint64_t hash = hd_hash_bytes(HD_HASH_START, hd_opencl_source, hd_opencl_source_size);
    hash = hd_hash_bytes(hash, hd_cuda_source, hd_cuda_source_size);
    snprintf(key, KEY_LENGTH, "hedron %s, kernels %016" PRIx64 "\ndevice %s\ndriver %s\n",
             HD_VERSION, hash, device, driver);
    if (hd_cache_get_text(kind, key, text, sizeof text, &ignored) != HD_OK)
        text[0] = '\0';
    for (int p = 0; p < 2; p++) {
        const char *line = strstr(text, precisions[p]);
        const char *start = line != NULL ? line + strlen(precisions[p]) : "";
        snprintf(lines[p], LINE_LENGTH, "%.*s", (int)strcspn(start, "\n"), start);
    }
}

void hd_arithmetic_remember(const char *device, const char *driver, HdPrecision precision,
                            const HdArithmetic *found) {
    char key[KEY_LENGTH], lines[2][LINE_LENGTH], text[2 * LINE_LENGTH + 32];
    HdError ignored;
    read_entry(device, driver, key, lines);
    snprintf(lines[precision], LINE_LENGTH, "%s", found->rounds_by_fma ? by_fma : right);
    if (found->difference[0] != '\0')
        snprintf(lines[precision], LINE_LENGTH, "%s%s", wrong, found->difference);
    snprintf(text, sizeof text, "%s%s%s%s\n", precisions[0], lines[0], precisions[1], lines[1]);
    hd_cache_put_text(kind, key, text, &ignored);
}

bool hd_arithmetic_recall(const char *device, const char *driver, HdPrecision precision,
                          HdArithmetic *known) {
    char key[KEY_LENGTH], lines[2][LINE_LENGTH];
    read_entry(device, driver, key, lines);
    const char *line = lines[precision];
    const bool is_wrong = strncmp(line, wrong, strlen(wrong)) == 0;
    *known = (HdArithmetic){.rounds_by_fma = strcmp(line, by_fma) == 0};
    if (is_wrong)
        snprintf(known->difference, sizeof known->difference, "%.500s", line + strlen(wrong));
    return is_wrong || known->rounds_by_fma || strcmp(line, right) == 0;
}
