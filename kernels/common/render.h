/* SPDX-License-Identifier: MIT */
/* Work items: the pixels of an item, their rendering and their first hits. */
#ifndef HD_RENDER_H
#define HD_RENDER_H

#include "ray_tree.h"

#ifndef HD_PIXELS_PER_ITEM
#define HD_PIXELS_PER_ITEM HD_BLOCK_PIXELS
#endif

typedef struct {
    int x, y;
} Pixel;

/* Returns the pixel at a place in the Z order of the block at `corner`. */
FN Pixel pixel_in_block(Pixel corner, int place) {
    int z = place % HD_BLOCK_PIXELS;
    Pixel pixel;
    pixel.x = corner.x + HD_Z_COLUMN(z);
    pixel.y = corner.y + HD_Z_ROW(z);
    return pixel;
}

/* Returns the corner of an item's block; no item crosses blocks. */
FN Pixel block_of_item(GLOBAL const View *view, int item) {
    int blocks_per_row = (view->width + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int block = item * HD_PIXELS_PER_ITEM / HD_BLOCK_PIXELS;
    Pixel corner;
    corner.x = block % blocks_per_row * HD_BLOCK_SIDE;
    corner.y = block / blocks_per_row * HD_BLOCK_SIDE;
    return corner;
}

FN int in_picture(GLOBAL const View *view, Pixel pixel) {
    return pixel.x < view->width && pixel.y < view->height;
}

/* Returns a / divisor, rounded down, for 0 <= a < 2^22: the half keeps the quotient further from
   whole numbers than its rounding error. */
FN vint divide_int(vint a, int divisor) {
    return to_int((to_real(a) + splat(R(0.5))) * splat(shared_quotient(R(1.0), (real)divisor)));
}

/* Replaces entries x, y of a listed frame by pixels of the whole picture. Empty entries leave
   `alive`. */
FN void listed_pixels(SAMPLE_PARAMETERS vmask *alive, vint *x, vint *y) {
    vint pixel = splat_int(-1), entry = *y * view->width + *x;
    vint live = vselect_int(*alive, splat_int(1), splat_int(0));
    for (int lane = 0; lane < HD_LANES; lane++)
        if (lane_int(&live, lane))
            set_lane_int(&pixel, lane, entries[lane_int(&entry, lane)]);
    *alive = *alive & ~(eq_int(pixel, splat_int(-1)));
    *x = pixel & 0xffff;
    *y = (pixel >> 16) & 0xffff;
}

/* Computes the pixels at the places of an item; returns the lanes inside the picture. */
FN vmask pixels_at(GLOBAL const View *view, int item, vint place, vint *x, vint *y) {
    vint z = (place + item * HD_PIXELS_PER_ITEM % HD_BLOCK_PIXELS) & (HD_BLOCK_PIXELS - 1);
    Pixel corner = block_of_item(view, item);
    *x = HD_Z_COLUMN(z) + corner.x;
    *y = HD_Z_ROW(z) + corner.y;
    return lt_int(place, splat_int(HD_PIXELS_PER_ITEM)) & lt_int(*x, splat_int(view->width)) &
           lt_int(*y, splat_int(view->height));
}

/* Returns the direction to an image point, in half steps of the grid right of and below the middle.
 */
FN Vec3 direction_to(GLOBAL const View *view, vreal right, vreal down) {
    Vec3 axis = vec3_of(view->down);
    Vec3 sum = vec3_of(view->forward);
    sum = vec3_scale_add(axis, down, sum);
    axis = vec3_of(view->right);
    return vec3_normalize(vec3_scale_add(axis, right, sum));
}

/* Computes the directions of samples `first`, first + 1, ... of an item, pixel by pixel and row by
   row; returns the lanes that hold one. The item has the sample `first`. */
FN vmask sample_directions(SAMPLE_PARAMETERS int item, int first, Vec3 *direction) {
    int n = view->grid_side, samples = view->samples;
    int first_pixel = HD_PIXELS_PER_ITEM > 1 ? first / samples : 0;
    first -= first_pixel * samples;
    vint within = lane_numbers() + first, x, y;
    vint pixels = HD_LANES > 1 ? divide_int(within, samples) : splat_int(0);
    within = within - pixels * samples;
    vmask alive = pixels_at(view, item, pixels + first_pixel, &x, &y);
    vint row, column;
    if (view->listed)
        listed_pixels(SAMPLE_ARGUMENTS & alive, &x, &y);
    if (view->patterned) {
        vint place = load_ints(sample_places + first);
        column = place & 0xffff;
        row = (place >> 16) & 0xffff;
    } else {
        row = divide_int(within, n);
        column = within - row * n;
    }
    vreal right = to_real((x * n + column) * 2 + view->first_column);
    vreal down = to_real((y * n + row) * 2 + view->first_row);
    *direction = direction_to(view, right, down);
    return alive;
}

/* Returns a sample's part of its pixel's error bound, rounded up. */
FN fixed64 shifted_bound(GLOBAL const View *view, fixed64 bound) {
    const fixed64 below_one = ((fixed64)1 << view->bound_shift) - 1;
    return (bound + below_one) >> view->bound_shift;
}

FN Sample empty_sample(void) {
    Sample sample;
    sample.mirrored = sample.transmitted = splat_int(0);
    sample.shadow_tests = sample.clamps = splat_int(0);
    sample.r = sample.g = sample.b = sample.bound = truncate_to_fix(splat(R(0.0)));
    return sample;
}

/* The sums of all or some samples of an item's pixels. */
typedef struct {
    fixed64 sums[HD_PIXELS_PER_ITEM * PIXEL_SUMS];
    RayCounts counts;
} PixelAccumulator;

FN RayCounts no_counts(void) {
    RayCounts counts;
    counts.mirrored = counts.transmitted = counts.shadow_tests = counts.clamps = 0;
    return counts;
}

/* Returns the counts of a packet of samples; lanes without one add nothing. */
FN RayCounts counts_of(const Sample *sample) {
    RayCounts counts;
    counts.mirrored = (uint64)sum_lanes(sample->mirrored);
    counts.transmitted = (uint64)sum_lanes(sample->transmitted);
    counts.shadow_tests = (uint64)sum_lanes(sample->shadow_tests);
    counts.clamps = (uint64)sum_lanes(sample->clamps);
    return counts;
}

FN void add_counts(RayCounts *sum, RayCounts more) {
    sum->mirrored += more.mirrored;
    sum->transmitted += more.transmitted;
    sum->shadow_tests += more.shadow_tests;
    sum->clamps += more.clamps;
}

FN void clear_accumulator(PixelAccumulator *accumulator) {
    for (int i = 0; i < HD_PIXELS_PER_ITEM * PIXEL_SUMS; i++)
        accumulator->sums[i] = 0;
    accumulator->counts = no_counts();
}

/* Adds a packet of samples to their pixels; `first` is the first lane's sample within the item. */
FN void add_sample(SCENE_PARAMETERS const Sample *sample, int first,
                   PixelAccumulator *accumulator) {
    int per_pixel = view->samples;
    int place = first / per_pixel, left = per_pixel - first % per_pixel;
    add_counts(&accumulator->counts, counts_of(sample));
    for (int lane = 0; lane < HD_LANES && place < HD_PIXELS_PER_ITEM; lane++) {
        fixed64 *sums = accumulator->sums + place * PIXEL_SUMS;
        sums[0] += lane_fix(&sample->r, lane) >> view->pixel_shift;
        sums[1] += lane_fix(&sample->g, lane) >> view->pixel_shift;
        sums[2] += lane_fix(&sample->b, lane) >> view->pixel_shift;
        if (BOUNDED(header))
            sums[HD_RADIANCE_SUMS] += shifted_bound(view, lane_fix(&sample->bound, lane));
        left--;
        if (left == 0) {
            left = per_pixel;
            place++;
        }
    }
}

/* Stores a pixel's sum as a float of the picture. */
FN void store_channel(GLOBAL const Header *header, GLOBAL const View *view, Pixel pixel,
                      int channel, fixed64 sum, GLOBAL float *pixels) {
    int floats = BOUNDED(header) ? HD_BOUNDED_SUMS : HD_RADIANCE_SUMS;
    uint64 number = (uint64)pixel.y * (uint64)view->width + (uint64)pixel.x;
    real from_fixed = channel < HD_RADIANCE_SUMS ? view->from_fixed : view->bound_from_fixed;
    if (in_picture(view, pixel) && channel < floats)
        pixels[number * (uint64)floats + (uint64)channel] =
            (float)shared_quotient((real)sum * from_fixed, (real)view->samples);
}

FN void store_pixels(GLOBAL const Header *header, GLOBAL const View *view, int item,
                     const PixelAccumulator *accumulator, GLOBAL float *pixels) {
    Pixel corner = block_of_item(view, item);
    for (int place = 0; place < HD_PIXELS_PER_ITEM; place++) {
        Pixel pixel = pixel_in_block(corner, item * HD_PIXELS_PER_ITEM + place);
        for (int channel = 0; channel < PIXEL_SUMS; channel++)
            store_channel(header, view, pixel, channel,
                          accumulator->sums[place * PIXEL_SUMS + channel], pixels);
    }
}

/* Renders the pixels of one item and sets its counts. */
FN void render_item(SCENE_PARAMETERS int item, GLOBAL float *pixels, GLOBAL RayCounts *counts) {
    PixelAccumulator accumulator;
    clear_accumulator(&accumulator);
    for (int first = 0; first < HD_PIXELS_PER_ITEM * view->samples; first += HD_LANES) {
        Vec3 direction;
        vmask alive = sample_directions(SAMPLE_ARGUMENTS item, first, &direction);
        Sample sample = empty_sample();
        trace(SCENE_ARGUMENTS direction, alive, &sample);
        add_sample(SCENE_ARGUMENTS & sample, first, &accumulator);
    }
    store_pixels(header, view, item, &accumulator, pixels);
    *counts = accumulator.counts;
}

#if HD_GROUP_SIZE

/* ---- by work groups: packets of one lane, and items of one pixel ---- */

/* A thread's numbers in the memory of its group: its pixel's sums, then its RayCounts. They lie at
   an odd distance from the next thread's, so that neighbours use different banks. */
enum { GROUP_NUMBERS = PIXEL_SUMS + HD_RAY_COUNTS, GROUP_STRIDE = GROUP_NUMBERS | 1 };

/* Traces every `parts`-th sample of the item from sample `part` on; dead ones, if it does not
   exist. Sums them in `own`, for registers are scarce while rays are traced. `parts` divides the
   number of samples, so all threads of a group trace equally many. */
FN void gather_part(SCENE_PARAMETERS int item, int exists, int part, int parts,
                    LOCAL fixed64 *own) {
    for (int i = 0; i < GROUP_NUMBERS; i++)
        own[i] = 0;
    for (int start = 0; start < view->samples; start += parts) {
        Vec3 direction;
        vmask alive = sample_directions(SAMPLE_ARGUMENTS item, start + part, &direction);
        Sample sample = empty_sample();
        trace(SCENE_ARGUMENTS direction, exists ? alive : mask_none(), &sample);
        own[0] += sample.r >> view->pixel_shift;
        own[1] += sample.g >> view->pixel_shift;
        own[2] += sample.b >> view->pixel_shift;
        if (BOUNDED(header))
            own[HD_RADIANCE_SUMS] += shifted_bound(view, sample.bound);
        own[PIXEL_SUMS] += sample.mirrored;
        own[PIXEL_SUMS + 1] += sample.transmitted;
        own[PIXEL_SUMS + 2] += sample.shadow_tests;
        own[PIXEL_SUMS + 3] += sample.clamps;
    }
}

/* Stores pixels and counts of `items` items from `first_item` on: each thread adds up a number of
   all the threads that share an item. */
FN void store_by_group(GLOBAL const Header *header, GLOBAL const View *view, int first_item,
                       int items, int parts, int thread, int thread_count,
                       LOCAL const fixed64 *scratch, GLOBAL float *pixels,
                       GLOBAL RayCounts *counts) {
    for (int i = thread; i < items * GROUP_NUMBERS; i += thread_count) {
        int place = i / GROUP_NUMBERS, number = i % GROUP_NUMBERS, item = first_item + place;
        fixed64 sum = 0;
        for (int p = 0; p < parts; p++)
            sum += scratch[(place * parts + p) * GROUP_STRIDE + number];
        if (number < PIXEL_SUMS)
            store_channel(header, view, pixel_in_block(block_of_item(view, item), item), number,
                          sum, pixels);
        else
            ((GLOBAL uint64 *)(counts + item))[number - PIXEL_SUMS] = (uint64)sum;
    }
}

/* Renders the items [first_item, first_item + item_count) by work groups: `parts` neighbouring
   threads share the samples of an item. All threads must call this; `scratch` has GROUP_STRIDE
   numbers for each. Sums are integers: the split of the samples changes no bit. */
FN void render_by_group(SCENE_PARAMETERS int first_item, int item_count, int parts, int group_index,
                        int group_count, int thread, int thread_count, LOCAL fixed64 *scratch,
                        GLOBAL float *pixels, GLOBAL RayCounts *counts) {
    int per_group = thread_count / parts;
    int place = thread / parts, part = thread % parts;
    for (int first = group_index * per_group; first < item_count;
         first += group_count * per_group) {
        int items = item_count - first < per_group ? item_count - first : per_group;
        gather_part(SCENE_ARGUMENTS first_item + first + place, place < items, part, parts,
                    scratch + thread * GROUP_STRIDE);
        BARRIER();
        store_by_group(header, view, first_item + first, items, parts, thread, thread_count,
                       scratch, pixels, counts);
        BARRIER();
    }
}

#endif

/* ---- first hits, in frames that are not listed ---- */

FN Hit first_hit(SCENE_PARAMETERS const Ray *ray, LocalOrigin *local_origin) {
    *local_origin = local_origin_of(SCENE_ARGUMENTS ray->last_hit, 1);
    return closest_hit(SCENE_ARGUMENTS ray, *local_origin);
}

/* Counts the samples of each of the item's pixels that hit anything. */
FN void count_covered(SCENE_PARAMETERS int item, int covered[HD_PIXELS_PER_ITEM]) {
    int per_pixel = view->samples, count = HD_PIXELS_PER_ITEM * per_pixel;
    for (int place = 0; place < HD_PIXELS_PER_ITEM; place++)
        covered[place] = 0;
    for (int first = 0; first < count; first += HD_LANES) {
        Vec3 direction;
        LocalOrigin local_origin;
        vmask alive = sample_directions(SAMPLE_ARGUMENTS item, first, &direction);
        if (!any_lane(alive))
            continue;
        Ray ray = eye_ray(direction, alive);
        Hit hit = first_hit(SCENE_ARGUMENTS & ray, &local_origin);
        vmask met = alive & ~lt_int(hit.object, splat_int(0));
        vint counts = vselect_int(met, splat_int(1), splat_int(0));
        for (int lane = 0; lane < HD_LANES && first + lane < count; lane++)
            covered[(first + lane) / per_pixel] += lane_int(&counts, lane);
    }
}

/* The hits of rays through pixel centres. */
typedef struct {
    vreal distance; /* 0 without a hit, as is the normal */
    Vec3 normal;
    vint object; /* from 1 on; 0: none */
} CentreHits;

FN CentreHits trace_pixel_centres(SCENE_PARAMETERS vint x, vint y, vmask alive) {
    int n = view->grid_side;
    vreal right = to_real(x * (2 * n) + (view->first_column + n - 1));
    vreal down = to_real(y * (2 * n) + (view->first_row + n - 1));
    Ray ray = eye_ray(direction_to(view, right, down), alive);
    LocalOrigin local_origin;
    Hit hit = first_hit(SCENE_ARGUMENTS & ray, &local_origin);
    vmask met = alive & ~lt_int(hit.object, splat_int(0));
    Surface surface = surface_at(SCENE_ARGUMENTS & ray, local_origin, &hit, met);
    CentreHits centre;
    centre.distance = vselect(met, hit.t, splat(R(0.0)));
    centre.normal = vec3_select(met, surface.normal, vec3_zero());
    centre.object = vselect_int(met, hit.object + 1, splat_int(0));
    return centre;
}

/* Stores the floats after the alpha (HD_FIRST_FLOATS) of the item's pixels. */
FN void store_centre_hits(SCENE_PARAMETERS int item, GLOBAL float *hits) {
    for (int first = 0; first < HD_PIXELS_PER_ITEM; first += HD_LANES) {
        vint x, y;
        vmask alive = pixels_at(view, item, lane_numbers() + first, &x, &y);
        if (!any_lane(alive))
            continue;
        CentreHits centre = trace_pixel_centres(SCENE_ARGUMENTS x, y, alive);
        vint live = vselect_int(alive, splat_int(1), splat_int(0));
        for (int lane = 0; lane < HD_LANES; lane++) {
            if (!lane_int(&live, lane))
                continue;
            uint64 row = (uint64)lane_int(&y, lane) * (uint64)view->width;
            GLOBAL float *out = hits + (row + (uint64)lane_int(&x, lane)) * HD_FIRST_FLOATS;
            out[1] = (float)lane_real(&centre.distance, lane);
            out[2] = (float)lane_real(&centre.normal.x, lane);
            out[3] = (float)lane_real(&centre.normal.y, lane);
            out[4] = (float)lane_real(&centre.normal.z, lane);
            out[5] = (float)lane_int(&centre.object, lane);
        }
    }
}

/* Fills `floats` numbers of each of the item's pixels: HD_ALPHA_FLOATS or HD_FIRST_FLOATS. */
FN void find_first_hits(SCENE_PARAMETERS int item, int floats, GLOBAL float *hits) {
    int covered[HD_PIXELS_PER_ITEM];
    Pixel corner = block_of_item(view, item);
    count_covered(SCENE_ARGUMENTS item, covered);
    for (int place = 0; place < HD_PIXELS_PER_ITEM; place++) {
        Pixel pixel = pixel_in_block(corner, item * HD_PIXELS_PER_ITEM + place);
        if (!in_picture(view, pixel))
            continue;
        uint64 number = (uint64)pixel.y * (uint64)view->width + (uint64)pixel.x;
        hits[number * (uint64)floats] =
            (float)shared_quotient((real)covered[place], (real)view->samples);
    }
    if (floats == HD_FIRST_FLOATS)
        store_centre_hits(SCENE_ARGUMENTS item, hits);
}

/* Sums every `workers`-th count from number `worker` on. */
FN void sum_counts(GLOBAL const RayCounts *counts, int count, int worker, int workers,
                   GLOBAL RayCounts *sums) {
    RayCounts sum = no_counts();
    for (int i = worker; i < count; i += workers)
        add_counts(&sum, counts[i]);
    sums[worker] = sum;
}

/* ---- from radiance to the 8 bits that most files store ---- */

enum { INFINITE_BITS = 0x7f800000 };

/* Returns the maximum code whose threshold is not above a value; 0 for NaN. The value and the
   positive thresholds, by code, are the bits of floats: as integers they keep their order, and no
   compiler can alter the handling of NaN. Negative values are below every threshold. */
FN uint encode8(int bits, GLOBAL const int *thresholds) {
    uint code = 0;
    for (uint step = 128; step > 0; step >>= 1)
        if (bits <= INFINITE_BITS && bits >= thresholds[code + step])
            code += step;
    return code;
}

/* Encodes every `workers`-th of `count` pixels from number `worker` on: three floats, as bits,
   become the bytes r, g, b and an alpha of 255. */
FN void encode_pixels(GLOBAL const int *pixels, int count, GLOBAL const int *thresholds, int worker,
                      int workers, GLOBAL uint *image) {
    for (int i = worker; i < count; i += workers) {
        GLOBAL const int *rgb = pixels + (uint64)i * 3;
        image[i] = encode8(rgb[0], thresholds) | encode8(rgb[1], thresholds) << 8 |
                   encode8(rgb[2], thresholds) << 16 | 0xff000000u;
    }
}

#endif
