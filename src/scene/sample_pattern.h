/* SPDX-License-Identifier: MIT */
/* Positions of the samples in a pixel: a grid, or a multi-jittered pattern. */
#ifndef HD_SCENE_SAMPLE_PATTERN_H
#define HD_SCENE_SAMPLE_PATTERN_H

#include "scene/scene.h"

/* Returns the columns and rows of positions in each pixel, in whose middles samples lie: n, or
   n * n of the multi-jittered pattern. */
int hd_sample_lattice(const HdScene *scene);

/* Fills `places` with the n * n positions column | row << 16 of a pattern on a lattice of n * n
   columns and rows: one in each cell of a grid of n x n, row by row, and one in each column and row
   (Chiu, Shirley, Wang 1994; except for n = 3 and 4 with one order for all rows of cells and one
   for all columns of cells, as in Kensler 2013). An edge that is nearly upright or level crosses n
   * n different columns or rows, of a grid only n. The orders were found by search. 1 <= n <=
   HD_MAX_SAMPLES_PER_SIDE. */
void hd_multijitter(int n, int *places);

#endif
