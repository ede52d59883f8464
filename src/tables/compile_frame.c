/* SPDX-License-Identifier: MIT */
/* The tables of a frame; compiled for each precision. */
#include "tables/builder.h"

#include <math.h>
#include <string.h>

#include "tables/room.h"

static int ceil_log2(int n) {
    int bits = 0;
    while ((1 << bits) < n)
        bits++;
    return bits;
}

static real power_of_two(int exponent) {
    return (real)ldexp(1.0, exponent);
}

/* Bounds are small where they matter, so they have the more bits after the point the less can be
   left out. */
enum { MOST_BOUND_BITS = 44 };

static void fill_fixed_bound(View *view, double most_left_out, int samples) {
    int exponent;
    frexp(most_left_out, &exponent);
    int bits = exponent + MOST_BOUND_BITS <= 61 ? MOST_BOUND_BITS : 61 - exponent;
    int excess = exponent + bits + ceil_log2(samples) - 62;
    view->bound_shift = excess > 0 ? excess : 0;
    view->bound_to_fixed = power_of_two(bits);
    view->bound_from_fixed = power_of_two(view->bound_shift - bits);
}

/* A contribution is at most 2^16 and the weights of one level add up to at most 1, so a sample's
   sum is at most (depth + 1) 2^16; 62 bits hold a pixel's sum of samples. */
static void fill_fixed_point(View *view, const HdScene *scene, int samples) {
    int sum_bits = 16 + ceil_log2(scene->depth + 1);
    int sample_bits = sum_bits + 40 <= 62 ? 40 : 62 - sum_bits;
    int excess = sum_bits + sample_bits + ceil_log2(samples) - 62;
    view->pixel_shift = excess > 0 ? excess : 0;
    view->to_fixed = power_of_two(sample_bits);
    view->from_fixed = power_of_two(view->pixel_shift - sample_bits);
}

static void fill_view(View *view, const HdFrameTables *tables, const HdScene *scene,
                      const HdCamera *camera, const HdSampleList *list) {
    const HdCrop *crop = &scene->crop;
    int whole_width = crop->whole_width > 0 ? crop->whole_width : scene->width;
    int whole_height = crop->whole_height > 0 ? crop->whole_height : scene->height;
    int side = list != NULL ? list->grid_side : scene->samples_per_side;
    double step = camera->tangent_of_half_fov / ((double)whole_width * (double)side);
    hd_store3(view->forward, camera->forward);
    hd_store3(view->right, hd_scale(camera->right, step));
    hd_store3(view->down, hd_scale(camera->up, -step));
    view->cutoff = (real)scene->cutoff;
    view->width = tables->width;
    view->height = tables->height;
    view->samples = tables->samples;
    view->grid_side = side;
    view->first_column = 1 - whole_width * side + 2 * crop->left * side;
    view->first_row = 1 - whole_height * side + 2 * crop->top * side;
    view->depth = scene->depth;
    view->listed = list != NULL;
    fill_fixed_point(view, scene, tables->samples);
    if (list != NULL) {
        view->bound_cutoff = (real)list->bound_cutoff;
        fill_fixed_bound(view, list->most_left_out, tables->samples);
    }
}

/* Entries that fill up the frame's last row are none. */
static void fill_list(const HdFrameTables *tables, const HdSampleList *list) {
    int *entries = tables->table[HD_TABLE_entries].data;
    size_t words = tables->table[HD_TABLE_entries].bytes / sizeof *entries;
    size_t filled = 2 * (size_t)list->entry_count;
    memcpy(entries, list->entries, filled * sizeof *entries);
    for (size_t i = filled; i < words; i++)
        entries[i] = -1;
    memcpy(tables->table[HD_TABLE_sample_places].data, list->places,
           tables->table[HD_TABLE_sample_places].bytes);
}

HdStatus NAMED(hd_compile_frame)(HdFrameTables *tables, const HdScene *scene,
                                 const HdCamera *camera, const HdSampleList *list, HdError *error) {
    int object_count = hd_object_count(scene);
    tables->table_count = HD_FRAME_TABLE_COUNT;
    tables->table[HD_TABLE_view].bytes = sizeof(View);
    tables->table[HD_TABLE_eye_offsets].bytes = (size_t)object_count * sizeof(Vector);
    if (list != NULL) {
        tables->table[HD_TABLE_entries].bytes =
            2 * sizeof(int) * (size_t)tables->width * (size_t)tables->height;
        tables->table[HD_TABLE_sample_places].bytes = sizeof(int) * (size_t)list->place_count;
    }
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++) {
        HdStatus status = hd_table_allocate(&tables->table[i], "tables of a frame", error);
        if (status != HD_OK)
            return status;
    }
    fill_view(tables->table[HD_TABLE_view].data, tables, scene, camera, list);
    if (list != NULL)
        fill_list(tables, list);
    Vector *offsets = tables->table[HD_TABLE_eye_offsets].data;
    for (int object = 0; object < object_count; object++)
        offsets[object] = hd_as_vector(hd_sub(camera->eye, hd_object_centre(scene, object)));
    return HD_OK;
}
