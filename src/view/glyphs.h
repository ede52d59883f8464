/* SPDX-License-Identifier: MIT */
/* Pictures as text for terminals. */
#ifndef HD_VIEW_GLYPHS_H
#define HD_VIEW_GLYPHS_H

#include <stdint.h>
#include <stdio.h>

#include "base/error.h"

/* A part of the terminal's screen, from column and row 1. */
typedef struct HdTextArea {
    int left, top, columns, rows;
} HdTextArea;

/* Half blocks, two pixels a character, by 24-bit colours: only what is other than before is sent.
 */
typedef struct HdHalfBlocks {
    uint8_t *shown; /* owned; r, g, b of the upper and the lower half of each place */
    HdTextArea area;
} HdHalfBlocks;

/* Sends a picture of area->columns x 2 area->rows pixels, r, g, b and alpha. Another area than the
   last time is sent as a whole, and after hd_half_blocks_free any is. */
HdStatus hd_half_blocks_write(HdHalfBlocks *blocks, const HdTextArea *area, const uint8_t *rgba,
                              FILE *out, HdError *error);

void hd_half_blocks_free(HdHalfBlocks *blocks);

/* Sends a picture of any size, r, g, b and alpha, by the kitty graphics protocol, in place of the
   last one; the terminal scales it to the area. */
void hd_kitty_write(const HdTextArea *area, const uint8_t *rgba, int width, int height, FILE *out);

/* Sent, takes such a picture off the screen. */
extern const char hd_kitty_clear[];

/* Sends a picture as sixels from the area's corner on, a sixel's pixel for each of the picture's,
   in 216 colours with an ordered dither. */
void hd_sixel_write(const HdTextArea *area, const uint8_t *rgba, int width, int height, FILE *out);

#endif
