/* SPDX-License-Identifier: MIT */
#include "scene/sample_pattern.h"

#include <stdint.h>

enum { MAX_LISTED = 16 };

/* Orders of columns and rows: the sample in column i and row j of the cells is in column P[j] and
   row Q[i] of its cell. Up to 6 they have the least error in pictures of nine scenes among all
   (n = 2) or many orders, from 7 on among many at straight edges of all directions. */
typedef struct Orders {
    unsigned char p[MAX_LISTED], q[MAX_LISTED];
} Orders;

static const Orders listed[] = {
    [1] = {{0}, {0}},
    [2] = {{0, 1}, {1, 0}},
    [5] = {{0, 2, 4, 1, 3}, {3, 1, 2, 4, 0}},
    [6] = {{4, 1, 2, 5, 3, 0}, {1, 3, 5, 0, 2, 4}},
    [7] = {{0, 4, 2, 5, 1, 3, 6}, {6, 3, 1, 5, 2, 4, 0}},
    [8] = {{0, 3, 6, 2, 5, 1, 4, 7}, {7, 4, 1, 5, 2, 6, 3, 0}},
    [9] = {{8, 4, 2, 6, 1, 5, 7, 3, 0}, {0, 4, 7, 2, 5, 1, 6, 3, 8}},
    [10] = {{9, 4, 7, 1, 5, 2, 8, 3, 6, 0}, {0, 4, 7, 2, 8, 5, 1, 6, 3, 9}},
    [11] = {{9, 3, 7, 1, 5, 10, 4, 8, 2, 6, 0}, {2, 8, 4, 0, 6, 9, 5, 1, 7, 3, 10}},
    [12] = {{0, 7, 4, 9, 1, 6, 11, 3, 8, 2, 5, 10}, {11, 6, 2, 8, 4, 0, 10, 7, 3, 9, 5, 1}},
    [13] = {{12, 5, 9, 2, 7, 11, 4, 0, 8, 3, 10, 6, 1}, {0, 8, 3, 10, 5, 1, 7, 11, 6, 2, 9, 4, 12}},
    [14] = {{8, 2, 10, 4, 13, 6, 1, 11, 7, 3, 12, 9, 5, 0},
            {0, 6, 11, 4, 10, 2, 8, 13, 3, 7, 1, 9, 5, 12}},
    [15] = {{2, 11, 6, 0, 10, 4, 13, 8, 1, 7, 12, 3, 9, 5, 14},
            {14, 4, 8, 11, 1, 6, 12, 9, 3, 13, 7, 0, 5, 10, 2}},
    [16] = {{15, 5, 9, 2, 12, 4, 10, 1, 8, 14, 6, 11, 3, 13, 7, 0},
            {3, 12, 6, 0, 9, 14, 7, 2, 11, 4, 15, 8, 1, 10, 13, 5}},
};

/* Rows of the samples by column of the lattice: with an order of its own in each row of cells, 3 x
   3 and 4 x 4 samples have 4 and 5 % less error than with one order. */
static const unsigned char rows_of_9[9] = {5, 1, 8, 4, 0, 6, 3, 7, 2};
static const unsigned char rows_of_16[16] = {11, 2, 6, 15, 10, 3, 7, 13, 0, 8, 4, 12, 9, 1, 14, 5};

int hd_sample_rows(const HdScene *scene) {
    return scene->sampling == HD_SAMPLING_MULTIJITTER && scene->sample_rows > 0
               ? scene->sample_rows
               : scene->samples_per_side;
}

int hd_sample_count(const HdScene *scene) {
    return scene->samples_per_side * hd_sample_rows(scene);
}

int hd_sample_lattice(const HdScene *scene) {
    return scene->sampling == HD_SAMPLING_MULTIJITTER ? hd_sample_count(scene)
           : scene->sampling == HD_SAMPLING_REFERENCE ? HD_DENSE_LATTICE
                                                      : scene->samples_per_side;
}

/* Places the sample of each column into the list of its cells. */
static void place_rows(int n, const unsigned char *rows, int *places) {
    for (int column = 0; column < n * n; column++)
        places[rows[column] / n * n + column / n] = column | rows[column] << 16;
}

/* Returns a number's eight binary digits in reverse order. */
static int reversed_bits(int number) {
    int reversed = 0;
    for (int bit = 0; bit < 8; bit++)
        reversed |= (number >> bit & 1) << (7 - bit);
    return reversed;
}

/* Returns the rank of `number` among 0 to n - 1 by their reversed digits (van der Corput 1935). */
static int rank_of(int number, int n) {
    int rank = 0;
    for (int other = 0; other < n; other++)
        rank += reversed_bits(other) < reversed_bits(number);
    return rank;
}

static void multijitter(int columns, int rows, int *places) {
    int p[HD_MAX_SAMPLES_PER_SIDE], q[HD_MAX_SAMPLES_PER_SIDE];
    const bool is_square = columns == rows, is_listed = is_square && columns <= MAX_LISTED;
    if (is_square && (columns == 3 || columns == 4)) {
        place_rows(columns, columns == 3 ? rows_of_9 : rows_of_16, places);
        return;
    }
    for (int j = 0; j < rows; j++)
        p[j] = is_listed ? listed[rows].p[j] : rank_of(is_square ? j : rows - 1 - j, rows);
    for (int i = 0; i < columns; i++)
        q[i] = is_listed ? listed[columns].q[i] : rank_of(is_square ? columns - 1 - i : i, columns);
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++)
            places[j * columns + i] = (rows * i + p[j]) | (columns * j + q[i]) << 16;
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

/* Returns the coordinate, on the dense lattice, of random position `within` in part `part` of cell
   `cell`. */
static int dense_place(int side, int cell, int part, uint32_t within) {
    double place = cell + (part + (double)within / 4294967296.0) / side;
    return (int)(place * HD_DENSE_LATTICE / side);
}

static void dense(int side, int *places) {
    int column_of[HD_MAX_SAMPLES_PER_SIDE] = {0}, row_of[HD_MAX_SAMPLES_PER_SIDE] = {0};
    uint32_t state = 1 + (uint32_t)side * UINT32_C(2654435761);
    shuffle(column_of, side, &state);
    shuffle(row_of, side, &state);
    for (int i = 0; i < side * side; i++) {
        int column = i % side, row = i / side;
        int x = dense_place(side, column, column_of[row], next_random(&state));
        int y = dense_place(side, row, row_of[column], next_random(&state));
        places[i] = x | y << 16;
    }
}

void hd_sample_places(const HdScene *scene, int *places) {
    const int n = scene->samples_per_side;
    if (scene->sampling == HD_SAMPLING_MULTIJITTER)
        multijitter(n, hd_sample_rows(scene), places);
    else if (scene->sampling == HD_SAMPLING_REFERENCE)
        dense(n, places);
    else
        for (int i = 0; i < n * n; i++)
            places[i] = i % n | i / n << 16;
}
