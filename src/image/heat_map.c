/* SPDX-License-Identifier: MIT */
#include "image/heat_map.h"

#include <math.h>
#include <setjmp.h>
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

/* Everything that must outlive a jump out of libpng lives here. */
struct HdHeatMap {
    HdAtomicFile file;
    HdPngSink sink;
    png_structp png;
    png_infop info;
    int width, height;
    uint8_t *row; /* owned */
    char message[HD_PNG_MESSAGE_SIZE];
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

static bool try_head(HdHeatMap *map) {
    map->sink.stream = map->file.stream;
    if (setjmp(png_jmpbuf(map->png)) != 0)
        return false;
    hd_png_begin_rgb(map->png, map->info, &map->sink, map->width, map->height, 8);
    png_set_sRGB(map->png, map->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(map->png, map->info);
    return true;
}

static bool try_row(HdHeatMap *map) {
    if (setjmp(png_jmpbuf(map->png)) != 0)
        return false;
    png_write_row(map->png, map->row);
    return true;
}

static bool try_end(HdHeatMap *map) {
    if (setjmp(png_jmpbuf(map->png)) != 0)
        return false;
    png_write_end(map->png, NULL);
    return true;
}

static void free_map(HdHeatMap *map) {
    png_destroy_write_struct(&map->png, &map->info);
    free(map->row);
    free(map);
}

static HdStatus fail_writing(const HdHeatMap *map, HdError *error) {
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", map->file.path, map->message);
}

HdStatus hd_heat_map_open(HdHeatMap **out, const char *path, int width, int height,
                          HdError *error) {
    HdHeatMap *map = calloc(1, sizeof *map);
    if (map == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to write %s", path);
    map->width = width;
    map->height = height;
    memcpy(map->message, "out of memory", sizeof "out of memory");
    HdStatus status = hd_atomic_file_open(&map->file, path, error);
    if (status != HD_OK) {
        free(map);
        return status;
    }
    map->row = malloc((size_t)width * 3);
    if (map->row != NULL)
        map->png = hd_png_create_writer(map->message);
    if (map->png != NULL)
        map->info = png_create_info_struct(map->png);
    if (map->info == NULL || !try_head(map)) {
        status = fail_writing(map, error);
        hd_heat_map_discard(map);
        return status;
    }
    *out = map;
    return HD_OK;
}

HdStatus hd_heat_map_add_row(HdHeatMap *map, const double *errors, HdError *error) {
    for (int x = 0; x < map->width; x++)
        hd_heat_colour(errors[x], map->row + 3 * (size_t)x);
    return try_row(map) ? HD_OK : fail_writing(map, error);
}

HdStatus hd_heat_map_commit(HdHeatMap *map, HdError *error) {
    HdStatus status;
    if (try_end(map)) {
        status = hd_atomic_file_commit(&map->file, error);
    } else {
        status = fail_writing(map, error);
        hd_atomic_file_discard(&map->file);
    }
    free_map(map);
    return status;
}

void hd_heat_map_discard(HdHeatMap *map) {
    if (map == NULL)
        return;
    hd_atomic_file_discard(&map->file);
    free_map(map);
}
