/* SPDX-License-Identifier: MIT */
/* The whole tree of rays of one bundle of samples (Whitted 1980), depth first with an explicit
 * stack. */
#ifndef HD_RAY_TREE_H
#define HD_RAY_TREE_H

#include "lights.h"

/* What a bundle of samples gathered. Sums are fixed point, so that their order does not matter. */
typedef struct {
    vfix r, g, b;
    vint rays, shadow_tests, clamps;
} Sample;

#define CONTRIBUTION_LIMIT R(65536.0)

/* The one conversion to fixed point; truncates. NaN counts as 0. */
FN vfix contribution(vmask m, vreal radiance, vreal weight, real to_fixed, vint *clamps) {
    vreal limit = splat(CONTRIBUTION_LIMIT);
    vmask over = m & lt(limit, radiance);
    *clamps = *clamps - over;
    vreal clamped =
        pick(over, limit, pick(m & lt(splat(R(0.0)), radiance), radiance, splat(R(0.0))));
    return truncate_to_fix(clamped * weight * to_fixed);
}

FN void add_radiance(SCENE_PARAMETERS Sample *sample, vmask m, Vec3 radiance, Vec3 weight) {
    radiance = vec3_scale(radiance, splat(header->exposure));
    sample->r += contribution(m, radiance.x, weight.x, view->to_fixed, &sample->clamps);
    sample->g += contribution(m, radiance.y, weight.y, view->to_fixed, &sample->clamps);
    sample->b += contribution(m, radiance.z, weight.z, view->to_fixed, &sample->clamps);
}

/* A ray that goes on from the points of a surface. */
FN Ray next_ray(const Ray *ray, const Surface *surface, const Hit *hit, Vec3 direction, Vec3 weight,
                vmask inside, vmask alive, real cutoff) {
    Ray next;
    next.weight = vec3_mul(ray->weight, weight);
    if (cutoff > R(0.0)) {
        vreal strongest = greater(next.weight.x, greater(next.weight.y, next.weight.z));
        alive = alive & le(splat(cutoff), strongest);
    }
    next.alive = alive;
    next.origin = surface->point;
    next.direction = direction;
    next.touched = spread_first(hit->object, alive);
    next.inside = inside;
    return next;
}

/* Shades the lanes that hit something and prepares the two rays that may go on. */
FN void shade(SCENE_PARAMETERS const Ray *ray, Reference reference, const Hit *hit, vmask struck,
              Sample *sample, Ray *mirror, Ray *through) {
    Surface surface = surface_at(SCENE_ARGUMENTS ray, reference, hit, struck);
    vreal zero = splat(R(0.0));
    vreal facing = vec3_dot(surface.normal, ray->direction);
    Vec3 mirrored = vec3_scale_add(surface.normal, facing * R(-2.0), ray->direction);
    vmask is_solid = lt_int(hit->object, splat_int(header->solid_count));

    LitPoints points;
    points.active =
        struck & (lt(zero, surface.material.diffuse) | lt(zero, surface.material.specular));
    points.object = spread_first(hit->object, struck);
    points.plane = hit->plane;
    points.inside = is_solid & ~hit->entering;
    Vec3 radiance =
        vec3_scale_add(surface.material.colour, surface.material.ambient, surface.emission);
    if (any_lane(points.active))
        radiance = vec3_add(radiance, direct_light(SCENE_ARGUMENTS & surface, &points, mirrored,
                                                   &sample->shadow_tests));
    add_radiance(SCENE_ARGUMENTS sample, struck, radiance, ray->weight);

    *mirror = next_ray(ray, &surface, hit, mirrored,
                       vec3_scale(surface.material.mirror_tint, surface.material.reflection),
                       points.inside, struck & lt(zero, surface.material.reflection), view->cutoff);
    *through = next_ray(ray, &surface, hit, ray->direction,
                        vec3_scale(surface.material.colour, surface.material.transmission),
                        is_solid & hit->entering, struck & lt(zero, surface.material.transmission),
                        view->cutoff);
}

FN Ray eye_ray(Vec3 direction, vmask alive) {
    Ray ray;
    ray.origin = vec3_zero();
    ray.direction = direction;
    ray.weight = vec3_splat(R(1.0), R(1.0), R(1.0));
    ray.touched = splat_int(0);
    ray.inside = mask_none();
    ray.alive = alive;
    return ray;
}

/* Adds to `sample` what the eye sees in `direction` (unit) in the lanes of `alive`. At most one ray
   for each level waits on the stack. */
FN void trace(SCENE_PARAMETERS Vec3 direction, vmask alive, Sample *sample) {
    Ray stack[DEPTH_BOUND];
    int stack_level[DEPTH_BOUND];
    int waiting = 0, level = 0;
    Ray ray = eye_ray(direction, alive);
    Vec3 background =
        vec3_splat(header->background[0], header->background[1], header->background[2]);
    for (;;) {
        sample->rays = sample->rays - ray.alive;
        Reference reference = reference_of(SCENE_ARGUMENTS ray.touched, level == 0);
        Hit hit = closest_hit(SCENE_ARGUMENTS & ray, reference);
        vmask struck = ray.alive & ~lt_int(hit.object, splat_int(0));
        add_radiance(SCENE_ARGUMENTS sample, ray.alive & ~struck, background, ray.weight);
        if (any_lane(struck)) {
            Ray mirror, through;
            shade(SCENE_ARGUMENTS & ray, reference, &hit, struck, sample, &mirror, &through);
            if (level < view->depth) {
                level++;
                int mirrors = any_lane(mirror.alive), passes = any_lane(through.alive);
                if (mirrors && passes) {
                    stack[waiting] = mirror;
                    stack_level[waiting] = level;
                    waiting++;
                }
                if (mirrors || passes) {
                    ray = passes ? through : mirror;
                    continue;
                }
            }
        }
        if (waiting == 0)
            break;
        waiting--;
        ray = stack[waiting];
        level = stack_level[waiting];
    }
}

#endif
