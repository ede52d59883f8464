/* SPDX-License-Identifier: MIT */
#include "output/frame_names.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A number that differs from 0 in its first digit, however many digits 0 has. */
enum { ALL_ONES = 1111111111, MAX_DIGITS = 10 };

static size_t common_length(const char *a, const char *b) {
    size_t length = 0;
    while (a[length] != '\0' && a[length] == b[length])
        length++;
    return length;
}

/* `out` gets `length` bytes. */
static void cut_out(char out[HD_MAX_PATH], const char *text, size_t length) {
    memcpy(out, text, length);
    out[length] = '\0';
}

HdStatus hd_frame_names_find(HdFrameNames *names, const HdOutput *output, const HdFrameList *frames,
                             HdError *error) {
    char zero[HD_MAX_PATH], ones[HD_MAX_PATH];
    names->frames = frames;
    HdStatus status = hd_output_file(output, 0, zero, error);
    if (status == HD_OK)
        status = hd_output_file(output, ALL_ONES, ones, error);
    if (status != HD_OK)
        return status;
    const size_t number = common_length(zero, ones);
    const char *behind = output->is_numbered ? ones + number + MAX_DIGITS : ones + number;
    names->digits = (int)(strlen(zero) - number - strlen(behind));
    size_t entry = number;
    while (entry > 0 && zero[entry - 1] != '/')
        entry--;
    const size_t suffix = strcspn(behind, "/");
    cut_out(names->folder, zero, entry);
    cut_out(names->prefix, zero + entry, number - entry);
    cut_out(names->suffix, behind, suffix);
    cut_out(names->rest, behind + suffix, strlen(behind + suffix));
    return HD_OK;
}

static int compare_numbers(const void *a, const void *b) {
    const int left = *(const int *)a, right = *(const int *)b;
    return (left > right) - (left < right);
}

static int find_frame(const HdFrameList *frames, int number) {
    const int *found =
        bsearch(&number, frames->frames, (size_t)frames->count, sizeof number, compare_numbers);
    return found != NULL ? (int)(found - frames->frames) : -1;
}

/* Negative where these are no digits of a number as it is written. */
static int read_number(const HdFrameNames *names, const char *text, int digits) {
    int64_t number = 0;
    if (digits > names->digits && text[0] == '0')
        return -1;
    for (int i = 0; i < digits; i++) {
        if (text[i] < '0' || text[i] > '9')
            return -1;
        number = 10 * number + (text[i] - '0');
    }
    return number <= INT_MAX ? (int)number : -1;
}

static bool is_suffix(const HdFrameNames *names, const char *text, size_t length, bool is_cut) {
    const size_t whole = strlen(names->suffix);
    return (is_cut ? length <= whole : length == whole) && memcmp(text, names->suffix, length) == 0;
}

int hd_frame_names_place(const HdFrameNames *names, const char *entry, size_t length, bool is_cut) {
    const size_t before = strlen(names->prefix);
    if (is_cut && length <= before)
        return memcmp(entry, names->prefix, length) == 0 ? 0 : -1;
    if (length < before || memcmp(entry, names->prefix, before) != 0)
        return -1;
    if (names->digits == 0)
        return is_suffix(names, entry + before, length - before, is_cut) ? 0 : -1;
    for (int digits = names->digits; digits <= MAX_DIGITS; digits++) {
        const size_t end = before + (size_t)digits;
        if (end > length)
            return is_cut && read_number(names, entry + before, (int)(length - before)) >= 0 ? 0
                                                                                             : -1;
        const int number = read_number(names, entry + before, digits);
        const int place = number >= 0 ? find_frame(names->frames, number) : -1;
        if (place >= 0 && is_suffix(names, entry + end, length - end, is_cut))
            return place;
    }
    return -1;
}
