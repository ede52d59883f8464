/* SPDX-License-Identifier: MIT */
/* Random segments from solids and the floor to lights: none of them crosses an object that the
   masks exclude, and the masks exclude many. */
#include "kernels/host/shared.h"
#include "scene_text.h"
#include "tables/table.h"

#define GLASS "\"material\": \"glass\""
/* To be filled in: more lights, at random. */
static const char pattern[] =
    "{\"hedron\": 1, \"camera\": {\"eye\": [30, 0, 5]}, \"materials\": {\"glass\": {}}, "
    "\"solids\": ["
    "{\"kind\": \"tetrahedron\", \"centre\": [2.5, 0, 0], \"circumradius\": 1.45, " GLASS "},"
    "{\"kind\": \"octahedron\", \"centre\": [-1.25, 2.165, 0.1], \"circumradius\": 1.35, " GLASS ","
    " \"edge_lights\": {\"per_edge\": 2, \"intensity\": 1}},"
    "{\"kind\": \"dodecahedron\", \"centre\": [-1.25, -2.165, 0.3], \"circumradius\": 1.35, " GLASS
    "},"
    "{\"kind\": \"cube\", \"centre\": [-2.5, -2, 0.1], \"circumradius\": 0.9, " GLASS "},"
    "{\"kind\": \"icosahedron\", \"centre\": [5, 3, -1.3], \"circumradius\": 1, " GLASS "}],"
    "\"lights\": [{\"position\": [2.5, 0.1, 0.2]}%s], \"floor\": {\"corners\": "
    "[[-12, 12, -1.4], [12, 12, -1.4], [12, -12, -1.4], [-12, -12, -1.4]], " GLASS "}}";

enum { SOLIDS = 5, FLOOR = SOLIDS, OBJECTS, LIGHTS = 60, POINTS = 1500 };

static HdSceneFile file;
static HdSceneTables tables;
static const Object *objects;
static const Plane *planes;
static const int *ways;

static double between(double least, double most) {
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * (double)(state >> 11) * 0x1p-53;
}

static void compile(void) {
    HdError error;
    hd_scene_tables_free(&tables);
    assert_int_equal(hd_compile_scene(&tables, &file.scene, HD_PRECISION_FLOAT, 8, &error), HD_OK);
    objects = tables.table[HD_TABLE_objects].data;
    planes = tables.table[HD_TABLE_planes].data;
    ways = tables.table[HD_TABLE_occlusion_masks].data;
}

static int begin(void **state) {
    (void)state;
    char text[16384], lights[LIGHTS * 64] = "";
    for (int i = 0; i < LIGHTS; i++) {
        double x = between(-6.0, 6.0), y = between(-6.0, 6.0), z = between(-1.3, 6.0);
        snprintf(lights + strlen(lights), 64, ", {\"position\": [%.3f, %.3f, %.3f]}", x, y, z);
    }
    snprintf(text, sizeof text, pattern, lights);
    expect_scene(&file, text, NULL);
    compile();
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_tables_free(&tables);
    hd_scene_file_free(&file);
    return 0;
}

static double along(const Plane *plane, HdVec3 v) {
    return (double)plane->x * v.x + (double)plane->y * v.y + (double)plane->z * v.z;
}

/* Returns a point on the surface, relative to the object. */
static HdVec3 point_on(int object) {
    HdVec3 v = {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
    if (object == FLOOR)
        return (HdVec3){12.0 * v.x, 12.0 * v.y, 0.0};
    double farthest = 0.0;
    for (int k = 0; k < objects[object].plane_count; k++) {
        const Plane *plane = planes + objects[object].first_plane + k;
        double h = along(plane, v) / (double)plane->distance;
        farthest = fmax(farthest, objects[object].paired ? fabs(h) : h);
    }
    return (HdVec3){v.x / farthest, v.y / farthest, v.z / farthest};
}

static HdVec3 offset(int table, int row) {
    const Vector *v = (const Vector *)tables.table[table].data + row;
    return (HdVec3){(double)v->x, (double)v->y, (double)v->z};
}

/* Cuts the segment to the part behind one half-space. */
static void clip(double from, double to, double distance, double *first, double *last) {
    double t = (distance - from) / (to - from);
    if (to > from)
        *last = fmin(*last, t);
    else if (to < from)
        *first = fmax(*first, t);
    else if (from > distance)
        *last = -1.0;
}

static bool crosses(int object, HdVec3 from, HdVec3 to) {
    const Plane *own = planes + objects[object].first_plane;
    if (object == FLOOR)
        return along(own, from) * along(own, to) < 0.0;
    double first = 0.0, last = 1.0;
    for (int k = 0; k < objects[object].plane_count; k++) {
        double a = along(own + k, from), b = along(own + k, to);
        clip(a, b, (double)own[k].distance, &first, &last);
        if (objects[object].paired)
            clip(-a, -b, (double)own[k].distance, &first, &last);
    }
    return first < last;
}

static bool cannot_occlude(int from, int light, int object) {
    return ways[from * (tables.light_count + 1) + 1 + light] >> object & 1;
}

/* Masks of single lights, and before them one of all lights. */
TEST(segments_miss_excluded_objects) {
    int nonoccluders = 0, others = 0, crossed = 0;
    for (int from = 0; from < OBJECTS; from++)
        for (int object = 0; object < OBJECTS; object++) {
            bool all = true;
            for (int light = 0; light < tables.light_count; light++) {
                all = all && cannot_occlude(from, light, object);
                if (object == from)
                    continue;
                bool missed = cannot_occlude(from, light, object), is_crossed = false;
                HdVec3 move = offset(HD_TABLE_object_offsets, from * OBJECTS + object);
                HdVec3 to = offset(HD_TABLE_light_offsets, object * tables.light_count + light);
                for (int i = 0; i < POINTS && !is_crossed; i++)
                    is_crossed = crosses(object, hd_add(point_on(from), move), to);
                assert_false(missed && is_crossed);
                nonoccluders += missed;
                others += !missed;
                crossed += is_crossed;
            }
            assert_int_equal(cannot_occlude(from, -1, object), all);
        }
    /* Most objects that the masks do not exclude are crossed: the hulls are not much too wide. */
    assert_true(nonoccluders > others);
    assert_true(2 * crossed > others);
}

/* The dodecahedron and the cube overlap, the icosahedron is in the floor. The first light is in the
   tetrahedron, the second one is not. */
TEST(solids_that_others_reach_into_are_not_isolated) {
    static const int isolated[OBJECTS] = {1, 1, 0, 0, 0, 0};
    for (int i = 0; i < OBJECTS; i++)
        assert_int_equal(objects[i].isolated, isolated[i]);
    assert_true(cannot_occlude(0, 0, 0) && cannot_occlude(FLOOR, 0, FLOOR) &&
                !cannot_occlude(0, 1, 0));
}

/* For distant rays rounding puts points off the solids, so that nothing is known: the eye is 10^7
   radii away, which a float resolves to about one. */
TEST(nothing_is_known_where_points_are_off) {
    file.scene.eye.point.x = 1e7;
    compile();
    for (int from = 0; from < SOLIDS; from++) {
        assert_false(objects[from].isolated);
        for (int light = 0; light < tables.light_count; light++)
            for (int object = 0; object < OBJECTS; object++)
                assert_true(object == from || !cannot_occlude(from, light, object));
    }
}

GROUP(begin, end)
