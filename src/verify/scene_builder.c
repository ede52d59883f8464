/* SPDX-License-Identifier: MIT */
#include "verify/scene_builder.h"

#include <stdlib.h>
#include <string.h>

#include "base/trigonometry.h"

static void *allocate(size_t count, size_t size) {
    void *memory = calloc(count > 0 ? count : 1, size);
    if (memory == NULL)
        abort();
    return memory;
}

static HdVec3 same(double a) {
    return hd_vec3(a, a, a);
}

HdMaterial build_material(HdVec3 colour, double reflection, double transmission) {
    return (HdMaterial){.colour = colour,
                        .mirror_tint = same(1.0),
                        .diffuse = 0.3,
                        .specular = 0.4,
                        .shininess = 48,
                        .reflection = reflection,
                        .transmission = transmission,
                        .index_of_refraction = 1.0};
}

static HdMaterial rim_material(void) {
    return (HdMaterial){.colour = same(0.05),
                        .mirror_tint = same(1.0),
                        .diffuse = 0.5,
                        .specular = 0.25,
                        .shininess = 7,
                        .index_of_refraction = 1.0};
}

void build_scene(HdScene *scene, int width, int height, int samples, int depth, int solids,
                 int lights) {
    memset(scene, 0, sizeof *scene);
    scene->frame_count = 1;
    scene->target.cylinder.z0 = -1.0; /* not at the eye; the frames' cameras are others */
    scene->width = width;
    scene->height = height;
    scene->samples_per_side = samples;
    scene->depth = depth;
    scene->field_of_view_degrees = 60.0;
    scene->exposure = 1.0;
    scene->background = hd_vec3(0.01, 0.02, 0.04);
    scene->solid_count = solids;
    scene->solids = allocate((size_t)solids, sizeof *scene->solids);
    scene->light_count = lights;
    scene->lights = allocate((size_t)lights, sizeof *scene->lights);
}

void build_solid(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                 HdVec3 colour, int lights_per_edge) {
    double count = lights_per_edge > 0 ? 12.0 * lights_per_edge : 1.0;
    scene->solids[index] = (HdSolid){.kind = kind,
                                     .centre = centre,
                                     .circumradius = radius,
                                     .face = build_material(colour, 0.6, 0.35),
                                     .rim_width = 0.05 * radius,
                                     .rim = rim_material(),
                                     .lights = {.per_edge = lights_per_edge,
                                                .colour_count = 1,
                                                .colours = {{1.0, 1.0, 1.0}},
                                                .intensity = 2.0 / count,
                                                .falloff = {.distance = radius},
                                                .disc_radius = 0.025 * radius,
                                                .disc_radiance = 3.0}};
}

void build_glass(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                 double grey, double transmission) {
    build_solid(scene, index, kind, centre, radius, same(grey), 0);
    scene->solids[index].rim_width = 0.0;
    scene->solids[index].face.reflection = 0.0;
    scene->solids[index].face.transmission = transmission;
}

void build_light(HdScene *scene, int index, HdVec3 position, HdVec3 intensity) {
    scene->lights[index] = (HdLight){.position = position, .intensity = intensity};
}

/* A texture of hard squares and smooth ramps, so that a wrong texel or weight shows. */
void build_texture(HdTexture *texture, int width, int height) {
    texture->width = width;
    texture->height = height;
    texture->texels = allocate((size_t)width * (size_t)height * 3, sizeof *texture->texels);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint16_t *rgb = texture->texels + 3 * (y * width + x);
            rgb[0] = (x / 4 + y / 4) % 2 ? 60000 : 4000;
            rgb[1] = (uint16_t)(65535 * x / width);
            rgb[2] = (uint16_t)(65535 * y / height);
        }
}

void build_floor(HdScene *scene, HdVec3 a, HdVec3 b, HdVec3 c, HdVec3 d) {
    scene->floor.present = true;
    scene->floor.corners[0] = a;
    scene->floor.corners[1] = b;
    scene->floor.corners[2] = c;
    scene->floor.corners[3] = d;
    scene->floor.material = build_material(hd_vec3(0.9, 0.8, 0.7), 0.4, 0.0);
    scene->floor.material.diffuse = 0.7;
}

void build_square_floor(HdScene *scene, double half_side, double z) {
    build_floor(scene, hd_vec3(-half_side, half_side, z), hd_vec3(half_side, half_side, z),
                hd_vec3(half_side, -half_side, z), hd_vec3(-half_side, -half_side, z));
}

void build_camera(HdCamera *camera, HdVec3 eye, HdVec3 target, double field_of_view_degrees) {
    double sine, cosine;
    camera->eye = eye;
    camera->forward = hd_normalize(hd_sub(target, eye));
    camera->right = hd_normalize(hd_cross(camera->forward, hd_vec3(0.0, 0.0, 1.0)));
    camera->up = hd_cross(camera->right, camera->forward);
    hd_sine_cosine(field_of_view_degrees * HD_PI / 360.0, &sine, &cosine);
    camera->tangent_of_half_fov = sine / cosine;
}
