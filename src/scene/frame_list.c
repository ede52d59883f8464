/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "scene/frame_list.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "base/text.h"

/* Characters of a range with its comma, and of what stands for those that have no room. */
enum { MAX_RANGE_TEXT = 28 };

/* Frames from `first` to `last`, both included. */
typedef struct Range {
    int first, last;
} Range;

static HdStatus fail_item(const char *item, size_t length, const char *what, int frame_count,
                          HdError *error) {
    char expected[80] = "the scene has one frame, 0";
    if (frame_count != 1)
        snprintf(expected, sizeof expected, "expected frames or ascending ranges within 0-%d",
                 frame_count - 1);
    return hd_fail(error, HD_BAD_INPUT, "the frame list has \"%.*s\", %s; %s",
                   (int)(length < 1000 ? length : 1000), item, what, expected);
}

/* Moves `*text` past the digits. A number beyond int becomes INT_MAX, which no sequence contains.
 */
static bool read_number(const char **text, const char *end, int *number) {
    const char *start = *text;
    *number = 0;
    for (; *text < end && **text >= '0' && **text <= '9'; (*text)++) {
        int digit = **text - '0';
        *number = *number > (INT_MAX - digit) / 10 ? INT_MAX : *number * 10 + digit;
    }
    return *text > start;
}

static bool read_range(const char *text, const char *end, Range *range) {
    if (!read_number(&text, end, &range->first))
        return false;
    range->last = range->first;
    if (text == end)
        return true;
    if (*text++ != '-')
        return false;
    return read_number(&text, end, &range->last) && text == end;
}

static HdStatus parse_item(const char *item, size_t length, int frame_count, Range *range,
                           HdError *error) {
    if (length == 0)
        return fail_item(item, length, "an empty item", frame_count, error);
    if (!read_range(item, item + length, range))
        return fail_item(item, length, "which is neither a frame nor a range", frame_count, error);
    if (range->first >= frame_count || range->last >= frame_count)
        return fail_item(item, length, "which lies outside the sequence", frame_count, error);
    if (range->first > range->last)
        return fail_item(item, length, "a descending range", frame_count, error);
    return HD_OK;
}

static int compare_ranges(const void *a, const void *b) {
    const Range *left = a, *right = b;
    return (left->first > right->first) - (left->first < right->first);
}

/* Sorts and merges the ranges so that they share no frame; returns their number. */
static int merge_ranges(Range *ranges, int count) {
    int kept = 1;
    qsort(ranges, (size_t)count, sizeof *ranges, compare_ranges);
    for (int i = 1; i < count; i++) {
        Range *previous = &ranges[kept - 1];
        if (ranges[i].first > previous->last)
            ranges[kept++] = ranges[i];
        else if (ranges[i].last > previous->last)
            previous->last = ranges[i].last;
    }
    return kept;
}

static HdStatus fill_list(HdFrameList *list, const Range *ranges, int count, HdError *error) {
    int total = 0; /* sum, at most the frames of the sequence, so an int */
    for (int i = 0; i < count; i++)
        total += ranges[i].last - ranges[i].first + 1;
    list->frames = malloc((size_t)total * sizeof *list->frames);
    if (list->frames == NULL)
        return HD_NO_ROOM(error, "a list of %d frames", total);
    for (int i = 0; i < count; i++)
        for (int frame = ranges[i].first; frame <= ranges[i].last; frame++)
            list->frames[list->count++] = frame;
    return HD_OK;
}

static HdStatus parse_text(HdFrameList *list, const char *text, int frame_count, HdError *error) {
    Range *ranges = NULL, range;
    int count = 0, capacity = 0;
    HdStatus status = HD_OK;
    bool has_memory = true;
    for (bool is_last = false; !is_last && has_memory && status == HD_OK;) {
        const size_t length = strcspn(text, ",");
        status = parse_item(text, length, frame_count, &range, error);
        if (status == HD_OK)
            has_memory = hd_append(&ranges, sizeof range, &count, &capacity, &range);
        is_last = text[length] == '\0';
        text += length + 1;
    }
    if (!has_memory)
        status = HD_NO_ROOM(error, "a frame list");
    else if (status == HD_OK)
        status = fill_list(list, ranges, merge_ranges(ranges, count), error);
    free(ranges);
    return status;
}

HdStatus hd_frame_list_parse(HdFrameList *list, const char *text, int frame_count, HdError *error) {
    *list = (HdFrameList){0};
    if (text != NULL)
        return parse_text(list, text, frame_count, error);
    Range all = {0, frame_count - 1};
    return fill_list(list, &all, 1, error);
}

void hd_frame_list_write(const HdFrameList *list, const bool *marks, bool wanted,
                         char text[HD_FRAMES_TEXT]) {
    int first = 0;
    text[0] = '\0';
    for (int i = 0; i < list->count; i++) {
        const int frame = list->frames[i];
        if (marks[i] != wanted)
            continue;
        if (i == 0 || marks[i - 1] != wanted || list->frames[i - 1] != frame - 1)
            first = frame;
        if (i + 1 < list->count && marks[i + 1] == wanted && list->frames[i + 1] == frame + 1)
            continue;
        if (strlen(text) + MAX_RANGE_TEXT >= HD_FRAMES_TEXT) {
            hd_add_text(text, HD_FRAMES_TEXT, ",", "...");
            return;
        }
        hd_add_text(text, HD_FRAMES_TEXT, ",", first < frame ? "%d-%d" : "%d", first, frame);
    }
}

void hd_frame_list_free(HdFrameList *list) {
    free(list->frames);
    *list = (HdFrameList){0};
}
