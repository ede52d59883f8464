/* SPDX-License-Identifier: MIT */
/* Effects of a change of the scene on the picture: none, or a known one. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/trigonometry.h"
#include "scene/camera.h"
#include "scene/triangulate.h"
#include "truths.h"
#include "verify/scene_builder.h"

enum { WIDTH = 48, HEIGHT = 36, SIDE = 32 };

/* Truths that are yes or no. */
static void expect_true(Check *check, const char *truth, bool holds) {
    expect(check, truth, 0, 0, holds ? 1.0 : 0.0, 1.0);
}

/* ---- a scene with all features of solids, lights and floors, on a coarse grid ---- */

typedef struct Place {
    double scale;
    HdVec3 move; /* after the scaling */
} Place;

static HdVec3 placed(const Place *place, double x, double y, double z) {
    return hd_add(hd_scale(hd_vec3(x, y, z), place->scale), place->move);
}

static void build_placed(HdScene *scene, HdCamera *camera, const Place *place) {
    const double s = place->scale;
    build_scene(scene, WIDTH, HEIGHT, 2, 4, 3, 2);
    build_solid(scene, 0, HD_OCTAHEDRON, placed(place, -1.5, 0.25, 0.0), 1.25 * s,
                hd_vec3(1.0, 0.3, 0.2), 2);
    build_solid(scene, 1, HD_HEXAHEDRON, placed(place, 1.5, 0.5, 0.125), 1.25 * s,
                hd_vec3(0.3, 0.5, 1.0), 0);
    build_glass(scene, 2, HD_DODECAHEDRON, placed(place, 0.0, -1.25, -0.25), 0.5 * s, 0.9, 0.8);
    scene->solids[1].rotation_degrees = hd_vec3(10.0, 20.0, 30.0);
    scene->solids[2].face.index_of_refraction = 1.5;
    build_light(scene, 0, placed(place, 3.0, -2.0, 5.0), hd_vec3(1.0, 0.9, 0.8));
    build_light(scene, 1, placed(place, -2.0, -3.0, 2.5), hd_vec3(0.2, 0.5, 0.8));
    scene->lights[1].falloff.distance = 4.0 * s;
    build_square_floor(scene, 5.0, -1.5);
    build_texture(&scene->floor.texture, 8, 8);
    for (int i = 0; i < 4; i++) {
        const HdVec3 corner = scene->floor.corners[i];
        scene->floor.corners[i] = placed(place, corner.x, corner.y, corner.z);
    }
    build_camera(camera, hd_vec3(0.5, -4.0, 1.25), hd_vec3(0.0, 0.0, -0.25), 60.0);
    camera->eye = placed(place, 0.5, -4.0, 1.25);
}

static HdFrame render_placed(const Check *check, const Place *place, HdGeometry geometry) {
    HdScene scene;
    HdCamera camera;
    HdError error;
    build_placed(&scene, &camera, place);
    if (geometry == HD_GEOMETRY_TRIANGLES) {
        scene.samples_per_side = 1; /* a ray takes tens of times as long here */
        if (hd_scene_triangulate(&scene, 8, 2, &error) != HD_OK)
            fail("triangles", &error);
    }
    return render_last(check, &scene, &camera);
}

static void check_same_bytes(Check *check, const char *truth, HdGeometry geometry,
                             const Place *places, int count) {
    const Place origin = {.scale = 1.0};
    HdFrame before = render_placed(check, &origin, geometry);
    for (int i = 0; i < count; i++) {
        HdFrame after = render_placed(check, &places[i], geometry);
        expect_true(check, truth, hd_frame_hash(&after) == hd_frame_hash(&before));
        hd_frame_free(&after);
    }
    hd_frame_free(&before);
}

/* A power of two changes exponents and no digit. */
static void check_scaling(Check *check) {
    const Place places[] = {{.scale = 0x1p-20}, {.scale = 0.5}, {.scale = 0x1p10}};
    check_same_bytes(check, "scaled by a power of two", HD_GEOMETRY_SOLIDS, places, 3);
    check_same_bytes(check, "triangles scaled by a power of two", HD_GEOMETRY_TRIANGLES, places, 3);
}

/* The scene may move on the grid of its coordinates: the kernels get them relative to the eye. */
static void check_moving(Check *check) {
    const Place places[] = {{1.0, {0.125, -0.25, 0.375}},
                            {1.0, {64.0, -128.0, 32.0}},
                            {1.0, {-4096.0, 8192.5, 1024.25}}};
    check_same_bytes(check, "moved on the grid", HD_GEOMETRY_SOLIDS, places, 3);
    check_same_bytes(check, "triangles moved on the grid", HD_GEOMETRY_TRIANGLES, places, 3);
}

/* ---- symmetry ---- */

/* Seen from straight above, the octahedron is the same after a quarter turn. */
static HdFrame render_quarter(const Check *check, bool turned) {
    HdScene scene;
    HdCamera camera = {.eye = {0.0, 0.0, 4.0},
                       .right = {1.0, 0.0, 0.0},
                       .up = {0.0, 1.0, 0.0},
                       .forward = {0.0, 0.0, -1.0},
                       .tangent_of_half_fov = 0.5};
    const HdVec3 centre = {0.3737, 0.1313, 0.0}, light = {2.0, 0.5, 3.0};
    build_scene(&scene, SIDE, SIDE, 2, 4, 1, 1);
    build_solid(&scene, 0, HD_OCTAHEDRON, turned ? hd_vec3(-centre.y, centre.x, 0.0) : centre, 1.0,
                hd_vec3(0.9, 0.6, 0.3), 3);
    build_light(&scene, 0, turned ? hd_vec3(-light.y, light.x, light.z) : light, grey(1.0));
    build_square_floor(&scene, 1.75, -1.25);
    return render_last(check, &scene, &camera);
}

/* (x, y) becomes (-y, x): the pixel in column i and row j becomes column j and row SIDE - 1 - i.
   Rounding may push a sample over an edge. */
static void check_quarter_turn(Check *check) {
    enum { MAX_DIFFERENT = SIDE * SIDE * 3 / 200 };
    int different = 0;
    HdFrame before = render_quarter(check, false), after = render_quarter(check, true);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++)
            for (int c = 0; c < 3; c++)
                different += fabs(channel_of(&after, j, SIDE - 1 - i, c) -
                                  channel_of(&before, i, j, c)) > 1e-3;
    expect_compared(check, "a quarter turn turns the picture", MAX_DIFFERENT - different, 0);
    hd_frame_free(&before);
    hd_frame_free(&after);
}

/* ---- light ---- */

enum { LIGHTS = 7 };

/* Renders with lights alone: no background and no ambient light. */
static HdFrame render_lit(const Check *check, int first_light, double power) {
    const Place origin = {.scale = 1.0};
    HdScene scene, lit;
    HdCamera camera;
    build_placed(&scene, &camera, &origin);
    build_scene(&lit, WIDTH, HEIGHT, 1, 4, 0, LIGHTS);
    free(scene.lights);
    scene.lights = lit.lights;
    scene.light_count = LIGHTS;
    lit.lights = NULL;
    hd_scene_free(&lit);
    for (int i = 0; i < LIGHTS; i++) {
        const double angle = 0.9 * i;
        build_light(&scene, (i + first_light) % LIGHTS,
                    hd_vec3(4.0 * cos(angle), 4.0 * sin(angle), 1.0 + 0.5 * i),
                    hd_scale(hd_vec3(0.1 + 0.1 * i, 0.5, 0.7 - 0.1 * i), 0.3 * power));
    }
    scene.background = grey(0.0);
    scene.solids[0].lights.intensity *= power;
    scene.solids[0].lights.disc_radiance *= power;
    return render_last(check, &scene, &camera);
}

/* Checks that every value of a picture is the same multiple of another's; returns the number of
   values above 1. */
static int expect_times(Check *check, const char *truth, const HdFrame *found, double power,
                        const HdFrame *before) {
    int bright = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < 3; c++) {
                const double expected = power * channel_of(before, x, y, c);
                bright += expected > 1.0;
                expect(check, truth, x, y, channel_of(found, x, y, c), expected);
            }
    return bright;
}

/* Sums of floats depend on their order in the last digits alone. */
static void check_light_order(Check *check) {
    HdFrame before = render_lit(check, 0, 1.0);
    for (int first = 1; first < LIGHTS; first += 2) {
        HdFrame after = render_lit(check, first, 1.0);
        expect_times(check, "another order of the lights", &after, 1.0, &before);
        hd_frame_free(&after);
    }
    hd_frame_free(&before);
}

/* Radiance is linear in the light, also far above 1, where files clamp. */
static void check_doubled_light(Check *check) {
    HdFrame before = render_lit(check, 0, 1.0);
    for (double power = 2.0; power <= 512.0; power *= 16.0) {
        HdFrame after = render_lit(check, 0, power);
        int bright = expect_times(check, "light of more power", &after, power, &before);
        expect_compared(check, "light of more power, above 1", bright, 1);
        hd_frame_free(&after);
    }
    hd_frame_free(&before);
}

/* Renders a point of the floor below the origin, seen from one place and lit from another. One
   solid of glass is on the first segment and two are on the second. Both places have equal height
   and distance, so that only the segments are swapped. */
static double render_swapped(const Check *check, HdVec3 eye, HdVec3 light, double transmission) {
    HdScene scene;
    HdCamera camera;
    const HdVec3 point = {0.0, 0.0, -1.0};
    build_scene(&scene, 1, 1, 1, 16, 3, 1);
    build_glass(&scene, 0, HD_HEXAHEDRON, hd_vec3(1.0, 0.5, 0.5), 0.5, 0.7, transmission);
    build_glass(&scene, 1, HD_TETRAHEDRON, hd_vec3(0.35, 0.7, 0.05), 0.45, 0.6, transmission);
    build_glass(&scene, 2, HD_DODECAHEDRON, hd_vec3(0.75, 1.5, 1.25), 0.5, 0.9, transmission);
    scene.solids[1].rotation_degrees = hd_vec3(20.0, 30.0, 40.0);
    for (int i = 0; i < 3; i++)
        scene.solids[i].face.diffuse = scene.solids[i].face.specular = 0.0;
    build_light(&scene, 0, light, grey(1.0));
    build_square_floor(&scene, 5.0, point.z);
    scene.floor.material = build_material(grey(1.0), 0.0, 0.0);
    scene.floor.material.specular = 0.0;
    scene.background = grey(0.0);
    build_camera(&camera, eye, point, 1e-3);
    HdFrame frame = render_last(check, &scene, &camera);
    const double found = red(&frame, 0, 0);
    hd_frame_free(&frame);
    return found;
}

/* The view ray multiplies the transmissions one by one; a shadow segment does so in its own way. */
static void check_swapped(Check *check) {
    const HdVec3 one = {2.0, 1.0, 2.0}, other = {1.0, 2.0, 2.0};
    const double transmissions[] = {1.0, 0.9, 0.37};
    for (int i = 0; i < 3; i++) {
        const double there = render_swapped(check, one, other, transmissions[i]);
        const double back = render_swapped(check, other, one, transmissions[i]);
        expect_true(check, "eye and light swapped, light arrives", there > 1e-5 && there < 0.5);
        expect_true(check, "eye and light swapped",
                    fabs(there - back) <= 4.0 * (double)FLT_EPSILON * fmin(there, back));
    }
}

/* ---- energy ---- */

/* In a white world, surfaces that mirror, transmit and glow with shares that sum to 1 are at most
   white, and darker if rays end too early. */
static void check_energy(Check *check, double shares) {
    const double indices[] = {1.0, 1.5, 2.4};
    const HdSolidKind kinds[] = {HD_HEXAHEDRON, HD_OCTAHEDRON, HD_ICOSAHEDRON};
    const Place origin = {.scale = 1.0};
    HdScene scene;
    HdCamera camera;
    int white = 0;
    build_placed(&scene, &camera, &origin);
    scene.depth = 12;
    scene.background = grey(1.0);
    scene.light_count = 0;
    for (int i = 0; i < 3; i++) {
        HdSolid *solid = &scene.solids[i];
        const double reflection = shares * (0.2 + 0.3 * i);
        solid->kind = kinds[i];
        solid->rim_width = 0.0;
        solid->lights.per_edge = 0;
        solid->face = build_material(grey(1.0), reflection, shares - reflection);
        solid->face.has_inner_side = true;
        solid->face.inner_reflection = shares - reflection;
        solid->face.inner_transmission = reflection;
        solid->face.index_of_refraction = indices[i];
        solid->face.ambient = 1.0 - shares;
    }
    scene.floor.material = build_material(grey(1.0), shares, 0.0);
    scene.floor.material.ambient = 1.0 - shares;
    HdFrame frame = render_last(check, &scene, &camera);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const double found = red(&frame, x, y);
            white += found > 0.9;
            expect(check, "energy does not grow", x, y, fmax(found, 1.0), 1.0);
        }
    expect_compared(check, "energy does not grow, nearly white", white, WIDTH * HEIGHT / 4);
    hd_frame_free(&frame);
}

/* ---- small steps ---- */

static double largest_near(const HdFrame *frame, int x, int y, int channel, double sign) {
    double largest = -(double)INFINITY;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < frame->height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < frame->width; i++)
            largest = fmax(largest, sign * channel_of(frame, i, j, channel));
    return largest;
}

/* The camera moves a millionth of the scene's size: no pixel changes by 1 of 255 unless a sample
   crosses a discontinuity, and then it shows its neighbours' values. Discontinuities are edges of
   solids, of the floor, of rims and discs, of shadows, and the onset of total reflection. */
static void check_small_step(Check *check) {
    enum { MAX_CROSSED = WIDTH * HEIGHT / 200 };
    const Place origin = {.scale = 1.0};
    HdFrame frames[2];
    int crossed = 0;
    for (int i = 0; i < 2; i++) {
        HdScene scene;
        HdCamera camera;
        build_placed(&scene, &camera, &origin);
        camera.eye.x += i * 4e-6;
        camera.eye.z += i * 3e-6;
        frames[i] = render_last(check, &scene, &camera);
    }
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < 3; c++) {
                const double now = channel_of(&frames[1], x, y, c);
                const double step = fabs(now - channel_of(&frames[0], x, y, c));
                const bool is_between =
                    now <= largest_near(&frames[0], x, y, c, 1.0) + 1.0 / 255.0 &&
                    -now <= largest_near(&frames[0], x, y, c, -1.0) + 1.0 / 255.0;
                crossed += step > 1.0 / 255.0;
                expect(check, "a small step of the camera", x, y, is_between, 1.0);
            }
    expect_compared(check, "a small step of the camera, few pixels jump", MAX_CROSSED - crossed, 0);
    for (int i = 0; i < 2; i++)
        hd_frame_free(&frames[i]);
}

void check_invariance(Check *check) {
    check_scaling(check);
    check_moving(check);
    check_quarter_turn(check);
    check_light_order(check);
    check_doubled_light(check);
    check_swapped(check);
    check_energy(check, 1.0);
    check_energy(check, 0.7);
    check_small_step(check);
}
