/* SPDX-License-Identifier: MIT */
#include "render/samples.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"
#include "base/trigonometry.h"

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

static int compare(const void *a, const void *b) {
    const double *first = a, *second = b;
    return (*first > *second) - (*first < *second);
}

static double part(double a) {
    return a > 0.0 ? a * a : 0.0;
}

/* The share of the unit square about 0 with a x + b y <= d, for a >= b >= 0, a > 0. */
static double share_below(double a, double b, double d) {
    double outer = 0.5 * (a + b), inner = 0.5 * (a - b);
    if (b < 1e-9)
        return d <= -outer ? 0.0 : d >= outer ? 1.0 : d / a + 0.5;
    double area = part(d + outer) - part(d + inner) - part(d - inner) + part(d - outer);
    return area / (2.0 * a * b);
}

static double worst_at(const HdSampleSet *set, double *along, double cosine, double sine) {
    const double side = set->grid_side;
    double a = cosine < 0.0 ? -cosine : cosine, b = sine < 0.0 ? -sine : sine, worst = 0.0;
    for (int i = 0; i < set->count; i++) {
        double x = ((set->places[i] & 0xffff) + 0.5) / side - 0.5;
        double y = ((set->places[i] >> 16) + 0.5) / side - 0.5;
        along[i] = cosine * x + sine * y;
    }
    qsort(along, (size_t)set->count, sizeof *along, compare);
    for (int i = 0; i < set->count; i++) {
        double exact = share_below(a > b ? a : b, a > b ? b : a, along[i]);
        double below = exact - (double)i / set->count, above = (double)(i + 1) / set->count - exact;
        worst = below > worst ? below : worst;
        worst = above > worst ? above : worst;
    }
    return worst;
}

double hd_sample_set_error(const HdSampleSet *set, int angles) {
    const double turn = 6.283185307179586;
    double *along = calloc((size_t)set->count, sizeof *along), worst = 0.0;
    for (int i = 0; along != NULL && i < angles; i++) {
        double angle = turn * i / angles, sine, cosine;
        hd_sine_cosine(angle, &sine, &cosine);
        double error = worst_at(set, along, cosine, sine);
        worst = error > worst ? error : worst;
    }
    free(along);
    return 255.0 * worst;
}
