/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "mesh/obj/lines.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "system/file_bytes.h"

enum { RAW_SIZE = 1 << 17 };

_Static_assert(RAW_SIZE > HD_OBJ_MOST_LINE + 2, "a line and its end fit into the buffer");

static const char byte_order_mark[] = "\xef\xbb\xbf";

bool hd_obj_fail_reading(HdObjLines *lines, const char *reason) {
    lines->status =
        hd_fail(lines->error, HD_BAD_INPUT, "cannot read the mesh %s: %s", lines->path, reason);
    return false;
}

bool hd_obj_fail_room(HdObjLines *lines) {
    lines->status = hd_obj_fail_memory(lines->memory, lines->path, lines->error);
    return false;
}

bool hd_obj_fail_at(HdObjLines *lines, size_t line, const char *format, ...) {
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    lines->status =
        hd_fail(lines->error, HD_BAD_INPUT, "%s: line %zu: %s", lines->path, line, message);
    return false;
}

/* Reads until the buffer is full or the file ends. */
static bool fill(HdObjLines *lines) {
    memmove(lines->raw, lines->raw + lines->raw_begin, lines->raw_end - lines->raw_begin);
    lines->raw_end -= lines->raw_begin;
    lines->raw_begin = 0;
    const ssize_t count =
        hd_read_fully(lines->descriptor, lines->raw + lines->raw_end, RAW_SIZE - lines->raw_end);
    if (count < 0)
        return hd_obj_fail_reading(lines, strerror(errno));
    lines->raw_end += (size_t)count;
    return true;
}

static bool open_file(HdObjLines *lines) {
    struct stat found;
    /* Not blocking, lest a named pipe stops the program before it is refused. */
    lines->descriptor = open(lines->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (lines->descriptor < 0 || fstat(lines->descriptor, &found) != 0)
        return hd_obj_fail_reading(lines, strerror(errno));
    if (S_ISDIR(found.st_mode))
        return hd_obj_fail_reading(lines, strerror(EISDIR));
    if (!S_ISREG(found.st_mode))
        return hd_obj_fail_reading(lines, "it is not a regular file");
    return true;
}

HdStatus hd_obj_lines_open(HdObjLines *lines) {
    if (!open_file(lines))
        return lines->status;
    lines->raw = hd_obj_allocate(lines->memory, RAW_SIZE, 1);
    lines->joined = hd_obj_allocate(lines->memory, HD_OBJ_MOST_LINE, 1);
    if (lines->raw == NULL || lines->joined == NULL)
        hd_obj_fail_room(lines);
    else if (fill(lines) && lines->raw_end >= 3 && memcmp(lines->raw, byte_order_mark, 3) == 0)
        lines->raw_begin = 3;
    return lines->status;
}

void hd_obj_lines_close(HdObjLines *lines) {
    if (lines->descriptor >= 0)
        close(lines->descriptor);
    hd_obj_release(lines->memory, lines->raw, RAW_SIZE);
    hd_obj_release(lines->memory, lines->joined, HD_OBJ_MOST_LINE);
}

/* Looks for the line's end from `*at` on; false: it is not in the buffer, or something is wrong. */
static bool find_end(HdObjLines *lines, size_t *at) {
    const unsigned char *raw = (const unsigned char *)lines->raw;
    for (; *at < lines->raw_end; ++*at) {
        const unsigned char byte = raw[*at];
        if (byte > '\r')
            continue;
        if (byte == '\n' || byte == '\r')
            return true;
        if (byte == '\0')
            return hd_obj_fail_at(lines, lines->lines_read + 1,
                                  "it has a byte 0, so this is no OBJ file");
    }
    return false;
}

/* Takes the line end at raw_begin: "\n", "\r\n" or, as old files have it, "\r". */
static bool skip_end(HdObjLines *lines) {
    if (lines->raw_begin == lines->raw_end)
        return true;
    if (lines->raw[lines->raw_begin++] == '\n')
        return true;
    if (lines->raw_begin == lines->raw_end && !fill(lines))
        return false;
    if (lines->raw_begin < lines->raw_end && lines->raw[lines->raw_begin] == '\n')
        lines->raw_begin++;
    return true;
}

/* Passes over the rest of a comment that is longer than the buffer. */
static bool skip_comment(HdObjLines *lines) {
    size_t at = lines->raw_end;
    while (!find_end(lines, &at)) {
        if (lines->status != HD_OK)
            return false;
        lines->raw_begin = lines->raw_end;
        if (!fill(lines))
            return false;
        at = 0;
        if (lines->raw_end == 0)
            return true;
    }
    lines->raw_begin = at;
    return true;
}

/* The next line as it stands in the file, whose end is taken before the one after it; NULL for its
   begin at the end, or when something is wrong. */
static HdSpan next_raw_line(HdObjLines *lines) {
    const HdSpan none = {NULL, NULL};
    if (lines->lines_read > 0 && !skip_end(lines))
        return none;
    size_t at = lines->raw_begin;
    if (!find_end(lines, &at)) {
        const size_t seen = at - lines->raw_begin;
        if (lines->status != HD_OK || !fill(lines))
            return none;
        at = seen;
        if (!find_end(lines, &at) && lines->status != HD_OK)
            return none;
    }
    if (lines->raw_begin == lines->raw_end)
        return none;
    HdSpan line = {lines->raw + lines->raw_begin, lines->raw + at};
    lines->lines_read++;
    lines->raw_begin = at;
    const HdSpan text = hd_rest(line);
    if (text.begin < text.end && *text.begin == '#') {
        line.end = line.begin;
        if (at == RAW_SIZE && !skip_comment(lines))
            return none;
    } else if (line.end - line.begin > HD_OBJ_MOST_LINE) {
        hd_obj_fail_at(lines, lines->lines_read, "it is longer than %d bytes", HD_OBJ_MOST_LINE);
        return none;
    }
    return line;
}

/* Puts the line behind the `*used` bytes of those that it continues. */
static bool join(HdObjLines *lines, HdSpan line, size_t *used) {
    const size_t length = (size_t)(line.end - line.begin);
    if (*used + length > HD_OBJ_MOST_LINE)
        return hd_obj_fail_at(lines, lines->line_number,
                              "with those that continue it, it is longer than %d bytes",
                              HD_OBJ_MOST_LINE);
    memcpy(lines->joined + *used, line.begin, length);
    *used += length;
    return true;
}

static bool is_continued(HdSpan line) {
    return line.begin != NULL && line.begin < line.end && line.end[-1] == '\\';
}

bool hd_obj_lines_next(HdObjLines *lines, HdSpan *line) {
    size_t used = 0;
    *line = next_raw_line(lines);
    lines->line_number = lines->lines_read;
    while (is_continued(*line)) {
        if (!join(lines, *line, &used))
            return false;
        lines->joined[used - 1] = ' ';
        *line = next_raw_line(lines);
    }
    if (lines->status != HD_OK || used == 0)
        return lines->status == HD_OK && line->begin != NULL;
    if (line->begin != NULL && !join(lines, *line, &used))
        return false;
    *line = (HdSpan){lines->joined, lines->joined + used};
    return true;
}
