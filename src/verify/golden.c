/* SPDX-License-Identifier: MIT */
#include "verify/golden.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "scene/triangulate.h"
#include "verify/scene_builder.h"

/* Made at build time from tests/golden/frames.txt. */
extern const unsigned char hd_golden_hashes[];

const HdSceneTables hd_golden_needs = {.plane_count = 32,
                                       .depth = 32,
                                       .node_stack = 32,
                                       .refracts = true,
                                       .lit_from_behind = true,
                                       .many_lights = true,
                                       .cut_outs = true,
                                       .environment = true,
                                       .small_tables = true};

static void two_lights(HdScene *scene) {
    build_light(scene, 0, hd_vec3(3.0, -2.0, 5.0), hd_vec3(1.0, 0.9, 0.8));
    build_light(scene, 1, hd_vec3(-4.0, -1.0, 3.0), hd_vec3(0.3, 0.4, 0.7));
}

static bool one_solid(HdScene *scene, HdCamera *camera, double kind) {
    if (!build_scene(scene, 64, 48, 2, 5, 1, 2) || !build_texture(&scene->floor.texture, 16, 12))
        return false;
    two_lights(scene);
    build_solid(scene, 0, (HdSolidKind)kind, hd_vec3(0.1, 0.2, 0.05), 1.2, hd_vec3(0.9, 0.6, 0.3),
                3);
    build_square_floor(scene, 4.0, -1.3);
    build_camera(camera, hd_vec3(2.3, -2.9, 1.4), hd_vec3(0.0, 0.0, 0.0), 50.0);
    return true;
}

static bool three_solids(HdScene *scene, HdCamera *camera, double spacing) {
    if (!build_scene(scene, 80, 48, 2, 6, 3, 2))
        return false;
    two_lights(scene);
    build_solid(scene, 0, HD_TETRAHEDRON, hd_vec3(-spacing, 0.1, 0.0), 1.1, hd_vec3(1.0, 0.3, 0.2),
                2);
    build_solid(scene, 1, HD_OCTAHEDRON, hd_vec3(0.0, 0.4, 0.2), 1.0, hd_vec3(0.3, 0.9, 0.4), 2);
    build_solid(scene, 2, HD_DODECAHEDRON, hd_vec3(spacing, 0.0, 0.1), 1.2, hd_vec3(0.3, 0.5, 1.0),
                1);
    build_square_floor(scene, 6.0, -1.5);
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 65.0);
    return true;
}

static bool three_textured(HdScene *scene, HdCamera *camera, double spacing) {
    return three_solids(scene, camera, spacing) && build_texture(&scene->floor.texture, 24, 24);
}

/* A picture all around, in a mirror and through clear faces; the view holds a pole and the seam. */
static bool under_a_sky(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    if (!build_scene(scene, 64, 48, 2, 6, 2, 2) || !build_sky(scene, 20, 10, 2.5, 130.0))
        return false;
    two_lights(scene);
    build_solid(scene, 0, HD_OCTAHEDRON, hd_vec3(-1.0, 0.4, 0.0), 1.1, hd_vec3(1.0, 0.9, 0.8), 1);
    build_solid(scene, 1, HD_TETRAHEDRON, hd_vec3(1.1, 0.1, -0.1), 1.2, hd_vec3(0.9, 1.0, 0.9), 1);
    build_camera(camera, hd_vec3(0.2, -2.2, -2.6), hd_vec3(0.0, 0.0, 0.6), 110.0);
    return true;
}

/* The eye lies exactly on the face x = 1 of a hexahedron with half-integer centre and edge 2, and
   looks along and into it. */
static bool eye_on_face(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    if (!build_scene(scene, 64, 48, 1, 6, 1, 2))
        return false;
    two_lights(scene);
    build_solid(scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 0.0), sqrt(3.0), hd_vec3(0.8, 0.7, 1.0),
                4);
    build_square_floor(scene, 4.0, -1.25);
    build_camera(camera, hd_vec3(1.0, -0.25, 0.125), hd_vec3(0.75, 0.5, 0.0), 120.0);
    return true;
}

/* The picture's centre is a vertex, and its middle row and column run along edges: odd sizes put
   sample rays exactly there. */
static bool edges_and_corners(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    if (!build_scene(scene, 65, 65, 1, 8, 2, 2))
        return false;
    two_lights(scene);
    build_solid(scene, 0, HD_OCTAHEDRON, hd_vec3(0.0, 0.0, 0.0), 1.0, hd_vec3(0.6, 0.9, 0.9), 3);
    build_solid(scene, 1, HD_HEXAHEDRON, hd_vec3(0.0, 4.0, 0.0), 2.0 * sqrt(3.0),
                hd_vec3(1.0, 0.8, 0.5), 1);
    scene->solids[0].rim_width = 0.0;
    scene->solids[1].rim_width = 0.0;
    build_camera(camera, hd_vec3(0.0, -3.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 45.0);
    return true;
}

static bool fifty_edge_lights(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    if (!build_scene(scene, 48, 36, 2, 6, 1, 0) || !build_texture(&scene->floor.texture, 7, 31))
        return false;
    build_solid(scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 0.2), 1.5, hd_vec3(0.7, 0.4, 0.9), 50);
    scene->solids[0].lights.disc_radius = 0.01;
    build_square_floor(scene, 5.0, -1.2);
    build_camera(camera, hd_vec3(2.6, -2.2, 1.9), hd_vec3(0.0, 0.0, 0.0), 55.0);
    return true;
}

static void tilted_floor(HdScene *scene) {
    build_floor(scene, hd_vec3(-4.0, 4.0, -0.5), hd_vec3(4.0, 4.0, -1.5), hd_vec3(4.0, -4.0, -2.5),
                hd_vec3(-4.0, -4.0, -1.5));
}

static void trapezoid_floor(HdScene *scene) {
    build_floor(scene, hd_vec3(-1.0, 5.0, -1.3), hd_vec3(2.0, 4.0, -1.3), hd_vec3(6.0, -4.0, -1.3),
                hd_vec3(-5.0, -3.0, -1.3));
}

static void white_faces(HdScene *scene) {
    for (int s = 0; s < scene->solid_count; s++)
        scene->solids[s].face.colour = hd_vec3(1.0, 1.0, 1.0);
}

static void cut_off(HdScene *scene) {
    scene->cutoff = 0.02;
    scene->exposure = 1.5;
}

static void clamped(HdScene *scene) {
    scene->lights[0].intensity = hd_vec3(1e12, 1e12, 1e12);
}

static bool empty_scene(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    if (!build_scene(scene, 9, 5, 1, 3, 0, 0))
        return false;
    build_camera(camera, hd_vec3(0.0, -1.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 60.0);
    return true;
}

static void refract(HdSolid *solid, double index, double reflection, double transmission) {
    solid->face.index_of_refraction = index;
    solid->face.reflection = reflection;
    solid->face.transmission = transmission;
    solid->face.diffuse = 0.05;
}

static void glass_cube(HdScene *scene) {
    scene->solids[0].rotation_degrees = hd_vec3(15.0, 25.0, 35.0);
    scene->solids[0].face.colour = hd_vec3(0.9, 0.97, 1.0);
    refract(&scene->solids[0], 1.5, 0.1, 0.85);
}

/* Most of the picture is total reflection. */
static void dense_glass(HdScene *scene) {
    glass_cube(scene);
    refract(&scene->solids[0], 2.4, 0.15, 0.8);
}

/* An index below 1, as of air in water: total reflection on the outer side. */
static void bubble(HdScene *scene) {
    scene->solids[0].face.colour = hd_vec3(1.0, 1.0, 1.0);
    scene->solids[0].lights.per_edge = 0;
    refract(&scene->solids[0], 0.75, 0.05, 0.9);
}

static void glass_dodecahedron(HdScene *scene) {
    scene->solids[0].face.colour = hd_vec3(1.0, 0.93, 0.85);
    scene->solids[0].face.has_inner_side = true;
    scene->solids[0].face.inner_reflection = 0.3;
    scene->solids[0].face.inner_transmission = 0.6;
    scene->solids[0].rim_width = 0.0;
    refract(&scene->solids[0], 1.33, 0.08, 0.9);
}

/* Mirrors outside and nearly clear inside. */
static void inner_sides(HdScene *scene) {
    for (int s = 0; s < 3; s++) {
        HdMaterial *face = &scene->solids[s].face;
        face->has_inner_side = true;
        face->inner_reflection = 0.1 * s;
        face->inner_transmission = 0.8;
    }
}

static void colour_edges(HdSolid *solid) {
    static const HdVec3 colours[] = {
        {1.0, 0.1, 0.1}, {0.1, 1.0, 0.2}, {0.2, 0.3, 1.0}, {1.0, 0.8, 0.1}};
    solid->lights.colour_count = 4;
    for (int i = 0; i < 4; i++)
        solid->lights.colours[i] = colours[i];
}

static void coloured_edges(HdScene *scene) {
    for (int s = 0; s < 3; s++) {
        scene->solids[s].rotation_degrees = hd_vec3(20.0 * s, 35.0, -50.0);
        scene->solids[s].lights.intensity = 0.15;
        scene->solids[s].lights.disc_radius = 0.06;
        colour_edges(&scene->solids[s]);
    }
}

static void ending_lights(HdScene *scene) {
    colour_edges(&scene->solids[0]);
    scene->solids[0].lights.per_edge = 1;
    scene->solids[0].lights.intensity = 1.5;
    scene->solids[0].lights.falloff = (HdFalloff){.end = 1.6};
    build_light(scene, 0, hd_vec3(1.3, -1.8, -0.6), hd_vec3(1.5, 1.2, 0.9));
    build_light(scene, 1, hd_vec3(-1.4, 1.6, 0.2), hd_vec3(0.6, 0.9, 1.5));
    for (int i = 0; i < 2; i++)
        scene->lights[i].falloff = (HdFalloff){.end = 1.0 + 1.2 * i};
}

/* Many lights on each edge, culled by clusters: some points are too far from all or some. */
static void runs_of_lights(HdScene *scene) {
    for (int s = 0; s < 3; s++) {
        colour_edges(&scene->solids[s]);
        scene->solids[s].lights.per_edge = 6;
        scene->solids[s].lights.intensity = 0.1;
        scene->solids[s].lights.falloff = (HdFalloff){.end = 0.7 + 0.3 * s};
    }
}

/* Lanterns: paper faces over the solid's own lights, and a lamp below a thin floor. */
static void lanterns(HdScene *scene) {
    HdSolid *solid = &scene->solids[0];
    colour_edges(solid);
    solid->lights.per_edge = 1;
    solid->lights.intensity = 0.15;
    solid->face.reflection = 0.1;
    solid->face.transmission = 0.5;
    solid->face.diffuse = 0.8;
    solid->face.lit_from_behind = true;
    scene->floor.material.reflection = 0.1;
    scene->floor.material.transmission = 0.6;
    scene->floor.material.lit_from_behind = true;
    build_light(scene, 1, hd_vec3(-1.5, -0.5, -2.2), hd_vec3(0.9, 0.9, 0.5));
}

static void everything(HdScene *scene) {
    scene->cutoff = 0.001;
    for (int s = 0; s < 3; s++) {
        HdSolid *solid = &scene->solids[s];
        solid->rotation_degrees = hd_vec3(-30.0, 10.0 * s, 65.0);
        colour_edges(solid);
        solid->lights.intensity = 0.15;
        solid->lights.falloff = (HdFalloff){.end = 2.5};
        refract(solid, s == 1 ? 0.8 : 1.4 + 0.3 * s, 0.15, 0.8);
        solid->face.has_inner_side = true;
        solid->face.inner_reflection = 0.2;
        solid->face.inner_transmission = 0.75;
        solid->face.diffuse = 0.4;
        solid->face.lit_from_behind = s != 1;
    }
    scene->lights[1].falloff.end = 6.0;
}

/* ---- meshes: few planes, a depth of at most 8 ---- */

/* Curved mirrors of coloured glass next to a solid: a smooth one and a flat one. */
static bool bumpy_sphere(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    HdMaterial red = build_material(hd_vec3(0.95, 0.5, 0.3), 0.5, 0.4);
    HdMaterial green = build_material(hd_vec3(0.4, 0.9, 0.6), 0.3, 0.6);
    green.index_of_refraction = 1.4;
    green.has_inner_side = true;
    green.inner_reflection = 0.2;
    green.inner_transmission = 0.7;
    if (!build_scene(scene, 80, 60, 2, 6, 1, 2) || !build_meshes(scene, 2, 2, 0) ||
        !build_sphere_mesh(&scene->meshes[0], 24, 0.2, true, false, &red) ||
        !build_sphere_mesh(&scene->meshes[1], 9, 0.1, false, false, &green))
        return false;
    two_lights(scene);
    build_solid(scene, 0, HD_OCTAHEDRON, hd_vec3(0.2, 1.6, 0.3), 1.1, hd_vec3(0.3, 0.6, 1.0), 2);
    build_instance(scene, 0, 0, hd_vec3(-1.1, 0.0, 0.0), hd_vec3(20.0, 30.0, 40.0), 1.0);
    build_instance(scene, 1, 1, hd_vec3(1.3, -0.4, -0.3), hd_vec3(0.0, 0.0, 0.0), 0.8);
    build_camera(camera, hd_vec3(0.3, -4.0, 1.4), hd_vec3(0.0, 0.0, 0.0), 55.0);
    return finish_meshes(scene);
}

/* Enough instances for a hierarchy over them: textured, of several materials, some with one of
   their own, one stretched, three that overlap. */
static bool many_instances(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    HdMaterial blue = build_material(hd_vec3(0.4, 0.6, 1.0), 0.4, 0.5);
    blue.index_of_refraction = 1.25;
    HdMaterial gold = build_material(hd_vec3(1.0, 0.8, 0.3), 0.5, 0.0);
    HdMaterial white = build_material(hd_vec3(1.0, 1.0, 1.0), 0.2, 0.3);
    if (!build_scene(scene, 80, 60, 2, 5, 0, 2) || !build_meshes(scene, 2, 11, 1) ||
        !build_texture(&scene->pictures[0].texture, 9, 7) ||
        !build_cube_mesh(&scene->meshes[0], &blue, &gold) ||
        !build_sphere_mesh(&scene->meshes[1], 10, 0.0, true, true, &white))
        return false;
    two_lights(scene);
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
    build_camera(camera, hd_vec3(0.3, -4.5, 2.2), hd_vec3(0.0, 0.0, 0.2), 55.0);
    return finish_meshes(scene);
}

/* Holes in the textured instances, before others and before lights; coloured corners. */
static bool cut_outs(HdScene *scene, HdCamera *camera, double variant) {
    if (!many_instances(scene, camera, variant))
        return false;
    scene->meshes[1].materials[0].mask_picture = 0;
    return build_colours(&scene->meshes[0]);
}

/* The look of the classic scenes, made of triangles: rims, discs, lights on edges, a floor. */
static bool triangulated_solids(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    HdError error;
    if (!build_scene(scene, 80, 48, 2, 5, 2, 2) || !build_texture(&scene->floor.texture, 16, 12))
        return false;
    two_lights(scene);
    build_solid(scene, 0, HD_TETRAHEDRON, hd_vec3(-1.2, 0.1, 0.0), 1.1, hd_vec3(1.0, 0.3, 0.2), 2);
    build_solid(scene, 1, HD_HEXAHEDRON, hd_vec3(1.3, 0.4, 0.2), 1.2, hd_vec3(0.3, 0.9, 0.4), 1);
    scene->solids[1].lights.intensity = 0.3;
    scene->solids[0].face.index_of_refraction = 1.2;
    build_square_floor(scene, 6.0, -1.5);
    build_camera(camera, hd_vec3(0.4, -4.5, 1.2), hd_vec3(0.0, 0.0, 0.0), 60.0);
    return hd_scene_triangulate(scene, 8, 1, &error) == HD_OK;
}

/* Rays run exactly through edges and corners, from outside and from inside; the only frame that
   tests every triangle. */
static bool mesh_edges_and_corners(HdScene *scene, HdCamera *camera, double variant) {
    (void)variant;
    HdMaterial clear = build_material(hd_vec3(0.9, 0.8, 1.0), 0.3, 0.6);
    HdMaterial glass = clear;
    glass.index_of_refraction = 1.1;
    if (!build_scene(scene, 65, 65, 1, 6, 0, 2) || !build_meshes(scene, 2, 2, 0) ||
        !build_cube_mesh(&scene->meshes[0], &clear, &clear) ||
        !build_sphere_mesh(&scene->meshes[1], 8, 0.0, false, false, &glass))
        return false;
    two_lights(scene);
    build_instance(scene, 0, 0, hd_vec3(0.0, 0.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 4.0);
    build_instance(scene, 1, 1, hd_vec3(0.0, 0.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 1.0);
    scene->accel = HD_ACCEL_BRUTE;
    build_camera(camera, hd_vec3(0.0, -3.0, 0.0), hd_vec3(0.0, 0.0, 0.0), 90.0);
    return finish_meshes(scene);
}

/* For frames that test compiled kernels. */
static void without_refraction(HdScene *scene) {
    for (int i = 0; i < scene->mesh_count; i++)
        scene->meshes[i].materials[0].material.index_of_refraction = 1.0;
}

static void paper_instances(HdScene *scene) {
    without_refraction(scene);
    for (int i = 0; i < scene->mesh_count; i++)
        scene->meshes[i].materials[0].material.lit_from_behind = true;
}

/* ---- frames with an error bound ---- */

/* Rays and lights that are left out; repeated passes. */
static void bounded_grid(HdScene *scene) {
    everything(scene);
    scene->cutoff = 0.0;
    scene->max_error = 4.0;
}

static void crop_of_reference(HdScene *scene) {
    scene->samples_per_side = 3;
    scene->sampling = HD_SAMPLING_REFERENCE;
    scene->max_error = 0.5;
    scene->crop = (HdCrop){.whole_width = scene->width,
                           .whole_height = scene->height,
                           .left = scene->width / 3,
                           .top = scene->height / 4};
    scene->width /= 3;
    scene->height /= 2;
}

/* ---- multi-jittered samples ---- */

static void crop_of_multijitter(HdScene *scene) {
    everything(scene);
    scene->sampling = HD_SAMPLING_MULTIJITTER;
    scene->sample_rows = 2;
    scene->crop =
        (HdCrop){2 * scene->width, 2 * scene->height, scene->width / 3, scene->height / 4};
}

static void bounded_multijitter(HdScene *scene) {
    scene->sampling = HD_SAMPLING_MULTIJITTER;
    scene->max_error = 2.0;
}

/* ---- the list ---- */

#define SOLID(kind) .base = one_solid, .variant = HD_##kind
#define SEPARATE    .base = three_solids, .variant = 2.4
#define OVERLAPPING .base = three_solids, .variant = 0.7
#define TEXTURED    .base = three_textured, .variant = 2.0
#define SIZE(w, h, samples, levels)                                                                \
    .width = (w), .height = (h), .samples_per_side = (samples), .depth = (levels)
#define FACES(r, t)                  .reflection = (r), .transmission = (t)
#define VIEW(x, y, z, tx, ty, tz, d) .eye = {x, y, z}, .target = {tx, ty, tz}, .degrees = (d)
#define IN_FRONT(d)                  VIEW(0.4, -4.5, 1.2, 0.0, 0.0, 0.0, d)
#define FEW_INSTANCES                .base = many_instances, SIZE(40, 30, 1, 0), .tests_build = true

const HdGoldenFrame hd_golden_frames[] = {
    {.name = "tetrahedron", SOLID(TETRAHEDRON)},
    {.name = "hexahedron", SOLID(HEXAHEDRON), .tests_build = true},
    {.name = "octahedron", SOLID(OCTAHEDRON)},
    {.name = "dodecahedron", SOLID(DODECAHEDRON)},
    {.name = "icosahedron", SOLID(ICOSAHEDRON)},
    {.name = "three-apart", SEPARATE},
    {.name = "three-overlapping", OVERLAPPING},
    {.name = "eye-inside", SEPARATE, VIEW(2.5, 0.1, 0.2, 0.0, 0.3, 0.0, 80.0)},
    {.name = "eye-on-face", .base = eye_on_face},
    {.name = "eye-on-floor-plane", SEPARATE, VIEW(0.5, -4.0, -1.5, 0.0, 0.0, -1.5, 70.0)},
    {.name = "edges-and-corners", .base = edges_and_corners},
    {.name = "fifty-edge-lights", .base = fifty_edge_lights},
    {.name = "tilted-floor", SOLID(ICOSAHEDRON), .change = tilted_floor},
    {.name = "trapezoid-floor", SOLID(TETRAHEDRON), .change = trapezoid_floor},
    {.name = "all-of-the-light",
     SEPARATE,
     SIZE(40, 24, 2, 12),
     FACES(0.7, 0.3),
     .change = white_faces},
    {.name = "mirror-only", SEPARATE, .depth = 20, .reflection = 0.95},
    {.name = "glass-only", OVERLAPPING, .depth = 10, .transmission = 0.9},
    {.name = "one-pixel", SEPARATE, SIZE(1, 1, 7, 0)},
    {.name = "wide-strip", SEPARATE, SIZE(1023, 7, 1, 0), IN_FRONT(150.0)},
    {.name = "right-angle-view", SEPARATE, SIZE(80, 48, 3, 0), IN_FRONT(90.0)},
    {.name = "widest-view", SEPARATE, IN_FRONT(178.0)},
    {.name = "cut-off", SEPARATE, .depth = 12, .change = cut_off},
    {.name = "far-from-origin", SEPARATE, .is_far = true},
    {.name = "clamped", SOLID(OCTAHEDRON), .change = clamped},
    {.name = "empty-scene", .base = empty_scene},
    {.name = "inner-sides", OVERLAPPING, FACES(0.7, 0.25), .change = inner_sides},
    {.name = "coloured-edges", SEPARATE, .change = coloured_edges},
    {.name = "ending-lights", SOLID(DODECAHEDRON), .change = ending_lights},
    {.name = "runs-of-lights", SEPARATE, SIZE(80, 48, 1, 4), .change = runs_of_lights},
    {.name = "glass-cube", SOLID(HEXAHEDRON), .depth = 8, .change = glass_cube},
    {.name = "eye-inside-glass",
     SOLID(HEXAHEDRON),
     SIZE(64, 48, 1, 8),
     VIEW(0.2, 0.1, 0.15, -0.3, 0.9, -0.4, 100.0),
     .change = dense_glass,
     .tests_build = true},
    {.name = "bubble", SOLID(OCTAHEDRON), .change = bubble},
    {.name = "glass-dodecahedron", SOLID(DODECAHEDRON), .change = glass_dodecahedron},
    {.name = "lanterns", SOLID(ICOSAHEDRON), .change = lanterns},
    {.name = "everything", TEXTURED, SIZE(80, 48, 1, 10), .change = everything},
    {.name = "bumpy-sphere", .base = bumpy_sphere},
    {.name = "many-instances", .base = many_instances},
    {.name = "cut-outs", .base = cut_outs},
    {.name = "triangulated-solids", .base = triangulated_solids},
    {.name = "mesh-edges-and-corners", .base = mesh_edges_and_corners, .tests_build = true},
    {.name = "mesh-far-from-origin", .base = bumpy_sphere, .is_far = true},
    {.name = "bounded-grid", TEXTURED, SIZE(80, 48, 4, 24), .change = bounded_grid},
    {.name = "crop-of-reference", .base = many_instances, .change = crop_of_reference},
    {.name = "crop-of-multijitter", TEXTURED, SIZE(45, 31, 3, 8), .change = crop_of_multijitter},
    {.name = "bounded-multijitter",
     SOLID(DODECAHEDRON),
     SIZE(40, 24, 5, 12),
     .change = bounded_multijitter},
    {.name = "paper-cube", SOLID(HEXAHEDRON), .change = lanterns, .tests_build = true},
    {.name = "plain-instances", FEW_INSTANCES, .change = without_refraction},
    {.name = "paper-instances", FEW_INSTANCES, .change = paper_instances},
    {.name = "under-a-sky", .base = under_a_sky, .tests_build = true},
};
const int hd_golden_frame_count = (int)(sizeof hd_golden_frames / sizeof hd_golden_frames[0]);

const HdGoldenFrame *hd_golden_find(const char *name) {
    for (int i = 0; i < hd_golden_frame_count; i++)
        if (strcmp(hd_golden_frames[i].name, name) == 0)
            return &hd_golden_frames[i];
    return NULL;
}

static void shift(HdScene *scene, HdCamera *camera) {
    const HdVec3 by = {16384.0, -8192.0, 4096.0};
    for (int i = 0; i < scene->solid_count; i++)
        scene->solids[i].centre = hd_add(scene->solids[i].centre, by);
    for (int i = 0; i < scene->instance_count; i++)
        scene->instances[i].position = hd_add(scene->instances[i].position, by);
    for (int i = 0; i < scene->light_count; i++)
        scene->lights[i].position = hd_add(scene->lights[i].position, by);
    for (int i = 0; i < 4; i++)
        scene->floor.corners[i] = hd_add(scene->floor.corners[i], by);
    camera->eye = hd_add(camera->eye, by);
}

static void change(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera) {
    if (frame->width > 0) {
        scene->width = frame->width;
        scene->height = frame->height;
        scene->samples_per_side = frame->samples_per_side;
    }
    if (frame->depth > 0)
        scene->depth = frame->depth;
    if (frame->degrees > 0.0)
        build_camera(camera, frame->eye, frame->target, frame->degrees);
    for (int s = 0; s < scene->solid_count && frame->reflection + frame->transmission > 0.0; s++) {
        scene->solids[s].face.reflection = frame->reflection;
        scene->solids[s].face.transmission = frame->transmission;
    }
    if (frame->is_far)
        shift(scene, camera);
    if (frame->change != NULL)
        frame->change(scene);
}

HdStatus hd_golden_build(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera,
                         HdError *error) {
    if (!frame->base(scene, camera, frame->variant)) {
        hd_scene_free(scene);
        return HD_NO_ROOM(error, "the golden frame '%s'", frame->name);
    }
    change(frame, scene, camera);
    return HD_OK;
}

bool hd_golden_find_hashes(const char *name, HdPrecision precision, HdGoldenHashes *hashes) {
    size_t length = strlen(name);
    *hashes = (HdGoldenHashes){0};
    for (const char *line = (const char *)hd_golden_hashes; line != NULL && *line != '\0';
         line = strchr(line, '\n')) {
        line += *line == '\n';
        uint64_t frame[2], first_hits[2];
        if (strncmp(line, name, length) != 0 || line[length] != ' ' ||
            sscanf(line + length, "%" SCNx64 " %" SCNx64 " %" SCNx64 " %" SCNx64, &frame[0],
                   &frame[1], &first_hits[0], &first_hits[1]) != 4)
            continue;
        *hashes = (HdGoldenHashes){frame[precision], first_hits[precision]};
        return true;
    }
    return false;
}
