/* SPDX-License-Identifier: MIT */
#include "choice/certificate.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/hash.h"
#include "device/kernel_source.h"
#include "system/machine.h"

const char *const hd_verdict_names[] = {"right", "wrong", "untested"};
static const char *const precision_names[] = {"float", "double"};

typedef struct Build {
    HdPipeline pipeline;
    bool refracts, lit_from_behind;
} Build;

/* The first one does all there is. */
static const Build builds[] = {{HD_PIPELINE_MEGA, true, true},
                               {HD_PIPELINE_MEGA, false, false},
                               {HD_PIPELINE_MEGA, true, false},
                               {HD_PIPELINE_MEGA, false, true},
                               {HD_PIPELINE_WAVEFRONT, true, true}};
enum { BUILDS = sizeof builds / sizeof *builds };

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

static HdStatus test_frames(HdCertificate *certificate, HdRenderer *renderer, HdPrecision precision,
                            const Build *build, HdError *error) {
    const HdSceneTables like = {.precision = precision,
                                .lanes = hd_renderer_lanes(renderer),
                                .node_stack = 1,
                                .refracts = build->refracts,
                                .lit_from_behind = build->lit_from_behind};
    char name[96];
    bool is_wrong;
    snprintf(name, sizeof name, "frames in %s by %s, %s refraction, %s from behind",
             precision_names[precision], hd_pipeline_names[build->pipeline],
             build->refracts ? "with" : "without", build->lit_from_behind ? "lit" : "not lit");
    HdCertificateTest *test = begin_test(certificate, name);
    HdStatus status = hd_renderer_self_test(renderer, &like, &test->hash, &is_wrong, error);
    HdVerdict verdict = is_wrong          ? HD_VERDICT_WRONG
                        : status == HD_OK ? HD_VERDICT_RIGHT
                                          : HD_VERDICT_UNTESTED;
    end_test(certificate, test, verdict, status == HD_OK ? "" : error->message);
    return status;
}

static HdStatus open_renderer(HdRenderer **renderer, HdCertificate *certificate,
                              HdPrecision precision, HdPipeline pipeline, HdError *error) {
    const HdRenderOptions options = {.precision = precision, .pipeline = pipeline};
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
        status = test_frames(certificate, renderer, precision, &builds[i], error);
    hd_renderer_kernel_maker(renderer, certificate->compiler, sizeof certificate->compiler);
    hd_renderer_close(renderer);
    return status;
}

/* A device whose groups of threads lack 64-bit atomics has no wavefront. */
static HdStatus test_precision(HdCertificate *certificate, HdPrecision precision, bool quick,
                               HdError *error) {
    const HdDevice *device = &certificate->device;
    const HdRenderOptions waves = {.precision = precision, .pipeline = HD_PIPELINE_WAVEFRONT};
    HdDevice unknown = *device;
    unknown.not_strict[0] = '\0';
    HdStatus status = test_builds(certificate, precision, 0, quick ? 1 : BUILDS - 1, quick, error);
    if (status == HD_OK && !quick && certificate->verdict == HD_VERDICT_RIGHT &&
        hd_device_obstacle(&unknown, &waves) == NULL)
        status = test_builds(certificate, precision, BUILDS - 1, 1, quick, error);
    return status;
}

/* ---- the certificate ---- */

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
        snprintf(line, sizeof line, "%s, %d, %d, %016" PRIx64 ", %s", test->name, test->tuples,
                 test->by_fma, test->hash, hd_verdict_names[test->verdict]);
        hash = hash_text(hash, line);
        hash = hash_text(hash, test->reason);
    }
    return hash;
}

HdStatus hd_certify(HdCertificate *certificate, const HdDevice *device, bool quick,
                    HdError *error) {
    HdStatus status = HD_OK;
    *certificate = (HdCertificate){
        .device = *device, .verdict = HD_VERDICT_RIGHT, .seconds = -hd_monotonic_seconds()};
    for (int p = HD_PRECISION_FLOAT; status != HD_INTERRUPTED && p <= HD_PRECISION_DOUBLE; p++)
        if (p == HD_PRECISION_FLOAT || device->has_double)
            status = test_precision(certificate, (HdPrecision)p, quick, error);
    certificate->seconds += hd_monotonic_seconds();
    certificate->time = (int64_t)time(NULL);
    certificate->hash = hash_of(certificate);
    return status == HD_INTERRUPTED ? status : HD_OK;
}
