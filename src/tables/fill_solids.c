/* SPDX-License-Identifier: MIT */
/* Tables of solids, the floor and their materials; compiled for each precision. */
#include "tables/builder.h"

#include <math.h>

#include "scene/light_bound.h"

static void fill_environment(Header *header, const HdBuilder *builder) {
    const HdEnvironment *environment = &builder->scene->environment;
    const double start = 0.5 + environment->rotation_degrees / 360.0;
    header->environment_picture = builder->environment_picture;
    header->environment_factor = (real)(environment->intensity * environment->top);
    header->environment_start = (real)(start - floor(start));
}

void NAMED(hd_fill_header)(const HdBuilder *builder, const HdSceneTables *tables) {
    Header *header = builder->table[HD_TABLE_header];
    hd_store3(header->background, builder->scene->background);
    fill_environment(header, builder);
    header->exposure = (real)builder->scene->exposure;
    header->refracts = tables->refracts;
    header->lit_from_behind = tables->lit_from_behind;
    header->bounded = tables->bounded;
    header->cut_outs = tables->cut_outs;
    hd_store3(header->light_bound, hd_light_bound(builder->scene));
    header->solid_count = builder->solid_count;
    header->floor_end = builder->solid_count + (builder->has_floor ? 1 : 0);
    header->top_root = -1;
    header->object_count = builder->object_count;
    header->plane_count = builder->plane_count;
    header->light_count = builder->light_count;
}

static void store_seen(Object *out, const HdSeen *seen, HdVec3 limit) {
    hd_store3(out->seen_outside, hd_minimum(seen->outside, limit));
    hd_store3(out->seen_inside, hd_minimum(seen->inside, limit));
}

void NAMED(hd_fill_seen)(const HdBuilder *builder) {
    const HdScene *scene = builder->scene;
    Object *objects = builder->table[HD_TABLE_objects];
    const HdVec3 most = hd_max_radiance(scene);
    HdSeen seen[HD_MAX_SOLIDS + 2];
    hd_seen_bounds(scene, seen);
    for (int s = 0; s < builder->solid_count; s++)
        store_seen(&objects[s], &seen[s], most);
    int mesh = builder->solid_count;
    if (builder->has_floor)
        store_seen(&objects[mesh++], &seen[scene->solid_count], most);
    /* Meshes may include solids made of triangles. */
    if (mesh < builder->object_count)
        store_seen(&objects[mesh], &(HdSeen){most, most}, most);
}

/* Returns x to the power n by squaring, as kernels do. */
static double power(double x, int n) {
    double result = 1.0;
    for (; n > 0; n >>= 1) {
        result *= n & 1 ? x : 1.0;
        x *= x;
    }
    return result;
}

/* Returns the cosine whose power is 2^-60, rounded up; by bisection, as library functions differ.
 */
static real min_highlight(int shininess) {
    double below = 0.0, above = 1.0;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (below + above);
        if (power(middle, shininess) < 0x1p-60)
            below = middle;
        else
            above = middle;
    }
    return (real)(above * 1.000001);
}

void NAMED(hd_fill_material)(Material *out, const HdMaterial *material) {
#define STORE_COLOUR(term) hd_store3(out->term, material->term);
#define STORE_NUMBER(term) out->term = (real)material->term;
    HD_PLAIN_TERMS(STORE_COLOUR, STORE_NUMBER)
    bool own_inside = material->has_inner_side;
    out->inner_reflection = own_inside ? (real)material->inner_reflection : out->reflection;
    out->inner_transmission = own_inside ? (real)material->inner_transmission : out->transmission;
    out->index_of_refraction = (real)material->index_of_refraction;
    out->inverse_index = (real)(1.0 / material->index_of_refraction);
    out->shininess = material->shininess;
    out->min_highlight = min_highlight(material->shininess);
    out->lit_from_behind = material->lit_from_behind;
}

/* ---- solids ---- */

/* Returns a pattern's depth; -REAL_LARGE switches it off, as no point is nearer to a plane. */
static real pattern_depth(double width, double sine_of_dihedral) {
    return width > 0.0 ? (real)(width * sine_of_dihedral) : -REAL_LARGE;
}

static void fill_object(Object *out, const HdSolid *solid, const HdPlatonic *shape) {
    double disc = solid->lights.per_edge > 0 ? solid->lights.disc_radius : 0.0;
    out->rim_depth = pattern_depth(solid->rim_width, shape->sine_of_dihedral);
    out->disc_depth = pattern_depth(disc, shape->sine_of_dihedral);
    out->disc_radius_squared = (real)(disc * disc);
    out->circumradius_squared = (real)(solid->circumradius * solid->circumradius);
    out->radius_about = (real)(solid->circumradius * 1.001);
    out->edge_half_length = (real)(0.5 * shape->edge_length * solid->circumradius);
    double reach = (0.5 * shape->edge_length * solid->circumradius + disc) * 1.001;
    out->disc_reach_squared = (real)(reach * reach);
    out->plane_count = hd_solid_plane_count(shape);
    out->paired = hd_faces_per_plane(shape) == 2;
    out->edge_count = shape->edge_count;
    out->lights_per_edge = solid->lights.per_edge;
}

static Plane plane_of(HdVec3 normal, double distance) {
    return (Plane){(real)normal.x, (real)normal.y, (real)normal.z, (real)distance};
}

static void fill_solid_planes(Plane *out, const HdSolid *solid, const HdPlatonic *shape) {
    for (int i = 0; i < hd_solid_plane_count(shape); i++)
        out[i] = plane_of(shape->face_normal[i * hd_faces_per_plane(shape)],
                          shape->inradius * solid->circumradius);
}

static void fill_solid_edges(Edge *out, const HdSolid *solid, const HdPlatonic *shape) {
    for (int e = 0; e < shape->edge_count; e++) {
        HdVec3 a = shape->vertex[shape->edge[e].vertex[0]];
        HdVec3 b = shape->vertex[shape->edge[e].vertex[1]];
        hd_store3(out[e].middle, hd_edge_point(shape, e, solid->circumradius, 0.5));
        hd_store3(out[e].direction, hd_normalize(hd_sub(b, a)));
        if (solid->lights.per_edge > 0)
            hd_store3(out[e].disc_radiance,
                      hd_scale(hd_edge_colour(&solid->lights, e), solid->lights.disc_radiance));
    }
}

void NAMED(hd_fill_solids)(const HdBuilder *builder) {
    Object *objects = builder->table[HD_TABLE_objects];
    Plane *planes = builder->table[HD_TABLE_planes];
    Edge *edges = builder->table[HD_TABLE_edges];
    Material *materials = builder->table[HD_TABLE_materials];
    int plane = 0, edge = 0;
    for (int s = 0; s < builder->solid_count; s++) {
        const HdSolid *solid = &builder->scene->solids[s];
        const HdPlatonic *shape = &builder->shapes[s];
        fill_object(&objects[s], solid, shape);
        fill_solid_planes(planes + plane, solid, shape);
        fill_solid_edges(edges + edge, solid, shape);
        objects[s].first_plane = plane;
        objects[s].first_edge = edge;
        objects[s].face_material = 2 * s;
        objects[s].rim_material = 2 * s + 1;
        NAMED(hd_fill_material)(&materials[2 * s], &solid->face);
        NAMED(hd_fill_material)(&materials[2 * s + 1], &solid->rim);
        plane += hd_solid_plane_count(shape);
        edge += shape->edge_count;
    }
}

/* ---- the floor ---- */

static void fill_floor_planes(Plane *out, const HdFloor *floor, const HdFloorFrame *frame) {
    out[0] = plane_of(frame->normal, 0.0);
    for (int i = 0; i < 4; i++) {
        HdVec3 corner = hd_sub(floor->corners[i], frame->centre);
        HdVec3 next = hd_sub(floor->corners[(i + 1) % 4], frame->centre);
        HdVec3 outward = hd_normalize(hd_cross(hd_sub(next, corner), frame->normal));
        double distance = hd_dot(outward, corner);
        if (distance < 0.0) {
            outward = hd_scale(outward, -1.0);
            distance = -distance;
        }
        out[i + 1] = plane_of(outward, distance);
    }
}

static void fill_floor_map(FloorMap *map, const HdFloor *floor, const HdFloorFrame *frame) {
    double a[4], b[4];
    for (int i = 0; i < 4; i++) {
        HdVec3 corner = hd_sub(floor->corners[i], frame->centre);
        a[i] = hd_dot(frame->axis_a, corner);
        b[i] = hd_dot(frame->axis_b, corner);
    }
    hd_store3(map->axis_a, frame->axis_a);
    hd_store3(map->axis_b, frame->axis_b);
    map->origin[0] = (real)a[0];
    map->origin[1] = (real)b[0];
    map->e[0] = (real)(a[1] - a[0]);
    map->e[1] = (real)(b[1] - b[0]);
    map->f[0] = (real)(a[3] - a[0]);
    map->f[1] = (real)(b[3] - b[0]);
    map->g[0] = (real)(a[0] - a[1] + a[2] - a[3]);
    map->g[1] = (real)(b[0] - b[1] + b[2] - b[3]);
    double determinant = (a[1] - a[0]) * (b[3] - b[0]) - (b[1] - b[0]) * (a[3] - a[0]);
    map->orientation = determinant < 0.0 ? R(-1.0) : R(1.0);
    /* A smaller bend moves a corner by less than a float resolves. */
    double bend = fabs(a[0] - a[1] + a[2] - a[3]) + fabs(b[0] - b[1] + b[2] - b[3]);
    map->is_parallelogram = bend * bend < 1e-18 * fabs(determinant);
    if (map->is_parallelogram) {
        double s_a = (b[3] - b[0]) / determinant, s_b = -(a[3] - a[0]) / determinant;
        double t_a = -(b[1] - b[0]) / determinant, t_b = (a[1] - a[0]) / determinant;
        hd_store3(map->axis_s, hd_add(hd_scale(frame->axis_a, s_a), hd_scale(frame->axis_b, s_b)));
        hd_store3(map->axis_t, hd_add(hd_scale(frame->axis_a, t_a), hd_scale(frame->axis_b, t_b)));
        map->start[0] = (real) - (s_a * a[0] + s_b * b[0]);
        map->start[1] = (real) - (t_a * a[0] + t_b * b[0]);
    }
}

void NAMED(hd_fill_floor)(const HdBuilder *builder) {
    const HdFloor *floor = &builder->scene->floor;
    if (!builder->has_floor)
        return;
    HdFloorFrame frame = hd_floor_frame(floor);
    Object *object = (Object *)builder->table[HD_TABLE_objects] + builder->solid_count;
    object->first_plane = builder->plane_count - HD_FLOOR_PLANES;
    object->plane_count = HD_FLOOR_PLANES;
    object->face_material = object->rim_material = 2 * builder->solid_count;
    fill_floor_planes((Plane *)builder->table[HD_TABLE_planes] + object->first_plane, floor,
                      &frame);
    NAMED(hd_fill_material)
    ((Material *)builder->table[HD_TABLE_materials] + object->face_material, &floor->material);
    FloorMap *map = builder->table[HD_TABLE_floor_map];
    fill_floor_map(map, floor, &frame);
    map->picture = floor->texture.width > 0 ? builder->scene->picture_count : -1;
}

/* Stores texels row by row; the first column and row are repeated after the last ones. */
static uint *fill_texels(uint *words, const HdTexture *texture) {
    for (int row = 0; row <= texture->height; row++)
        for (int column = 0; column <= texture->width; column++) {
            size_t place = (size_t)(row % texture->height) * (size_t)texture->width +
                           (size_t)(column % texture->width);
            const uint16_t *rgb = texture->texels + 3 * place;
            *words++ = (uint)rgb[0] | (uint)rgb[1] << 16;
            *words++ = rgb[2];
        }
    return words;
}

void NAMED(hd_fill_pictures)(const HdBuilder *builder) {
    const HdScene *scene = builder->scene;
    Picture *pictures = builder->table[HD_TABLE_pictures];
    uint *texels = builder->table[HD_TABLE_texels], *words = texels;
    for (int i = 0; i < builder->picture_count; i++) {
        const HdTexture *texture = hd_builder_texture(builder, i);
        bool is_clamped = i < scene->picture_count ? scene->pictures[i].is_clamped
                                                   : i != builder->environment_picture;
        int first = (int)((words - texels) / 2);
        pictures[i] = (Picture){first, texture->width, texture->height, is_clamped};
        words = fill_texels(words, texture);
    }
}

void NAMED(hd_fill_object_offsets)(const HdBuilder *builder) {
    Vector *offsets = builder->table[HD_TABLE_object_offsets];
    for (int from = 0; from < builder->object_count; from++)
        for (int to = 0; to < builder->object_count; to++)
            offsets[from * builder->object_count + to] =
                hd_as_vector(hd_sub(builder->centres[from], builder->centres[to]));
}
