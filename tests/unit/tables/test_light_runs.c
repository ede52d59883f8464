/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "kernels/host/shared.h"
#include "small_scene.h"
#include "tables/table.h"
#include "unit_test.h"

static HdError error;
static HdScene scene;
static HdSceneTables tables;

static int begin(void **state) {
    enum { FAR = 40 };
    (void)state;
    if (small_scene(&scene, "hexahedron", &error) != HD_OK)
        return 1;
    free(scene.lights);
    scene.light_count = FAR;
    scene.lights = calloc(FAR, sizeof *scene.lights);
    assert_non_null(scene.lights);
    for (int i = 0; i < FAR; i++)
        scene.lights[i] = (HdLight){.position = {0.0, 0.0, 100.0 + i}, .falloff = {.end = 50.0}};
    scene.solids[0].lights = (HdEdgeLights){.colour_count = 1};
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_tables_free(&tables);
    hd_scene_free(&scene);
    return 0;
}

static const Light *compile(int lanes) {
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, lanes, &error), HD_OK);
    assert_true(tables.light_count >= 16);
    return tables.table[HD_TABLE_lights].data;
}

/* Runs are of one cluster each. With one lane they are long enough, and within their spheres. With
   several lanes all lights are in runs of maximum length, without culling of their own. */
TEST(runs_are_of_one_cluster_and_within_their_sphere) {
    for (int lanes = 1; lanes <= 8; lanes += 7) {
        const Light *lights = compile(lanes);
        const Vector *offset = tables.table[HD_TABLE_light_offsets].data;
        const LightRun *ball = tables.table[HD_TABLE_light_runs].data;
        const int objects = (int)(tables.table[HD_TABLE_objects].bytes / sizeof(Object));
        const int count = tables.light_count;
        int longest = 0;
        for (int i = 0, run; i<count; i += run> 0 ? run : 1) {
            run = lights[i].run;
            assert_true(i + run <= count && (lanes == 1 ? run == 0 || run >= 3 : run >= 1));
            for (int k = i; k < i + run; k++) {
                assert_int_equal(lights[k].cluster, lights[i].cluster);
                assert_int_equal(lights[k].run, k == i ? run : 0);
                for (int object = 0; object < objects * (lanes == 1); object++) {
                    const LightRun *own = &ball[object * count + i];
                    const Vector *to = &offset[object * count + k];
                    const float x = to->x - own->place[0], y = to->y - own->place[1],
                                z = to->z - own->place[2];
                    assert_true(x * x + y * y + z * z <= own->radius * own->radius);
                    assert_true(own->reach >= 50.0F);
                }
            }
            if (lanes > 1 && i + run < count)
                assert_int_not_equal(lights[i + run].cluster, lights[i].cluster);
            longest = run > longest ? run : longest;
        }
        assert_true(longest >= 3);
        if (lanes > 1)
            assert_int_equal(tables.table[HD_TABLE_light_runs].bytes, 0);
        hd_scene_tables_free(&tables);
    }
}

TEST(one_lane_has_no_runs_without_falloff) {
    for (int i = 0; i < scene.light_count; i++)
        scene.lights[i].falloff = (HdFalloff){0};
    const Light *lights = compile(1);
    for (int i = 0; i < tables.light_count; i++)
        assert_int_equal(lights[i].run, 0);
    assert_true(tables.many_lights);
}

EACH(begin, end)
