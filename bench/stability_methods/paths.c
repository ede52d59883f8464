/* SPDX-License-Identifier: MIT */
/* Paths between mirrors: how many reach their 30th bounce, and how many still hit the faces of the
   path in double; and after hundreds. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../scenes/models/random.h"
#include "compiled.h"
#include "product.h"
#include "shapes.h"
#include "studies.h"

/* ---- mirrored solids, and the paths of rays between them in double: independent of the kernels
   ---- */

enum { MAX_ROOM_SOLIDS = 3 };

/* Convex solids about the origin that mirror on both sides. The first has circumradius 1, and the
   others lie within it. */
typedef struct Room {
    int count;
    HdSolidKind kind[MAX_ROOM_SOLIDS];
    HdVec3 degrees[MAX_ROOM_SOLIDS], centre[MAX_ROOM_SOLIDS];
    double radius[MAX_ROOM_SOLIDS];
    HdPlatonic shape[MAX_ROOM_SOLIDS]; /* rotated, of circumradius 1 */
} Room;

typedef enum RoomKind { ROOM_EMPTY, ROOM_WITH_SOLIDS, ROOM_KINDS } RoomKind;

static const char *const room_names[ROOM_KINDS] = {"inside", "between"};

static void add(Room *room, HdSolidKind kind, HdVec3 centre, double radius, uint64_t *random) {
    int n = room->count++;
    room->kind[n] = kind;
    room->centre[n] = centre;
    room->radius[n] = radius;
    room->degrees[n] = hd_random_turn(random);
    hd_platonic(kind, &room->shape[n]);
    hd_platonic_rotate(&room->shape[n], room->degrees[n]);
}

/* Makes randomly rotated solids; `turn` chooses among their kinds. */
static void make_room(Room *room, RoomKind kind, int turn, uint64_t *random) {
    HdVec3 origin = hd_vec3(0.0, 0.0, 0.0), aside = hd_vec3(0.2511, -0.1037, 0.0892);
    room->count = 0;
    if (kind == ROOM_EMPTY) {
        add(room, (HdSolidKind)(turn % HD_SOLID_KIND_COUNT), origin, 1.0, random);
        return;
    }
    add(room, turn % 2 == 0 ? HD_HEXAHEDRON : HD_DODECAHEDRON, origin, 1.0, random);
    add(room, (HdSolidKind)(turn % HD_SOLID_KIND_COUNT), aside, 0.24, random);
    add(room, (HdSolidKind)((turn + 2) % HD_SOLID_KIND_COUNT), hd_scale(aside, -1.0), 0.24, random);
}

static double height(const Room *room, int solid, int face, HdVec3 point) {
    const HdPlatonic *shape = &room->shape[solid];
    return hd_dot(shape->face_normal[face], hd_sub(point, room->centre[solid])) -
           shape->inradius * room->radius[solid];
}

static bool is_within(const Room *room, int solid, HdVec3 point, double margin) {
    for (int face = 0; face < room->shape[solid].face_count; face++)
        if (height(room, solid, face, point) > margin)
            return false;
    return true;
}

/* Returns a place within the first solid and outside the others. */
static HdVec3 find_eye(const Room *room, uint64_t *random) {
    for (;;) {
        HdVec3 eye = hd_scale(hd_random_direction(random), random_between(random, 0.0, 0.6));
        bool fits = is_within(room, 0, eye, -0.05);
        for (int s = 1; s < room->count && fits; s++)
            fits = !is_within(room, s, eye, 0.02);
        if (fits)
            return eye;
    }
}

/* The next hit of a path: the solid, the face and the distance. */
typedef struct Next {
    double t;
    HdBounce at;
} Next;

/* Puts the exit of a ray within the solid into `next`, if it is nearer. */
static void leave(const Room *room, int solid, HdVec3 origin, HdVec3 direction, Next *next) {
    for (int face = 0; face < room->shape[solid].face_count; face++) {
        double slope = hd_dot(room->shape[solid].face_normal[face], direction);
        if (!(slope > 0.0))
            continue;
        double t = fmax(-height(room, solid, face, origin), 0.0) / slope;
        if (t < next->t)
            *next = (Next){t, {solid, face}};
    }
}

static void enter(const Room *room, int solid, HdVec3 origin, HdVec3 direction, Next *next) {
    double in = 0.0, out = next->t;
    int entered = -1;
    for (int face = 0; face < room->shape[solid].face_count; face++) {
        double slope = hd_dot(room->shape[solid].face_normal[face], direction);
        double away = height(room, solid, face, origin);
        if (slope < 0.0 && -away / slope > in) {
            in = -away / slope;
            entered = face;
        } else if (slope > 0.0) {
            out = fmin(out, -away / slope);
        } else if (away > 0.0 && slope >= 0.0) {
            return;
        }
    }
    if (entered >= 0 && in < out)
        *next = (Next){in, {solid, entered}};
}

/* Follows a path; fills the `count` faces that it hits. */
static void trace_and_shade(const Room *room, HdVec3 origin, HdVec3 direction, int count,
                            HdBounce *bounces) {
    int last = -1;
    for (int i = 0; i < count; i++) {
        Next next = {.t = 1e30};
        leave(room, 0, origin, direction, &next);
        for (int s = 1; s < room->count; s++)
            if (s != last)
                enter(room, s, origin, direction, &next);
        bounces[i] = next.at;
        last = next.at.object;
        HdVec3 normal = room->shape[last].face_normal[next.at.face];
        origin = hd_add(origin, hd_scale(direction, next.t));
        direction = hd_sub(direction, hd_scale(normal, 2.0 * hd_dot(normal, direction)));
    }
}

/* ---- paths in other renderers: triangles and rays in float, in world coordinates, with a method
   against hitting the surface that a ray leaves; not part of the product ---- */

enum { MAX_PLAIN_TRIANGLES = 128 };

typedef struct PlainScene {
    int count;
    HdFloatTriangle triangles[MAX_PLAIN_TRIANGLES];
    HdFloat3 normals[MAX_PLAIN_TRIANGLES]; /* unit, outward */
    HdBounce faces[MAX_PLAIN_TRIANGLES];
} PlainScene;

enum { AVOIDANCES = 8 };
/* The method that keeps a ray from hitting the surface that it leaves. */
typedef struct Avoidance {
    float epsilon;          /* nearer hits do not count */
    float relative_epsilon; /* likewise, times the largest coordinate of the ray's origin */
    bool moves_origin, skips_triangle, skips_face;
    bool is_moeller_trumbore; /* instead of the watertight test with the tie rule */
} Avoidance;

enum { moeller_trumbore = 1 }; /* index among the tests: that with a least determinant of 0 */

static const Avoidance avoidances[AVOIDANCES] = {
    {.epsilon = 1e-3f},     {.epsilon = 1e-4f},
    {.epsilon = 4e-6f},     {.relative_epsilon = 1e-5f},
    {.moves_origin = true}, {.skips_triangle = true},
    {.skips_face = true},   {.epsilon = 1e-4f, .is_moeller_trumbore = true},
};

static const char *const avoidance_names[AVOIDANCES] = {
    "epsilon_1e-3",    "epsilon_1e-4", "epsilon_4e-6", "relative_epsilon",
    "waechter_binder", "own_triangle", "own_face",     "moeller_trumbore_epsilon_1e-4",
};

static void make_plain_scene(PlainScene *scene, const Room *room, HdVec3 centre, double scale) {
    scene->count = 0;
    for (int s = 0; s < room->count; s++) {
        HdShape shape;
        HdVec3 at[HD_MAX_SHAPE_VERTICES];
        hd_shape_of_platonic(&shape, &room->shape[s]);
        for (int v = 0; v < shape.vertex_count; v++) {
            HdVec3 p = hd_add(room->centre[s], hd_scale(shape.vertices[v], room->radius[s]));
            at[v] = hd_add(centre, hd_scale(p, scale));
        }
        for (int i = 0; i < shape.triangle_count; i++) {
            HdFloatTriangle *triangle = &scene->triangles[scene->count];
            triangle->a = hd_to_float(at[shape.corners[i][0]]);
            triangle->b = hd_to_float(at[shape.corners[i][1]]);
            triangle->c = hd_to_float(at[shape.corners[i][2]]);
            scene->normals[scene->count] =
                hd_to_float(room->shape[s].face_normal[shape.face_of[i]]);
            scene->faces[scene->count++] = (HdBounce){s, shape.face_of[i]};
        }
    }
}

static float dot(HdFloat3 a, HdFloat3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static HdFloat3 along(HdFloat3 origin, HdFloat3 direction, float t) {
    return (HdFloat3){origin.x + t * direction.x, origin.y + t * direction.y,
                      origin.z + t * direction.z};
}

static float largest(HdFloat3 a) {
    return fmaxf(fabsf(a.x), fmaxf(fabsf(a.y), fabsf(a.z)));
}

/* C. Waechter, N. Binder 2019, A Fast and Robust Method for Avoiding Self-Intersection. */

static float moved(float p, float normal) {
    const float near_origin = 1.0f / 32.0f, float_step = 1.0f / 65536.0f, int_step = 256.0f;
    int32_t bits, steps = (int32_t)(int_step * normal);
    memcpy(&bits, &p, sizeof bits);
    bits += p < 0.0f ? -steps : steps;
    float stepped;
    memcpy(&stepped, &bits, sizeof stepped);
    return fabsf(p) < near_origin ? p + float_step * normal : stepped;
}

static HdFloat3 move_off(HdFloat3 p, HdFloat3 normal) {
    return (HdFloat3){moved(p.x, normal.x), moved(p.y, normal.y), moved(p.z, normal.z)};
}

/* Blends the corners: nearer to the triangle than a point computed along the ray. */
static HdFloat3 blend(const HdFloatTriangle *triangle, const HdMeeting *meeting) {
    float b = meeting->share_b, c = meeting->share_c, a = 1.0f - b - c;
    HdFloat3 p = triangle->a, q = triangle->b, r = triangle->c;
    return (HdFloat3){a * p.x + b * q.x + c * r.x, a * p.y + b * q.y + c * r.y,
                      a * p.z + b * q.z + c * r.z};
}

static bool is_same(HdBounce a, HdBounce b) {
    return a.object == b.object && a.face == b.face;
}

/* Returns whether a ray that leaves triangle `last` (-1: the eye) crosses another. */
static bool crosses(const PlainScene *scene, int number, const HdFloatRay *ray, int last,
                    int triangle, HdMeeting *meeting) {
    const Avoidance *avoidance = &avoidances[number];
    const HdTriangleTests *tests = &hd_triangle_tests;
    const HdTriangleTest *test =
        &tests->tests[avoidance->is_moeller_trumbore ? moeller_trumbore : tests->count - 1];
    float least = avoidance->epsilon + avoidance->relative_epsilon * largest(ray->origin);
    bool skipped = last >= 0 &&
                   ((avoidance->skips_triangle && triangle == last) ||
                    (avoidance->skips_face && is_same(scene->faces[triangle], scene->faces[last])));
    return !skipped && test->cross(ray, &scene->triangles[triangle], meeting) &&
           meeting->t > (last >= 0 ? least : 0.0f);
}

/* Returns the first triangle that a ray hits; -1: none. */
static int closest(const PlainScene *scene, int number, HdFloatRay *ray, int last, HdMeeting *met) {
    int found = -1;
    hd_triangle_tests.prepare_ray(ray);
    met->t = INFINITY;
    for (int i = 0; i < scene->count; i++) {
        HdMeeting meeting;
        if (!crosses(scene, number, ray, last, i, &meeting) || !(meeting.t < met->t))
            continue;
        *met = meeting;
        found = i;
    }
    return found;
}

/* Returns the next origin of a path on a triangle; `side` is 1 on its outer side, else -1. */
static HdFloat3 go_on_from(const PlainScene *scene, int number, const HdFloatRay *ray, int met,
                           const HdMeeting *meeting, float side) {
    HdFloat3 normal = scene->normals[met];
    HdFloat3 towards = {side * normal.x, side * normal.y, side * normal.z};
    if (avoidances[number].moves_origin)
        return move_off(blend(&scene->triangles[met], meeting), towards);
    return along(ray->origin, ray->direction, meeting->t);
}

/* Follows a path of mirrors; returns the number of faces hit, at most `most`. */
static int follow_plainly(const PlainScene *scene, int number, HdFloat3 eye, HdFloat3 direction,
                          int most, HdBounce *bounces) {
    HdFloatRay ray = {.origin = eye, .direction = direction};
    int last = -1;
    for (int count = 0; count < most; count++) {
        HdMeeting met;
        last = closest(scene, number, &ray, last, &met);
        if (last < 0)
            return count;
        bounces[count] = scene->faces[last];
        HdFloat3 normal = scene->normals[last];
        float facing = dot(normal, ray.direction);
        ray.origin = go_on_from(scene, number, &ray, last, &met, facing < 0.0f ? 1.0f : -1.0f);
        ray.direction = along(ray.direction, normal, -2.0f * facing);
    }
    return most;
}

/* ---- the study ---- */

enum { BOUNCES = 30, MANY_BOUNCES = 300, PATHS_A_ROOM = 250 };
enum { FEW = 5 }; /* bounces after which a path is likely to have many more */

/* The plain methods, then the product's. */
enum { OURS_SOLIDS = AVOIDANCES, OURS_TRIANGLES, OURS_DOUBLE, METHODS };

typedef struct Tally {
    long long paths, completed, followed, far_paths, followed_far;
} Tally;

typedef struct Path {
    HdVec3 eye, direction; /* in sizes about the room's centre; the direction rounded */
    HdBounce truth[MANY_BOUNCES];
} Path;

/* A room at one place, as every method has it. */
typedef struct Stage {
    Room room;
    Path paths[PATHS_A_ROOM];
    HdVec3 centre;
    double scale;
    PlainScene plain;
    HdCompiled compiled[METHODS - OURS_SOLIDS];
} Stage;

static const char *method_name(int method) {
    static const char *const ours[] = {"ours_solids", "ours_triangles", "ours_double"};
    return method < OURS_SOLIDS ? avoidance_names[method] : ours[method - OURS_SOLIDS];
}

static bool compile(Stage *stage, int method) {
    HdCompiled *compiled = &stage->compiled[method - OURS_SOLIDS];
    HdSolid solids[MAX_ROOM_SOLIDS];
    const Room *room = &stage->room;
    for (int s = 0; s < room->count; s++)
        solids[s] = hd_plain_solid(
            room->kind[s], hd_add(stage->centre, hd_scale(room->centre[s], stage->scale)),
            room->radius[s] * stage->scale, room->degrees[s], HD_FACE_MIRROR);
    hd_compiled_free(compiled);
    return hd_compiled_begin(compiled, solids, room->count, 0) &&
           hd_compiled_finish(
               compiled, method == OURS_DOUBLE ? HD_PRECISION_DOUBLE : HD_PRECISION_FLOAT,
               method == OURS_TRIANGLES ? HD_GEOMETRY_TRIANGLES : HD_GEOMETRY_SOLIDS);
}

static bool put(Stage *stage, HdPlace place) {
    stage->scale = place.scale;
    stage->centre =
        hd_scale(hd_vec3(HD_OFFSET_X, HD_OFFSET_Y, HD_OFFSET_Z), place.offset * place.scale);
    make_plain_scene(&stage->plain, &stage->room, stage->centre, place.scale);
    bool done = true;
    for (int method = OURS_SOLIDS; method < METHODS && done; method++)
        done = compile(stage, method);
    return done;
}

/* Returns -1 if it cannot be. */
static int walk(Stage *stage, int method, const Path *path, int most, HdBounce *found) {
    HdVec3 eye = hd_add(stage->centre, hd_scale(path->eye, stage->scale));
    if (method < OURS_SOLIDS)
        return follow_plainly(&stage->plain, method, hd_to_float(eye), hd_to_float(path->direction),
                              most, found);
    HdCompiled *compiled = &stage->compiled[method - OURS_SOLIDS];
    const HdProduct *product = method == OURS_DOUBLE ? &hd_product_double : &hd_product_float;
    if (!hd_compiled_look(compiled, eye))
        return -1;
    return product->mirror_path(compiled->tables.table, compiled->frame.table, path->direction,
                                most, found);
}

static int common_faces(const HdBounce *a, const HdBounce *b, int count) {
    int same = 0;
    while (same < count && a[same].object == b[same].object && a[same].face == b[same].face)
        same++;
    return same;
}

static bool try_path(Stage *stage, int method, const Path *path, bool goes_far, Tally *tally) {
    HdBounce found[MANY_BOUNCES];
    int count = walk(stage, method, path, BOUNCES, found);
    if (count < 0)
        return false;
    bool follows = common_faces(found, path->truth, count) == BOUNCES;
    tally->paths++;
    tally->completed += count == BOUNCES;
    tally->followed += follows;
    if (!goes_far)
        return true;
    tally->far_paths++;
    count = follows ? walk(stage, method, path, MANY_BOUNCES, found) : 0;
    tally->followed_far += common_faces(found, path->truth, count) == MANY_BOUNCES;
    return count >= 0;
}

static void make_paths(Stage *stage, RoomKind kind, int turn, int count, uint64_t *random) {
    make_room(&stage->room, kind, turn, random);
    for (int i = 0; i < count; i++) {
        Path *path = &stage->paths[i];
        path->eye = find_eye(&stage->room, random);
        path->direction = hd_round(hd_random_direction(random));
        trace_and_shade(&stage->room, path->eye, path->direction, MANY_BOUNCES, path->truth);
    }
}

static bool study_room(Stage *stage, int count, Tally (*tallies)[METHODS]) {
    int few = (count + FEW - 1) / FEW;
    bool done = true;
    for (int p = 0; p < hd_all_place_count && done; p++) {
        done = put(stage, hd_places[p]);
        for (int method = 0; method < METHODS && done; method++)
            for (int i = 0; i < count && done; i++)
                done = try_path(stage, method, &stage->paths[i], i < few, &tallies[p][method]);
    }
    return done;
}

static void print_tallies(const char *room, Tally (*tallies)[METHODS]) {
    for (int p = 0; p < hd_all_place_count; p++)
        for (int method = 0; method < METHODS; method++) {
            const Tally *tally = &tallies[p][method];
            printf("paths %s %s %g %g tried=%lld completed=%lld followed=%lld tried_far=%lld "
                   "followed_far=%lld\n",
                   room, method_name(method), hd_places[p].scale, hd_places[p].offset, tally->paths,
                   tally->completed, tally->followed, tally->far_paths, tally->followed_far);
        }
    fflush(stdout);
}

static bool study_kind(Stage *stage, RoomKind kind, int count) {
    Tally(*tallies)[METHODS] = calloc((size_t)hd_all_place_count, sizeof *tallies);
    uint64_t random = 2;
    bool done = tallies != NULL;
    for (int first = 0, turn = 0; first < count && done; first += PATHS_A_ROOM, turn++) {
        int paths = count - first < PATHS_A_ROOM ? count - first : PATHS_A_ROOM;
        make_paths(stage, kind, turn, paths, &random);
        done = study_room(stage, paths, tallies);
    }
    if (done)
        print_tallies(room_names[kind], tallies);
    free(tallies);
    return done;
}

bool hd_study_paths(int count) {
    Stage *stage = calloc(1, sizeof *stage);
    bool done = stage != NULL;
    for (int kind = 0; kind < ROOM_KINDS && done; kind++)
        done = study_kind(stage, (RoomKind)kind, count);
    for (int i = 0; stage != NULL && i < METHODS - OURS_SOLIDS; i++)
        hd_compiled_free(&stage->compiled[i]);
    free(stage);
    return done;
}
