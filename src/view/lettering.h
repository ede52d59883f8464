/* SPDX-License-Identifier: MIT */
/* Text on a picture, in letters of 5 x 7 pixels, and 2 below the line. */
#ifndef HD_VIEW_LETTERING_H
#define HD_VIEW_LETTERING_H

#include <stdint.h>

/* Of a character with the gap that follows, and of a line. */
enum { HD_LETTER_WIDTH = 6, HD_LETTER_HEIGHT = 11 };

/* A picture of r, g, b and alpha to write on. */
typedef struct HdCanvas {
    uint8_t *rgba;
    int width, height;
} HdCanvas;

/* Writes a line at left, top; every pixel of a letter becomes scale x scale pixels, and what is
   outside of the picture is left out. ASCII; anything else is shown as a question mark. */
void hd_canvas_write(const HdCanvas *canvas, const char *text, int left, int top, int scale,
                     const uint8_t colour[4]);

/* Gives a rectangle, cut to the picture, one colour. */
void hd_canvas_fill(const HdCanvas *canvas, int left, int top, int width, int height,
                    const uint8_t colour[4]);

#endif
