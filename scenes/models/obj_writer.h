/* SPDX-License-Identifier: MIT */
/* Writes a Wavefront OBJ of any size in little memory: the text depends on nothing but the
   calls. */
#ifndef HD_OBJ_WRITER_H
#define HD_OBJ_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct HdObjWriter {
    FILE *stream;
    bool failed; /* whether writing has stopped */
    int reason;  /* errno of the failed write; 0 if a signal ended the work */
    size_t used;
    char buffer[65536];
} HdObjWriter;

/* Begins a file. `stream` stays the caller's, and nobody else writes to it until hd_obj_end. */
void hd_obj_begin(HdObjWriter *writer, FILE *stream);

/* Writes a comment, without line breaks, of at most 200 bytes. */
void hd_obj_comment(HdObjWriter *writer, const char *text);

/* Writes a vertex. `point` is x, y, z, each within -1000..1000; 6 decimals of them are kept. */
void hd_obj_vertex(HdObjWriter *writer, const double point[3]);

/* Writes a triangle of the vertices with these numbers, which count from 0, counterclockwise as
   seen from the outer side. */
void hd_obj_triangle(HdObjWriter *writer, int a, int b, int c);

/* Writes two triangles, a b c and a c d. */
void hd_obj_quad(HdObjWriter *writer, int a, int b, int c, int d);

/* Writes the rest; `failed` tells whether all arrived. */
void hd_obj_end(HdObjWriter *writer);

#endif
