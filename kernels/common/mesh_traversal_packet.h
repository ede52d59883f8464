/* SPDX-License-Identifier: MIT */
/* Traversal of a mesh by packets. Nodes are wide: lanes are a node's children, tested against all
   rays at once. When few rays are left, each traverses singly afterwards, and lanes are a leaf's
   triangles too. */
#ifndef HD_MESH_TRAVERSAL_PACKET_H
#define HD_MESH_TRAVERSAL_PACKET_H

#include "mesh_traversal.h"

#if HD_LANES > 1

/* Reals in the bounds of a wide node: lower and upper of each axis for each child. */
enum { WIDE_STRIDE = 6 * HD_LANES };

/* Prefetches a node, or the triangles of a leaf. */
FN void prefetch_place(SCENE_PARAMETERS int place) {
    enum { NODE_BYTES = WIDE_STRIDE * (int)sizeof(real), LEAF_BYTES = 192 };
    if (place < 0) {
        prefetch_bytes((GLOBAL const char *)(triangles + (~place >> HD_LEAF_ITEM_BITS)),
                       LEAF_BYTES);
        return;
    }
    prefetch_bytes((GLOBAL const char *)wide_bounds + (uint64)place * NODE_BYTES, NODE_BYTES);
    prefetch_bytes((GLOBAL const char *)(wide_children + (uint64)place * HD_LANES),
                   HD_LANES * (int)sizeof(int));
}

/* Returns where the bounds of an axis and side begin in a wide node. */
FN int place_of_bounds(const int side[3], const RayOctant *octant, int axis) {
    return (3 * side[axis] + octant->axis[axis]) * HD_LANES;
}

/* ---- one ray in all lanes ---- */

FN vreal spread_real(vreal a, int lane) {
    return splat(lane_real(&a, lane));
}

FN Vec3 spread_vector(Vec3 a, int lane) {
    return vec3(spread_real(a.x, lane), spread_real(a.y, lane), spread_real(a.z, lane));
}

FN vmask spread_mask(uint bits, int lane) {
    return bits >> lane & 1 ? mask_all() : mask_none();
}

/* Returns one lane's ray in all lanes. */
FN MeshRays spread_rays(const MeshRays *rays, int lane) {
    MeshRays one = *rays;
    one.frame.origin = spread_vector(rays->frame.origin, lane);
    one.frame.across = spread_real(rays->frame.across, lane);
    one.frame.upward = spread_real(rays->frame.upward, lane);
    one.frame.forward = spread_real(rays->frame.forward, lane);
    one.frame.backward = spread_mask(lane_bits(rays->frame.backward), lane);
    one.slabs.inverse = spread_vector(rays->slabs.inverse, lane);
    one.slabs.near = spread_vector(rays->slabs.near, lane);
    one.slabs.far = spread_vector(rays->slabs.far, lane);
    for (int axis = 0; axis < 3; axis++)
        one.slabs.negative[axis] = spread_mask(lane_bits(rays->slabs.negative[axis]), lane);
    one.own = spread_mask(lane_bits(rays->own), lane);
    one.inside = spread_mask(lane_bits(rays->inside), lane);
    one.own_face = splat_int(lane_int(&rays->own_face, lane));
    return one;
}

FN Findings spread_findings(const Findings *found, int lane) {
    Findings one;
    one.alive = mask_all();
    one.limit = spread_real(found->limit, lane);
    one.object = splat_int(lane_int(&found->object, lane));
    one.triangle = splat_int(lane_int(&found->triangle, lane));
    one.entering = spread_mask(lane_bits(found->entering), lane);
    for (int channel = 0; channel < 3; channel++)
        one.density[channel] = one.rest[channel] = splat_int(0);
    return one;
}

/* Returns the triangles `number` of the table, one in each lane. */
FN TriangleLanes triangles_at(GLOBAL const Triangle *triangles, vint number, int count,
                              const int axis[3], int first_face, int first_mesh_material) {
    GLOBAL const real *table = (GLOBAL const real *)triangles;
    vint place = number * TRIANGLE_STRIDE;
    FourReals a = load_rows(table, place, count);
    FourReals b = load_rows(table + CORNER_STRIDE, place, count);
    FourReals c = load_rows(table + 2 * CORNER_STRIDE, place, count);
    TriangleLanes lanes;
    lanes.a = vec3(a.number[axis[0]], a.number[axis[1]], a.number[axis[2]]);
    lanes.b = vec3(b.number[axis[0]], b.number[axis[1]], b.number[axis[2]]);
    lanes.c = vec3(c.number[axis[0]], c.number[axis[1]], c.number[axis[2]]);
    name_triangles(&lanes, number, to_int(a.number[3]), first_face, first_mesh_material);
    return lanes;
}

/* Appends a leaf's triangles to `count` others in the lanes; returns the new count. */
FN int add_leaf(vint *number, int count, int leaf) {
    int first = ~leaf >> HD_LEAF_ITEM_BITS, more = ~leaf & HD_LEAF_ITEM_MASK;
    vint added = min_int(lane_numbers() + (first - count), splat_int(first + more - 1));
    *number = vselect_int(lt_int(lane_numbers(), splat_int(count)), *number, added);
    return count + more;
}

/* Tests `count` triangles, one in each lane, and merges the findings into all lanes. Returns
   whether the ray hits anything. */
FN int try_triangle_lanes(SCENE_PARAMETERS Findings *found, const MeshRays *ray,
                          const RayOctant *octant, vint number, int count) {
    vmask m = lanes_below(count);
    TriangleCrossing crossing;
    TriangleLanes triangle = triangles_at(triangles, number, count, octant->axis, ray->first_face,
                                          ray->first_mesh_material);
    vmask met = meet_triangles(ray, &triangle, found->limit, m, &crossing);
    if (!any_lane(met))
        return 0;
    if (CUT_OUTS(header))
        met = without_holes(SCENE_ARGUMENTS ray, &triangle, met, &crossing);
    if (ray->is_shadow) {
        keep_filter(mesh_materials, found, ray, &triangle, met, &crossing);
        if (any_lane(~found->alive))
            found->alive = mask_none();
        return 1;
    }
    vmask closer = met & is_closer(found, crossing.t, ray->object, triangle.number);
    uint entering = lane_bits(crossing.entering);
    for (uint left = lane_bits(closer); left; left &= left - 1) {
        int lane = lowest_bit(left);
        vreal t = spread_real(crossing.t, lane);
        vint triangle_number = splat_int(lane_int(&triangle.number, lane));
        vmask best = is_closer(found, t, ray->object, triangle_number);
        if (!any_lane(best))
            continue;
        found->limit = t;
        found->object = splat_int(ray->object);
        found->triangle = triangle_number;
        found->entering = spread_mask(entering, lane);
    }
    return 1;
}

/* ---- single-ray traversal, interleaved ---- */

/* Maximum of nodes that a lane's ray defers. */
enum { MAX_SINGLES = 24 };

/* The nodes left for single-ray traversal: `capacity` entries for each lane, the nearest one last.
 */
typedef struct {
    int waiting[HD_LANES];
    RayOctant octant[HD_LANES];
    int *stack;
    real *stack_near;
    int capacity;
    uint lanes; /* lanes with entries */
} SingleRays;

/* Defers a node; nodes arrive in the order in which the ray meets them. */
FN void queue_single(SingleRays *singles, const RayOctant *octant, int lane, int node, real near) {
    int *stack = singles->stack + lane * singles->capacity;
    real *stack_near = singles->stack_near + lane * singles->capacity;
    int i = singles->waiting[lane]++;
    singles->octant[lane] = *octant;
    singles->lanes |= 1u << lane;
    for (; i > 0; i--) {
        stack[i] = stack[i - 1];
        stack_near[i] = stack_near[i - 1];
    }
    stack[0] = node;
    stack_near[0] = near;
}

FN int can_queue_single(const SingleRays *singles, uint bits) {
    for (; bits; bits &= bits - 1)
        if (singles->waiting[lowest_bit(bits)] == MAX_SINGLES)
            return 0;
    return 1;
}

/* Merges the findings of a single ray into `lane`. */
FN void merge_findings(Findings *found, const Findings *one, int is_shadow, int lane) {
    vmask m = eq_int(lane_numbers(), splat_int(lane));
    if (is_shadow) {
        for (int channel = 0; channel < 3; channel++) {
            int sum = 0, rest = 0;
            for (int i = 0; i < HD_LANES; i++) {
                sum += lane_int(&one->density[channel], i);
                sum = sum < HD_OPAQUE_DENSITY ? sum : HD_OPAQUE_DENSITY;
                rest += lane_int(&one->rest[channel], i);
            }
            rest += lane_int(&found->rest[channel], lane);
            sum += lane_int(&found->density[channel], lane) + (rest >> HD_DENSITY_BITS);
            sum = sum < HD_OPAQUE_DENSITY ? sum : HD_OPAQUE_DENSITY;
            rest &= HD_DENSITY_ONE - 1;
            found->density[channel] = vselect_int(m, splat_int(sum), found->density[channel]);
            found->rest[channel] = vselect_int(m, splat_int(rest), found->rest[channel]);
        }
        found->alive = found->alive & (~m | one->alive);
        return;
    }
    found->limit = vselect(m, one->limit, found->limit);
    found->object = vselect_int(m, one->object, found->object);
    found->triangle = vselect_int(m, one->triangle, found->triangle);
    found->entering = vselect_mask(m, one->entering, found->entering);
}

/* The stack of one lane's ray. */
typedef struct {
    int *node;
    real *near;
    int waiting;
} NodeStack;

/* Pops the top leaf and the leaves next to it while lanes are free for their triangles; returns the
   count of triangles, whose numbers it sets. */
FN int pop_leaves(NodeStack *stack, real limit, vint *number) {
    int current = stack->node[stack->waiting];
    int count = add_leaf(number, 0, current);
    if (count > HD_LANES) {
        int next = (~current >> HD_LEAF_ITEM_BITS) + HD_LANES;
        stack->node[stack->waiting++] = ~(next << HD_LEAF_ITEM_BITS | (count - HD_LANES));
        count = HD_LANES;
    }
    while (stack->waiting > 0 && stack->node[stack->waiting - 1] < 0 &&
           count + (~stack->node[stack->waiting - 1] & HD_LEAF_ITEM_MASK) <= HD_LANES) {
        stack->waiting--;
        if (stack->near[stack->waiting] <= limit)
            count = add_leaf(number, count, stack->node[stack->waiting]);
    }
    return count;
}

/* Tests leaves; returns whether the ray continues. */
FN int try_leaves(SCENE_PARAMETERS Findings *found, const MeshRays *rays, const RayOctant *octant,
                  NodeStack *stack, real limit, int lane) {
    vint number = splat_int(0);
    int count = pop_leaves(stack, limit, &number);
    MeshRays ray = spread_rays(rays, lane);
    Findings one = spread_findings(found, lane);
    if (!try_triangle_lanes(SCENE_ARGUMENTS & one, &ray, octant, number, count))
        return 1;
    merge_findings(found, &one, rays->is_shadow, lane);
    return !ray.is_shadow || any_lane(one.alive);
}

/* Returns the children of a node whose boxes one lane's ray meets, and their `entry`. */
FN vmask meet_children(const Slabs *slabs, const RayOctant *octant, GLOBAL const real *bounds,
                       real limit, int lane, vreal *entry) {
    int lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = place_of_bounds(octant->entry, octant, axis);
        upper[axis] = place_of_bounds(octant->exit, octant, axis);
    }
    Vec3 inverse = spread_vector(slabs->inverse, lane);
    Vec3 early = spread_vector(slabs->near, lane), late = spread_vector(slabs->far, lane);
    vreal near = multiply_add(load_reals(bounds + lower[0]), inverse.x, early.x);
    vreal far = multiply_add(load_reals(bounds + upper[0]), inverse.x, late.x);
    near = vmax(near, multiply_add(load_reals(bounds + lower[1]), inverse.y, early.y));
    far = vmin(far, multiply_add(load_reals(bounds + upper[1]), inverse.y, late.y));
    near = vmax(near, multiply_add(load_reals(bounds + lower[2]), inverse.z, early.z));
    far = vmin(far, multiply_add(load_reals(bounds + upper[2]), inverse.z, late.z));
    near = vmax(near, splat(R(0.0)));
    far = vmin(far, splat(limit));
    *entry = near;
    return le(near, far);
}

/* Pushes children of node `parent`, the nearest one last. */
FN void push_children_of(SCENE_PARAMETERS NodeStack *stack, int parent, vmask met, vreal entry) {
    int bottom = stack->waiting;
    for (uint left = lane_bits(met); left; left &= left - 1) {
        int number = lowest_bit(left);
        real at = lane_real(&entry, number);
        int place = stack->waiting;
        while (place > bottom && stack->near[place - 1] < at) {
            stack->node[place] = stack->node[place - 1];
            stack->near[place] = stack->near[place - 1];
            place--;
        }
        int child = wide_children[(uint64)parent * HD_LANES + (uint64)number];
        prefetch_place(SCENE_ARGUMENTS child);
        stack->node[place] = child;
        stack->near[place] = at;
        stack->waiting++;
    }
}

/* Advances a lane's ray by adjacent leaves or by a node; returns the height of its stack. */
FN int step_single(SCENE_PARAMETERS Findings *found, const MeshRays *rays, SingleRays *singles,
                   int lane) {
    NodeStack stack;
    stack.node = singles->stack + lane * singles->capacity;
    stack.near = singles->stack_near + lane * singles->capacity;
    stack.waiting = singles->waiting[lane];
    real limit = lane_real(&found->limit, lane);
    const RayOctant *octant = &singles->octant[lane];
    do {
        if (stack.waiting == 0)
            return 0;
        stack.waiting--;
    } while (limit < stack.near[stack.waiting]);
    int current = stack.node[stack.waiting];
    if (current < 0) {
        if (!try_leaves(SCENE_ARGUMENTS found, rays, octant, &stack, limit, lane))
            return 0;
    } else {
        vreal entry;
        vmask met = meet_children(&rays->slabs, octant, wide_bounds + (uint64)current * WIDE_STRIDE,
                                  limit, lane, &entry);
        push_children_of(SCENE_ARGUMENTS & stack, current, met, entry);
    }
    singles->waiting[lane] = stack.waiting;
    return stack.waiting;
}

/* Advances the rays interleaved, one step each: memory that a ray prefetched arrives while others
   work. */
FN void traverse_singles_interleaved(SCENE_PARAMETERS Findings *found, const MeshRays *rays,
                                     SingleRays *singles) {
    uint lanes = singles->lanes & lane_bits(found->alive);
    while (lanes)
        for (uint left = lanes; left; left &= left - 1) {
            int lane = lowest_bit(left);
            if (!step_single(SCENE_ARGUMENTS found, rays, singles, lane))
                lanes &= ~(1u << lane);
        }
}

/* ---- packet traversal ---- */

/* Fewer rays traverse singly, and so do rays that all deferred nearer nodes: a hit there may make
   the rest needless. */
enum { FEW_RAYS = HD_LANES / 8 + 1 };

/* Bounds of all rays of a packet, which share an octant: origins, for entry and exit of a box, and
   the minimum and maximum inverse of their directions. */
typedef struct {
    vreal first[3], last[3];
    vreal least[3], greatest[3];
    int entry[3], exit[3]; /* offsets of the bounds in a node by which rays enter and leave */
} Beam;

FN void bound_axis(Beam *beam, int axis, vreal origin, vreal inverse, vmask m,
                   const RayOctant *octant, real slack) {
    real least = min_lane(origin, m), greatest = max_lane(origin, m);
    int negative = octant->entry[axis];
    beam->first[axis] = splat(negative ? least - slack : greatest + slack);
    beam->last[axis] = splat(negative ? greatest + slack : least - slack);
    beam->least[axis] = splat(min_lane(inverse, m));
    beam->greatest[axis] = splat(max_lane(inverse, m));
    beam->entry[axis] = place_of_bounds(octant->entry, octant, axis);
    beam->exit[axis] = place_of_bounds(octant->exit, octant, axis);
}

FN Beam beam_of(const MeshRays *rays, vmask m, const RayOctant *octant) {
    Vec3 origin = rays->frame.origin, inverse = rays->slabs.inverse;
    real far_out =
        max_lane(vmax(absolute(origin.x), vmax(absolute(origin.y), absolute(origin.z))), m);
    /* Twice the margin of ray_slabs, as this rounds differently. */
    real slack = (far_out + R(1.0)) * (R(2.0) * ROUNDING_MARGIN);
    Beam beam;
    bound_axis(&beam, 0, origin.x, inverse.x, m, octant, slack);
    bound_axis(&beam, 1, origin.y, inverse.y, m, octant, slack);
    bound_axis(&beam, 2, origin.z, inverse.z, m, octant, slack);
    return beam;
}

/* Return bounds of t at which rays of the beam enter and leave the children's slab of an axis. */
FN vreal beam_entry(const Beam *beam, GLOBAL const real *bounds, int axis) {
    vreal octant = load_reals(bounds + beam->entry[axis]) - beam->first[axis];
    return vmin(octant * beam->least[axis], octant * beam->greatest[axis]);
}
FN vreal beam_exit(const Beam *beam, GLOBAL const real *bounds, int axis) {
    vreal octant = load_reals(bounds + beam->exit[axis]) - beam->last[axis];
    return vmax(octant * beam->least[axis], octant * beam->greatest[axis]);
}

/* Return t at which each ray enters and leaves the box of a child. */
FN vreal ray_entry(const Beam *beam, GLOBAL const real *bounds, const Slabs *slabs) {
    vreal x = multiply_add(splat(bounds[beam->entry[0]]), slabs->inverse.x, slabs->near.x);
    vreal y = multiply_add(splat(bounds[beam->entry[1]]), slabs->inverse.y, slabs->near.y);
    vreal z = multiply_add(splat(bounds[beam->entry[2]]), slabs->inverse.z, slabs->near.z);
    return vmax(vmax(x, y), vmax(z, splat(R(0.0))));
}
FN vreal ray_exit(const Beam *beam, GLOBAL const real *bounds, const Slabs *slabs) {
    vreal x = multiply_add(splat(bounds[beam->exit[0]]), slabs->inverse.x, slabs->far.x);
    vreal y = multiply_add(splat(bounds[beam->exit[1]]), slabs->inverse.y, slabs->far.y);
    vreal z = multiply_add(splat(bounds[beam->exit[2]]), slabs->inverse.z, slabs->far.z);
    return vmin(vmin(x, y), z);
}

/* Traverses a mesh with the rays of `m`, all of one octant; defers single rays. */
FN void traverse_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                      const RayOctant *octant, int root, SingleRays *singles) {
    int stack[WIDE_STACK(header)];
    vreal stack_near[WIDE_STACK(header)]; /* above every limit in lanes that miss */
    real stack_key[WIDE_STACK(header)];
    Beam beam = beam_of(rays, m, octant);
    vreal furthest = splat(max_lane(found->limit, m));
    int waiting = 1;
    stack[0] = root;
    stack_near[0] = splat(R(0.0));
    stack_key[0] = R(0.0);
    while (waiting > 0) {
        waiting--;
        int current = stack[waiting];
        vmask alive = m & found->alive & le(stack_near[waiting], found->limit);
        uint bits = lane_bits(alive);
        if (!bits)
            continue;
        if (FEW_RAYS > 1 && current >= 0 &&
            (count_bits(bits) < FEW_RAYS || !(bits & ~singles->lanes)) &&
            can_queue_single(singles, bits)) {
            for (; bits; bits &= bits - 1) {
                int lane = lowest_bit(bits);
                queue_single(singles, octant, lane, current, lane_real(&stack_near[waiting], lane));
            }
            continue;
        }
        if (current < 0) {
            try_triangles(SCENE_ARGUMENTS found, rays, alive, octant, ~current >> HD_LEAF_ITEM_BITS,
                          ~current & HD_LEAF_ITEM_MASK);
            furthest = splat(max_lane(found->limit, m));
            continue;
        }
        GLOBAL const real *bounds = wide_bounds + (uint64)current * WIDE_STRIDE;
        vreal entry = vmax(beam_entry(&beam, bounds, 0), beam_entry(&beam, bounds, 1));
        entry = vmax(entry, vmax(beam_entry(&beam, bounds, 2), splat(R(0.0))));
        vreal leave = vmin(beam_exit(&beam, bounds, 0), beam_exit(&beam, bounds, 1));
        leave = vmin(leave, vmin(beam_exit(&beam, bounds, 2), furthest));
        int bottom = waiting;
        for (uint left = lane_bits(le(entry, leave)); left; left &= left - 1) {
            int child = lowest_bit(left);
            vreal near = ray_entry(&beam, bounds + child, &rays->slabs);
            vreal far = vmin(ray_exit(&beam, bounds + child, &rays->slabs), found->limit);
            vmask meets = alive & le(near, far);
            if (!any_lane(meets))
                continue;
            real key = lane_real(&entry, child);
            int place = waiting;
            while (place > bottom && stack_key[place - 1] < key) {
                stack[place] = stack[place - 1];
                stack_near[place] = stack_near[place - 1];
                stack_key[place] = stack_key[place - 1];
                place--;
            }
            stack[place] = wide_children[(uint64)current * HD_LANES + (uint64)child];
            prefetch_place(SCENE_ARGUMENTS stack[place]);
            stack_near[place] = vselect(meets, near, splat(REAL_LARGE * R(2.0)));
            stack_key[place] = key;
            waiting++;
        }
    }
}

FN void search_hierarchy(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                         int root) {
    int stack[HD_LANES * (WIDE_STACK(header) + MAX_SINGLES)];
    real stack_near[HD_LANES * (WIDE_STACK(header) + MAX_SINGLES)];
    SingleRays singles;
    singles.lanes = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        singles.waiting[lane] = 0;
    singles.capacity = WIDE_STACK(header) + MAX_SINGLES;
    singles.stack = stack;
    singles.stack_near = stack_near;
    vmask left = m;
    while (any_lane(left)) {
        RayOctant octant;
        vmask same = same_octant(&rays->slabs, rays->last, left, &octant);
        left = left & ~same;
        traverse_mesh(SCENE_ARGUMENTS found, rays, same, &octant, root, &singles);
    }
    if (FEW_RAYS > 1)
        traverse_singles_interleaved(SCENE_ARGUMENTS found, rays, &singles);
}

/* Tests all triangles of a mesh against rays of any octant. */
FN void try_all(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m, int first,
                int count) {
    const int axis[3] = {0, 1, 2};
    for (int i = first; i < first + count; i++) {
        TriangleLanes triangle =
            same_triangle(triangles, i, axis, rays->first_face, rays->first_mesh_material);
        triangle.a = turn(rays->last, triangle.a);
        triangle.b = turn(rays->last, triangle.b);
        triangle.c = turn(rays->last, triangle.c);
        keep_crossing(SCENE_ARGUMENTS found, rays, &triangle, m);
    }
}

/* Searches one mesh, with or without a hierarchy, with the rays of `m`. */
FN void search_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                    GLOBAL const Instance *instance) {
    if (instance->root >= 0)
        search_hierarchy(SCENE_ARGUMENTS found, rays, m, instance->root);
    else
        try_all(SCENE_ARGUMENTS found, rays, m, instance->first_triangle, instance->triangle_count);
}

#endif

#endif
