/* SPDX-License-Identifier: MIT */
#include "verify/first_difference.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "verify/trust.h"

enum { DEVICE, PLAIN_C, SIDES };
enum { NOWHERE = -1, MOST_PARTS = 64 };

/* What is taken from the scene as it was built. Of each kind of part a bit for those left out. */
typedef struct Cuts {
    uint64_t solids, edge_lights, lights, instances;
    bool floor;
    int depth;                    /* NOWHERE: as it was */
    int left, top, right, bottom; /* what is left of the picture, in its pixels */
    bool samples_are_pixels;      /* each sample of a grid is a pixel of its own */
} Cuts;

typedef struct Search {
    const HdDispute *dispute;
    HdRenderer *renderers[SIDES];
    HdFrame frames[SIDES]; /* of the last comparison, free where there was none */
    HdScene scene;         /* of the last comparison */
    HdCamera camera;
    Cuts cuts;
} Search;

/* ---- both sides ---- */

static HdStatus open_side(Search *search, int side, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error) {
    HdRenderOptions chosen = *options;
    HdDevice wrong = *device;
    chosen.test.is_for_one_scene = true;
    wrong.not_strict[0] = '\0'; /* as it is known to be */
    return hd_renderer_open(&search->renderers[side], &wrong, &chosen, error);
}

static HdStatus open_sides(Search *search, HdError *error) {
    HdDevice plain;
    int count;
    const HdDispute *dispute = search->dispute;
    const HdRenderOptions options = {.precision = dispute->options->precision};
    HdStatus status = hd_backend_enumerate(hd_backend_always_there(), &plain, 1, &count, error);
    if (status == HD_OK)
        status = open_side(search, DEVICE, dispute->device, dispute->options, error);
    if (status == HD_OK)
        status = open_side(search, PLAIN_C, &plain, &options, error);
    return status;
}

static void forget_frames(Search *search) {
    for (int side = 0; side < SIDES; side++)
        hd_frame_free(&search->frames[side]);
}

static void close_search(Search *search) {
    forget_frames(search);
    hd_scene_free(&search->scene);
    for (int side = 0; side < SIDES; side++)
        hd_renderer_close(search->renderers[side]);
}

/* ---- what is left of the scene ---- */

static bool is_cut(uint64_t cuts, int part) {
    return part < MOST_PARTS && (cuts >> part & 1) != 0;
}

/* A macro, for the parts are of many types; those that stay move up. */
#define CUT_PARTS(parts, count, cuts)                                                              \
    do {                                                                                           \
        int kept = 0;                                                                              \
        for (int part = 0; part < (count); part++)                                                 \
            if (!is_cut(cuts, part))                                                               \
                (parts)[kept++] = (parts)[part];                                                   \
        (count) = kept;                                                                            \
    } while (0)

static void cut_picture(HdScene *scene, const Cuts *cuts) {
    int side = cuts->samples_are_pixels ? scene->samples_per_side : 1;
    bool is_part = scene->crop.whole_width > 0;
    scene->crop =
        (HdCrop){.whole_width = side * (is_part ? scene->crop.whole_width : scene->width),
                 .whole_height = side * (is_part ? scene->crop.whole_height : scene->height),
                 .left = side * scene->crop.left + cuts->left,
                 .top = side * scene->crop.top + cuts->top};
    scene->width = cuts->right - cuts->left;
    scene->height = cuts->bottom - cuts->top;
    if (cuts->samples_are_pixels)
        scene->samples_per_side = 1;
}

static HdStatus build(Search *search, const Cuts *cuts, HdError *error) {
    HdScene *scene = &search->scene;
    hd_scene_free(scene);
    HdStatus status = search->dispute->build(search->dispute->what, scene, &search->camera, error);
    if (status != HD_OK)
        return status;
    for (int i = 0; i < scene->solid_count; i++)
        if (is_cut(cuts->edge_lights, i))
            scene->solids[i].lights = (HdEdgeLights){.colour_count = 1};
    CUT_PARTS(scene->solids, scene->solid_count, cuts->solids);
    CUT_PARTS(scene->lights, scene->light_count, cuts->lights);
    CUT_PARTS(scene->instances, scene->instance_count, cuts->instances);
    if (cuts->floor)
        scene->floor.present = false;
    if (cuts->depth != NOWHERE)
        scene->depth = cuts->depth;
    cut_picture(scene, cuts);
    return HD_OK;
}

/* ---- the comparison ---- */

/* Bit by bit: a NaN is the same as itself. */
static bool is_same_value(float a, float b) {
    uint32_t bits[2];
    memcpy(&bits[0], &a, sizeof a);
    memcpy(&bits[1], &b, sizeof b);
    return bits[0] == bits[1];
}

/* The number of the first value that differs in the last comparison, row by row, or NOWHERE. */
static int first_value(const Search *search) {
    const HdFrame *found = &search->frames[DEVICE], *expected = &search->frames[PLAIN_C];
    for (int i = 0; i < found->width * found->height * found->floats; i++)
        if (!is_same_value(found->rgb[i], expected->rgb[i]))
            return i;
    return NOWHERE;
}

static HdStatus compare(Search *search, const Cuts *cuts, bool *differs, HdError *error) {
    HdStatus status = build(search, cuts, error);
    forget_frames(search);
    for (int side = 0; status == HD_OK && side < SIDES; side++)
        status = hd_put_and_render(search->renderers[side], &search->scene, &search->camera,
                                   search->dispute->like, 0, &search->frames[side], error);
    *differs = status == HD_OK &&
               hd_frame_hash(&search->frames[DEVICE]) != hd_frame_hash(&search->frames[PLAIN_C]);
    return status;
}

/* ---- the search ---- */

/* Keeps these cuts if the frame still differs. */
static HdStatus attempt(Search *search, const Cuts *cuts, bool *differs, HdError *error) {
    HdStatus status = compare(search, cuts, differs, error);
    if (status == HD_OK && *differs)
        search->cuts = *cuts;
    return status;
}

static HdStatus cut_each(Search *search, uint64_t *cuts_of, int count, HdError *error) {
    HdStatus status = HD_OK;
    for (int part = 0; status == HD_OK && part < count && part < MOST_PARTS; part++) {
        bool differs;
        const uint64_t before = *cuts_of; /* lies in search->cuts */
        *cuts_of = before | UINT64_C(1) << part;
        const Cuts tried = search->cuts;
        *cuts_of = before;
        status = attempt(search, &tried, &differs, error);
    }
    return status;
}

static HdStatus cut_scene(Search *search, const HdScene *whole, HdError *error) {
    Cuts *cuts = &search->cuts;
    HdStatus status = cut_each(search, &cuts->solids, whole->solid_count, error);
    if (status == HD_OK)
        status = cut_each(search, &cuts->edge_lights, whole->solid_count, error);
    if (status == HD_OK)
        status = cut_each(search, &cuts->lights, whole->light_count, error);
    if (status == HD_OK)
        status = cut_each(search, &cuts->instances, whole->instance_count, error);
    if (status == HD_OK && whole->floor.present) {
        bool differs;
        Cuts tried = *cuts;
        tried.floor = true;
        status = attempt(search, &tried, &differs, error);
    }
    return status;
}

/* The least depth at which it differs. */
static HdStatus cut_depth(Search *search, int depth, HdError *error) {
    bool differs = false;
    HdStatus status = HD_OK;
    for (int tried_depth = 0; status == HD_OK && !differs && tried_depth <= depth; tried_depth++) {
        Cuts tried = search->cuts;
        tried.depth = tried_depth;
        status = attempt(search, &tried, &differs, error);
    }
    return status;
}

static HdStatus cut_samples(Search *search, const HdScene *whole, HdError *error) {
    bool differs;
    int side = whole->samples_per_side;
    Cuts tried = search->cuts;
    if (side == 1 || hd_scene_is_surveyed(whole))
        return HD_OK;
    tried.samples_are_pixels = true;
    tried.left *= side;
    tried.top *= side;
    tried.right *= side;
    tried.bottom *= side;
    return attempt(search, &tried, &differs, error);
}

/* Halves of the picture, as long as one of them differs. */
static HdStatus cut_pixels(Search *search, HdError *error) {
    bool differs = true;
    HdStatus status = HD_OK;
    while (status == HD_OK && differs) {
        const Cuts now = search->cuts;
        Cuts halves[4] = {now, now, now, now};
        int column = (now.left + now.right) / 2, row = (now.top + now.bottom) / 2;
        halves[0].right = halves[1].left = column;
        halves[2].bottom = halves[3].top = row;
        differs = false;
        for (int i = 0; status == HD_OK && !differs && i < 4; i++)
            if (halves[i].left < halves[i].right && halves[i].top < halves[i].bottom &&
                (halves[i].right - halves[i].left < now.right - now.left ||
                 halves[i].bottom - halves[i].top < now.bottom - now.top))
                status = attempt(search, &halves[i], &differs, error);
    }
    return status;
}

/* ---- in words ---- */

static void tell_value(const Search *search, int value, char *text, size_t capacity) {
    static const char *const channels[] = {"red", "green", "blue", "the bound"};
    snprintf(text, capacity, "%s is %a, expected %a",
             channels[value % search->frames[DEVICE].floats],
             (double)search->frames[DEVICE].rgb[value], (double)search->frames[PLAIN_C].rgb[value]);
}

static void tell_counts(const Search *search, char *text, size_t capacity) {
    const HdFrame *found = &search->frames[DEVICE], *expected = &search->frames[PLAIN_C];
    const struct {
        const char *what;
        uint64_t found, expected;
    } counts[] = {{"mirrored rays", found->mirrored_rays, expected->mirrored_rays},
                  {"transmitted rays", found->transmitted_rays, expected->transmitted_rays},
                  {"tests for shadows", found->shadow_tests, expected->shadow_tests},
                  {"contributions that are cut", found->clamps, expected->clamps}};
    text[0] = '\0';
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (text[0] == '\0' && counts[i].found != counts[i].expected)
            snprintf(text, capacity,
                     "no pixel, but the number of %s is %" PRIu64 ", expected %" PRIu64,
                     counts[i].what, counts[i].found, counts[i].expected);
}

/* Where the first value that differs is, in the frame that was given. */
static void tell_place(const Search *search, const HdScene *whole, int value, char *text,
                       size_t capacity) {
    const HdFrame *frame = &search->frames[DEVICE];
    const Cuts *cuts = &search->cuts;
    int pixel = value / frame->floats;
    int x = cuts->left + pixel % frame->width, y = cuts->top + pixel / frame->width;
    int side = whole->samples_per_side;
    if (cuts->samples_are_pixels)
        snprintf(text, capacity, "pixel %d, %d, sample %d, %d of %d x %d", x / side, y / side,
                 x % side, y % side, side, side);
    else if (side > 1 && !hd_scene_is_surveyed(whole))
        snprintf(text, capacity, "pixel %d, %d, though no sample of its %d x %d differs alone", x,
                 y, side, side);
    else
        snprintf(text, capacity, "pixel %d, %d", x, y);
}

static void tell(const Search *search, const HdScene *whole, char *text, size_t capacity) {
    char place[128], value[128];
    const HdScene *left = &search->scene;
    int number = first_value(search);
    if (number == NOWHERE) {
        tell_counts(search, text, capacity);
        return;
    }
    tell_place(search, whole, number, place, sizeof place);
    tell_value(search, number, value, sizeof value);
    snprintf(text, capacity,
             "%s, depth %d of the ray: %s; it differs with %d of %d solids, %d of %d lights, %d of "
             "%d instances of meshes%s, in a part of %d x %d pixels",
             place, left->depth, value, left->solid_count, whole->solid_count,
             hd_scene_light_count(left), hd_scene_light_count(whole), left->instance_count,
             whole->instance_count,
             whole->floor.present ? left->floor.present ? " and the floor" : " without the floor"
                                  : "",
             left->width, left->height);
}

/* ---- all of it ---- */

static HdStatus simplify(Search *search, const HdScene *whole, char *text, size_t capacity,
                         HdError *error) {
    bool differs;
    HdStatus status = compare(search, &search->cuts, &differs, error);
    if (status != HD_OK || !differs)
        return status;
    status = cut_depth(search, whole->depth, error);
    if (status == HD_OK)
        status = cut_scene(search, whole, error);
    if (status == HD_OK)
        status = cut_samples(search, whole, error);
    if (status == HD_OK)
        status = cut_pixels(search, error);
    /* Once more, for the words: a device whose faults come and go has them from now on. */
    if (status == HD_OK)
        status = compare(search, &search->cuts, &differs, error);
    if (status == HD_OK && differs)
        tell(search, whole, text, capacity);
    else if (status == HD_OK)
        snprintf(text, capacity, "the same frame differs one time and not another");
    return status;
}

HdStatus hd_first_difference(const HdDispute *dispute, char *text, size_t capacity,
                             HdError *error) {
    Search search = {.dispute = dispute, .cuts = {.depth = NOWHERE}};
    HdScene whole;
    text[0] = '\0';
    HdStatus status = dispute->build(dispute->what, &whole, &search.camera, error);
    if (status != HD_OK)
        return status;
    search.cuts.right = whole.width;
    search.cuts.bottom = whole.height;
    status = open_sides(&search, error);
    if (status == HD_OK)
        status = simplify(&search, &whole, text, capacity, error);
    close_search(&search);
    hd_scene_free(&whole);
    return status;
}
