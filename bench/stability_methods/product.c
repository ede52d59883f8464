/* SPDX-License-Identifier: MIT */
/* HD_PRODUCT names the table; HD_DOUBLE is 0 or 1. */
#include "product.h"

#include "cpu/dialect.h"
#include "kernels/common/ray_tree.h"

static Vec3 rounded(HdVec3 v) {
    return vec3_splat((real)v.x, (real)v.y, (real)v.z);
}

/* The frame's tables that light does not need. */
static const HdTable no_frame[HD_FRAME_TABLE_COUNT];

static Sample no_sample(void) {
    Sample sample = {0};
    return sample;
}

static HdBounce bounce_of(const HdTable *scene, const Ray *next) {
    const Header *header = scene[HD_TABLE_header].data;
    const Object *objects = scene[HD_TABLE_objects].data;
    const Instance *instances = scene[HD_TABLE_instances].data;
    int object = next->last_hit;
    if (object >= header->floor_end) {
        int number = object - header->floor_end;
        return (HdBounce){number, next->face - instances[number].first_face};
    }
    int face = next->face - 2 * objects[object].first_plane;
    return (HdBounce){object, objects[object].paired ? face : face / 2};
}

static int mirror_path(const HdTable *scene, const HdTable *frame, HdVec3 direction, int most,
                       HdBounce *bounces) {
    HD_DECLARE_TABLES(scene, frame)
    Ray ray = eye_ray(rounded(direction), mask_all());
    Sample sample = no_sample();
    int count = 0;
    while (count < most) {
        Ray mirror, through;
        trace_and_shade(SCENE_ARGUMENTS & ray, count, &sample, &mirror, &through);
        if (!any_lane(mirror.alive))
            break;
        bounces[count++] = bounce_of(scene, &mirror);
        ray = mirror;
    }
    return count;
}

static HdCrossings pierce(const HdTable *scene, const HdTable *frame, HdVec3 direction) {
    enum { MOST = 16 };
    HD_DECLARE_TABLES(scene, frame)
    Ray ray = eye_ray(rounded(direction), mask_all());
    Hit hit = closest_hit(SCENE_ARGUMENTS & ray, local_origin_of(SCENE_ARGUMENTS ray.last_hit, 1));
    HdCrossings crossings = {.first = (double)hit.t};
    Sample sample = no_sample();
    for (int level = 0; level < MOST; level++) {
        Ray mirror, through;
        trace_and_shade(SCENE_ARGUMENTS & ray, level, &sample, &mirror, &through);
        if (!any_lane(through.alive))
            break;
        if (any_lane(through.inside))
            crossings.entered++;
        else
            crossings.left++;
        ray = through;
    }
    return crossings;
}

static HdCrossings cross_triangles(HdVec3 (*corners)[3], int count, HdVec3 origin,
                                   HdVec3 direction) {
    HdCrossings crossings = {.first = (double)REAL_LARGE};
    Vec3 from = rounded(origin), along = rounded(direction);
    DominantAxis last = dominant_axis(along);
    from = turn(last, from);
    along = turn(last, along);
    RayFrame frame = ray_frame(from, along);
    Slabs slabs = ray_slabs(from, along, splat(R(1.0)));
    for (int i = 0; i < count; i++) {
        TriangleCrossing crossing;
        vmask met = cross_triangle(&frame, &slabs, mask_all(), turn(last, rounded(corners[i][0])),
                                   turn(last, rounded(corners[i][1])),
                                   turn(last, rounded(corners[i][2])), &crossing);
        if (!any_lane(met & le(splat(R(0.0)), crossing.t)))
            continue;
        if (!any_lane(crossing.entering)) {
            crossings.left++;
            continue;
        }
        crossings.entered++;
        if ((double)crossing.t < crossings.first)
            crossings.first = (double)crossing.t;
    }
    return crossings;
}

static Surface surface_of(const HdLitPoint *point) {
    Surface surface;
    surface.point = rounded(point->point);
    surface.normal = rounded(point->normal);
    surface.emission = vec3_zero();
    surface.material = no_material();
    surface.material.colour = vec3_splat(R(1.0), R(1.0), R(1.0));
    surface.material.diffuse = splat(R(1.0));
    return surface;
}

static LitPoints points_of(const HdLitPoint *point) {
    LitPoints points;
    points.object = splat_int(point->object);
    points.face = splat_int(point->face);
    points.inside = point->inside ? mask_all() : mask_none();
    points.active = mask_all();
    return points;
}

static double transmittance(const HdTable *scene, const HdLitPoint *point, int light) {
    HD_DECLARE_TABLES(scene, no_frame)
    Surface surface = surface_of(point);
    LitPoints points = points_of(point);
    vreal coordinates[PLANE_BOUND(header)];
    vint outer[SOLID_BOUND(header)];
    uint some_outer[SOLID_BOUND(header)];
    vmask open_to[SOLID_BOUND(header)];
    classify_against_planes(SCENE_ARGUMENTS & surface, &points, 0, coordinates, outer, some_outer,
                            open_to);
    LightRows rows = light_rows(points.object);
    Vec3 to_light = vec3_sub(light_position(SCENE_ARGUMENTS & rows, light), surface.point);
    Vec3 white = vec3_splat(R(1.0), R(1.0), R(1.0));
    Vec3 passing =
        passing_light(SCENE_ARGUMENTS light, header->solid_count, white, to_light, &surface,
                      coordinates, outer, some_outer, open_to, &points, 0, mask_all());
    return (double)lane_real(&passing.x, 0);
}

static double radiance(const HdTable *scene, const HdLitPoint *point) {
    HD_DECLARE_TABLES(scene, no_frame)
    Surface surface = surface_of(point);
    LitPoints points = points_of(point);
    vint tests = splat_int(0);
    Vec3 sum = direct_light(SCENE_ARGUMENTS & surface, &points, surface.normal, &tests);
    return (double)lane_real(&sum.x, 0);
}

const HdProduct HD_PRODUCT = {
    .precision = HD_DOUBLE ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT,
    .mirror_path = mirror_path,
    .pierce = pierce,
    .cross_triangles = cross_triangles,
    .transmittance = transmittance,
    .radiance = radiance,
};
