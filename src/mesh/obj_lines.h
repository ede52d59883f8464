/* SPDX-License-Identifier: MIT */
/* Lines of an OBJ file, and the messages of its reader. */
#ifndef HD_MESH_OBJ_LINES_H
#define HD_MESH_OBJ_LINES_H

#include <stdio.h>

#include "mesh/obj_reading.h"

/* Initialise the first three members only. */
typedef struct HdObjLines {
    const char *path;
    HdObjMemory *memory;
    HdError *error;

    HdStatus status;    /* result of reading so far */
    size_t line_number; /* number of the current line, the first of its continuations */
    size_t lines_read;
    FILE *file;
    bool is_utf16;
    int low_byte; /* index of it in a unit of UTF-16 */
    char *buffer; /* bytes of the file not yet read; */
    const char *next, *end;
    char *line; /* the current line with its continuations */
} HdObjLines;

/* Opens the file behind a byte order mark. In UTF-16, which needs the mark, characters beyond ASCII
   are read as "?". Returns false on failure, with status and error; in both
   cases close it. */
bool hd_obj_lines_open(HdObjLines *lines);

/* Reads the next line without its end and comments; it is valid until the next call. Zero bytes
   behind the last line are no part of the file. Returns false at the end of the file or on an
   error. */
bool hd_obj_lines_next(HdObjLines *lines, HdSpan *line);

void hd_obj_lines_close(HdObjLines *lines);

/* Fails because memory is short or used up. */
HdStatus hd_obj_fail_memory(const HdObjLines *lines);

/* Set status and error, and return false. */
bool hd_obj_fail_allocation(HdObjLines *lines);
bool hd_obj_fail_reading(HdObjLines *lines, const char *reason);
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
bool hd_obj_fail_at(HdObjLines *lines, size_t line, const char *format, ...);

#endif
