/* SPDX-License-Identifier: MIT */
#include "run/darkness.h"

#include <math.h>

#include "base/minmax.h"
#include "render/backends.h"
#include "scene/camera.h"
#include "scene/light_bound.h"
#include "verify/trust.h"

/* Pixels of the longer side of the small picture; its maximum depth. */
enum { SMALL_SIDE = 96, SMALL_DEPTH = 8 };

/* Weight of rays below which no pixel changes by a step. */
static const double small_cutoff = 1.0 / 256.0;

/* Steps of 255 below which a value looks black; share of bright pixels below which a picture does.
 */
static const double min_step = 3.0, min_share = 0.01;

/* Exposure above which another reason must make the picture dark. */
static const double max_exposure = 1e5;

/* Small picture of a frame. */
typedef struct Preview {
    const HdScene *scene;
    HdVec3 eye;
    int frame;
    int hits, bright; /* pixels that show an object, and those that are not black */
    double largest;   /* largest value of the former, linear, times exposure */
} Preview;

static bool is_bright(HdCurve curve, double value) {
    return 255.0 * hd_curve_to_display(curve, value) >= min_step;
}

static void count_pixels(Preview *seen, const HdFrame *frame, HdCurve curve) {
    for (ptrdiff_t i = 0; i < (ptrdiff_t)frame->width * frame->height; i++) {
        const float *rgb = frame->rgb + i * frame->floats;
        const double value = hd_largest(hd_vec3((double)rgb[0], (double)rgb[1], (double)rgb[2]));
        if (frame->first[i * frame->first_floats + HD_FIRST_ALPHA] <= 0.0f)
            continue;
        seen->hits++;
        seen->bright += is_bright(curve, value);
        seen->largest = fmax(seen->largest, value);
    }
}

static HdStatus render_preview(Preview *seen, HdCurve curve, HdError *error) {
    const HdRenderOptions options = {.threads = 1, .first_hits = true};
    HdScene small = *seen->scene; /* borrows all that it points to */
    const double factor = (double)SMALL_SIDE / hd_max(small.width, small.height);
    HdRenderer *renderer;
    HdDevice device;
    HdCamera camera;
    HdFrame frame;
    hd_scene_drop_error_bound(&small);
    small.width = hd_max(1, (int)(factor * small.width));
    small.height = hd_max(1, (int)(factor * small.height));
    small.samples_per_side = 1;
    small.sample_rows = 0;
    small.depth = hd_min(small.depth, SMALL_DEPTH);
    small.cutoff = fmax(small.cutoff, small_cutoff);
    HD_TRY(hd_camera_at(&camera, &small, seen->frame, error));
    HD_TRY(hd_find_plain_device(&device, error));
    HD_TRY(hd_renderer_open(&renderer, &device, &options, error));
    const HdStatus status = hd_put_and_render(renderer, &small, &camera, NULL,
                                              HD_LAYER_BIT(HD_LAYER_ALPHA), &frame, error);
    if (status == HD_OK) {
        count_pixels(seen, &frame, curve);
        hd_frame_free(&frame);
    }
    hd_renderer_close(renderer);
    seen->eye = camera.eye;
    return status;
}

/* Ways in which a material shows light. */
enum { COLOURED = 1, SHINY = 2, MIRROR = 4 };

static unsigned ways_of(const HdMaterial *material, HdVec3 emission) {
    const double diffuse = (material->ambient + material->diffuse) * hd_largest(material->colour);
    const double mirrors = material->reflection + material->transmission +
                           material->inner_reflection + material->inner_transmission;
    return (diffuse > 0.0 || hd_largest(emission) > 0.0 ? COLOURED : 0) |
           (material->specular > 0.0 ? SHINY : 0) | (mirrors > 0.0 ? MIRROR : 0);
}

/* Returns the ways of the materials of all objects. */
static unsigned ways_in(const HdScene *scene) {
    const HdVec3 none = {0};
    unsigned ways = scene->floor.present ? ways_of(&scene->floor.material, none) : 0;
    for (int i = 0; i < scene->solid_count; i++) {
        const HdSolid *solid = &scene->solids[i];
        ways |= ways_of(&solid->face, none);
        ways |= solid->rim_width > 0.0 ? ways_of(&solid->rim, none) : 0;
    }
    for (int i = 0; i < scene->instance_count; i++) {
        const HdInstance *instance = &scene->instances[i];
        const HdMesh *mesh = &scene->meshes[instance->mesh];
        ways |= instance->has_material ? ways_of(&instance->material, none) : 0;
        for (int j = 0; j < mesh->material_count && !instance->has_material; j++)
            ways |= ways_of(&mesh->materials[j].material, mesh->materials[j].emission);
    }
    return ways;
}

/* Notes solids whose faces have a colour but show no light. */
static void note_solids(const HdScene *scene, HdProblems *notes) {
    for (int i = 0; i < scene->solid_count; i++) {
        const HdMaterial *face = &scene->solids[i].face;
        if (ways_of(face, (HdVec3){0}) == 0 && hd_largest(face->colour) > 0.0)
            hd_problem(notes,
                       "solids[%d] shows no light: its material lacks ambient, diffuse, specular, "
                       "reflection and transmission",
                       i);
    }
}

static bool is_inside(const HdSolid *solid, HdVec3 point) {
    const HdVec3 from_centre = hd_sub(point, solid->centre);
    bool is_in = hd_length(from_centre) < solid->circumradius;
    const HdPlatonic shape = is_in ? hd_solid_shape(solid) : (HdPlatonic){0};
    for (int i = 0; i < shape.face_count; i++)
        is_in &= hd_dot(shape.face_normal[i], from_centre) < shape.inradius * solid->circumradius;
    return is_in;
}

/* Returns the number of the first opaque solid around the point, or -1. */
static int find_opaque(const HdScene *scene, HdVec3 point) {
    for (int i = 0; i < scene->solid_count; i++)
        if (scene->solids[i].face.transmission == 0.0 && is_inside(&scene->solids[i], point))
            return i;
    return -1;
}

/* Adds a reason: a literal format, and its arguments. */
#define NOTE_REASON(seen, notes, format, ...)                                                      \
    hd_problem(notes, "all that is in view in frame %d is %s: " format, (seen)->frame,             \
               (seen)->largest > 0.0 ? "nearly black" : "black", __VA_ARGS__)

static void note_lights(const Preview *seen, HdProblems *notes) {
    const HdScene *scene = seen->scene;
    const int eye_in = find_opaque(scene, seen->eye);
    bool is_on = false, is_with_eye = false;
    for (int i = 0; i < scene->solid_count; i++)
        is_on |= scene->solids[i].lights.per_edge > 0 && scene->solids[i].lights.intensity > 0.0;
    for (int i = 0; i < scene->light_count; i++) {
        const int in = find_opaque(scene, scene->lights[i].position);
        is_on |= hd_largest(scene->lights[i].intensity) > 0.0;
        is_with_eye |= in == eye_in;
        if (in >= 0 && in != eye_in)
            NOTE_REASON(seen, notes, "lights[%d] is inside solids[%d], which is opaque", i, in);
    }
    if (!is_on)
        NOTE_REASON(seen, notes, "%s",
                    hd_scene_light_count(scene) == 0
                        ? "the scene has no lights"
                        : "none of lights and edge_lights has an intensity and a colour");
    else if (eye_in >= 0 && !is_with_eye)
        NOTE_REASON(seen, notes, "camera.eye is inside solids[%d], which is opaque", eye_in);
}

/* Returns whether more reflections and transmissions would make the picture bright. */
static bool is_too_shallow(const Preview *seen, HdCurve curve) {
    HdScene deep = *seen->scene; /* borrows all that it points to */
    Preview deeper = {.scene = &deep, .frame = seen->frame};
    HdError ignored;
    deep.depth = SMALL_DEPTH;
    return seen->scene->depth < SMALL_DEPTH && render_preview(&deeper, curve, &ignored) == HD_OK &&
           deeper.bright >= min_share * deeper.hits;
}

static void note_reasons(const Preview *seen, HdCurve curve, HdProblems *notes) {
    const unsigned ways = ways_in(seen->scene);
    const double exposure = seen->scene->exposure;
    const int before = notes->count;
    if (seen->bright == 0 && exposure <= max_exposure * seen->largest) {
        NOTE_REASON(seen, notes,
                    "image.exposure is %.3g, and with %.3g the brightest pixel is white", exposure,
                    exposure / seen->largest);
        return;
    }
    if (is_too_shallow(seen, curve)) {
        NOTE_REASON(seen, notes, "image.depth is %d, too small to see through glass or in mirrors",
                    seen->scene->depth);
        return;
    }
    if ((ways & (COLOURED | SHINY)) == 0)
        NOTE_REASON(seen, notes, "%s",
                    "no material shows light: all lack ambient, diffuse and specular, or a colour");
    if ((ways & COLOURED) == 0 && (ways & MIRROR) != 0 &&
        !is_bright(curve, exposure * hd_largest(hd_background_bound(seen->scene))))
        NOTE_REASON(seen, notes, "%s", "mirrors and glass show background, which is black");
    note_lights(seen, notes);
    if (notes->count == before && seen->bright == 0)
        NOTE_REASON(seen, notes, "%s",
                    (ways & COLOURED) != 0
                        ? "no light reaches it: lights are behind it, behind what is opaque or "
                          "the floor, or end before it"
                        : "materials have only specular, and no highlight is in view: give "
                          "them diffuse");
}

void hd_note_darkness(const HdScene *scene, HdCurve curve, int frame, HdProblems *notes) {
    const int objects = scene->solid_count + scene->instance_count + scene->floor.present;
    const int before = notes->count;
    const bool is_dark =
        !is_bright(curve, scene->exposure * hd_largest(hd_background_bound(scene)));
    Preview seen = {.scene = scene, .frame = frame};
    HdError ignored;
    if (scene->crop.whole_width > 0 || render_preview(&seen, curve, &ignored) != HD_OK)
        return;
    if (seen.hits > 0 && seen.bright < min_share * seen.hits)
        note_reasons(&seen, curve, notes);
    /* A film may begin with an empty view, and a picture of the background may be meant. */
    if (seen.hits == 0 && (is_dark || (scene->frame_count == 1 && objects > 0)))
        hd_problem(notes,
                   "nothing is in view in frame %d%s: look at camera.eye, camera.target and "
                   "camera.field_of_view",
                   frame, is_dark ? ", and background is black" : "");
    if (notes->count == before)
        note_solids(scene, notes);
}
