/* SPDX-License-Identifier: MIT */
#include "verify/first_difference.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "render/backends.h"
#include "scene/sample_pattern.h"
#include "verify/trust.h"

enum { DEVICE, PLAIN_C, SIDES };
enum { AS_IT_IS = -1, NOWHERE = -1 };

typedef struct Search {
    const HdMismatch *mismatch;
    HdRenderer *renderers[SIDES];
    HdFrame frames[SIDES]; /* of the last comparison; empty before the first */
    int depth, side;       /* of the original scene: ray depth, samples per side */
    bool is_bounded;
} Search;

/* ---- both sides ---- */

/* The pictures of these kernels serve only the search, so that untested ones may render. */
static HdStatus open_side(Search *search, int side, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error) {
    HdDevice wrong = *device;
    wrong.not_strict[0] = '\0'; /* the device's arithmetic is known to be wrong */
    HdStatus status = hd_renderer_open(&search->renderers[side], &wrong, options, error);
    if (status == HD_OK)
        hd_put_on_trial(search->renderers[side]);
    return status;
}

static HdStatus open_sides(Search *search, HdError *error) {
    HdDevice plain;
    const HdMismatch *mismatch = search->mismatch;
    const HdRenderOptions options = {.precision = mismatch->options->precision};
    HD_TRY(hd_find_plain_device(&plain, error));
    HD_TRY(open_side(search, DEVICE, mismatch->device, mismatch->options, error));
    return open_side(search, PLAIN_C, &plain, &options, error);
}

static void forget_frames(Search *search) {
    for (int side = 0; side < SIDES; side++)
        hd_frame_free(&search->frames[side]);
}

/* ---- the comparison ---- */

/* Makes each position of the pixels' grid a pixel. */
static void split_samples(HdScene *scene) {
    int side = hd_sample_lattice(scene);
    HdCrop *crop = &scene->crop;
    scene->width *= side;
    scene->height *= side;
    crop->whole_width *= side;
    crop->whole_height *= side;
    crop->left *= side;
    crop->top *= side;
    scene->samples_per_side = 1;
    scene->sample_rows = 0;
    scene->sampling = HD_SAMPLING_GRID;
}

static HdStatus compare(Search *search, int depth, bool splits, bool *differs, HdError *error) {
    HdScene scene;
    HdCamera camera;
    HdStatus status = search->mismatch->build(search->mismatch->what, &scene, &camera, error);
    if (status != HD_OK)
        return status;
    search->depth = scene.depth;
    search->side = hd_sample_lattice(&scene);
    search->is_bounded = hd_scene_has_error_bound(&scene);
    if (depth != AS_IT_IS)
        scene.depth = depth;
    if (splits)
        split_samples(&scene);
    forget_frames(search);
    for (int side = 0; status == HD_OK && side < SIDES; side++)
        status = hd_put_and_render(search->renderers[side], &scene, &camera, search->mismatch->like,
                                   0, &search->frames[side], error);
    hd_scene_free(&scene);
    *differs = status == HD_OK &&
               hd_frame_hash(&search->frames[DEVICE]) != hd_frame_hash(&search->frames[PLAIN_C]);
    return status;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Returns the index of the first value that differs in the last comparison, row by row, bit by bit:
   a NaN equals itself. */
static int first_value(const Search *search) {
    const HdFrame *found = &search->frames[DEVICE], *expected = &search->frames[PLAIN_C];
    for (int i = 0; i < found->width * found->height * found->floats; i++)
        if (bits_of(found->rgb[i]) != bits_of(expected->rgb[i]))
            return i;
    return NOWHERE;
}

/* ---- report ---- */

static void report_counts(const Search *search, char *text, size_t capacity) {
    const HdFrame *found = &search->frames[DEVICE], *expected = &search->frames[PLAIN_C];
    const struct {
        const char *what;
        uint64_t found, expected;
    } counts[] = {{"mirrored rays", found->mirrored_rays, expected->mirrored_rays},
                  {"transmitted rays", found->transmitted_rays, expected->transmitted_rays},
                  {"tests for shadows", found->shadow_tests, expected->shadow_tests},
                  {"contributions that are cut", found->clamps, expected->clamps}};
    int i = 0;
    while (i < 3 && counts[i].found == counts[i].expected)
        i++;
    snprintf(text, capacity, "no pixel, but the number of %s is %" PRIu64 ", expected %" PRIu64,
             counts[i].what, counts[i].found, counts[i].expected);
}

static void describe_value(const Search *search, int depth, bool is_split, char *text,
                           size_t capacity) {
    static const char *const channels[] = {"red", "green", "blue", "the bound"};
    const HdFrame *found = &search->frames[DEVICE], *expected = &search->frames[PLAIN_C];
    char sample[80] = "";
    int value = first_value(search), side = search->side;
    if (value == NOWHERE) {
        report_counts(search, text, capacity);
        return;
    }
    int pixel = value / found->floats, x = pixel % found->width, y = pixel / found->width;
    if (is_split)
        snprintf(sample, sizeof sample, ", sample %d, %d of %d x %d", x % side, y % side, side,
                 side);
    else if (side > 1 && !search->is_bounded)
        snprintf(sample, sizeof sample, ", though no sample of its %d x %d differs alone", side,
                 side);
    snprintf(text, capacity, "pixel %d, %d%s, depth %d of the ray: %s is %a, expected %a",
             is_split ? x / side : x, is_split ? y / side : y, sample, depth,
             channels[value % found->floats], (double)found->rgb[value],
             (double)expected->rgb[value]);
}

/* ---- search ---- */

static HdStatus search_frame(Search *search, char *text, size_t capacity, HdError *error) {
    bool differs, is_split = false;
    int depth = 0;
    snprintf(text, capacity, "a second rendering equals that of plain C");
    HdStatus status = compare(search, AS_IT_IS, false, &differs, error);
    if (status != HD_OK || !differs)
        return status;
    differs = false;
    for (; status == HD_OK && !differs && depth <= search->depth; depth++)
        status = compare(search, depth, false, &differs, error);
    depth--;
    if (status == HD_OK && differs && search->side > 1 && !search->is_bounded) {
        status = compare(search, depth, true, &is_split, error);
        if (status == HD_OK && !is_split)
            status = compare(search, depth, false, &differs, error);
    }
    if (status == HD_OK && differs)
        describe_value(search, depth, is_split, text, capacity);
    else if (status == HD_OK)
        snprintf(text, capacity, "the same frame differs in some renderings only");
    return status;
}

HdStatus hd_first_difference(const HdMismatch *mismatch, char *text, size_t capacity,
                             HdError *error) {
    Search search = {.mismatch = mismatch};
    HdStatus status = open_sides(&search, error);
    if (status == HD_OK)
        status = search_frame(&search, text, capacity, error);
    if (status != HD_OK)
        snprintf(text, capacity, "the search for the difference failed: %s", error->message);
    forget_frames(&search);
    for (int side = 0; side < SIDES; side++)
        hd_renderer_close(search.renderers[side]);
    return status;
}
