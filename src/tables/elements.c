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

HdStatus hd_builder_shape_solids(HdBuilder *builder, HdError *error) {
    const HdScene *scene = builder->scene;
    builder->shapes = calloc((size_t)scene->solid_count + 1, sizeof *builder->shapes);
    if (builder->shapes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the scene has %d solids",
                       scene->solid_count);
    for (int s = 0; s < scene->solid_count; s++)
        builder->shapes[s] = hd_solid_shape(&scene->solids[s]);
    return HD_OK;
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
    return picture < scene->picture_count ? &scene->pictures[picture].texture
                                          : &scene->floor.texture;
}

static void count_pictures(HdBuilder *builder) {
    const HdScene *scene = builder->scene;
    builder->picture_count = scene->picture_count;
    if (builder->has_floor && scene->floor.texture.width > 0)
        builder->picture_count++;
    for (int i = 0; i < builder->picture_count; i++) {
        const HdTexture *texture = hd_builder_texture(builder, i);
        builder->texels += ((size_t)texture->width + 1) * ((size_t)texture->height + 1);
    }
}

void hd_builder_count(HdBuilder *builder) {
    const HdScene *scene = builder->scene;
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
}

/* The difference of the centres comes first: an edge light keeps all its digits at its own solid,
   however far from the world's origin that is. */
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

HdVec3 hd_most_radiance(const HdScene *scene) {
    HdVec3 most = hd_radiance_bound(scene);
    double limit = HD_RADIANCE_LIMIT / scene->exposure;
    return (HdVec3){fmin(most.x, limit), fmin(most.y, limit), fmin(most.z, limit)};
}
