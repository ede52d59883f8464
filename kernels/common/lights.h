/* SPDX-License-Identifier: MIT */
/* Direct light by Phong's model, and the coloured transmittance on its way. */
#ifndef HD_LIGHTS_H
#define HD_LIGHTS_H

#include "surface.h"

/* The lit points of a bundle. */
typedef struct {
    vint object;  /* what the points lie on */
    vint plane;   /* and the plane of the face */
    vmask inside; /* light reaches the point from inside that solid */
    vmask active;
} LitPoints;

/* Distances of the points to every plane of the scene, computed once for all lights. A point seen
   from inside its own solid is inside, whatever rounding says. */
FN void measure_planes(SCENE_PARAMETERS const Surface *surface, const LitPoints *points,
                       vreal *distances) {
    Reference reference = reference_of(SCENE_ARGUMENTS points->object, 0);
    for (int object = 0; object < header->object_count; object++) {
        Vec3 point = move_to_object(SCENE_ARGUMENTS reference, surface->point, object);
        vmask own_inside = points->inside & eq_int(points->object, splat_int(object));
        int first = objects[object].first_plane;
        for (int k = first; k < first + objects[object].plane_count; k++) {
            vreal point_distance = plane_distance(planes + k, point);
            distances[k] = pick(own_inside, lesser(point_distance, splat(R(0.0))), point_distance);
        }
    }
}

/* Lanes whose segment to the light crosses the floor. */
FN vmask floor_blocks(SCENE_PARAMETERS int object, GLOBAL const real *light_row,
                      const vreal *distances, const LitPoints *points) {
    int first = objects[object].first_plane;
    vreal zero = splat(R(0.0));
    real light_distance = light_row[first];
    if (light_distance == R(0.0))
        return mask_none();
    vreal point_distance = distances[first];
    vmask blocked = light_distance < R(0.0) ? lt(zero, point_distance) : lt(point_distance, zero);
    blocked = blocked & ~eq_int(points->object, splat_int(object));
    if (!any_lane(blocked))
        return blocked;
    vreal t = point_distance / (point_distance - splat(light_distance));
    for (int side = first + 1; side < first + 1 + HD_FLOOR_SIDES; side++) {
        vreal distance = multiply_add(t, splat(light_row[side]) - distances[side], distances[side]);
        blocked = blocked & le(distance, zero);
    }
    return blocked;
}

/* Multiplies `transmittance` by what one face lets through: its colour times `transmission`, or
   nothing at the rim. */
FN void cross_face(SCENE_PARAMETERS GLOBAL const Object *solid, GLOBAL const real *light_row,
                   const vreal *distances, vmask crossing, vreal t, real transmission,
                   Vec3 *transmittance) {
    if (!any_lane(crossing))
        return;
    GLOBAL const Material *face = materials + solid->face_material;
    vreal passes = splat(transmission);
    if (solid->rim_depth > R(0.0)) {
        /* The second greatest distance exceeds a number when two of them do. */
        vreal depth = splat(-solid->rim_depth);
        vint near = splat_int(0);
        for (int k = solid->first_plane; k < solid->first_plane + solid->plane_count; k++) {
            vreal distance = multiply_add(t, splat(light_row[k]) - distances[k], distances[k]);
            near = near - lt(depth, distance);
        }
        passes = pick(lt_int(splat_int(1), near), splat(R(0.0)), passes);
    }
    Vec3 filtered = vec3_scale(*transmittance, passes);
    filtered = vec3_mul(filtered, vec3_splat(face->colour[0], face->colour[1], face->colour[2]));
    *transmittance = vec3_pick(crossing, filtered, *transmittance);
}

/* Lets the segments from the points to the light pass one solid. A segment misses it when neither
   end is inside of one plane, which settles most of them before anything is divided. */
FN void cross_solid(SCENE_PARAMETERS int object, GLOBAL const LightSides *sides,
                    GLOBAL const real *light_row, const vreal *distances, const LitPoints *points,
                    vmask lit, Vec3 *transmittance) {
    GLOBAL const Object *solid = objects + object;
    int first = solid->first_plane;
    vmask own = eq_int(points->object, splat_int(object));
    vmask own_inside = own & points->inside;
    vmask crossing = lit & (~own | own_inside);
    vreal zero = splat(R(0.0));
    vmask inside = mask_all();
    for (uint left = sides->outside | sides->on_plane; left; left &= left - 1)
        inside = inside & lt(distances[first + lowest_bit(left)], zero);
    crossing = crossing & (inside | own_inside);
    if (!any_lane(crossing))
        return;

    vreal entry = zero, exit = splat(R(1.0));
    vmask entered = mask_none();
    uint all_planes = ((uint)1 << solid->plane_count) - 1;
    for (uint left = all_planes & ~(sides->outside | sides->on_plane); left; left &= left - 1) {
        int k = first + lowest_bit(left);
        vmask enters = crossing & lt(zero, distances[k]);
        if (!any_lane(enters))
            continue;
        vreal t = distances[k] / (distances[k] - splat(light_row[k]));
        entry = pick(enters, greater(entry, t), entry);
        entered = entered | enters;
    }
    for (uint left = sides->outside; left; left &= left - 1) {
        int k = first + lowest_bit(left);
        exit = lesser(exit, distances[k] / (distances[k] - splat(light_row[k])));
    }
    crossing = crossing & (own_inside | lt(entry, exit));
    /* Sides are named as for a ray that looks from the point to the light. */
    GLOBAL const Material *face = materials + solid->face_material;
    cross_face(SCENE_ARGUMENTS solid, light_row, distances, crossing & entered, entry,
               face->transmission, transmittance);
    if (sides->outside)
        cross_face(SCENE_ARGUMENTS solid, light_row, distances, crossing, exit,
                   face->inner_transmission, transmittance);
}

/* x to the power n, n >= 1, by squaring; `common` is n where all lanes share it, else 0. */
FN vreal power(vreal x, vint n, int common) {
    vreal result = splat(R(1.0));
    if (common) {
        for (int bits = common; bits; bits >>= 1) {
            if (bits & 1)
                result = result * x;
            x = x * x;
        }
        return result;
    }
    for (vint bits = n; any_lane(~eq_int(bits, splat_int(0))); bits = bits >> 1) {
        result = pick(eq_int(bits & 1, splat_int(1)), result * x, result);
        x = x * x;
    }
    return result;
}

/* Phong's model for one light: the share of the arriving light that leaves towards the viewer, for
   each channel. `cosine` is N.L times the light's distance, `squared` that distance squared;
   without `shines` no lane has a highlight. */
FN Vec3 phong(const LaneMaterial *material, int shines, vint shininess, int common_shininess,
              vreal cosine, vreal mirror_cosine, vreal squared) {
    vreal inverse = splat(R(1.0)) / square_root(squared);
    vreal diffuse = material->diffuse * (cosine * inverse);
    vreal specular = splat(R(0.0));
    if (shines)
        specular = material->specular * power(greater(mirror_cosine * inverse, splat(R(0.0))),
                                              shininess, common_shininess);
    return vec3_scale_add(material->colour, diffuse, vec3(specular, specular, specular));
}

/* The light's intensity at a squared distance. */
FN Vec3 intensity_at(GLOBAL const Light *light, vreal squared) {
    Vec3 intensity = vec3_splat(light->intensity[0], light->intensity[1], light->intensity[2]);
    vreal one = splat(R(1.0)), scale = splat(light->inverse_falloff_squared);
    if (light->falloff_ends) {
        vreal rest = greater(multiply_add(-squared, scale, one), splat(R(0.0)));
        intensity = vec3_scale(intensity, rest * rest);
    } else if (light->inverse_falloff_squared > R(0.0)) {
        intensity = vec3_scale(intensity, one / multiply_add(squared, scale, one));
    }
    return intensity;
}

/* Lanes at a squared distance at which nothing is left of the light. */
FN vmask beyond_falloff(GLOBAL const Light *light, vreal squared) {
    if (!light->falloff_ends)
        return mask_none();
    return le(splat(R(1.0)), squared * splat(light->inverse_falloff_squared));
}

/* What the segments to one light let through in the lanes of `lit`. */
FN Vec3 transmittance_to(SCENE_PARAMETERS int light, const vreal *distances,
                         const LitPoints *points, vmask lit) {
    GLOBAL const real *light_row = light_distances + light * header->plane_count;
    GLOBAL const LightSides *sides = light_sides + light * header->object_count;
    for (int object = header->solid_count; object < header->object_count; object++)
        lit = lit & ~floor_blocks(SCENE_ARGUMENTS object, light_row, distances, points);
    vreal open = pick(lit, splat(R(1.0)), splat(R(0.0)));
    Vec3 transmittance = vec3(open, open, open);
    for (int object = 0; object < header->solid_count; object++)
        cross_solid(SCENE_ARGUMENTS object, sides + object, light_row, distances, points, lit,
                    &transmittance);
    return transmittance;
}

/* A face that holds the light gets nothing from it: N.L is 0, whatever rounding says. */
FN vmask holds_light(GLOBAL const Light *light, const LitPoints *points) {
    return eq_int(points->plane, splat_int(light->own_plane[0])) |
           eq_int(points->plane, splat_int(light->own_plane[1]));
}

/* Radiance that the points send to the viewer by diffuse and specular reflection of all lights.
   Lights are the outer loop and lanes the points, so that everything about a light is the same for
   a bundle. `mirrored` is the viewing ray's mirror direction, unit. */
FN Vec3 direct_light(SCENE_PARAMETERS const Surface *surface, const LitPoints *points,
                     Vec3 mirrored, vint *shadow_tests) {
    Vec3 sum = vec3_zero();
    vreal distances[PLANE_BOUND];
    measure_planes(SCENE_ARGUMENTS surface, points, distances);
    vreal zero = splat(R(0.0));
    int same_object = all_same(points->object);
    vint shininess = spread_first(surface->material.shininess, points->active);
    int common_shininess = all_same(shininess) ? lane_int(&shininess, 0) : 0;
    int shines = any_lane(points->active & lt(zero, surface->material.specular));
    for (int i = 0; i < header->light_count; i++) {
        Vec3 position =
            fetch_vector(light_offsets, points->object * header->light_count + i, same_object);
        Vec3 to_light = vec3_sub(position, surface->point);
        vreal cosine = vec3_dot(surface->normal, to_light);
        vreal squared = vec3_dot(to_light, to_light);
        vmask lit = points->active & ~holds_light(lights + i, points) & lt(zero, cosine) &
                    lt(zero, squared) & ~beyond_falloff(lights + i, squared);
        if (!any_lane(lit))
            continue;
        *shadow_tests = *shadow_tests - lit;
        Vec3 transmittance = transmittance_to(SCENE_ARGUMENTS i, distances, points, lit);
        Vec3 arriving = vec3_mul(transmittance, intensity_at(lights + i, squared));
        Vec3 reflected = phong(&surface->material, shines, shininess, common_shininess, cosine,
                               vec3_dot(mirrored, to_light), squared);
        sum = vec3_pick(lit, vec3_add(sum, vec3_mul(arriving, reflected)), sum);
    }
    return sum;
}

#endif
