/* SPDX-License-Identifier: MIT */
#include "plain_paths.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "methods.h"
#include "shapes.h"

/* What keeps a ray from meeting the surface that it leaves. */
typedef struct Avoidance {
    float epsilon;          /* nearer hits count as none */
    float relative_epsilon; /* likewise, times the largest coordinate of the ray's origin */
    bool moves_origin, skips_triangle, skips_face;
    bool is_moeller_trumbore; /* instead of the watertight test with the tie rule */
} Avoidance;

enum { moeller_trumbore = 1 }; /* among the tests: that with a least determinant of 0 */

static const Avoidance avoidances[HD_AVOIDANCES] = {
    {.epsilon = 1e-3f},     {.epsilon = 1e-4f},
    {.epsilon = 4e-6f},     {.relative_epsilon = 1e-5f},
    {.moves_origin = true}, {.skips_triangle = true},
    {.skips_face = true},   {.epsilon = 1e-4f, .is_moeller_trumbore = true},
};

const char *const hd_avoidance_names[HD_AVOIDANCES] = {
    "epsilon_1e-3",    "epsilon_1e-4", "epsilon_4e-6", "relative_epsilon",
    "waechter_binder", "own_triangle", "own_face",     "moeller_trumbore_epsilon_1e-4",
};

void hd_plain_scene_make(HdPlainScene *scene, const HdRoom *room, HdVec3 centre, double scale) {
    scene->count = 0;
    for (int s = 0; s < room->count; s++) {
        HdShape shape;
        HdVec3 at[HD_MOST_SHAPE_VERTICES];
        hd_shape_of_platonic(&shape, &room->shape[s]);
        for (int v = 0; v < shape.vertex_count; v++) {
            HdVec3 p = hd_add(room->centre[s], hd_scale(shape.vertices[v], room->radius[s]));
            at[v] = hd_add(centre, hd_scale(p, scale));
        }
        for (int i = 0; i < shape.triangle_count; i++) {
            HdFloatTriangle *triangle = &scene->triangles[scene->count];
            triangle->a = hd_to_float(at[shape.corners[i][0]]);
            triangle->b = hd_to_float(at[shape.corners[i][1]]);
            triangle->c = hd_to_float(at[shape.corners[i][2]]);
            scene->normals[scene->count] =
                hd_to_float(room->shape[s].face_normal[shape.face_of[i]]);
            scene->faces[scene->count++] = (HdBounce){s, shape.face_of[i]};
        }
    }
}

static float dot(HdFloat3 a, HdFloat3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static HdFloat3 along(HdFloat3 origin, HdFloat3 direction, float t) {
    return (HdFloat3){origin.x + t * direction.x, origin.y + t * direction.y,
                      origin.z + t * direction.z};
}

static float largest(HdFloat3 a) {
    return fmaxf(fabsf(a.x), fmaxf(fabsf(a.y), fabsf(a.z)));
}

/* ---- C. Waechter, N. Binder 2019, A Fast and Robust Method for Avoiding Self-Intersection ---- */

static float moved(float p, float normal) {
    const float near_origin = 1.0f / 32.0f, float_step = 1.0f / 65536.0f, int_step = 256.0f;
    int32_t bits, steps = (int32_t)(int_step * normal);
    memcpy(&bits, &p, sizeof bits);
    bits += p < 0.0f ? -steps : steps;
    float stepped;
    memcpy(&stepped, &bits, sizeof stepped);
    return fabsf(p) < near_origin ? p + float_step * normal : stepped;
}

static HdFloat3 move_off(HdFloat3 p, HdFloat3 normal) {
    return (HdFloat3){moved(p.x, normal.x), moved(p.y, normal.y), moved(p.z, normal.z)};
}

/* Nearer to the triangle than a point computed along the ray. */
static HdFloat3 blend(const HdFloatTriangle *triangle, const HdMeeting *meeting) {
    float b = meeting->share_b, c = meeting->share_c, a = 1.0f - b - c;
    HdFloat3 p = triangle->a, q = triangle->b, r = triangle->c;
    return (HdFloat3){a * p.x + b * q.x + c * r.x, a * p.y + b * q.y + c * r.y,
                      a * p.z + b * q.z + c * r.z};
}

/* ---- paths ---- */

static bool is_same(HdBounce a, HdBounce b) {
    return a.object == b.object && a.face == b.face;
}

/* Whether a ray that leaves triangle `last` (-1: the eye) crosses another. */
static bool crosses(const HdPlainScene *scene, int number, const HdFloatRay *ray, int last,
                    int triangle, HdMeeting *meeting) {
    const Avoidance *avoidance = &avoidances[number];
    const HdTriangleTests *tests = &hd_triangle_tests;
    const HdTriangleTest *test =
        &tests->tests[avoidance->is_moeller_trumbore ? moeller_trumbore : tests->count - 1];
    float least = avoidance->epsilon + avoidance->relative_epsilon * largest(ray->origin);
    bool skipped = last >= 0 &&
                   ((avoidance->skips_triangle && triangle == last) ||
                    (avoidance->skips_face && is_same(scene->faces[triangle], scene->faces[last])));
    return !skipped && test->cross(ray, &scene->triangles[triangle], meeting) &&
           meeting->t > (last >= 0 ? least : 0.0f);
}

/* The triangle that a ray meets first, -1: none. */
static int closest(const HdPlainScene *scene, int number, HdFloatRay *ray, int last,
                   HdMeeting *met) {
    int found = -1;
    hd_triangle_tests.prepare_ray(ray);
    met->t = INFINITY;
    for (int i = 0; i < scene->count; i++) {
        HdMeeting meeting;
        if (!crosses(scene, number, ray, last, i, &meeting) || !(meeting.t < met->t))
            continue;
        *met = meeting;
        found = i;
    }
    return found;
}

/* Where a path goes on from a triangle; `side` is 1 on its outer side, else -1. */
static HdFloat3 leave(const HdPlainScene *scene, int number, const HdFloatRay *ray, int met,
                      const HdMeeting *meeting, float side) {
    HdFloat3 normal = scene->normals[met];
    HdFloat3 towards = {side * normal.x, side * normal.y, side * normal.z};
    if (avoidances[number].moves_origin)
        return move_off(blend(&scene->triangles[met], meeting), towards);
    return along(ray->origin, ray->direction, meeting->t);
}

int hd_plain_path(const HdPlainScene *scene, int number, HdFloat3 eye, HdFloat3 direction, int most,
                  HdBounce *bounces) {
    HdFloatRay ray = {.origin = eye, .direction = direction};
    int last = -1;
    for (int count = 0; count < most; count++) {
        HdMeeting met;
        last = closest(scene, number, &ray, last, &met);
        if (last < 0)
            return count;
        bounces[count] = scene->faces[last];
        HdFloat3 normal = scene->normals[last];
        float facing = dot(normal, ray.direction);
        ray.origin = leave(scene, number, &ray, last, &met, facing < 0.0f ? 1.0f : -1.0f);
        ray.direction = along(ray.direction, normal, -2.0f * facing);
    }
    return most;
}
