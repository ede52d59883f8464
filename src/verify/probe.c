/* SPDX-License-Identifier: MIT */
#include "verify/probe.h"

#include "verify/probe_operands.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

#define WORDS(name, words) words,
static const char *const number_words[] = {HD_PROBE_NUMBERS(WORDS)};
static const char *const integer_words[] = {HD_PROBE_INTEGERS(WORDS)};

/* Memory of a batch, in the larger precision. */
typedef struct Memory {
    double operands[3][HD_PROBE_BATCH];
    int64_t bits[HD_PROBE_BATCH];
    struct {
        double numbers[HD_PROBE_NUMBER_COUNT * HD_PROBE_BATCH];
        int64_t integers[HD_PROBE_INTEGER_COUNT * HD_PROBE_BATCH];
    } found, expected;
} Memory;

typedef struct Probe {
    HdPrecision precision;
    HdProbeBatch batch;
    HdProbeResults found, expected;
    HdProbeReport *report;
    bool only_rounding_differs; /* only divisions and roots differ */
} Probe;

static Probe probe_in(Memory *memory, HdPrecision precision, HdProbeReport *report) {
    return (Probe){
        .precision = precision,
        .batch = {.precision = precision,
                  .count = HD_PROBE_BATCH,
                  .operands = {memory->operands[0], memory->operands[1], memory->operands[2]},
                  .bits = memory->bits},
        .found = {.numbers = memory->found.numbers, .integers = memory->found.integers},
        .expected = {.numbers = memory->expected.numbers, .integers = memory->expected.integers},
        .report = report,
        .only_rounding_differs = true};
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

/* Returns whether the number is denormal. */
static bool is_small(const Probe *probe, double a) {
    double min_normal = probe->precision == HD_PRECISION_DOUBLE ? 0x1p-1022 : 0x1p-126;
    return a != 0.0 && fabs(a) < min_normal;
}

/* ---- differences ---- */

static double rounded_twice(const Probe *probe, double a, double b, double c) {
    float product = (float)a * (float)b;
    return probe->precision == HD_PRECISION_DOUBLE ? a * b + c : (double)(product + (float)c);
}

static double rounded_once(const Probe *probe, double a, double b, double c) {
    return probe->precision == HD_PRECISION_DOUBLE ? fma(a, b, c)
                                                   : (double)fmaf((float)a, (float)b, (float)c);
}

/* Returns the likely cause of a difference, in brackets; "" if unknown. */
static const char *guess_cause(const Probe *probe, int primitive, double a, double b, double c,
                               double found, double expected) {
    double first = primitive == HD_PROBE_NUMBER_unfused_from ? -a : a;
    bool is_isolated =
        primitive == HD_PROBE_NUMBER_unfused || primitive == HD_PROBE_NUMBER_unfused_from;
    bool is_rounded = primitive == HD_PROBE_NUMBER_quotient || primitive == HD_PROBE_NUMBER_root;
    if (is_isolated && is_same(found, rounded_once(probe, first, b, c)))
        return " (a product and a sum are contracted into one operation)";
    if (primitive == HD_PROBE_NUMBER_fused && is_same(found, rounded_twice(probe, a, b, c)))
        return " (it is rounded twice)";
    if (is_small(probe, expected) && found == 0.0)
        return " (denormal numbers are flushed to 0)";
    if (is_small(probe, a) || is_small(probe, b) || is_small(probe, c))
        return " (denormal operands count as 0)";
    return is_rounded ? " (it is not correctly rounded)" : "";
}

/* Returns whether nothing differs so far, so that this difference is the reported one. */
static bool is_first(const Probe *probe) {
    return probe->report->found.difference[0] == '\0';
}

static void compare_number(Probe *probe, int primitive, size_t i) {
    size_t place = (size_t)primitive * (size_t)probe->batch.count + i;
    double found = number_at(probe, probe->found.numbers, place);
    double expected = number_at(probe, probe->expected.numbers, place);
    double hashed = isnan(found) ? (double)NAN : found; /* one kind of NaN, so that hashes agree */
    probe->report->hash = hd_hash_words(probe->report->hash, &hashed, sizeof hashed, sizeof hashed);
    if (is_same(found, expected))
        return;
    double a = number_at(probe, probe->batch.operands[0], i);
    double b = number_at(probe, probe->batch.operands[1], i);
    double c = number_at(probe, probe->batch.operands[2], i);
    probe->only_rounding_differs =
        probe->only_rounding_differs &&
        (primitive == HD_PROBE_NUMBER_quotient || primitive == HD_PROBE_NUMBER_root);
    if (is_first(probe))
        snprintf(probe->report->found.difference, sizeof probe->report->found.difference,
                 "%s of a = %a, b = %a, c = %a, x = 0x%016" PRIx64 " in %s is %a, expected %a%s",
                 number_words[primitive], a, b, c, (uint64_t)probe->batch.bits[i],
                 precision_name(probe), found, expected,
                 guess_cause(probe, primitive, a, b, c, found, expected));
}

static void compare_integer(Probe *probe, int primitive, size_t i) {
    size_t place = (size_t)primitive * (size_t)probe->batch.count + i;
    int64_t found = probe->found.integers[place], expected = probe->expected.integers[place];
    probe->report->hash = hd_hash_words(probe->report->hash, &found, sizeof found, sizeof found);
    if (found == expected)
        return;
    double a = number_at(probe, probe->batch.operands[0], i);
    double b = number_at(probe, probe->batch.operands[1], i);
    probe->only_rounding_differs = false;
    if (is_first(probe))
        snprintf(probe->report->found.difference, sizeof probe->report->found.difference,
                 "%s of a = %a, b = %a, x = 0x%016" PRIx64 " in %s is %" PRId64
                 ", expected %" PRId64 "%s",
                 integer_words[primitive], a, b, (uint64_t)probe->batch.bits[i],
                 precision_name(probe), found, expected,
                 is_small(probe, a) || is_small(probe, b) ? " (denormal operands count as 0)" : "");
}

static void compare_batch(Probe *probe) {
    for (int primitive = 0; primitive < HD_PROBE_NUMBER_COUNT; primitive++)
        for (int i = 0; i < probe->batch.count; i++)
            compare_number(probe, primitive, (size_t)i);
    for (int primitive = 0; primitive < HD_PROBE_INTEGER_COUNT; primitive++)
        for (int i = 0; i < probe->batch.count; i++)
            compare_integer(probe, primitive, (size_t)i);
}

/* Devices without thread groups add nothing. */
static void compare_sums(Probe *probe) {
    const HdProbeResults *found = &probe->found, *expected = &probe->expected;
    for (int i = 0; i < HD_PROBE_SUMS; i++)
        if (found->sums[i] != expected->sums[i] || found->counters[i] != expected->counters[i]) {
            probe->only_rounding_differs = false;
            if (is_first(probe))
                snprintf(probe->report->found.difference, sizeof probe->report->found.difference,
                         "the sum %d that all threads add to atomically is 0x%016" PRIx64
                         " in 64 bits and %" PRIu32 " in 32, expected 0x%016" PRIx64
                         " and %" PRIu32,
                         i, (uint64_t)found->sums[i], found->counters[i],
                         (uint64_t)expected->sums[i], expected->counters[i]);
        }
}

/* ---- the probe ---- */

static HdStatus run(HdRenderer *renderer, Probe *probe, int tuples, HdError *error) {
    bool is_double = probe->precision == HD_PRECISION_DOUBLE;
    HdStatus status = HD_OK;
    for (int start = 0; status == HD_OK && start < tuples; start += probe->batch.count) {
        (is_double ? hd_probe_operands_double : hd_probe_operands_float)(&probe->batch,
                                                                         (uint64_t)start);
        (is_double ? hd_probe_expect_double : hd_probe_expect_float)(&probe->batch,
                                                                     &probe->expected);
        status = hd_renderer_compute(renderer, &probe->batch, &probe->found, error);
        if (status == HD_OK)
            compare_batch(probe);
        probe->report->tuples += probe->batch.count;
    }
    return status;
}

static HdStatus probe_once(HdRenderer *renderer, int tuples, HdProbeReport *report,
                           bool *only_rounding_differs, HdError *error) {
    const HdKernelShape *shape = &hd_renderer_kernels(renderer)->shape;
    Memory *memory = calloc(1, sizeof *memory);
    if (memory == NULL)
        return HD_NO_ROOM(error, "the arithmetic probe");
    Probe probe = probe_in(memory, shape->precision, report);
    *report = (HdProbeReport){.hash = HD_HASH_START};
    HdStatus status = run(renderer, &probe, tuples, error);
    if (status == HD_OK && shape->group_size > 0)
        compare_sums(&probe);
    *only_rounding_differs = probe.only_rounding_differs;
    free(memory);
    return status;
}

/* If an error remains, the report keeps the difference found without fma. */
static void try_by_fma(HdRenderer *renderer, int tuples, HdProbeReport *report) {
    HdKernelShape *shape = &hd_renderer_kernels(renderer)->shape;
    HdProbeReport healed = {0};
    HdError ignored;
    bool only_rounding_differs;
    shape->rounds_by_fma = true;
    HdStatus status = probe_once(renderer, tuples, &healed, &only_rounding_differs, &ignored);
    shape->rounds_by_fma = status == HD_OK && healed.found.difference[0] == '\0';
    if (shape->rounds_by_fma)
        *report = healed;
}

HdStatus hd_probe(HdRenderer *renderer, int tuples, HdProbeReport *report, HdError *error) {
    HdKernelCache *kernels = hd_renderer_kernels(renderer);
    const HdDevice *device = hd_renderer_device(renderer);
    bool only_rounding_differs = false;
    *report = (HdProbeReport){0};
    HdStatus status = probe_once(renderer, tuples, report, &only_rounding_differs, error);
    kernels->is_settled = false;
    if (status != HD_OK)
        return status;
    if (report->found.difference[0] != '\0' && only_rounding_differs &&
        !kernels->shape.rounds_by_fma)
        try_by_fma(renderer, tuples, report);
    report->found.rounds_by_fma = kernels->shape.rounds_by_fma;
    kernels->is_settled = report->found.difference[0] == '\0';
    hd_arithmetic_remember(device->name, device->driver, kernels->shape.precision, &report->found);
    return HD_OK;
}

HdStatus hd_probe_settle(HdRenderer *renderer, HdError *error) {
    HdKernelCache *kernels = hd_renderer_kernels(renderer);
    const HdDevice *device = hd_renderer_device(renderer);
    HdArithmetic known;
    HdProbeReport report;
    if (kernels == NULL || kernels->is_settled || kernels->shape.math != HD_MATH_STRICT)
        return HD_OK;
    if (!hd_arithmetic_recall(device->name, device->driver, kernels->shape.precision, &known)) {
        HD_TRY(hd_probe(renderer, HD_PROBE_QUICK, &report, error));
        known = report.found;
    }
    kernels->shape.rounds_by_fma = known.rounds_by_fma;
    kernels->is_settled = known.difference[0] == '\0';
    if (kernels->is_settled)
        return HD_OK;
    hd_fail(
        error, HD_UNAVAILABLE,
        "%s (%s) computes wrongly: %s; another version of its driver or compiler may do better, "
        "and --math fast does without",
        device->name, device->driver, known.difference);
    return hd_renderer_fail(renderer, HD_UNAVAILABLE, error);
}
