/* SPDX-License-Identifier: MIT */
/* One build of the searches; HD_BUILD names it, HD_BUILD_SET is its instruction set. */
#include "walks.h"

#include <string.h>

#include "cpu/kernel_tables.h"
#include "kernels/common/render.h"

typedef struct Start {
    Vec3 origin, direction;
    vint touched, face;
    vmask inside;
    int is_eye;
} Start;

static Vec3 load_vectors(float *const coordinates[3], int first) {
    return vec3(load_reals(coordinates[0] + first), load_reals(coordinates[1] + first),
                load_reals(coordinates[2] + first));
}

static Start load_start(const HdRays *rays, int first, int meshes) {
    Start start;
    start.is_eye = rays->kind == HD_RAYS_PRIMARY;
    start.origin = start.is_eye ? vec3_zero() : load_vectors(rays->origin, first);
    start.direction = load_vectors(rays->direction, first);
    start.touched = splat_int(meshes);
    start.face = splat_int(-2) - load_ints(rays->triangle + first);
    start.inside = lt_int(splat_int(0), load_ints(rays->is_inside + first));
    return start;
}

static void search_closest(const HdTable *scene, const HdTable *frame, const Start *start,
                           int first, HdHits *hits) {
    HD_DECLARE_TABLES(scene, frame)
    Ray ray;
    ray.origin = start->origin;
    ray.direction = start->direction;
    ray.weight = vec3_zero();
    ray.touched = start->touched;
    ray.face = start->face;
    ray.inside = start->inside;
    ray.alive = mask_all();
    Reference reference = reference_of(SCENE_ARGUMENTS start->touched, start->is_eye);
    Hit hit = closest_hit(SCENE_ARGUMENTS & ray, reference);
    vmask missed = lt_int(hit.object, splat_int(0));
    vint triangle = pick_int(missed, splat_int(-1), hit.face);
    vint entering = pick_int(hit.entering, splat_int(1), splat_int(0));
    memcpy(hits->t + first, &hit.t, sizeof hit.t);
    memcpy(hits->triangle + first, &triangle, sizeof triangle);
    memcpy(hits->is_entering + first, &entering, sizeof entering);
}

static void search_light(const HdTable *scene, const HdTable *frame, const Start *start, int first,
                         HdHits *hits) {
    HD_DECLARE_TABLES(scene, frame)
    WorldRays world;
    Vec3 passing;
    vmask all = mask_all();
    world.origin = world.own_origin = start->origin;
    world.direction = start->direction;
    world.touched = start->touched;
    world.face = start->face;
    world.inside = start->inside;
    world.is_shadow = 1;
    world.light_face[0] = world.light_face[1] = -1;
    filter_by_meshes(SCENE_ARGUMENTS & world, &all, &passing);
    memcpy(hits->passing[0] + first, &passing.x, sizeof passing.x);
    memcpy(hits->passing[1] + first, &passing.y, sizeof passing.y);
    memcpy(hits->passing[2] + first, &passing.z, sizeof passing.z);
}

static void search(const HdObject *object, const HdRays *rays, HdHits *hits) {
    const HdTable *scene = object->tables.table, *frame = object->frame.table;
    HD_DECLARE_TABLES(scene, frame)
    for (int first = 0; first < rays->count; first += HD_LANES) {
        Start start = load_start(rays, first, header->floor_end);
        if (rays->kind == HD_RAYS_SHADOW)
            search_light(scene, frame, &start, first, hits);
        else
            search_closest(scene, frame, &start, first, hits);
    }
}

extern const HdWalks HD_BUILD;
const HdWalks HD_BUILD = {.instruction_set = HD_BUILD_SET, .lanes = HD_LANES, .search = search};
