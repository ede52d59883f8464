/* SPDX-License-Identifier: MIT */
/* Where the samples of a pixel are, and in which order they are taken. */
#ifndef HD_RENDER_SAMPLES_H
#define HD_RENDER_SAMPLES_H

#include "base/error.h"

/* Samples in places of a grid, each place once: column | row << 16. The first 1, 4, 16, ... samples
   are spread over the pixel as evenly as a grid of theirs. */
typedef struct HdSampleSet {
    int *places; /* owned */
    int count;
    int grid_side;
} HdSampleSet;

/* All places of a grid of side x side, 1 to 64, in the order in which a low-discrepancy sequence
   comes upon them: the first two dimensions of Sobol's, a (0, 2)-sequence in base 2 (Sobol 1967;
   Niederreiter 1992, section 4), turned over so that the first sample is next to the middle. */
HdStatus hd_sample_set_grid(HdSampleSet *set, int side, HdError *error);

/* side * side places, 1 to 64, on a grid of HD_DENSE_GRID: correlated multi-jittered samples
   (Kensler 2013), one in each cell of a grid of side x side and one in each of side * side columns
   and rows. An edge between black and white is seen with an error of at most 2.2 steps of 255 by
   32 x 32 of them, and by a grid with up to 4. */
enum { HD_DENSE_GRID = 4096 };
HdStatus hd_sample_set_dense(HdSampleSet *set, int side, HdError *error);

void hd_sample_set_free(HdSampleSet *set);

#endif
