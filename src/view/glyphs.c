/* SPDX-License-Identifier: MIT */
#include "view/glyphs.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* ---- half blocks ---- */

enum { CELL_BYTES = 6 };

void hd_half_blocks_free(HdHalfBlocks *blocks) {
    free(blocks->shown);
    *blocks = (HdHalfBlocks){.shown = NULL};
}

static HdStatus fit_blocks(HdHalfBlocks *blocks, const HdTextArea *area, bool *is_new,
                           HdError *error) {
    *is_new = blocks->shown == NULL || memcmp(area, &blocks->area, sizeof *area) != 0;
    if (!*is_new)
        return HD_OK;
    free(blocks->shown);
    blocks->area = *area;
    blocks->shown = calloc((size_t)area->columns * (size_t)area->rows, CELL_BYTES);
    if (blocks->shown == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the terminal's picture");
    return HD_OK;
}

/* What the terminal's pen is: colours and place. */
typedef struct Pen {
    uint8_t colours[CELL_BYTES];
    bool has_colours;
    int column, row; /* of the next character, from 0 within the area */
} Pen;

static void write_cell(Pen *pen, const HdTextArea *area, int column, int row, const uint8_t *cell,
                       FILE *out) {
    if (pen->column != column || pen->row != row)
        fprintf(out, "\033[%d;%dH", area->top + row, area->left + column);
    if (!pen->has_colours || memcmp(pen->colours, cell, 3) != 0)
        fprintf(out, "\033[38;2;%d;%d;%dm", cell[0], cell[1], cell[2]);
    if (!pen->has_colours || memcmp(pen->colours + 3, cell + 3, 3) != 0)
        fprintf(out, "\033[48;2;%d;%d;%dm", cell[3], cell[4], cell[5]);
    fputs("\xe2\x96\x80", out);
    memcpy(pen->colours, cell, CELL_BYTES);
    pen->has_colours = true;
    pen->column = column + 1;
    pen->row = row;
}

HdStatus hd_half_blocks_write(HdHalfBlocks *blocks, const HdTextArea *area, const uint8_t *rgba,
                              FILE *out, HdError *error) {
    bool is_new;
    Pen pen = {.row = -1};
    HdStatus status = fit_blocks(blocks, area, &is_new, error);
    if (status != HD_OK)
        return status;
    const size_t row_bytes = 4 * (size_t)area->columns;
    for (int row = 0; row < area->rows; row++)
        for (int column = 0; column < area->columns; column++) {
            const uint8_t *upper = rgba + 2 * (size_t)row * row_bytes + 4 * (size_t)column;
            uint8_t cell[CELL_BYTES];
            uint8_t *shown =
                blocks->shown + CELL_BYTES * ((size_t)row * (size_t)area->columns + (size_t)column);
            memcpy(cell, upper, 3);
            memcpy(cell + 3, upper + row_bytes, 3);
            if (!is_new && memcmp(cell, shown, CELL_BYTES) == 0)
                continue;
            memcpy(shown, cell, CELL_BYTES);
            write_cell(&pen, area, column, row, cell, out);
        }
    fputs("\033[0m", out);
    return HD_OK;
}

/* ---- the kitty protocol ---- */

static void write_base64(const uint8_t bytes[3], FILE *out) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned bits = (unsigned)bytes[0] << 16 | (unsigned)bytes[1] << 8 | bytes[2];
    for (int shift = 18; shift >= 0; shift -= 6)
        putc(digits[bits >> shift & 63], out);
}

/* A pixel becomes four characters, of which a chunk may have 4096. */
void hd_kitty_write(const HdTextArea *area, const uint8_t *rgba, int width, int height, FILE *out) {
    enum { CHUNK = 1024 };
    const int pixels = width * height;
    fprintf(out, "\033[%d;%dH", area->top, area->left);
    for (int first = 0; first < pixels; first += CHUNK) {
        const int end = first + CHUNK < pixels ? first + CHUNK : pixels;
        fputs("\033_G", out);
        if (first == 0)
            fprintf(out, "a=T,f=24,s=%d,v=%d,c=%d,r=%d,i=1,p=1,q=2,C=1,", width, height,
                    area->columns, area->rows);
        fprintf(out, "m=%d;", end < pixels);
        for (int i = first; i < end; i++)
            write_base64(rgba + 4 * (size_t)i, out);
        fputs("\033\\", out);
    }
}

const char hd_kitty_clear[] = "\033_Ga=d,q=2\033\\";

/* ---- sixels ---- */

enum { LEVELS = 6, COLOURS = LEVELS * LEVELS * LEVELS, BAND = 6 };

/* A step of 255 is cut into 4 x 4 places, so that flat colours between two levels are seen. */
static int level_of(int value, int x, int y) {
    static const int bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    const int scaled = value * (LEVELS - 1) * 16 + (2 * bayer[y & 3][x & 3] + 1) * 255 / 2;
    const int level = scaled / (255 * 16);
    return level < LEVELS ? level : LEVELS - 1;
}

static int colour_of(const uint8_t *pixel, int x, int y) {
    return (level_of(pixel[0], x, y) * LEVELS + level_of(pixel[1], x, y)) * LEVELS +
           level_of(pixel[2], x, y);
}

static void write_run(int length, int sixel, FILE *out) {
    if (length > 3)
        fprintf(out, "!%d%c", length, 63 + sixel);
    else
        for (; length > 0; length--)
            putc(63 + sixel, out);
}

/* The places of a band that have one colour. */
static void write_colour(const uint8_t *colours, int width, int rows, int colour, FILE *out) {
    int length = 0, before = 0;
    fprintf(out, "#%d", colour);
    for (int x = 0; x < width; x++) {
        int sixel = 0;
        for (int y = 0; y < rows; y++)
            sixel |= (colours[y * width + x] == colour) << y;
        if (sixel != before) {
            write_run(length, before, out);
            length = 0;
        }
        before = sixel;
        length++;
    }
    write_run(before != 0 ? length : 0, before, out);
    putc('$', out);
}

static void write_band(const uint8_t *rgba, int width, int top, int rows, uint8_t *colours,
                       FILE *out) {
    bool is_used[COLOURS] = {false};
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < width; x++) {
            const size_t pixel = (size_t)(top + y) * (size_t)width + (size_t)x;
            const int colour = colour_of(rgba + 4 * pixel, x, top + y);
            colours[y * width + x] = (uint8_t)colour;
            is_used[colour] = true;
        }
    for (int colour = 0; colour < COLOURS; colour++)
        if (is_used[colour])
            write_colour(colours, width, rows, colour, out);
    putc('-', out);
}

static void write_palette(FILE *out) {
    for (int colour = 0; colour < COLOURS; colour++)
        fprintf(out, "#%d;2;%d;%d;%d", colour, colour / (LEVELS * LEVELS) * 100 / (LEVELS - 1),
                colour / LEVELS % LEVELS * 100 / (LEVELS - 1),
                colour % LEVELS * 100 / (LEVELS - 1));
}

void hd_sixel_write(const HdTextArea *area, const uint8_t *rgba, int width, int height, FILE *out) {
    uint8_t *colours = malloc((size_t)width * BAND);
    if (colours == NULL)
        return;
    fprintf(out, "\033[%d;%dH\033Pq\"1;1;%d;%d", area->top, area->left, width, height);
    write_palette(out);
    for (int top = 0; top < height; top += BAND)
        write_band(rgba, width, top, height - top < BAND ? height - top : BAND, colours, out);
    fputs("\033\\", out);
    free(colours);
}
