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

#include "system/path.h"

enum { RAW_SIZE = 1 << 17, TEXT_SIZE = 2 * HD_OBJ_MOST_LINE + 1 };

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

/* Reads what comes next. False: there is nothing, or it cannot be read. */
static bool fill(HdObjLines *lines) {
    const ssize_t count = hd_read_fully(lines->descriptor, lines->raw, RAW_SIZE);
    if (count < 0)
        return hd_obj_fail_reading(lines, strerror(errno));
    lines->raw_begin = 0;
    lines->raw_end = (size_t)count;
    return count > 0;
}

static bool has_next(HdObjLines *lines) {
    return lines->raw_begin < lines->raw_end || fill(lines);
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
    lines->text = hd_obj_allocate(lines->memory, TEXT_SIZE, 1);
    if (lines->raw == NULL || lines->text == NULL)
        hd_obj_fail_room(lines);
    else if (fill(lines) && lines->raw_end >= 3 && memcmp(lines->raw, byte_order_mark, 3) == 0)
        lines->raw_begin = 3;
    return lines->status;
}

void hd_obj_lines_close(HdObjLines *lines) {
    if (lines->descriptor >= 0)
        close(lines->descriptor);
    hd_obj_release(lines->memory, lines->raw, RAW_SIZE);
    hd_obj_release(lines->memory, lines->text, TEXT_SIZE);
}

static bool is_comment(const char *text, size_t length) {
    const HdSpan span = hd_rest((HdSpan){text, text + length});
    return span.begin < span.end && *span.begin == '#';
}

/* Takes what the buffer has of a line, which is put behind the `*length` bytes that `text` has of
   it; of what is too long only its beginning. Whether the line goes on, and is not refused. */
static bool take_piece(HdObjLines *lines, char *text, size_t *length) {
    const char *begin = lines->raw + lines->raw_begin, *end = lines->raw + lines->raw_end;
    const char *at = begin;
    while (at < end && *at != '\n' && *at != '\r' && *at != '\0')
        at++;
    const size_t size = (size_t)(at - begin), room = HD_OBJ_MOST_LINE + 1 - *length;
    const size_t kept = size < room ? size : room;
    memcpy(text + *length, begin, kept);
    *length += kept;
    lines->raw_begin += size;
    return at == end && (*length <= HD_OBJ_MOST_LINE || is_comment(text, *length)) && fill(lines);
}

/* Takes a line's end: "\n", "\r\n" or, as old files have it, "\r". */
static bool take_end(HdObjLines *lines) {
    if (!has_next(lines))
        return lines->status == HD_OK;
    const char end = lines->raw[lines->raw_begin++];
    if (end == '\0')
        return hd_obj_fail_at(lines, lines->lines_read, "it has a byte 0, so this is no OBJ file");
    if (end == '\r' && has_next(lines) && lines->raw[lines->raw_begin] == '\n')
        lines->raw_begin++;
    return lines->status == HD_OK;
}

/* Takes a line of the file and puts it behind the `*used` bytes of those that it continues, but
   nothing of a comment. False: there is none, or something is wrong. */
static bool take_line(HdObjLines *lines, size_t *used) {
    char *text = lines->text + *used;
    size_t length = 0;
    if (!has_next(lines))
        return false;
    lines->lines_read++;
    while (take_piece(lines, text, &length))
        continue;
    if (is_comment(text, length))
        length = 0;
    if (length > HD_OBJ_MOST_LINE)
        return hd_obj_fail_at(lines, lines->lines_read, "it is longer than %d bytes",
                              HD_OBJ_MOST_LINE);
    *used += length;
    if (*used > HD_OBJ_MOST_LINE)
        return hd_obj_fail_at(lines, lines->line_number,
                              "with those that continue it, it is longer than %d bytes",
                              HD_OBJ_MOST_LINE);
    return take_end(lines);
}

bool hd_obj_lines_next(HdObjLines *lines, HdSpan *line) {
    size_t used = 0;
    lines->line_number = lines->lines_read + 1;
    bool is_taken = take_line(lines, &used);
    while (is_taken && used > 0 && lines->text[used - 1] == '\\') {
        lines->text[used - 1] = ' ';
        is_taken = take_line(lines, &used);
    }
    *line = (HdSpan){lines->text, lines->text + used};
    return lines->status == HD_OK && (is_taken || used > 0);
}
