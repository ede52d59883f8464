/* SPDX-License-Identifier: MIT */
/* Pictures of errors. The scale is logarithmic: black below 1/4 of a step of 255, then a colour for
   each doubling, from dark violet at 1/4 over red and orange to pale yellow at 256, mixed in
   between; each is lighter than the one before. Cyan stands for NaN. */
#ifndef HD_IMAGE_HEAT_MAP_H
#define HD_IMAGE_HEAT_MAP_H

#include <stdint.h>

#include "base/error.h"

/* The colour of an error in steps of 255, at least 0 or NaN; r, g, b on the sRGB curve. */
void hd_heat_colour(double error, uint8_t rgb[3]);

typedef struct HdHeatMap HdHeatMap;

/* Begins a PNG of width * height, 1..65535 each, that appears under its name when it is complete.
 */
HdStatus hd_heat_map_open(HdHeatMap **map, const char *path, int width, int height, HdError *error);

/* The next row from the top, an error for each pixel. */
HdStatus hd_heat_map_add_row(HdHeatMap *map, const double *errors, HdError *error);

/* Ends the file after its last row, and frees the map in any case. */
HdStatus hd_heat_map_commit(HdHeatMap *map, HdError *error);

/* Leaves no file. NULL is allowed. */
void hd_heat_map_discard(HdHeatMap *map);

#endif
