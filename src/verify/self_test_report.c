/* SPDX-License-Identifier: MIT */
#include "verify/self_test_report.h"

#include <inttypes.h>
#include <stdio.h>
#include <time.h>

#include "base/hash.h"
#include "device/kernel_cache.h"
#include "scene/sample_pattern.h"
#include "system/machine.h"
#include "verify/first_difference.h"
#include "verify/golden.h"
#include "verify/probe.h"
#include "verify/random_scenes.h"
#include "verify/trust.h"

const char *const hd_test_result_names[] = {"right", "wrong", "untested"};
static const char *const precision_names[] = {"float", "double"};

/* Samples of a frame in a quick test, at most. */
enum { MAX_QUICK_SAMPLES = 65 * 65 };

enum { RANDOM_SCENES = 2400 };

/* State of the current part of the test. */
typedef struct Part {
    HdSelfTestReport *report;
    HdRenderer *renderer;
    HdRenderOptions options; /* of the renderer */
    HdTestEffort effort;
} Part;

/* ---- tests ---- */

static HdReportTest *begin_test(const Part *part, const char *what, const char *by) {
    HdReportTest *test = &part->report->tests[part->report->test_count++];
    *test = (HdReportTest){.seconds = -hd_monotonic_seconds()};
    snprintf(test->name, sizeof test->name, "%s %s%s%s", what,
             precision_names[part->options.precision], by,
             by[0] != '\0' ? hd_pipeline_names[part->options.pipeline] : "");
    return test;
}

/* Ends a test. `wrong` is the first difference; "": none. Returns `status`. */
static HdStatus end_test(const Part *part, HdReportTest *test, const char *wrong, HdStatus status,
                         const HdError *error) {
    HdSelfTestReport *report = part->report;
    const char *reason = status != HD_OK ? error->message : "";
    test->result = status != HD_OK ? HD_RESULT_UNTESTED : HD_RESULT_RIGHT;
    if (wrong[0] != '\0') {
        test->result = HD_RESULT_WRONG;
        reason = wrong;
    }
    snprintf(test->reason, sizeof test->reason, "%.2000s", reason);
    test->seconds += hd_monotonic_seconds();
    if (report->result == HD_RESULT_RIGHT || test->result == HD_RESULT_WRONG)
        report->result = test->result;
    return status;
}

static HdStatus test_arithmetic(const Part *part, HdError *error) {
    HdProbeReport report = {0};
    const int tuples = part->effort == HD_TEST_QUICK ? HD_PROBE_QUICK : HD_PROBE_WHOLE;
    HdReportTest *test = begin_test(part, "arithmetic in", "");
    HdStatus status = hd_probe(part->renderer, tuples, &report, error);
    if (status == HD_OK) {
        test->tuples = report.tuples;
        test->by_fma = report.found.rounds_by_fma;
        test->hash = report.hash;
    }
    return end_test(part, test, report.found.difference, status, error);
}

/* ---- golden frames ---- */

static HdStatus build_golden(const void *what, HdScene *scene, HdCamera *camera, HdError *error) {
    return hd_golden_build(what, scene, camera, error);
}

typedef struct GoldenTest {
    const Part *part;
    const HdSceneTables *like; /* needs of all frames, if kernels are compiled for them */
    HdReportTest *test;
    int wrong;
    const HdGoldenFrame *first_wrong;
    uint64_t found, expected; /* hashes of the first wrong frame */
} GoldenTest;

/* Returns whether the frame is small enough, and with or without an error bound as requested. */
static bool is_selected(const GoldenTest *golden, const HdScene *scene, bool is_bounded) {
    return hd_scene_has_error_bound(scene) == is_bounded &&
           (golden->part->effort != HD_TEST_QUICK ||
            (int64_t)scene->width * scene->height * hd_sample_count(scene) <= MAX_QUICK_SAMPLES);
}

static void check_golden(GoldenTest *golden, const HdGoldenFrame *frame, uint64_t hash) {
    HdGoldenHashes expected;
    golden->test->frames++;
    golden->test->hash = hd_hash_numbers(golden->test->hash, &hash, sizeof hash, sizeof hash);
    hd_golden_find_hashes(frame->name, golden->part->options.precision, &expected);
    if (hash == expected.frame || golden->wrong++ > 0)
        return;
    golden->first_wrong = frame;
    golden->found = hash;
    golden->expected = expected.frame;
}

static HdStatus render_golden(GoldenTest *golden, const HdGoldenFrame *frame, bool is_bounded,
                              HdError *error) {
    HdScene scene;
    HdCamera camera;
    HdFrame image;
    HD_TRY(hd_golden_build(frame, &scene, &camera, error));
    const bool renders = is_selected(golden, &scene, is_bounded);
    HdStatus status = renders ? hd_put_and_render(golden->part->renderer, &scene, &camera,
                                                  golden->like, 0, &image, error)
                              : HD_OK;
    if (renders && status == HD_OK) {
        check_golden(golden, frame, hd_frame_hash(&image));
        hd_frame_free(&image);
    }
    hd_scene_free(&scene);
    return status;
}

/* Renders all frames by the same kernels, which are kept if all frames are correct. */
static HdStatus render_all(GoldenTest *golden, bool are_bounded, HdError *error) {
    HdKernelCache *kernels = hd_renderer_kernels(golden->part->renderer);
    for (int i = 0; i < hd_golden_frame_count; i++)
        HD_TRY(render_golden(golden, &hd_golden_frames[i], are_bounded, error));
    if (kernels != NULL && golden->wrong == 0)
        hd_kernel_cache_accept(kernels);
    return HD_OK;
}

/* Reports why a frame is wrong. */
static void report_golden(const GoldenTest *golden, char *reason, size_t capacity) {
    const HdMismatch mismatch = {&golden->part->report->device, &golden->part->options,
                                 golden->like, build_golden, golden->first_wrong};
    char difference[512];
    HdError error;
    hd_first_difference(&mismatch, difference, sizeof difference, &error);
    snprintf(reason, capacity,
             "%d of %d golden frames differ, '%s' first, with the hash %016" PRIx64
             ", expected %016" PRIx64 "; the first difference: %s",
             golden->wrong, golden->test->frames, golden->first_wrong->name, golden->found,
             golden->expected, difference);
}

static HdStatus test_golden(const Part *part, HdError *error) {
    char reason[sizeof part->report->tests->reason] = "";
    GoldenTest golden = {.part = part,
                         .like = hd_renderer_kernels(part->renderer) ? &hd_golden_needs : NULL,
                         .test = begin_test(part, "golden frames in", " by ")};
    golden.test->hash = HD_HASH_START;
    hd_put_on_trial(part->renderer);
    HdStatus status = render_all(&golden, false, error);
    if (status == HD_OK && part->effort != HD_TEST_QUICK)
        status = render_all(&golden, true, error);
    if (golden.wrong > 0)
        report_golden(&golden, reason, sizeof reason);
    return end_test(part, golden.test, reason, status, error);
}

/* ---- random scenes ---- */

/* A processor's own driver already uses all threads. */
static HdStatus test_random_scenes(const Part *part, HdError *error) {
    static HdRandomResult result;
    const HdRandomTest random = {.device = &part->report->device,
                                 .options = part->options,
                                 .scenes = RANDOM_SCENES,
                                 .kind = -1,
                                 .threads = part->report->device.is_cpu ? 1 : 0};
    HdReportTest *test = begin_test(part, "random scenes in", " by ");
    HdStatus status = hd_random_test(&random, &result, error);
    test->frames = result.scenes;
    return end_test(part, test, result.text, status, error);
}

/* ---- the report ---- */

static HdStatus test_pipeline(HdSelfTestReport *report, const HdRenderOptions *options,
                              HdTestEffort effort, HdError *error) {
    Part part = {.report = report, .options = *options, .effort = effort};
    HdStatus status = hd_renderer_open(&part.renderer, &report->device, &part.options, error);
    if (status != HD_OK)
        return end_test(&part, begin_test(&part, "opening for", " by "), "", status, error);
    /* All pipelines share their arithmetic. */
    if (part.options.pipeline == HD_PIPELINE_MEGA && !report->device.backend->needs_no_driver)
        status = test_arithmetic(&part, error);
    if (status == HD_OK && report->result == HD_RESULT_RIGHT)
        status = test_golden(&part, error);
    const HdKernelCache *kernels = hd_renderer_kernels(part.renderer);
    if (kernels != NULL)
        snprintf(report->compiler, sizeof report->compiler, "%s", kernels->maker);
    hd_renderer_close(part.renderer);
    if (status == HD_OK && effort == HD_TEST_DEEP && report->result == HD_RESULT_RIGHT)
        status = test_random_scenes(&part, error);
    return status;
}

/* A device whose thread groups lack 64-bit atomics has no wavefront. */
static HdStatus test_precision(HdSelfTestReport *report, HdPrecision precision, HdTestEffort effort,
                               HdError *error) {
    HdRenderOptions options = {
        .precision = precision, .pipeline = HD_PIPELINE_MEGA, .test.keeps_pipeline = true};
    HD_TRY(test_pipeline(report, &options, effort, error));
    options.pipeline = HD_PIPELINE_WAVEFRONT;
    const bool goes_on = effort != HD_TEST_QUICK && report->result == HD_RESULT_RIGHT &&
                         hd_device_unsupported_reason(&report->device, &options) == NULL;
    return goes_on ? test_pipeline(report, &options, effort, error) : HD_OK;
}

HdStatus hd_self_test(HdSelfTestReport *report, const HdDevice *device, HdTestEffort effort,
                      HdError *error) {
    HdStatus status = HD_OK;
    *report = (HdSelfTestReport){
        .device = *device, .result = HD_RESULT_RIGHT, .seconds = -hd_monotonic_seconds()};
    report->device.not_strict[0] = '\0'; /* the test decides this again */
    for (int p = HD_PRECISION_FLOAT; status != HD_INTERRUPTED && p <= HD_PRECISION_DOUBLE; p++)
        if (p == HD_PRECISION_FLOAT || device->has_double)
            status = test_precision(report, (HdPrecision)p, effort, error);
    report->seconds += hd_monotonic_seconds();
    report->time = (int64_t)time(NULL);
    return status == HD_INTERRUPTED ? status : HD_OK;
}
