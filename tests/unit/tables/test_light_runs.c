/* SPDX-License-Identifier: MIT */
#include "device/self_test_scenes.h"
#include "kernels/host/shared.h"
#include "tables/tables.h"
#include "unit_test.h"

static HdError error;
static HdScene scene;
static HdSceneTables tables;

static int begin(void **state) {
    (void)state;
    return (int)hd_self_test_scene(&scene, HD_SELF_TEST_SOLID, false, false, &error);
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

static void expect_within(int light, int run) {
    const Vector *offsets = tables.table[HD_TABLE_light_offsets].data;
    const LightRun *runs = tables.table[HD_TABLE_light_runs].data;
    int objects = (int)(tables.table[HD_TABLE_objects].bytes / sizeof(Object));
    for (int object = 0; object < objects; object++) {
        const LightRun *ball = &runs[object * tables.light_count + run];
        const Vector *offset = &offsets[object * tables.light_count + light];
        float x = offset->x - ball->place[0], y = offset->y - ball->place[1],
              z = offset->z - ball->place[2];
        assert_true(x * x + y * y + z * z <= ball->radius * ball->radius);
        assert_true(ball->reach >= 50.0F);
    }
}

TEST(runs_are_of_one_group_and_within_their_sphere) {
    const Light *lights = compile(1);
    int longest = 0;
    for (int i = 0; i < tables.light_count; i++) {
        int run = lights[i].run;
        assert_true(run == 0 || (run >= 3 && i + run <= tables.light_count));
        for (int k = i; k < i + run; k++) {
            assert_int_equal(lights[k].group, lights[i].group);
            assert_int_equal(lights[k].run, k == i ? run : 0);
            expect_within(k, i);
        }
        longest = run > longest ? run : longest;
    }
    assert_true(longest >= 3);
}

/* All lights are in runs, which are as long as they can be and are not judged by themselves. */
TEST(bundles_of_several_lanes_skip_by_all_runs) {
    const Light *lights = compile(8);
    for (int i = 0, run; i < tables.light_count; i += run) {
        run = lights[i].run;
        assert_true(run >= 1 && i + run <= tables.light_count);
        for (int k = i + 1; k < i + run; k++) {
            assert_int_equal(lights[k].group, lights[i].group);
            assert_int_equal(lights[k].run, 0);
        }
        if (i + run < tables.light_count)
            assert_int_not_equal(lights[i + run].group, lights[i].group);
    }
    assert_int_equal(tables.table[HD_TABLE_light_runs].bytes, 0);
    assert_false(tables.many_lights);
}

TEST(where_no_light_ends_one_lane_has_none) {
    for (int i = 0; i < scene.light_count; i++)
        scene.lights[i].falloff = (HdFalloff){0};
    const Light *lights = compile(1);
    for (int i = 0; i < tables.light_count; i++)
        assert_int_equal(lights[i].run, 0);
    assert_true(tables.many_lights);
}

EACH(begin, end)
