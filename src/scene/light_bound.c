/* SPDX-License-Identifier: MIT */
#include "scene/light_bound.h"

#include <math.h>

/* More than all roundings, those of highlights' powers and of weights over many levels included. */
#define MARGIN 1.02

static double greater(double a, double b) {
    return a > b ? a : b;
}

static HdVec3 greater3(HdVec3 a, HdVec3 b) {
    return (HdVec3){greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)};
}

static HdVec3 times(HdVec3 a, HdVec3 b) {
    return (HdVec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static HdVec3 colour_of_edge_lights(const HdEdgeLights *lights, int edge_light) {
    return lights->colours[edge_light / lights->per_edge % lights->colour_count];
}

static HdVec3 solid_light(const HdSolid *solid) {
    HdVec3 sum = {0.0, 0.0, 0.0};
    int count = solid->lights.intensity > 0.0 ? hd_edge_light_count(solid) : 0;
    for (int i = 0; i < count; i++)
        sum = hd_add(sum, colour_of_edge_lights(&solid->lights, i));
    return hd_scale(sum, solid->lights.intensity);
}

HdVec3 hd_light_bound(const HdScene *scene) {
    HdVec3 sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < scene->light_count; i++)
        sum = hd_add(sum, scene->lights[i].intensity);
    for (int s = 0; s < scene->solid_count; s++)
        sum = hd_add(sum, solid_light(&scene->solids[s]));
    return hd_scale(sum, MARGIN);
}

/* Called for each material of the scene, with what its surface emits. */
typedef void Visit(void *context, const HdMaterial *material, HdVec3 emission);

static void visit_mesh(const HdScene *scene, const HdInstance *instance, Visit *visit,
                       void *context) {
    const HdMesh *mesh = &scene->meshes[instance->mesh];
    for (int m = 0; m < mesh->material_count; m++) {
        const HdMeshMaterial *own = &mesh->materials[m];
        visit(context, instance->has_material ? &instance->material : &own->material,
              own->emission);
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

/* The share of light that goes on from one side; total reflection mirrors what would have passed.
 */
static HdVec3 share_of_side(const HdMaterial *material, double reflection, double transmission) {
    HdVec3 share = hd_add(hd_scale(material->mirror_tint, reflection),
                          hd_scale(material->colour, transmission));
    if (material->index_of_refraction != 1.0)
        share = greater3(share, hd_scale(material->mirror_tint, reflection + transmission));
    return share;
}

/* Of the side where it is greater. */
static HdVec3 share_sent_on(const HdMaterial *material) {
    HdVec3 outside = share_of_side(material, material->reflection, material->transmission);
    if (!material->has_inner_side)
        return outside;
    return greater3(
        outside, share_of_side(material, material->inner_reflection, material->inner_transmission));
}

typedef struct Bounding {
    HdVec3 light;   /* the sum of all */
    HdVec3 own;     /* the most that a surface shows by itself */
    HdVec3 endless; /* the most that one shows which sees its like without end */
} Bounding;

static double endless(double own, double share) {
    if (own <= 0.0)
        return 0.0;
    return share < 1.0 ? own / (1.0 - share) : HUGE_VAL;
}

static void bound_material(void *context, const HdMaterial *material, HdVec3 emission) {
    Bounding *bounding = context;
    double sides = material->lit_from_behind
                       ? 1.0 + greater(material->transmission, material->inner_transmission)
                       : 1.0;
    HdVec3 scattered = hd_add(hd_scale(material->colour, material->diffuse * sides),
                              (HdVec3){material->specular, material->specular, material->specular});
    HdVec3 own = hd_add(hd_add(times(scattered, bounding->light), emission),
                        hd_scale(material->colour, material->ambient));
    HdVec3 share = share_sent_on(material);
    HdVec3 shown = {endless(own.x, share.x), endless(own.y, share.y), endless(own.z, share.z)};
    bounding->own = greater3(bounding->own, own);
    bounding->endless = greater3(bounding->endless, shown);
}

static HdVec3 disc_bound(const HdSolid *solid) {
    HdVec3 most = {0.0, 0.0, 0.0};
    for (int i = 0; i < (solid->lights.per_edge > 0 ? solid->lights.colour_count : 0); i++)
        most = greater3(most, solid->lights.colours[i]);
    return hd_scale(most, solid->lights.disc_radiance);
}

/* `last`: what ends a ray's way shows. */
static double bound_of_channel(double last, double own, double without_end) {
    double all_levels = last + own * (HD_MAX_DEPTH + 1.0);
    double endless_too = greater(last, without_end);
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
    HdVec3 last = scene->background;
    for (int s = 0; s < scene->solid_count; s++)
        last = greater3(last, disc_bound(&scene->solids[s]));
    return hd_scale((HdVec3){bound_of_channel(last.x, bounding.own.x, bounding.endless.x),
                             bound_of_channel(last.y, bounding.own.y, bounding.endless.y),
                             bound_of_channel(last.z, bounding.own.z, bounding.endless.z)},
                    MARGIN);
}

static void find_strongest(void *context, const HdMaterial *material, HdVec3 emission) {
    double *strongest = context;
    (void)emission;
    double outside = greater(material->reflection, material->transmission);
    if (material->index_of_refraction != 1.0) /* total reflection */
        outside = material->reflection + material->transmission;
    *strongest = greater(*strongest, outside);
    if (!material->has_inner_side)
        return;
    double inside = greater(material->inner_reflection, material->inner_transmission);
    if (material->index_of_refraction != 1.0)
        inside = material->inner_reflection + material->inner_transmission;
    *strongest = greater(*strongest, inside);
}

int hd_depth_for_bound(const HdScene *scene, double bound) {
    HdVec3 most = hd_radiance_bound(scene);
    double left = greater(most.x, greater(most.y, most.z)) * scene->exposure, strongest = 0.0;
    int depth = 0;
    visit_materials(scene, find_strongest, &strongest);
    while (depth < HD_MAX_DEPTH && left > bound) {
        left *= strongest;
        depth++;
    }
    return depth;
}
