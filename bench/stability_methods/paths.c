/* SPDX-License-Identifier: MIT */
/* Paths between mirrors: how many come to their 30th bounce, and how many still meet the faces that
   the path in double meets; and after hundreds. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiled.h"
#include "methods.h"
#include "mirror_rooms.h"
#include "plain_paths.h"
#include "shapes.h"
#include "studies.h"

enum { BOUNCES = 30, MANY_BOUNCES = 300, PATHS_A_ROOM = 250 };
enum { FEW = 5 }; /* a path of so many goes on to many bounces */

/* The plain methods, then the product's. */
enum { OURS_SOLIDS = HD_AVOIDANCES, OURS_TRIANGLES, OURS_DOUBLE, METHODS };

typedef struct Tally {
    long long paths, completed, followed, far_paths, followed_far;
} Tally;

typedef struct Path {
    HdVec3 eye, direction; /* in sizes about the room's centre; the direction rounded */
    HdBounce truth[MANY_BOUNCES];
} Path;

/* A room at one place, as every method has it. */
typedef struct Stage {
    HdRoom room;
    Path paths[PATHS_A_ROOM];
    HdVec3 centre;
    double scale;
    HdPlainScene plain;
    HdCompiled compiled[METHODS - OURS_SOLIDS];
} Stage;

static const char *method_name(int method) {
    static const char *const ours[] = {"ours_solids", "ours_triangles", "ours_double"};
    return method < OURS_SOLIDS ? hd_avoidance_names[method] : ours[method - OURS_SOLIDS];
}

static bool compile(Stage *stage, int method) {
    HdCompiled *compiled = &stage->compiled[method - OURS_SOLIDS];
    HdSolid solids[HD_MOST_ROOM_SOLIDS];
    const HdRoom *room = &stage->room;
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
    hd_plain_scene_make(&stage->plain, &stage->room, stage->centre, place.scale);
    bool done = true;
    for (int method = OURS_SOLIDS; method < METHODS && done; method++)
        done = compile(stage, method);
    return done;
}

/* Returns -1 where it cannot be. */
static int walk(Stage *stage, int method, const Path *path, int most, HdBounce *found) {
    HdVec3 eye = hd_add(stage->centre, hd_scale(path->eye, stage->scale));
    if (method < OURS_SOLIDS)
        return hd_plain_path(&stage->plain, method, hd_to_float(eye), hd_to_float(path->direction),
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

static void make_paths(Stage *stage, HdRoomKind kind, int turn, int count, uint64_t *random) {
    hd_room_make(&stage->room, kind, turn, random);
    for (int i = 0; i < count; i++) {
        Path *path = &stage->paths[i];
        path->eye = hd_room_eye(&stage->room, random);
        path->direction = hd_round(hd_random_direction(random));
        hd_room_follow(&stage->room, path->eye, path->direction, MANY_BOUNCES, path->truth);
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

static bool study_kind(Stage *stage, HdRoomKind kind, int count) {
    Tally(*tallies)[METHODS] = calloc((size_t)hd_all_place_count, sizeof *tallies);
    uint64_t random = 2;
    bool done = tallies != NULL;
    for (int first = 0, turn = 0; first < count && done; first += PATHS_A_ROOM, turn++) {
        int paths = count - first < PATHS_A_ROOM ? count - first : PATHS_A_ROOM;
        make_paths(stage, kind, turn, paths, &random);
        done = study_room(stage, paths, tallies);
    }
    if (done)
        print_tallies(hd_room_names[kind], tallies);
    free(tallies);
    return done;
}

bool hd_study_paths(int count) {
    Stage *stage = calloc(1, sizeof *stage);
    bool done = stage != NULL;
    for (int kind = 0; kind < HD_ROOM_KINDS && done; kind++)
        done = study_kind(stage, (HdRoomKind)kind, count);
    for (int i = 0; stage != NULL && i < METHODS - OURS_SOLIDS; i++)
        hd_compiled_free(&stage->compiled[i]);
    free(stage);
    return done;
}
