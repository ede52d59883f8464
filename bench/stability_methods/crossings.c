/* SPDX-License-Identifier: MIT */
/* Rays aimed at closed surfaces, tested against every triangle: each must cross the surface once on
   its way in and once on its way out. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../scenes/models/random.h"
#include "compiled.h"
#include "product.h"
#include "shapes.h"
#include "studies.h"
#include "triangle_tests.h"

enum { MAX_METHODS = 12, RAYS_A_TURN = 50, MAX_TRIES = 100 };

/* Distance of rays' origins, in sizes; error beyond which a hit counts as misplaced. */
static const double distance = 3.0, tolerance = 1e-3;
static const double min_facing = 0.05, min_graze = 1e-4, max_graze = 1e-2;

typedef struct Tally {
    const char *name;
    long long rays, missed, twice, wrong, misplaced;
} Tally;

typedef enum Surroundings { PLATONIC, NEEDLE, ZERO_AREAS, DUPLICATES, T_JUNCTIONS } Surroundings;
typedef enum RayOctant { ANY_WAY, GRAZING, ALONG_AXES } RayOctant;

typedef struct Case {
    const char *name;
    Surroundings shape;
    HdAimKind aim; /* HD_AIM_KINDS: each in turn */
    RayOctant way;
} Case;

static const Case cases[] = {
    {"edges", PLATONIC, HD_AIM_EDGE, ANY_WAY},
    {"corners", PLATONIC, HD_AIM_CORNER, ANY_WAY},
    {"interior", PLATONIC, HD_AIM_INTERIOR, ANY_WAY},
    {"grazing", PLATONIC, HD_AIM_INTERIOR, GRAZING},
    {"axis_parallel", PLATONIC, HD_AIM_KINDS, ALONG_AXES},
    {"slivers", NEEDLE, HD_AIM_KINDS, ANY_WAY},
    {"zero_area", ZERO_AREAS, HD_AIM_KINDS, ANY_WAY},
    {"duplicates", DUPLICATES, HD_AIM_KINDS, ANY_WAY},
    {"t_junctions", T_JUNCTIONS, HD_AIM_EDGE, ANY_WAY},
};

/* One surface at one place. */
typedef struct Stage {
    HdShape shape;
    HdPlace place;
    HdVec3 centre;
    HdVec3 in_world[HD_MAX_SHAPE_VERTICES], in_mesh[HD_MAX_SHAPE_VERTICES]; /* rounded to float */
    HdFloatTriangle triangles[HD_MAX_SHAPE_TRIANGLES];
    HdVec3 world_corners[HD_MAX_SHAPE_TRIANGLES][3], mesh_corners[HD_MAX_SHAPE_TRIANGLES][3];
    bool has_solid;
    HdSolidKind kind;
    HdVec3 degrees;
    HdCompiled solid; /* clear, for the kernels */
} Stage;

/* A ray in sizes about the shape's centre, and rounded. */
typedef struct Aimed {
    HdVec3 origin;
    bool is_silhouette; /* whether rounding decides if it hits */
    HdVec3 world_origin, world_direction;
    HdVec3 mesh_origin, mesh_direction;
    HdVec3 direction;
    HdVec3 eye; /* not rounded */
} Aimed;

static void make_shape(Stage *stage, const Case *each, int turn, uint64_t *random) {
    HdSolidKind kind = (HdSolidKind)(turn % HD_SOLID_KIND_COUNT);
    HdVec3 degrees = each->way == ALONG_AXES ? hd_vec3(0.0, 0.0, 0.0) : hd_random_turn(random);
    HdPlatonic solid;
    hd_platonic(kind, &solid);
    hd_platonic_rotate(&solid, degrees);
    if (each->shape == NEEDLE) {
        hd_shape_needle(&stage->shape);
        hd_rotate_points(stage->shape.vertices, stage->shape.vertex_count, degrees);
        hd_rotate_points(stage->shape.normals, stage->shape.triangle_count, degrees);
    } else if (each->shape == T_JUNCTIONS) {
        hd_shape_with_t_junctions(&stage->shape, &solid);
    } else {
        hd_shape_of_platonic(&stage->shape, &solid);
    }
    if (each->shape == ZERO_AREAS)
        hd_shape_add_zero_areas(&stage->shape);
    if (each->shape == DUPLICATES)
        hd_shape_double(&stage->shape);
    stage->has_solid = each->shape == PLATONIC;
    stage->kind = kind;
    stage->degrees = degrees;
}

static void put(Stage *stage, HdPlace place, const HdTriangleTests *tests) {
    HdShape *shape = &stage->shape;
    stage->place = place;
    stage->centre =
        hd_scale(hd_vec3(HD_OFFSET_X, HD_OFFSET_Y, HD_OFFSET_Z), place.offset * place.scale);
    for (int i = 0; i < shape->vertex_count; i++) {
        HdVec3 p = shape->vertices[i];
        stage->in_world[i] = hd_round(hd_add(stage->centre, hd_scale(p, place.scale)));
        stage->in_mesh[i] = hd_round(p);
    }
    for (int i = 0; i < shape->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            stage->world_corners[i][k] = stage->in_world[shape->corners[i][k]];
            stage->mesh_corners[i][k] = stage->in_mesh[shape->corners[i][k]];
        }
        stage->triangles[i].a = hd_to_float(stage->world_corners[i][0]);
        stage->triangles[i].b = hd_to_float(stage->world_corners[i][1]);
        stage->triangles[i].c = hd_to_float(stage->world_corners[i][2]);
        tests->prepare_triangle(&stage->triangles[i]);
    }
}

/* Returns a direction from the point back to the ray's origin. */
static HdVec3 way_back(const HdShape *shape, const HdAim *aim, RayOctant way, uint64_t *random) {
    HdVec3 normal = shape->normals[aim->triangle];
    if (way == ALONG_AXES) {
        double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
        if (x >= y && x >= z)
            return hd_vec3(copysign(1.0, normal.x), 0.0, 0.0);
        return y >= z ? hd_vec3(0.0, copysign(1.0, normal.y), 0.0)
                      : hd_vec3(0.0, 0.0, copysign(1.0, normal.z));
    }
    if (way == GRAZING) {
        double angle = min_graze * pow(max_graze / min_graze, random_between(random, 0, 1));
        HdVec3 along = hd_normalize(hd_cross(normal, hd_random_direction(random)));
        return hd_add(hd_scale(along, cos(angle)), hd_scale(normal, sin(angle)));
    }
    HdVec3 away = normal;
    for (int i = 0; i < MAX_TRIES; i++) {
        away = hd_normalize(hd_add(normal, hd_random_direction(random)));
        if (hd_aim_facing(shape, aim, away) > min_facing)
            break;
    }
    return away; /* a needle's tip has none */
}

static Aimed aim_ray(const Stage *stage, const Case *each, int number, uint64_t *random) {
    HdAimKind kind = each->aim == HD_AIM_KINDS ? (HdAimKind)(number % HD_AIM_KINDS) : each->aim;
    HdAim aim = hd_random_aim(&stage->shape, kind, random);
    HdVec3 away = way_back(&stage->shape, &aim, each->way, random);
    HdVec3 target = hd_aim_point(&stage->shape, &aim, stage->shape.vertices);
    HdVec3 in_world = hd_aim_point(&stage->shape, &aim, stage->in_world);
    HdVec3 in_mesh = hd_aim_point(&stage->shape, &aim, stage->in_mesh);
    double scale = stage->place.scale;
    Aimed ray = {.origin = hd_add(target, hd_scale(away, distance))};
    ray.is_silhouette =
        each->way != GRAZING && hd_aim_facing(&stage->shape, &aim, away) < min_facing;
    ray.direction = hd_scale(away, -1.0);
    ray.eye = hd_add(stage->centre, hd_scale(ray.origin, scale));
    ray.world_origin = hd_round(ray.eye);
    ray.mesh_origin = hd_round(hd_scale(hd_round(hd_scale(ray.origin, scale)), 1.0 / scale));
    ray.world_direction = ray.mesh_direction = ray.direction;
    if (each->way != ALONG_AXES) {
        ray.world_direction = hd_round(hd_normalize(hd_sub(in_world, ray.world_origin)));
        ray.mesh_direction = hd_round(hd_normalize(hd_sub(in_mesh, ray.mesh_origin)));
    }
    return ray;
}

static void note(Tally *tally, const Stage *stage, const Aimed *ray, HdCrossings truth,
                 HdCrossings found, double unit, bool judges_distance) {
    bool missed = found.entered < truth.entered || found.left < truth.left;
    bool twice = found.entered > truth.entered || found.left > truth.left;
    if (ray->is_silhouette) {
        int copies = stage->shape.copies;
        missed = found.entered != found.left && found.entered <= copies && found.left <= copies;
        twice = found.entered > copies || found.left > copies;
    }
    bool misplaced = !ray->is_silhouette && judges_distance && found.entered > 0 &&
                     !(fabs(found.first / unit - distance) < tolerance);
    tally->rays++;
    tally->missed += missed;
    tally->twice += twice;
    tally->wrong += missed || twice;
    tally->misplaced += misplaced;
}

static HdCrossings count_crossings(const Stage *stage, const HdTriangleTests *tests,
                                   const HdTriangleTest *test, const Aimed *aimed) {
    HdFloatRay ray = {.origin = hd_to_float(aimed->world_origin),
                      .direction = hd_to_float(aimed->world_direction)};
    HdCrossings crossings = {.first = 1e30};
    tests->prepare_ray(&ray);
    for (int i = 0; i < stage->shape.triangle_count; i++) {
        HdMeeting meeting;
        if (!test->cross(&ray, &stage->triangles[i], &meeting) || !(meeting.t >= 0.0f))
            continue;
        crossings.entered += meeting.entering;
        crossings.left += !meeting.entering;
        if (meeting.entering && (double)meeting.t < crossings.first)
            crossings.first = (double)meeting.t;
    }
    return crossings;
}

/* Adds the results of `tests` to their tallies; returns the number of methods. */
static int try_tests(Stage *stage, const HdTriangleTests *tests, const Aimed *ray,
                     HdCrossings truth, bool judges, Tally *tallies) {
    for (int i = 0; i < tests->count; i++) {
        tallies[i].name = tests->tests[i].name;
        note(&tallies[i], stage, ray, truth, count_crossings(stage, tests, &tests->tests[i], ray),
             stage->place.scale, judges);
    }
    return tests->count;
}

/* In double, of the rounded corners. A crack at a T-junction exists because of this rounding, and
   is what the study looks for. */
static HdCrossings true_crossings(const Stage *stage, const Case *each, HdVec3 (*corners)[3],
                                  HdVec3 origin, HdVec3 direction) {
    if (each->shape == T_JUNCTIONS)
        return (HdCrossings){.entered = 1, .left = 1};
    return hd_product_double.cross_triangles(corners, stage->shape.triangle_count, origin,
                                             direction);
}

static bool try_ray(Stage *stage, const Case *each, const Aimed *ray, bool contracts,
                    Tally *tallies) {
    const HdShape *shape = &stage->shape;
    bool judges = each->way != GRAZING;
    HdCrossings truth =
        true_crossings(stage, each, stage->world_corners, ray->world_origin, ray->world_direction);
    int used = try_tests(stage, &hd_triangle_tests, ray, truth, judges, tallies);
    if (contracts)
        used += try_tests(stage, &hd_triangle_tests_contracted, ray, truth, judges, tallies + used);
    truth = true_crossings(stage, each, stage->mesh_corners, ray->mesh_origin, ray->mesh_direction);
    tallies[used].name = "ours_triangles";
    note(&tallies[used++], stage, ray, truth,
         hd_product_float.cross_triangles(stage->mesh_corners, shape->triangle_count,
                                          ray->mesh_origin, ray->mesh_direction),
         1.0, judges);
    if (!stage->has_solid)
        return true;
    HdCompiled *solid = &stage->solid;
    if (!hd_compiled_look(solid, ray->eye))
        return false;
    tallies[used].name = "ours_solids";
    note(&tallies[used], stage, ray, (HdCrossings){.entered = 1, .left = 1},
         hd_product_float.pierce(solid->tables.table, solid->frame.table, ray->direction),
         stage->place.scale, judges);
    return true;
}

static void print_tallies(const Case *each, HdPlace place, const Tally *tallies) {
    for (int i = 0; i < MAX_METHODS && tallies[i].name != NULL; i++)
        printf(
            "crossings %s %s %g %g tried=%lld missed=%lld twice=%lld wrong=%lld misplaced=%lld\n",
            each->name, tallies[i].name, place.scale, place.offset, tallies[i].rays,
            tallies[i].missed, tallies[i].twice, tallies[i].wrong, tallies[i].misplaced);
    fflush(stdout);
}

static bool compile_solid(Stage *stage) {
    hd_compiled_free(&stage->solid);
    if (!stage->has_solid)
        return true;
    HdSolid solid = hd_plain_solid(stage->kind, stage->centre, stage->place.scale, stage->degrees,
                                   HD_FACE_CLEAR);
    return hd_compiled_begin(&stage->solid, &solid, 1, 0) &&
           hd_compiled_finish(&stage->solid, HD_PRECISION_FLOAT, HD_GEOMETRY_SOLIDS);
}

static bool study_case(Stage *stage, const Case *each, HdPlace place, int count, bool contracts) {
    Tally tallies[MAX_METHODS] = {{0}};
    uint64_t random = 1;
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        if (i % RAYS_A_TURN == 0) {
            make_shape(stage, each, i / RAYS_A_TURN, &random);
            put(stage, place, &hd_triangle_tests);
            done = compile_solid(stage);
        }
        Aimed ray = aim_ray(stage, each, i, &random);
        done = done && try_ray(stage, each, &ray, contracts, tallies);
    }
    if (done)
        print_tallies(each, place, tallies);
    return done;
}

bool hd_study_crossings(int count) {
    Stage *stage = calloc(1, sizeof *stage);
    bool done = stage != NULL, contracts = hd_can_contract();
    for (size_t c = 0; done && c < sizeof cases / sizeof *cases; c++)
        for (int p = 0; done && p < hd_place_count; p++)
            done = study_case(stage, &cases[c], hd_places[p], count, contracts);
    if (stage != NULL)
        hd_compiled_free(&stage->solid);
    free(stage);
    return done;
}
