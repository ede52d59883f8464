/* SPDX-License-Identifier: MIT */
#include "render/frame.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "base/minmax.h"
#include "kernels/host/shared.h"
#include "render/bound_pass.h"
#include "system/machine.h"
#include "system/thread_pool.h"
#include "tables/table.h"

/* Least contrasts in steps of 1/255, per step of the target error: of neighbours with one sample,
   of the parts of a pixel's samples, and of neighbours with more samples. Measured on the bundled
   scenes (docs/performance.md). */
#define FIRST_CONTRAST     0.5
#define PART_CONTRAST      2.0
#define NEIGHBOUR_CONTRAST 8.0

/* Target error unless the user sets one. */
#define USUAL_ERROR 2.0

/* Typical share of refined pixels, weighted by cost, and of a pass's samples that spread to
   neighbours. Only progress estimates use them. */
#define USUAL_SHARE  0.75
#define USUAL_SPREAD 0.05

/* Most rounds of spreading to neighbours, and the picture's part that a round must reach: a smaller
   pass keeps a GPU waiting as long as a large one. */
enum { MAX_SPREADS = 4, MIN_SPREAD = 1000 };

/* More would wait for each other longer than they work. */
enum { MAX_THREADS = 16 };

typedef struct Codes {
    uint8_t rgb[3];
} Codes;

typedef struct Pixel {
    float mean[3];
    float bound;
    int samples;
    Codes codes;    /* codes of the mean */
    bool is_uneven; /* means of its samples' parts differ much */
} Pixel;

typedef struct HdRefinement {
    HdThreadPool *threads;
    HdBoundPasses passes; /* passes of the scene; their sums are the frame */
    HdSampleSet samples;
    int width, height;
    int *order; /* pixels in blocks of neighbours, which suit packets */
    Pixel *pixels;
    int *chosen;   /* pixels of the pass */
    double *steps; /* steps of 1/255 that a pixel may miss */
    HdBoundRequest *requests;
    HdBoundedMean *means;
    int request_capacity, mean_capacity;
    HdWatched left; /* weight of the frame not given to a pass */
} HdRefinement;

static void free_refinement(HdRefinement *r) {
    if (r == NULL)
        return;
    hd_thread_pool_destroy(r->threads);
    hd_bound_passes_free(&r->passes);
    hd_sample_set_free(&r->samples);
    free(r->order);
    free(r->pixels);
    free(r->chosen);
    free(r->steps);
    free(r->requests);
    free(r->means);
    free(r);
}

static void order_pixels(HdRefinement *r) {
    enum { SIDE = HD_BLOCK_SIDE };
    int count = 0;
    for (int top = 0; top < r->height; top += SIDE)
        for (int left = 0; left < r->width; left += SIDE)
            for (int z = 0; z < SIDE * SIDE; z++) {
                int x = left + HD_Z_COLUMN(z), y = top + HD_Z_ROW(z);
                if (x < r->width && y < r->height)
                    r->order[count++] = y * r->width + x;
            }
}

/* The scene is on the renderer; both must live on. */
static HdStatus fill_refinement(HdRefinement *r, const HdFrameMaker *maker, HdError *error) {
    const HdScene *scene = maker->scene;
    const int side = scene->samples_per_side;
    const size_t pixels = (size_t)scene->width * (size_t)scene->height;
    r->width = scene->width;
    r->height = scene->height;
    HD_TRY((scene->sampling == HD_SAMPLING_REFERENCE ? hd_sample_set_dense
            : scene->sampling == HD_SAMPLING_MULTIJITTER
                ? hd_sample_set_multijitter
                : hd_sample_set_grid)(&r->samples, side, error));
    HD_TRY(hd_thread_pool_create(&r->threads, hd_min(hd_processor_count(), MAX_THREADS), error));
    r->passes = (HdBoundPasses){.scene = scene,
                                .renderer = maker->renderer,
                                .samples = &r->samples,
                                .curve = maker->request.curve,
                                .max_left_out = hd_max_left_out(scene),
                                .threads = r->threads};
    r->order = calloc(pixels, sizeof *r->order);
    r->pixels = calloc(pixels, sizeof *r->pixels);
    r->chosen = calloc(pixels, sizeof *r->chosen);
    r->steps = calloc(pixels, sizeof *r->steps);
    if (!(r->order && r->pixels && r->chosen && r->steps))
        return HD_NO_ROOM(error, "%zu pixels", pixels);
    order_pixels(r);
    return HD_OK;
}

/* ---- contrast of pixels ---- */

static double error_aimed_at(const HdRefinement *r) {
    double limit = r->passes.scene->max_error;
    return limit > 0.0 ? limit : USUAL_ERROR;
}

static int greatest_difference(Codes a, Codes b) {
    int greatest = 0;
    for (int channel = 0; channel < 3; channel++)
        greatest = hd_max(greatest, abs(a.rgb[channel] - b.rgb[channel]));
    return greatest;
}

static Codes encode(const HdRefinement *r, const float rgb[3]) {
    Codes codes;
    hd_curve_encode8(r->passes.curve, rgb, 3, codes.rgb);
    return codes;
}

static void widen(Codes *least, Codes *most, Codes codes) {
    for (int channel = 0; channel < 3; channel++) {
        uint8_t code = codes.rgb[channel];
        least->rgb[channel] = code < least->rgb[channel] ? code : least->rgb[channel];
        most->rgb[channel] = code > most->rgb[channel] ? code : most->rgb[channel];
    }
}

/* Returns whether means of `samples` samples differ much. The pixel's own mean counts too, unless
   it has fewer samples. */
static bool are_uneven(const HdRefinement *r, const Pixel *pixel, const HdBoundedMean *means,
                       int count, int samples) {
    Codes first = encode(r, means[0].rgb), least = first, most = first;
    for (int i = 1; i < count; i++)
        widen(&least, &most, encode(r, means[i].rgb));
    if (pixel->samples >= samples)
        widen(&least, &most, pixel->codes);
    return greatest_difference(least, most) > PART_CONTRAST * error_aimed_at(r);
}

static void add_means(const HdRefinement *r, Pixel *pixel, const HdBoundedMean *means, int count,
                      int samples) {
    double total = pixel->samples + (double)count * samples;
    pixel->is_uneven = count > 1 && are_uneven(r, pixel, means, count, samples);
    for (int channel = 0; channel < 3; channel++) {
        double sum = (double)pixel->mean[channel] * pixel->samples;
        for (int i = 0; i < count; i++)
            sum += (double)means[i].rgb[channel] * samples;
        pixel->mean[channel] = (float)(sum / total);
    }
    double bound = (double)pixel->bound * pixel->samples;
    for (int i = 0; i < count; i++)
        bound += (double)means[i].bound * samples;
    pixel->bound = (float)(bound / total);
    pixel->samples = (int)total;
    pixel->codes = encode(r, pixel->mean);
}

/* ---- passes ---- */

/* Samples of the chosen pixels from index `from` on, in parts of `each`. */
typedef struct Pass {
    HdRefinement *refinement;
    int from, parts, each;
} Pass;

static void request_samples(void *context, int first, int end) {
    const Pass *pass = context;
    const HdRefinement *r = pass->refinement;
    HdBoundRequest *request = &r->requests[(size_t)first * (size_t)pass->parts];
    for (int i = first; i < end; i++) {
        int x = r->chosen[i] % r->width, y = r->chosen[i] / r->width;
        const int packed =
            (int)((uint32_t)y << 16 | (uint32_t)x); /* the sign bit belongs to the row */
        for (int p = 0; p < pass->parts; p++)
            *request++ = (HdBoundRequest){packed, pass->from + p * pass->each};
    }
}

static void add_samples(void *context, int first, int end) {
    const Pass *pass = context;
    const HdRefinement *r = pass->refinement;
    for (int i = first; i < end; i++) {
        Pixel *pixel = &r->pixels[r->chosen[i]];
        if (pass->from == 0)
            *pixel = (Pixel){0};
        add_means(r, pixel, &r->means[(size_t)i * (size_t)pass->parts], pass->parts, pass->each);
    }
}

/* Takes the chosen pixels, in order, to `samples` samples in `parts` equal parts. About `later`
   samples follow in other passes. */
static HdStatus sample_chosen(HdRefinement *r, int count, int from, int samples, int parts,
                              double later, HdError *error) {
    Pass pass = {r, from, parts, (samples - from) / parts};
    if (count == 0)
        return HD_OK;
    if (count > INT_MAX / parts)
        return hd_fail(error, HD_FAILED, "%d pixels are too many for adaptive sampling", count);
    const int all = count * parts;
    r->requests = hd_reserved(r->requests, sizeof *r->requests, all, &r->request_capacity);
    r->means = hd_reserved(r->means, sizeof *r->means, all, &r->mean_capacity);
    if (r->requests == NULL || r->means == NULL)
        return HD_NO_ROOM(error, "the means of %d pixels", all);
    hd_chunks_run(r->threads, count, request_samples, &pass);
    const double own = (double)count * (samples - from);
    const HdBoundPass asked = {.requests = r->requests,
                               .count = all,
                               .samples = pass.each,
                               .means = r->means,
                               .watched = hd_watched_split(&r->left, own / (own + later))};
    HD_TRY(hd_bound_pass(&r->passes, &asked, error));
    hd_chunks_run(r->threads, count, add_samples, &pass);
    return HD_OK;
}

/* Criteria of the choice of pixels. */
typedef struct Choice {
    const HdRefinement *refinement;
    int samples;    /* samples of the pixels to choose */
    bool is_spread; /* choice only because of neighbours with new samples */
    int likeness;   /* largest difference of similar neighbours, in 1/255 */
} Choice;

/* A pixel qualifies if it, or a neighbour with new samples, is uneven, or if it differs from a
   neighbour. */
static bool is_reason(const Choice *choice, const Pixel *pixel, const Pixel *neighbour) {
    bool differs = greatest_difference(pixel->codes, neighbour->codes) > choice->likeness;
    return choice->is_spread
               ? neighbour->samples > choice->samples && (neighbour->is_uneven || differs)
               : pixel->is_uneven || differs;
}

static bool any_neighbour(const Choice *choice, int number) {
    const HdRefinement *r = choice->refinement;
    const Pixel *pixel = &r->pixels[number];
    int x = number % r->width, y = number / r->width;
    int left = x > 0 ? -1 : 0, right = x + 1 < r->width ? 1 : 0;
    int above = y > 0 ? -1 : 0, below = y + 1 < r->height ? 1 : 0;
    for (int dy = above; dy <= below; dy++)
        for (int dx = left; dx <= right; dx++)
            if (is_reason(choice, pixel, pixel + dy * r->width + dx))
                return true;
    return false;
}

static int choose_pixels(void *context, int first, int end, int *chosen) {
    const Choice *choice = context;
    const HdRefinement *r = choice->refinement;
    int count = 0;
    for (int i = first; i < end; i++) {
        int number = r->order[i];
        if (r->pixels[number].samples == choice->samples && any_neighbour(choice, number))
            chosen[count++] = number;
    }
    return count;
}

/* Chooses the qualifying pixels of `samples` samples; returns their number. */
static int choose(HdRefinement *r, int samples, bool is_spread, double contrast) {
    double likeness = contrast * error_aimed_at(r);
    Choice choice = {r, samples, is_spread, likeness < 255.0 ? (int)likeness : 255};
    return hd_chunks_choose(r->threads, r->width * r->height, choose_pixels, &choice, r->chosen);
}

static HdStatus sample_all(HdRefinement *r, int samples, HdError *error) {
    int pixels = r->width * r->height;
    double later = USUAL_SHARE * pixels * (r->samples.count - samples);
    memcpy(r->chosen, r->order, sizeof *r->order * (size_t)pixels);
    return sample_chosen(r, pixels, 0, samples, 1, later, error);
}

/* Returns the number of parts: three, or else the least number that divides the samples. */
static int part_count(int samples) {
    int parts = 3;
    while (parts < samples && samples % parts != 0)
        parts++;
    return parts < samples ? parts : samples;
}

/* Gives the chosen pixels the samples of `level`, and then neighbours of those that become uneven,
   while that spreads. One sample that becomes all of them needs no parts, which take longer to
   send. */
static HdStatus refine_chosen(HdRefinement *r, int count, int samples, int level, HdError *error) {
    bool is_only_level = samples == 1 && level == r->samples.count;
    int parts = is_only_level ? 1 : part_count(level - samples);
    double later = (double)count * (r->samples.count - level);
    double spread_later = USUAL_SPREAD * count * (level - samples);
    HD_TRY(sample_chosen(r, count, samples, level, parts, later + spread_later, error));
    for (int spread = 0; count > 0 && spread < MAX_SPREADS; spread++) {
        count = choose(r, samples, true, NEIGHBOUR_CONTRAST);
        if ((double)count * MIN_SPREAD < (double)r->width * r->height)
            break;
        HD_TRY(sample_chosen(r, count, samples, level, parts, later, error));
    }
    return HD_OK;
}

/* Nine in ten pixels that need more than one sample need more than four. */
static HdStatus refine(HdRefinement *r, HdError *error) {
    HD_TRY(sample_all(r, 1, error));
    for (int samples = 1; samples < r->samples.count;) {
        int level = hd_min(samples == 1 ? 16 : 4 * samples, r->samples.count);
        int count = choose(r, samples, false, samples == 1 ? FIRST_CONTRAST : NEIGHBOUR_CONTRAST);
        HD_TRY(refine_chosen(r, count, samples, level, error));
        samples = level;
    }
    return HD_OK;
}

/* ---- frames with an error bound ---- */

static void fill_pixels(void *context, int first, int end) {
    const HdRefinement *r = context;
    const HdFrame *frame = r->passes.sums;
    for (int i = first; i < end; i++) {
        const Pixel *pixel = &r->pixels[i];
        r->steps[i] = hd_missing_steps(r->passes.curve, (double)pixel->bound,
                                       (double)hd_darkest(pixel->mean));
        memcpy(frame->rgb + 3 * (size_t)i, pixel->mean, sizeof pixel->mean);
        if (frame->effort != NULL) {
            float *effort = frame->effort + HD_EFFORT_FLOATS * (size_t)i;
            effort[HD_EFFORT_SAMPLES] = (float)pixel->samples;
            effort[HD_EFFORT_BOUND] = (float)r->steps[i];
        }
    }
}

/* Sums the mean in the pixels' order, so that it does not depend on the threads. */
static void fill_frame(HdRefinement *r, HdFrame *frame) {
    int pixels = r->width * r->height;
    double largest = 0.0, sum = 0.0;
    hd_chunks_run(r->threads, pixels, fill_pixels, r);
    for (int i = 0; i < pixels; i++) {
        largest = r->steps[i] > largest ? r->steps[i] : largest;
        sum += r->steps[i];
    }
    frame->has_bound = true;
    frame->largest_bound = largest;
    frame->mean_bound = sum / (double)pixels;
}

/* Coverage comes from all n x n samples, however many a pixel has. */
static HdStatus find_first_hits(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                                HdError *error) {
    HdFrameTables tables;
    HdStatus status =
        hd_compile_frame(&tables, maker->scene, camera,
                         hd_renderer_options(maker->renderer)->precision, NULL, error);
    tables.watched = (HdWatched){.watch = maker->watch}; /* without further weight */
    if (status == HD_OK)
        status = hd_renderer_first_hits(maker->renderer, &tables, frame, error);
    hd_frame_tables_free(&tables);
    return status;
}

/* Weights of passes are estimates, since each depends on the results of those before. */
static HdStatus render_bounded(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                               HdError *error) {
    HdRefinement *r = maker->refinement;
    double start = hd_monotonic_seconds();
    frame->primary_rays = frame->mirrored_rays = frame->transmitted_rays = 0;
    frame->shadow_tests = frame->clamps = 0;
    r->passes.camera = camera;
    r->passes.sums = frame;
    r->left = (HdWatched){maker->watch, HD_WATCH_FRAME};
    HD_TRY(maker->scene->sampling == HD_SAMPLING_ADAPTIVE ? refine(r, error)
                                                          : sample_all(r, r->samples.count, error));
    if (frame->first != NULL)
        HD_TRY(find_first_hits(maker, camera, frame, error));
    hd_watched_add(&r->left, 0, 1, 1);
    frame->is_encoded = false;
    fill_frame(r, frame);
    frame->trace_seconds = hd_monotonic_seconds() - start;
    return HD_OK;
}

/* ---- frames ---- */

HdStatus hd_frame_maker_open(HdFrameMaker *maker, HdError *error) {
    maker->refinement = NULL;
    if (!hd_scene_has_error_bound(maker->scene))
        return HD_OK;
    maker->refinement = calloc(1, sizeof *maker->refinement);
    if (maker->refinement == NULL)
        return HD_NO_ROOM(error, "a refinement");
    HdStatus status = fill_refinement(maker->refinement, maker, error);
    if (status != HD_OK)
        hd_frame_maker_close(maker);
    return status;
}

void hd_frame_maker_close(HdFrameMaker *maker) {
    free_refinement(maker->refinement);
    maker->refinement = NULL;
}

int hd_frame_max_in_flight(const HdFrameMaker *maker) {
    return maker->refinement != NULL ? 1 : HD_FRAMES_IN_FLIGHT;
}

HdStatus hd_frame_prepare(const HdFrameMaker *maker, const HdCamera *camera,
                          HdFrameInFlight *in_flight, HdError *error) {
    *in_flight = (HdFrameInFlight){.camera = *camera};
    if (maker->refinement != NULL)
        return HD_OK;
    HdStatus status =
        hd_compile_frame(&in_flight->tables, maker->scene, camera,
                         hd_renderer_options(maker->renderer)->precision, NULL, error);
    in_flight->tables.watched = (HdWatched){maker->watch, HD_WATCH_FRAME};
    return status;
}

HdStatus hd_frame_begin(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdError *error) {
    if (maker->refinement != NULL)
        return HD_OK;
    HdStatus status =
        hd_renderer_submit(maker->renderer, &in_flight->tables, &maker->request, error);
    if (status != HD_OK)
        hd_frame_tables_free(&in_flight->tables);
    return status;
}

HdStatus hd_frame_end(const HdFrameMaker *maker, HdFrameInFlight *in_flight, HdFrame *frame,
                      HdError *error) {
    if (maker->refinement != NULL)
        return render_bounded(maker, &in_flight->camera, frame, error);
    HdStatus status = hd_renderer_collect(maker->renderer, frame, error);
    if (status == HD_OK && frame->first != NULL)
        status = hd_renderer_first_hits(maker->renderer, &in_flight->tables, frame, error);
    hd_frame_fill_samples(frame, in_flight->tables.samples);
    hd_frame_tables_free(&in_flight->tables);
    return status;
}

HdStatus hd_frame_render(const HdFrameMaker *maker, const HdCamera *camera, HdFrame *frame,
                         HdError *error) {
    HdFrameMaker own = *maker;
    HdFrameInFlight in_flight;
    own.request.radiance = true;
    HdStatus status = hd_frame_maker_open(&own, error);
    if (status == HD_OK)
        status = hd_frame_prepare(&own, camera, &in_flight, error);
    if (status == HD_OK)
        status = hd_frame_begin(&own, &in_flight, error);
    if (status == HD_OK)
        status = hd_frame_end(&own, &in_flight, frame, error);
    hd_renderer_drop(own.renderer);
    hd_frame_maker_close(&own);
    return status;
}
