/* SPDX-License-Identifier: MIT */
/* The search of one mesh by a bundle of rays: for the closest hit, or for all that filters light.

   Rays that run the same way share a walk through the hierarchy. A bundle's nodes are wide: the
   lanes are a node's children, which all rays of a walk are tested against at once; where few rays
   are left each walks by itself, and the lanes are a leaf's triangles too. A single lane's nodes
   have two children. What is found does not depend on the way. */
#ifndef HD_MESH_SEARCH_H
#define HD_MESH_SEARCH_H

#include "triangle.h"

/* What the rays look for, and what was found. */
typedef struct {
    vmask alive;
    vreal limit;           /* nothing is looked for from here on: the closest hit so far, or
                              the light */
    vint object, triangle; /* the closest hit's */
    vmask entering;
    vint octaves[3], rest[3]; /* what filters light, added up (Skin.filter) */
} Findings;

/* The rays in a mesh's own coordinates. */
typedef struct {
    LastAxis last; /* origins and directions are turned by it (triangle.h) */
    RayFrame frame;
    Slabs slabs;
    vmask own;     /* leaves this very mesh, */
    vint own_face; /* this face of it, or -1, */
    vmask inside;  /* and on its inner side */
    int object;    /* number of the mesh among the objects */
    int first_face, first_skin;
    int is_shadow;     /* all that filters light is looked for, not the closest hit */
    int light_face[2]; /* a light's own faces are not in its way; -1: none */
    real contact_squared;
} MeshRays;

/* Which way rays run: what bundles have in common that share a walk. */
typedef struct {
    int axis[3];           /* of the mesh, the one nearest to the rays last */
    int entry[3], exit[3]; /* of a box they enter by the lower (0) or the upper bound of each */
    int backward;          /* a bit for each axis of the mesh: they run against it */
} Way;

/* The lanes of `m` whose rays run the same way as the first one's. */
FN vmask same_way(const Slabs *slabs, LastAxis last, vmask m, Way *way) {
    int lane = first_lane(m);
    int x = (int)(lane_bits(last.x) >> lane & 1), y = (int)(lane_bits(last.y) >> lane & 1);
    m = m & (x ? last.x : ~last.x) & (y ? last.y : ~last.y);
    way->backward = 0;
    for (int i = 0; i < 3; i++) {
        vmask against = slabs->negative[i];
        int negative = (int)(lane_bits(against) >> lane & 1);
        m = m & (negative ? against : ~against);
        way->axis[i] = (i + (x ? 1 : y ? 2 : 0)) % 3;
        way->entry[i] = negative;
        way->exit[i] = !negative;
        way->backward |= negative << way->axis[i];
    }
    return m;
}

/* Triangles of a mesh, one for all lanes or one for each. */
typedef struct {
    Vec3 a, b, c;
    vint number, face, skin;
} TriangleLanes;

/* Triangles of a group count as one face; others have a negative number each. */
FN vint face_of_triangle(vint number, vint group, int first_face) {
    vmask grouped = lt_int(splat_int(0), group);
    return pick_int(grouped, group + (first_face - 1), splat_int(-2) - number);
}

FN void name_triangles(TriangleLanes *lanes, vint number, vint tag, int first_face,
                       int first_skin) {
    vint group = tag & (HD_TRIANGLE_GROUPS - 1);
    lanes->number = number;
    lanes->skin = (tag >> HD_TRIANGLE_GROUP_BITS) + first_skin;
    lanes->face = face_of_triangle(number, group, first_face);
}

/* One triangle, its coordinates in the order of `axis`. */
FN TriangleLanes same_triangle(GLOBAL const Triangle *triangles, int number, const int axis[3],
                               int first_face, int first_skin) {
    GLOBAL const Triangle *triangle = triangles + number;
    TriangleLanes lanes;
    lanes.a = vec3_splat(triangle->a[axis[0]], triangle->a[axis[1]], triangle->a[axis[2]]);
    lanes.b = vec3_splat(triangle->b[axis[0]], triangle->b[axis[1]], triangle->b[axis[2]]);
    lanes.c = vec3_splat(triangle->c[axis[0]], triangle->c[axis[1]], triangle->c[axis[2]]);
    name_triangles(&lanes, splat_int(number), splat_int((int)triangle->tag), first_face,
                   first_skin);
    return lanes;
}

FN TriangleLanes fetch_triangles(GLOBAL const Triangle *triangles, vint number, int first_face,
                                 int first_skin) {
    GLOBAL const real *table = (GLOBAL const real *)triangles;
    vint place = number * 12;
    FourReals a = fetch_four_reals(table, place);
    FourReals b = fetch_four_reals(table, place + 4);
    FourReals c = fetch_four_reals(table, place + 8);
    TriangleLanes lanes;
    lanes.a = vec3(a.number[0], a.number[1], a.number[2]);
    lanes.b = vec3(b.number[0], b.number[1], b.number[2]);
    lanes.c = vec3(c.number[0], c.number[1], c.number[2]);
    name_triangles(&lanes, number, to_int(a.number[3]), first_face, first_skin);
    return lanes;
}

#if HD_LANES > 1
/* `count` triangles side by side, at most as many as there are lanes. */
FN TriangleLanes adjacent_triangles(GLOBAL const Triangle *triangles, int first, int count,
                                    const int axis[3], int first_face, int first_skin) {
    GLOBAL const real *row = (GLOBAL const real *)(triangles + first);
    FourReals a = load_rows(row, 12, count), b = load_rows(row + 4, 12, count);
    FourReals c = load_rows(row + 8, 12, count);
    TriangleLanes lanes;
    lanes.a = vec3(a.number[axis[0]], a.number[axis[1]], a.number[axis[2]]);
    lanes.b = vec3(b.number[axis[0]], b.number[axis[1]], b.number[axis[2]]);
    lanes.c = vec3(c.number[axis[0]], c.number[axis[1]], c.number[axis[2]]);
    name_triangles(&lanes, lane_numbers() + first, to_int(a.number[3]), first_face, first_skin);
    return lanes;
}
#endif

/* ---- sides ---- */

/* As long as twice the area. */
FN Vec3 normal_of(const TriangleLanes *triangle) {
    return vec3_cross(vec3_sub(triangle->b, triangle->a), vec3_sub(triangle->c, triangle->a));
}

/* The rays' origin is as near to the triangle's plane as rounding may put it. */
FN vmask is_in_contact(const MeshRays *rays, const TriangleLanes *triangle) {
    Vec3 normal = normal_of(triangle);
    vreal away = vec3_dot(normal, vec3_sub(triangle->a, rays->frame.origin));
    return le(away * away, vec3_dot(normal, normal) * rays->contact_squared);
}

/* What of `met` rays cross that left a face of this mesh. They meet its outer side next if they run
   outside, its inner side if they run inside: where rounding has put their origin past a neighbour
   of what they left, they meet that from the wrong side, nearby. */
FN vmask leave_face(const MeshRays *rays, const TriangleLanes *triangle, vmask met,
                    vmask entering) {
    met = met & ~(rays->own & eq_int(triangle->face, rays->own_face));
    vmask wrong = met & rays->own & ~(entering ^ rays->inside);
    return any_lane(wrong) ? met & ~(wrong & is_in_contact(rays, triangle)) : met;
}

/* Tries triangles, with the rays of `m`, for what is no further away than `limit`. The closest
   hit's search takes the wrong side of a surface to be further away by what the distance is
   uncertain: at an edge where both sides are met at once the right one is first. */
FN vmask meet_triangles(const MeshRays *rays, const TriangleLanes *triangle, vreal limit, vmask m,
                        TriangleCrossing *crossing) {
    vmask met = cross_triangle(&rays->frame, &rays->slabs, m, triangle->a, triangle->b, triangle->c,
                               crossing);
    met = met & le(splat(R(0.0)), crossing->t) & le(crossing->t, limit);
    if (any_lane(met & rays->own))
        met = leave_face(rays, triangle, met, crossing->entering);
    if (!rays->is_shadow) {
        vmask wrong = met & ~(crossing->entering ^ (rays->own & rays->inside));
        crossing->t = pick(wrong, crossing->t + crossing->slack, crossing->t);
    }
    return met;
}

/* ---- the closest hit ---- */

/* Of two hits at one distance that of the lower number counts. */
FN vmask is_closer(const Findings *found, vreal t, int object, vint triangle) {
    vmask level = ~lt(t, found->limit) & ~lt(found->limit, t);
    vmask same = eq_int(found->object, splat_int(object));
    vmask lower = (same & lt_int(triangle, found->triangle)) |
                  (~same & lt_int(splat_int(object), found->object));
    return lt(t, found->limit) | (level & lower);
}

FN void keep_closest(Findings *found, const MeshRays *rays, const TriangleLanes *triangle,
                     vmask met, const TriangleCrossing *crossing) {
    vmask closer = met & is_closer(found, crossing->t, rays->object, triangle->number);
    found->limit = pick(closer, crossing->t, found->limit);
    found->object = pick_int(closer, splat_int(rays->object), found->object);
    found->triangle = pick_int(closer, triangle->number, found->triangle);
    found->entering = pick_mask(closer, crossing->entering, found->entering);
}

/* ---- what filters light ---- */

FN void keep_filter(GLOBAL const Skin *skins, Findings *found, const MeshRays *rays,
                    const TriangleLanes *triangle, vmask met, const TriangleCrossing *crossing) {
    met = met & lt(crossing->t, found->limit) & found->alive;
    met = met & ~(eq_int(triangle->face, splat_int(rays->light_face[0])) |
                  eq_int(triangle->face, splat_int(rays->light_face[1])));
    vint most = splat_int(HD_OPAQUE_OCTAVES);
    while (any_lane(met)) {
        int number = lane_int(&triangle->skin, first_lane(met));
        GLOBAL const Skin *skin = skins + number;
        vmask m = met & eq_int(triangle->skin, splat_int(number));
        met = met & ~m;
        for (int channel = 0; channel < 3; channel++) {
            vint more = pick_int(crossing->entering, splat_int(skin->filter[0][channel]),
                                 splat_int(skin->filter[1][channel]));
            vint rest = pick_int(crossing->entering, splat_int(skin->filter_rest[0][channel]),
                                 splat_int(skin->filter_rest[1][channel]));
            rest = found->rest[channel] + pick_int(m, rest, splat_int(0));
            vint sum = found->octaves[channel] + pick_int(m, more, splat_int(0)) + (rest >> 24);
            found->octaves[channel] = pick_int(lt_int(sum, most), sum, most);
            found->rest[channel] = rest & (HD_OCTAVE - 1);
        }
        vint opaque = pick_int(crossing->entering, splat_int(skin->filter[0][3]),
                               splat_int(skin->filter[1][3]));
        found->alive = found->alive & ~(m & lt_int(splat_int(0), opaque));
    }
}

/* ---- leaves ---- */

FN void keep_crossing(SCENE_PARAMETERS Findings *found, const MeshRays *rays,
                      const TriangleLanes *triangle, vmask m) {
    TriangleCrossing crossing;
    vmask met = meet_triangles(rays, triangle, found->limit, m, &crossing);
    if (!any_lane(met))
        return;
    if (rays->is_shadow)
        keep_filter(skins, found, rays, triangle, met, &crossing);
    else
        keep_closest(found, rays, triangle, met, &crossing);
}

/* Tries the triangles of a leaf with rays that run one way. */
FN void try_leaf(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m, const Way *way,
                 int leaf) {
    int first = ~leaf >> HD_LEAF_ITEM_BITS, end = first + (~leaf & HD_LEAF_ITEM_MASK);
    for (int i = first; i < end; i++) {
        TriangleLanes triangle =
            same_triangle(triangles, i, way->axis, rays->first_face, rays->first_skin);
        keep_crossing(SCENE_ARGUMENTS found, rays, &triangle, m);
    }
}

/* Tries all triangles of a mesh with rays that run any way. */
FN void try_all(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m, int first,
                int count) {
    const int axis[3] = {0, 1, 2};
    for (int i = first; i < first + count; i++) {
        TriangleLanes triangle =
            same_triangle(triangles, i, axis, rays->first_face, rays->first_skin);
        triangle.a = turn(rays->last, triangle.a);
        triangle.b = turn(rays->last, triangle.b);
        triangle.c = turn(rays->last, triangle.c);
        keep_crossing(SCENE_ARGUMENTS found, rays, &triangle, m);
    }
}

#if HD_LANES > 1

/* Begins to load what a walk comes to later: a node, or the triangles of a leaf. */
FN void prefetch_place(SCENE_PARAMETERS int place) {
    enum { NODE_BYTES = 6 * HD_LANES * (int)sizeof(real), LEAF_BYTES = 192 };
    if (place < 0) {
        prefetch_bytes((GLOBAL const char *)(triangles + (~place >> HD_LEAF_ITEM_BITS)),
                       LEAF_BYTES);
        return;
    }
    prefetch_bytes((GLOBAL const char *)wide_bounds + (uint64)place * NODE_BYTES, NODE_BYTES);
    prefetch_bytes((GLOBAL const char *)(wide_children + (uint64)place * HD_LANES),
                   HD_LANES * (int)sizeof(int));
}

/* Where the bounds of an axis begin in a wide node, those of one side each. */
FN int place_of_bounds(const int side[3], const Way *way, int axis) {
    return (3 * side[axis] + way->axis[axis]) * HD_LANES;
}

/* ---- a ray by itself ---- */

FN vreal spread_real(vreal a, int lane) {
    return splat(lane_real(&a, lane));
}

FN Vec3 spread_vector(Vec3 a, int lane) {
    return vec3(spread_real(a.x, lane), spread_real(a.y, lane), spread_real(a.z, lane));
}

FN vmask spread_mask(uint bits, int lane) {
    return bits >> lane & 1 ? mask_all() : mask_none();
}

/* One lane's ray in all lanes. */
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
        one.octaves[channel] = one.rest[channel] = splat_int(0);
    return one;
}

/* Tries the triangles of a leaf side by side. What is found in the lanes is brought together, so
   that all of them hold it. */
FN void try_leaf_at_once(SCENE_PARAMETERS Findings *found, const MeshRays *ray, const Way *way,
                         int leaf) {
    int first = ~leaf >> HD_LEAF_ITEM_BITS, count = ~leaf & HD_LEAF_ITEM_MASK;
    for (int done = 0; done < count; done += HD_LANES) {
        int rest = count - done < HD_LANES ? count - done : HD_LANES;
        vmask m = lanes_below(rest);
        TriangleCrossing crossing;
        TriangleLanes triangle = adjacent_triangles(triangles, first + done, rest, way->axis,
                                                    ray->first_face, ray->first_skin);
        vmask met = meet_triangles(ray, &triangle, found->limit, m, &crossing);
        if (!any_lane(met))
            continue;
        if (ray->is_shadow) {
            keep_filter(skins, found, ray, &triangle, met, &crossing);
            if (any_lane(~found->alive))
                found->alive = mask_none();
            continue;
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
    }
}

/* The ray that all lanes of `ray` hold. */
FN void walk_alone(SCENE_PARAMETERS Findings *found, const MeshRays *ray, const Way *way,
                   int root) {
    int stack[WIDE_STACK];
    real stack_near[WIDE_STACK];
    int lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = place_of_bounds(way->entry, way, axis);
        upper[axis] = place_of_bounds(way->exit, way, axis);
    }
    int waiting = 1;
    stack[0] = root;
    stack_near[0] = R(0.0);
    while (waiting > 0) {
        waiting--;
        int current = stack[waiting];
        if (lane_real(&found->limit, 0) < stack_near[waiting])
            continue;
        if (current < 0) {
            try_leaf_at_once(SCENE_ARGUMENTS found, ray, way, current);
            if (ray->is_shadow && !any_lane(found->alive))
                return;
            continue;
        }
        GLOBAL const real *bounds = wide_bounds + (uint64)current * (6 * HD_LANES);
        const Slabs *slabs = &ray->slabs;
        vreal near = multiply_add(load_reals(bounds + lower[0]), slabs->inverse.x, slabs->near.x);
        vreal far = multiply_add(load_reals(bounds + upper[0]), slabs->inverse.x, slabs->far.x);
        near = greater(
            near, multiply_add(load_reals(bounds + lower[1]), slabs->inverse.y, slabs->near.y));
        far = lesser(far,
                     multiply_add(load_reals(bounds + upper[1]), slabs->inverse.y, slabs->far.y));
        near = greater(
            near, multiply_add(load_reals(bounds + lower[2]), slabs->inverse.z, slabs->near.z));
        far = lesser(far,
                     multiply_add(load_reals(bounds + upper[2]), slabs->inverse.z, slabs->far.z));
        near = greater(near, splat(R(0.0)));
        far = lesser(far, found->limit);
        int bottom = waiting;
        for (uint left = lane_bits(le(near, far)); left; left &= left - 1) {
            int lane = lowest_bit(left);
            real at = lane_real(&near, lane);
            int place = waiting;
            while (place > bottom && stack_near[place - 1] < at) {
                stack[place] = stack[place - 1];
                stack_near[place] = stack_near[place - 1];
                place--;
            }
            int child = wide_children[(uint64)current * HD_LANES + (uint64)lane];
            prefetch_place(SCENE_ARGUMENTS child);
            stack[place] = child;
            stack_near[place] = at;
            waiting++;
        }
    }
}

FN void search_alone(SCENE_PARAMETERS Findings *found, const MeshRays *rays, const Way *way,
                     int lane, int root) {
    MeshRays ray = spread_rays(rays, lane);
    Findings one = spread_findings(found, lane);
    walk_alone(SCENE_ARGUMENTS & one, &ray, way, root);
    vmask m = eq_int(lane_numbers(), splat_int(lane));
    if (rays->is_shadow) {
        for (int channel = 0; channel < 3; channel++) {
            int sum = 0, rest = 0;
            for (int i = 0; i < HD_LANES; i++) {
                sum += lane_int(&one.octaves[channel], i);
                sum = sum < HD_OPAQUE_OCTAVES ? sum : HD_OPAQUE_OCTAVES;
                rest += lane_int(&one.rest[channel], i);
            }
            rest += lane_int(&found->rest[channel], lane);
            sum += lane_int(&found->octaves[channel], lane) + (rest >> 24);
            sum = sum < HD_OPAQUE_OCTAVES ? sum : HD_OPAQUE_OCTAVES;
            rest &= HD_OCTAVE - 1;
            found->octaves[channel] = pick_int(m, splat_int(sum), found->octaves[channel]);
            found->rest[channel] = pick_int(m, splat_int(rest), found->rest[channel]);
        }
        found->alive = found->alive & (~m | one.alive);
        return;
    }
    found->limit = pick(m, one.limit, found->limit);
    found->object = pick_int(m, one.object, found->object);
    found->triangle = pick_int(m, one.triangle, found->triangle);
    found->entering = pick_mask(m, one.entering, found->entering);
}

/* ---- rays that share a walk ---- */

/* Fewer rays than these walk alone. */
enum { FEW_RAYS = HD_LANES / 8 + 1 };

/* What holds for all rays of a bundle, whose directions have the same signs: between which origins
   they begin, for where they enter and leave a box, and the least and greatest inverse of their
   directions. */
typedef struct {
    vreal first[3], last[3];
    vreal least[3], greatest[3];
    int entry[3], exit[3]; /* where the bounds begin in a node that they enter and leave by */
} Beam;

FN void bound_axis(Beam *beam, int axis, vreal origin, vreal inverse, vmask m, const Way *way,
                   real slack) {
    real least = least_lane(origin, m), greatest = greatest_lane(origin, m);
    int negative = way->entry[axis];
    beam->first[axis] = splat(negative ? least - slack : greatest + slack);
    beam->last[axis] = splat(negative ? greatest + slack : least - slack);
    beam->least[axis] = splat(least_lane(inverse, m));
    beam->greatest[axis] = splat(greatest_lane(inverse, m));
    beam->entry[axis] = place_of_bounds(way->entry, way, axis);
    beam->exit[axis] = place_of_bounds(way->exit, way, axis);
}

FN Beam beam_of(const MeshRays *rays, vmask m, const Way *way) {
    Vec3 origin = rays->frame.origin, inverse = rays->slabs.inverse;
    real far_out = greatest_lane(
        greater(absolute(origin.x), greater(absolute(origin.y), absolute(origin.z))), m);
    /* Twice what ray_slabs allows for each ray, since this rounds otherwise. */
    real slack = (far_out + R(1.0)) * (R(2.0) * SLAB_MARGIN);
    Beam beam;
    bound_axis(&beam, 0, origin.x, inverse.x, m, way, slack);
    bound_axis(&beam, 1, origin.y, inverse.y, m, way, slack);
    bound_axis(&beam, 2, origin.z, inverse.z, m, way, slack);
    return beam;
}

/* No ray of the beam meets the children's bounds of an axis earlier, or later. */
FN vreal beam_entry(const Beam *beam, GLOBAL const real *bounds, int axis) {
    vreal way = load_reals(bounds + beam->entry[axis]) - beam->first[axis];
    return lesser(way * beam->least[axis], way * beam->greatest[axis]);
}
FN vreal beam_exit(const Beam *beam, GLOBAL const real *bounds, int axis) {
    vreal way = load_reals(bounds + beam->exit[axis]) - beam->last[axis];
    return greater(way * beam->least[axis], way * beam->greatest[axis]);
}

/* Where each ray enters the box of a child, and leaves it. */
FN vreal ray_entry(const Beam *beam, GLOBAL const real *bounds, const Slabs *slabs) {
    vreal x = multiply_add(splat(bounds[beam->entry[0]]), slabs->inverse.x, slabs->near.x);
    vreal y = multiply_add(splat(bounds[beam->entry[1]]), slabs->inverse.y, slabs->near.y);
    vreal z = multiply_add(splat(bounds[beam->entry[2]]), slabs->inverse.z, slabs->near.z);
    return greater(greater(x, y), greater(z, splat(R(0.0))));
}
FN vreal ray_exit(const Beam *beam, GLOBAL const real *bounds, const Slabs *slabs) {
    vreal x = multiply_add(splat(bounds[beam->exit[0]]), slabs->inverse.x, slabs->far.x);
    vreal y = multiply_add(splat(bounds[beam->exit[1]]), slabs->inverse.y, slabs->far.y);
    vreal z = multiply_add(splat(bounds[beam->exit[2]]), slabs->inverse.z, slabs->far.z);
    return lesser(lesser(x, y), z);
}

/* The rays of `m`, which all run that way. */
FN void walk_wide(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m, const Way *way,
                  int root) {
    int stack[WIDE_STACK];
    vreal stack_near[WIDE_STACK]; /* beyond every limit in lanes that miss */
    real stack_key[WIDE_STACK];
    Beam beam = beam_of(rays, m, way);
    vreal furthest = splat(greatest_lane(found->limit, m));
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
        if (current >= 0 && count_bits(bits) < FEW_RAYS) {
            for (; bits; bits &= bits - 1)
                search_alone(SCENE_ARGUMENTS found, rays, way, lowest_bit(bits), current);
            continue;
        }
        if (current < 0) {
            try_leaf(SCENE_ARGUMENTS found, rays, alive, way, current);
            furthest = splat(greatest_lane(found->limit, m));
            continue;
        }
        GLOBAL const real *bounds = wide_bounds + (uint64)current * (6 * HD_LANES);
        vreal entry = greater(beam_entry(&beam, bounds, 0), beam_entry(&beam, bounds, 1));
        entry = greater(entry, greater(beam_entry(&beam, bounds, 2), splat(R(0.0))));
        vreal leave = lesser(beam_exit(&beam, bounds, 0), beam_exit(&beam, bounds, 1));
        leave = lesser(leave, lesser(beam_exit(&beam, bounds, 2), furthest));
        int bottom = waiting;
        for (uint left = lane_bits(le(entry, leave)); left; left &= left - 1) {
            int child = lowest_bit(left);
            vreal near = ray_entry(&beam, bounds + child, &rays->slabs);
            vreal far = lesser(ray_exit(&beam, bounds + child, &rays->slabs), found->limit);
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
            stack_near[place] = pick(meets, near, splat(REAL_LARGE * R(2.0)));
            stack_key[place] = key;
            waiting++;
        }
    }
}

#endif

/* ---- rays that share a walk ---- */

FN vreal entry_of_child(GLOBAL const MeshNode *node, const Slabs *slabs, const Way *way,
                        int child) {
    real x = node->bounds[way->axis[0]][way->entry[0]][child];
    real y = node->bounds[way->axis[1]][way->entry[1]][child];
    real z = node->bounds[way->axis[2]][way->entry[2]][child];
    vreal near = multiply_add(splat(x), slabs->inverse.x, slabs->near.x);
    near = greater(near, multiply_add(splat(y), slabs->inverse.y, slabs->near.y));
    near = greater(near, multiply_add(splat(z), slabs->inverse.z, slabs->near.z));
    return greater(near, splat(R(0.0)));
}

FN vreal exit_of_child(GLOBAL const MeshNode *node, const Slabs *slabs, const Way *way, int child) {
    real x = node->bounds[way->axis[0]][way->exit[0]][child];
    real y = node->bounds[way->axis[1]][way->exit[1]][child];
    real z = node->bounds[way->axis[2]][way->exit[2]][child];
    vreal far = multiply_add(splat(x), slabs->inverse.x, slabs->far.x);
    far = lesser(far, multiply_add(splat(y), slabs->inverse.y, slabs->far.y));
    return lesser(far, multiply_add(splat(z), slabs->inverse.z, slabs->far.z));
}

#if HD_LANES == 1

/* The rays of `m`, which all run that way. */
FN void walk_together(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                      const Way *way, int root) {
    int stack[NODE_STACK];
    vreal stack_near[NODE_STACK];
    int waiting = 0, current = root;
    for (;;) {
        int next = -1, has_next = 0;
        if (current >= 0) {
            GLOBAL const MeshNode *node = mesh_nodes + current;
            vreal near0 = entry_of_child(node, &rays->slabs, way, 0);
            vreal near1 = entry_of_child(node, &rays->slabs, way, 1);
            vreal far0 = lesser(exit_of_child(node, &rays->slabs, way, 0), found->limit);
            vreal far1 = lesser(exit_of_child(node, &rays->slabs, way, 1), found->limit);
            vmask alive = m & found->alive;
            int meets0 = any_lane(alive & le(near0, far0));
            int meets1 = any_lane(alive & le(near1, far1));
            int last = way->backward >> node->axis & 1 ? 0 : 1; /* further along the rays */
            if (meets0 && meets1) {
                stack[waiting] = node->child[last];
                stack_near[waiting] = last ? near1 : near0;
                waiting++;
                next = node->child[!last];
                has_next = 1;
            } else if (meets0 || meets1) {
                next = node->child[meets1 ? 1 : 0];
                has_next = 1;
            }
        } else {
            try_leaf(SCENE_ARGUMENTS found, rays, m & found->alive, way, current);
        }
        while (!has_next && waiting > 0) {
            waiting--;
            next = stack[waiting];
            vmask alive = m & found->alive;
            has_next = any_lane(alive & le(stack_near[waiting], found->limit));
        }
        RECONVERGE();
        if (!has_next)
            return;
        current = next;
    }
}

#endif

/* ---- the search ---- */

FN void search_hierarchy(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                         int root) {
    vmask left = m;
    while (any_lane(left)) {
        Way way;
        vmask same = same_way(&rays->slabs, rays->last, left, &way);
        left = left & ~same;
#if HD_LANES > 1
        walk_wide(SCENE_ARGUMENTS found, rays, same, &way, root);
#else
        walk_together(SCENE_ARGUMENTS found, rays, same, &way, root);
#endif
    }
}

/* Searches one mesh with the rays of `m`, whichever way it is laid out. */
FN void search_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                    GLOBAL const Instance *instance) {
    if (instance->root >= 0)
        search_hierarchy(SCENE_ARGUMENTS found, rays, m, instance->root);
    else
        try_all(SCENE_ARGUMENTS found, rays, m, instance->first_triangle, instance->triangle_count);
}

#endif
