/* SPDX-License-Identifier: MIT */
#include "hunt.h"

#include <math.h>
#include <stdlib.h>

#include "../../scenes/models/random.h"
#include "hunt_mesh_materials.h"
#include "scene/platonic.h"
#include "verify/scene_builder.h"

/* Depths along y, and radiances. The floor and the background have one radiance of their own in red
   and green; the light adds to the floor's green. */
#define FLOOR_DEPTH 5.0
#define WALL_DEPTH  0.1
#define GLOW        0.25
#define LIGHT       0.5

/* In the second, third and fourth the eye looks along x, z and -y of the mesh. In the fifth and the
   sixth the dominant axis of its rays changes within the picture. Single precision resolves the
   sheets in all of them: its steps at 200 times the scale are 1/500 of a pixel's width there. */
const Placement placements[PLACEMENT_COUNT] = {
    {"size 1", 1.0, {0, 0, 0}, {0, 0, 0}, 0},
    {"size 1e-4, along x", 1e-4, {1, -2, 3}, {0, 0, 90}, 0},
    {"size 1e4, along z", 1e4, {-30, 20, 10}, {90, 0, 0}, 0},
    {"1e3 away, turned round", 1.0, {1e3, 700, -400}, {0, 0, 180}, 0},
    {"size 1e-3, 1e5 away, askew", 1e-3, {1e5, -3e4, 2e4}, {10, 20, 45}, 0},
    {"size 1e3, 1e4 away, askew", 1e3, {1e4, 1e4, 1e4}, {45, 35.264, 30}, 0},
    {"another mesh 50 away", 0.37, {0, 0, 0}, {12, 34, 56}, 50},
    {"another mesh 400 away", 30, {1e3, 0, 0}, {-70, 110, 5}, 400},
};

static HdMaterial nothing(void) {
    return (HdMaterial){.colour = hd_vec3(1.0, 1.0, 1.0),
                        .mirror_tint = hd_vec3(1.0, 1.0, 1.0),
                        .shininess = 1,
                        .index_of_refraction = 1.0};
}

static HdMaterial clear(void) {
    HdMaterial material = nothing();
    material.transmission = material.inner_transmission = 0.5;
    return material;
}

static HdMaterial glowing(void) {
    HdMaterial material = nothing();
    material.ambient = GLOW;
    material.diffuse = 1.0;
    return material;
}

/* Converts the eye's coordinates to the world's. */
static HdVec3 in_world(const Hunt *hunt, HdVec3 p) {
    return hd_scale(hd_add(p, hunt->placement->offset), hunt->placement->scale);
}

/* Rotates a mesh so that the instance, which rotates it back, keeps its place. */
static void unturn(HdMesh *mesh, HdVec3 rotation_degrees) {
    HdVec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    hd_rotate_points(axes, 3, rotation_degrees);
    for (int i = 0; i < mesh->vertex_count; i++) {
        HdVec3 p = mesh->vertices[i];
        mesh->vertices[i] = hd_vec3(hd_dot(axes[0], p), hd_dot(axes[1], p), hd_dot(axes[2], p));
    }
}

static void place(Hunt *hunt, int index, int mesh, HdVec3 position, HdVec3 rotation_degrees) {
    build_instance(&hunt->scene, index, mesh, in_world(hunt, position), rotation_degrees,
                   hunt->placement->scale);
}

static bool is_room(HuntKind kind) {
    return kind == HUNT_ROOM || kind == HUNT_WEDGE;
}

static bool has_light(HuntKind kind) {
    return kind != HUNT_MIRRORS && !is_room(kind);
}

/* Fills the expected crossings of pixels behind the sheets and of their shadow rays. */
static void know_sheets(Hunt *hunt) {
    int last = hunt->side - 1 - HUNT_RIM;
    for (int y = 0; y < hunt->side; y++)
        for (int x = 0; x < hunt->side; x++) {
            int least = x < y ? x : y, most = x > y ? x : y;
            HuntPixel pixel = PIXEL_WITHIN;
            if (least < HUNT_RIM || most > last)
                pixel = PIXEL_FREE;
            else if (least == HUNT_RIM || most == last)
                pixel = PIXEL_RIM;
            hunt->pixels[y * hunt->side + x] = pixel;
            hunt->is_lit[y * hunt->side + x] =
                has_light(hunt->kind) &&
                (hunt->kind != HUNT_SPOTS || random_bits(&hunt->random) % 6 == 0);
        }
}

static void add_floor(Hunt *hunt) {
    double most = 1.1 * HUNT_TANGENT * FLOOR_DEPTH;
    build_floor(&hunt->scene, in_world(hunt, hd_vec3(-most, FLOOR_DEPTH, most)),
                in_world(hunt, hd_vec3(most, FLOOR_DEPTH, most)),
                in_world(hunt, hd_vec3(most, FLOOR_DEPTH, -most)),
                in_world(hunt, hd_vec3(-most, FLOOR_DEPTH, -most)));
    hunt->scene.floor.material = glowing();
}

/* Meshes: the sheets, the spots or mirrors if any, the stray one if any. */
static void add_meshes(Hunt *hunt) {
    HdScene *scene = &hunt->scene;
    const Placement *placement = hunt->placement;
    const HdMaterial passing = clear(), opaque = nothing(), glow = glowing();
    HdMaterial mirror = nothing();
    mirror.reflection = mirror.inner_reflection = 1.0;
    double roughness = random_between(&hunt->random, 0.5, 4.0);
    bool has_second = hunt->kind == HUNT_SPOTS || hunt->kind == HUNT_MIRRORS;
    bool has_stray = placement->stray > 0.0;
    const HdVec3 straight = {0.0, 0.0, 0.0};
    build_meshes(scene, 1 + has_second + has_stray, 1 + has_second + has_stray, 0);
    if (hunt->kind == HUNT_MIRRORS) {
        build_sphere_mesh(&scene->meshes[0], hunt->side / 3, 0.1, false, false, &passing);
        build_mirrors(&scene->meshes[1], hunt->side, WALL_DEPTH, &scene->meshes[0],
                      placement->rotation_degrees, &mirror, &hunt->random);
    } else {
        build_mesh_material(&scene->meshes[0],
                            hunt->kind == HUNT_ROOM    ? MATERIAL_ROOM
                            : hunt->kind == HUNT_WEDGE ? MATERIAL_WEDGE
                                                       : MATERIAL_SHEETS,
                            hunt->side, roughness, is_room(hunt->kind) ? &mirror : &passing,
                            &hunt->random);
        unturn(&scene->meshes[0], placement->rotation_degrees);
        scene->meshes[0].materials[0].is_opaque_to_shadows = hunt->kind == HUNT_SHADE;
    }
    if (hunt->kind == HUNT_SPOTS)
        build_spots(&scene->meshes[1], hunt->side, hunt->is_lit, FLOOR_DEPTH, &glow);
    place(hunt, 0, 0, straight, placement->rotation_degrees);
    if (has_second)
        place(hunt, 1, 1, straight, straight);
    if (has_stray) {
        build_cube_mesh(&scene->meshes[1 + has_second], &opaque, &opaque);
        place(hunt, 1 + has_second, 1 + has_second,
              hd_vec3(placement->stray, 0.2 * placement->stray, 0.0), straight);
    }
    scene->accel = HD_ACCEL_BVH;
    finish_meshes(scene);
}

void hunt_begin(Hunt *hunt, HuntKind kind, const Placement *placement, int side, uint64_t seed) {
    size_t count = (size_t)side * (size_t)side;
    *hunt = (Hunt){.kind = kind, .placement = placement, .side = side, .random = seed};
    hunt->surfaces = kind == HUNT_MIRRORS ? 1 : 2;
    hunt->pixels = hunt_allocate(count, sizeof *hunt->pixels);
    hunt->is_lit = hunt_allocate(count, sizeof *hunt->is_lit);
    build_scene(&hunt->scene, side, side, 1, 8, 0, has_light(kind));
    hunt->scene.background = hd_vec3(GLOW, GLOW, 0.0);
    if (kind == HUNT_MIRRORS) {
        for (size_t i = 0; i < count; i++)
            hunt->pixels[i] = PIXEL_WITHIN;
    } else {
        know_sheets(hunt);
        hunt_move_light(hunt, 0.0);
    }
    if (kind == HUNT_FLOOR || kind == HUNT_SHADE)
        add_floor(hunt);
    add_meshes(hunt);
}

/* Returns a vector of up to 64 steps; short ones are as likely as long ones. */
static HdVec3 small_move(uint64_t *random, double step) {
    double length = step * exp2(random_between(random, -2.0, 6.0));
    HdVec3 move = {random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0),
                   random_between(random, -1.0, 1.0)};
    return hd_scale(move, length);
}

void hunt_move_light(Hunt *hunt, double step) {
    hunt->light = small_move(&hunt->random, step);
    if (hunt->scene.light_count > 0)
        build_light(&hunt->scene, 0, in_world(hunt, hunt->light), hd_vec3(0.0, LIGHT, 0.0));
}

HdCamera hunt_camera(Hunt *hunt, double step) {
    return (HdCamera){.eye = in_world(hunt, small_move(&hunt->random, step)),
                      .right = {1.0, 0.0, 0.0},
                      .up = {0.0, 0.0, 1.0},
                      .forward = {0.0, 1.0, 0.0},
                      .tangent_of_half_fov = HUNT_TANGENT};
}

/* If the share of radiance is no power of a half, the cause is unknown; it counts as a leak. */
static void judge_ray(double share, int surfaces, HuntPixel pixel, Catch *caught) {
    double crossings = share > 0.0 ? -log2(share) : 1000.0;
    bool is_whole = fabs(crossings - rint(crossings)) < 0.01;
    int count = (int)rint(crossings);
    caught->rays += pixel != PIXEL_FREE;
    if (pixel == PIXEL_FREE)
        surfaces = 0;
    if (pixel == PIXEL_RIM && count % 2 == 0 && is_whole)
        return;
    caught->leaks += count < surfaces || !is_whole;
    caught->double_hits += count > surfaces && is_whole;
}

/* Counts rays that must not arrive. */
static void judge_blocked_ray(double arrived, HuntPixel pixel, Catch *caught) {
    caught->rays += pixel == PIXEL_WITHIN;
    caught->leaks += pixel == PIXEL_WITHIN && arrived != 0.0;
}

/* Returns the light's part of the green of a pixel's floor without the sheets. */
static double light_of(const Hunt *hunt, int x, int y) {
    HdVec3 point = hd_scale(hunt_pixel_ray(hunt->side, x, y), FLOOR_DEPTH);
    HdVec3 way = hd_normalize(hd_sub(hunt->light, point));
    return -way.y * LIGHT;
}

static void judge_pixel(const Hunt *hunt, int x, int y, const float rgb[3], Catch *caught) {
    int i = y * hunt->side + x;
    HuntPixel pixel = hunt->pixels[i];
    double red = (double)rgb[0], lit = (double)rgb[1] - red;
    if (is_room(hunt->kind)) {
        judge_blocked_ray(red, pixel, caught);
        return;
    }
    judge_ray(red / GLOW, hunt->surfaces, pixel, caught);
    if (!hunt->is_lit[i])
        return;
    if (hunt->kind == HUNT_SHADE && pixel != PIXEL_FREE)
        judge_blocked_ray(lit, pixel, caught);
    else
        judge_ray(lit / (light_of(hunt, x, y) * red / GLOW), hunt->surfaces, pixel, caught);
}

void hunt_judge(const Hunt *hunt, const float *rgb, Catch *caught) {
    for (int y = 0; y < hunt->side; y++)
        for (int x = 0; x < hunt->side; x++, rgb += 3)
            judge_pixel(hunt, x, y, rgb, caught);
}

void hunt_end(Hunt *hunt) {
    hd_scene_free(&hunt->scene);
    free(hunt->pixels);
    free(hunt->is_lit);
}
