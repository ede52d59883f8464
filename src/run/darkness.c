/* SPDX-License-Identifier: MIT */
#include "run/darkness.h"

#include <math.h>

#include "base/minmax.h"
#include "render/backends.h"
#include "scene/camera.h"
#include "verify/trust.h"

/* Pixels of the longer side of the small picture, and its depth, at most. */
enum { SMALL_SIDE = 96, SMALL_DEPTH = 8 };

/* Rays of less weight change no pixel of it by a step. */
static const double small_cutoff = 1.0 / 256.0;

/* Values below so many steps of 255 are black to the eye, and a picture is black if a smaller share
   of what it shows is brighter. */
static const double min_step = 3.0, min_share = 0.01;

/* A higher one is no cure: the picture is dark for another reason. */
static const double max_exposure = 1e5;

/* What the small picture shows. */
typedef struct Glimpse {
    const HdScene *scene;
    HdVec3 eye;
    int frame;
    int hits, bright; /* pixels that show an object, and those of them that are not black */
    double largest;   /* value of these, linear and times exposure */
} Glimpse;

static bool is_bright(HdCurve curve, double value) {
    return 255.0 * hd_curve_to_display(curve, value) >= min_step;
}

static void count_pixels(Glimpse *seen, const HdFrame *frame, HdCurve curve) {
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

static HdStatus look(Glimpse *seen, HdCurve curve, HdError *error) {
    const HdRenderOptions options = {.threads = 1, .first_hits = true};
    HdScene small = *seen->scene; /* what it owns stays with the other */
    const double factor = (double)SMALL_SIDE / hd_max(small.width, small.height);
    HdRenderer *renderer;
    HdDevice device;
    HdCamera camera;
    HdFrame frame;
    int count;
    hd_scene_drop_error_bound(&small);
    small.width = hd_max(1, (int)(factor * small.width));
    small.height = hd_max(1, (int)(factor * small.height));
    small.samples_per_side = 1;
    small.depth = hd_min(small.depth, SMALL_DEPTH);
    small.cutoff = fmax(small.cutoff, small_cutoff);
    HD_TRY(hd_camera_at(&camera, &small, seen->frame, error));
    HD_TRY(hd_backend_enumerate(hd_backend_always_there(), &device, 1, &count, error));
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

static bool shows_light(const HdMaterial *material) {
    return material->specular > 0.0 ||
           (material->ambient + material->diffuse > 0.0 && hd_largest(material->colour) > 0.0);
}

static bool mesh_shows_light(const HdMesh *mesh) {
    for (int i = 0; i < mesh->material_count; i++)
        if (shows_light(&mesh->materials[i].material) ||
            hd_largest(mesh->materials[i].emission) > 0.0)
            return true;
    return false;
}

static bool any_shows_light(const HdScene *scene) {
    bool shows = scene->floor.present && shows_light(&scene->floor.material);
    for (int i = 0; i < scene->solid_count; i++) {
        const HdSolid *solid = &scene->solids[i];
        shows |= shows_light(&solid->face) || (solid->rim_width > 0.0 && shows_light(&solid->rim));
    }
    for (int i = 0; i < scene->instance_count; i++) {
        const HdInstance *instance = &scene->instances[i];
        shows |= instance->has_material ? shows_light(&instance->material)
                                        : mesh_shows_light(&scene->meshes[instance->mesh]);
    }
    return shows;
}

static bool is_inside(const HdSolid *solid, HdVec3 point) {
    const HdVec3 from_centre = hd_sub(point, solid->centre);
    bool is_in = hd_length(from_centre) < solid->circumradius;
    const HdPlatonic shape = is_in ? hd_solid_shape(solid) : (HdPlatonic){0};
    for (int i = 0; i < shape.face_count; i++)
        is_in &= hd_dot(shape.face_normal[i], from_centre) < shape.inradius * solid->circumradius;
    return is_in;
}

/* The number of the first solid around the point that lets no light through; -1: there is none. */
static int find_opaque(const HdScene *scene, HdVec3 point) {
    for (int i = 0; i < scene->solid_count; i++)
        if (scene->solids[i].face.transmission == 0.0 && is_inside(&scene->solids[i], point))
            return i;
    return -1;
}

/* Adds a reason: a literal format, and its arguments. */
#define because(seen, notes, format, ...)                                                          \
    hd_problem(notes, "all that is in view in frame %d is %s: " format, (seen)->frame,             \
               (seen)->largest > 0.0 ? "nearly black" : "black", __VA_ARGS__)

static void note_lights(const Glimpse *seen, HdProblems *notes) {
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
            because(seen, notes, "lights[%d] is inside solids[%d], which is opaque", i, in);
    }
    if (!is_on)
        because(seen, notes, "%s", "none of lights and edge_lights has an intensity and a colour");
    else if (eye_in >= 0 && !is_with_eye)
        because(seen, notes, "camera.eye is inside solids[%d], which is opaque", eye_in);
}

static void note_reasons(const Glimpse *seen, HdProblems *notes) {
    const double exposure = seen->scene->exposure;
    const int before = notes->count;
    if (seen->bright == 0 && exposure <= max_exposure * seen->largest) {
        because(seen, notes, "image.exposure is %.3g, and with %.3g the brightest pixel is white",
                exposure, exposure / seen->largest);
        return;
    }
    if (!any_shows_light(seen->scene))
        because(seen, notes, "%s",
                "no material shows light: all lack ambient, diffuse and specular, or a colour");
    note_lights(seen, notes);
    if (notes->count == before && seen->bright == 0)
        because(seen, notes, "%s",
                "no light reaches it: lights are behind it, behind what is opaque or the floor, or "
                "end before it");
}

void hd_note_darkness(const HdScene *scene, HdCurve curve, int frame, HdProblems *notes) {
    const int objects = scene->solid_count + scene->instance_count + scene->floor.present;
    const bool is_dark = !is_bright(curve, scene->exposure * hd_largest(scene->background));
    Glimpse seen = {.scene = scene, .frame = frame};
    HdError ignored;
    if (scene->crop.whole_width > 0 || look(&seen, curve, &ignored) != HD_OK)
        return;
    if (seen.hits > 0 && seen.bright < min_share * seen.hits)
        note_reasons(&seen, notes);
    /* A film may begin with an empty view, and a picture of the background may be meant. */
    if (seen.hits == 0 && (is_dark || (scene->frame_count == 1 && objects > 0)))
        hd_problem(notes,
                   "nothing is in view in frame %d%s: look at camera.eye, camera.target and "
                   "camera.field_of_view",
                   frame, is_dark ? ", and background is black" : "");
}
