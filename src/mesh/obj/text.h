/* SPDX-License-Identifier: MIT */
/* What of an OBJ file fast_obj gets to see. That reader trusts its input: a comment behind a face
   makes it turn for ever, long lines end the file unseen, "nan" is 0, 1e20 too. So each line is
   checked first, and only whole lines with nothing but well-formed v, vt, vn, f and mtllib are
   handed on. Materials are told apart here, since fast_obj would compare each name with all. */
#ifndef HD_MESH_OBJ_TEXT_H
#define HD_MESH_OBJ_TEXT_H

#include <stdint.h>

#include "base/error.h"
#include "base/problems.h"
#include "mesh/obj/names.h"

/* The most bytes of a line, continued ones together; comments may be longer. */
enum { HD_OBJ_MOST_LINE = 65000 };

/* What faces refer to by number. */
typedef enum HdObjKind { HD_OBJ_VERTEX, HD_OBJ_UV, HD_OBJ_NORMAL, HD_OBJ_KIND_COUNT } HdObjKind;

typedef struct HdObjElements {
    int64_t count;
    int64_t highest; /* that a face names, 0: none */
    size_t line_of_highest;
} HdObjElements;

/* The material of faces before the first `usemtl`. */
#define HD_OBJ_NO_MATERIAL "default"

/* Faces from `first_face` on have this material, a number of `names`. */
typedef struct HdObjRun {
    uint32_t first_face;
    int32_t material;
} HdObjRun;

typedef struct HdObjText {
    const char *path;
    HdObjMemory *memory;
    HdProblems *notes;
    HdError *error;
    HdStatus status; /* of the reading so far */

    HdObjElements elements[HD_OBJ_KIND_COUNT];
    int64_t face_count, triangle_count;
    int most_corners; /* of a face */
    HdNameTable names;
    HdObjRun *runs;
    size_t run_count;

    /* The rest is this module's own. */
    int descriptor;
    bool is_at_end;
    char *raw; /* what has been read and not yet looked at */
    size_t raw_begin, raw_end;
    size_t lines_read, line_number;
    char *joined; /* a line that is continued on the next */
    char *clean;  /* the next line for fast_obj */
    size_t clean_size;
    size_t run_room;
    int material; /* -1: none has been named */
    bool has_left_out;
} HdObjText;

/* Opens the file. `text` has path, memory, notes and error, and zeros. To be closed afterwards,
   whether it could be opened or not. */
HdStatus hd_obj_text_open(HdObjText *text);

/* Writes as many whole lines as fit, which are some unless the text is at its end or is wrong:
   see `status`. `room` is at least HD_OBJ_MOST_LINE + 8. */
size_t hd_obj_text_read(HdObjText *text, char *to, size_t room);

/* What only the whole file tells: whether there are faces, and what they name. */
HdStatus hd_obj_text_finish(HdObjText *text);

void hd_obj_text_close(HdObjText *text);

#endif
