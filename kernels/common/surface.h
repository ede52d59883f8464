/* SPDX-License-Identifier: MIT */
/* The surface at a hit: normal, material, and the patterns on a face, its rim and its edge lights'
   discs. */
#ifndef HD_SURFACE_H
#define HD_SURFACE_H

#include "meshes.h"

/* ---- the floor's texture ---- */

/* Computes the texture coordinates, in the unit square, of a point of the floor. With h = (a, b) -
   origin, t solves k2 t^2 + k1 t + k0 = 0. The root inside a convex quadrilateral is the one at
   which the map's determinant, k1 + 2 k2 t, has the sign of the orientation. The form of the root
   that adds numbers of equal sign also covers k2 = 0. */
FN void floor_coordinates(GLOBAL const FloorMap *map, Vec3 point, vreal *s, vreal *t) {
    Vec3 axis_a = vec3_of(map->axis_a);
    Vec3 axis_b = vec3_of(map->axis_b);
    vreal ha = vec3_dot(axis_a, point) - splat(map->origin[0]);
    vreal hb = vec3_dot(axis_b, point) - splat(map->origin[1]);
    vreal ea = splat(map->e[0]), eb = splat(map->e[1]);
    vreal fa = splat(map->f[0]), fb = splat(map->f[1]);
    vreal ga = splat(map->g[0]), gb = splat(map->g[1]);
    vreal k2 = multiply_add(ga, fb, -(gb * fa));
    vreal k1 = multiply_add(ea, fb, -(eb * fa)) + multiply_add(ha, gb, -(hb * ga));
    vreal k0 = multiply_add(ha, eb, -(hb * ea));
    vreal discriminant = vmax(multiply_add(k1, k1, k2 * k0 * R(-4.0)), splat(R(0.0)));
    vreal root = square_root(discriminant) * map->orientation;
    vmask same_sign = le(splat(R(0.0)), k1 * root);
    *t = clamp_unit(
        vselect(same_sign, quotient(k0 * R(-2.0), k1 + root), quotient(root - k1, k2 * R(2.0))));
    vreal da = multiply_add(*t, ga, ea), db = multiply_add(*t, gb, eb);
    vreal na = multiply_add(-*t, fa, ha), nb = multiply_add(-*t, fb, hb);
    vmask use_a = lt(db * db, da * da);
    *s = clamp_unit(quotient(vselect(use_a, na, nb), vselect(use_a, da, db)));
}

FN void parallelogram_coordinates(GLOBAL const FloorMap *map, Vec3 point, vreal *s, vreal *t) {
    Vec3 axis_s = vec3_of(map->axis_s);
    Vec3 axis_t = vec3_of(map->axis_t);
    *s = clamp_unit(vec3_dot(axis_s, point) + splat(map->start[0]));
    *t = clamp_unit(vec3_dot(axis_t, point) + splat(map->start[1]));
}

/* ---- materials ---- */

/* The terms of a material in lanes, X(type, select, name, of, none). They give the function that
   selects it, its value from the row `material`, and that of a surface that reflects and transmits
   nothing. Rays in the lanes of `entering` hit the outer side. Reflection, transmission and the
   relative index are those of the side that the ray comes from. */
#define HD_LANE_TERMS(X)                                                                           \
    X(Vec3, vec3_select, colour, vec3_of(material->colour), vec3_zero())                           \
    X(Vec3, vec3_select, mirror_tint, vec3_of(material->mirror_tint), vec3_zero())                 \
    X(vreal, vselect, ambient, splat(material->ambient), splat(R(0.0)))                            \
    X(vreal, vselect, diffuse, splat(material->diffuse), splat(R(0.0)))                            \
    X(vreal, vselect, specular, splat(material->specular), splat(R(0.0)))                          \
    X(vreal, vselect, min_highlight, splat(material->min_highlight), splat(REAL_LARGE))            \
    X(vreal, vselect, reflection,                                                                  \
      vselect(entering, splat(material->reflection), splat(material->inner_reflection)),           \
      splat(R(0.0)))                                                                               \
    X(vreal, vselect, transmission,                                                                \
      vselect(entering, splat(material->transmission), splat(material->inner_transmission)),       \
      splat(R(0.0)))                                                                               \
    X(vreal, vselect, relative_index,                                                              \
      vselect(entering, splat(material->inverse_index), splat(material->index_of_refraction)),     \
      splat(R(1.0)))                                                                               \
    X(vmask, vselect_mask, lit_from_behind, material->lit_from_behind ? mask_all() : mask_none(),  \
      mask_none())                                                                                 \
    X(vint, vselect_int, shininess, splat_int(material->shininess), splat_int(1))

#define HD_TERM_MEMBER(type, select_term, name, of, none) type name;
#define HD_TERM_OF(type, select_term, name, of, none)     lanes.name = of;
#define HD_TERM_NONE(type, select_term, name, of, none)   lanes.name = none;
#define HD_TERM_PICKED(type, select_term, name, of, none)                                          \
    lanes.name = select_term(m, a.name, b.name);

typedef struct {
    HD_LANE_TERMS(HD_TERM_MEMBER)
} LaneMaterial;

typedef struct {
    Vec3 point;  /* relative to the hit object or mesh instance */
    Vec3 normal; /* unit, towards the viewer */
    Vec3 lift;   /* to the smooth surface, on which shadow rays of the mesh itself begin */
    Vec3 emission;
    LaneMaterial material;
} Surface;

/* Returns a material that reflects and transmits nothing. */
FN LaneMaterial no_material(void) {
    LaneMaterial lanes;
    HD_LANE_TERMS(HD_TERM_NONE)
    return lanes;
}

FN LaneMaterial splat_material(GLOBAL const Material *material, vmask entering) {
    LaneMaterial lanes;
    HD_LANE_TERMS(HD_TERM_OF)
    return lanes;
}

FN LaneMaterial select_material(vmask m, LaneMaterial a, LaneMaterial b) {
    LaneMaterial lanes;
    HD_LANE_TERMS(HD_TERM_PICKED)
    return lanes;
}

FN void set_material(Surface *surface, vmask m, LaneMaterial material) {
    surface->material = select_material(m, material, surface->material);
}

/* Returns the lanes whose point is within the radius of one of the edge's lights. */
FN vmask on_disc(GLOBAL const Object *solid, GLOBAL const Edge *edge, Vec3 point) {
    real count = (real)solid->lights_per_edge;
    real spacing = shared_quotient(R(2.0) * solid->edge_half_length, count);
    Vec3 direction = vec3_of(edge->direction);
    Vec3 middle = vec3_of(edge->middle);
    Vec3 offset = vec3_sub(point, middle);
    vreal along = vec3_dot(offset, direction);
    vreal cell = quotient(along + splat(solid->edge_half_length), splat(spacing));
    cell = vmin(vmax(cell, splat(R(0.0))), splat(count - R(1.0)));
    vreal light =
        (to_real(to_int(cell)) + splat(R(0.5))) * spacing - splat(solid->edge_half_length);
    Vec3 distance = vec3_scale_add(direction, -light, offset);
    return lt(vec3_dot(distance, distance), splat(solid->disc_radius_squared));
}

/* Sets the emission of points on discs, which neither reflect nor transmit. */
FN void show_discs(GLOBAL const Object *solid, GLOBAL const Edge *edges, vmask m,
                   Surface *surface) {
    vmask shown = mask_none();
    vreal reach = splat(solid->disc_reach_squared);
    for (int e = solid->first_edge; e < solid->first_edge + solid->edge_count; e++) {
        GLOBAL const Edge *edge = edges + e;
        Vec3 from_middle = vec3_sub(surface->point, vec3_of(edge->middle));
        if (!any_lane(m & lt(vec3_dot(from_middle, from_middle), reach)))
            continue;
        vmask disc = m & on_disc(solid, edge, surface->point);
        Vec3 radiance = vec3_of(edge->disc_radiance);
        surface->emission = vec3_select(disc, radiance, surface->emission);
        shown = shown | disc;
    }
    set_material(surface, shown, no_material());
}

/* Returns the signed distance of a point of a solid to one of its planes, negative inside. */
FN vreal nearness(GLOBAL const Object *solid, GLOBAL const Plane *plane, vreal coordinate) {
    return (solid->paired ? absolute(coordinate) : coordinate) - splat(plane->distance);
}

FN void describe_solid(SCENE_PARAMETERS int object, vmask m, const Hit *hit, Surface *surface) {
    GLOBAL const Object *solid = objects + object;
    vint met_plane = hit->face >> 1;
    vreal nearest = splat(-REAL_LARGE); /* of the other planes */
    Vec3 normal = vec3_zero();
    for (int k = solid->first_plane; k < solid->first_plane + solid->plane_count; k++) {
        GLOBAL const Plane *plane = planes + k;
        vmask met = eq_int(met_plane, splat_int(k));
        normal = vec3_select(met, vec3_splat(plane->x, plane->y, plane->z), normal);
        vreal near = nearness(solid, plane, along_normal(plane, surface->point));
        nearest = vselect(met, nearest, vmax(near, nearest));
    }
    /* The second of two planes faces against the normal. */
    vmask second = ~eq_int(hit->face & 1, splat_int(0));
    vreal towards_viewer = vselect(second ^ hit->entering, splat(R(1.0)), splat(R(-1.0)));
    surface->normal = vec3_select(m, vec3_scale(normal, towards_viewer), surface->normal);
    set_material(surface, m, splat_material(materials + solid->face_material, hit->entering));
    vmask rim = m & lt(splat(-solid->rim_depth), nearest);
    if (any_lane(rim))
        set_material(surface, rim, splat_material(materials + solid->rim_material, hit->entering));
    vmask near_edge = m & lt(splat(-solid->disc_depth), nearest);
    if (any_lane(near_edge))
        show_discs(solid, edges, near_edge, surface);
}

FN void describe_floor(SCENE_PARAMETERS int object, vmask m, const Hit *hit, Surface *surface) {
    GLOBAL const Object *floor = objects + object;
    GLOBAL const Plane *plane = planes + floor->first_plane;
    Vec3 normal = vec3_splat(plane->x, plane->y, plane->z);
    surface->normal =
        vec3_select(m, vec3_scale(normal, vselect(hit->entering, splat(R(1.0)), splat(R(-1.0)))),
                    surface->normal);
    /* A floor has no inner side, whichever way its normal points. */
    set_material(surface, m, splat_material(materials + floor->face_material, mask_all()));
    if (floor_map->picture >= 0) {
        vreal s, t;
        if (floor_map->is_parallelogram)
            parallelogram_coordinates(floor_map, surface->point, &s, &t);
        else
            floor_coordinates(floor_map, surface->point, &s, &t);
        Vec3 texel = sample_picture(pictures + floor_map->picture, texels, s, t);
        LaneMaterial *material = &surface->material;
        material->colour = vec3_select(m, vec3_mul(material->colour, texel), material->colour);
    }
}

/* ---- meshes ---- */

/* Returns the unit vector; no component may be much smaller than the minimum normal number's root.
 */
FN Vec3 direction_of(Vec3 v) {
    vreal most = vmax(absolute(v.x), vmax(absolute(v.y), absolute(v.z)));
    return vec3_normalize(vec3_scale(v, reciprocal(most)));
}

/* Returns the way of a point of a triangle to the tangent plane of a corner, if that plane lies
   above it, times the corner's share. All are in the mesh. */
FN Vec3 way_to_tangent(Vec3 point, Vec3 corner, Vec3 normal, vreal share, vreal towards) {
    vreal above = vec3_dot(normal, vec3_sub(corner, point)) * towards;
    return vec3_scale(normal, vmax(above, splat(R(0.0))) * towards * share);
}

/* Returns the blend of the corners' normals, if the triangle has any, the viewer sees the front of
   the surface and a mirrored ray stays on it; otherwise `flat`. All normals point towards the
   viewer. Sets `lift` to the way, in the mesh, to the surface that such normals have (Hanika 2021,
   Hacking the Shadow Terminator); 0 with `flat`. */
FN Vec3 smooth_normal(SCENE_PARAMETERS GLOBAL const Instance *instance,
                      const TriangleLanes *triangle, vmask entering,
                      const TriangleCrossing *crossing, Vec3 direction, Vec3 flat, Vec3 *lift) {
    vint within = triangle->number - instance->first_triangle;
    *lift = vec3_zero();
    enum { NORMAL_STRIDE = sizeof(Vector) / sizeof(real) };
    FourWords corner = fetch_corner_words(corner_normals, instance->first_corner_normals, within);
    vmask has = ~lt_int(corner.word[0], splat_int(0));
    if (!any_lane(has))
        return flat;
    GLOBAL const real *table = (GLOBAL const real *)mesh_normals;
    const vreal *share = crossing->share;
    Vec3 sum = vec3_zero(), ways = vec3_zero();
    Vec3 point =
        vec3_scale_add(triangle->a, share[0],
                       vec3_scale_add(triangle->b, share[1], vec3_scale(triangle->c, share[2])));
    vreal towards = vselect(entering, splat(R(1.0)), splat(R(-1.0)));
    for (int i = 0; i < 3; i++) {
        vint place = vselect_int(has, corner.word[i], splat_int(0)) * NORMAL_STRIDE;
        FourReals n = fetch_four_reals(table, place);
        Vec3 normal = vec3(n.number[0], n.number[1], n.number[2]);
        Vec3 at = i == 0 ? triangle->a : i == 1 ? triangle->b : triangle->c;
        sum = vec3_scale_add(normal, share[i], sum);
        ways = vec3_add(ways, way_to_tangent(point, at, normal, share[i], towards));
    }
    Vec3 smooth = vec3_scale(direction_of(transform_normal(instance->to_mesh, sum)), towards);
    vreal facing = vec3_dot(smooth, direction);
    Vec3 mirrored = vec3_scale_add(smooth, facing * R(-2.0), direction);
    vmask sound = has & lt(facing, splat(R(0.0))) & lt(splat(R(0.0)), vec3_dot(mirrored, flat));
    *lift = vec3_select(sound, ways, *lift);
    return vec3_select(sound, smooth, flat);
}

/* Returns the colour of a mesh material's picture; white without one. */
FN Vec3 colour_of_picture(SCENE_PARAMETERS GLOBAL const Instance *instance,
                          GLOBAL const MeshMaterial *mesh_material, vint triangle,
                          const TriangleCrossing *crossing) {
    Vec3 white = vec3_splat(R(1.0), R(1.0), R(1.0));
    vreal u, v;
    if (mesh_material->picture < 0 || instance->first_corner_uvs < 0)
        return white;
    vmask has = coordinates_in_picture(SCENE_ARGUMENTS instance, triangle, crossing->share, &u, &v);
    return vec3_select(has, sample_picture(pictures + mesh_material->picture, texels, u, v), white);
}

/* Returns the blend of the corners' colours of a mesh that has them. */
FN Vec3 colour_of_corners(SCENE_PARAMETERS GLOBAL const Instance *instance, vint triangle,
                          const TriangleCrossing *crossing) {
    enum { COLOUR_STRIDE = sizeof(Vector) / sizeof(real) };
    GLOBAL const real *table =
        (GLOBAL const real *)(corner_colours + instance->first_corner_colours);
    vint place = (triangle - instance->first_triangle) * (3 * COLOUR_STRIDE);
    Vec3 sum = vec3_zero();
    for (int i = 0; i < 3; i++) {
        FourReals at = fetch_four_reals(table, place + i * COLOUR_STRIDE);
        sum =
            vec3_scale_add(vec3(at.number[0], at.number[1], at.number[2]), crossing->share[i], sum);
    }
    return sum;
}

FN void set_mesh_materials(SCENE_PARAMETERS GLOBAL const Instance *instance, vmask m,
                           const TriangleLanes *triangle, const TriangleCrossing *crossing,
                           vmask entering, Surface *surface) {
    while (any_lane(m)) {
        int number = lane_int(&triangle->mesh_material, first_lane(m));
        GLOBAL const MeshMaterial *mesh_material = mesh_materials + number;
        vmask same = m & eq_int(triangle->mesh_material, splat_int(number));
        m = lanes_after(m, same);
        LaneMaterial material = splat_material(materials + mesh_material->material, entering);
        material.colour =
            vec3_mul(material.colour, colour_of_picture(SCENE_ARGUMENTS instance, mesh_material,
                                                        triangle->number, crossing));
        if (instance->first_corner_colours >= 0)
            material.colour =
                vec3_mul(material.colour,
                         colour_of_corners(SCENE_ARGUMENTS instance, triangle->number, crossing));
        set_material(surface, same, material);
        surface->emission = vec3_select(same, vec3_of(mesh_material->emission), surface->emission);
    }
}

/* Triangles of less than half this area are smaller than the rounding of their corners. */
#if HD_DOUBLE
#define MIN_AREA R(1e-30)
#else
#define MIN_AREA R(1e-15)
#endif

/* Sines of angles: a ray below the first one leaves flat; the second is the minimum. The last is
   the maximum share of the distance to a triangle's middle that origins move by. */
#define FLAT        R(0.125)
#define FLATTEST    R(0.0009765625)
#define MAX_INWARDS R(0.25)

/* Moves the origin of rays that leave a triangle flat back along their direction. A ray that starts
   a unit of rounding on the wrong side crosses the triangle after 1 / sin(angle) units, which must
   be before the edge ahead. `way` is the ray's direction in the mesh, and `normal` as long as twice
   the area. */
FN void step_back(GLOBAL const Instance *instance, const TriangleLanes *triangle, Vec3 normal,
                  Vec3 way, TriangleCrossing *crossing) {
    vreal zero = splat(R(0.0)), most = splat(REAL_LARGE);
    vreal down = absolute(vec3_dot(normal, way)), length = vec3_dot(way, way);
    vreal area = vmax(vec3_dot(normal, normal), splat(MIN_AREA * MIN_AREA)); /* squared */
    vmask flat = lt(down * down, area * length * splat(FLAT * FLAT));
    if (!any_lane(flat))
        return;
    down = vmax(down, square_root(area * length) * splat(FLATTEST));
    /* A point is off by at most an eighth of the contact distance. */
    vreal wanted = square_root(area * (instance->contact_squared * R(0.015625))) * reciprocal(down);
    /* The rates of change of the corners' shares. */
    vreal inverse = reciprocal(area), rate[3], *share = crossing->share;
    rate[1] = vec3_dot(way, vec3_cross(vec3_sub(triangle->c, triangle->a), normal)) * inverse;
    rate[2] = vec3_dot(way, vec3_cross(normal, vec3_sub(triangle->b, triangle->a))) * inverse;
    rate[0] = -(rate[1] + rate[2]);
    vreal ahead = most, behind = most;               /* to the edges, in units of `way` */
    vreal middle_ahead = most, middle_behind = most; /* the same from the middle */
    vreal third = splat(R(0.33333333333333333));
    for (int i = 0; i < 3; i++) {
        vmask falls = lt(rate[i], zero), rises = lt(zero, rate[i]);
        vreal time = reciprocal(vselect(falls | rises, absolute(rate[i]), splat(R(1.0))));
        ahead = vselect(falls, vmin(ahead, share[i] * time), ahead);
        behind = vselect(rises, vmin(behind, share[i] * time), behind);
        middle_ahead = vselect(falls, vmin(middle_ahead, third * time), middle_ahead);
        middle_behind = vselect(rises, vmin(middle_behind, third * time), middle_behind);
    }
    /* Near a corner the space is too small: it grows with the distance towards the middle. */
    vreal lacking = vmax(wanted - (ahead + behind), zero);
    vreal inwards = vmin(lacking * reciprocal(middle_ahead + middle_behind), splat(MAX_INWARDS));
    ahead = multiply_add(inwards, middle_ahead - ahead, ahead);
    behind = multiply_add(inwards, middle_behind - behind, behind);
    vreal back = vmin(vmax(wanted - ahead, zero), vmax(behind, zero) * R(0.5));
    for (int i = 0; i < 3; i++) {
        vreal moved = multiply_add(inwards, third - share[i], share[i]);
        share[i] = vselect(flat, multiply_add(-back, rate[i], moved), share[i]);
    }
}

/* Returns the origin of rays that leave a triangle; `normal` is as long as twice its area. Within
   rounding of an edge the origin moves inside: a ray from the edge itself might be on the wrong
   side of both its triangles, and miss both. */
FN Vec3 point_of_departure(GLOBAL const Instance *instance, const TriangleLanes *triangle,
                           const TriangleCrossing *crossing, Vec3 normal) {
    Vec3 to_b = vec3_sub(triangle->b, triangle->a), to_c = vec3_sub(triangle->c, triangle->a);
    Vec3 from_b_to_c = vec3_sub(triangle->c, triangle->b);
    vreal least = splat(instance->contact_squared * R(0.25));
    vreal area = vmax(vec3_dot(normal, normal), splat(MIN_AREA * MIN_AREA)); /* squared */
    vreal a = crossing->share[0], b = crossing->share[1], c = crossing->share[2];
    vreal margin_a = vec3_dot(from_b_to_c, from_b_to_c) * least;
    vreal margin_b = vec3_dot(to_c, to_c) * least, margin_c = vec3_dot(to_b, to_b) * least;
    vmask near_edge =
        lt(a * a * area, margin_a) | lt(b * b * area, margin_b) | lt(c * c * area, margin_c);
    if (any_lane(near_edge)) {
        vreal scale = square_root(reciprocal(area)), one = splat(R(1.0));
        margin_a = square_root(margin_a) * scale;
        margin_b = square_root(margin_b) * scale;
        margin_c = square_root(margin_c) * scale;
        vreal sum = margin_a + margin_b + margin_c;
        vreal fits = vmin(one, reciprocal(sum) * R(0.5)); /* half of a smaller triangle */
        vreal rest = one - sum * fits;
        a = vselect(near_edge, multiply_add(rest, a, margin_a * fits), a);
        b = vselect(near_edge, multiply_add(rest, b, margin_b * fits), b);
        c = vselect(near_edge, multiply_add(rest, c, margin_c * fits), c);
    }
    return vec3_scale_add(triangle->a, a,
                          vec3_scale_add(triangle->b, b, vec3_scale(triangle->c, c)));
}

/* Describes the lanes of `met`, which hit triangles of the instance; sets hit->face to the face. */
FN_NOINLINE void describe_mesh(SCENE_PARAMETERS const Ray *ray, const LocalOrigin *local_origin,
                               int number, const vmask *met, Hit *hit, Surface *surface) {
    vmask m = *met;
    GLOBAL const Instance *instance = instances + number;
    Vec3 origin = move_to_object(SCENE_ARGUMENTS * local_origin, ray->origin, header->floor_end);
    vmask own = mask_none();
    if (!local_origin->is_eye)
        own = eq_int(ray->last_hit, splat_int(header->floor_end + number));
    Vec3 in_mesh = origin_in_mesh(instance, origin, own, ray->origin);
    Vec3 along = transform_vector(instance->to_mesh, ray->direction);
    DominantAxis last = dominant_axis(along);
    in_mesh = turn(last, in_mesh);
    along = turn(last, along);
    RayFrame frame = ray_frame(in_mesh, along);
    Slabs slabs = ray_slabs(in_mesh, along, splat(R(1.0)));
    TriangleLanes triangle =
        fetch_triangles(triangles, vselect_int(m, hit->face, splat_int(instance->first_triangle)),
                        instance->first_face, instance->first_mesh_material);
    TriangleCrossing crossing;
    cross_triangle(&frame, &slabs, m, turn(last, triangle.a), turn(last, triangle.b),
                   turn(last, triangle.c), &crossing);
    Vec3 normal = normal_of(&triangle);
    Vec3 flat = direction_of(transform_normal(instance->to_mesh, direction_of(normal)));
    flat = vec3_scale(flat, vselect(hit->entering, splat(R(1.0)), splat(R(-1.0))));
    surface->normal = vec3_select(m, flat, surface->normal);
    Vec3 leaving = ray->direction;
    if (instance->first_corner_normals >= 0) {
        Vec3 lift;
        Vec3 smooth = smooth_normal(SCENE_ARGUMENTS instance, &triangle, hit->entering, &crossing,
                                    ray->direction, flat, &lift);
        Vec3 mirrored =
            vec3_scale_add(smooth, vec3_dot(smooth, ray->direction) * R(-2.0), ray->direction);
        vmask flatter = lt(vec3_dot(flat, mirrored), absolute(vec3_dot(flat, leaving)));
        leaving = vec3_select(flatter, mirrored, leaving);
        surface->normal = vec3_select(m, smooth, surface->normal);
        surface->lift = vec3_select(m, transform_vector(instance->to_world, lift), surface->lift);
    }
    set_mesh_materials(SCENE_ARGUMENTS instance, m, &triangle, &crossing, hit->entering, surface);
    step_back(instance, &triangle, normal, transform_vector(instance->to_mesh, leaving), &crossing);
    Vec3 point = point_of_departure(instance, &triangle, &crossing, normal);
    surface->point = vec3_select(m, transform_vector(instance->to_world, point), surface->point);
    hit->face = vselect_int(m, triangle.face, hit->face);
}

/* Describes the lanes of `struck`, object by object, so that all lanes that hit a material read it
   once. For mesh hits it sets hit->face to the face. */
FN Surface surface_at(SCENE_PARAMETERS const Ray *ray, LocalOrigin local_origin, Hit *hit,
                      vmask struck) {
    Surface surface;
    surface.point = surface.normal = surface.lift = surface.emission = vec3_zero();
    surface.material = no_material();
    vmask left = struck;
    while (any_lane(left)) {
        int object = lane_int(&hit->object, first_lane(left));
        vmask m = left & eq_int(hit->object, splat_int(object));
        left = lanes_after(left, m);
        if (MESHES(header) && object >= header->floor_end) {
            describe_mesh(SCENE_ARGUMENTS ray, &local_origin, object - header->floor_end, &m, hit,
                          &surface);
            continue;
        }
        Vec3 origin = move_to_object(SCENE_ARGUMENTS local_origin, ray->origin, object);
        surface.point =
            vec3_select(m, vec3_scale_add(ray->direction, hit->t, origin), surface.point);
        if (object < header->solid_count)
            describe_solid(SCENE_ARGUMENTS object, m, hit, &surface);
        else
            describe_floor(SCENE_ARGUMENTS object, m, hit, &surface);
    }
    return surface;
}

#endif
