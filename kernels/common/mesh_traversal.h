/* SPDX-License-Identifier: MIT */
/* Tests of triangles against rays in one mesh, for the closest hit or for all filters of light.
   Then the parts that all traversals share, and that of a single lane; that of packets is in
   mesh_traversal_packet.h. */
#ifndef HD_MESH_TRAVERSAL_H
#define HD_MESH_TRAVERSAL_H

#include "pictures.h"

/* The state of a search. */
typedef struct {
    vmask alive;
    vreal limit;           /* maximum t: the closest hit so far, or the light */
    vint object, triangle; /* the closest hit */
    vmask entering;
    vint density[3], rest[3]; /* sum of optical densities (MeshMaterial.filter) */
} Findings;

/* The rays in a mesh's own coordinates. */
typedef struct {
    DominantAxis last; /* permutes origins and directions (triangle.h) */
    RayFrame frame;
    Slabs slabs;
    vmask own;     /* leaves this mesh */
    vint own_face; /* the face that it leaves, or -1 */
    vmask inside;  /* leaves on the inner side */
    int object;    /* number of the mesh among the objects */
    int first_face, first_mesh_material;
    int is_shadow;     /* collects filters of light, not the closest hit */
    int light_face[2]; /* the light's own faces, which do not occlude it; -1: none */
    real contact_squared;
} MeshRays;

/* ---- sides ---- */

/* Returns lanes whose origin is within rounding of the triangle's plane. */
FN vmask is_in_contact(const MeshRays *rays, const TriangleLanes *triangle) {
    Vec3 normal = normal_of(triangle);
    vreal away = vec3_dot(normal, vec3_sub(triangle->a, rays->frame.origin));
    return le(away * away, vec3_dot(normal, normal) * rays->contact_squared);
}

/* Returns `met` without false hits of rays that left a face of this mesh. Rays outside next hit an
   outer side, rays inside an inner side. If rounding puts their origin past a neighbouring face,
   they hit that from the wrong side, nearby. */
FN vmask leave_face(const MeshRays *rays, const TriangleLanes *triangle, vmask met,
                    vmask entering) {
    met = met & ~(rays->own & eq_int(triangle->face, rays->own_face));
    vmask wrong = met & rays->own & ~(entering ^ rays->inside);
    return any_lane(wrong) ? met & ~(wrong & is_in_contact(rays, triangle)) : met;
}

/* Tests triangles against the rays of `m` up to `limit`. A closest-hit search adds the distance's
   uncertainty to hits of the wrong side: if a ray hits both sides at an edge, the right one comes
   first. */
FN vmask meet_triangles(const MeshRays *rays, const TriangleLanes *triangle, vreal limit, vmask m,
                        TriangleCrossing *crossing) {
    vmask met = cross_triangle(&rays->frame, &rays->slabs, m, triangle->a, triangle->b, triangle->c,
                               crossing);
    met = met & le(splat(R(0.0)), crossing->t) & le(crossing->t, limit);
    if (any_lane(met & rays->own))
        met = leave_face(rays, triangle, met, crossing->entering);
    if (!rays->is_shadow) {
        vmask wrong = met & ~(crossing->entering ^ (rays->own & rays->inside));
        crossing->t = vselect(wrong, crossing->t + crossing->slack, crossing->t);
    }
    return met;
}

/* ---- the closest hit ---- */

/* Returns lanes with a closer hit; at equal distance the lower number wins. */
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
    found->limit = vselect(closer, crossing->t, found->limit);
    found->object = vselect_int(closer, splat_int(rays->object), found->object);
    found->triangle = vselect_int(closer, triangle->number, found->triangle);
    found->entering = vselect_mask(closer, crossing->entering, found->entering);
}

/* ---- filters of light ---- */

FN void keep_filter(GLOBAL const MeshMaterial *mesh_materials, Findings *found,
                    const MeshRays *rays, const TriangleLanes *triangle, vmask met,
                    const TriangleCrossing *crossing) {
    met = met & lt(crossing->t, found->limit) & found->alive;
    met = met & ~(eq_int(triangle->face, splat_int(rays->light_face[0])) |
                  eq_int(triangle->face, splat_int(rays->light_face[1])));
    vint most = splat_int(HD_OPAQUE_DENSITY);
    while (any_lane(met)) {
        int number = lane_int(&triangle->mesh_material, first_lane(met));
        GLOBAL const MeshMaterial *mesh_material = mesh_materials + number;
        vmask m = met & eq_int(triangle->mesh_material, splat_int(number));
        met = lanes_after(met, m);
        for (int channel = 0; channel < 3; channel++) {
            vint more =
                vselect_int(crossing->entering, splat_int(mesh_material->filter[0][channel]),
                            splat_int(mesh_material->filter[1][channel]));
            vint rest =
                vselect_int(crossing->entering, splat_int(mesh_material->filter_rest[0][channel]),
                            splat_int(mesh_material->filter_rest[1][channel]));
            rest = found->rest[channel] + vselect_int(m, rest, splat_int(0));
            vint sum = found->density[channel] + vselect_int(m, more, splat_int(0)) +
                       (rest >> HD_DENSITY_BITS);
            found->density[channel] = vselect_int(lt_int(sum, most), sum, most);
            found->rest[channel] = rest & (HD_DENSITY_ONE - 1);
        }
        vint opaque = vselect_int(crossing->entering, splat_int(mesh_material->filter[0][3]),
                                  splat_int(mesh_material->filter[1][3]));
        found->alive = found->alive & ~(m & lt_int(splat_int(0), opaque));
    }
}

/* ---- holes ---- */

/* Crossings of triangles of one instance, in the lanes of `met`. */
typedef struct {
    vmask met;
    vint triangle, mesh_material;
    vreal share[3];
} Crossings;

/* Drops crossings, of which there are some, in holes: where the picture that masks the material is
 * below a half. */
FN_NOINLINE void drop_holes(SCENE_PARAMETERS int number, Crossings *at) {
    GLOBAL const Instance *instance = instances + number;
    vmask left = at->met;
    do {
        int material = lane_int(&at->mesh_material, first_lane(left));
        vmask same = left & eq_int(at->mesh_material, splat_int(material));
        int mask = mesh_materials[material].mask;
        left = lanes_after(left, same);
        same = same & lt_int(splat_int(-1), splat_int(mask));
        if (must_visit(same)) {
            vreal u, v;
            vint triangle = vselect_int(same, at->triangle, splat_int(instance->first_triangle));
            vmask has =
                coordinates_in_picture(SCENE_ARGUMENTS instance, triangle, at->share, &u, &v);
            Vec3 opacity = sample_picture(pictures + (mask < 0 ? 0 : mask), texels, u, v);
            at->met = at->met & ~(same & has & lt(opacity.x, splat(R(0.5))));
        }
    } while (any_lane(left));
}

/* Returns `met` without the crossings in holes. The copies keep the callers' values in registers.
 */
FN vmask without_holes(SCENE_PARAMETERS const MeshRays *rays, const TriangleLanes *triangle,
                       vmask met, const TriangleCrossing *crossing) {
    Crossings at;
    at.met = met;
    at.triangle = triangle->number;
    at.mesh_material = triangle->mesh_material;
    for (int i = 0; i < 3; i++)
        at.share[i] = crossing->share[i];
    drop_holes(SCENE_ARGUMENTS rays->object - header->floor_end, &at);
    return at.met;
}

/* ---- leaves ---- */

FN void keep_crossing(SCENE_PARAMETERS Findings *found, const MeshRays *rays,
                      const TriangleLanes *triangle, vmask m) {
    TriangleCrossing crossing;
    vmask met = meet_triangles(rays, triangle, found->limit, m, &crossing);
    if (!any_lane(met))
        return;
    if (CUT_OUTS(header))
        met = without_holes(SCENE_ARGUMENTS rays, triangle, met, &crossing);
    if (rays->is_shadow)
        keep_filter(mesh_materials, found, rays, triangle, met, &crossing);
    else
        keep_closest(found, rays, triangle, met, &crossing);
}

/* ---- ray octants ---- */

/* The octant and dominant axis that rays share in a traversal. */
typedef struct {
    int axis[3];           /* axes of the mesh, the dominant one last */
    int entry[3], exit[3]; /* bound by which rays enter and leave a box on each axis: lower (0) or
                              upper (1) */
    int backward;          /* a bit for each axis of the mesh that rays run against */
} RayOctant;

/* Returns the lanes of `m` in the octant of the first one, and this octant. */
FN vmask same_octant(const Slabs *slabs, DominantAxis last, vmask m, RayOctant *octant) {
    int lane = first_lane(m);
    int x = (int)(lane_bits(last.x) >> lane & 1), y = (int)(lane_bits(last.y) >> lane & 1);
    m = m & (x ? last.x : ~last.x) & (y ? last.y : ~last.y);
    octant->backward = 0;
    for (int i = 0; i < 3; i++) {
        vmask against = slabs->negative[i];
        int negative = (int)(lane_bits(against) >> lane & 1);
        m = m & (negative ? against : ~against);
        octant->axis[i] = (i + (x ? 1 : y ? 2 : 0)) % 3;
        octant->entry[i] = negative;
        octant->exit[i] = !negative;
        octant->backward |= negative << octant->axis[i];
    }
    return m;
}

/* Tests `count` triangles, at least one, against rays of one octant. */
FN void try_triangles(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                      const RayOctant *octant, int first, int count) {
    int i = first;
    do {
        TriangleLanes triangle =
            same_triangle(triangles, i, octant->axis, rays->first_face, rays->first_mesh_material);
        keep_crossing(SCENE_ARGUMENTS found, rays, &triangle, m);
        i++;
    } while (i < first + count);
}

/* ---- nodes of two children ---- */

FN vreal entry_of_child(GLOBAL const MeshNode *node, const Slabs *slabs, const RayOctant *octant,
                        int child) {
    real x = node->bounds[octant->axis[0]][octant->entry[0]][child];
    real y = node->bounds[octant->axis[1]][octant->entry[1]][child];
    real z = node->bounds[octant->axis[2]][octant->entry[2]][child];
    vreal near = multiply_add(splat(x), slabs->inverse.x, slabs->near.x);
    near = vmax(near, multiply_add(splat(y), slabs->inverse.y, slabs->near.y));
    near = vmax(near, multiply_add(splat(z), slabs->inverse.z, slabs->near.z));
    return vmax(near, splat(R(0.0)));
}

FN vreal exit_of_child(GLOBAL const MeshNode *node, const Slabs *slabs, const RayOctant *octant,
                       int child) {
    real x = node->bounds[octant->axis[0]][octant->exit[0]][child];
    real y = node->bounds[octant->axis[1]][octant->exit[1]][child];
    real z = node->bounds[octant->axis[2]][octant->exit[2]][child];
    vreal far = multiply_add(splat(x), slabs->inverse.x, slabs->far.x);
    far = vmin(far, multiply_add(splat(y), slabs->inverse.y, slabs->far.y));
    return vmin(far, multiply_add(splat(z), slabs->inverse.z, slabs->far.z));
}

#if HD_LANES == 1

/* Special nodes, with numbers that no node or leaf has: none, and all triangles of a mesh without a
   hierarchy. */
enum { NO_NODE = -1, WHOLE_MESH = -2147483647 };

/* Searches one mesh with the ray of `m`: descends to a leaf, then tests its triangles, so that
   threads of a warp stay in step (Aila and Laine 2009). */
FN void search_mesh(SCENE_PARAMETERS Findings *found, const MeshRays *rays, vmask m,
                    GLOBAL const Instance *instance) {
    int stack[NODE_STACK(header)];
    vreal stack_near[NODE_STACK(header)];
    int waiting = 0, current = instance->root >= 0 ? instance->root : WHOLE_MESH;
    RayOctant octant;
    m = same_octant(&rays->slabs, rays->last, m, &octant);
    do {
        do {
            if (current == NO_NODE) {
                waiting--;
                current =
                    any_lane(le(stack_near[waiting], found->limit)) ? stack[waiting] : NO_NODE;
            }
            if (current >= 0) {
                GLOBAL const MeshNode *node = mesh_nodes + current;
                vreal near0 = entry_of_child(node, &rays->slabs, &octant, 0);
                vreal near1 = entry_of_child(node, &rays->slabs, &octant, 1);
                vreal far0 = vmin(exit_of_child(node, &rays->slabs, &octant, 0), found->limit);
                vreal far1 = vmin(exit_of_child(node, &rays->slabs, &octant, 1), found->limit);
                vmask alive = m & found->alive;
                int meets0 = any_lane(alive & le(near0, far0));
                int meets1 = any_lane(alive & le(near1, far1));
                int last = octant.backward >> node->axis & 1 ? 0 : 1; /* the farther child */
                if (meets0 && meets1) {
                    stack[waiting] = node->child[last];
                    stack_near[waiting] = last ? near1 : near0;
                    waiting++;
                }
                int next = meets0 && meets1 ? !last : meets1;
                current = meets0 || meets1 ? node->child[next] : NO_NODE;
            }
        } while (current >= 0 || (current == NO_NODE && waiting > 0));
        int first = ~current >> HD_LEAF_ITEM_BITS, count = ~current & HD_LEAF_ITEM_MASK;
        if (current == WHOLE_MESH) {
            first = instance->first_triangle;
            count = instance->triangle_count;
        }
        if (current != NO_NODE)
            try_triangles(SCENE_ARGUMENTS found, rays, m & found->alive, &octant, first, count);
        current = NO_NODE;
        waiting = any_lane(m & found->alive) ? waiting : 0;
    } while (waiting > 0);
}

#endif

#endif
