/* SPDX-License-Identifier: MIT */
/* All meshes of a scene: closest hits and transmittance. */
#ifndef HD_MESHES_H
#define HD_MESHES_H

#include "intersection.h"
#include "mesh_traversal_packet.h"

/* Rays relative to the meshes' centre. */
typedef struct {
    Vec3 origin, direction;
    Vec3 own_origin;     /* relative to the last hit instance */
    vint last_hit, face; /* the last hit object, -1: none, and its face */
    vmask inside;
    int is_shadow;     /* collects filters of light, not the closest hit */
    int light_face[2]; /* the light's own faces, -1: none */
} WorldRays;

/* Transforms a point relative to the instance's start, or a direction. */
FN Vec3 transform_vector(const GLOBAL real (*rows)[3], Vec3 v) {
    vreal at[3];
    for (int i = 0; i < 3; i++)
        at[i] = multiply_add(splat(rows[i][0]), v.x,
                             multiply_add(splat(rows[i][1]), v.y, splat(rows[i][2]) * v.z));
    return vec3(at[0], at[1], at[2]);
}

/* Transforms a mesh's normals to the world, by the transpose of `to_mesh`. */
FN Vec3 transform_normal(const GLOBAL real (*rows)[3], Vec3 n) {
    vreal at[3];
    for (int i = 0; i < 3; i++)
        at[i] = multiply_add(splat(rows[0][i]), n.x,
                             multiply_add(splat(rows[1][i]), n.y, splat(rows[2][i]) * n.z));
    return vec3(at[0], at[1], at[2]);
}

/* Returns the rays' origins in mesh coordinates; those that left the instance keep their exact
   origin. */
FN Vec3 origin_in_mesh(GLOBAL const Instance *instance, Vec3 origin, vmask own, Vec3 own_origin) {
    Vec3 start = vec3_of(instance->start);
    return transform_vector(instance->to_mesh,
                            vec3_select(own, own_origin, vec3_sub(origin, start)));
}

FN MeshRays rays_in_mesh(SCENE_PARAMETERS const WorldRays *world, int number) {
    GLOBAL const Instance *instance = instances + number;
    MeshRays rays;
    rays.object = header->floor_end + number;
    rays.own = eq_int(world->last_hit, splat_int(rays.object));
    Vec3 origin = origin_in_mesh(instance, world->origin, rays.own, world->own_origin);
    Vec3 direction = transform_vector(instance->to_mesh, world->direction);
    rays.last = dominant_axis(direction);
    origin = turn(rays.last, origin);
    direction = turn(rays.last, direction);
    rays.frame = ray_frame(origin, direction);
    rays.slabs = ray_slabs(origin, direction, splat(R(1.0)));
    rays.own_face = vselect_int(rays.own, world->face, splat_int(-1));
    rays.inside = world->inside;
    rays.first_face = instance->first_face;
    rays.first_mesh_material = instance->first_mesh_material;
    rays.is_shadow = world->is_shadow;
    rays.light_face[0] = world->light_face[0];
    rays.light_face[1] = world->light_face[1];
    rays.contact_squared = instance->contact_squared;
    return rays;
}

FN_NOINLINE void search_instance(SCENE_PARAMETERS Findings *found, const WorldRays *world,
                                 const vmask *m, int number) {
    MeshRays rays = rays_in_mesh(SCENE_ARGUMENTS world, number);
    search_mesh(SCENE_ARGUMENTS found, &rays, *m, instances + number);
}

/* Pushes the children of a node that rays of `m` meet, the nearer one on top; returns the height of
   the stack. */
FN int push_children(SCENE_PARAMETERS const Findings *found, const Slabs *slabs, vmask m,
                     const RayOctant *octant, int number, int *stack, int waiting) {
    GLOBAL const MeshNode *node = mesh_nodes + number;
    int last = octant->backward >> node->axis & 1 ? 0 : 1;
    for (int i = 0; i < 2; i++) {
        int child = i == 0 ? last : !last;
        vreal near = entry_of_child(node, slabs, octant, child);
        vreal far = vmin(exit_of_child(node, slabs, octant, child), found->limit);
        if (any_lane(m & found->alive & le(near, far))) {
            stack[waiting] = node->child[child];
            waiting++;
        }
    }
    return waiting;
}

/* Traverses the hierarchy over the instances with the rays of `m`, all of one octant. */
FN void traverse_instances(SCENE_PARAMETERS Findings *found, const WorldRays *world,
                           const Slabs *slabs, vmask m, const RayOctant *octant) {
    int stack[NODE_STACK(header)];
    int waiting = 1, item = 0, end = 0; /* items of a leaf */
    stack[0] = header->top_root;
    do {
        while (item == end && waiting > 0) {
            waiting--;
            int current = stack[waiting];
            if (current < 0) {
                item = ~current >> HD_LEAF_ITEM_BITS;
                end = item + (~current & HD_LEAF_ITEM_MASK);
            } else {
                waiting =
                    push_children(SCENE_ARGUMENTS found, slabs, m, octant, current, stack, waiting);
            }
        }
        if (item < end) {
            vmask alive = m & found->alive;
            search_instance(SCENE_ARGUMENTS found, world, &alive, top_items[item]);
            item++;
        }
    } while (item < end || waiting > 0);
}

FN void search_meshes(SCENE_PARAMETERS Findings *found, const WorldRays *world) {
    if (header->top_root < 0) {
        for (int i = 0; i < header->instance_count; i++) {
            vmask alive = found->alive;
            search_instance(SCENE_ARGUMENTS found, world, &alive, i);
        }
        return;
    }
    Slabs slabs = ray_slabs(world->origin, world->direction, splat(header->mesh_reach));
    DominantAxis unturned;
    unturned.x = unturned.y = mask_none();
    vmask left = found->alive;
    if (!must_visit(left))
        return;
    do {
        RayOctant octant;
        vmask same = same_octant(&slabs, unturned, left, &octant);
        left = lanes_after(left, same);
        traverse_instances(SCENE_ARGUMENTS found, world, &slabs, same, &octant);
    } while (any_lane(left));
}

/* ---- closest hits ---- */

/* Adds the meshes to a closest-hit search; a hit's face is then the number of the triangle. */
FN_NOINLINE void closest_mesh_hit(SCENE_PARAMETERS const Ray *ray, const LocalOrigin *local_origin,
                                  Hit *hit) {
    WorldRays world;
    world.origin = move_to_object(SCENE_ARGUMENTS * local_origin, ray->origin, header->floor_end);
    world.own_origin = ray->origin;
    world.direction = ray->direction;
    world.last_hit = local_origin->is_eye ? splat_int(-1) : ray->last_hit;
    world.face = ray->face;
    world.inside = ray->inside;
    world.is_shadow = 0;
    world.light_face[0] = world.light_face[1] = -1;
    Findings found;
    found.alive = ray->alive;
    found.limit = hit->t;
    found.object = hit->object;
    found.triangle = hit->face;
    found.entering = hit->entering;
    search_meshes(SCENE_ARGUMENTS & found, &world);
    hit->t = found.limit;
    hit->object = found.object;
    hit->face = found.triangle;
    hit->entering = found.entering;
}

/* ---- transmittance ---- */

/* Returns 2^-x of x = density 2^-24 + rest 2^-48, by the Taylor series about the middle of a factor
   of two. */
FN vreal passing_share(vint density, vint rest) {
    vreal one = splat(R(1.0));
    vint whole = density >> HD_DENSITY_BITS;
    vreal part =
        multiply_add(to_real(rest), splat(R(3.5527136788005009e-15)),
                     to_real(density & (HD_DENSITY_ONE - 1)) * splat(R(5.9604644775390625e-8)));
    vreal x = (splat(R(0.5)) - part) * splat(R(0.69314718055994530942));
    vreal share = one;
    for (int k = 14; k > 0; k--)
        share = multiply_add(share, x * splat(shared_quotient(R(1.0), (real)k)), one);
    share = share * splat(R(0.70710678118654752440));
    for (vint left = whole; any_lane(lt_int(splat_int(0), left)); left = left - 1)
        share = vselect(lt_int(splat_int(0), left), share * splat(R(0.5)), share);
    share = vselect(lt_int(splat_int(0), density), share, one); /* exactly 1 without filters */
    return vselect(lt_int(density, splat_int(HD_DARK_DENSITY)), share, splat(R(0.0)));
}

/* Computes the meshes' transmittance on the segments of `world`, in the lanes of `lit`. */
FN_NOINLINE void filter_by_meshes(SCENE_PARAMETERS const WorldRays *world, const vmask *lit,
                                  Vec3 *transmittance) {
    Findings found;
    found.alive = *lit;
    found.limit = splat(R(1.0));
    found.object = found.triangle = splat_int(-1);
    found.entering = mask_none();
    for (int channel = 0; channel < 3; channel++)
        found.density[channel] = found.rest[channel] = splat_int(0);
    search_meshes(SCENE_ARGUMENTS & found, world);
    vreal open = vselect(found.alive, splat(R(1.0)), splat(R(0.0)));
    vint most = max_int(found.density[0], max_int(found.density[1], found.density[2]));
    *transmittance = vec3(open, open, open);
    if (!any_lane(found.alive & lt_int(splat_int(0), most)))
        return;
    transmittance->x = open * passing_share(found.density[0], found.rest[0]);
    transmittance->y = open * passing_share(found.density[1], found.rest[1]);
    transmittance->z = open * passing_share(found.density[2], found.rest[2]);
}

/* Returns the meshes' transmittance between points of a surface and light number `light`;
   `to_light` is the vector from each point to the light. In the mesh that a ray leaves, all of it
   is moved by `lift`. */
FN Vec3 transmittance_of_meshes(SCENE_PARAMETERS Vec3 point, Vec3 lift, Vec3 to_light, vint object,
                                vint face, vmask inside, int light, vmask lit) {
    WorldRays world;
    Vec3 transmittance;
    LocalOrigin local_origin = local_origin_of(SCENE_ARGUMENTS object, 0);
    world.origin = move_to_object(SCENE_ARGUMENTS local_origin, point, header->floor_end);
    world.own_origin = vec3_add(point, lift);
    world.direction = to_light;
    world.last_hit = object;
    world.face = face;
    world.inside = inside;
    world.is_shadow = 1;
    world.light_face[0] = lights[light].own_face[0];
    world.light_face[1] = lights[light].own_face[1];
    filter_by_meshes(SCENE_ARGUMENTS & world, &lit, &transmittance);
    return transmittance;
}

#endif
