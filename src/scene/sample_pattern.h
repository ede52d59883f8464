/* SPDX-License-Identifier: MIT */
/* Positions of the samples in a pixel, the same in all pixels. */
#ifndef HD_SCENE_SAMPLE_PATTERN_H
#define HD_SCENE_SAMPLE_PATTERN_H

#include "scene/scene.h"

/* Lattice of HD_SAMPLING_REFERENCE. */
enum { HD_DENSE_LATTICE = 4096 };

/* Returns the rows of cells, each with scene->samples_per_side samples. */
int hd_sample_rows(const HdScene *scene);

/* Returns the number of a pixel's samples. */
int hd_sample_count(const HdScene *scene);

/* Returns the columns and rows of positions in each pixel, in whose middles samples lie. */
int hd_sample_lattice(const HdScene *scene);

/* Fills `places` with the hd_sample_count positions column | row << 16 on the lattice.

   HD_SAMPLING_MULTIJITTER (Chiu, Shirley, Wang 1994) has one in each cell, row by row, and one in
   each column and row of its lattice. An edge that is nearly upright or level crosses as many
   different columns or rows as there are samples, of a grid only n. One order holds for all rows
   of cells and one for all columns of cells, as in Kensler 2013, except for 3 x 3 and 4 x 4. The
   orders of squares were found by search.

   HD_SAMPLING_REFERENCE is Kensler's with random positions. For an edge between black and white, 32
   x 32 of them have an error of at most 2.2/255; a grid has up to 4/255. */
void hd_sample_places(const HdScene *scene, int *places);

#endif
