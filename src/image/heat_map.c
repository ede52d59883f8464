/* SPDX-License-Identifier: MIT */
#include "image/heat_map.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "image/png.h"
#include "system/atomic_file.h"

static const double LEAST = 0.25; /* has the first colour */
enum { DOUBLINGS = 10 };

/* Their lightness (CIE L*) goes from 14 to 97 in equal steps. */
static const uint8_t colours[DOUBLINGS + 1][3] = {
    {53, 10, 90},   {89, 17, 107},  {127, 31, 106}, {164, 45, 95},  {198, 63, 76},   {225, 89, 51},
    {243, 120, 25}, {250, 155, 13}, {249, 191, 41}, {247, 223, 90}, {252, 252, 156},
};
static const uint8_t no_error[3] = {0, 0, 0}, no_number[3] = {0, 255, 255};

struct HdHeatMap {
    HdAtomicFile file;
    HdPngWriter *png; /* owned */
    int width;
    uint8_t *row; /* owned */
};

void hd_heat_colour(double error, uint8_t rgb[3]) {
    if (isnan(error) || error < LEAST) {
        memcpy(rgb, isnan(error) ? no_number : no_error, 3);
        return;
    }
    const double place = fmin(log2(error / LEAST), DOUBLINGS);
    const int below = place < DOUBLINGS ? (int)place : DOUBLINGS - 1;
    for (int c = 0; c < 3; c++) {
        const double from = colours[below][c], to = colours[below + 1][c];
        rgb[c] = (uint8_t)lround(from + (place - below) * (to - from));
    }
}

static void free_map(HdHeatMap *map) {
    hd_png_free(map->png);
    free(map->row);
    free(map);
}

HdStatus hd_heat_map_open(HdHeatMap **out, const char *path, int width, int height,
                          HdError *error) {
    const HdPngFacts facts = {.width = width, .height = height, .bits = 8, .is_srgb = true};
    HdHeatMap *map = calloc(1, sizeof *map);
    uint8_t *row = malloc((size_t)width * 3);
    if (map == NULL || row == NULL) {
        free(map);
        free(row);
        return hd_fail(error, HD_FAILED, "out of memory: no room to write %s", path);
    }
    map->width = width;
    map->row = row;
    HdStatus status = hd_atomic_file_open(&map->file, path, error);
    if (status != HD_OK) {
        free_map(map);
        return status;
    }
    status = hd_png_begin(&map->png, map->file.stream, map->file.path, &facts, NULL, error);
    if (status == HD_OK)
        *out = map;
    else
        hd_heat_map_discard(map);
    return status;
}

HdStatus hd_heat_map_add_row(HdHeatMap *map, const double *errors, HdError *error) {
    for (int x = 0; x < map->width; x++)
        hd_heat_colour(errors[x], map->row + 3 * (size_t)x);
    return hd_png_write_row(map->png, map->row, error);
}

HdStatus hd_heat_map_commit(HdHeatMap *map, HdError *error) {
    HdStatus status = hd_png_end(map->png, NULL, error);
    if (status == HD_OK)
        status = hd_atomic_file_commit(&map->file, HD_DURABLE, error);
    else
        hd_atomic_file_discard(&map->file);
    free_map(map);
    return status;
}

void hd_heat_map_discard(HdHeatMap *map) {
    if (map == NULL)
        return;
    hd_atomic_file_discard(&map->file);
    free_map(map);
}
