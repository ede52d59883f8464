/* SPDX-License-Identifier: MIT */
#include "render/bound_pass.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "base/limits.h"
#include "base/minmax.h"
#include "kernels/host/shared.h"
#include "scene/light_bound.h"
#include "scene/sample_pattern.h"
#include "system/thread_pool.h"

/* ---- errors ---- */

/* sRGB: 1 / f' is 1 / 12.92 = 0.0774 up to 0.0031308, then 2.2749 v^0.5833, which is concave. The
   line 0.0705 + 2.2 v is below both at their ends: 0.0774 at 0.0031308 and 2.2749 at 1. */
double hd_missing_allowed(HdCurve curve, double steps, double radiance) {
    if (curve != HD_CURVE_SRGB)
        return steps * (1.0 / 255.0);
    return steps * (0.0705 / 255.0 + 2.2 / 255.0 * (radiance > 0.0 ? radiance : 0.0));
}

/* Curves are the steepest at the dark end. */
double hd_missing_steps(HdCurve curve, double missing, double radiance) {
    return 255.0 *
           (hd_curve_to_display(curve, radiance + missing) - hd_curve_to_display(curve, radiance));
}

float hd_darkest(const float rgb[3]) {
    float least = rgb[0] < rgb[1] ? rgb[0] : rgb[1];
    return least < rgb[2] ? least : rgb[2];
}

/* ---- bound passes ---- */

/* Most entries of one submission, in whole items. Few large submissions are faster, for a GPU waits
   for the longest tree of each. */
enum { MAX_ENTRIES = HD_MAX_IMAGE_SIDE / HD_LISTED_WIDTH * HD_LISTED_WIDTH * HD_LISTED_WIDTH };

/* Cut-offs as parts of a dark pixel's allowance: the first one, the ratio of successive ones, and
   the last one. With the last one no sample of at most MAX_RAYS rays can miss too much. */
#define FIRST_CUTOFF (1.0 / 64.0)
#define NEXT_CUTOFF  (1.0 / 8.0)
#define LAST_CUTOFF  (1.0 / MAX_RAYS)

/* Mean rays of a sample, beyond which smaller cut-offs would not terminate. A packet cannot be
   interrupted. */
#define MAX_RAYS 1048576.0

/* First limit on the way to smaller ones, so that each pass predicts the cost of the next. */
#define EASY_LIMIT 1.0

/* A bound that stays above this part of its last value gains nothing from a smaller cut-off: depth
   or weight ended the rays. */
#define PROGRESS 0.99F

void hd_bound_passes_free(HdBoundPasses *passes) {
    free(passes->entries);
    free(passes->open);
    hd_frame_free(&passes->frame);
}

void hd_bound_pass_end_rays(HdScene *scene) {
    /* sRGB is the stricter curve. */
    const double limit = hd_missing_allowed(HD_CURVE_SRGB, scene->max_error, 0.0);
    if (!(scene->max_error > 0.0))
        return;
    scene->depth = hd_depth_for_bound(scene, limit * LAST_CUTOFF);
    scene->cutoff = 0.0;
}

static HdStatus reserve_frame(HdBoundPasses *passes, int rows, HdError *error) {
    if (rows <= passes->frame_rows)
        return HD_OK;
    hd_frame_free(&passes->frame);
    HdStatus status =
        hd_frame_create_with(&passes->frame, HD_LISTED_WIDTH, rows, HD_BOUNDED_FLOATS, error);
    passes->frame_rows = status == HD_OK ? rows : 0;
    return status;
}

static HdStatus reserve(HdBoundPasses *passes, int count, HdError *error) {
    const int at_once = hd_min(count, MAX_ENTRIES);
    passes->entries =
        hd_reserved(passes->entries, sizeof *passes->entries, at_once, &passes->entry_capacity);
    passes->open = hd_reserved(passes->open, sizeof *passes->open, count, &passes->open_capacity);
    if (passes->entries == NULL || passes->open == NULL)
        return HD_NO_ROOM(error, "a list of %d pixels", count);
    return reserve_frame(passes, (at_once + HD_LISTED_WIDTH - 1) / HD_LISTED_WIDTH, error);
}

static void add_counts(HdFrame *sums, const HdFrame *frame, int count, int samples) {
    sums->primary_rays += (uint64_t)count * (uint64_t)samples;
    sums->mirrored_rays += frame->mirrored_rays;
    sums->transmitted_rays += frame->transmitted_rays;
    sums->shadow_tests += frame->shadow_tests;
    sums->clamps += frame->clamps;
}

static bool is_within(const HdBoundPasses *passes, const HdBoundedMean *mean) {
    double limit = passes->scene->max_error;
    return !(limit > 0.0) ||
           (double)mean->bound <=
               hd_missing_allowed(passes->curve, limit, (double)hd_darkest(mean->rgb));
}

/* Pixels of one submission. */
typedef struct Part {
    HdBoundPasses *passes;
    const HdBoundPass *pass;
    double cutoff;
    bool is_first; /* first of several cut-offs */
    int *open;     /* numbers of the pixels; at first from, from + 1, ... */
    int from, count;
} Part;

static int pixel_number(const Part *part, int i) {
    return part->is_first ? part->from + i : part->open[i];
}

/* Returns the list position of pixel i of `count`. Items render their 64 entries in Z order, so
   neighbours share packets only if they are listed so. The last pixels, which fill no item, stay
   in order. */
static int list_position(int i, int count) {
    enum { ITEM = HD_LISTED_WIDTH * HD_LISTED_WIDTH };
    int z = i % ITEM, first = i - z;
    return first + ITEM <= count ? first + HD_Z_ROW(z) * HD_LISTED_WIDTH + HD_Z_COLUMN(z) : i;
}

static void list_entries(void *context, int first, int end) {
    const Part *part = context;
    for (int i = first; i < end; i++) {
        part->passes->entries[list_position(i, part->count)] =
            part->pass->pixels[pixel_number(part, i)];
    }
}

/* Stores means and selects the pixels beyond the limit. */
static int store_means(void *context, int first, int end, int *still_open) {
    const Part *part = context;
    const float *values = part->passes->frame.rgb;
    int left = 0;
    for (int i = first; i < end; i++) {
        int number = pixel_number(part, i);
        HdBoundedMean *mean = &part->pass->means[number];
        float before = mean->bound;
        size_t place = (size_t)list_position(i, part->count);
        memcpy(mean, values + HD_BOUNDED_FLOATS * place, sizeof *mean);
        bool goes_on = part->is_first || mean->bound < PROGRESS * before;
        if (goes_on && !is_within(part->passes, mean))
            still_open[left++] = number;
    }
    return left;
}

static HdStatus submit(const Part *part, HdWatched watched, HdError *error) {
    HdBoundPasses *passes = part->passes;
    HdFrameTables tables;
    const HdPixelList list = {
        .entries = passes->entries,
        .entry_count = part->count,
        .bound_cutoff = part->cutoff,
        .max_left_out = passes->max_left_out,
    };
    HD_TRY(hd_compile_frame(&tables, passes->scene, passes->camera,
                            hd_renderer_options(passes->renderer)->precision, &list, error));
    tables.watched = watched;
    passes->frame.height = tables.height;
    HdStatus status = hd_renderer_render(passes->renderer, &tables, &passes->frame, error);
    hd_frame_tables_free(&tables);
    return status;
}

/* Renders the pixels of a part and keeps those beyond the limit, in place. */
static HdStatus bound_part(Part *part, HdWatched watched, HdError *error) {
    HdBoundPasses *passes = part->passes;
    hd_chunks_run(passes->threads, part->count, list_entries, part);
    HD_TRY(submit(part, watched, error));
    add_counts(passes->sums, &passes->frame, part->count, hd_sample_count(passes->scene));
    part->count = hd_chunks_choose(passes->threads, part->count, store_means, part, part->open);
    return HD_OK;
}

/* Renders the open pixels, at first all. */
static HdStatus bound_open(HdBoundPasses *passes, const HdBoundPass *pass, double cutoff,
                           bool is_first, HdWatched watched, int *open_count, HdError *error) {
    int left = 0;
    for (int from = 0; from < *open_count; from += MAX_ENTRIES) {
        int rest = *open_count - from, count = hd_min(rest, MAX_ENTRIES);
        int *open = passes->open + from;
        Part part = {passes, pass, cutoff, is_first, open, from, count};
        HD_TRY(bound_part(&part, hd_watched_split(&watched, (double)count / rest), error));
        memmove(passes->open + left, open, sizeof *open * (size_t)part.count);
        left += part.count;
    }
    *open_count = left;
    return HD_OK;
}

/* Decreases the cut-off until no pixel is open; without a limit one cut-off suffices. Each step
   gets most of the remaining weight, for few pixels need another one. */
HdStatus hd_bound_pass(HdBoundPasses *passes, const HdBoundPass *pass, HdError *error) {
    double limit = passes->scene->max_error;
    double easy = limit > 0.0 && limit < EASY_LIMIT ? EASY_LIMIT : limit;
    double cutoff = FIRST_CUTOFF * hd_missing_allowed(passes->curve, easy, 0.0);
    double last = LAST_CUTOFF * hd_missing_allowed(passes->curve, limit, 0.0);
    bool is_first = true;
    int open = pass->count;
    HdWatched watched = pass->watched;
    HD_TRY(reserve(passes, open, error));
    while (open > 0) {
        const double before = (double)hd_frame_rays(passes->sums),
                     tried = (double)open * hd_sample_count(passes->scene);
        const HdWatched own = hd_watched_split(&watched, limit > 0.0 ? 0.875 : 1.0);
        HD_TRY(bound_open(passes, pass, cutoff, is_first, own, &open, error));
        if (cutoff <= last ||
            (double)hd_frame_rays(passes->sums) - before > tried * MAX_RAYS * NEXT_CUTOFF)
            break;
        cutoff = cutoff * NEXT_CUTOFF > last ? cutoff * NEXT_CUTOFF : last;
        is_first = false;
    }
    hd_watched_add(&watched, 0, 1, 1);
    return HD_OK;
}
