/* SPDX-License-Identifier: MIT */
/* The official example of the classic input, whole, in parts and with a part changed. */
#ifndef HD_CLASSIC_TEXT_H
#define HD_CLASSIC_TEXT_H

#include <stdio.h>
#include <stdlib.h>

#include "input/classic.h"
#include "unit_test.h"

/* The official example of the task. */
static const char official[] =
    "1024\n"
    "out/img_%d.data\n"
    "640 480 120\n"
    "7.0 3.0 0.0      2.0 1.0          2.0 6.0 1.0    0.0 0.0\n"
    "2.0 0.0 0.0      0.5 0.1          1.0 4.0 1.0    0.0 0.0\n"
    "2.0 0.0 0.0      1.0 0.0 0.0      1.0    0.9     0.1       10\n"
    "0.0 2.0 0.0      0.0 1.0 0.0      0.75   0.8     0.2       5\n"
    "0.0 0.0 0.0      0.0 0.7 0.7      0.5    0.7     0.3       2\n"
    "-5.0 -5.0 -1.0 -5.0 5.0 -1.0      5.0 5.0 -1.0   5.0 -5.0 -1.0   ~/floor.data   "
    "0.0 1.0 0.0   0.5\n"
    "2\n"
    "-10.0 0.0 10.0             1.0 1.0 1.0\n"
    "1.0 0.0 10.0               0.0 0.0 1.0\n"
    "10 16\n";

/* Positions in the list of tokens. */
enum {
    FRAMES = 0,
    OUTPUT = 1,
    WIDTH = 2,
    VIEW = 4,
    EYE_R_AMPLITUDE = 8,
    TARGET_Z_PHASE = 24,
    SOLID_1 = 25,
    SOLID_2 = SOLID_1 + 10,
    FLOOR = SOLID_1 + 30,
    TEXTURE = FLOOR + 12,
    LIGHT_COUNT = TEXTURE + 5,
    DEPTH = LIGHT_COUNT + 13,
    SAMPLES = DEPTH + 1,
    TOKENS = SAMPLES + 1
};

/* Where the token begins and, by `length`, ends; `line`, counted from 1, may be NULL. */
static inline size_t token_at(int index, size_t *length, int *line) {
    static const char spaces[] = " \n";
    size_t start = 0;
    for (int i = 0; i < index; i++) {
        start += strcspn(official + start, spaces);
        start += strspn(official + start, spaces);
    }
    *length = strcspn(official + start, spaces);
    for (size_t i = 0; line != NULL && i <= start; i++)
        *line = i == 0 ? 1 : *line + (official[i - 1] == '\n');
    return start;
}

/* Parses a copy with no zero byte behind it, so that a memory checker sees a byte read too many. */
static inline HdStatus parse_bytes(HdSceneFile *input, const char *text, size_t size, int variant,
                                   HdError *error) {
    char *copy = malloc(size > 0 ? size : 1);
    assert_non_null(copy);
    memcpy(copy, text, size);
    const HdStatus status = hd_classic_parse(input, copy, size, "standard input", variant, error);
    free(copy);
    return status;
}

static inline void expect_parsed(HdSceneFile *input, const char *text, int variant) {
    static HdError error;
    if (parse_bytes(input, text, strlen(text), variant, &error) != HD_OK)
        fail_msg("%s", error.message);
}

static inline void expect_empty(const HdSceneFile *input) {
    assert_null(input->scene.solids);
    assert_null(input->scene.lights);
    assert_int_equal(input->scene.solid_count, 0);
    assert_int_equal(input->output.path[0], '\0');
}

/* The official text with one token replaced; the caller frees it. */
static inline char *with_token(int index, const char *replacement) {
    size_t length;
    const size_t start = token_at(index, &length, NULL),
                 size = sizeof official + strlen(replacement);
    char *text = malloc(size);
    assert_non_null(text);
    snprintf(text, size, "%.*s%s%s", (int)start, official, replacement, official + start + length);
    return text;
}

static inline void expect_token_accepted(HdSceneFile *input, int index, const char *replacement) {
    char *text = with_token(index, replacement);
    expect_parsed(input, text, 4);
    free(text);
}

#endif
