/* SPDX-License-Identifier: MIT */
/* The lines of an OBJ file, whatever ends them, with those that continue them. */
#ifndef HD_MESH_OBJ_LINES_H
#define HD_MESH_OBJ_LINES_H

#include "mesh/obj/memory.h"
#include "mesh/obj/words.h"

/* The most bytes of a line, continued ones together; comments may be longer. */
enum { HD_OBJ_MOST_LINE = 65000 };

typedef struct HdObjLines {
    const char *path;
    HdObjMemory *memory;
    HdError *error;
    HdStatus status;    /* of the reading so far */
    size_t line_number; /* of the line that was taken last, where it begins */

    /* The rest is this module's own. */
    int descriptor;
    char *raw; /* what has been read and not yet taken */
    size_t raw_begin, raw_end;
    size_t lines_read;
    char *text; /* the line, with those that continue it */
} HdObjLines;

/* Opens the file. `lines` has path, memory and error, and zeros. To be closed afterwards, whether
   it could be opened or not. */
HdStatus hd_obj_lines_open(HdObjLines *lines);

/* Takes the next line, which lasts until another is taken: without its end, and of a comment
   nothing. False: there is none, or something is wrong (`status`). */
bool hd_obj_lines_next(HdObjLines *lines, HdSpan *line);

void hd_obj_lines_close(HdObjLines *lines);

/* Set `status` and the error, and return false. */
bool hd_obj_fail_reading(HdObjLines *lines, const char *reason);
bool hd_obj_fail_room(HdObjLines *lines);
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
bool hd_obj_fail_at(HdObjLines *lines, size_t line, const char *format, ...);

#endif
