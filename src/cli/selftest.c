/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include "base/text.h"
#include "choice/devices.h"
#include "cli/options.h"
#include "input/json/json_device_text.h"
#include "verify/certificate.h"

enum { TIME_SIZE = 32, HASH_SIZE = 17 };

static void write_time(const HdCertificate *certificate, char text[TIME_SIZE]) {
    const time_t seconds = (time_t)certificate->time;
    struct tm parts;
    text[0] = '\0';
    if (gmtime_r(&seconds, &parts) != NULL)
        strftime(text, TIME_SIZE, "%Y-%m-%dT%H:%M:%SZ", &parts);
}

/* ---- text ---- */

static void print_test(const HdCertificateTest *test) {
    printf("  %-8s %s", hd_verdict_names[test->verdict], test->name);
    if (test->tuples > 0)
        printf(", %d tuples of operands", test->tuples);
    if (test->frames > 0)
        printf(", %d of them", test->frames);
    if (test->by_fma)
        printf(", division by fma");
    printf(" (%.2f s)\n", test->seconds);
    if (test->reason[0] != '\0')
        printf("           %s\n", test->reason);
}

static void print_certificate(const HdCertificate *certificate) {
    const HdDevice *device = &certificate->device;
    char when[TIME_SIZE];
    write_time(certificate, when);
    printf("%s:%d  %s\n  %s\n", device->backend->name, device->index, device->name, device->driver);
    for (int i = 0; i < certificate->test_count; i++)
        print_test(&certificate->tests[i]);
    printf("  %s: hedron %s%s%s, %s, %.2f s\n", hd_verdict_names[certificate->verdict], HD_VERSION,
           certificate->compiler[0] != '\0' ? ", kernels by " : "", certificate->compiler, when,
           certificate->seconds);
}

/* ---- JSON ---- */

static json_t *text_or_null(const char *text) {
    return text[0] != '\0' ? hd_json_device_text(text) : json_null();
}

static json_t *count_or_null(int count) {
    return count > 0 ? json_integer(count) : json_null();
}

static json_t *describe_test(const HdCertificateTest *test) {
    char hash[HASH_SIZE];
    snprintf(hash, sizeof hash, "%016" PRIx64, test->hash);
    return json_pack("{s:s, s:s, s:o, s:o, s:o, s:b, s:s, s:f}", "name", test->name, "verdict",
                     hd_verdict_names[test->verdict], "reason", text_or_null(test->reason),
                     "tuples", count_or_null(test->tuples), "frames", count_or_null(test->frames),
                     "division_by_fma", test->by_fma, "hash", hash, "seconds", test->seconds);
}

static json_t *describe_tests(const HdCertificate *certificate) {
    json_t *list = json_array();
    for (int i = 0; i < certificate->test_count; i++)
        if (json_array_append_new(list, describe_test(&certificate->tests[i])) != 0) {
            json_decref(list);
            return NULL;
        }
    return list;
}

static json_t *describe_certificate(const HdCertificate *certificate) {
    const HdDevice *device = &certificate->device;
    char when[TIME_SIZE];
    write_time(certificate, when);
    return json_pack(
        "{s:s, s:s, s:i, s:o, s:o, s:o, s:s, s:o, s:s, s:f}", "hedron", HD_VERSION, "backend",
        device->backend->name, "index", device->index, "name", hd_json_device_text(device->name),
        "driver", hd_json_device_text(device->driver), "compiler",
        text_or_null(certificate->compiler), "verdict", hd_verdict_names[certificate->verdict],
        "tests", describe_tests(certificate), "time", when, "seconds", certificate->seconds);
}

/* ---- the command ---- */

typedef struct Tally {
    int tested, wrong;
    bool list_failed;
} Tally;

static HdStatus certify(const HdOptions *options, const HdDevice *device, json_t *list,
                        Tally *tally, HdError *error) {
    static HdCertificate certificate;
    const HdTestEffort effort = options->deep    ? HD_TEST_DEEP
                                : options->quick ? HD_TEST_QUICK
                                                 : HD_TEST_WHOLE;
    HdStatus status = hd_certify(&certificate, device, effort, error);
    if (status != HD_OK)
        return status;
    tally->tested += certificate.verdict != HD_VERDICT_UNTESTED;
    tally->wrong += certificate.verdict == HD_VERDICT_WRONG;
    if (list == NULL)
        print_certificate(&certificate);
    else if (json_array_append_new(list, describe_certificate(&certificate)) != 0)
        tally->list_failed = true;
    fflush(stdout);
    return HD_OK;
}

static HdStatus judge(const Tally *tally, int count, HdError *error) {
    if (tally->wrong > 0)
        return hd_fail(error, HD_FAILED, "%d of %d device%s computes wrongly", tally->wrong, count,
                       hd_plural(count));
    if (tally->tested == 0)
        return hd_fail(error, HD_UNAVAILABLE, "no device could be tested");
    return HD_OK;
}

HdStatus hd_command_selftest(const HdOptions *options, HdError *error) {
    static HdDevice devices[HD_BACKEND_COUNT * HD_MAX_DEVICES];
    Tally tally = {0};
    int count;
    HdStatus status =
        hd_devices_named(options->devices.backend, options->devices.device, devices, &count, error);
    if (status != HD_OK)
        return status;
    json_t *list = options->json ? json_array() : NULL;
    for (int i = 0; status == HD_OK && i < count; i++)
        status = certify(options, &devices[i], list, &tally, error);
    if (status == HD_OK && options->json)
        status = hd_json_print(tally.list_failed ? NULL : json_pack("{s:O}", "certificates", list),
                               "the certificates", error);
    json_decref(list);
    return status == HD_OK ? judge(&tally, count, error) : status;
}
