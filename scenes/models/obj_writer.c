/* SPDX-License-Identifier: MIT */
#include "obj_writer.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "system/interrupt.h"

enum { DECIMALS = 6, MILLION = 1000000, LONGEST_LINE = 256 };

static void hand_over(HdObjWriter *writer) {
    errno = 0;
    if (hd_interrupt_signal() != 0)
        writer->failed = true;
    if (writer->failed)
        return;
    if (fwrite(writer->buffer, 1, writer->used, writer->stream) != writer->used ||
        fflush(writer->stream) != 0) {
        writer->failed = true;
        writer->reason = errno;
    }
}

/* Makes space for one more line. */
static void begin_line(HdObjWriter *writer) {
    if (sizeof writer->buffer - writer->used >= LONGEST_LINE)
        return;
    hand_over(writer);
    writer->used = 0;
}

static void put_char(HdObjWriter *writer, char byte) {
    writer->buffer[writer->used++] = byte;
}

/* Appends `number` in decimal, with zeros before it up to `least` digits. */
static void put_digits(HdObjWriter *writer, unsigned number, int least) {
    char digits[16];
    int count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number != 0);
    while (count < least)
        digits[count++] = '0';
    while (count > 0)
        put_char(writer, digits[--count]);
}

static void put_decimal(HdObjWriter *writer, double value) {
    long scaled = lround(value * MILLION);
    unsigned size = (unsigned)(scaled < 0 ? -scaled : scaled);
    put_char(writer, ' ');
    if (scaled < 0)
        put_char(writer, '-');
    put_digits(writer, size / MILLION, 1);
    put_char(writer, '.');
    put_digits(writer, size % MILLION, DECIMALS);
}

void hd_obj_begin(HdObjWriter *writer, FILE *stream) {
    writer->stream = stream;
    writer->failed = false;
    writer->reason = 0;
    writer->used = 0;
}

void hd_obj_comment(HdObjWriter *writer, const char *text) {
    size_t length = strlen(text);
    begin_line(writer);
    put_char(writer, '#');
    put_char(writer, ' ');
    memcpy(writer->buffer + writer->used, text, length);
    writer->used += length;
    put_char(writer, '\n');
}

void hd_obj_vertex(HdObjWriter *writer, const double point[3]) {
    begin_line(writer);
    put_char(writer, 'v');
    for (int axis = 0; axis < 3; axis++)
        put_decimal(writer, point[axis]);
    put_char(writer, '\n');
}

void hd_obj_triangle(HdObjWriter *writer, int a, int b, int c) {
    const int corners[3] = {a, b, c};
    begin_line(writer);
    put_char(writer, 'f');
    for (int i = 0; i < 3; i++) {
        put_char(writer, ' ');
        put_digits(writer, (unsigned)corners[i] + 1, 1);
    }
    put_char(writer, '\n');
}

void hd_obj_quad(HdObjWriter *writer, int a, int b, int c, int d) {
    hd_obj_triangle(writer, a, b, c);
    hd_obj_triangle(writer, a, c, d);
}

void hd_obj_end(HdObjWriter *writer) {
    hand_over(writer);
    writer->used = 0;
}
