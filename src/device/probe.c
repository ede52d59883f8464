/* SPDX-License-Identifier: MIT */
#include "device/probe.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "device/kernel_cache.h"
#include "device/probe_operands.h"
#include "device/verdict.h"
#include "system/cache_folder.h"

#define WORDS(name, words) words,
static const char *const number_words[] = {HD_PROBE_NUMBERS(WORDS)};
static const char *const integer_words[] = {HD_PROBE_INTEGERS(WORDS)};

typedef struct Probe {
    HdPrecision precision;
    HdProbeBatch batch;
    HdProbeResults found, expected;
    HdProbeReport *report;
    bool only_rounding_differs; /* of divisions and roots */
} Probe;

/* ---- memory ---- */

static size_t number_size(HdPrecision precision) {
    return precision == HD_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
}

static void *take_numbers(const Probe *probe, int each) {
    return calloc((size_t)each * (size_t)probe->batch.count, number_size(probe->precision));
}

static bool take_results(const Probe *probe, HdProbeResults *results) {
    results->numbers = take_numbers(probe, HD_PROBE_NUMBER_COUNT);
    results->integers =
        calloc(HD_PROBE_INTEGER_COUNT * (size_t)probe->batch.count, sizeof(int64_t));
    return results->numbers != NULL && results->integers != NULL;
}

static void free_probe(Probe *probe) {
    for (int i = 0; i < 3; i++)
        free(probe->batch.operands[i]);
    free(probe->batch.bits);
    free(probe->found.numbers);
    free(probe->found.integers);
    free(probe->expected.numbers);
    free(probe->expected.integers);
}

static HdStatus begin(Probe *probe, HdPrecision precision, int tuples, HdProbeReport *report,
                      HdError *error) {
    *probe = (Probe){.precision = precision, .report = report, .only_rounding_differs = true};
    *report = (HdProbeReport){.hash = HD_HASH_START, .expected = HD_HASH_START};
    probe->batch.precision = precision;
    probe->batch.count = tuples < HD_PROBE_BATCH ? tuples : HD_PROBE_BATCH;
    bool has_room = true;
    for (int i = 0; i < 3; i++) {
        probe->batch.operands[i] = take_numbers(probe, 1);
        has_room = has_room && probe->batch.operands[i] != NULL;
    }
    probe->batch.bits = calloc((size_t)probe->batch.count, sizeof *probe->batch.bits);
    has_room = has_room && probe->batch.bits != NULL && take_results(probe, &probe->found) &&
               take_results(probe, &probe->expected);
    if (has_room)
        return HD_OK;
    free_probe(probe);
    return hd_fail(error, HD_FAILED, "out of memory: no room for the arithmetic probe");
}

/* ---- numbers ---- */

static double number_at(const Probe *probe, const void *numbers, size_t place) {
    return probe->precision == HD_PRECISION_DOUBLE ? ((const double *)numbers)[place]
                                                   : (double)((const float *)numbers)[place];
}

static bool is_same(double a, double b) {
    return isnan(a) ? isnan(b) : a == b && !signbit(a) == !signbit(b);
}

static const char *precision_name(const Probe *probe) {
    return probe->precision == HD_PRECISION_DOUBLE ? "double" : "float";
}

static double least_normal(const Probe *probe) {
    return probe->precision == HD_PRECISION_DOUBLE ? 0x1p-1022 : 0x1p-126;
}

static bool is_small(const Probe *probe, double a) {
    return a != 0.0 && fabs(a) < least_normal(probe);
}

/* One kind of NaN, so that hashes agree. */
static uint64_t hash_number(uint64_t hash, double number) {
    double told = isnan(number) ? (double)NAN : number;
    return hd_hash_words(hash, &told, sizeof told);
}

/* ---- what differs ---- */

static double rounded_twice(const Probe *probe, double a, double b, double c) {
    float product = (float)a * (float)b;
    return probe->precision == HD_PRECISION_DOUBLE ? a * b + c : (double)(product + (float)c);
}

static double rounded_once(const Probe *probe, double a, double b, double c) {
    return probe->precision == HD_PRECISION_DOUBLE ? fma(a, b, c)
                                                   : (double)fmaf((float)a, (float)b, (float)c);
}

/* What a difference looks like, in brackets; "" where it looks like nothing that is known. */
static const char *guess_cause(const Probe *probe, int primitive, double a, double b, double c,
                               double found, double expected) {
    double first = primitive == HD_PROBE_NUMBER_apart_from ? -a : a;
    bool is_apart = primitive == HD_PROBE_NUMBER_apart || primitive == HD_PROBE_NUMBER_apart_from;
    bool is_rounded = primitive == HD_PROBE_NUMBER_quotient || primitive == HD_PROBE_NUMBER_root;
    if (is_apart && is_same(found, rounded_once(probe, first, b, c)))
        return " (a product and a sum are contracted into one operation)";
    if (primitive == HD_PROBE_NUMBER_fused && is_same(found, rounded_twice(probe, a, b, c)))
        return " (it is rounded twice)";
    if (is_small(probe, expected) && found == 0.0)
        return " (denormal numbers are flushed to 0)";
    if (is_small(probe, a) || is_small(probe, b) || is_small(probe, c))
        return " (denormal operands are taken for 0)";
    return is_rounded ? " (it is not correctly rounded)" : "";
}

static void note_difference(Probe *probe, const char *text) {
    char *first = probe->report->difference;
    if (first[0] == '\0')
        snprintf(first, sizeof probe->report->difference, "%s", text);
}

static void compare_number(Probe *probe, int primitive, size_t i) {
    size_t place = (size_t)primitive * (size_t)probe->batch.count + i;
    double found = number_at(probe, probe->found.numbers, place);
    double expected = number_at(probe, probe->expected.numbers, place);
    probe->report->hash = hash_number(probe->report->hash, found);
    probe->report->expected = hash_number(probe->report->expected, expected);
    if (is_same(found, expected))
        return;
    double a = number_at(probe, probe->batch.operands[0], i);
    double b = number_at(probe, probe->batch.operands[1], i);
    double c = number_at(probe, probe->batch.operands[2], i);
    char text[sizeof probe->report->difference];
    probe->only_rounding_differs =
        probe->only_rounding_differs &&
        (primitive == HD_PROBE_NUMBER_quotient || primitive == HD_PROBE_NUMBER_root);
    snprintf(text, sizeof text,
             "%s of a = %a, b = %a, c = %a, x = 0x%016" PRIx64 " in %s is %a, expected %a%s",
             number_words[primitive], a, b, c, (uint64_t)probe->batch.bits[i],
             precision_name(probe), found, expected,
             guess_cause(probe, primitive, a, b, c, found, expected));
    note_difference(probe, text);
}

static void compare_integer(Probe *probe, int primitive, size_t i) {
    size_t place = (size_t)primitive * (size_t)probe->batch.count + i;
    int64_t found = probe->found.integers[place], expected = probe->expected.integers[place];
    probe->report->hash = hd_hash_words(probe->report->hash, &found, sizeof found);
    probe->report->expected = hd_hash_words(probe->report->expected, &expected, sizeof expected);
    if (found == expected)
        return;
    char text[sizeof probe->report->difference];
    double a = number_at(probe, probe->batch.operands[0], i);
    double b = number_at(probe, probe->batch.operands[1], i);
    probe->only_rounding_differs = false;
    snprintf(
        text, sizeof text,
        "%s of a = %a, b = %a, x = 0x%016" PRIx64 " in %s is %" PRId64 ", expected %" PRId64 "%s",
        integer_words[primitive], a, b, (uint64_t)probe->batch.bits[i], precision_name(probe),
        found, expected,
        is_small(probe, a) || is_small(probe, b) ? " (denormal operands are taken for 0)" : "");
    note_difference(probe, text);
}

static void compare_batch(Probe *probe) {
    for (int primitive = 0; primitive < HD_PROBE_NUMBER_COUNT; primitive++)
        for (int i = 0; i < probe->batch.count; i++)
            compare_number(probe, primitive, (size_t)i);
    for (int primitive = 0; primitive < HD_PROBE_INTEGER_COUNT; primitive++)
        for (int i = 0; i < probe->batch.count; i++)
            compare_integer(probe, primitive, (size_t)i);
}

/* Devices whose threads do not work in groups add nothing. */
static void compare_sums(Probe *probe, bool has_groups) {
    char text[sizeof probe->report->difference];
    const HdProbeResults *found = &probe->found, *expected = &probe->expected;
    for (int i = 0; has_groups && i < HD_PROBE_SUMS; i++)
        if (found->sums[i] != expected->sums[i] || found->counters[i] != expected->counters[i]) {
            probe->only_rounding_differs = false;
            snprintf(text, sizeof text,
                     "the sum %d that all threads add to atomically is 0x%016" PRIx64
                     " in 64 bits and %" PRIu32 " in 32, expected 0x%016" PRIx64 " and %" PRIu32,
                     i, (uint64_t)found->sums[i], found->counters[i], (uint64_t)expected->sums[i],
                     expected->counters[i]);
            note_difference(probe, text);
        }
}

/* ---- probing ---- */

static HdStatus run(const HdBackend *backend, void *renderer, Probe *probe, int tuples,
                    HdError *error) {
    bool is_double = probe->precision == HD_PRECISION_DOUBLE;
    HdStatus status = HD_OK;
    for (int start = 0; status == HD_OK && start < tuples; start += probe->batch.count) {
        if (is_double) {
            hd_probe_operands_double(&probe->batch, (uint64_t)start);
            hd_probe_expect_double(&probe->batch, &probe->expected);
        } else {
            hd_probe_operands_float(&probe->batch, (uint64_t)start);
            hd_probe_expect_float(&probe->batch, &probe->expected);
        }
        status = backend->functions->probe(renderer, &probe->batch, &probe->found, error);
        if (status == HD_OK)
            compare_batch(probe);
        probe->report->tuples += probe->batch.count;
    }
    return status;
}

static HdStatus probe_once(const HdBackend *backend, void *renderer, int tuples,
                           HdProbeReport *report, bool *only_rounding_differs, HdError *error) {
    Probe probe;
    const HdKernelShape *shape = &backend->functions->kernels(renderer)->shape;
    HdStatus status = begin(&probe, shape->precision, tuples, report, error);
    if (status != HD_OK)
        return status;
    status = run(backend, renderer, &probe, tuples, error);
    if (status == HD_OK)
        compare_sums(&probe, shape->group_size > 0);
    *only_rounding_differs = probe.only_rounding_differs;
    free_probe(&probe);
    return status;
}

/* What is still wrong then is told as it was without. */
static void try_by_fma(const HdBackend *backend, void *renderer, int tuples,
                       HdProbeReport *report) {
    HdKernelShape *shape = &backend->functions->kernels(renderer)->shape;
    HdProbeReport healed;
    HdError ignored;
    bool only_rounding_differs;
    shape->rounds_by_fma = true;
    HdStatus status =
        probe_once(backend, renderer, tuples, &healed, &only_rounding_differs, &ignored);
    shape->rounds_by_fma = status == HD_OK && healed.difference[0] == '\0';
    if (shape->rounds_by_fma)
        *report = healed;
}

HdStatus hd_probe(const HdBackend *backend, void *renderer, int tuples, HdProbeReport *report,
                  HdError *error) {
    HdKernelShape *shape = &backend->functions->kernels(renderer)->shape;
    bool only_rounding_differs = false;
    HdStatus status = probe_once(backend, renderer, tuples, report, &only_rounding_differs, error);
    bool is_wrong = status == HD_OK && report->difference[0] != '\0';
    if (is_wrong && only_rounding_differs && !shape->rounds_by_fma)
        try_by_fma(backend, renderer, tuples, report);
    report->rounds_by_fma = shape->rounds_by_fma;
    return status;
}

/* ---- what is remembered ---- */

static const char kind[] = "probe", right[] = "right", by_fma[] = "right with division by fma",
                  wrong[] = "wrong: ";

static HdStatus fail(const HdDevice *device, const char *difference, HdError *error) {
    return hd_fail(error, HD_UNAVAILABLE,
                   "%s (%s) computes wrongly: %s; another version of its driver or compiler may do "
                   "better, and --math fast does without",
                   device->name, device->driver, difference);
}

void hd_probe_remember(const HdBackend *backend, void *renderer, const HdDevice *device,
                       const HdProbeReport *report) {
    char key[HD_KERNEL_KEY_LENGTH], text[sizeof wrong + sizeof report->difference];
    HdError ignored;
    HdKernelShape *shape = &backend->functions->kernels(renderer)->shape;
    shape->rounds_by_fma = false; /* the key is that of a device which is not known */
    backend->functions->probe_key(renderer, key, sizeof key);
    shape->rounds_by_fma = report->rounds_by_fma;
    snprintf(text, sizeof text, "%s", report->rounds_by_fma ? by_fma : right);
    if (report->difference[0] != '\0')
        snprintf(text, sizeof text, "%s%s", wrong, report->difference);
    hd_cache_put_text(kind, key, text, &ignored);
    if (shape->precision == HD_PRECISION_FLOAT)
        hd_verdict_put(device->name, device->driver, report->difference);
}

HdStatus hd_probe_settle(const HdBackend *backend, void *renderer, const HdDevice *device,
                         HdError *error) {
    HdKernelCache *kernels = backend->functions->kernels(renderer);
    char key[HD_KERNEL_KEY_LENGTH], text[sizeof wrong + 512];
    HdProbeReport report;
    backend->functions->probe_key(renderer, key, sizeof key);
    if (hd_cache_get_text(kind, key, text, sizeof text, error) == HD_OK) {
        kernels->shape.rounds_by_fma = strcmp(text, by_fma) == 0;
        if (strncmp(text, wrong, strlen(wrong)) == 0)
            return fail(device, text + strlen(wrong), error);
        if (kernels->shape.rounds_by_fma || strcmp(text, right) == 0)
            return HD_OK;
    }
    HdStatus status = hd_probe(backend, renderer, HD_PROBE_QUICK, &report, error);
    if (status != HD_OK)
        return status;
    hd_probe_remember(backend, renderer, device, &report);
    return report.difference[0] == '\0' ? HD_OK : fail(device, report.difference, error);
}
