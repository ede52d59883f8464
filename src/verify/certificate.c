/* SPDX-License-Identifier: MIT */
#include "verify/certificate.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/hash.h"
#include "device/kernel_source.h"
#include "device/self_test_scenes.h"
#include "system/machine.h"
#include "verify/first_difference.h"
#include "verify/golden.h"
#include "verify/random_test.h"
#include "verify/trust.h"

const char *const hd_verdict_names[] = {"right", "wrong", "untested"};
static const char *const precision_names[] = {"float", "double"};

typedef struct Build {
    HdPipeline pipeline;
    bool refracts, lit_from_behind;
    bool is_golden; /* with room for the golden frames, which it renders too */
} Build;

/* The first one does all there is. */
static const Build builds[] = {{HD_PIPELINE_MEGA, true, true, true},
                               {HD_PIPELINE_MEGA, false, false, false},
                               {HD_PIPELINE_MEGA, true, false, false},
                               {HD_PIPELINE_MEGA, false, true, false},
                               {HD_PIPELINE_WAVEFRONT, true, true, true}};
enum { BUILDS = sizeof builds / sizeof *builds };

/* Of the frames that a quick test renders. */
enum { MOST_QUICK_SAMPLES = 65 * 65 };

enum { RANDOM_SCENES = 2400 };

/* ---- tests ---- */

static HdCertificateTest *begin_test(HdCertificate *certificate, const char *name) {
    HdCertificateTest *test = &certificate->tests[certificate->test_count++];
    *test = (HdCertificateTest){.verdict = HD_VERDICT_RIGHT, .seconds = -hd_monotonic_seconds()};
    snprintf(test->name, sizeof test->name, "%s", name);
    return test;
}

static void end_test(HdCertificate *certificate, HdCertificateTest *test, HdVerdict verdict,
                     const char *reason) {
    test->verdict = verdict;
    snprintf(test->reason, sizeof test->reason, "%.2000s", reason);
    test->seconds += hd_monotonic_seconds();
    if (certificate->verdict == HD_VERDICT_RIGHT || verdict == HD_VERDICT_WRONG)
        certificate->verdict = verdict;
}

static HdStatus test_arithmetic(HdCertificate *certificate, HdRenderer *renderer,
                                HdPrecision precision, bool quick, HdError *error) {
    char name[64];
    HdProbeReport report;
    snprintf(name, sizeof name, "arithmetic in %s", precision_names[precision]);
    HdCertificateTest *test = begin_test(certificate, name);
    HdStatus status =
        hd_renderer_probe(renderer, quick ? HD_PROBE_QUICK : HD_PROBE_WHOLE, &report, error);
    if (status == HD_OK) {
        test->tuples = report.tuples;
        test->by_fma = report.rounds_by_fma;
        test->hash = report.hash;
        bool is_right = report.difference[0] == '\0';
        end_test(certificate, test, is_right ? HD_VERDICT_RIGHT : HD_VERDICT_WRONG,
                 report.difference);
    } else {
        end_test(certificate, test, HD_VERDICT_UNTESTED, error->message);
    }
    return status;
}

static HdSceneTables needs_of(const Build *build, HdPrecision precision, int lanes) {
    HdSceneTables needs = {.node_stack = 1};
    if (build->is_golden)
        needs = hd_golden_needs;
    needs.precision = precision;
    needs.lanes = lanes;
    needs.refracts = build->refracts;
    needs.lit_from_behind = build->lit_from_behind;
    return needs;
}

/* What there is to say where a frame is wrong. */
static void tell_difference(const HdDispute *dispute, char *text, size_t capacity) {
    char difference[512];
    HdError error;
    size_t length = strlen(text);
    if (hd_first_difference(dispute, difference, sizeof difference, &error) != HD_OK)
        snprintf(text + length, capacity - length,
                 "; where it differs first could not be found out: %s", error.message);
    else
        snprintf(text + length, capacity - length, "; %s%s",
                 difference[0] != '\0' ? "the first difference: "
                                       : "asked again it renders as plain C does",
                 difference);
}

typedef struct SelfTestFrame {
    HdSelfTestFrame frame;
    const Build *build;
} SelfTestFrame;

static HdStatus build_self_test_frame(const void *what, HdScene *scene, HdCamera *camera,
                                      HdError *error) {
    const SelfTestFrame *wanted = what;
    HdStatus status = hd_self_test_scene(scene, wanted->frame, wanted->build->refracts,
                                         wanted->build->lit_from_behind, error);
    return status == HD_OK ? hd_camera_at(camera, scene, 0, error) : status;
}

static HdStatus test_frames(HdCertificate *certificate, HdRenderer *renderer, HdPrecision precision,
                            const Build *build, HdError *error) {
    const HdSceneTables like = needs_of(build, precision, hd_renderer_lanes(renderer));
    char name[96], reason[sizeof certificate->tests->reason];
    HdSelfTestFrame frame;
    bool is_wrong;
    snprintf(name, sizeof name, "frames in %s by %s, %s refraction, %s from behind",
             precision_names[precision], hd_pipeline_names[build->pipeline],
             build->refracts ? "with" : "without", build->lit_from_behind ? "lit" : "not lit");
    HdCertificateTest *test = begin_test(certificate, name);
    HdStatus status = hd_renderer_self_test(renderer, &like, &test->hash, &frame, &is_wrong, error);
    snprintf(reason, sizeof reason, "%.1000s", status == HD_OK ? "" : error->message);
    if (is_wrong) {
        const SelfTestFrame what = {frame, build};
        const HdRenderOptions options = {.precision = precision, .pipeline = build->pipeline};
        tell_difference(
            &(HdDispute){&certificate->device, &options, &like, build_self_test_frame, &what},
            reason, sizeof reason);
    }
    HdVerdict verdict = is_wrong          ? HD_VERDICT_WRONG
                        : status == HD_OK ? HD_VERDICT_RIGHT
                                          : HD_VERDICT_UNTESTED;
    end_test(certificate, test, verdict, reason);
    return status;
}

/* ---- golden frames ---- */

static HdStatus build_golden_frame(const void *what, HdScene *scene, HdCamera *camera,
                                   HdError *error) {
    return hd_golden_build(what, scene, camera, error);
}

static bool is_quick(const HdScene *scene) {
    int64_t side = scene->samples_per_side;
    return !hd_scene_is_surveyed(scene) &&
           scene->width * scene->height * side * side <= MOST_QUICK_SAMPLES;
}

typedef struct GoldenTest {
    HdRenderer *renderer;
    const HdSceneTables *like; /* what all frames need, where kernels are compiled for them */
    HdPrecision precision;
    bool quick;
    HdCertificateTest *test;
    int wrong;
    const HdGoldenFrame *first_wrong;
    uint64_t found, expected; /* hashes of the first wrong one */
} GoldenTest;

static void judge_golden_frame(GoldenTest *golden, const HdGoldenFrame *frame, uint64_t hash) {
    HdGoldenHashes expected = {0};
    golden->test->frames++;
    golden->test->hash = hd_hash_bytes(golden->test->hash, &hash, sizeof hash);
    if (hd_golden_find_hashes(frame->name, golden->precision, &expected) && hash == expected.frame)
        return;
    if (golden->wrong++ > 0)
        return;
    golden->first_wrong = frame;
    golden->found = hash;
    golden->expected = expected.frame;
}

static HdStatus render_golden_frame(GoldenTest *golden, const HdGoldenFrame *frame,
                                    HdError *error) {
    HdScene scene;
    HdCamera camera;
    HdFrame image;
    HdStatus status = hd_golden_build(frame, &scene, &camera, error);
    if (status != HD_OK)
        return status;
    if (!golden->quick || is_quick(&scene)) {
        status =
            hd_put_and_render(golden->renderer, &scene, &camera, golden->like, 0, &image, error);
        if (status == HD_OK) {
            judge_golden_frame(golden, frame, hd_frame_hash(&image));
            hd_frame_free(&image);
        }
    }
    hd_scene_free(&scene);
    return status;
}

static void tell_golden_difference(const GoldenTest *golden, const HdDevice *device,
                                   HdPipeline pipeline, char *reason, size_t capacity) {
    snprintf(reason, capacity,
             "%d of %d golden frames differ, '%s' first, with the hash %016" PRIx64
             ", expected %016" PRIx64,
             golden->wrong, golden->test->frames, golden->first_wrong->name, golden->found,
             golden->expected);
    const HdRenderOptions options = {.precision = golden->precision, .pipeline = pipeline};
    tell_difference(
        &(HdDispute){device, &options, golden->like, build_golden_frame, golden->first_wrong},
        reason, capacity);
}

static HdStatus test_golden_frames(HdCertificate *certificate, HdRenderer *renderer,
                                   HdPrecision precision, HdPipeline pipeline, bool quick,
                                   HdError *error) {
    char name[96], reason[sizeof certificate->tests->reason] = "";
    snprintf(name, sizeof name, "golden frames in %s by %s", precision_names[precision],
             hd_pipeline_names[pipeline]);
    const bool is_compiled = certificate->device.backend->functions->kernels != NULL;
    GoldenTest golden = {.renderer = renderer,
                         .like = is_compiled ? &hd_golden_needs : NULL,
                         .precision = precision,
                         .quick = quick,
                         .test = begin_test(certificate, name)};
    HdStatus status = HD_OK;
    golden.test->hash = HD_HASH_START;
    for (int i = 0; status == HD_OK && i < hd_golden_frame_count; i++)
        status = render_golden_frame(&golden, &hd_golden_frames[i], error);
    if (golden.wrong > 0)
        tell_golden_difference(&golden, &certificate->device, pipeline, reason, sizeof reason);
    HdVerdict verdict = golden.wrong > 0  ? HD_VERDICT_WRONG
                        : status == HD_OK ? HD_VERDICT_RIGHT
                                          : HD_VERDICT_UNTESTED;
    end_test(certificate, golden.test, verdict,
             verdict == HD_VERDICT_UNTESTED ? error->message : reason);
    return status;
}

/* ---- renderers ---- */

static HdStatus open_renderer(HdRenderer **renderer, HdCertificate *certificate,
                              HdPrecision precision, HdPipeline pipeline, HdError *error) {
    const HdRenderOptions options = {
        .precision = precision, .pipeline = pipeline, .test.keeps_pipeline = true};
    HdDevice device = certificate->device;
    device.not_strict[0] = '\0'; /* it is to be found out anew */
    HdStatus status = hd_renderer_open(renderer, &device, &options, error);
    if (status != HD_OK) {
        char name[64];
        snprintf(name, sizeof name, "opening for %s by %s", precision_names[precision],
                 hd_pipeline_names[pipeline]);
        end_test(certificate, begin_test(certificate, name), HD_VERDICT_UNTESTED, error->message);
    }
    return status;
}

static HdStatus test_build(HdCertificate *certificate, HdRenderer *renderer, HdPrecision precision,
                           const Build *build, bool quick, HdError *error) {
    HdStatus status = test_frames(certificate, renderer, precision, build, error);
    if (status == HD_OK && build->is_golden)
        status =
            test_golden_frames(certificate, renderer, precision, build->pipeline, quick, error);
    return status;
}

/* With the builds of one pipeline; the arithmetic is tested with the first of all. */
static HdStatus test_builds(HdCertificate *certificate, HdPrecision precision, int first, int count,
                            bool quick, HdError *error) {
    HdRenderer *renderer;
    HdStatus status =
        open_renderer(&renderer, certificate, precision, builds[first].pipeline, error);
    if (status != HD_OK)
        return status;
    if (first == 0 && !certificate->device.backend->needs_no_driver)
        status = test_arithmetic(certificate, renderer, precision, quick, error);
    bool is_right = certificate->verdict == HD_VERDICT_RIGHT;
    for (int i = first; status == HD_OK && is_right && i < first + count; i++)
        status = test_build(certificate, renderer, precision, &builds[i], quick, error);
    hd_renderer_kernel_maker(renderer, certificate->compiler, sizeof certificate->compiler);
    hd_renderer_close(renderer);
    return status;
}

/* ---- random scenes ---- */

/* A processor's own driver has threads enough. */
static HdStatus test_random_scenes(HdCertificate *certificate, HdPrecision precision,
                                   HdPipeline pipeline, HdError *error) {
    static HdRandomResult result;
    char name[96];
    HdDevice device = certificate->device;
    const HdRandomTest random = {.device = &device,
                                 .options = {.precision = precision, .pipeline = pipeline},
                                 .scenes = RANDOM_SCENES,
                                 .kind = -1,
                                 .threads = certificate->device.is_cpu ? 1 : 0};
    snprintf(name, sizeof name, "random scenes in %s by %s", precision_names[precision],
             hd_pipeline_names[pipeline]);
    device.not_strict[0] = '\0'; /* it was found out anew */
    HdCertificateTest *test = begin_test(certificate, name);
    HdStatus status = hd_random_test(&random, &result, error);
    test->frames = result.scenes;
    HdVerdict verdict = result.different > 0 ? HD_VERDICT_WRONG
                        : status != HD_OK    ? HD_VERDICT_UNTESTED
                                             : HD_VERDICT_RIGHT;
    end_test(certificate, test, verdict,
             verdict == HD_VERDICT_UNTESTED ? error->message : result.text);
    return status;
}

/* ---- the certificate ---- */

/* The parts of a test by one pipeline. */
static HdStatus test_pipeline(HdCertificate *certificate, HdPrecision precision, int first,
                              int count, HdTestEffort effort, HdError *error) {
    HdStatus status =
        test_builds(certificate, precision, first, count, effort == HD_TEST_QUICK, error);
    if (status == HD_OK && effort == HD_TEST_DEEP && certificate->verdict == HD_VERDICT_RIGHT)
        status = test_random_scenes(certificate, precision, builds[first].pipeline, error);
    return status;
}

/* A device whose groups of threads lack 64-bit atomics has no wavefront. */
static HdStatus test_precision(HdCertificate *certificate, HdPrecision precision,
                               HdTestEffort effort, HdError *error) {
    const HdDevice *device = &certificate->device;
    const HdRenderOptions waves = {.precision = precision, .pipeline = HD_PIPELINE_WAVEFRONT};
    const bool quick = effort == HD_TEST_QUICK;
    HdDevice unknown = *device;
    unknown.not_strict[0] = '\0';
    HdStatus status =
        test_pipeline(certificate, precision, 0, quick ? 1 : BUILDS - 1, effort, error);
    if (status == HD_OK && !quick && certificate->verdict == HD_VERDICT_RIGHT &&
        hd_device_obstacle(&unknown, &waves) == NULL)
        status = test_pipeline(certificate, precision, BUILDS - 1, 1, effort, error);
    return status;
}

static uint64_t hash_text(uint64_t hash, const char *text) {
    return hd_hash_bytes(hash, text, strlen(text) + 1);
}

static uint64_t hash_of(const HdCertificate *certificate) {
    const HdDevice *device = &certificate->device;
    uint64_t hash = hash_text(HD_HASH_START, HD_VERSION);
    hash = hash_text(hash, device->backend->name);
    hash = hash_text(hash, device->name);
    hash = hash_text(hash, device->driver);
    hash = hash_text(hash, certificate->compiler);
    hash = hash_text(hash, hd_verdict_names[certificate->verdict]);
    for (int i = 0; i < certificate->test_count; i++) {
        const HdCertificateTest *test = &certificate->tests[i];
        char line[256];
        snprintf(line, sizeof line, "%s, %d, %d, %d, %016" PRIx64 ", %s", test->name, test->tuples,
                 test->frames, test->by_fma, test->hash, hd_verdict_names[test->verdict]);
        hash = hash_text(hash, line);
        hash = hash_text(hash, test->reason);
    }
    return hash;
}

HdStatus hd_certify(HdCertificate *certificate, const HdDevice *device, HdTestEffort effort,
                    HdError *error) {
    HdStatus status = HD_OK;
    *certificate = (HdCertificate){
        .device = *device, .verdict = HD_VERDICT_RIGHT, .seconds = -hd_monotonic_seconds()};
    for (int p = HD_PRECISION_FLOAT; status != HD_INTERRUPTED && p <= HD_PRECISION_DOUBLE; p++)
        if (p == HD_PRECISION_FLOAT || device->has_double)
            status = test_precision(certificate, (HdPrecision)p, effort, error);
    certificate->seconds += hd_monotonic_seconds();
    certificate->time = (int64_t)time(NULL);
    certificate->hash = hash_of(certificate);
    return status == HD_INTERRUPTED ? status : HD_OK;
}
