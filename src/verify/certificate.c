/* SPDX-License-Identifier: MIT */
#include "verify/certificate.h"

#include <inttypes.h>
#include <stdio.h>
#include <time.h>

#include "base/hash.h"
#include "device/kernel_cache.h"
#include "system/machine.h"
#include "verify/first_difference.h"
#include "verify/golden.h"
#include "verify/probe.h"
#include "verify/random_scenes.h"
#include "verify/trust.h"

const char *const hd_verdict_names[] = {"right", "wrong", "untested"};
static const char *const precision_names[] = {"float", "double"};

/* Of the frames that a quick test renders. */
enum { MOST_QUICK_SAMPLES = 65 * 65 };

enum { RANDOM_SCENES = 2400 };

/* What is tested at a time. */
typedef struct Part {
    HdCertificate *certificate;
    HdRenderer *renderer;
    HdRenderOptions options; /* of the renderer */
    HdTestEffort effort;
} Part;

/* ---- tests ---- */

static HdCertificateTest *begin_test(const Part *part, const char *what, const char *by) {
    HdCertificateTest *test = &part->certificate->tests[part->certificate->test_count++];
    *test = (HdCertificateTest){.seconds = -hd_monotonic_seconds()};
    snprintf(test->name, sizeof test->name, "%s %s%s%s", what,
             precision_names[part->options.precision], by,
             by[0] != '\0' ? hd_pipeline_names[part->options.pipeline] : "");
    return test;
}

/* `wrong` is what differs first; "": nothing does. Returns `status`. */
static HdStatus end_test(const Part *part, HdCertificateTest *test, const char *wrong,
                         HdStatus status, const HdError *error) {
    HdCertificate *certificate = part->certificate;
    const char *reason = status != HD_OK ? error->message : "";
    test->verdict = status != HD_OK ? HD_VERDICT_UNTESTED : HD_VERDICT_RIGHT;
    if (wrong[0] != '\0') {
        test->verdict = HD_VERDICT_WRONG;
        reason = wrong;
    }
    snprintf(test->reason, sizeof test->reason, "%.2000s", reason);
    test->seconds += hd_monotonic_seconds();
    if (certificate->verdict == HD_VERDICT_RIGHT || test->verdict == HD_VERDICT_WRONG)
        certificate->verdict = test->verdict;
    return status;
}

static HdStatus test_arithmetic(const Part *part, HdError *error) {
    HdProbeReport report = {0};
    const int tuples = part->effort == HD_TEST_QUICK ? HD_PROBE_QUICK : HD_PROBE_WHOLE;
    HdCertificateTest *test = begin_test(part, "arithmetic in", "");
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
    const HdSceneTables *like; /* what all frames need, where kernels are compiled for them */
    HdCertificateTest *test;
    int wrong;
    const HdGoldenFrame *first_wrong;
    uint64_t found, expected; /* hashes of the first wrong one */
} GoldenTest;

/* If it is surveyed or not, and small enough. */
static bool is_wanted(const GoldenTest *golden, const HdScene *scene, bool is_surveyed) {
    const int64_t side = scene->samples_per_side;
    return hd_scene_is_surveyed(scene) == is_surveyed &&
           (golden->part->effort != HD_TEST_QUICK ||
            scene->width * scene->height * side * side <= MOST_QUICK_SAMPLES);
}

static void judge_golden(GoldenTest *golden, const HdGoldenFrame *frame, uint64_t hash) {
    HdGoldenHashes expected;
    golden->test->frames++;
    golden->test->hash = hd_hash_bytes(golden->test->hash, &hash, sizeof hash);
    hd_golden_find_hashes(frame->name, golden->part->options.precision, &expected);
    if (hash == expected.frame || golden->wrong++ > 0)
        return;
    golden->first_wrong = frame;
    golden->found = hash;
    golden->expected = expected.frame;
}

static HdStatus render_golden(GoldenTest *golden, const HdGoldenFrame *frame, bool is_surveyed,
                              HdError *error) {
    HdScene scene;
    HdCamera camera;
    HdFrame image;
    HD_TRY(hd_golden_build(frame, &scene, &camera, error));
    const bool renders = is_wanted(golden, &scene, is_surveyed);
    HdStatus status = renders ? hd_put_and_render(golden->part->renderer, &scene, &camera,
                                                  golden->like, 0, &image, error)
                              : HD_OK;
    if (renders && status == HD_OK) {
        judge_golden(golden, frame, hd_frame_hash(&image));
        hd_frame_free(&image);
    }
    hd_scene_free(&scene);
    return status;
}

/* By the same kernels, which are kept if all frames are right. */
static HdStatus render_all(GoldenTest *golden, bool are_surveyed, HdError *error) {
    HdKernelCache *kernels = hd_renderer_kernels(golden->part->renderer);
    for (int i = 0; i < hd_golden_frame_count; i++)
        HD_TRY(render_golden(golden, &hd_golden_frames[i], are_surveyed, error));
    if (kernels != NULL && golden->wrong == 0)
        hd_kernel_cache_accept(kernels);
    return HD_OK;
}

/* What there is to say where a frame is wrong. */
static void tell_golden(const GoldenTest *golden, char *reason, size_t capacity) {
    const HdDispute dispute = {&golden->part->certificate->device, &golden->part->options,
                               golden->like, build_golden, golden->first_wrong};
    char difference[512];
    HdError error;
    hd_first_difference(&dispute, difference, sizeof difference, &error);
    snprintf(reason, capacity,
             "%d of %d golden frames differ, '%s' first, with the hash %016" PRIx64
             ", expected %016" PRIx64 "; the first difference: %s",
             golden->wrong, golden->test->frames, golden->first_wrong->name, golden->found,
             golden->expected, difference);
}

static HdStatus test_golden(const Part *part, HdError *error) {
    char reason[sizeof part->certificate->tests->reason] = "";
    GoldenTest golden = {.part = part,
                         .like = hd_renderer_kernels(part->renderer) ? &hd_golden_needs : NULL,
                         .test = begin_test(part, "golden frames in", " by ")};
    golden.test->hash = HD_HASH_START;
    hd_put_on_trial(part->renderer);
    HdStatus status = render_all(&golden, false, error);
    if (status == HD_OK && part->effort != HD_TEST_QUICK)
        status = render_all(&golden, true, error);
    if (golden.wrong > 0)
        tell_golden(&golden, reason, sizeof reason);
    return end_test(part, golden.test, reason, status, error);
}

/* ---- random scenes ---- */

/* A processor's own driver has threads enough. */
static HdStatus test_random_scenes(const Part *part, HdError *error) {
    static HdRandomResult result;
    const HdRandomTest random = {.device = &part->certificate->device,
                                 .options = part->options,
                                 .scenes = RANDOM_SCENES,
                                 .kind = -1,
                                 .threads = part->certificate->device.is_cpu ? 1 : 0};
    HdCertificateTest *test = begin_test(part, "random scenes in", " by ");
    HdStatus status = hd_random_test(&random, &result, error);
    test->frames = result.scenes;
    return end_test(part, test, result.text, status, error);
}

/* ---- the certificate ---- */

static HdStatus test_pipeline(HdCertificate *certificate, const HdRenderOptions *options,
                              HdTestEffort effort, HdError *error) {
    Part part = {.certificate = certificate, .options = *options, .effort = effort};
    HdStatus status = hd_renderer_open(&part.renderer, &certificate->device, &part.options, error);
    if (status != HD_OK)
        return end_test(&part, begin_test(&part, "opening for", " by "), "", status, error);
    /* The arithmetic is the same in all pipelines. */
    if (part.options.pipeline == HD_PIPELINE_MEGA && !certificate->device.backend->needs_no_driver)
        status = test_arithmetic(&part, error);
    if (status == HD_OK && certificate->verdict == HD_VERDICT_RIGHT)
        status = test_golden(&part, error);
    const HdKernelCache *kernels = hd_renderer_kernels(part.renderer);
    if (kernels != NULL)
        snprintf(certificate->compiler, sizeof certificate->compiler, "%s", kernels->maker);
    hd_renderer_close(part.renderer);
    if (status == HD_OK && effort == HD_TEST_DEEP && certificate->verdict == HD_VERDICT_RIGHT)
        status = test_random_scenes(&part, error);
    return status;
}

/* A device whose groups of threads lack 64-bit atomics has no wavefront. */
static HdStatus test_precision(HdCertificate *certificate, HdPrecision precision,
                               HdTestEffort effort, HdError *error) {
    HdRenderOptions options = {
        .precision = precision, .pipeline = HD_PIPELINE_MEGA, .test.keeps_pipeline = true};
    HD_TRY(test_pipeline(certificate, &options, effort, error));
    options.pipeline = HD_PIPELINE_WAVEFRONT;
    const bool goes_on = effort != HD_TEST_QUICK && certificate->verdict == HD_VERDICT_RIGHT &&
                         hd_device_obstacle(&certificate->device, &options) == NULL;
    return goes_on ? test_pipeline(certificate, &options, effort, error) : HD_OK;
}

HdStatus hd_certify(HdCertificate *certificate, const HdDevice *device, HdTestEffort effort,
                    HdError *error) {
    HdStatus status = HD_OK;
    *certificate = (HdCertificate){
        .device = *device, .verdict = HD_VERDICT_RIGHT, .seconds = -hd_monotonic_seconds()};
    certificate->device.not_strict[0] = '\0'; /* it is to be found out anew */
    for (int p = HD_PRECISION_FLOAT; status != HD_INTERRUPTED && p <= HD_PRECISION_DOUBLE; p++)
        if (p == HD_PRECISION_FLOAT || device->has_double)
            status = test_precision(certificate, (HdPrecision)p, effort, error);
    certificate->seconds += hd_monotonic_seconds();
    certificate->time = (int64_t)time(NULL);
    return status == HD_INTERRUPTED ? status : HD_OK;
}
