/* SPDX-License-Identifier: MIT */
/* The whole tree of rays of one packet of samples (Whitted 1980), depth first with an explicit
 * stack. */
#ifndef HD_RAY_TREE_H
#define HD_RAY_TREE_H

#include "environment.h"
#include "lights.h"

/* Returns the isolated solid that all rays run in; otherwise -1. */
FN int only_within(SCENE_PARAMETERS const Ray *ray, const LocalOrigin *local_origin) {
    if (local_origin->is_eye || !local_origin->same || any_lane(ray->alive & ~ray->inside))
        return -1;
    int object = lane_int(&ray->last_hit, 0);
    return object < header->floor_end && objects[object].isolated ? object : -1;
}

/* Returns the closest hit. On the floor, `entering` means from the side of its normal. On a mesh,
   `face` is the triangle until surface_at replaces it. */
FN Hit closest_hit(SCENE_PARAMETERS const Ray *ray, LocalOrigin local_origin) {
    Hit hit;
    hit.t = splat(REAL_LARGE);
    hit.object = splat_int(-1);
    hit.face = splat_int(0);
    hit.entering = mask_none();
    int first = 0, end = header->floor_end;
    int within = only_within(SCENE_ARGUMENTS ray, &local_origin);
    if (within >= 0) {
        first = within;
        end = within + 1;
    }
    for (int object = first; object < end && object < header->solid_count; object++)
        hit_solid(SCENE_ARGUMENTS ray, local_origin, object, &hit);
    for (int object = header->solid_count; object < end; object++)
        hit_floor(SCENE_ARGUMENTS ray, local_origin, object, &hit);
    if (MESHES(header) && within < 0)
        closest_mesh_hit(SCENE_ARGUMENTS ray, &local_origin, &hit);
    return hit;
}

/* The results of a packet of samples. Sums are fixed point, so that their order does not matter. */
typedef struct {
    vfix r, g, b;
    vint mirrored, transmitted; /* rays */
    vint shadow_tests, clamps;
    vfix bound; /* in scenes with an error bound: that bound, times view->bound_to_fixed */
} Sample;

/* Converts a contribution to fixed point, truncated; the only such conversion. NaN counts as 0. */
FN vfix contribution(vmask m, vreal radiance, vreal weight, real to_fixed, vint *clamps) {
    vreal limit = splat((real)HD_CONTRIBUTION_LIMIT);
    vmask over = m & lt(limit, radiance);
    *clamps = count_lanes(*clamps, over);
    vreal clamped =
        vselect(over, limit, vselect(m & lt(splat(R(0.0)), radiance), radiance, splat(R(0.0))));
    return truncate_to_fix(clamped * weight * to_fixed);
}

FN void add_radiance(SCENE_PARAMETERS Sample *sample, vmask m, Vec3 radiance, Vec3 weight) {
    radiance = vec3_scale(radiance, splat(header->exposure));
    sample->r += contribution(m, radiance.x, weight.x, view->to_fixed, &sample->clamps);
    sample->g += contribution(m, radiance.y, weight.y, view->to_fixed, &sample->clamps);
    sample->b += contribution(m, radiance.z, weight.z, view->to_fixed, &sample->clamps);
}

FN vreal max_component(Vec3 a) {
    return vmax(a.x, vmax(a.y, a.z));
}

/* Adds to the error bound in the lanes of `m`, rounded up. No ray adds more than HD_RADIANCE_LIMIT.
 */
FN void add_to_bound(SCENE_PARAMETERS Sample *sample, vmask m, vreal bound) {
    vreal ceiling = multiply_add(vmin(bound, splat((real)HD_RADIANCE_LIMIT)),
                                 splat(view->bound_to_fixed), splat(R(1.0)));
    sample->bound += truncate_to_fix(vselect(m, ceiling, splat(R(0.0))));
}

/* Returns the maximum that `radiance` can add to a channel of the picture. */
FN vreal bound_of(SCENE_PARAMETERS Vec3 weight, Vec3 radiance) {
    return max_component(vec3_mul(weight, radiance)) * splat(header->exposure);
}

/* Returns the bound of radiance that secondary rays see, by the object and side that they leave. */
FN Vec3 max_seen(SCENE_PARAMETERS const Ray *ray, vmask left) {
    Vec3 most = vec3_zero();
    while (any_lane(left)) {
        int last_hit = lane_int(&ray->last_hit, first_lane(left));
        vmask m = left & eq_int(ray->last_hit, splat_int(last_hit));
        int number = last_hit < header->floor_end ? last_hit : header->floor_end;
        GLOBAL const Object *object = objects + number;
        GLOBAL const real *out = object->seen_outside, *in = object->seen_inside;
        Vec3 seen = vec3_select(ray->inside, vec3_splat(in[0], in[1], in[2]),
                                vec3_splat(out[0], out[1], out[2]));
        most = vec3_select(m, seen, most);
        left = lanes_after(left, m);
    }
    return most;
}

/* Ends the rays whose weight is too small or that exceed the scene's ray depth. */
FN void end_rays(SCENE_PARAMETERS int level, Ray *next, Sample *sample) {
    vmask weak = mask_none();
    if (view->cutoff > R(0.0))
        weak = ~le(splat(view->cutoff), max_component(next->weight));
    if (level == view->depth)
        weak = mask_all();
    /* Without a cut-off by bounds, only rays that end anyway need a bound. */
    if (BOUNDED(header)) {
        vmask asked = next->alive & (view->bound_cutoff > R(0.0) ? mask_all() : weak);
        vreal bound = bound_of(SCENE_ARGUMENTS next->weight, max_seen(SCENE_ARGUMENTS next, asked));
        weak = weak | lt(bound, splat(view->bound_cutoff));
        add_to_bound(SCENE_ARGUMENTS sample, next->alive & weak, bound);
    }
    next->alive = next->alive & ~weak;
}

/* Returns the lanes of `lit` whose lights matter; adds the others' to the error bound. */
FN vmask end_lights(SCENE_PARAMETERS vmask lit, Vec3 weight, const LaneMaterial *material,
                    Sample *sample) {
    Vec3 arriving =
        vec3_splat(header->light_bound[0], header->light_bound[1], header->light_bound[2]);
    vreal behind = vselect(material->lit_from_behind, material->transmission, splat(R(0.0)));
    vreal diffuse = multiply_add(behind, material->diffuse, material->diffuse);
    Vec3 most = vec3_scale_add(material->colour, diffuse,
                               vec3_scale(vec3_splat(R(1.0), R(1.0), R(1.0)), material->specular));
    vreal bound = bound_of(SCENE_ARGUMENTS weight, vec3_mul(most, arriving));
    vmask dim = lit & lt(bound, splat(view->bound_cutoff));
    add_to_bound(SCENE_ARGUMENTS sample, dim, bound);
    return lit & ~dim;
}

/* Returns a secondary ray from the points of a surface. */
FN Ray next_ray(const Ray *ray, const Surface *surface, const Hit *hit, Vec3 direction, Vec3 weight,
                vmask inside, vmask alive) {
    Ray next;
    next.weight = vec3_mul(ray->weight, weight);
    next.alive = alive;
    next.origin = surface->point;
    next.direction = direction;
    next.last_hit = spread_first(hit->object, alive);
    next.face = hit->face;
    next.inside = inside;
    return next;
}

/* Returns the direction of a transmitted ray by Snell's law (Glassner 1989, An Introduction to Ray
   Tracing, chapter 2, section 5.2). `facing` is the cosine between `normal` and the ray. If both
   sides have one index the direction keeps its bits. Lanes of `total` reflect totally instead. */
FN Vec3 refract(Vec3 direction, Vec3 normal, vreal facing, vreal relative_index, vmask *total) {
    vreal one = splat(R(1.0)), zero = splat(R(0.0));
    vmask bends = lt(relative_index, one) | lt(one, relative_index);
    vreal sine_squared = multiply_add(-facing, facing, one) * relative_index * relative_index;
    vreal cosine_squared = one - sine_squared;
    *total = bends & lt(cosine_squared, zero);
    vreal cosine = square_root(vmax(cosine_squared, zero));
    vreal along_normal = multiply_add(-relative_index, facing, -cosine);
    Vec3 bent = vec3_scale_add(normal, along_normal, vec3_scale(direction, relative_index));
    return vec3_select(bends & ~*total, vec3_normalize(bent), direction);
}

/* Flips a lit surface, for light from behind, whose rays begin on the triangle itself. */
FN void flip_surface(Surface *surface, LitPoints *points) {
    LaneMaterial *material = &surface->material;
    surface->normal = vec3_scale(surface->normal, splat(R(-1.0)));
    surface->lift = vec3_zero();
    material->diffuse = material->diffuse * material->transmission;
    material->specular = splat(R(0.0));
    points->active =
        points->active & material->lit_from_behind & lt(splat(R(0.0)), material->diffuse);
    points->inside = ~points->inside;
}

/* Returns the radiance of the lanes that hit something; prepares their two secondary rays. */
FN Vec3 shade(SCENE_PARAMETERS const Ray *ray, LocalOrigin local_origin, Hit *hit, vmask struck,
              Sample *sample, Ray *mirror, Ray *through) {
    Surface surface = surface_at(SCENE_ARGUMENTS ray, local_origin, hit, struck);
    vreal zero = splat(R(0.0));
    vreal facing = vec3_dot(surface.normal, ray->direction);
    Vec3 mirrored = vec3_scale_add(surface.normal, facing * R(-2.0), ray->direction);
    LitPoints points;
    points.active =
        struck & (lt(zero, surface.material.diffuse) | lt(zero, surface.material.specular));
    points.object = spread_first(hit->object, struck);
    points.face = hit->face;
    points.inside = ~hit->entering;
    if (BOUNDED(header) && view->bound_cutoff > R(0.0))
        points.active =
            end_lights(SCENE_ARGUMENTS points.active, ray->weight, &surface.material, sample);
    Vec3 radiance =
        vec3_scale_add(surface.material.colour, surface.material.ambient, surface.emission);
    Surface lit = surface;
    for (int side = 0; side <= LIT_FROM_BEHIND(header); side++) {
        if (side > 0)
            flip_surface(&lit, &points);
        if (any_lane(points.active))
            radiance = vec3_add(radiance, direct_light(SCENE_ARGUMENTS & lit, &points, mirrored,
                                                       &sample->shadow_tests));
    }

    vreal reflection = surface.material.reflection, transmission = surface.material.transmission;
    Vec3 passing = ray->direction;
    vmask total = mask_none();
    if (REFRACTS(header)) {
        passing = refract(ray->direction, surface.normal, facing, surface.material.relative_index,
                          &total);
        reflection = vselect(total, reflection + transmission, reflection);
    }
    *mirror =
        next_ray(ray, &surface, hit, mirrored, vec3_scale(surface.material.mirror_tint, reflection),
                 ~hit->entering, struck & lt(zero, reflection));
    *through =
        next_ray(ray, &surface, hit, passing, vec3_scale(surface.material.colour, transmission),
                 hit->entering, struck & ~total & lt(zero, transmission));
    return radiance;
}

FN Ray eye_ray(Vec3 direction, vmask alive) {
    Ray ray;
    ray.origin = vec3_zero();
    ray.direction = direction;
    ray.weight = vec3_splat(R(1.0), R(1.0), R(1.0));
    ray.last_hit = splat_int(0);
    ray.face = splat_int(-1);
    ray.inside = mask_none();
    ray.alive = alive;
    return ray;
}

/* Adds the radiance and the counts of rays to `sample`; fills the secondary rays `mirror` and
   `through`, with no live lane if the ray tree ends. */
FN void trace_and_shade(SCENE_PARAMETERS const Ray *ray, int level, Sample *sample, Ray *mirror,
                        Ray *through) {
    Vec3 radiance = vec3_splat(header->background[0], header->background[1], header->background[2]);
    LocalOrigin local_origin = local_origin_of(SCENE_ARGUMENTS ray->last_hit, level == 0);
    Hit hit = closest_hit(SCENE_ARGUMENTS ray, local_origin);
    vmask struck = ray->alive & ~lt_int(hit.object, splat_int(0));
    mirror->alive = through->alive = mask_none();
    if (ENVIRONMENT(header) && must_visit(ray->alive & ~struck))
        radiance = vec3_add(radiance, environment_at(SCENE_ARGUMENTS ray->direction));
    if (!must_visit(struck)) {
        add_radiance(SCENE_ARGUMENTS sample, ray->alive, radiance, ray->weight);
        return;
    }
    Vec3 shaded = shade(SCENE_ARGUMENTS ray, local_origin, &hit, struck, sample, mirror, through);
    radiance = vec3_select(struck, shaded, radiance);
    add_radiance(SCENE_ARGUMENTS sample, ray->alive, radiance, ray->weight);
    end_rays(SCENE_ARGUMENTS level, mirror, sample);
    end_rays(SCENE_ARGUMENTS level, through, sample);
    sample->mirrored = count_lanes(sample->mirrored, mirror->alive);
    sample->transmitted = count_lanes(sample->transmitted, through->alive);
}

/* Adds to `sample` the ray trees of eye rays in `direction` (unit) in the lanes of `alive`. At most
   one ray for each depth waits on the stack. The inner loop descends until no ray continues. Of the
   threads of a warp, those with the deepest waiting rays go on: the others join them later. */
FN void trace(SCENE_PARAMETERS Vec3 direction, vmask alive, Sample *sample) {
    Ray stack[DEPTH_BOUND(view)];
    int stack_level[DEPTH_BOUND(view)];
    int waiting = 0, level = 0, descends = 1, in_tree;
    Ray ray = eye_ray(direction, alive);
    do {
        while (descends) {
            Ray mirror, through;
            trace_and_shade(SCENE_ARGUMENTS & ray, level, sample, &mirror, &through);
            int mirrors = any_lane(mirror.alive), passes = any_lane(through.alive);
            level++;
            if (mirrors && passes) {
                stack[waiting] = mirror;
                stack_level[waiting] = level;
                waiting++;
            }
            ray = passes ? through : mirror;
            descends = mirrors || passes;
        }
        in_tree = waiting > 0;
        if (in_tree)
            descends =
                !ALIGNS_DEPTHS || is_highest_of_warp(stack_level[waiting - 1], DEPTH_BOUND(view));
        if (descends) {
            waiting--;
            ray = stack[waiting];
            level = stack_level[waiting];
        }
    } while (in_tree);
}

#endif
