/* SPDX-License-Identifier: MIT */
#include "rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const hd_ray_kind_names[HD_RAY_KINDS] = {"primary", "mirrored", "diffuse", "shadow"};

static void *numbers(int count) {
    return aligned_alloc(64, (size_t)count * sizeof(float));
}

bool hd_rays_create(HdRays *rays, HdRayKind kind, int count) {
    memset(rays, 0, sizeof *rays);
    rays->kind = kind;
    rays->count = count;
    for (int i = 0; i < 3; i++) {
        rays->origin[i] = numbers(count);
        rays->direction[i] = numbers(count);
    }
    rays->triangle = numbers(count);
    rays->is_inside = numbers(count);
    bool has_all = rays->triangle != NULL && rays->is_inside != NULL;
    for (int i = 0; i < 3; i++)
        has_all = has_all && rays->origin[i] != NULL && rays->direction[i] != NULL;
    return has_all;
}

void hd_rays_free(HdRays *rays) {
    for (int i = 0; i < 3; i++) {
        free(rays->origin[i]);
        free(rays->direction[i]);
    }
    free(rays->triangle);
    free(rays->is_inside);
}

bool hd_hits_create(HdHits *hits, int count) {
    hits->t = numbers(count);
    hits->triangle = numbers(count);
    hits->is_entering = numbers(count);
    for (int i = 0; i < 3; i++)
        hits->passing[i] = numbers(count);
    return hits->t != NULL && hits->triangle != NULL && hits->is_entering != NULL &&
           hits->passing[0] != NULL && hits->passing[1] != NULL && hits->passing[2] != NULL;
}

void hd_hits_free(HdHits *hits) {
    free(hits->t);
    free(hits->triangle);
    free(hits->is_entering);
    for (int i = 0; i < 3; i++)
        free(hits->passing[i]);
}

static void set_ray(HdRays *rays, int number, HdVec3 origin, HdVec3 direction) {
    const double from[3] = {origin.x, origin.y, origin.z};
    const double to[3] = {direction.x, direction.y, direction.z};
    for (int i = 0; i < 3; i++) {
        rays->origin[i][number] = (float)from[i];
        rays->direction[i][number] = (float)to[i];
    }
}

/* The bits of a number of the Z order that lie in even places. */
static int every_other_bit(int number) {
    int bits = 0;
    for (int i = 0; i < 15; i++)
        bits |= (number >> 2 * i & 1) << i;
    return bits;
}

void hd_rays_look(HdRays *rays, const HdObject *object, int side) {
    const double tangent = hd_object_tangent;
    for (int i = 0; i < rays->count; i++) {
        double x = (every_other_bit(i) + 0.5) / side, y = (every_other_bit(i >> 1) + 0.5) / side;
        HdVec3 direction = hd_vec3((2.0 * x - 1.0) * tangent, 1.0, (1.0 - 2.0 * y) * tangent);
        set_ray(rays, i, object->eye, hd_normalize(direction));
        rays->triangle[i] = -1;
        rays->is_inside[i] = 0;
    }
}

/* Equally distributed numbers from 0 to 1, the same in every run (Marsaglia 2003, Xorshift RNGs).
 */
static double next_number(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) * 0x1p-53;
}

/* As many towards a direction as its cosine with the normal is large. */
static HdVec3 scatter(HdVec3 normal, uint64_t *state) {
    for (;;) {
        HdVec3 p = hd_vec3(2.0 * next_number(state) - 1.0, 2.0 * next_number(state) - 1.0,
                           2.0 * next_number(state) - 1.0);
        double square = hd_dot(p, p);
        if (square > 1.0 || square < 0.01)
            continue;
        HdVec3 direction = hd_add(normal, hd_scale(p, 1.0 / sqrt(square)));
        if (hd_dot(direction, direction) > 0.01)
            return hd_normalize(direction);
    }
}

static HdVec3 vector_at(float *const coordinates[3], int i) {
    return hd_vec3((double)coordinates[0][i], (double)coordinates[1][i], (double)coordinates[2][i]);
}

void hd_rays_continue(HdRays *rays, const HdObject *object, const HdRays *from,
                      const HdHits *hits) {
    uint64_t state = 0x9e3779b97f4a7c15;
    for (int i = 0; i < rays->count; i++) {
        HdVec3 origin = vector_at(from->origin, i), direction = vector_at(from->direction, i);
        int triangle = hits->triangle[i];
        rays->triangle[i] = triangle;
        rays->is_inside[i] = triangle >= 0 && !hits->is_entering[i];
        if (triangle < 0) {
            set_ray(rays, i, origin, direction);
            continue;
        }
        HdVec3 point = hd_add(origin, hd_scale(direction, (double)hits->t[i]));
        HdVec3 normal = object->normals[triangle];
        if (!hits->is_entering[i])
            normal = hd_scale(normal, -1.0);
        if (rays->kind == HD_RAYS_MIRRORED)
            direction = hd_sub(direction, hd_scale(normal, 2.0 * hd_dot(normal, direction)));
        else if (rays->kind == HD_RAYS_DIFFUSE)
            direction = scatter(normal, &state);
        else
            direction = hd_sub(object->light, point);
        if (hd_dot(normal, direction) < 0.0) /* to a light beyond the surface */
            rays->is_inside[i] = !rays->is_inside[i];
        set_ray(rays, i, point, direction);
    }
}

static HdVec3 point_to_aim_at(const HdObject *object, uint64_t *state) {
    const double outside_of_sphere = 2.0, least_cosine = 0.5;
    for (;;) {
        int triangle = (int)(next_number(state) * object->triangle_count);
        HdVec3 a = hd_object_corner(object, triangle, 0);
        HdVec3 b = hd_object_corner(object, triangle, 1);
        double share = next_number(state) < 0.5 ? 0.0 : next_number(state);
        HdVec3 way = hd_normalize(hd_sub(object->eye, a));
        if (hd_dot(a, a) < outside_of_sphere &&
            hd_dot(object->normals[triangle], way) > least_cosine)
            return hd_add(a, hd_scale(hd_sub(b, a), share));
    }
}

void hd_rays_aim(HdRays *rays, const HdObject *object, float *distance) {
    const double beyond = 5.0; /* from the eye, whatever the direction to the sphere */
    uint64_t state = 0x9e3779b97f4a7c15;
    for (int i = 0; i < rays->count; i++) {
        HdVec3 way = hd_sub(point_to_aim_at(object, &state), object->eye);
        distance[i] = (float)(sqrt(hd_dot(way, way)) / beyond);
        rays->triangle[i] = -1;
        rays->is_inside[i] = 0;
        set_ray(rays, i, object->eye, hd_scale(hd_normalize(way), beyond));
    }
}
