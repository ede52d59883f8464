/* SPDX-License-Identifier: MIT */
/* What an OBJ file says, line by line: each is checked and kept in one go. */
#ifndef HD_MESH_OBJ_TEXT_H
#define HD_MESH_OBJ_TEXT_H

#include <stdint.h>

#include "base/problems.h"
#include "mesh/mesh.h"
#include "mesh/obj/reading.h"

/* The most bytes of a line, continued ones together; comments may be longer. */
enum { HD_OBJ_MOST_LINE = 65000 };

/* What corners of faces refer to by number. */
typedef enum HdObjKind { HD_OBJ_VERTEX, HD_OBJ_UV, HD_OBJ_NORMAL, HD_OBJ_KIND_COUNT } HdObjKind;

typedef struct HdObjElements {
    double *numbers; /* owned; of each, 3 of vertices and normals and 2 of texture coordinates, all
                        rounded to float */
    size_t count, room;
    int64_t highest; /* the number, from 1, that a face names; 0: none */
    size_t line_of_highest;
} HdObjElements;

/* The material of faces before the first `usemtl`. */
#define HD_OBJ_NO_MATERIAL "default"

typedef struct HdObjFace {
    int32_t corner_count, material; /* a number of `names` */
} HdObjFace;

/* Numbers of elements from 0; -1: none. */
typedef struct HdObjCorner {
    int32_t element[HD_OBJ_KIND_COUNT];
} HdObjCorner;

typedef struct HdObjText {
    const char *path;
    HdObjMemory *memory;
    HdProblems *notes;
    HdError *error;

    HdObjElements elements[HD_OBJ_KIND_COUNT];
    HdObjFace *faces; /* owned */
    size_t face_count, face_room;
    HdObjCorner *corners; /* owned; of one face after the other */
    size_t corner_count, corner_room;
    int64_t triangle_count;
    int32_t most_corners; /* of a face */
    HdNameTable names;    /* of materials */
    char *libraries;      /* owned; their names as the file has them, each with a zero byte */
    size_t libraries_size, libraries_room;

    /* The rest is this module's own. */
    HdStatus status;  /* of the reading so far */
    int32_t material; /* -1: none has been named */
    bool has_left_out;
    int descriptor;
    char *raw; /* what has been read and not yet taken */
    size_t raw_begin, raw_end;
    char *line;         /* the one that was taken last, with those that continue it */
    size_t line_number; /* where it begins */
    size_t lines_read;
} HdObjText;

/* Reads the whole file. `text` has path, memory, notes and error, and zeros. To be freed afterwards
   in any case. */
HdStatus hd_obj_text_read(HdObjText *text);

/* The elements as an array of their own, free()'s, of just their size. */
double *hd_obj_text_take(HdObjText *text, HdObjKind kind);

void hd_obj_text_free(HdObjText *text);

/* Gives the mesh a material for each name of the text, which is taken from there: as its libraries
   define it or, where none does, white and opaque. What is not used is told in the text's notes.
   False: the memory does not suffice. */
bool hd_obj_read_materials(HdObjText *text, HdMesh *mesh);

#endif
