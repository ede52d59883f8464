/* SPDX-License-Identifier: MIT */
/* Writes a Wavefront OBJ of any size in little memory: the text depends on nothing but the calls.
 */
#ifndef HD_OBJ_WRITER_H
#define HD_OBJ_WRITER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct HdObjWriter {
    FILE *stream;
    bool failed; /* nothing is written any more */
    int reason;  /* errno of the write that failed; 0 where a signal ended the work */
    size_t used;
    char buffer[65536];
} HdObjWriter;

/* `stream` stays the caller's, and nobody else writes to it until hd_obj_end. */
void hd_obj_begin(HdObjWriter *writer, FILE *stream);

/* A line of comment, without line breaks, of at most 200 bytes. */
void hd_obj_comment(HdObjWriter *writer, const char *text);

/* `point` is x, y, z, each within -1000..1000; 6 decimals of them are kept. */
void hd_obj_vertex(HdObjWriter *writer, const double point[3]);

/* A triangle of the vertices with these numbers, which count from 0, counterclockwise as seen from
   the outer side. */
void hd_obj_triangle(HdObjWriter *writer, int a, int b, int c);

/* Two triangles, a b c and a c d. */
void hd_obj_quad(HdObjWriter *writer, int a, int b, int c, int d);

/* Hands the rest to the system. Whether all arrived: see `failed`. */
void hd_obj_end(HdObjWriter *writer);

#endif
