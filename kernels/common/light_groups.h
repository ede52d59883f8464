/* SPDX-License-Identifier: MIT */
/* What is decided for a bundle of points and many lights near each other: that none of these can
   reach any of the points, or, for bundles of several lanes, that nothing of a solid lies between.
   All of it is conservative (docs/numerics.md, Light culling): lights are left out, and solids
   not looked at, only where each pair by itself would come to the same. */
#ifndef HD_LIGHT_GROUPS_H
#define HD_LIGHT_GROUPS_H

#include "surface.h"

/* The lit points of a bundle. */
typedef struct {
    vint object;  /* what the points lie on */
    vint face;    /* and which face of it */
    vmask inside; /* light reaches the point from inside that solid */
    vmask active;
} LitPoints;

/* Of a light or a group of lights: a bit for each of the first objects, that it is not between; and
   one more, that the group is dark. */
#define GROUP_IS_DARK ((int)1 << HD_JUDGED_OBJECTS)

FN int is_beside(int beside, int object) {
    return object < HD_JUDGED_OBJECTS && beside >> object & 1;
}

FN int floor_may_block(GLOBAL const Header *header, int beside) {
    return header->solid_count < header->floor_end && !is_beside(beside, header->solid_count);
}

#if HD_LANES == 1

/* A length is at most that. */
FN vreal sum_of_sides(Vec3 v) {
    return absolute(v.x) + absolute(v.y) + absolute(v.z);
}

/* Whether all lights of the run that begins with number `light` are too far away from a point on an
   object, or behind it. */
FN int run_is_dark(SCENE_PARAMETERS Vec3 point, Vec3 normal, int object, int light) {
    GLOBAL const LightRun *run = light_runs + object * header->light_count + light;
    Vec3 way = vec3_sub(vec3_of(run->place), point);
    vreal radius = splat(run->radius);
    vreal slack = (sum_of_sides(way) + radius + sum_of_sides(point)) * R(1e-4);
    vreal size = radius + slack, most = splat(run->reach) + size;
    return any_lane(lt(most * most, vec3_dot(way, way)) |
                    lt(vec3_dot(normal, way) + size, splat(R(0.0))));
}

#else

/* A ball about the active points, and their normals: first lane's and how far others are off. */
typedef struct {
    Vec3 middle, normal;
    vreal radius, spread;
} PointBall;

FN Vec3 lane_of(const Vec3 *v, int lane) {
    return vec3_splat(lane_real(&v->x, lane), lane_real(&v->y, lane), lane_real(&v->z, lane));
}

FN vreal length_of(Vec3 v) {
    return square_root(vec3_dot(v, v));
}

FN vreal most_distance(const Vec3 *points, Vec3 from, vmask m) {
    Vec3 way = vec3_sub(*points, from);
    return square_root(splat(greatest_lane(vec3_dot(way, way), m)));
}

FN PointBall ball_about(const Vec3 *points, const Vec3 *normals, vmask active) {
    PointBall ball;
    int lane = first_lane(active);
    ball.middle = lane_of(points, lane);
    ball.normal = lane_of(normals, lane);
    ball.radius = most_distance(points, ball.middle, active);
    ball.spread = most_distance(normals, ball.normal, active);
    return ball;
}

/* As many groups as there are lanes. */
typedef struct {
    Vec3 place; /* relative to an object */
    vreal radius, reach;
} Groups;

FN Groups load_groups(GLOBAL const real *light_groups, int object, int first, int count) {
    GLOBAL const real *row = light_groups + object * HD_GROUP_ROWS * count + first;
    Groups groups;
    groups.place = vec3(load_reals(row + HD_GROUP_X * count), load_reals(row + HD_GROUP_Y * count),
                        load_reals(row + HD_GROUP_Z * count));
    groups.radius = load_reals(row + HD_GROUP_RADIUS * count);
    groups.reach = load_reals(row + HD_GROUP_REACH * count);
    return groups;
}

/* Groups that are too far away, or behind the points. */
FN vmask dark_groups(const PointBall *ball, const Groups *groups) {
    Vec3 way = vec3_sub(groups->place, ball->middle);
    vreal distance = length_of(way), size = groups->radius + ball->radius;
    vreal slack = (distance + size + length_of(ball->middle)) * R(1e-4);
    vreal height = vec3_dot(ball->normal, way);
    vreal most_height = multiply_add(ball->spread, distance + size, height + size);
    return lt(groups->reach + size + slack, distance) | lt(most_height + slack, splat(R(0.0)));
}

/* Groups whose segments to the points all lie beyond one plane that a sphere about the solid is
   before: a plane across the way from the solid's centre, which places are relative to, to the
   middle segment. */
FN vmask groups_beside(vreal solid_radius, const PointBall *ball, Vec3 middle,
                       const Groups *groups) {
    Vec3 way = vec3_sub(groups->place, middle);
    vreal squared = greater(vec3_dot(way, way), splat(R(1e-30)));
    vreal along = lesser(-vec3_dot(middle, way) * reciprocal(squared), splat(R(1.0)));
    Vec3 across = vec3_scale_add(way, greater(along, splat(R(0.0))), middle);
    vreal length = length_of(across), told = splat(R(1e-15)); /* from one that rounded to 0 */
    vreal least = solid_radius + (length_of(middle) + ball->radius) * R(1e-4);
    return lt(told, length) & lt(length * (least + ball->radius), vec3_dot(across, middle)) &
           lt(length * (least + groups->radius), vec3_dot(across, groups->place));
}

/* What is known of each group, for points that lie on one object; `open_to` are the points from
   which segments may cross a solid. */
FN_APART void judge_groups(SCENE_PARAMETERS const Vec3 *points, const Vec3 *normals,
                           const LitPoints *lit_points, const vmask *open_to, int *known) {
    const int count = HD_LIGHT_GROUPS(header->light_count);
    vint numbers = object_of(SCENE_ARGUMENTS lit_points->object);
    int object = lane_int(&numbers, 0);
    int solids = header->solid_count < HD_JUDGED_OBJECTS ? header->solid_count : HD_JUDGED_OBJECTS;
    PointBall ball = ball_about(points, normals, lit_points->active);
    for (int first = 0; first < count; first += HD_LANES) {
        Groups groups = load_groups(light_groups, object, first, count);
        vmask dark = dark_groups(&ball, &groups);
        vint found = pick_int(dark, splat_int(GROUP_IS_DARK), splat_int(0));
        for (int s = 0; s < solids && any_lane(~dark); s++) {
            vmask beside = mask_all();
            if (any_lane(open_to[s])) {
                if (s == object)
                    continue; /* from inside of it */
                GLOBAL const Vector *offset = object_offsets + object * header->object_count + s;
                groups = load_groups(light_groups, s, first, count);
                beside = groups_beside(
                    splat(objects[s].radius_about), &ball,
                    vec3_add(ball.middle, vec3_splat(offset->x, offset->y, offset->z)), &groups);
            }
            found = found | pick_int(beside, splat_int((int)1 << s), splat_int(0));
        }
        for (int lane = 0; lane < HD_LANES; lane++)
            known[first + lane] = lane_int(&found, lane);
    }
}
#endif

#endif
