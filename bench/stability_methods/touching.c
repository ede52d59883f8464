/* SPDX-License-Identifier: MIT */
/* Pictures of solids that touch each other or the floor: how many pixels are off from the picture
   with a gap between them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../scenes/models/random.h"
#include "compiled.h"
#include "methods.h"
#include "plain_trees.h"
#include "product.h"
#include "scene/contact.h"
#include "shapes.h"
#include "studies.h"

enum { MOST_CUBES = 2, PIXELS_A_TURN = 250, DEPTH = 5 };

static const double gap = 1e-6, step = 1.0 / 255.0; /* in sizes; of radiance */
static const double half_side = 0.57735026918962573;
static const double floor_height = -0.8, floor_side = 5.0;
static const HdGrey glass = {0.9f, 0.2f, 0.3f, 0.6f}, stone = {0.7f, 0.8f, 0.1f, 0.0f};

typedef enum Case { ON_THE_FLOOR, STACKED, SIDE_BY_SIDE, DOUBLED, CASES } Case;

static const char *const case_names[CASES] = {"on_the_floor", "stacked", "side_by_side", "doubled"};

/* The plain methods, the last but one of them with a gap too, and the product's. */
enum {
    WITH_GAP = HD_AVOIDANCES,
    OURS_SOLIDS,
    OURS_TRIANGLES,
    OURS_DOUBLE,
    METHODS,
    TRUTH = METHODS
};
enum { OWN_FACE = 6 };

static const char *const other_names[] = {"own_face_with_gap", "ours_solids", "ours_triangles",
                                          "ours_double"};

typedef struct Stage {
    int cube_count;
    HdVec3 cubes[2][MOST_CUBES]; /* centres in sizes, without and with a gap */
    double radii[2][MOST_CUBES];
    double degrees; /* about the vertical */
    HdVec3 centre;
    double scale;
    HdVec3 eye, light;       /* in sizes */
    HdPlainPicture plain[2]; /* without and with a gap */
    HdGrey materials[MOST_CUBES + 1];
    HdCompiled compiled[TRUTH + 1 - OURS_SOLIDS];
} Stage;

static HdVec3 place_of(const Stage *stage, HdVec3 point) {
    return hd_add(stage->centre, hd_scale(point, stage->scale));
}

static HdVec3 turned(double degrees, HdVec3 point) {
    const double angle = degrees * 0.017453292519943296;
    return hd_vec3(point.x * cos(angle) - point.y * sin(angle),
                   point.x * sin(angle) + point.y * cos(angle), point.z);
}

static void put_cubes(Stage *stage, Case which, int has_gap) {
    const double between = has_gap ? gap : 0.0;
    HdVec3 *cubes = stage->cubes[has_gap], beside = {2.0 * half_side + between, 0.3, 0.1};
    double *radii = stage->radii[has_gap];
    bool stands = which == ON_THE_FLOOR || which == STACKED;
    radii[0] = radii[1] = 1.0;
    cubes[0] = hd_vec3(0.0, 0.0, stands ? floor_height + half_side + between : 0.0);
    cubes[1] = cubes[0];
    if (which == STACKED)
        cubes[1].z += 2.0 * half_side + between;
    if (which == SIDE_BY_SIDE)
        cubes[1] = turned(stage->degrees, beside);
    if (which == DOUBLED)
        radii[1] += between;
    stage->cube_count = which == ON_THE_FLOOR ? 1 : 2;
}

/* ---- as the plain methods have them ---- */

static void add_triangle(HdPlainScene *scene, const HdVec3 *corners, HdVec3 normal, int object,
                         int face) {
    HdFloatTriangle *triangle = &scene->triangles[scene->count];
    triangle->a = hd_to_float(corners[0]);
    triangle->b = hd_to_float(corners[1]);
    triangle->c = hd_to_float(corners[2]);
    scene->normals[scene->count] = hd_to_float(normal);
    scene->faces[scene->count++] = (HdBounce){object, face};
}

static void add_floor(const Stage *stage, HdPlainScene *scene) {
    static const double corner[2][3][2] = {{{1, 1}, {-1, 1}, {-1, -1}},
                                           {{1, 1}, {-1, -1}, {1, -1}}};
    for (int i = 0; i < 2; i++) {
        HdVec3 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = place_of(stage, hd_vec3(floor_side * corner[i][k][0],
                                                 floor_side * corner[i][k][1], floor_height));
        add_triangle(scene, corners, hd_vec3(0.0, 0.0, 1.0), stage->cube_count, 0);
    }
}

static void make_plain(Stage *stage, int has_gap) {
    HdPlainPicture *picture = &stage->plain[has_gap];
    *picture = (HdPlainPicture){.materials = stage->materials, .depth = DEPTH};
    picture->eye = hd_to_float(place_of(stage, stage->eye));
    picture->light = hd_to_float(place_of(stage, stage->light));
    HdPlatonic solid;
    HdShape shape;
    hd_platonic(HD_HEXAHEDRON, &solid);
    hd_platonic_rotate(&solid, hd_vec3(0.0, 0.0, stage->degrees));
    hd_shape_of_platonic(&shape, &solid);
    for (int cube = 0; cube < stage->cube_count; cube++) {
        stage->materials[cube] = glass;
        for (int i = 0; i < shape.triangle_count; i++) {
            HdVec3 corners[3];
            for (int k = 0; k < 3; k++) {
                HdVec3 corner = shape.vertices[shape.corners[i][k]];
                corner = hd_scale(corner, stage->radii[has_gap][cube]);
                corners[k] = place_of(stage, hd_add(stage->cubes[has_gap][cube], corner));
            }
            add_triangle(&picture->scene, corners, shape.normals[i], cube, shape.face_of[i]);
        }
    }
    stage->materials[stage->cube_count] = stone;
    add_floor(stage, &picture->scene);
}

/* ---- as the product has them ---- */

static void set_material(HdMaterial *material, HdGrey grey) {
    material->colour = hd_vec3((double)grey.colour, (double)grey.colour, (double)grey.colour);
    material->diffuse = (double)grey.diffuse;
    material->reflection = (double)grey.reflection;
    material->transmission = (double)grey.transmission;
}

static bool compile(Stage *stage, int method) {
    HdCompiled *compiled = &stage->compiled[method - OURS_SOLIDS];
    HdSolid solids[MOST_CUBES];
    int has_gap = method == TRUTH;
    for (int i = 0; i < stage->cube_count; i++) {
        HdVec3 centre = place_of(stage, stage->cubes[has_gap][i]);
        solids[i] = hd_plain_solid(HD_HEXAHEDRON, centre, stage->radii[has_gap][i] * stage->scale,
                                   hd_vec3(0.0, 0.0, stage->degrees), HD_FACE_CLEAR);
        set_material(&solids[i].face, glass);
    }
    hd_compiled_free(compiled);
    if (!hd_compiled_begin(compiled, solids, stage->cube_count, 1))
        return false;
    HdScene *scene = &compiled->scene;
    scene->depth = DEPTH;
    scene->lights[0].position = place_of(stage, stage->light);
    hd_compiled_put_floor(compiled, stage->centre, stage->scale, floor_height, floor_side);
    set_material(&scene->floor.material, stone);
    hd_scene_part_contacts(scene);
    bool is_double = method == OURS_DOUBLE || method == TRUTH;
    return hd_compiled_finish(compiled, is_double ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT,
                              method == OURS_TRIANGLES ? HD_GEOMETRY_TRIANGLES
                                                       : HD_GEOMETRY_SOLIDS) &&
           hd_compiled_look(compiled, place_of(stage, stage->eye));
}

/* ---- pixels ---- */

static bool put(Stage *stage, Case which, HdPlace place, int turn, uint64_t *random) {
    stage->degrees = turn % 3 == 0 ? 0.0 : random_between(random, 0.0, 90.0);
    stage->scale = place.scale;
    stage->centre =
        hd_scale(hd_vec3(HD_OFFSET_X, HD_OFFSET_Y, HD_OFFSET_Z), place.offset * place.scale);
    stage->eye = turned(random_between(random, 0.0, 360.0), hd_vec3(3.2, 0.0, 1.3));
    stage->light = hd_vec3(3.0, -4.0, 5.0);
    bool done = true;
    for (int has_gap = 0; has_gap < 2; has_gap++) {
        put_cubes(stage, which, has_gap);
        make_plain(stage, has_gap);
    }
    for (int method = OURS_SOLIDS; method <= TRUTH && done; method++)
        done = compile(stage, method);
    return done;
}

static double seen(const Stage *stage, int method, HdVec3 direction) {
    if (method < OURS_SOLIDS) {
        int avoidance = method == WITH_GAP ? OWN_FACE : method;
        return (double)hd_plain_seen(&stage->plain[method == WITH_GAP], avoidance,
                                     hd_to_float(direction));
    }
    const HdCompiled *compiled = &stage->compiled[method - OURS_SOLIDS];
    bool is_double = method == OURS_DOUBLE || method == TRUTH;
    const HdProduct *product = is_double ? &hd_product_double : &hd_product_float;
    return product->seen(compiled->tables.table, compiled->frame.table, direction);
}

static bool study_place(Stage *stage, Case which, HdPlace place, int count) {
    long long off[METHODS] = {0};
    uint64_t random = 5;
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        if (i % PIXELS_A_TURN == 0)
            done = put(stage, which, place, i / PIXELS_A_TURN, &random);
        HdVec3 at = {.x = random_between(&random, -1.2, 1.2)};
        at.y = random_between(&random, -1.2, 1.2);
        at.z = random_between(&random, floor_height, 1.6);
        HdVec3 direction = hd_round(hd_normalize(hd_sub(at, stage->eye)));
        double truth = done ? seen(stage, TRUTH, direction) : 0.0;
        for (int method = 0; method < METHODS && done; method++)
            off[method] += !(fabs(seen(stage, method, direction) - truth) <= step);
    }
    for (int method = 0; method < METHODS && done; method++)
        printf("touching %s %s %g %g tried=%d off=%lld\n", case_names[which],
               method < WITH_GAP ? hd_avoidance_names[method] : other_names[method - WITH_GAP],
               place.scale, place.offset, count, off[method]);
    fflush(stdout);
    return done;
}

bool hd_study_touching(int count) {
    Stage *stage = calloc(1, sizeof *stage);
    bool done = stage != NULL;
    for (int which = 0; which < CASES && done; which++)
        for (int p = 0; p < hd_place_count && done; p++)
            done = study_place(stage, (Case)which, hd_places[p], count);
    for (int i = 0; stage != NULL && i <= TRUTH - OURS_SOLIDS; i++)
        hd_compiled_free(&stage->compiled[i]);
    free(stage);
    return done;
}
