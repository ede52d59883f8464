/* SPDX-License-Identifier: MIT */
/* The solids, the floor and the lights that tables are made of, before anything is rounded. */
#include "tables/builder.h"

#include <math.h>
#include <stdlib.h>

#include "scene/light_bound.h"

int hd_faces_per_plane(const HdPlatonic *shape) {
    return shape->face_count == 4 ? 1 : 2;
}

int hd_solid_plane_count(const HdPlatonic *shape) {
    return shape->face_count / hd_faces_per_plane(shape);
}

static bool has_solids(const HdScene *scene) {
    return scene->geometry == HD_GEOMETRY_SOLIDS;
}

static bool has_floor(const HdScene *scene) {
    return has_solids(scene) && scene->floor.present;
}

int hd_object_count(const HdScene *scene) {
    int solids = has_solids(scene) ? scene->solid_count : 0;
    return solids + has_floor(scene) + (scene->instance_count > 0);
}

HdVec3 hd_object_centre(const HdScene *scene, int object) {
    HdVec3 centre;
    if (has_solids(scene) && object < scene->solid_count)
        return scene->solids[object].centre;
    if (has_floor(scene) && object == scene->solid_count)
        return hd_floor_centre(&scene->floor);
    hd_box_meshes(scene, &centre);
    return centre;
}

const HdTexture *hd_builder_texture(const HdBuilder *builder, int picture) {
    const HdScene *scene = builder->scene;
    if (picture == builder->environment_picture)
        return &scene->environment.texture;
    return picture < scene->picture_count ? &scene->pictures[picture].texture
                                          : &scene->floor.texture;
}

static void count_pictures(HdBuilder *builder) {
    const HdScene *scene = builder->scene;
    builder->picture_count = scene->picture_count;
    if (builder->has_floor && scene->floor.texture.width > 0)
        builder->picture_count++;
    builder->environment_picture =
        scene->environment.texture.width > 0 ? builder->picture_count++ : -1;
    for (int i = 0; i < builder->picture_count; i++) {
        const HdTexture *texture = hd_builder_texture(builder, i);
        builder->texels += ((size_t)texture->width + 1) * ((size_t)texture->height + 1);
    }
}

HdStatus hd_builder_count(HdBuilder *builder, HdError *error) {
    const HdScene *scene = builder->scene;
    builder->shapes = calloc((size_t)scene->solid_count + 1, sizeof *builder->shapes);
    if (builder->shapes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene has %d solids",
                       scene->solid_count);
    for (int s = 0; s < scene->solid_count; s++)
        builder->shapes[s] = hd_solid_shape(&scene->solids[s]);
    builder->solid_count = has_solids(scene) ? scene->solid_count : 0;
    builder->has_floor = has_floor(scene);
    builder->object_count = hd_object_count(scene);
    builder->light_count = scene->light_count;
    for (int s = 0; s < builder->solid_count; s++) {
        builder->plane_count += hd_solid_plane_count(&builder->shapes[s]);
        builder->edge_count += builder->shapes[s].edge_count;
    }
    for (int s = 0; s < scene->solid_count; s++) {
        if (scene->solids[s].lights.intensity > 0.0)
            builder->light_count += hd_edge_light_count(&scene->solids[s]);
    }
    if (builder->has_floor)
        builder->plane_count += HD_FLOOR_PLANES;
    count_pictures(builder);
    return HD_OK;
}

/* ---- lights ---- */

HdVec3 hd_edge_point(const HdPlatonic *shape, int edge, double circumradius, double along) {
    HdVec3 a = shape->vertex[shape->edge[edge].vertex[0]];
    HdVec3 b = shape->vertex[shape->edge[edge].vertex[1]];
    return hd_scale(hd_add(hd_scale(a, 1.0 - along), hd_scale(b, along)), circumradius);
}

HdVec3 hd_edge_colour(const HdEdgeLights *lights, int edge) {
    return lights->colours[edge % lights->colour_count];
}

static int list_edge_lights(const HdBuilder *builder, int solid, HdLightSource *out) {
    const HdSolid *description = &builder->scene->solids[solid];
    const HdPlatonic *shape = &builder->shapes[solid];
    int count = 0;
    if (!(description->lights.intensity > 0.0))
        return 0;
    for (int e = 0; e < shape->edge_count; e++)
        for (int k = 0; k < description->lights.per_edge; k++) {
            double along = (k + 0.5) / description->lights.per_edge;
            out[count++] = (HdLightSource){
                .position = hd_edge_point(shape, e, description->circumradius, along),
                .owner = solid,
                .face = {shape->edge[e].face[0], shape->edge[e].face[1]},
                .intensity = hd_scale(hd_edge_colour(&description->lights, e),
                                      description->lights.intensity),
                .falloff = description->lights.falloff,
            };
        }
    return count;
}

/* The difference of the centres comes first: at its own solid an edge light keeps all its digits,
   at any distance from the world's origin. */
HdVec3 hd_light_offset(const HdBuilder *builder, const HdLightSource *source, int object) {
    if (source->owner < 0)
        return hd_sub(source->position, builder->centres[object]);
    return hd_add(hd_sub(builder->scene->solids[source->owner].centre, builder->centres[object]),
                  source->position);
}

/* ---- the floor ---- */

HdFloorFrame hd_floor_frame(const HdFloor *floor) {
    const HdVec3 *c = floor->corners;
    HdFloorFrame frame;
    frame.centre = hd_floor_centre(floor);
    frame.normal = hd_normalize(hd_cross(hd_sub(c[2], c[0]), hd_sub(c[3], c[1])));
    HdVec3 along = hd_sub(c[1], c[0]);
    along = hd_sub(along, hd_scale(frame.normal, hd_dot(frame.normal, along)));
    frame.axis_a = hd_normalize(along);
    frame.axis_b = hd_cross(frame.normal, frame.axis_a);
    return frame;
}

/* ---- radiance ---- */

HdVec3 hd_max_radiance(const HdScene *scene) {
    double limit = HD_RADIANCE_LIMIT / scene->exposure;
    return hd_minimum(hd_radiance_bound(scene), hd_vec3(limit, limit, limit));
}

/* ---- clusters of lights near each other ---- */

static double coordinate(HdVec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* Orders by key, then by number, so that every machine makes the same clusters. */
static int compare_keys(const void *a, const void *b) {
    const HdClusteredLight *left = a, *right = b;
    if (left->key != right->key)
        return left->key < right->key ? -1 : 1;
    return (left->light > right->light) - (left->light < right->light);
}

static double extent(const HdClusteredLight *lights, int count, int axis) {
    double least = coordinate(lights[0].about, axis), most = least;
    for (int i = 1; i < count; i++) {
        double x = coordinate(lights[i].about, axis);
        least = x < least ? x : least;
        most = x > most ? x : most;
    }
    return most - least;
}

static bool ends_edge(const HdClusteredLight *lights, int place) {
    return hd_length(hd_sub(lights[place - 1].about, lights[place].about)) > 0.0;
}

/* Returns the place nearest to `place` that separates no edge's lights, otherwise `place`. */
static int nearest_edge_end(const HdClusteredLight *lights, int count, int place) {
    for (int off = 0; off < count; off++) {
        if (place - off > 0 && ends_edge(lights, place - off))
            return place - off;
        if (place + off < count && ends_edge(lights, place + off))
            return place + off;
    }
    return place;
}

/* Divides `count` lights into `clusters` clusters, at most `count`. */
static void split_lights(HdClusteredLight *lights, int count, int first_cluster, int clusters) {
    if (clusters == 1) {
        for (int i = 0; i < count; i++) {
            lights[i].cluster = first_cluster;
            lights[i].key = 0.0;
        }
        qsort(lights, (size_t)count, sizeof *lights, compare_keys);
        return;
    }
    int axis = 0;
    for (int other = 1; other < 3; other++)
        if (extent(lights, count, other) > extent(lights, count, axis))
            axis = other;
    for (int i = 0; i < count; i++)
        lights[i].key = coordinate(lights[i].about, axis);
    qsort(lights, (size_t)count, sizeof *lights, compare_keys);
    int part = nearest_edge_end(lights, count, (int)((int64_t)count * (clusters / 2) / clusters));
    int half = (int)(((int64_t)clusters * part + count / 2) / count);
    half = half < 1 ? 1 : half < clusters ? half : clusters - 1;
    split_lights(lights, part, first_cluster, half);
    split_lights(lights + part, count - part, first_cluster + half, clusters - half);
}

static bool share_edge(const HdLightSource *a, const HdLightSource *b) {
    return a->owner >= 0 && a->owner == b->owner && a->face[0] == b->face[0] &&
           a->face[1] == b->face[1];
}

/* Sets `about` of the lights on one edge, from `first` on; returns the next light. */
static int set_middle(HdBuilder *builder, int first) {
    HdClusteredLight *lights = builder->clustered;
    int next = first + 1;
    while (next < builder->light_count &&
           share_edge(&builder->sources[first], &builder->sources[next]))
        next++;
    HdVec3 middle = hd_scale(hd_add(lights[first].position, lights[next - 1].position), 0.5);
    for (int i = first; i < next; i++)
        lights[i].about = middle;
    return next;
}

static void cluster_lights(HdBuilder *builder) {
    int clusters = HD_LIGHT_CLUSTERS(builder->light_count);
    for (int i = 0; i < builder->light_count; i++) {
        const HdLightSource *source = &builder->sources[i];
        HdVec3 position = source->position;
        if (source->owner >= 0)
            position = hd_add(position, builder->scene->solids[source->owner].centre);
        builder->clustered[i] = (HdClusteredLight){position, position, .light = i};
    }
    for (int i = 0, next; i < builder->light_count; i = next)
        next = set_middle(builder, i);
    if (clusters > 0)
        split_lights(builder->clustered, builder->light_count, 0, clusters);
}

void hd_builder_list_lights(HdBuilder *builder) {
    const HdScene *scene = builder->scene;
    int count = 0;
    for (int i = 0; i < scene->light_count; i++)
        builder->sources[count++] = (HdLightSource){
            .position = scene->lights[i].position,
            .owner = -1,
            .intensity = scene->lights[i].intensity,
            .falloff = scene->lights[i].falloff,
        };
    for (int s = 0; s < scene->solid_count; s++)
        count += list_edge_lights(builder, s, builder->sources + count);
    cluster_lights(builder);
}
