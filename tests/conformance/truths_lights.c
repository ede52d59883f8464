/* SPDX-License-Identifier: MIT */
/* Edge lights: the discs that are seen, and what the lights give. */
#include <math.h>

#include "certify/scene_builder.h"
#include "scene/camera.h"
#include "truth_check.h"
#include "truths.h"

static const HdVec3 edge_colours[] = {
    {1.0, 0.2, 0.1}, {0.1, 0.9, 0.3}, {0.2, 0.3, 0.8}, {0.7, 0.6, 0.0}, {0.4, 0.0, 0.5}};
enum { COLOURS = 5 };

static void build_coloured_solid(HdScene *scene, HdSolidKind kind, int per_edge) {
    build_solid(scene, 0, kind, hd_vec3(0.0, 0.0, 0.0), 1.0, hd_vec3(1.0, 1.0, 1.0), per_edge);
    HdSolid *solid = &scene->solids[0];
    solid->rotation_degrees = hd_vec3(20.0, 30.0, 40.0);
    solid->rim_width = 0.0;
    solid->face.reflection = 0.0;
    solid->face.transmission = 1.0;
    solid->lights.colour_count = COLOURS;
    for (int i = 0; i < COLOURS; i++)
        solid->lights.colours[i] = edge_colours[i];
}

static HdVec3 edge_light(const HdPlatonic *shape, int edge, double along) {
    HdVec3 a = shape->vertex[shape->edge[edge].vertex[0]];
    HdVec3 b = shape->vertex[shape->edge[edge].vertex[1]];
    return hd_add(hd_scale(a, 1.0 - along), hd_scale(b, along));
}

static double channel(HdVec3 v, int number) {
    return number == 0 ? v.x : number == 1 ? v.y : v.z;
}

/* Each edge's discs show that edge's colour. */
static void check_discs(Check *check, HdSolidKind kind) {
    const double radiance = 2.5;
    HdScene scene;
    HdCamera camera;
    begin(check);
    build_scene(&scene, 1, 1, 1, 0, 1, 0);
    build_coloured_solid(&scene, kind, 3);
    scene.solids[0].lights.disc_radiance = radiance;
    HdPlatonic shape = shape_of(&scene.solids[0]);
    for (int e = 0; e < shape.edge_count; e++) {
        HdVec3 normal = shape.face_normal[shape.edge[e].face[0]];
        HdVec3 light = edge_light(&shape, e, (e % 3 + 0.5) / 3.0);
        /* Beside the edge, so that rounding cannot miss the solid. */
        HdVec3 inwards = hd_normalize(hd_sub(normal, hd_scale(light, 1.0 / hd_dot(light, normal))));
        HdVec3 aim = hd_add(light, hd_scale(inwards, 0.5 * scene.solids[0].lights.disc_radius));
        build_camera(&camera, hd_add(aim, hd_scale(normal, 2.0)), aim, 0.01);
        HdFrame frame = render(check, &scene, &camera);
        for (int c = 0; c < 3; c++)
            expect(check, "discs of an edge", e, c, channel_of(&frame, 0, 0, c),
                   radiance * channel(edge_colours[e % COLOURS], c));
        hd_frame_free(&frame);
    }
    hd_scene_free(&scene);
}

/* What the floor's point takes from all edge lights, through clear faces. */
static HdVec3 diffuse_light(const HdSolid *solid, HdVec3 point) {
    HdPlatonic shape = shape_of(solid);
    HdVec3 sum = hd_vec3(0.0, 0.0, 0.0);
    double d0 = solid->lights.falloff.distance;
    for (int e = 0; e < shape.edge_count; e++)
        for (int k = 0; k < solid->lights.per_edge; k++) {
            HdVec3 light = edge_light(&shape, e, (k + 0.5) / solid->lights.per_edge);
            HdVec3 to_light = hd_sub(light, point);
            double distance = hd_length(to_light);
            double share = solid->lights.intensity * to_light.z / distance /
                           (1.0 + distance * distance / (d0 * d0));
            sum = hd_add(sum, hd_scale(edge_colours[e % COLOURS], share));
        }
    return sum;
}

/* Each edge's lights have that edge's colour, and its place, and clear faces let them through. */
static void check_edge_lights(Check *check) {
    HdScene scene;
    HdCamera camera;
    begin(check);
    build_scene(&scene, 20, 16, 1, 0, 1, 0);
    build_coloured_solid(&scene, HD_OCTAHEDRON, 2);
    build_square_floor(&scene, 20.0, -1.5);
    scene.floor.material.specular = 0.0;
    scene.floor.material.colour = hd_vec3(1.0, 1.0, 1.0);
    build_camera(&camera, hd_vec3(0.3, -4.0, -1.2), hd_vec3(0.0, 0.0, -1.8), 60.0);
    HdFrame frame = render(check, &scene, &camera);
    int compared = 0;
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            HdVec3 d = direction_at(&scene, &camera, x + 0.5, y + 0.5);
            double t = (-1.5 - camera.eye.z) / d.z;
            HdVec3 point = hd_add(camera.eye, hd_scale(d, t));
            if (d.z > -0.05 || t > 15.0)
                continue;
            HdVec3 light = diffuse_light(&scene.solids[0], point);
            for (int c = 0; c < 3; c++)
                expect(check, "coloured edge lights", x, y, channel_of(&frame, x, y, c),
                       scene.floor.material.diffuse * channel(light, c));
            compared++;
        }
    expect_compared(check, "coloured edge lights", compared, 100);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

void check_lights(Check *check) {
    check_discs(check, HD_TETRAHEDRON);
    check_discs(check, HD_DODECAHEDRON);
    check_edge_lights(check);
}
