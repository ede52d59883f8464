/* SPDX-License-Identifier: MIT */
#include "plain_trees.h"

#include <math.h>

static float dot(HdFloat3 a, HdFloat3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static HdFloat3 add_scaled(HdFloat3 a, HdFloat3 b, float t) {
    return (HdFloat3){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

static const HdGrey *material_of(const HdPlainPicture *picture, int triangle) {
    return &picture->materials[picture->scene.faces[triangle].object];
}

/* What everything on the way to the light lets through. */
static float transmittance(const HdPlainPicture *picture, int avoidance, HdFloatRay *ray, int last,
                           float distance) {
    float passing = 1.0f;
    hd_triangle_tests.prepare_ray(ray);
    for (int i = 0; i < picture->scene.count; i++) {
        HdMeeting meeting;
        if (hd_plain_cross(&picture->scene, avoidance, ray, last, i, &meeting) &&
            meeting.t < distance)
            passing *= material_of(picture, i)->colour * material_of(picture, i)->transmission;
    }
    return passing;
}

/* `side` is that of the eye. */
static float lit(const HdPlainPicture *picture, int avoidance, HdFloat3 point, int met,
                 float side) {
    HdFloatRay ray = {.origin = point};
    HdFloat3 way = add_scaled(picture->light, point, -1.0f);
    float distance = sqrtf(dot(way, way));
    ray.direction = add_scaled((HdFloat3){0.0f, 0.0f, 0.0f}, way, 1.0f / distance);
    float facing = side * dot(picture->scene.normals[met], ray.direction);
    if (!(facing > 0.0f))
        return 0.0f;
    return facing * transmittance(picture, avoidance, &ray, met, distance);
}

static float follow(const HdPlainPicture *picture, int avoidance, HdFloatRay ray, int last,
                    int level) {
    HdMeeting meeting;
    int met = hd_plain_closest(&picture->scene, avoidance, &ray, last, &meeting);
    if (met < 0)
        return 0.0f;
    const HdGrey *material = material_of(picture, met);
    HdFloat3 normal = picture->scene.normals[met];
    float facing = dot(normal, ray.direction), side = facing < 0.0f ? 1.0f : -1.0f;
    HdFloat3 near = hd_plain_leave(&picture->scene, avoidance, &ray, met, &meeting, side);
    float sum = material->colour * material->diffuse * lit(picture, avoidance, near, met, side);
    if (level == picture->depth)
        return sum;
    HdFloatRay mirrored = {.origin = near,
                           .direction = add_scaled(ray.direction, normal, -2.0f * facing)};
    HdFloatRay passing = {.direction = ray.direction};
    passing.origin = hd_plain_leave(&picture->scene, avoidance, &ray, met, &meeting, -side);
    if (material->reflection > 0.0f)
        sum += material->reflection * follow(picture, avoidance, mirrored, met, level + 1);
    if (material->transmission > 0.0f)
        sum += material->transmission * material->colour *
               follow(picture, avoidance, passing, met, level + 1);
    return sum;
}

float hd_plain_seen(const HdPlainPicture *picture, int avoidance, HdFloat3 direction) {
    HdFloatRay ray = {.origin = picture->eye, .direction = direction};
    return follow(picture, avoidance, ray, -1, 0);
}
