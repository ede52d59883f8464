/* SPDX-License-Identifier: MIT */
#include "certify/first_difference.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "certify/render_scene.h"

enum { DEVICE, PLAIN_C, SIDES };
enum { NOWHERE = -1 };

typedef struct Search {
    const HdDispute *dispute;
    HdRenderer *renderers[SIDES];
    HdFrame frames[SIDES]; /* of the last comparison, free where there was none */
    HdScene scene;         /* of the last comparison */
    HdCamera camera;
    int column, row;               /* of the pixel */
    int sample_column, sample_row; /* within the pixel; NOWHERE: all of its samples */
    int level;                     /* the last one that is traced; NOWHERE: all there are */
} Search;

/* ---- both sides ---- */

static HdStatus open_side(Search *search, int side, const HdDevice *device, HdPipeline pipeline,
                          HdError *error) {
    const HdRenderOptions options = {.precision = search->dispute->precision,
                                     .pipeline = pipeline,
                                     .test.is_for_one_scene = true};
    HdDevice wrong = *device;
    wrong.not_strict[0] = '\0'; /* as it is known to be */
    return hd_renderer_open(&search->renderers[side], &wrong, &options, error);
}

static HdStatus open_sides(Search *search, HdError *error) {
    HdDevice plain;
    int count;
    const HdDispute *dispute = search->dispute;
    HdStatus status = hd_backend_enumerate(hd_backend_always_there(), &plain, 1, &count, error);
    if (status == HD_OK)
        status = open_side(search, DEVICE, dispute->device, dispute->pipeline, error);
    if (status == HD_OK)
        status = open_side(search, PLAIN_C, &plain, HD_PIPELINE_MEGA, error);
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

static HdStatus render_sides(Search *search, HdError *error) {
    HdStatus status = HD_OK;
    forget_frames(search);
    for (int side = 0; status == HD_OK && side < SIDES; side++)
        status = hd_render_scene(search->renderers[side], &search->scene, &search->camera,
                                 search->dispute->precision, search->dispute->like, 0,
                                 &search->frames[side], error);
    return status;
}

/* Bit by bit: a NaN is the same as itself. */
static bool is_same_value(float a, float b) {
    uint32_t bits[2];
    memcpy(&bits[0], &a, sizeof a);
    memcpy(&bits[1], &b, sizeof b);
    return bits[0] == bits[1];
}

static bool is_same_pixel(const Search *search, int pixel) {
    const float *found = search->frames[DEVICE].rgb + 3 * pixel;
    const float *expected = search->frames[PLAIN_C].rgb + 3 * pixel;
    return is_same_value(found[0], expected[0]) && is_same_value(found[1], expected[1]) &&
           is_same_value(found[2], expected[2]);
}

/* The first one of the last comparison, row by row, or NOWHERE. */
static int first_pixel(const Search *search) {
    const HdFrame *frame = &search->frames[DEVICE];
    for (int pixel = 0; pixel < frame->width * frame->height; pixel++)
        if (!is_same_pixel(search, pixel))
            return pixel;
    return NOWHERE;
}

/* ---- a part of the frame ---- */

/* The samples of a pixel as the pixels of a picture with one each, in the same directions bit by
   bit: those of a grid follow from the whole picture's samples side by side. */
static void look_at_samples(Search *search) {
    HdScene *scene = &search->scene;
    int side = scene->samples_per_side;
    bool is_part = scene->crop.whole_width > 0;
    bool is_one = search->sample_column != NOWHERE;
    scene->crop = (HdCrop){
        .whole_width = side * (is_part ? scene->crop.whole_width : scene->width),
        .whole_height = side * (is_part ? scene->crop.whole_height : scene->height),
        .left = side * (scene->crop.left + search->column) + (is_one ? search->sample_column : 0),
        .top = side * (scene->crop.top + search->row) + (is_one ? search->sample_row : 0)};
    scene->width = scene->height = is_one ? 1 : side;
    scene->samples_per_side = 1;
    scene->sampling = HD_SAMPLING_GRID;
    scene->max_error = 0.0;
    if (search->level != NOWHERE)
        scene->depth = search->level;
}

static HdStatus build(Search *search, HdError *error) {
    hd_scene_free(&search->scene);
    return search->dispute->build(search->dispute->what, &search->scene, &search->camera, error);
}

/* ---- a part of the scene ---- */

/* What is left of the surfaces' light, the least first: each adds what the next value is. */
typedef enum Term { TERM_MET, TERM_COLOUR, TERM_DIFFUSE, TERM_FADING, TERM_HIGHLIGHT } Term;

/* A colour that no other one of the first 64 materials has. */
static HdVec3 colour_of(int number) {
    return hd_vec3(0.25 * (1 + number % 4), 0.25 * (1 + number / 4 % 4),
                   0.25 * (1 + number / 16 % 4));
}

static void keep_term(HdMaterial *material, Term term, int number) {
    bool is_flat = term == TERM_MET || term == TERM_COLOUR;
    material->ambient = is_flat;
    if (is_flat || term == TERM_HIGHLIGHT)
        material->diffuse = 0.0;
    if (term != TERM_HIGHLIGHT)
        material->specular = 0.0;
    if (term == TERM_MET) {
        material->colour = colour_of(number);
        material->mirror_tint = hd_vec3(1.0, 1.0, 1.0);
    }
}

static void keep_in_materials(HdScene *scene, Term term) {
    int number = 0;
    for (int i = 0; i < scene->solid_count; i++) {
        keep_term(&scene->solids[i].face, term, number++);
        keep_term(&scene->solids[i].rim, term, number++);
    }
    keep_term(&scene->floor.material, term, number++);
    for (int i = 0; i < scene->instance_count; i++)
        keep_term(&scene->instances[i].material, term, number++);
    for (int i = 0; i < scene->mesh_count; i++)
        for (int k = 0; k < scene->meshes[i].material_count; k++)
            keep_term(&scene->meshes[i].materials[k].material, term, number++);
}

static void drop_textures(HdScene *scene) {
    hd_texture_clear(&scene->floor.texture);
    for (int i = 0; i < scene->mesh_count; i++)
        for (int k = 0; k < scene->meshes[i].material_count; k++) {
            scene->meshes[i].materials[k].emission = hd_vec3(0.0, 0.0, 0.0);
            scene->meshes[i].materials[k].picture = -1;
            scene->meshes[i].materials[k].passes_as = -1;
        }
}

/* Lights are counted from the scene's on, then the solids' edges. */
static int count_lights(const HdScene *scene) {
    return scene->light_count + scene->solid_count;
}

static void keep_light(HdScene *scene, int light, bool fades) {
    for (int i = 0; i < scene->light_count; i++) {
        if (i != light)
            scene->lights[i].intensity = hd_vec3(0.0, 0.0, 0.0);
        if (!fades)
            scene->lights[i].falloff = (HdFalloff){0};
    }
    for (int i = 0; i < scene->solid_count; i++) {
        if (scene->light_count + i != light)
            scene->solids[i].lights.intensity = 0.0;
        if (!fades)
            scene->solids[i].lights.falloff = (HdFalloff){0};
    }
}

/* `light` is one of count_lights, or NOWHERE. */
static void keep_part(HdScene *scene, Term term, int light) {
    keep_in_materials(scene, term);
    keep_light(scene, light, term > TERM_DIFFUSE);
    if (term == TERM_MET)
        drop_textures(scene);
}

/* ---- in words ---- */

static void name_term(const HdScene *scene, Term term, int light, char *text, size_t capacity) {
    static const struct {
        const char *before, *after;
    } words[] = {[TERM_MET] = {"which surface the ray meets, or the weight of the ray", ""},
                 [TERM_COLOUR] = {"the colour of the surface", ""},
                 [TERM_DIFFUSE] = {"the diffuse light of ",
                                   " before it fades (shadow, direction or normal)"},
                 [TERM_FADING] = {"how the light of ", " fades with the distance"},
                 [TERM_HIGHLIGHT] = {"the highlight of ", ""}};
    char name[64] = "";
    if (light >= scene->light_count)
        snprintf(name, sizeof name, "the edges of solids[%d]", light - scene->light_count);
    else if (light >= 0)
        snprintf(name, sizeof name, "lights[%d]", light);
    snprintf(text, capacity, "%s%s%s", words[term].before, name, words[term].after);
}

/* The values of the first channel that differs in a pixel of the last comparison. */
static void tell_values(const Search *search, int pixel, char *text, size_t capacity) {
    static const char *const channels[] = {"red", "green", "blue"};
    const float *found = search->frames[DEVICE].rgb + 3 * pixel;
    const float *expected = search->frames[PLAIN_C].rgb + 3 * pixel;
    int channel = 0;
    while (channel < 2 && is_same_value(found[channel], expected[channel]))
        channel++;
    snprintf(text, capacity, "%s is %a, expected %a", channels[channel], (double)found[channel],
             (double)expected[channel]);
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

/* ---- the search ---- */

static HdStatus compare_samples(Search *search, int *sample, HdError *error) {
    HdStatus status = build(search, error);
    if (status != HD_OK)
        return status;
    look_at_samples(search);
    status = render_sides(search, error);
    *sample = status == HD_OK ? first_pixel(search) : NOWHERE;
    return status;
}

static HdStatus find_level(Search *search, HdError *error) {
    int depth = search->scene.depth, differs = NOWHERE;
    HdStatus status = HD_OK;
    for (int level = 0; status == HD_OK && differs == NOWHERE && level <= depth; level++) {
        search->level = level;
        status = compare_samples(search, &differs, error);
    }
    return status;
}

static HdStatus compare_part(Search *search, Term term, int light, bool *differs, HdError *error) {
    HdStatus status = build(search, error);
    if (status != HD_OK)
        return status;
    look_at_samples(search);
    keep_part(&search->scene, term, light);
    status = render_sides(search, error);
    *differs = status == HD_OK && first_pixel(search) != NOWHERE;
    return status;
}

/* By every term the surfaces and then each light; where the one sample differs is left in `search`.
 */
static HdStatus find_term(Search *search, char *text, size_t capacity, HdError *error) {
    int lights = count_lights(&search->scene);
    bool differs = false;
    HdStatus status = HD_OK;
    for (int term = TERM_MET; term <= TERM_HIGHLIGHT; term++) {
        bool has_lights = term >= TERM_DIFFUSE;
        for (int light = has_lights ? 0 : NOWHERE; light < (has_lights ? lights : 0); light++) {
            status = compare_part(search, (Term)term, light, &differs, error);
            if (status != HD_OK)
                return status;
            if (differs) {
                name_term(&search->scene, (Term)term, light, text, capacity);
                return HD_OK;
            }
        }
    }
    int unused;
    snprintf(text, capacity, "the sum of its light");
    return compare_samples(search, &unused, error);
}

static HdStatus tell_sample(Search *search, int sample, char *text, size_t capacity,
                            HdError *error) {
    int side = search->scene.width;
    search->sample_column = sample % side;
    search->sample_row = sample / side;
    char term[160] = "", values[128];
    HdStatus status = find_level(search, error);
    if (status == HD_OK)
        status = find_term(search, term, sizeof term, error);
    if (status != HD_OK)
        return status;
    tell_values(search, 0, values, sizeof values);
    snprintf(text, capacity, ", sample %d, %d of %d x %d, level %d of the tree of rays: %s; %s",
             search->sample_column, search->sample_row, side, side, search->level, term, values);
    return HD_OK;
}

static HdStatus tell_pixel(Search *search, int pixel, char *text, size_t capacity, HdError *error) {
    int width = search->frames[DEVICE].width, sample;
    char values[128];
    search->column = pixel % width;
    search->row = pixel / width;
    tell_values(search, pixel, values, sizeof values);
    size_t length = (size_t)snprintf(text, capacity, "pixel %d, %d", search->column, search->row);
    HdStatus status = compare_samples(search, &sample, error);
    if (status != HD_OK || length >= capacity)
        return status;
    if (sample != NOWHERE)
        return tell_sample(search, sample, text + length, capacity - length, error);
    snprintf(text + length, capacity - length, ", though none of its samples differs alone; %s",
             values);
    return HD_OK;
}

static HdStatus search_frame(Search *search, char *text, size_t capacity, HdError *error) {
    HdStatus status = open_sides(search, error);
    if (status == HD_OK)
        status = build(search, error);
    if (status == HD_OK)
        status = render_sides(search, error);
    if (status != HD_OK)
        return status;
    int pixel = first_pixel(search);
    if (pixel != NOWHERE)
        return tell_pixel(search, pixel, text, capacity, error);
    tell_counts(search, text, capacity);
    return HD_OK;
}

HdStatus hd_first_difference(const HdDispute *dispute, char *text, size_t capacity,
                             HdError *error) {
    Search search = {
        .dispute = dispute, .sample_column = NOWHERE, .sample_row = NOWHERE, .level = NOWHERE};
    text[0] = '\0';
    HdStatus status = search_frame(&search, text, capacity, error);
    close_search(&search);
    return status;
}
