/* SPDX-License-Identifier: MIT */
#include "render/adaptive.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "render/survey.h"
#include "system/machine.h"
#include "system/thread_pool.h"

/* Steps of 255 by which pictures must differ, for each step of the error that is aimed at: of
   neighbours that have one sample; of the parts of a pixel's samples; of neighbours that have
   more. Measured on the scenes that ship (docs/performance.md). */
#define FIRST_CONTRAST     0.5
#define PART_CONTRAST      2.0
#define NEIGHBOUR_CONTRAST 8.0

/* The error that is aimed at where nobody said another. */
#define USUAL_ERROR 2.0

/* What is usual of a picture: pixels that are refined, dear as they are, and, of a pass, the
   samples that it brings to neighbours. Progress is guessed by them, and nothing else. */
#define USUAL_SHARE  0.75
#define USUAL_SPREAD 0.05

/* How often samples spread to neighbours, and to which share of the picture at least: a pass of
   fewer pixels keeps a GPU waiting as long as one of many. */
enum { MOST_SPREADS = 4, LEAST_SPREAD = 1000 };

/* More would wait for one another longer than they have work. */
enum { MOST_THREADS = 16 };

typedef struct Codes {
    uint8_t rgb[3];
} Codes;

typedef struct Pixel {
    float mean[3];
    float bound;
    int samples;
    Codes codes;    /* of the mean */
    bool is_uneven; /* the means of its samples' parts differ much */
} Pixel;

struct HdRefinement {
    HdThreadPool *threads;
    HdSurveyor surveyor;
    HdSampleSet samples;
    HdCurve curve;
    int width, height;
    int *order; /* of the pixels: blocks of neighbours together, as bundles like it */
    Pixel *pixels;
    int *chosen;   /* pixels of the pass */
    double *steps; /* of 255, that a pixel may miss */
    HdSurveyRequest *requests;
    HdSurvey *surveys;
    int request_room, survey_room;
    HdWatched left; /* of the frame, that no pass was given */
};

void hd_refinement_free(HdRefinement *r) {
    if (r == NULL)
        return;
    hd_thread_pool_destroy(r->threads);
    hd_surveyor_free(&r->surveyor);
    hd_sample_set_free(&r->samples);
    free(r->order);
    free(r->pixels);
    free(r->chosen);
    free(r->steps);
    free(r->requests);
    free(r->surveys);
    free(r);
}

static void order_pixels(HdRefinement *r) {
    enum { SIDE = 8 };
    int count = 0;
    for (int top = 0; top < r->height; top += SIDE)
        for (int left = 0; left < r->width; left += SIDE)
            for (int z = 0; z < SIDE * SIDE; z++) {
                int x = left + hd_z_order_x(z), y = top + hd_z_order_y(z);
                if (x < r->width && y < r->height)
                    r->order[count++] = y * r->width + x;
            }
}

static HdStatus reserve_requests(HdRefinement *r, int count, HdError *error) {
    r->requests = hd_reserved(r->requests, sizeof *r->requests, count, &r->request_room);
    r->surveys = hd_reserved(r->surveys, sizeof *r->surveys, count, &r->survey_room);
    if (r->requests == NULL || r->surveys == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for surveys of %d pixels", count);
    return HD_OK;
}

HdStatus hd_refinement_create(HdRefinement **refinement, const HdScene *scene, HdRenderer *renderer,
                              HdCurve curve, HdError *error) {
    HdRefinement *r = calloc(1, sizeof *r);
    if (r == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a refinement");
    size_t pixels = (size_t)scene->width * (size_t)scene->height;
    r->width = scene->width;
    r->height = scene->height;
    r->curve = curve;
    const int processors = hd_processor_count();
    HdStatus status = scene->sampling == HD_SAMPLING_REFERENCE
                          ? hd_sample_set_dense(&r->samples, scene->samples_per_side, error)
                          : hd_sample_set_grid(&r->samples, scene->samples_per_side, error);
    if (status == HD_OK)
        status = hd_thread_pool_create(
            &r->threads, processors < MOST_THREADS ? processors : MOST_THREADS, error);
    r->surveyor = (HdSurveyor){.scene = scene,
                               .renderer = renderer,
                               .samples = &r->samples,
                               .budget = hd_error_budget(curve),
                               .most_left_out = hd_most_left_out(scene),
                               .threads = r->threads};
    r->order = calloc(pixels, sizeof *r->order);
    r->pixels = calloc(pixels, sizeof *r->pixels);
    r->chosen = calloc(pixels, sizeof *r->chosen);
    r->steps = calloc(pixels, sizeof *r->steps);
    if (status == HD_OK && !(r->order && r->pixels && r->chosen && r->steps))
        status = hd_fail(error, HD_FAILED, "out of memory: no room for %zu pixels", pixels);
    if (status != HD_OK || r->order == NULL) {
        hd_refinement_free(r);
        return status;
    }
    order_pixels(r);
    *refinement = r;
    return HD_OK;
}

/* ---- what is known of a pixel ---- */

static double error_aimed_at(const HdRefinement *r) {
    double limit = r->surveyor.scene->max_error;
    return limit > 0.0 ? limit : USUAL_ERROR;
}

static int greatest_difference(Codes a, Codes b) {
    int greatest = 0;
    for (int channel = 0; channel < 3; channel++) {
        int difference = abs(a.rgb[channel] - b.rgb[channel]);
        greatest = difference > greatest ? difference : greatest;
    }
    return greatest;
}

static Codes encode(const HdRefinement *r, const float rgb[3]) {
    Codes codes;
    hd_curve_encode8(r->curve, rgb, 3, codes.rgb);
    return codes;
}

static void widen(Codes *least, Codes *most, Codes codes) {
    for (int channel = 0; channel < 3; channel++) {
        uint8_t code = codes.rgb[channel];
        least->rgb[channel] = code < least->rgb[channel] ? code : least->rgb[channel];
        most->rgb[channel] = code > most->rgb[channel] ? code : most->rgb[channel];
    }
}

/* Whether surveys of `samples` samples each differ much. The pixel's own until now are a part as
   well, unless they are fewer. */
static bool are_uneven(const HdRefinement *r, const Pixel *pixel, const HdSurvey *surveys,
                       int count, int samples) {
    Codes first = encode(r, surveys[0].rgb), least = first, most = first;
    for (int i = 1; i < count; i++)
        widen(&least, &most, encode(r, surveys[i].rgb));
    if (pixel->samples >= samples)
        widen(&least, &most, pixel->codes);
    return greatest_difference(least, most) > PART_CONTRAST * error_aimed_at(r);
}

static void add_surveys(const HdRefinement *r, Pixel *pixel, const HdSurvey *surveys, int count,
                        int samples) {
    double total = pixel->samples + (double)count * samples;
    pixel->is_uneven = count > 1 && are_uneven(r, pixel, surveys, count, samples);
    for (int channel = 0; channel < 3; channel++) {
        double sum = (double)pixel->mean[channel] * pixel->samples;
        for (int i = 0; i < count; i++)
            sum += (double)surveys[i].rgb[channel] * samples;
        pixel->mean[channel] = (float)(sum / total);
    }
    double bound = (double)pixel->bound * pixel->samples;
    for (int i = 0; i < count; i++)
        bound += (double)surveys[i].bound * samples;
    pixel->bound = (float)(bound / total);
    pixel->samples = (int)total;
    pixel->codes = encode(r, pixel->mean);
}

/* ---- passes ---- */

/* Rows from 32768 on reach into the sign. */
static int pack(int x, int y) {
    return (int)((uint32_t)y << 16 | (uint32_t)x);
}

/* The chosen pixels' samples from number `from` on, in parts of `each`. */
typedef struct Pass {
    HdRefinement *refinement;
    int from, parts, each;
} Pass;

static void request_samples(void *context, int first, int end) {
    const Pass *pass = context;
    const HdRefinement *r = pass->refinement;
    HdSurveyRequest *request = &r->requests[(size_t)first * (size_t)pass->parts];
    for (int i = first; i < end; i++) {
        int x = r->chosen[i] % r->width, y = r->chosen[i] / r->width;
        for (int p = 0; p < pass->parts; p++)
            *request++ = (HdSurveyRequest){pack(x, y), pass->from + p * pass->each};
    }
}

static void add_samples(void *context, int first, int end) {
    const Pass *pass = context;
    const HdRefinement *r = pass->refinement;
    for (int i = first; i < end; i++) {
        Pixel *pixel = &r->pixels[r->chosen[i]];
        if (pass->from == 0)
            *pixel = (Pixel){0};
        add_surveys(r, pixel, &r->surveys[(size_t)i * (size_t)pass->parts], pass->parts,
                    pass->each);
    }
}

/* The chosen pixels, in order, get the samples up to `samples` in `parts` equal parts. About
   `later` samples follow in other passes. */
static HdStatus sample_chosen(HdRefinement *r, const HdCamera *camera, int count, int from,
                              int samples, int parts, double later, HdError *error) {
    Pass pass = {r, from, parts, (samples - from) / parts};
    if (count == 0)
        return HD_OK;
    if (count > INT_MAX / parts)
        return hd_fail(error, HD_FAILED, "%d pixels are too many for adaptive sampling", count);
    HdStatus status = reserve_requests(r, count * parts, error);
    if (status != HD_OK)
        return status;
    hd_chunks_run(r->threads, count, request_samples, &pass);
    const double own = (double)count * (samples - from);
    const HdSurveyPass asked = {.camera = camera,
                                .requests = r->requests,
                                .count = count * parts,
                                .samples = pass.each,
                                .surveys = r->surveys,
                                .watched = hd_watched_take(&r->left, own / (own + later))};
    status = hd_survey_pass(&r->surveyor, &asked, error);
    if (status == HD_OK)
        hd_chunks_run(r->threads, count, add_samples, &pass);
    return status;
}

/* What pixels are chosen by. */
typedef struct Choice Choice;
typedef bool Judge(const Choice *choice, const Pixel *pixel, const Pixel *neighbour);
struct Choice {
    const HdRefinement *refinement;
    int samples; /* that pixels have */
    Judge *judge;
    int likeness; /* steps of 255 by which neighbours may differ */
};

static bool any_neighbour(const Choice *choice, int number) {
    const HdRefinement *r = choice->refinement;
    const Pixel *pixel = &r->pixels[number];
    int x = number % r->width, y = number / r->width;
    int left = x > 0 ? -1 : 0, right = x + 1 < r->width ? 1 : 0;
    int above = y > 0 ? -1 : 0, below = y + 1 < r->height ? 1 : 0;
    for (int dy = above; dy <= below; dy++)
        for (int dx = left; dx <= right; dx++)
            if (choice->judge(choice, pixel, pixel + dy * r->width + dx))
                return true;
    return false;
}

static bool differs(const Choice *choice, const Pixel *pixel, const Pixel *neighbour) {
    return greatest_difference(pixel->codes, neighbour->codes) > choice->likeness;
}

static bool is_uneven_or_differs(const Choice *choice, const Pixel *pixel, const Pixel *neighbour) {
    return pixel->is_uneven || differs(choice, pixel, neighbour);
}

/* `neighbour` has just got more samples: it is uneven in itself, or not like `pixel`. */
static bool is_next_to_uneven(const Choice *choice, const Pixel *pixel, const Pixel *neighbour) {
    return neighbour->samples > choice->samples &&
           (neighbour->is_uneven || differs(choice, pixel, neighbour));
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

/* Chooses the pixels of so many samples that `judge` finds a reason for; returns their number. */
static int choose(HdRefinement *r, int samples, Judge *judge, double contrast) {
    double likeness = contrast * error_aimed_at(r);
    Choice choice = {r, samples, judge, likeness < 255.0 ? (int)likeness : 255};
    return hd_chunks_choose(r->threads, r->width * r->height, choose_pixels, &choice, r->chosen);
}

/* Pixels of so many samples next to uneven ones that have more: none where they are too few. */
static int choose_next(HdRefinement *r, int samples) {
    int count = choose(r, samples, is_next_to_uneven, NEIGHBOUR_CONTRAST);
    return (double)count * LEAST_SPREAD < (double)r->width * r->height ? 0 : count;
}

static HdStatus sample_all(HdRefinement *r, const HdCamera *camera, int samples, HdError *error) {
    int pixels = r->width * r->height;
    double later = USUAL_SHARE * pixels * (r->samples.count - samples);
    memcpy(r->chosen, r->order, sizeof *r->order * (size_t)pixels);
    return sample_chosen(r, camera, pixels, 0, samples, 1, later, error);
}

/* Into how many parts so many samples are cut: three, or else the least number that divides them.
 */
static int part_count(int samples) {
    int parts = 3;
    while (parts < samples && samples % parts != 0)
        parts++;
    return parts < samples ? parts : samples;
}

/* Nine in ten pixels that need more than one sample need more than four. */
static int next_level(const HdRefinement *r, int samples) {
    int level = samples == 1 ? 16 : 4 * samples;
    return level < r->samples.count ? level : r->samples.count;
}

/* The chosen pixels get as many samples as `level` says, and after them the neighbours of those
   that turn out to be uneven, as far as that spreads. Parts take longer to be sent, and tell
   nothing more where one sample becomes all of them. */
static HdStatus refine_chosen(HdRefinement *r, const HdCamera *camera, int count, int samples,
                              int level, HdError *error) {
    bool is_only_level = samples == 1 && level == r->samples.count;
    int parts = is_only_level ? 1 : part_count(level - samples);
    double later = (double)count * (r->samples.count - level);
    double spread_later = USUAL_SPREAD * count * (level - samples);
    HdStatus status =
        sample_chosen(r, camera, count, samples, level, parts, later + spread_later, error);
    for (int spread = 0; status == HD_OK && count > 0 && spread < MOST_SPREADS; spread++) {
        count = choose_next(r, samples);
        status = sample_chosen(r, camera, count, samples, level, parts, later, error);
    }
    return status;
}

static HdStatus refine(HdRefinement *r, const HdCamera *camera, HdError *error) {
    HdStatus status = sample_all(r, camera, 1, error);
    for (int samples = 1; status == HD_OK && samples < r->samples.count;) {
        int level = next_level(r, samples);
        int count = samples == 1 ? choose(r, 1, differs, FIRST_CONTRAST)
                                 : choose(r, samples, is_uneven_or_differs, NEIGHBOUR_CONTRAST);
        status = refine_chosen(r, camera, count, samples, level, error);
        samples = level;
    }
    return status;
}

/* ---- the frame ---- */

typedef struct Filling {
    const HdRefinement *refinement;
    HdFrame *frame;
} Filling;

static void fill_pixels(void *context, int first, int end) {
    const Filling *filling = context;
    const HdRefinement *r = filling->refinement;
    for (int i = first; i < end; i++) {
        const Pixel *pixel = &r->pixels[i];
        const float *rgb = pixel->mean;
        float least = rgb[0] < rgb[1] ? rgb[0] : rgb[1];
        double darkest = (double)(least < rgb[2] ? least : rgb[2]);
        r->steps[i] = hd_missing_steps(r->curve, (double)pixel->bound, darkest);
        memcpy(filling->frame->rgb + 3 * (size_t)i, rgb, sizeof pixel->mean);
        if (filling->frame->effort != NULL) {
            float *effort = filling->frame->effort + HD_EFFORT_FLOATS * (size_t)i;
            effort[HD_EFFORT_SAMPLES] = (float)pixel->samples;
            effort[HD_EFFORT_BOUND] = (float)r->steps[i];
        }
    }
}

/* The mean is added up in the pixels' order, so that it does not depend on the threads. */
static void fill_frame(const HdRefinement *r, HdFrame *frame) {
    int pixels = r->width * r->height;
    Filling filling = {r, frame};
    double largest = 0.0, sum = 0.0;
    hd_chunks_run(r->threads, pixels, fill_pixels, &filling);
    for (int i = 0; i < pixels; i++) {
        largest = r->steps[i] > largest ? r->steps[i] : largest;
        sum += r->steps[i];
    }
    frame->has_bound = true;
    frame->largest_bound = largest;
    frame->mean_bound = sum / (double)pixels;
}

static void fill_counts(const HdFrame *sums, HdFrame *frame) {
    frame->primary_rays = sums->primary_rays;
    frame->mirrored_rays = sums->mirrored_rays;
    frame->transmitted_rays = sums->transmitted_rays;
    frame->shadow_tests = sums->shadow_tests;
    frame->clamps = sums->clamps;
}

/* The grid's samples tell what is covered, however many of them a pixel took. */
static HdStatus find_first_hits(const HdRefinement *r, const HdCamera *camera, HdFrame *frame,
                                HdError *error) {
    HdRenderer *renderer = r->surveyor.renderer;
    HdFrameTables tables;
    HdStatus status = hd_compile_frame(&tables, r->surveyor.scene, camera,
                                       hd_renderer_options(renderer)->precision, error);
    tables.watched = (HdWatched){.watch = r->left.watch}; /* worth nothing more to it */
    if (status == HD_OK)
        status = hd_renderer_first_hits(renderer, &tables, frame, error);
    hd_frame_tables_free(&tables);
    return status;
}

HdStatus hd_refinement_render(HdRefinement *r, const HdCamera *camera, HdWatch *watch,
                              HdFrame *frame, HdError *error) {
    double start = hd_monotonic_seconds();
    r->surveyor.sums = (HdFrame){0};
    r->left = (HdWatched){watch, HD_WATCH_FRAME};
    HdStatus status = r->surveyor.scene->sampling == HD_SAMPLING_ADAPTIVE
                          ? refine(r, camera, error)
                          : sample_all(r, camera, r->samples.count, error);
    if (status == HD_OK && frame->first != NULL)
        status = find_first_hits(r, camera, frame, error);
    if (status != HD_OK)
        return status;
    hd_watched_add(&r->left, 0, 1, 1);
    frame->is_encoded = false;
    fill_frame(r, frame);
    fill_counts(&r->surveyor.sums, frame);
    frame->trace_seconds = hd_monotonic_seconds() - start;
    return HD_OK;
}
