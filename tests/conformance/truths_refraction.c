/* SPDX-License-Identifier: MIT */
/* Snell's law and total reflection. The references work with angles and tangents, not with the
   kernels' formula. */
#include <math.h>

#include "certify/scene_builder.h"
#include "scene/camera.h"
#include "truth_check.h"
#include "truths.h"

static const double floor_height = -4.0, floor_half_side = 8.0;
static const double margin = 1e-3; /* from edges and critical angles: too close to call */

/* One solid about the origin that neither reflects nor shows anything of its own, over a floor. */
static void build_clear_solid(HdScene *scene, int width, int height, int depth, double circumradius,
                              HdVec3 rotation, double index) {
    build_scene(scene, width, height, 1, depth, 1, 1);
    scene->background = grey(0.0);
    build_glass(scene, 0, HD_HEXAHEDRON, grey(0.0), circumradius, 1.0, 1.0);
    scene->solids[0].rotation_degrees = rotation;
    scene->solids[0].face.diffuse = scene->solids[0].face.specular = 0.0;
    scene->solids[0].face.index_of_refraction = index;
    build_square_floor(scene, floor_half_side, floor_height);
    scene->floor.material = glowing(0.0);
}

/* The floor's red and green tell a point's place: 0.5 + x / h and 0.5 - y / h. Four texels do, for
   the lookup is bilinear. */
static void show_places(HdFloor *floor) {
    floor->material = glowing(1.0);
    build_texture(&floor->texture, 2, 2);
    for (int i = 0; i < 4; i++) {
        uint16_t *rgb = floor->texture.texels + 3 * i;
        rgb[0] = i % 2 ? 65535 : 0;
        rgb[1] = i / 2 ? 65535 : 0;
    }
}

static bool place_can_be_told(double x, double y) {
    return fabs(x) < 0.45 * floor_half_side && fabs(y) < 0.45 * floor_half_side;
}

static void expect_place(Check *check, const char *truth, const HdFrame *frame, int i, int j,
                         double x, double y) {
    expect(check, truth, i, j, channel_of(frame, i, j, 0), 0.5 + x / floor_half_side);
    expect(check, truth, i, j, channel_of(frame, i, j, 1), 0.5 - y / floor_half_side);
}

/* Where a straight line goes in and out of a solid about the origin. */
typedef struct Passage {
    double in, out;
    int face_in, face_out;
    bool clear; /* it meets the solid, and not too close to an edge */
} Passage;

static Passage passage(const HdSolid *solid, HdVec3 from, HdVec3 d) {
    HdPlatonic shape = shape_of(solid);
    double next_in = -1e9, next_out = 1e9;
    Passage p = {.in = -1e9, .out = 1e9};
    for (int f = 0; f < shape.face_count; f++) {
        double slope = hd_dot(d, shape.face_normal[f]);
        double t =
            (shape.inradius * solid->circumradius - hd_dot(from, shape.face_normal[f])) / slope;
        if (slope < 0.0 && t > p.in) {
            next_in = p.in;
            p.in = t;
            p.face_in = f;
        } else if (slope < 0.0) {
            next_in = fmax(next_in, t);
        } else if (slope > 0.0 && t < p.out) {
            next_out = p.out;
            p.out = t;
            p.face_out = f;
        } else {
            next_out = fmin(next_out, t);
        }
    }
    p.clear = p.in - next_in > margin && next_out - p.out > margin && p.out - p.in > margin;
    return p;
}

typedef struct Bent {
    HdVec3 direction;
    bool total; /* reflected totally: there is no direction */
    bool clear; /* far enough from the critical angle */
} Bent;

/* `normal` looks against the direction. */
static Bent bend(HdVec3 direction, HdVec3 normal, double relative_index) {
    Bent bent = {.direction = direction, .clear = true};
    double facing = -hd_dot(direction, normal);
    HdVec3 along = hd_add(direction, hd_scale(normal, facing));
    double sine = hd_length(along);
    if (sine < 1e-12)
        return bent;
    double refracted = relative_index * sine;
    bent.total = refracted >= 1.0;
    bent.clear = fabs(refracted - 1.0) > 0.02;
    if (!bent.total) {
        double angle = asin(refracted);
        bent.direction = hd_add(hd_scale(along, sin(angle) / sine), hd_scale(normal, -cos(angle)));
    }
    return bent;
}

/* From inside, the floor shows up where Snell's law says; under total reflection there is nothing,
   since the mirror ray meets a face from inside. */
static void check_looking_out(Check *check, HdVec3 rotation, double index) {
    HdScene scene;
    HdCamera camera;
    int landed = 0, total = 0;
    build_clear_solid(&scene, 40, 32, 1, sqrt(3.0), rotation, index);
    show_places(&scene.floor);
    build_camera(&camera, hd_vec3(0.2, -0.1, 0.15), hd_vec3(0.3, 0.2, -1.0), 110.0);
    HdPlatonic shape = shape_of(&scene.solids[0]);
    HdFrame frame = render(check, &scene, &camera);
    for (int j = 0; j < frame.height; j++)
        for (int i = 0; i < frame.width; i++) {
            HdVec3 d = direction_at(&scene, &camera, i + 0.5, j + 0.5);
            Passage way = passage(&scene.solids[0], camera.eye, d);
            Bent bent = bend(d, hd_scale(shape.face_normal[way.face_out], -1.0), index);
            HdVec3 at = hd_add(camera.eye, hd_scale(d, way.out));
            if (!way.clear || !bent.clear)
                continue;
            if (bent.total) {
                expect(check, "total reflection", i, j, red(&frame, i, j), 0.0);
                total++;
                continue;
            }
            double t = (floor_height - at.z) / bent.direction.z;
            HdVec3 place = hd_add(at, hd_scale(bent.direction, t));
            if (t < 0.0 || !place_can_be_told(place.x, place.y))
                continue;
            expect_place(check, "Snell's law, from inside", &frame, i, j, place.x, place.y);
            landed++;
        }
    expect_compared(check, "Snell's law, from inside", landed, 50);
    expect_compared(check, "total reflection", total, index > 1.2 ? 100 : 0);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

/* From outside, a face's inner side is seen, lit by a light within, whose light tells the place. */
static void check_looking_in(Check *check, HdVec3 rotation, double index) {
    const HdVec3 light = hd_vec3(0.2, 0.1, -0.3);
    const double diffuse = 0.8, falloff = 1.5;
    HdScene scene;
    HdCamera camera;
    int met = 0;
    build_clear_solid(&scene, 32, 24, 1, sqrt(3.0), rotation, index);
    scene.solids[0].face.diffuse = diffuse;
    build_light(&scene, 0, light, grey(1.0));
    scene.lights[0].falloff.distance = falloff;
    build_camera(&camera, hd_vec3(1.6, -2.4, 1.9), grey(0.0), 60.0);
    HdPlatonic shape = shape_of(&scene.solids[0]);
    HdFrame frame = render(check, &scene, &camera);
    for (int j = 0; j < frame.height; j++)
        for (int i = 0; i < frame.width; i++) {
            HdVec3 d = direction_at(&scene, &camera, i + 0.5, j + 0.5);
            Passage way = passage(&scene.solids[0], camera.eye, d);
            Bent bent = bend(d, shape.face_normal[way.face_in], 1.0 / index);
            if (!way.clear || !bent.clear)
                continue;
            double expected = 0.0;
            if (!bent.total) {
                HdVec3 at = hd_add(camera.eye, hd_scale(d, way.in));
                Passage within = passage(&scene.solids[0], at, bent.direction);
                if (!within.clear)
                    continue;
                at = hd_add(at, hd_scale(bent.direction, within.out));
                HdVec3 to_light = hd_sub(light, at);
                double distance = hd_length(to_light);
                double cosine = -hd_dot(to_light, shape.face_normal[within.face_out]) / distance;
                expected = diffuse * cosine / (1.0 + distance * distance / (falloff * falloff));
            }
            expect(check, "Snell's law, from outside", i, j, red(&frame, i, j), expected);
            met++;
        }
    expect_compared(check, "Snell's law, from outside", met, 100);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

/* Two parallel faces shift a ray by h sin(a - b) / cos(b) and do not bend it. */
static void check_slab(Check *check, double index) {
    const double half = 2.0;
    HdScene scene;
    HdCamera camera;
    int compared = 0;
    build_clear_solid(&scene, 24, 24, 2, half * sqrt(3.0), grey(0.0), index);
    show_places(&scene.floor);
    build_camera(&camera, hd_vec3(0.4, -0.6, 5.0), hd_vec3(0.3, 0.1, 0.0), 50.0);
    HdFrame frame = render(check, &scene, &camera);
    for (int j = 0; j < frame.height; j++)
        for (int i = 0; i < frame.width; i++) {
            HdVec3 d = direction_at(&scene, &camera, i + 0.5, j + 0.5);
            double a = acos(-d.z), b = asin(sin(a) / index);
            HdVec3 across = hd_scale(hd_vec3(d.x, d.y, 0.0), 1.0 / sin(a));
            HdVec3 in = hd_add(camera.eye, hd_scale(d, (half - camera.eye.z) / d.z));
            HdVec3 out = hd_add(in, hd_scale(across, 2.0 * half * tan(b)));
            if (fmax(fmax(fabs(in.x), fabs(in.y)), fmax(fabs(out.x), fabs(out.y))) > 0.95 * half)
                continue;
            double shift = 2.0 * half * sin(a - b) / cos(b);
            HdVec3 straight = hd_add(camera.eye, hd_scale(d, (floor_height - camera.eye.z) / d.z));
            HdVec3 place = hd_sub(straight, hd_scale(across, shift / cos(a)));
            if (!place_can_be_told(place.x, place.y))
                continue;
            expect_place(check, "slab", &frame, i, j, place.x, place.y);
            compared++;
        }
    expect_compared(check, "slab", compared, 100);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

/* One ray that meets a face at the critical angle plus `excess`, on that side of it from which
   there is one. */
static void check_critical_angle(Check *check, HdVec3 rotation, int face, double index,
                                 double excess) {
    const double glow = 0.2, background = 0.5;
    const bool inside = index > 1.0;
    HdScene scene;
    HdCamera camera;
    build_clear_solid(&scene, 1, 1, 1, sqrt(3.0), rotation, index);
    scene.background = grey(background);
    scene.floor.material = glowing(background);
    HdMaterial *material = &scene.solids[0].face;
    material->ambient = glow;
    material->reflection = 0.3;
    material->transmission = 0.6;
    material->has_inner_side = true;
    material->inner_reflection = 0.15;
    material->inner_transmission = 0.65;
    HdVec3 normal = shape_of(&scene.solids[0]).face_normal[face];
    HdVec3 along = hd_normalize(hd_cross(normal, hd_vec3(0.3, 0.5, 0.8)));
    double angle = asin(inside ? 1.0 / index : index) + excess;
    HdVec3 eye = hd_scale(normal, inside ? 0.7 : 1.3);
    HdVec3 d =
        hd_add(hd_scale(normal, inside ? cos(angle) : -cos(angle)), hd_scale(along, sin(angle)));
    build_camera(&camera, eye, hd_add(eye, d), 1.0);
    HdFrame frame = render_last(check, &scene, &camera);

    double reflection = inside ? 0.15 : 0.3, transmission = inside ? 0.65 : 0.6;
    double mirror = inside ? glow : background, through = inside ? background : glow;
    double expected = excess > 0.0 ? glow + (reflection + transmission) * mirror
                                   : glow + reflection * mirror + transmission * through;
    expect(check, "critical angle", face, inside, red(&frame, 0, 0), expected);
    expect(check, "critical angle, mirrored", face, inside, (double)frame.mirrored_rays, 1.0);
    expect(check, "critical angle, transmitted", face, inside, (double)frame.transmitted_rays,
           excess > 0.0 ? 0.0 : 1.0);
    hd_frame_free(&frame);
}

static void check_critical_angles(Check *check, HdVec3 rotation) {
    static const double indices[] = {1.2, 1.5, 2.4, 0.9, 0.5};
    const double excess = check->target->precision == HD_PRECISION_FLOAT ? 1e-5 : 1e-11;
    for (int i = 0; i < 5; i++)
        for (int face = 0; face < 6; face++) {
            check_critical_angle(check, rotation, face, indices[i], excess);
            check_critical_angle(check, rotation, face, indices[i], -excess);
        }
}

/* Half mirrors, half glass, and far away, where no ray comes, a solid with the index `far_index`.
 */
static uint64_t hash_with(const Check *check, double far_index) {
    HdScene scene;
    HdCamera camera;
    build_scene(&scene, 40, 30, 1, 6, 2, 1);
    build_light(&scene, 0, hd_vec3(3.0, -2.0, 5.0), grey(1.0));
    build_solid(&scene, 0, HD_HEXAHEDRON, grey(0.0), 1.3, hd_vec3(0.9, 0.6, 0.3), 2);
    build_glass(&scene, 1, HD_TETRAHEDRON, hd_vec3(900.0, 800.0, -700.0), 1e-3, 1.0, 1.0);
    scene.solids[0].rotation_degrees = hd_vec3(10.0, 20.0, 30.0);
    scene.solids[1].face.index_of_refraction = far_index;
    build_square_floor(&scene, 4.0, -1.4);
    build_camera(&camera, hd_vec3(2.3, -2.9, 1.4), grey(0.0), 50.0);
    HdFrame frame = render_last(check, &scene, &camera);
    uint64_t hash = hd_frame_hash(&frame);
    hd_frame_free(&frame);
    return hash;
}

static void check_index_one(Check *check) {
    begin(check);
    expect(check, "index 1 beside another", 0, 0, hash_with(check, 1.0) == hash_with(check, 1.5),
           1.0);
}

/* Where nothing is lost, a clear solid before a white background is white: what does not pass is
   reflected, totally or not. Two reflections that are not total leave less than can be seen. */
static void check_nothing_lost(Check *check, double index) {
    HdScene scene;
    HdCamera camera;
    build_clear_solid(&scene, 32, 24, 8, sqrt(3.0), hd_vec3(20.0, 30.0, 40.0), index);
    scene.background = grey(1.0);
    scene.floor.material = glowing(1.0);
    scene.solids[0].face.reflection = 0.0002;
    scene.solids[0].face.transmission = 0.9998;
    build_camera(&camera, hd_vec3(1.6, -2.4, 1.9), grey(0.0), 60.0);
    HdFrame frame = render_last(check, &scene, &camera);
    for (int j = 0; j < frame.height; j++)
        for (int i = 0; i < frame.width; i++)
            expect(check, "nothing is lost", i, j, red(&frame, i, j), 1.0);
    hd_frame_free(&frame);
}

void check_refraction(Check *check) {
    static const HdVec3 rotations[] = {{0.0, 0.0, 0.0}, {20.0, 30.0, 40.0}};
    static const double indices[] = {1.1, 1.5, 2.4, 0.7};
    check_index_one(check);
    for (int r = 0; r < 2; r++) {
        begin(check);
        for (int i = 0; i < 4; i++) {
            check_looking_out(check, rotations[r], indices[i]);
            check_looking_in(check, rotations[r], indices[i]);
        }
        check_critical_angles(check, rotations[r]);
    }
    begin(check);
    check_slab(check, 1.5);
    check_slab(check, 0.8);
    check_nothing_lost(check, 1.5);
    check_nothing_lost(check, 0.7);
}
