/* SPDX-License-Identifier: MIT */
#include "survey_pass.h"

#include <stdlib.h>
#include <string.h>

#include "clock.h"
#include "radiance_bound.h"

/* Entries of one submission, at most; lists are worked off in parts. */
enum { MOST_ENTRIES = HD_LISTED_WIDTH << 15 };

/* The first cut-off is this part of what a dark pixel may miss; each further one a part of the last
   one, down to a part that no sum of what is cut off fills. */
#define FIRST_CUTOFF (1.0 / 64.0)
#define NEXT_CUTOFF  (1.0 / 8.0)
enum { MOST_TRIES = 8 };

void hd_surveyor_free(HdSurveyor *surveyor) {
    free(surveyor->entries);
    hd_frame_free(&surveyor->frame);
    surveyor->entries = NULL;
    surveyor->capacity = 0;
}

int hd_survey_depth(const HdScene *scene) {
    HdErrorBudget budget = hd_error_budget(HD_CURVE_SRGB); /* the stricter one */
    double limit = hd_error_budget_radiance(&budget, scene->max_error, 0.0);
    return hd_depth_for_bound(scene, limit * FIRST_CUTOFF * NEXT_CUTOFF);
}

static HdStatus reserve(HdSurveyor *surveyor, int count, HdError *error) {
    if (count <= surveyor->capacity)
        return HD_OK;
    hd_surveyor_free(surveyor);
    surveyor->entries = calloc((size_t)count, 2 * sizeof *surveyor->entries);
    if (surveyor->entries == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of %d pixels", count);
    HdStatus status = hd_frame_create_with(&surveyor->frame, HD_LISTED_WIDTH,
                                           (count + HD_LISTED_WIDTH - 1) / HD_LISTED_WIDTH,
                                           HD_SURVEY_FLOATS, error);
    if (status == HD_OK)
        surveyor->capacity = count;
    return status;
}

static void add_counts(HdSurveyor *surveyor, int count, int samples, double seconds) {
    const HdFrame *frame = &surveyor->frame;
    surveyor->sums.primary_rays += (uint64_t)count * (uint64_t)samples;
    surveyor->sums.mirrored_rays += frame->mirrored_rays;
    surveyor->sums.transmitted_rays += frame->transmitted_rays;
    surveyor->sums.shadow_tests += frame->shadow_tests;
    surveyor->sums.clamps += frame->clamps;
    surveyor->sums.trace_seconds += seconds;
}

static HdStatus submit(HdSurveyor *surveyor, const HdCamera *camera, int count, int samples,
                       double cutoff, HdError *error) {
    HdFrameTables tables;
    const HdSampleList list = {
        .entries = surveyor->entries,
        .entry_count = count,
        .places = surveyor->samples->places,
        .place_count = surveyor->samples->count,
        .grid_side = surveyor->samples->grid_side,
        .samples = samples,
        .bound_cutoff = cutoff,
    };
    HdStatus status = hd_compile_listed_frame(&tables, surveyor->scene, camera, surveyor->precision,
                                              &list, error);
    if (status != HD_OK)
        return status;
    surveyor->frame.height = tables.height;
    status = hd_renderer_render(surveyor->renderer, &tables, &surveyor->frame, error);
    hd_frame_tables_free(&tables);
    return status;
}

static void list_entry(HdSurveyor *surveyor, int place, const HdSurveyRequest *request) {
    surveyor->entries[2 * place] = request->pixel;
    surveyor->entries[2 * place + 1] = request->first;
}

static float darkest(const float rgb[3]) {
    float least = rgb[0] < rgb[1] ? rgb[0] : rgb[1];
    return least < rgb[2] ? least : rgb[2];
}

static bool is_within(const HdSurveyor *surveyor, const HdSurvey *survey) {
    double limit = surveyor->scene->max_error;
    return !(limit > 0.0) ||
           (double)survey->bound <=
               hd_error_budget_radiance(&surveyor->budget, limit, (double)darkest(survey->rgb));
}

/* Of the requests numbered `open`, in place: those that are not within the limit stay. */
static HdStatus survey_open(HdSurveyor *surveyor, const HdCamera *camera,
                            const HdSurveyRequest *requests, int *open, int *open_count,
                            int samples, double cutoff, HdSurvey *surveys, HdError *error) {
    int left = 0;
    for (int from = 0; from < *open_count; from += MOST_ENTRIES) {
        int count = *open_count - from < MOST_ENTRIES ? *open_count - from : MOST_ENTRIES;
        double start = hd_monotonic_seconds();
        for (int i = 0; i < count; i++)
            list_entry(surveyor, i, &requests[open[from + i]]);
        HdStatus status = submit(surveyor, camera, count, samples, cutoff, error);
        if (status != HD_OK)
            return status;
        add_counts(surveyor, count, samples, hd_monotonic_seconds() - start);
        for (int i = 0; i < count; i++) {
            HdSurvey *survey = &surveys[open[from + i]];
            memcpy(survey, surveyor->frame.rgb + HD_SURVEY_FLOATS * (size_t)i, sizeof *survey);
            if (!is_within(surveyor, survey))
                open[left++] = open[from + i];
        }
    }
    *open_count = left;
    return HD_OK;
}

HdStatus hd_survey_pass(HdSurveyor *surveyor, const HdCamera *camera,
                        const HdSurveyRequest *requests, int count, int samples, HdSurvey *surveys,
                        HdError *error) {
    double limit = surveyor->scene->max_error;
    double cutoff = FIRST_CUTOFF * hd_error_budget_radiance(&surveyor->budget, limit, 0.0);
    if (count == 0)
        return HD_OK;
    HdStatus status = reserve(surveyor, count < MOST_ENTRIES ? count : MOST_ENTRIES, error);
    if (status != HD_OK)
        return status;
    int *open = calloc((size_t)count, sizeof *open);
    if (open == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of %d pixels", count);
    for (int i = 0; i < count; i++)
        open[i] = i;
    for (int tries = 0; status == HD_OK && count > 0 && tries < MOST_TRIES; tries++) {
        status =
            survey_open(surveyor, camera, requests, open, &count, samples, cutoff, surveys, error);
        cutoff *= NEXT_CUTOFF;
    }
    free(open);
    return status;
}
