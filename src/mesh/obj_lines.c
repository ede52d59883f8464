/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "mesh/obj_lines.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "system/path.h"

enum { BUFFER_SIZE = 1 << 17, TEXT_SIZE = 2 * HD_OBJ_MAX_LINE + 1 };

HdStatus hd_obj_fail_memory(const HdObjLines *lines) {
    if (lines->memory->is_over)
        return hd_fail(lines->error, HD_BAD_INPUT,
                       "%s: reading it needs more than the %zu bytes of memory allowed",
                       lines->path, lines->memory->max_bytes);
    return hd_fail(lines->error, HD_FAILED, "out of memory: no room to read the mesh %s",
                   lines->path);
}

bool hd_obj_fail_allocation(HdObjLines *lines) {
    lines->status = hd_obj_fail_memory(lines);
    return false;
}

bool hd_obj_fail_reading(HdObjLines *lines, const char *reason) {
    lines->status =
        hd_fail(lines->error, HD_BAD_INPUT, "cannot read the mesh %s: %s", lines->path, reason);
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

static bool open_file(HdObjLines *lines) {
    struct stat found;
    const char *reason;
    lines->file = hd_file_open(lines->path, &found, &reason);
    return lines->file != NULL ||
           hd_obj_fail_reading(lines, S_ISDIR(found.st_mode) ? strerror(EISDIR) : reason);
}

/* Replaces the UTF-16 in the buffer by ASCII. */
static void narrow(HdObjLines *lines) {
    const size_t count = (size_t)(lines->end - lines->buffer) / 2;
    for (size_t i = 0; i < count; i++) {
        const unsigned char low = (unsigned char)lines->buffer[2 * i + (size_t)lines->low_byte];
        const char high = lines->buffer[2 * i + 1 - (size_t)lines->low_byte];
        lines->buffer[i] = high == 0 && low < 0x80 ? (char)low : '?';
    }
    lines->end = lines->buffer + count;
}

static bool has_next(HdObjLines *lines) {
    if (lines->next == lines->end) {
        lines->next = lines->buffer;
        lines->end = lines->buffer + fread(lines->buffer, 1, BUFFER_SIZE, lines->file);
        if (lines->is_utf16)
            narrow(lines);
    }
    return lines->next < lines->end;
}

static void skip_mark(HdObjLines *lines) {
    const bool has_unit = has_next(lines) && lines->end - lines->next >= 2;
    lines->low_byte = has_unit && memcmp(lines->next, "\xfe\xff", 2) == 0;
    lines->is_utf16 = has_unit && (lines->low_byte == 1 || memcmp(lines->next, "\xff\xfe", 2) == 0);
    if (lines->is_utf16)
        narrow(lines);
    lines->next += lines->is_utf16 ? 1 : hd_mark_size((HdSpan){lines->next, lines->end});
}

bool hd_obj_lines_open(HdObjLines *lines) {
    if (!open_file(lines))
        return false;
    lines->buffer = hd_obj_allocate(lines->memory, BUFFER_SIZE, 1);
    lines->line = hd_obj_allocate(lines->memory, TEXT_SIZE, 1);
    if (lines->buffer == NULL || lines->line == NULL)
        return hd_obj_fail_allocation(lines);
    lines->next = lines->end = lines->buffer;
    skip_mark(lines);
    return true;
}

void hd_obj_lines_close(HdObjLines *lines) {
    if (lines->file != NULL)
        fclose(lines->file);
    hd_obj_release(lines->memory, lines->buffer, BUFFER_SIZE);
    hd_obj_release(lines->memory, lines->line, TEXT_SIZE);
}

static bool is_comment(const char *line, size_t length) {
    const HdSpan span = hd_rest((HdSpan){line, line + length});
    return span.begin < span.end && *span.begin == '#';
}

/* Copies the bytes of a line, at most one more than allowed, to `line`; returns how many. */
static size_t copy_bytes(HdObjLines *lines, char *line) {
    size_t length = 0;
    const char *at;
    do {
        for (at = lines->next; at < lines->end && *at != '\n' && *at != '\r' && *at != '\0'; at++)
            continue;
        const size_t size = (size_t)(at - lines->next), capacity = HD_OBJ_MAX_LINE + 1 - length;
        memcpy(line + length, lines->next, size < capacity ? size : capacity);
        length += size < capacity ? size : capacity;
        lines->next = at;
    } while (at == lines->end && has_next(lines));
    return length;
}

/* Skips the padding of zero bytes and end marks that some programs leave. Returns whether it goes
   on to the end of the file. */
static bool skip_padding(HdObjLines *lines) {
    while (has_next(lines)) {
        lines->next += hd_padding_size((HdSpan){lines->next, lines->end});
        if (lines->next < lines->end)
            return false;
    }
    return true;
}

/* Appends a line, up to "\n", "\r\n" or an old "\r", to the `*used` bytes that it continues; drops
   comments. Returns false at the end of the file or on an error. */
static bool join_line(HdObjLines *lines, size_t *used) {
    const bool is_there = has_next(lines);
    lines->lines_read += is_there;
    size_t length = copy_bytes(lines, lines->line + *used);
    if (ferror(lines->file))
        return hd_obj_fail_reading(lines, strerror(errno));
    if (is_comment(lines->line + *used, length))
        length = 0;
    *used += length;
    if (length > HD_OBJ_MAX_LINE)
        return hd_obj_fail_at(lines, lines->lines_read, "it is longer than %d bytes",
                              HD_OBJ_MAX_LINE);
    if (*used > HD_OBJ_MAX_LINE)
        return hd_obj_fail_at(lines, lines->line_number,
                              "with its continuations it is longer than %d bytes", HD_OBJ_MAX_LINE);
    const char end = has_next(lines) ? *lines->next++ : '\n';
    if (end == '\0' && !skip_padding(lines))
        return hd_obj_fail_at(lines, lines->lines_read, "it has a NUL byte, so it is no OBJ file");
    if (end == '\r' && has_next(lines) && *lines->next == '\n')
        lines->next++;
    return is_there;
}

bool hd_obj_lines_next(HdObjLines *lines, HdSpan *line) {
    size_t used = 0;
    lines->line_number = lines->lines_read + 1;
    bool is_taken = join_line(lines, &used);
    while (is_taken && used > 0 && lines->line[used - 1] == '\\') {
        lines->line[used - 1] = ' ';
        is_taken = join_line(lines, &used);
    }
    *line = (HdSpan){lines->line, lines->line + used};
    return lines->status == HD_OK && (is_taken || used > 0);
}
