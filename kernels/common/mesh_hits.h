/* SPDX-License-Identifier: MIT */
/* Triangles tried with rays of one mesh: which count as met, and what is kept of those: the closest
   hit, or all that filters light. */
#ifndef HD_MESH_HITS_H
#define HD_MESH_HITS_H

#include "mesh_triangles.h"

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

/* ---- sides ---- */

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
        met = lanes_after(met, m);
        for (int channel = 0; channel < 3; channel++) {
            vint more = pick_int(crossing->entering, splat_int(skin->filter[0][channel]),
                                 splat_int(skin->filter[1][channel]));
            vint rest = pick_int(crossing->entering, splat_int(skin->filter_rest[0][channel]),
                                 splat_int(skin->filter_rest[1][channel]));
            rest = found->rest[channel] + pick_int(m, rest, splat_int(0));
            vint sum = found->octaves[channel] + pick_int(m, more, splat_int(0)) +
                       (rest >> HD_OCTAVE_BITS);
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

#endif
