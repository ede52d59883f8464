/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "device/kernel_cache.h"

#include "fake_backend.h"
#include "small_scene.h"
#include "system/cache_folder.h"
#include "system/machine.h"
#include "test_folder.h"
#include "verify/trust.h"

static HdError error;
static HdRenderOptions options;
static HdDevice device;
static const char *kind; /* the golden frame with its scene */
static char note[1024];
static uint64_t hash;

static int begin(void **state) {
    (void)state;
    memset(&fake, 0, sizeof fake);
    options = (HdRenderOptions){.threads = 1};
    device = fake_device();
    device.has_wide_atomics = true; /* for the wavefront */
    kind = "hexahedron";
    setenv("HEDRON_CACHE", "cache", 1);
    return 0;
}

static int end(void **state) {
    (void)state;
    remove_folder("cache");
    return 0;
}

/* Renders a frame on a renderer that is opened for it. `note` becomes the report about the kernels,
   and `hash` that of the frame. */
static HdStatus render_frame(void) {
    HdRenderer *renderer;
    HdScene scene;
    HdCamera camera;
    HdFrame frame;
    assert_int_equal(small_scene(&scene, kind, &error), HD_OK);
    assert_int_equal(hd_camera_at(&camera, &scene, 0, &error), HD_OK);
    assert_int_equal(hd_renderer_open(&renderer, &device, &options, &error), HD_OK);
    HdStatus status = hd_put_and_render(renderer, &scene, &camera, NULL, 0, &frame, &error);
    snprintf(note, sizeof note, "%s", hd_renderer_kernels_note(renderer));
    if (status == HD_OK) {
        hash = hd_frame_hash(&frame);
        hd_frame_free(&frame);
    }
    hd_renderer_close(renderer);
    hd_scene_free(&scene);
    return status;
}

/* Renders; so many kernels are compiled, and loaded from the cache. */
static void expect_rendered(HdStatus status, int compiled, int loaded) {
    fake.compiled = fake.loaded = 0;
    assert_int_equal(render_frame(), status);
    assert_int_equal(fake.compiled, compiled);
    assert_int_equal(fake.loaded, loaded);
}

/* Each kind of kernels renders its golden frames for the self-test. */
TEST(a_warm_start_compiles_and_tests_nothing) {
    static const struct {
        const char *kind;
        int frames;
    } cases[] = {{"hexahedron", 1},      {"glass-cube", 2}, {"paper-cube", 2},
                 {"plain-instances", 2}, {"everything", 3}, {"paper-instances", 4},
                 {"many-instances", 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        kind = cases[i].kind;
        fake.rendered = 0;
        expect_rendered(HD_OK, 1, 0);
        const uint64_t cold = hash;
        assert_int_equal(fake.rendered, cases[i].frames + 1);
        assert_ptr_equal(strstr(note, "compiled in 1 ms by nobody; passed the self-test; "), note);
        expect_contains(note, "; cached");
        expect_rendered(HD_OK, 0, 1);
        assert_int_equal(fake.rendered, cases[i].frames + 2);
        expect_contains(note, "taken from cache, made by nobody");
        assert_true(hash == cold);
        remove_folder("cache");
    }
}

TEST(everything_that_kernels_depend_on_counts) {
    expect_rendered(HD_OK, 1, 0);
    snprintf(device.name, sizeof device.name, "Fake 2000");
    expect_rendered(HD_OK, 1, 0);
    snprintf(device.driver, sizeof device.driver, "driver 8");
    expect_rendered(HD_OK, 1, 0);
    fake.options = "-DFAST";
    expect_rendered(HD_OK, 1, 0);
    options.precision = HD_PRECISION_DOUBLE;
    fake.options = "-DDOUBLE";
    expect_rendered(HD_OK, 1, 0);
    expect_rendered(HD_OK, 0, 1);
}

/* These entries report no test, or nothing at all. */
TEST(damaged_kernels_are_compiled_again) {
    static const char *const entries[] = {"", "\n\n", "passed\nnobody\nfake", "fake"};
    expect_rendered(HD_OK, 1, 0);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(hd_cache_put_text("fake", fake.key, entries[i], &error), HD_OK);
        expect_rendered(HD_OK, 1, 0);
        expect_contains(note, "passed no test; compiled in");
        expect_rendered(HD_OK, 0, 1);
    }
}

TEST(kernels_that_a_driver_hides_are_not_cached) {
    fake.hides_binary = true;
    expect_rendered(HD_OK, 1, 0);
    expect_contains(note, "not cached; the driver does not provide them");
}

/* ---- the self-test ---- */

TEST(the_wavefront_takes_over_unless_it_is_wrong_too) {
    char text[HD_FALLBACK_LENGTH];
    fake.renders_wrongly = true;
    expect_rendered(HD_UNAVAILABLE, 2, 0);
    expect_contains(error.message, "fake: Fake 1000 (driver 7) computes wrongly: ");
    expect_contains(error.message, "the golden frame 'hexahedron' with the hash ");
    assert_int_equal(fake.rendered, 2);
    fake.is_right_in_waves = true;
    expect_rendered(HD_OK, 2, 0); /* they were not cached */
    expect_contains(note, "; passed");
    assert_true(hd_fallback_take(text));
    expect_contains(text, "the wavefront takes over: ");
    expect_contains(text, "computes wrongly: ");
}

TEST(errors_are_refused_and_frames_in_flight_are_dropped) {
    static const HdFrameRequest radiance = {.radiance = true};
    static const HdRenderOptions impossible = {.block = 33};
    HdFrame small = {.width = 1, .height = 1, .floats = HD_RADIANCE_FLOATS};
    HdRenderer *renderer;
    HdScene scene;
    HdSceneTables tables;
    HdCamera camera;
    HdFrameTables view;
    assert_int_equal(hd_renderer_open(&renderer, &device, &impossible, &error), HD_BAD_INPUT);
    assert_int_equal(hd_renderer_open(&renderer, &device, &options, &error), HD_OK);
    assert_int_equal(small_scene(&scene, kind, &error), HD_OK);
    assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 1, &error), HD_OK);
    assert_int_equal(hd_renderer_upload(renderer, &tables, &error), HD_OK);
    assert_int_equal(hd_camera_at(&camera, &scene, 0, &error), HD_OK);
    assert_int_equal(hd_compile_frame(&view, &scene, &camera, HD_PRECISION_FLOAT, NULL, &error),
                     HD_OK);
    hd_renderer_drop(renderer);
    assert_int_equal(fake.dropped, 0);
    assert_int_equal(hd_renderer_submit(renderer, &view, &radiance, &error), HD_BAD_INPUT);
    expect_contains(error.message, "with untested kernels");
    assert_int_equal(hd_put_tables(renderer, &tables, &error), HD_OK);
    assert_int_equal(hd_renderer_submit(renderer, &view, &radiance, &error), HD_OK);
    assert_int_equal(hd_renderer_submit(renderer, &view, &radiance, &error), HD_OK);
    assert_int_equal(hd_renderer_submit(renderer, &view, &radiance, &error), HD_BAD_INPUT);
    expect_contains(error.message, "a frame came while 2 frames were in flight, at most 1");
    assert_int_equal(hd_renderer_upload(renderer, &tables, &error), HD_BAD_INPUT);
    expect_contains(error.message, "a scene came while 2 frames were in flight, at most 0");
    assert_int_equal(hd_renderer_collect(renderer, &small, &error), HD_BAD_INPUT);
    expect_contains(error.message,
                    "a frame of 1 x 1 pixels and 3 floats was given for one of 16 x 16 and 3");
    hd_renderer_drop(renderer);
    hd_renderer_drop(renderer);
    assert_int_equal(fake.dropped, 1);
    assert_int_equal(hd_renderer_collect(renderer, &small, &error), HD_BAD_INPUT);
    expect_contains(error.message, "none was in flight");
    tables.lanes = 4;
    assert_int_equal(hd_renderer_upload(renderer, &tables, &error), HD_BAD_INPUT);
    expect_contains(error.message, "a scene was compiled for 4 lanes, not 1");
    view.precision = HD_PRECISION_DOUBLE;
    assert_int_equal(hd_renderer_submit(renderer, &view, &radiance, &error), HD_BAD_INPUT);
    expect_contains(error.message, "the frame are not in the precision of the renderer");
    hd_frame_tables_free(&view);
    hd_renderer_close(renderer);
    hd_scene_tables_free(&tables);
    hd_scene_free(&scene);
}

TEST(wrong_kernels_render_nothing) {
    HdRenderer *renderer;
    HdScene scene;
    HdFrame frame = {0};
    const HdFrameTables view = {0};
    fake.renders_wrongly = true;
    assert_int_equal(small_scene(&scene, "hexahedron", &error), HD_OK);
    assert_int_equal(hd_renderer_open(&renderer, &device, &options, &error), HD_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(hd_put_scene(renderer, &scene, NULL, &error), HD_UNAVAILABLE);
        assert_int_equal(hd_renderer_render(renderer, &view, &frame, &error), HD_BAD_INPUT);
    }
    assert_int_equal(fake.compiled, 2);
    hd_renderer_close(renderer);
    hd_scene_free(&scene);
}

/* Untested kernels do not count as strict arithmetic, even under the same options. */
TEST(fast_arithmetic_is_not_tested) {
    options.math = HD_MATH_FAST;
    fake.renders_wrongly = true;
    expect_rendered(HD_OK, 1, 0);
    assert_int_equal(fake.rendered, 1);
    assert_int_equal(fake.probed, 0);
    expect_contains(note, "not tested, since the arithmetic is fast; cached");
    expect_rendered(HD_OK, 0, 1);
    options.math = HD_MATH_STRICT;
    expect_rendered(HD_UNAVAILABLE, 2, 0);
}

/* The probe's result is remembered with all that it depends on, good or bad. */
TEST(arithmetic_is_probed_once) {
    expect_rendered(HD_OK, 1, 0);
    expect_rendered(HD_OK, 0, 1);
    assert_int_equal(fake.probed, 1);
    snprintf(device.driver, sizeof device.driver, "driver 8");
    fake.adds_wrongly = true;
    for (int i = 0; i < 2; i++) {
        expect_rendered(HD_UNAVAILABLE, 0, 0);
        expect_contains(error.message, "(driver 8) computes wrongly: a + b of a = ");
        expect_contains(error.message, " is 0x1p-3, expected ");
        assert_int_equal(fake.probed, 2);
    }
    HdArithmetic known;
    assert_true(hd_arithmetic_recall(device.name, "driver 8", HD_PRECISION_FLOAT, &known));
    expect_contains(known.difference, " is 0x1p-3, expected ");
    assert_false(hd_arithmetic_recall(device.name, "driver 8", HD_PRECISION_DOUBLE, &known));
    assert_true(hd_arithmetic_recall(device.name, "driver 7", HD_PRECISION_FLOAT, &known));
    assert_string_equal(known.difference, "");
    assert_false(hd_arithmetic_recall("Fake 2000", "driver 7", HD_PRECISION_FLOAT, &known));
}

TEST(corrected_division_stays_corrected) {
    fake.divides_wrongly = true;
    expect_rendered(HD_OK, 1, 0);
    assert_true(fake.divides_by_fma);
    expect_rendered(HD_OK, 0, 1);
    assert_true(fake.divides_by_fma);
    assert_int_equal(fake.probed, 2);
}

EACH(begin, end)
