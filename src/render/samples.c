/* SPDX-License-Identifier: MIT */
#include "render/samples.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"

enum { BITS = 24, TURN_OVER = (1 << (BITS - 1)) - 1 };

typedef struct Point {
    uint32_t x, y; /* in parts of 2^BITS */
} Point;

/* Sobol's first two dimensions: the bits of i turned round, and the same after multiplication by
   Pascal's triangle modulo 2. */
static Point sequence_point(uint32_t i) {
    Point point = {0, 0};
    uint32_t second = UINT32_C(1) << (BITS - 1);
    for (int bit = 0; bit < BITS; bit++) {
        if (i >> bit & 1) {
            point.x ^= UINT32_C(1) << (BITS - 1 - bit);
            point.y ^= second;
        }
        second ^= second >> 1;
    }
    point.x ^= TURN_OVER;
    point.y ^= TURN_OVER;
    return point;
}

static int cell_of(uint32_t coordinate, int side) {
    return (int)((uint64_t)coordinate * (uint64_t)side >> BITS);
}

static HdStatus create(HdSampleSet *set, int count, int grid_side, HdError *error) {
    set->places = calloc((size_t)count, sizeof *set->places);
    set->count = count;
    set->grid_side = grid_side;
    return set->places != NULL
               ? HD_OK
               : hd_fail(error, HD_FAILED, "out of memory: no room for %d samples", count);
}

HdStatus hd_sample_set_grid(HdSampleSet *set, int side, HdError *error) {
    const int count = side * side;
    HdStatus status = create(set, count, side, error);
    if (status != HD_OK)
        return status;
    unsigned char *taken = calloc((size_t)count, 1);
    if (taken == NULL) {
        hd_sample_set_free(set);
        return hd_fail(error, HD_FAILED, "out of memory: no room for %d samples", count);
    }
    int found = 0;
    for (uint32_t i = 0; found < count; i++) {
        Point point = sequence_point(i);
        int column = cell_of(point.x, side), row = cell_of(point.y, side);
        if (taken[row * side + column])
            continue;
        taken[row * side + column] = 1;
        set->places[found++] = column | row << 16;
    }
    free(taken);
    return HD_OK;
}

/* Marsaglia 2003, "Xorshift RNGs". */
static uint32_t next_random(uint32_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static void shuffle(int *numbers, int count, uint32_t *state) {
    for (int i = 0; i < count; i++)
        numbers[i] = i;
    for (int i = count - 1; i > 0; i--) {
        int other = (int)(next_random(state) % (uint32_t)(i + 1)), kept = numbers[i];
        numbers[i] = numbers[other];
        numbers[other] = kept;
    }
}

/* Where the random place `within` in part `part` of the cell number `cell` is, on the dense grid.
 */
static int dense_place(int side, int cell, int part, uint32_t within) {
    double place = cell + (part + (double)within / 4294967296.0) / side;
    return (int)(place * HD_DENSE_GRID / side);
}

HdStatus hd_sample_set_dense(HdSampleSet *set, int side, HdError *error) {
    int column_of[HD_MAX_SAMPLES_PER_SIDE] = {0}, row_of[HD_MAX_SAMPLES_PER_SIDE] = {0};
    uint32_t state = 1 + (uint32_t)side * UINT32_C(2654435761);
    HdStatus status = create(set, side * side, HD_DENSE_GRID, error);
    if (status != HD_OK)
        return status;
    shuffle(column_of, side, &state);
    shuffle(row_of, side, &state);
    for (int i = 0; i < set->count; i++) {
        int column = i % side, row = i / side;
        int x = dense_place(side, column, column_of[row], next_random(&state));
        int y = dense_place(side, row, row_of[column], next_random(&state));
        set->places[i] = x | y << 16;
    }
    return HD_OK;
}

void hd_sample_set_free(HdSampleSet *set) {
    free(set->places);
    memset(set, 0, sizeof *set);
}
