/* SPDX-License-Identifier: MIT */
/* Segments to lights on the surface of an opaque solid: counts open ones that are blocked, and
   blocked ones that are open. Also the effect of a light at the lit point itself. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../scenes/models/random.h"
#include "compiled.h"
#include "product.h"
#include "shapes.h"
#include "studies.h"
#include "triangle_tests.h"

enum { SEGMENTS_A_LAMP = 60, LIGHTS_AN_EDGE = 3, FREE_LIGHTS = 20 };

/* Distances, in sizes, that count as clearly outside or behind a face. */
static const double margin = 0.02;
static const double floor_height = -1.5, floor_side = 3.0;

typedef enum Where { EDGE_LIGHTS, EDGE_LIGHTS_FROM_WITHIN, FACE_LIGHTS, AT_THE_POINT } Where;

static const char *const where_names[] = {"edge_lights", "edge_lights_from_within", "face_lights",
                                          "light_at_the_point"};

/* Occlusion tests of other renderers: the range along the segment in which hits count. */
typedef struct Window {
    const char *name;
    bool normalised;
    float epsilon;
} Window;

static const Window windows[] = {
    {"normalised", true, 0.0f},
    {"normalised_epsilon_1e-4", true, 1e-4f},
    {"unnormalised", false, 0.0f},
    {"unnormalised_epsilon_1e-4", false, 1e-4f},
};

enum { WINDOWS = sizeof windows / sizeof *windows, OURS = WINDOWS, OURS_DOUBLE, METHODS };

typedef struct Tally {
    long long open, blocked_wrongly; /* counts of segments that should be open */
    long long shut, opened_wrongly;  /* counts of the others */
    long long no_numbers;
} Tally;

typedef struct Stage {
    HdPlatonic solid;
    HdShape shape;
    HdFloatTriangle triangles[HD_MAX_SHAPE_TRIANGLES];
    HdVec3 centre;
    double scale;
    HdVec3 light[FREE_LIGHTS]; /* lights on faces, in sizes about the centre */
    int light_face[FREE_LIGHTS];
    HdCompiled compiled[2]; /* for float and for double */
} Stage;

/* A segment, in sizes about the solid's centre. */
typedef struct Segment {
    HdVec3 point, light;
    int number;   /* position of the light */
    int faces[2]; /* faces that hold the light, -1: none */
    int own_face; /* face of the solid that holds the point; -1: it is on the floor */
} Segment;

static HdVec3 place_of(const Stage *stage, HdVec3 point) {
    return hd_add(stage->centre, hd_scale(point, stage->scale));
}

/* ---- the lamp over a floor ---- */

static bool compile(Stage *stage, HdSolidKind kind, HdVec3 degrees, Where where, bool is_double) {
    HdCompiled *compiled = &stage->compiled[is_double];
    HdSolid solid = hd_plain_solid(kind, stage->centre, stage->scale, degrees, HD_FACE_OPAQUE);
    bool has_free = where == FACE_LIGHTS || where == AT_THE_POINT;
    if (!has_free) {
        solid.lights.per_edge = LIGHTS_AN_EDGE;
        solid.lights.intensity = 1.0;
    }
    hd_compiled_free(compiled);
    if (!hd_compiled_begin(compiled, &solid, 1, has_free ? FREE_LIGHTS : 0))
        return false;
    HdScene *scene = &compiled->scene;
    for (int i = 0; i < scene->light_count; i++)
        scene->lights[i].position = place_of(stage, stage->light[i]);
    hd_compiled_put_floor(compiled, stage->centre, stage->scale, floor_height, floor_side);
    return hd_compiled_finish(compiled, is_double ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT,
                              HD_GEOMETRY_SOLIDS);
}

static HdVec3 floor_point(uint64_t *random) {
    HdVec3 point = {.z = floor_height};
    point.x = random_between(random, -floor_side, floor_side);
    point.y = random_between(random, -floor_side, floor_side);
    return point;
}

static void choose_lights(Stage *stage, Where where, uint64_t *random) {
    for (int i = 0; i < FREE_LIGHTS; i++) {
        HdAim aim = hd_random_aim(&stage->shape, HD_AIM_INTERIOR, random);
        stage->light_face[i] = stage->shape.face_of[aim.triangle];
        stage->light[i] = hd_aim_point(&stage->shape, &aim, stage->shape.vertices);
        if (where == AT_THE_POINT)
            stage->light[i] = floor_point(random);
    }
}

static bool put(Stage *stage, Where where, HdPlace place, int turn, uint64_t *random) {
    HdSolidKind kind = (HdSolidKind)(turn % HD_SOLID_KIND_COUNT);
    HdVec3 degrees = hd_random_turn(random);
    hd_platonic(kind, &stage->solid);
    hd_platonic_rotate(&stage->solid, degrees);
    hd_shape_of_platonic(&stage->shape, &stage->solid);
    stage->scale = place.scale;
    stage->centre =
        hd_scale(hd_vec3(HD_OFFSET_X, HD_OFFSET_Y, HD_OFFSET_Z), place.offset * place.scale);
    for (int i = 0; i < stage->shape.triangle_count; i++) {
        const int *corner = stage->shape.corners[i];
        const HdVec3 *v = stage->shape.vertices;
        stage->triangles[i].a = hd_to_float(place_of(stage, v[corner[0]]));
        stage->triangles[i].b = hd_to_float(place_of(stage, v[corner[1]]));
        stage->triangles[i].c = hd_to_float(place_of(stage, v[corner[2]]));
    }
    choose_lights(stage, where, random);
    return compile(stage, kind, degrees, where, false) &&
           compile(stage, kind, degrees, where, true);
}

/* ---- segments, and the truth about them ---- */

static Segment segment_to_edge(const Stage *stage, bool from_within, uint64_t *random) {
    const HdPlatonic *solid = &stage->solid;
    int e = (int)random_between(random, 0.0, solid->edge_count);
    int k = (int)random_between(random, 0.0, LIGHTS_AN_EDGE);
    const HdPlatonicEdge *edge = &solid->edge[e];
    double along = (k + 0.5) / LIGHTS_AN_EDGE;
    Segment segment = {
        .number = e * LIGHTS_AN_EDGE + k, .faces = {edge->face[0], edge->face[1]}, .own_face = -1};
    segment.light = hd_add(hd_scale(solid->vertex[edge->vertex[0]], 1.0 - along),
                           hd_scale(solid->vertex[edge->vertex[1]], along));
    segment.point = floor_point(random);
    while (from_within && (segment.own_face < 0 || segment.own_face == edge->face[0] ||
                           segment.own_face == edge->face[1])) {
        HdAim aim = hd_random_aim(&stage->shape, HD_AIM_INTERIOR, random);
        segment.own_face = stage->shape.face_of[aim.triangle];
        segment.point = hd_aim_point(&stage->shape, &aim, stage->shape.vertices);
    }
    return segment;
}

static Segment choose_segment(const Stage *stage, Where where, int number, uint64_t *random) {
    if (where == EDGE_LIGHTS || where == EDGE_LIGHTS_FROM_WITHIN)
        return segment_to_edge(stage, where == EDGE_LIGHTS_FROM_WITHIN, random);
    int light = number % FREE_LIGHTS;
    Segment segment = {.number = light,
                       .faces = {stage->light_face[light], -1},
                       .own_face = -1,
                       .light = stage->light[light]};
    segment.point = where == AT_THE_POINT ? segment.light : floor_point(random);
    return segment;
}

/* Returns 1 if nothing lies between the ends, 0 if the solid does, -1 if it is too near to
   decide. */
static int is_open(const Stage *stage, const Segment *segment) {
    double most = -1e30;
    if (segment->own_face >= 0)
        return 1;
    for (int i = 0; i < 2 && segment->faces[i] >= 0; i++)
        most = fmax(most, hd_dot(stage->solid.face_normal[segment->faces[i]], segment->point) -
                              stage->solid.inradius);
    return most > margin ? 1 : most < -margin ? 0 : -1;
}

/* ---- methods ---- */

static bool plain_blocks(const Stage *stage, const Window *window, const Segment *segment,
                         bool *has_number) {
    HdFloat3 p = hd_to_float(place_of(stage, segment->point));
    HdFloat3 q = hd_to_float(place_of(stage, segment->light));
    HdFloat3 d = {q.x - p.x, q.y - p.y, q.z - p.z};
    float length = sqrtf(d.x * d.x + d.y * d.y + d.z * d.z);
    HdFloatRay ray = {.origin = p, .direction = d};
    if (window->normalised)
        ray.direction = (HdFloat3){d.x / length, d.y / length, d.z / length};
    *has_number = isfinite(d.z / length); /* the cosine on a floor */
    float end = window->normalised ? length : 1.0f;
    const HdTriangleTest *test = &hd_triangle_tests.tests[hd_triangle_tests.count - 1];
    hd_triangle_tests.prepare_ray(&ray);
    for (int i = 0; i < stage->shape.triangle_count; i++) {
        HdMeeting meeting;
        if (test->cross(&ray, &stage->triangles[i], &meeting) && meeting.t > window->epsilon &&
            meeting.t < end - window->epsilon)
            return true;
    }
    return false;
}

static bool ours_blocks(const Stage *stage, bool is_double, const Segment *segment,
                        bool *has_number) {
    const HdPlatonic *solid = &stage->solid;
    HdVec3 up = {0.0, 0.0, 1.0}, floor_centre = {0.0, 0.0, floor_height};
    bool is_within = segment->own_face >= 0;
    HdLitPoint point = {.object = is_within ? 0 : 1, .inside = is_within, .normal = up};
    HdVec3 from = is_within ? segment->point : hd_sub(segment->point, floor_centre);
    point.point = hd_scale(from, stage->scale);
    int plane_count = solid->face_count == 4 ? 4 : solid->face_count / 2;
    point.face = 2 * plane_count; /* index of the floor, which comes last */
    if (is_within) {
        point.face = solid->face_count == 4 ? 2 * segment->own_face : segment->own_face;
        point.normal = hd_scale(solid->face_normal[segment->own_face], -1.0);
    }
    const HdTable *scene = stage->compiled[is_double].tables.table;
    const HdProduct *product = is_double ? &hd_product_double : &hd_product_float;
    *has_number = isfinite(product->radiance(scene, &point));
    return !(product->transmittance(scene, &point, segment->number) > 0.0);
}

static void try_segment(const Stage *stage, Where where, const Segment *segment, Tally *tallies) {
    int truth = where == AT_THE_POINT ? 1 : is_open(stage, segment);
    for (int method = 0; method < METHODS && truth >= 0; method++) {
        bool has_number, blocks;
        if (method >= OURS)
            blocks = ours_blocks(stage, method == OURS_DOUBLE, segment, &has_number);
        else
            blocks = plain_blocks(stage, &windows[method], segment, &has_number);
        Tally *tally = &tallies[method];
        tally->open += truth;
        tally->shut += !truth;
        /* At the point itself nothing arrives, blocked or not. */
        tally->blocked_wrongly += where != AT_THE_POINT && truth && blocks;
        tally->opened_wrongly += !truth && !blocks;
        tally->no_numbers += !has_number;
    }
}

static bool study_place(Stage *stage, Where where, HdPlace place, int count) {
    Tally tallies[METHODS] = {{0}};
    uint64_t random = 4;
    bool done = true;
    for (int i = 0; i < count && done; i++) {
        if (i % SEGMENTS_A_LAMP == 0)
            done = put(stage, where, place, i / SEGMENTS_A_LAMP, &random);
        Segment segment = choose_segment(stage, where, i, &random);
        if (done)
            try_segment(stage, where, &segment, tallies);
    }
    for (int method = 0; method < METHODS && done; method++) {
        const char *name = method < OURS    ? windows[method].name
                           : method == OURS ? "ours"
                                            : "ours_double";
        printf("shadows %s %s %g %g tried=%lld blocked=%lld tried_shut=%lld opened=%lld nan=%lld\n",
               where_names[where], name, place.scale, place.offset, tallies[method].open,
               tallies[method].blocked_wrongly, tallies[method].shut,
               tallies[method].opened_wrongly, tallies[method].no_numbers);
    }
    fflush(stdout);
    return done;
}

bool hd_study_shadows(int count) {
    Stage *stage = calloc(1, sizeof *stage);
    bool done = stage != NULL;
    for (int where = EDGE_LIGHTS; where <= AT_THE_POINT && done; where++)
        for (int p = 0; p < hd_place_count && done; p++)
            done = study_place(stage, (Where)where, hd_places[p], count);
    for (int i = 0; stage != NULL && i < 2; i++)
        hd_compiled_free(&stage->compiled[i]);
    free(stage);
    return done;
}
