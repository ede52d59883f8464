/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "choice/fastest_device.h"

#include "choice/record.h"
#include "device/self_test_scenes.h"
#include "fake_backend.h"
#include "test_folder.h"

enum { FAKE, C };

static HdError error;
static HdRenderOptions options;
static HdScene scene;
static HdJob job;
static HdCandidates candidates;
static HdDevice chosen;

static int begin(void **state) {
    (void)state;
    int count;
    memset(&fake, 0, sizeof fake);
    setenv("HEDRON_CACHE", "cache", 1);
    options = (HdRenderOptions){.threads = 1};
    if (hd_self_test_scene(&scene, HD_SELF_TEST_SOLID, false, false, &error) != HD_OK)
        return 1;
    job = (HdJob){.scene = &scene, .frame_count = 100};
    candidates = (HdCandidates){.wish = {.options = &options, .job = &job},
                                .count = 2,
                                .is_free = true,
                                .compared = 2,
                                .frame_seconds = 1.0};
    candidates.list[FAKE].device = fake_device();
    hd_backend_enumerate(&hd_backend_c, &candidates.list[C].device, 1, &count, &error);
    return 0;
}

static int end(void **state) {
    (void)state;
    hd_scene_free(&scene);
    remove_folder("cache");
    return 0;
}

static HdStatus open_it(void) {
    HdTeamDevice opened;
    candidates.why[0] = candidates.note[0] = '\0';
    HdStatus status = hd_fastest_open(&candidates, &opened, &error);
    if (status != HD_OK)
        return status;
    assert_non_null(opened.renderer);
    chosen = opened.device;
    hd_launch_close(&opened);
    for (int i = 0; i < candidates.count; i++)
        candidates.list[i].renderer = NULL;
    return status;
}

static void expect_chosen(const HdBackend *backend, const char *reason) {
    assert_int_equal(open_it(), HD_OK);
    assert_ptr_equal(chosen.backend, backend);
    expect_contains(candidates.why, reason);
}

TEST(the_fastest_is_taken_and_remembered) {
    fake.slow_milliseconds = 400;
    expect_chosen(&hd_backend_c, "the fastest of 2 on this kind of scene, ");
    expect_contains(candidates.why, " ms (fake 0)");
    assert_int_equal(fake.rendered, HD_SELF_TEST_FRAMES_WITHOUT_MESHES + 2);
    fake.opened = fake.rendered = 0;
    expect_chosen(&hd_backend_c, "the fastest of 2 on this kind of scene, measured earlier, ");
    assert_int_equal(fake.opened + fake.rendered, 0);
    assert_string_equal(candidates.note, "");
}

TEST(order_decides_nothing) {
    candidates.list[1] = candidates.list[0];
    candidates.list[1].device.index = 1;
    fake.slow_milliseconds = 400;
    for (fake.slow_index = 0; fake.slow_index < 2; fake.slow_index++) {
        expect_chosen(&fake_backend, "the fastest of 2 on this kind of scene, ");
        assert_int_equal(chosen.index, 1 - fake.slow_index);
        remove_folder("cache");
    }
}

static void expect_measured(bool is_measured) {
    fake.opened = 0;
    assert_int_equal(open_it(), HD_OK);
    assert_int_equal(fake.opened, is_measured);
}

TEST(scenes_and_devices_of_another_kind_are_measured) {
    fake.slow_milliseconds = 200;
    expect_measured(true);
    expect_measured(false);
    scene.exposure = 2.0;
    scene.lights[0].position.x = 0.75;
    expect_measured(false);
    scene.depth = 60;
    expect_measured(true);
    scene.width *= 4;
    expect_measured(true);
    scene.solids[0].lights.per_edge = 7;
    expect_measured(true);
    options.precision = HD_PRECISION_DOUBLE;
    expect_measured(true);
    options.block = 64;
    expect_measured(true);
    snprintf(candidates.list[FAKE].device.driver, sizeof candidates.list[FAKE].device.driver,
             "driver 8");
    expect_measured(true);
    expect_measured(false);
}

/* Whatever else is the same. */
TEST(meshes_of_another_size_are_another_kind) {
    char text[16];
    HdScene meshes;
    assert_int_equal(hd_self_test_scene(&meshes, HD_SELF_TEST_MESH, false, false, &error), HD_OK);
    assert_int_equal(hd_record_put("test", &meshes, &options, "", "known", &error), HD_OK);
    meshes.meshes[0].triangle_count += 1;
    assert_true(hd_record_get("test", &meshes, &options, "", text, sizeof text));
    assert_string_equal(text, "known");
    meshes.meshes[0].triangle_count += 1000;
    assert_false(hd_record_get("test", &meshes, &options, "", text, sizeof text));
    hd_scene_free(&meshes);
}

TEST(a_job_too_short_is_not_measured) {
    job.frame_count = 1;
    expect_chosen(&hd_backend_c, "it needs about 1 s, too little to measure");
    assert_int_equal(fake.opened, 0);
    candidates.compared = 1; /* only GPUs are wanted */
    expect_chosen(&fake_backend, "");
}

TEST(what_computes_wrongly_is_passed_over) {
    fake.renders_wrongly = true;
    expect_chosen(&hd_backend_c, "the fastest of 2");
    expect_contains(candidates.note, "fake: Fake 1000 (driver 7) computes wrongly");
    fake.opened = 0;
    expect_chosen(&hd_backend_c, "measured earlier");
    assert_int_equal(fake.opened, 0);
    candidates.compared = 1;
    expect_chosen(&hd_backend_c, "the next after one that cannot be used");
    expect_contains(candidates.note, "computes wrongly");
}

TEST(what_is_missing_is_passed_over) {
    fake.is_missing = true;
    expect_chosen(&hd_backend_c, "the fastest of 2");
    expect_contains(candidates.note, "fake: it is missing");
    candidates.count = 1;
    candidates.compared = 1;
    assert_int_equal(open_it(), HD_UNAVAILABLE);
    expect_contains(error.message, "fake: it is missing");
}

TEST(what_fails_at_work_is_tried_again) {
    fake.fails = true;
    for (int i = 1; i <= 2; i++) {
        expect_chosen(&hd_backend_c, "the fastest of 2 on this kind of scene");
        expect_contains(candidates.note, "fake: it fails");
        assert_int_equal(fake.opened, i);
    }
}

TEST(without_a_folder_it_is_measured_each_time) {
    setenv("HEDRON_CACHE", "off", 1);
    fake.slow_milliseconds = 400;
    for (int i = 1; i <= 2; i++) {
        expect_chosen(&hd_backend_c, "the fastest of 2 on this kind of scene, ");
        assert_int_equal(fake.opened, i);
    }
}

/* ---- the estimate ---- */

/* No machine is so slow or busy that less than what it really needs would be told: more than a
   second for so many pixels on one thread, of which a few thousandths are measured. */
TEST(the_estimate_scales_with_the_picture) {
    double seconds;
    scene.width = scene.height = 16384;
    assert_int_equal(hd_trial_estimate(&options, &job, 0.0, &seconds, &error), HD_OK);
    assert_true(seconds > 1.0);
}

/* It is measured with the meshes, so that their triangles count. */

EACH(begin, end)
