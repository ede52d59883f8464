/* SPDX-License-Identifier: MIT */
#include "verify/golden_mesh_scenes.h"

#include <stdlib.h>

#include "verify/mesh_builder.h"
#include "verify/scene_builder.h"
#include "scene/triangulate.h"

/* All of these need the same of the kernels (few planes, a depth of at most 8, refraction), so that
   devices that compile them do so once. */

static void two_lights(HdScene *scene) {
    build_light(scene, 0, hd_vec3(3.0, -2.0, 5.0), hd_vec3(1.0, 0.9, 0.8));
    build_light(scene, 1, hd_vec3(-4.0, -1.0, 3.0), hd_vec3(0.3, 0.4, 0.7));
}

/* Curved mirrors of coloured glass beside a solid: a smooth one and a flat one. */
void bumpy_sphere(HdScene *scene, HdCamera *camera) {
    HdMaterial red = build_material(hd_vec3(0.95, 0.5, 0.3), 0.5, 0.4);
    HdMaterial green = build_material(hd_vec3(0.4, 0.9, 0.6), 0.3, 0.6);
    green.index_of_refraction = 1.4;
    green.has_inner_side = true;
    green.inner_reflection = 0.2;
    green.inner_transmission = 0.7;
    build_scene(scene, 80, 60, 2, 6, 1, 2);
    two_lights(scene);
    build_solid(scene, 0, HD_OCTAHEDRON, hd_vec3(0.2, 1.6, 0.3), 1.1, hd_vec3(0.3, 0.6, 1.0), 2);
    build_meshes(scene, 2, 2, 0);
    build_sphere_mesh(&scene->meshes[0], 24, 0.2, true, false, &red);
    build_sphere_mesh(&scene->meshes[1], 9, 0.1, false, false, &green);
    build_instance(scene, 0, 0, hd_vec3(-1.1, 0.0, 0.0), hd_vec3(20.0, 30.0, 40.0), 1.0);
    build_instance(scene, 1, 1, hd_vec3(1.3, -0.4, -0.3), hd_vec3(0.0, 0.0, 0.0), 0.8);
    finish_meshes(scene);
    build_camera(camera, hd_vec3(0.3, -4.0, 1.4), hd_vec3(0.0, 0.0, 0.0), 55.0);
}

/* Enough for a hierarchy over them: textured, of several materials, some with one of their own, one
   stretched, three that overlap. */
void many_instances(HdScene *scene, HdCamera *camera) {
    HdMaterial blue = build_material(hd_vec3(0.4, 0.6, 1.0), 0.4, 0.5);
    blue.index_of_refraction = 1.25;
    HdMaterial gold = build_material(hd_vec3(1.0, 0.8, 0.3), 0.5, 0.0);
    HdMaterial white = build_material(hd_vec3(1.0, 1.0, 1.0), 0.2, 0.3);
    build_scene(scene, 80, 60, 2, 5, 0, 2);
    two_lights(scene);
    build_meshes(scene, 2, 11, 1);
    build_texture(&scene->pictures[0].texture, 9, 7);
    build_cube_mesh(&scene->meshes[0], &blue, &gold);
    build_sphere_mesh(&scene->meshes[1], 10, 0.0, true, true, &white);
    scene->meshes[1].materials[0].picture = 0;
    for (int i = 0; i < 11; i++) {
        int row = i / 4;
        build_instance(scene, i, i % 2,
                       hd_vec3(1.3 * (i % 4) - 2.0, 1.4 * row - 1.0, 0.3 * (i % 3)),
                       hd_vec3(13.0 * i, 21.0 * i, 34.0 * i), 0.4 + 0.05 * (i % 5));
    }
    scene->instances[2].scale = hd_vec3(0.2, 0.5, 0.9);
    scene->instances[6].position = scene->instances[5].position;
    scene->instances[7].has_material = true;
    scene->instances[7].material = gold;
    finish_meshes(scene);
    build_camera(camera, hd_vec3(0.3, -4.5, 2.2), hd_vec3(0.0, 0.0, 0.2), 55.0);
}

/* What the classic scenes look like, all of it triangles: rims, discs, lights on edges, a floor. */
void triangulated_solids(HdScene *scene, HdCamera *camera) {
    HdError error;
    build_scene(scene, 80, 48, 2, 5, 2, 2);
    two_lights(scene);
    build_solid(scene, 0, HD_TETRAHEDRON, hd_vec3(-1.2, 0.1, 0.0), 1.1, hd_vec3(1.0, 0.3, 0.2), 2);
    build_solid(scene, 1, HD_HEXAHEDRON, hd_vec3(1.3, 0.4, 0.2), 1.2, hd_vec3(0.3, 0.9, 0.4), 1);
    scene->solids[1].lights.intensity = 0.3;
    scene->solids[0].face.index_of_refraction = 1.2;
    build_square_floor(scene, 6.0, -1.5);
    build_texture(&scene->floor.texture, 16, 12);
    if (hd_scene_triangulate(scene, 8, 1, &error) != HD_OK)
        abort();
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 60.0);
}

/* Rays that run exactly through edges and corners, from outside and from inside; the one frame that
   tries every triangle. */
void mesh_edges_and_corners(HdScene *scene, HdCamera *camera) {
    HdMaterial clear = build_material(hd_vec3(0.9, 0.8, 1.0), 0.3, 0.6);
    HdMaterial glass = clear;
    glass.index_of_refraction = 1.1;
    build_scene(scene, 65, 65, 1, 6, 0, 2);
    two_lights(scene);
    build_meshes(scene, 2, 2, 0);
    build_cube_mesh(&scene->meshes[0], &clear, &clear);
    build_sphere_mesh(&scene->meshes[1], 8, 0.0, false, false, &glass);
    build_instance(scene, 0, 0, hd_vec3(0.0, 0.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 4.0);
    build_instance(scene, 1, 1, hd_vec3(0.0, 0.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 1.0);
    scene->accel = HD_ACCEL_BRUTE;
    finish_meshes(scene);
    build_camera(camera, hd_vec3(0.0, -3.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 90.0);
}

void mesh_far_from_origin(HdScene *scene, HdCamera *camera) {
    HdVec3 shift = hd_vec3(16384.0, -8192.0, 4096.0);
    bumpy_sphere(scene, camera);
    scene->solids[0].centre = hd_add(scene->solids[0].centre, shift);
    for (int i = 0; i < 2; i++) {
        scene->instances[i].position = hd_add(scene->instances[i].position, shift);
        scene->lights[i].position = hd_add(scene->lights[i].position, shift);
    }
    camera->eye = hd_add(camera->eye, shift);
}
