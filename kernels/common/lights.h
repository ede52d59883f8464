/* SPDX-License-Identifier: MIT */
/* Direct light by Phong's model, with shadows that coloured glass filters. */
#ifndef HD_LIGHTS_H
#define HD_LIGHTS_H

#include "surface.h"

/* ---- clusters of lights ----

   Tests of a packet of points against many lights near each other: whether none of these can reach
   any of the points and, for packets of several lanes, whether a solid cannot occlude. All are
   conservative (docs/numerics.md, Light culling): they skip lights and solids only if each pair by
   itself gives the same result. */

/* The lit points of a packet. */
typedef struct {
    vint object;  /* object that the points lie on */
    vint face;    /* and its face */
    vmask inside; /* whether light reaches the point from inside that solid */
    vmask active;
} LitPoints;

/* The mask of a light or cluster has a bit for each of the first objects, set if it cannot occlude,
   and this one, set if the cluster is culled. */
#define CLUSTER_IS_CULLED ((int)1 << HD_MASKED_OBJECTS)

FN int cannot_occlude(int nonoccluders, int object) {
    return object < HD_MASKED_OBJECTS && nonoccluders >> object & 1;
}

FN int floor_may_block(GLOBAL const Header *header, int nonoccluders) {
    return header->solid_count < header->floor_end &&
           !cannot_occlude(nonoccluders, header->solid_count);
}

#if HD_LANES == 1

/* Returns an upper bound of a vector's length. */
FN vreal sum_of_sides(Vec3 v) {
    return absolute(v.x) + absolute(v.y) + absolute(v.z);
}

/* Returns whether all lights of the run that begins with `light` are out of reach of a point on an
   object, or behind it. */
FN int run_is_culled(SCENE_PARAMETERS Vec3 point, Vec3 normal, int object, int light) {
    GLOBAL const LightRun *run = light_runs + object * header->light_count + light;
    Vec3 way = vec3_sub(vec3_of(run->place), point);
    vreal radius = splat(run->radius);
    vreal slack = (sum_of_sides(way) + radius + sum_of_sides(point)) * R(1e-4);
    vreal size = radius + slack, most = splat(run->reach) + size;
    return any_lane(lt(most * most, vec3_dot(way, way)) |
                    lt(vec3_dot(normal, way) + size, splat(R(0.0))));
}

#else

/* A sphere about the active points; their first normal and the maximum deviation from it. */
typedef struct {
    Vec3 middle, normal;
    vreal radius, spread;
} PointSphere;

FN Vec3 lane_of(const Vec3 *v, int lane) {
    return vec3_splat(lane_real(&v->x, lane), lane_real(&v->y, lane), lane_real(&v->z, lane));
}

FN vreal length_of(Vec3 v) {
    return square_root(vec3_dot(v, v));
}

FN vreal max_distance(const Vec3 *points, Vec3 from, vmask m) {
    Vec3 way = vec3_sub(*points, from);
    return square_root(splat(max_lane(vec3_dot(way, way), m)));
}

FN PointSphere sphere_about(const Vec3 *points, const Vec3 *normals, vmask active) {
    PointSphere sphere;
    int lane = first_lane(active);
    sphere.middle = lane_of(points, lane);
    sphere.normal = lane_of(normals, lane);
    sphere.radius = max_distance(points, sphere.middle, active);
    sphere.spread = max_distance(normals, sphere.normal, active);
    return sphere;
}

/* One cluster in each lane. */
typedef struct {
    Vec3 place; /* relative to an object */
    vreal radius, reach;
} Clusters;

FN Clusters load_clusters(GLOBAL const real *light_clusters, int object, int first, int count) {
    GLOBAL const real *row = light_clusters + object * HD_CLUSTER_ROWS * count + first;
    Clusters clusters;
    clusters.place =
        vec3(load_reals(row + HD_CLUSTER_X * count), load_reals(row + HD_CLUSTER_Y * count),
             load_reals(row + HD_CLUSTER_Z * count));
    clusters.radius = load_reals(row + HD_CLUSTER_RADIUS * count);
    clusters.reach = load_reals(row + HD_CLUSTER_REACH * count);
    return clusters;
}

/* Returns clusters that are out of reach, or behind the points. */
FN vmask culled_clusters(const PointSphere *sphere, const Clusters *clusters) {
    Vec3 way = vec3_sub(clusters->place, sphere->middle);
    vreal distance = length_of(way), size = clusters->radius + sphere->radius;
    vreal slack = (distance + size + length_of(sphere->middle)) * R(1e-4);
    vreal height = vec3_dot(sphere->normal, way);
    vreal max_height = multiply_add(sphere->spread, distance + size, height + size);
    return lt(clusters->reach + size + slack, distance) | lt(max_height + slack, splat(R(0.0)));
}

/* Returns the clusters that a plane separates, with all segments to the points, from a sphere about
   the solid. The plane is perpendicular to the line from the solid's centre, the local origin, to
   the middle segment. */
FN vmask unoccluded_clusters(vreal solid_radius, const PointSphere *sphere, Vec3 middle,
                             const Clusters *clusters) {
    Vec3 way = vec3_sub(clusters->place, middle);
    vreal squared = vmax(vec3_dot(way, way), splat(R(1e-30)));
    vreal along = vmin(-vec3_dot(middle, way) * reciprocal(squared), splat(R(1.0)));
    Vec3 across = vec3_scale_add(way, vmax(along, splat(R(0.0))), middle);
    vreal length = length_of(across),
          min_length = splat(R(1e-15)); /* a shorter one may be rounding alone */
    vreal least = solid_radius + (length_of(middle) + sphere->radius) * R(1e-4);
    return lt(min_length, length) &
           lt(length * (least + sphere->radius), vec3_dot(across, middle)) &
           lt(length * (least + clusters->radius), vec3_dot(across, clusters->place));
}

/* Fills `known`, a mask for each cluster, for points that lie on one object. `may_cross` holds the
   points from which segments may cross a solid. */
FN_NOINLINE void cull_clusters(SCENE_PARAMETERS const Vec3 *points, const Vec3 *normals,
                               const LitPoints *lit_points, const vmask *may_cross, int *known) {
    const int count = HD_LIGHT_CLUSTERS(header->light_count);
    vint numbers = object_of(SCENE_ARGUMENTS lit_points->object);
    int object = lane_int(&numbers, 0);
    int solids = header->solid_count < HD_MASKED_OBJECTS ? header->solid_count : HD_MASKED_OBJECTS;
    PointSphere sphere = sphere_about(points, normals, lit_points->active);
    for (int first = 0; first < count; first += HD_LANES) {
        Clusters clusters = load_clusters(light_clusters, object, first, count);
        vmask dark = culled_clusters(&sphere, &clusters);
        vint found = vselect_int(dark, splat_int(CLUSTER_IS_CULLED), splat_int(0));
        for (int s = 0; s < solids && any_lane(~dark); s++) {
            vmask nonoccluders = mask_all();
            if (any_lane(may_cross[s])) {
                if (s == object)
                    continue; /* the points are inside it */
                GLOBAL const Vector *offset = object_offsets + object * header->object_count + s;
                clusters = load_clusters(light_clusters, s, first, count);
                nonoccluders = unoccluded_clusters(
                    splat(objects[s].radius_about), &sphere,
                    vec3_add(sphere.middle, vec3_splat(offset->x, offset->y, offset->z)),
                    &clusters);
            }
            found = found | vselect_int(nonoccluders, splat_int((int)1 << s), splat_int(0));
        }
        for (int lane = 0; lane < HD_LANES; lane++)
            known[first + lane] = lane_int(&found, lane);
    }
}
#endif

/* ---- one light after the other ---- */

/* Classifies the points against the planes of the scene, once for all lights:
     coordinates[plane]    n.X of a solid's plane, the distance to a floor's
     outside_planes[solid] a bit for each face that the point is not strictly inside of
     some_outside[solid]   the bits of all lanes
     may_cross[solid]      the points from which a segment may cross it
   A point seen from inside its own solid counts as inside, without bits, despite rounding. */
FN void classify_against_planes(SCENE_PARAMETERS const Surface *surface, const LitPoints *points,
                                int nonoccluders, vreal *coordinates, vint *outside_planes,
                                uint *some_outside, vmask *may_cross) {
    LocalOrigin local_origin = local_origin_of(SCENE_ARGUMENTS points->object, 0);
    vreal zero = splat(R(0.0));
    vint first_side = splat_int(1), second_side = splat_int(2);
    for (int object = 0; object < header->solid_count; object++) {
        GLOBAL const Object *solid = objects + object;
        vmask own = eq_int(points->object, splat_int(object));
        vmask own_inside = own & points->inside;
        vint not_inside = splat_int(0);
        uint some = 0;
        outside_planes[object] = not_inside;
        some_outside[object] = some;
        may_cross[object] = mask_none();
        if (cannot_occlude(nonoccluders, object))
            continue;
        may_cross[object] = points->active & (~own | own_inside);
        if (!any_lane(may_cross[object]))
            continue; /* no segment crosses the solid that it leaves */
        Vec3 point = move_to_object(SCENE_ARGUMENTS local_origin, surface->point, object);
        int has_inside = any_lane(own_inside);
        for (int i = solid->plane_count - 1; i >= 0; i--) {
            GLOBAL const Plane *plane = planes + solid->first_plane + i;
            vreal width = splat(plane->distance), coordinate = along_normal(plane, point);
            if (has_inside) {
                vreal least = solid->paired ? -width : splat(-REAL_LARGE);
                coordinate = vselect(own_inside, vmin(vmax(coordinate, least), width), coordinate);
            }
            coordinates[solid->first_plane + i] = coordinate;
            vmask outside = le(zero, nearness(solid, plane, coordinate)) & ~own_inside;
            vint side = vselect_int(lt(coordinate, zero), second_side, first_side);
            not_inside = not_inside * 4 | vselect_int(outside, side, splat_int(0));
            some = some * 2 | (any_lane(outside) ? 1u : 0u);
        }
        outside_planes[object] = not_inside;
        some_outside[object] = some;
    }
    for (int object = header->solid_count; object < header->floor_end; object++) {
        if (cannot_occlude(nonoccluders, object))
            continue;
        Vec3 point = move_to_object(SCENE_ARGUMENTS local_origin, surface->point, object);
        int first = objects[object].first_plane;
        for (int k = first; k < first + objects[object].plane_count; k++)
            coordinates[k] = plane_distance(planes + k, point);
    }
}

/* Returns the lanes whose segment to the light crosses the floor. */
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
    vreal t =
        absolute(point_distance) * reciprocal(absolute(point_distance - splat(light_distance)));
    for (int side = first + 1; side < first + 1 + HD_FLOOR_SIDES; side++) {
        vreal distance = multiply_add(t, splat(light_row[side]) - distances[side], distances[side]);
        blocked = blocked & le(distance, zero);
    }
    return blocked;
}

/* Multiplies `light` by one face's transmittance at the crossing: its colour times `transmission`,
   or 0 on the rim. */
FN void cross_face(SCENE_PARAMETERS GLOBAL const Object *solid, GLOBAL const real *light_row,
                   const vreal *coordinates, vmask crossing, Crossing where, real transmission,
                   Vec3 *light) {
    GLOBAL const Material *face = materials + solid->face_material;
    vreal passes = splat(transmission);
    int has_rim = solid->rim_depth > R(0.0) && transmission > R(0.0);
    if (must_enter(has_rim)) {
        /* A rim is near two planes, the face's own among them. */
        int end = solid->first_plane + (has_rim ? solid->plane_count : 0);
        vreal t = has_rim ? crossing_time(where) : splat(R(0.0));
        vint near_planes = splat_int(0);
        UNROLL_TWICE
        for (int k = solid->first_plane; k < end; k++) {
            vreal from = coordinates[k];
            vreal coordinate = multiply_add(t, splat(light_row[k]) - from, from);
            vreal height = solid->paired ? absolute(coordinate) : coordinate;
            vreal least = splat(planes[k].distance - solid->rim_depth);
            near_planes = count_lanes(near_planes, lt(least, height));
        }
        passes = vselect(lt_int(splat_int(1), near_planes), splat(R(0.0)), passes);
    }
    Vec3 filtered = vec3_scale(*light, passes);
    filtered = vec3_mul(filtered, vec3_of(face->colour));
    *light = vec3_select(crossing, filtered, *light);
}

/* Returns where the segments enter a solid; only planes that a point is outside of matter. */
FN Crossing segment_entry(SCENE_PARAMETERS GLOBAL const Object *solid, uint some_outside,
                          GLOBAL const real *light_row, const vreal *coordinates) {
    Crossing entry = crossing(R(0.0), R(1.0), 0); /* at the point */
    for (uint left = some_outside; left; left &= left - 1) {
        int k = solid->first_plane + lowest_bit(left);
        Crossing next;
        next.distance = nearness(solid, planes + k, coordinates[k]);
        next.slope = splat(light_row[k]) - coordinates[k];
        next.plane = splat_int(k);
        entry = select_crossing(is_before(entry, next), next, entry);
    }
    return entry;
}

/* Returns where the segments leave a solid; only planes that the light is outside of matter. Points
   whose segments cross are inside of these planes, so no slope is negative. */
FN Crossing segment_exit(SCENE_PARAMETERS GLOBAL const Object *solid, uint light_outside,
                         GLOBAL const real *light_row, const vreal *coordinates) {
    Crossing exit = crossing(R(1.0), R(1.0), 0); /* at the light */
    for (uint left = light_outside; left; left &= left - 1) {
        int bit = lowest_bit(left);
        int k = solid->first_plane + (bit >> 1);
        vreal width = splat(planes[k].distance), from = coordinates[k], to = splat(light_row[k]);
        Crossing next;
        next.distance = bit & 1 ? width + from : width - from;
        next.slope = bit & 1 ? from - to : to - from;
        next.plane = splat_int(k);
        vmask before = lt(next.distance * exit.slope, exit.distance * next.slope);
        exit = select_crossing(before, next, exit);
    }
    return exit;
}

/* Filters `light` by one solid on the segments from the points to the light. A segment misses it if
   neither end is inside some one plane, which settles most cases without arithmetic. */
FN void cross_solid(SCENE_PARAMETERS int object, GLOBAL const LightSides *sides,
                    GLOBAL const real *light_row, const vreal *coordinates, vint outside_planes,
                    uint some_outside, vmask open, Vec3 *light) {
    GLOBAL const Object *solid = objects + object;
    vint ruled_out = outside_planes & splat_int((int)(sides->outside | sides->on_plane));
    vmask crosses = open & eq_int(ruled_out, splat_int(0));
    if (!any_lane(crosses))
        return;
    Crossing entry = segment_entry(SCENE_ARGUMENTS solid, some_outside, light_row, coordinates);
    Crossing exit = segment_exit(SCENE_ARGUMENTS solid, sides->outside, light_row, coordinates);
    if (some_outside) {
        crosses = crosses & ~is_before(exit, entry);
        if (!any_lane(crosses))
            return;
    }
    /* The outer side is the one that a ray from the point to the light enters. */
    GLOBAL const Material *face = materials + solid->face_material;
    if (some_outside)
        cross_face(SCENE_ARGUMENTS solid, light_row, coordinates,
                   crosses & lt(splat(R(0.0)), entry.distance), entry, face->transmission, light);
    if (sides->outside)
        cross_face(SCENE_ARGUMENTS solid, light_row, coordinates, crosses, exit,
                   face->inner_transmission, light);
}

/* Returns x to the power n, n >= 1, by squaring; `common` is n if all lanes share it, else 0. No
   square is computed without use: powers of at least 2^-60 give no denormals, which are slow on
   some processors. */
FN vreal power(vreal x, vint n, int common) {
    if (common) {
        int rest = common;
        for (; !(rest & 1); rest >>= 1)
            x = x * x;
        vreal result = x;
        for (rest >>= 1; rest; rest >>= 1) {
            x = x * x;
            if (rest & 1)
                result = result * x;
        }
        return result;
    }
    vint zero = splat_int(0);
    vreal result = vselect(eq_int(n & 1, zero), splat(R(1.0)), x);
    for (vint rest = n >> 1; any_lane(lt_int(zero, rest)); rest = rest >> 1) {
        x = vselect(lt_int(zero, rest), x * x, x);
        result = vselect(eq_int(rest & 1, zero), result, result * x);
    }
    return result;
}

/* Returns the reflected share of one light by Phong's model, if `share` of the light arrives.
   `cosine` is N.L times the light's distance, `squared` that distance squared; without `shines` no
   lane has a highlight. */
FN Vec3 phong(const LaneMaterial *material, int shines, vint shininess, int common_shininess,
              vreal cosine, vreal mirror_cosine, vreal squared, vreal share) {
    vreal inverse = reciprocal_root(squared);
    Vec3 reflected = vec3_scale(material->colour, material->diffuse * (share * (cosine * inverse)));
    if (!shines)
        return reflected;
    vreal x = mirror_cosine * inverse;
    vmask too_small = lt(x, material->min_highlight);
    if (!any_lane(~too_small))
        return reflected;
    x = vselect(too_small, splat(R(0.0)), x);
    vreal specular = material->specular * (share * power(x, shininess, common_shininess));
    return vec3_add(reflected, vec3(specular, specular, specular));
}

/* Returns a light's share of its intensity at a squared distance. */
FN vreal falloff_at(GLOBAL const Light *light, vreal squared) {
    vreal one = splat(R(1.0)), scale = splat(light->inverse_falloff_squared);
    vreal most = splat(REAL_LARGE); /* keeps the reciprocal normal */
    if (light->inverse_falloff_squared < R(0.0)) {
        vreal rest = vmax(multiply_add(squared, scale, one), splat(R(0.0)));
        return rest * rest;
    }
    if (light->inverse_falloff_squared > R(0.0))
        return reciprocal(vmin(multiply_add(squared, scale, one), most));
    return one;
}

/* Returns the lanes whose squared distance is beyond the light's end. */
FN vmask beyond_falloff(GLOBAL const Light *light, vreal squared) {
    if (!(light->inverse_falloff_squared < R(0.0)))
        return mask_none();
    return le(squared * splat(light->inverse_falloff_squared), splat(R(-1.0)));
}

/* Returns `light` as the first `solids` solids, the floor and the meshes transmit it to the points
   of `lit`. */
FN Vec3 passing_light(SCENE_PARAMETERS int number, int solids, Vec3 light, Vec3 to_light,
                      const Surface *surface, const vreal *coordinates, const vint *outside_planes,
                      const uint *some_outside, const vmask *may_cross, const LitPoints *points,
                      int known, vmask lit) {
    GLOBAL const real *light_row = light_coordinates + number * header->plane_count;
    GLOBAL const LightSides *sides = light_sides + number * header->object_count;
    for (int object = 0; object < solids; object++) {
        if (cannot_occlude(known, object))
            continue;
        cross_solid(SCENE_ARGUMENTS object, sides + object, light_row, coordinates,
                    outside_planes[object], some_outside[object], may_cross[object] & lit, &light);
    }
    if (floor_may_block(header, known)) {
        vmask blocked =
            floor_blocks(SCENE_ARGUMENTS header->solid_count, light_row, coordinates, points);
        light = vec3_select(blocked, vec3_zero(), light);
        lit = lit & ~blocked;
    }
    if (MESHES(header) && must_visit(lit))
        light = vec3_mul(light, transmittance_of_meshes(SCENE_ARGUMENTS surface->point,
                                                        surface->lift, to_light, points->object,
                                                        points->face, points->inside, number, lit));
    return light;
}

/* Returns the lanes on a face that holds the light: N.L is 0 there, whatever rounding gives. */
FN vmask holds_light(GLOBAL const Light *light, const LitPoints *points) {
    if (light->own_face[0] < 0)
        return mask_none();
    return eq_int(points->face, splat_int(light->own_face[0])) |
           eq_int(points->face, splat_int(light->own_face[1]));
}

/* The different objects that a packet's points lie on, each with its points. */
typedef struct {
    int count;
    int object[HD_LANES];
    vmask points[HD_LANES];
} LightRows;

FN LightRows light_rows(vint object) {
    LightRows rows;
    rows.count = 0;
    vmask left = mask_all();
    do {
        int number = lane_int(&object, first_lane(left));
        vmask same = eq_int(object, splat_int(number));
        rows.object[rows.count] = number;
        rows.points[rows.count] = same;
        rows.count++;
        left = lanes_after(left, same);
    } while (any_lane(left));
    return rows;
}

/* Returns a light's place, relative to the objects that the points lie on. */
FN Vec3 light_position(SCENE_PARAMETERS const LightRows *rows, int light) {
    GLOBAL const Vector *v = light_offsets + rows->object[0] * header->light_count + light;
    Vec3 position = vec3_splat(v->x, v->y, v->z);
    for (int i = 1; i < rows->count; i++) {
        v = light_offsets + rows->object[i] * header->light_count + light;
        position = vec3_select(rows->points[i], vec3_splat(v->x, v->y, v->z), position);
    }
    return position;
}

/* Returns the occlusion mask of light `entry` - 1 for a packet's points; entry 0: of all lights. */
FN int occlusion_mask(SCENE_PARAMETERS const LightRows *rows, int entry) {
    return rows->count > 1 ? 0
                           : occlusion_masks[rows->object[0] * (header->light_count + 1) + entry];
}

/* Returns the radiance towards the viewer by diffuse and specular reflection of all lights. The
   outer loop runs over lights and lanes are points, so that a packet shares all data of a light.
   `mirrored` is the viewing ray's mirror direction, unit. */
FN Vec3 direct_light(SCENE_PARAMETERS const Surface *surface, const LitPoints *points,
                     Vec3 mirrored, vint *shadow_tests) {
    Vec3 sum = vec3_zero();
    vreal coordinates[PLANE_BOUND(header)];
    vint outside_planes[SOLID_BOUND(header)];
    uint some_outside[SOLID_BOUND(header)];
    vmask may_cross[SOLID_BOUND(header)];
    vreal zero = splat(R(0.0));
    LightRows rows = light_rows(object_of(SCENE_ARGUMENTS points->object));
    classify_against_planes(SCENE_ARGUMENTS surface, points,
                            occlusion_mask(SCENE_ARGUMENTS & rows, 0), coordinates, outside_planes,
                            some_outside, may_cross);
    Vec3 point = surface->point;
    if (MESHES(header))
        point = vec3_add(point, start_of_instance(SCENE_ARGUMENTS points->object));
    vint shininess = spread_first(surface->material.shininess, points->active);
    int common_shininess = HD_LANES > 1 && all_same(shininess) ? lane_int(&shininess, 0) : 0;
    int shines = any_lane(points->active & lt(zero, surface->material.specular));
    /* Bits of the solids and the floor. */
    const int masked_objects =
        header->floor_end < HD_MASKED_OBJECTS ? ((int)1 << header->floor_end) - 1 : -1;
#if HD_LANES > 1
    int cluster_masks[HD_MAX_LIGHT_CLUSTERS];
    cluster_masks[0] = 0; /* for all lights, if there are no clusters */
    if (HD_LIGHT_CLUSTERS(header->light_count) > 0 && rows.count == 1) {
        /* Copies, as a variable whose address is passed cannot stay in registers. */
        Vec3 at = point, normal = surface->normal;
        LitPoints lit_points = *points;
        cull_clusters(SCENE_ARGUMENTS & at, &normal, &lit_points, may_cross, cluster_masks);
    } else {
        for (int g = 1; g < HD_LIGHT_CLUSTERS(header->light_count); g++)
            cluster_masks[g] = 0;
    }
#endif
    for (int i = 0; i < header->light_count; i++) {
#if HD_LANES > 1
        int known = cluster_masks[lights[i].cluster];
        if (known & CLUSTER_IS_CULLED) {
            i += lights[i].run - 1;
            continue;
        }
#else
        int known = 0, run = MANY_LIGHTS(header) ? lights[i].run : 0;
        if (run > 0 && run_is_culled(SCENE_ARGUMENTS point, surface->normal,
                                     object_of(SCENE_ARGUMENTS points->object), i)) {
            i += run - 1;
            continue;
        }
#endif
        Vec3 to_light = vec3_sub(light_position(SCENE_ARGUMENTS & rows, i), point);
        vreal cosine = vec3_dot(surface->normal, to_light);
        vreal squared = vec3_dot(to_light, to_light);
        vmask lit = points->active & ~holds_light(lights + i, points) & lt(zero, cosine) &
                    lt(zero, squared) & ~beyond_falloff(lights + i, squared);
        if (!any_lane(lit))
            continue;
        *shadow_tests = count_lanes(*shadow_tests, lit);
        known |= occlusion_mask(SCENE_ARGUMENTS & rows, i + 1);
        Vec3 light = vec3_of(lights[i].intensity);
        int may_block = ~known & masked_objects;
        if (MESHES(header) || must_enter(may_block))
            light = passing_light(SCENE_ARGUMENTS i, may_block ? header->solid_count : 0, light,
                                  to_light, surface, coordinates, outside_planes, some_outside,
                                  may_cross, points, known, lit);
        vreal share = vselect(lit, falloff_at(lights + i, squared), zero);
        Vec3 reflected = phong(&surface->material, shines, shininess, common_shininess, cosine,
                               vec3_dot(mirrored, to_light), squared, share);
        sum = vec3_mul_add(light, reflected, sum);
    }
    return sum;
}

#endif
