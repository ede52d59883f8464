/* SPDX-License-Identifier: MIT */
#include "scene/light_bound.h"

#include <math.h>
#include <string.h>

#include "scene/contact.h"

/* Covers all roundings, also those of highlights' powers and of weights at great ray depths. */
#define MARGIN 1.02

static HdVec3 times(HdVec3 a, HdVec3 b) {
    return (HdVec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static HdVec3 solid_light(const HdSolid *solid) {
    HdVec3 sum = {0.0, 0.0, 0.0};
    const HdEdgeLights *lights = &solid->lights;
    int count = lights->intensity > 0.0 ? hd_edge_light_count(solid) : 0;
    for (int i = 0; i < count; i++)
        sum = hd_add(sum, lights->colours[i / lights->per_edge % lights->colour_count]);
    return hd_scale(sum, lights->intensity);
}

HdVec3 hd_background_bound(const HdScene *scene) {
    const HdEnvironment *around = &scene->environment;
    const double most = around->texture.width > 0 ? around->top * around->intensity : 0.0;
    return hd_add(scene->background, hd_vec3(most, most, most));
}

HdVec3 hd_light_bound(const HdScene *scene) {
    HdVec3 sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < scene->light_count; i++)
        sum = hd_add(sum, scene->lights[i].intensity);
    for (int s = 0; s < scene->solid_count; s++)
        sum = hd_add(sum, solid_light(&scene->solids[s]));
    return hd_scale(sum, MARGIN);
}

/* Visits a material of the scene and its surface's emission. */
typedef void Visit(void *context, const HdMaterial *material, HdVec3 emission);

static void visit_mesh(const HdScene *scene, const HdInstance *instance, Visit *visit,
                       void *context) {
    const HdMesh *mesh = &scene->meshes[instance->mesh];
    for (int m = 0; m < mesh->material_count; m++) {
        const HdMaterial material = hd_instance_material(scene, instance, m);
        visit(context, &material, mesh->materials[m].emission);
    }
}

static void visit_materials(const HdScene *scene, Visit *visit, void *context) {
    const HdVec3 dark = {0.0, 0.0, 0.0};
    for (int s = 0; s < scene->solid_count; s++) {
        visit(context, &scene->solids[s].face, dark);
        if (scene->solids[s].rim_width > 0.0)
            visit(context, &scene->solids[s].rim, dark);
    }
    if (scene->floor.present)
        visit(context, &scene->floor.material, dark);
    for (int i = 0; i < scene->instance_count; i++)
        visit_mesh(scene, &scene->instances[i], visit, context);
}

/* Returns what one side sends on of what its two rays see. Total reflection mirrors what would have
   passed. */
static HdVec3 sent_on(const HdMaterial *material, double reflection, double transmission,
                      HdVec3 mirrored, HdVec3 passing) {
    HdVec3 mirror = times(material->mirror_tint, mirrored);
    HdVec3 sum = hd_add(hd_scale(mirror, reflection),
                        hd_scale(times(material->colour, passing), transmission));
    if (material->index_of_refraction != 1.0)
        sum = hd_maximum(sum, hd_scale(mirror, reflection + transmission));
    return sum;
}

static HdVec3 sent_outside(const HdMaterial *material, HdVec3 mirrored, HdVec3 passing) {
    return sent_on(material, material->reflection, material->transmission, mirrored, passing);
}

static HdVec3 sent_inside(const HdMaterial *material, HdVec3 mirrored, HdVec3 passing) {
    if (!material->has_inner_side)
        return sent_outside(material, mirrored, passing);
    return sent_on(material, material->inner_reflection, material->inner_transmission, mirrored,
                   passing);
}

/* Returns the greater of both sides. */
static HdVec3 sent_by_either(const HdMaterial *material, HdVec3 seen) {
    return hd_maximum(sent_outside(material, seen, seen), sent_inside(material, seen, seen));
}

/* Returns the most that a surface shows by itself under `light`. */
static HdVec3 own_radiance(const HdMaterial *material, HdVec3 emission, HdVec3 light) {
    double sides = material->lit_from_behind
                       ? 1.0 + fmax(material->transmission, material->inner_transmission)
                       : 1.0;
    HdVec3 scattered = hd_add(hd_scale(material->colour, material->diffuse * sides),
                              (HdVec3){material->specular, material->specular, material->specular});
    return hd_add(hd_add(times(scattered, light), emission),
                  hd_scale(material->colour, material->ambient));
}

typedef struct Bounding {
    HdVec3 light;   /* sum of all lights */
    HdVec3 own;     /* most that a surface shows by itself */
    HdVec3 endless; /* most that a surface shows that sees its like without end */
} Bounding;

static double endless(double own, double share) {
    if (own <= 0.0)
        return 0.0;
    return share < 1.0 ? own / (1.0 - share) : HUGE_VAL;
}

static void bound_material(void *context, const HdMaterial *material, HdVec3 emission) {
    Bounding *bounding = context;
    const HdVec3 one = {1.0, 1.0, 1.0};
    HdVec3 own = own_radiance(material, emission, bounding->light);
    HdVec3 share = sent_by_either(material, one);
    HdVec3 shown = {endless(own.x, share.x), endless(own.y, share.y), endless(own.z, share.z)};
    bounding->own = hd_maximum(bounding->own, own);
    bounding->endless = hd_maximum(bounding->endless, shown);
}

static HdVec3 disc_bound(const HdSolid *solid) {
    HdVec3 most = {0.0, 0.0, 0.0};
    for (int i = 0; i < (solid->lights.per_edge > 0 ? solid->lights.colour_count : 0); i++)
        most = hd_maximum(most, solid->lights.colours[i]);
    return hd_scale(most, solid->lights.disc_radiance);
}

/* `last` is the most that the end of a ray's path shows. */
static double bound_of_channel(double last, double own, double without_end) {
    double all_levels = last + own * (HD_MAX_DEPTH + 1.0);
    double endless_too = fmax(last, without_end);
    return endless_too < all_levels ? endless_too : all_levels;
}

static Bounding bound_surfaces(const HdScene *scene) {
    Bounding bounding = {.light = hd_light_bound(scene)};
    visit_materials(scene, bound_material, &bounding);
    return bounding;
}

HdVec3 hd_surface_bound(const HdScene *scene) {
    return hd_scale(bound_surfaces(scene).own, MARGIN);
}

HdVec3 hd_radiance_bound(const HdScene *scene) {
    Bounding bounding = bound_surfaces(scene);
    HdVec3 last = hd_background_bound(scene);
    for (int s = 0; s < scene->solid_count; s++)
        last = hd_maximum(last, disc_bound(&scene->solids[s]));
    return hd_scale((HdVec3){bound_of_channel(last.x, bounding.own.x, bounding.endless.x),
                             bound_of_channel(last.y, bounding.own.y, bounding.endless.y),
                             bound_of_channel(last.z, bounding.own.z, bounding.endless.z)},
                    MARGIN);
}

/* ---- bounds by object ---- */

/* Objects: the solids, the floor, all meshes together. */
enum { MAX_OBJECTS = HD_MAX_SOLIDS + 2, MAX_ROUNDS = 256 };

/* Solids farther from each other than this part of their sizes have no point in common, despite
   rounding. */
#define NEAR 1e-3

/* A round that changes less is the last one. */
#define SETTLED 0.999

/* Bounds of what the two sides of an object's surface show. */
typedef struct Shown {
    HdVec3 outer, inner;
} Shown;

typedef struct Views {
    const HdScene *scene;
    HdVec3 light;
    bool near[HD_MAX_SOLIDS][MAX_OBJECTS]; /* may have points in common */
    Shown shown[MAX_OBJECTS];
    HdSeen *seen;
} Views;

static void find_neighbours(Views *views) {
    const HdScene *scene = views->scene;
    const int count = scene->solid_count;
    for (int a = 0; a < count; a++) {
        const HdSolid *solid = &scene->solids[a];
        for (int b = 0; b < a; b++) {
            double least = -NEAR * (solid->circumradius + scene->solids[b].circumradius);
            bool near = hd_solid_depth(solid, &scene->solids[b], least) > least;
            views->near[a][b] = views->near[b][a] = near;
        }
        double least = -NEAR * solid->circumradius;
        views->near[a][count] =
            scene->floor.present && hd_floor_depth(solid, &scene->floor, least) > least;
        views->near[a][count + 1] = scene->instance_count > 0;
    }
}

static void show_material(Views *views, const HdMaterial *material, HdVec3 emission, int object) {
    const HdSeen *seen = &views->seen[object];
    Shown *shown = &views->shown[object];
    HdVec3 own = own_radiance(material, emission, views->light);
    HdVec3 outer = sent_outside(material, seen->outside, seen->inside);
    HdVec3 inner = sent_inside(material, seen->inside, seen->outside);
    shown->outer = hd_maximum(shown->outer, hd_add(own, outer));
    shown->inner = hd_maximum(shown->inner, hd_add(own, inner));
}

static void show_mesh_material(void *context, const HdMaterial *material, HdVec3 emission) {
    Views *views = context;
    show_material(views, material, emission, views->scene->solid_count + 1);
}

static void show_surfaces(Views *views) {
    const HdScene *scene = views->scene;
    const HdVec3 dark = {0.0, 0.0, 0.0};
    memset(views->shown, 0, sizeof views->shown);
    for (int s = 0; s < scene->solid_count; s++) {
        HdVec3 disc = disc_bound(&scene->solids[s]);
        views->shown[s] = (Shown){disc, disc};
        show_material(views, &scene->solids[s].face, dark, s);
        if (scene->solids[s].rim_width > 0.0)
            show_material(views, &scene->solids[s].rim, dark, s);
    }
    if (scene->floor.present)
        show_material(views, &scene->floor.material, dark, scene->solid_count);
    for (int i = 0; i < scene->instance_count; i++)
        visit_mesh(scene, &scene->instances[i], show_mesh_material, views);
}

static HdVec3 either_side(const Shown *shown) {
    return hd_maximum(shown->outer, shown->inner);
}

/* Returns the bound inside a solid: of its inner side and of objects that reach into it. */
static HdVec3 seen_inside(const Views *views, int solid) {
    HdVec3 most = views->shown[solid].inner;
    for (int i = 0; i < views->scene->solid_count + 2; i++)
        if (i != solid && views->near[solid][i])
            most = hd_maximum(most, either_side(&views->shown[i]));
    return most;
}

/* Returns the bound outside `object`, which is not met again. Solids add their inner side only if
   they may have points in common with it. */
static HdVec3 seen_outside(const Views *views, int object) {
    const int solids = views->scene->solid_count;
    HdVec3 most = hd_background_bound(views->scene);
    for (int i = 0; i < solids; i++) {
        bool is_near = object < solids ? views->near[object][i] : views->near[i][object];
        if (i != object)
            most =
                hd_maximum(most, is_near ? either_side(&views->shown[i]) : views->shown[i].outer);
    }
    if (object != solids)
        most = hd_maximum(most, views->shown[solids].outer);
    return hd_maximum(most, either_side(&views->shown[solids + 1]));
}

static bool tighten(HdVec3 *seen, HdVec3 most) {
    HdVec3 before = *seen;
    *seen = hd_minimum(before, most);
    return seen->x < SETTLED * before.x || seen->y < SETTLED * before.y ||
           seen->z < SETTLED * before.z;
}

/* Runs one round; returns false if hardly any bound shrank. */
static bool update_bounds(Views *views) {
    const int solids = views->scene->solid_count;
    bool changed = false;
    show_surfaces(views);
    for (int i = 0; i < solids + 2; i++) {
        HdVec3 around = seen_outside(views, i);
        HdVec3 within = i < solids ? seen_inside(views, i) : around;
        bool less_outside = tighten(&views->seen[i].outside, around);
        bool less_inside = tighten(&views->seen[i].inside, within);
        changed = changed || less_outside || less_inside;
    }
    return changed;
}

void hd_seen_bounds(const HdScene *scene, HdSeen *seen) {
    Views views = {.scene = scene, .light = hd_light_bound(scene), .seen = seen};
    const HdVec3 most = hd_radiance_bound(scene);
    find_neighbours(&views);
    for (int i = 0; i < scene->solid_count + 2; i++)
        seen[i] = (HdSeen){most, most};
    for (int round = 0; round < MAX_ROUNDS && update_bounds(&views); round++)
        ;
    for (int i = 0; i < scene->solid_count + 2; i++) {
        seen[i].outside = hd_minimum(most, hd_scale(seen[i].outside, MARGIN));
        seen[i].inside = hd_minimum(most, hd_scale(seen[i].inside, MARGIN));
    }
}

/* Total reflection mirrors what would have passed. */
static double strongest_of(const HdMaterial *material, double reflection, double transmission) {
    return material->index_of_refraction != 1.0 ? reflection + transmission
                                                : fmax(reflection, transmission);
}

static void find_strongest(void *context, const HdMaterial *material, HdVec3 emission) {
    double *strongest = context;
    (void)emission;
    *strongest =
        fmax(*strongest, strongest_of(material, material->reflection, material->transmission));
    if (material->has_inner_side)
        *strongest = fmax(*strongest, strongest_of(material, material->inner_reflection,
                                                   material->inner_transmission));
}

int hd_depth_for_bound(const HdScene *scene, double bound) {
    HdVec3 most = hd_radiance_bound(scene);
    double left = fmax(most.x, fmax(most.y, most.z)) * scene->exposure, strongest = 0.0;
    int depth = 0;
    visit_materials(scene, find_strongest, &strongest);
    while (depth < HD_MAX_DEPTH && left > bound) {
        left *= strongest;
        depth++;
    }
    return depth;
}
