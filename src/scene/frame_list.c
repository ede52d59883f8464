/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "scene/frame_list.h"

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "base/text.h"

/* Every `step`-th frame from `first` to `last`, both included. */
typedef struct Range {
    int first, last, step;
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
    range->step = 1;
    if (text == end)
        return true;
    if (*text++ != '-' || !read_number(&text, end, &range->last))
        return false;
    if (text == end)
        return true;
    return *text++ == ':' && read_number(&text, end, &range->step) && text == end;
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
    if (range->step == 0)
        return fail_item(item, length, "a step of 0", frame_count, error);
    return HD_OK;
}

static int compare_ranges(const void *a, const void *b) {
    const Range *left = a, *right = b;
    return (left->first > right->first) - (left->first < right->first);
}

/* Sorts the ranges and merges those without a step, so that they share no frame; returns their
   number. */
static int merge_ranges(Range *ranges, int count) {
    int kept = 1;
    qsort(ranges, (size_t)count, sizeof *ranges, compare_ranges);
    for (int i = 1; i < count; i++) {
        Range *previous = &ranges[kept - 1];
        if (ranges[i].first > previous->last || ranges[i].step > 1 || previous->step > 1)
            ranges[kept++] = ranges[i];
        else if (ranges[i].last > previous->last)
            previous->last = ranges[i].last;
    }
    return kept;
}

static int compare_frames(const void *a, const void *b) {
    const int left = *(const int *)a, right = *(const int *)b;
    return (left > right) - (left < right);
}

/* Puts frames of overlapping ranges in order, each once. */
static void sort_list(HdFrameList *list) {
    int kept = 1;
    qsort(list->frames, (size_t)list->count, sizeof *list->frames, compare_frames);
    for (int i = 1; i < list->count; i++)
        if (list->frames[i] > list->frames[kept - 1])
            list->frames[kept++] = list->frames[i];
    list->count = kept;
}

static int frames_of(const Range *range) {
    return (range->last - range->first) / range->step + 1;
}

static HdStatus fill_list(HdFrameList *list, const Range *ranges, int count, HdError *error) {
    int64_t total = 0;
    bool overlaps = false;
    for (int i = 0; i < count; i++)
        total += frames_of(&ranges[i]);
    list->frames = total < INT_MAX ? malloc((size_t)total * sizeof *list->frames) : NULL;
    if (list->frames == NULL)
        return HD_NO_ROOM(error, "a list of %lld frames", (long long)total);
    for (int i = 0; i < count; i++) {
        overlaps |= i > 0 && ranges[i].first <= ranges[i - 1].last;
        for (int k = 0; k < frames_of(&ranges[i]); k++)
            list->frames[list->count++] = ranges[i].first + k * ranges[i].step;
    }
    if (overlaps)
        sort_list(list);
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
    Range all = {0, frame_count - 1, 1};
    return fill_list(list, &all, 1, error);
}

/* Returns the first index from `i` on whose mark is `wanted`, or the list's count. */
static int next_marked(const HdFrameList *list, const bool *marks, bool wanted, int i) {
    while (i < list->count && marks[i] != wanted)
        i++;
    return i;
}

/* Finds the frames from index `i` on that make a range; two with a step are none. Returns the index
   of the next one. */
static int find_range(const HdFrameList *list, const bool *marks, bool wanted, int i,
                      Range *range) {
    const int *frames = list->frames;
    const int second = next_marked(list, marks, wanted, i + 1);
    int next = second, count = 1;
    *range = (Range){frames[i], frames[i], 1};
    if (second == list->count)
        return second;
    range->step = frames[second] - frames[i];
    for (; next < list->count && frames[next] - range->last == range->step; count++) {
        range->last = frames[next];
        next = next_marked(list, marks, wanted, next + 1);
    }
    if (count > 2 || range->step == 1)
        return next;
    range->last = range->first;
    return second;
}

void hd_frame_list_write(const HdFrameList *list, const bool *marks, bool wanted,
                         char text[HD_FRAMES_TEXT]) {
    Range range;
    text[0] = '\0';
    for (int i = next_marked(list, marks, wanted, 0); i < list->count;) {
        char item[40] = "";
        i = find_range(list, marks, wanted, i, &range);
        hd_add_text(item, sizeof item, "", range.last > range.first ? "%d-%d" : "%d", range.first,
                    range.last);
        if (range.last > range.first && range.step > 1)
            hd_add_text(item, sizeof item, ":", "%d", range.step);
        if (strlen(text) + strlen(item) + sizeof ",,..." > HD_FRAMES_TEXT) {
            hd_add_text(text, HD_FRAMES_TEXT, ",", "...");
            return;
        }
        hd_add_text(text, HD_FRAMES_TEXT, ",", "%s", item);
    }
}

void hd_frame_list_free(HdFrameList *list) {
    free(list->frames);
    *list = (HdFrameList){0};
}
