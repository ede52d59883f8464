/* SPDX-License-Identifier: MIT */
/* Four numbers that follow each other in a table, for each lane; needs the types of bundles. */
#ifndef HD_ROWS_H
#define HD_ROWS_H

typedef struct {
    vint word[4];
} FourWords;

typedef struct {
    vreal number[4];
} FourReals;

#endif
