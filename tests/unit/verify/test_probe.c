/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
/* Results of the arithmetic probe on devices that compute correctly and on others. */
#include "verify/probe.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "device/kernel_cache.h"
#include "unit_test.h"
#include "verify/probe_operands.h"

typedef enum Fault {
    NONE,
    OTHER_NAN,
    DIVISION,
    DIVISION_FOR_GOOD,
    DIVISION_AND_FAILS_BY_FMA,
    FLUSHED_RESULTS,
    FLUSHED_OPERANDS,
    CONTRACTED,
    ZERO_WITHOUT_SIGN,
    LOST_ADDITION,
    ROUNDED_TO_INT
} Fault;

static HdError error;
static HdKernelCache kernels;
static Fault fault;

static HdKernelCache *fake_kernels(void *renderer) {
    (void)renderer;
    return &kernels;
}

static float flushed(float a) {
    return fabsf(a) < 0x1p-126f ? copysignf(0.0f, a) : a;
}

static void spoil_tuple(const HdProbeBatch *batch, HdProbeResults *results, int i) {
    const float *const *operands = (const float *const *)batch->operands;
    const float a = operands[0][i], b = operands[1][i], c = operands[2][i];
    float *numbers = (float *)results->numbers + i;
    float *quotient = numbers + HD_PROBE_NUMBER_quotient * batch->count;
    float *product = numbers + HD_PROBE_NUMBER_product * batch->count;
    const bool is_healed = fault == DIVISION && kernels.shape.rounds_by_fma;
    if (fault >= DIVISION && fault <= DIVISION_AND_FAILS_BY_FMA && !is_healed &&
        isnormal(*quotient))
        *quotient = nextafterf(*quotient, INFINITY);
    if (fault == CONTRACTED)
        numbers[HD_PROBE_NUMBER_unfused * batch->count] = fmaf(a, b, c);
    if (fault == ZERO_WITHOUT_SIGN && a == 0.0f)
        numbers[HD_PROBE_NUMBER_plus_zero * batch->count] = a;
    if (fault == FLUSHED_RESULTS)
        *product = flushed(*product);
    if (fault == FLUSHED_OPERANDS)
        *product = flushed(a) * flushed(b);
    if (fault == OTHER_NAN && isnan(*product))
        *product = -nanf("77");
}

static HdStatus fake_probe(void *renderer, const HdProbeBatch *batch, HdProbeResults *results,
                           HdError *failure) {
    (void)renderer;
    if (fault == DIVISION_AND_FAILS_BY_FMA && kernels.shape.rounds_by_fma)
        return hd_fail(failure, HD_FAILED, "it does not compile");
    if (batch->precision == HD_PRECISION_DOUBLE)
        hd_probe_expect_double(batch, results);
    else
        hd_probe_expect_float(batch, results);
    for (int i = 0; fault != NONE && i < batch->count; i++)
        spoil_tuple(batch, results, i);
    if (fault == LOST_ADDITION)
        results->sums[3] -= batch->bits[3];
    if (fault == ROUNDED_TO_INT)
        results->integers[HD_PROBE_INTEGER_to_fixed * batch->count + 5]++;
    return HD_OK;
}

static HdStatus fake_open(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                          HdError *failure) {
    (void)device, (void)options, (void)failure;
    *renderer = NULL;
    return HD_OK;
}

static void fake_close(void *renderer) {
    (void)renderer;
}

static const HdRendererFunctions functions = {
    .open = fake_open, .kernels = fake_kernels, .probe = fake_probe, .close = fake_close};
static const HdBackend backend = {.name = "fake", .functions = &functions};

static HdProbeReport probe(Fault of, HdPrecision precision) {
    const HdDevice device = {.backend = &backend, .name = "Fake", .has_double = true};
    const HdRenderOptions options = {.precision = precision};
    HdRenderer *renderer;
    HdProbeReport report;
    fault = of;
    setenv("HEDRON_CACHE", "off", 1);
    assert_int_equal(hd_renderer_open(&renderer, &device, &options, &error), HD_OK);
    kernels.shape = (HdKernelShape){.precision = precision, .lanes = 1, .group_size = 64};
    assert_int_equal(hd_probe(renderer, HD_PROBE_QUICK, &report, &error), HD_OK);
    hd_renderer_close(renderer);
    assert_int_equal(report.tuples, HD_PROBE_QUICK);
    assert_int_equal(report.found.rounds_by_fma, kernels.shape.rounds_by_fma);
    return report;
}

static const uint64_t hashes[] = {0x98b531570775fa8d, 0x9aa55f0c416093c4};

/* Plain C's results on every processor; they change only with the operands, on purpose. */
TEST(expectations_are_known) {
    for (int precision = 0; precision < 2; precision++) {
        const HdProbeReport report = probe(NONE, (HdPrecision)precision);
        assert_string_equal(report.found.difference, "");
        assert_false(report.found.rounds_by_fma);
        if (report.hash != hashes[precision])
            fail_msg("precision %d has the hash %016" PRIx64, precision, report.hash);
    }
}

/* Division alone may be replaced by fused operations. */
TEST(faults_are_reported_or_corrected) {
    static const struct {
        Fault fault;
        const char *primitive, *cause; /* NULL: none is reported */
    } list[] = {
        {OTHER_NAN, NULL, NULL},
        {DIVISION, NULL, NULL},
        {DIVISION_FOR_GOOD, "a / b of a = ", "(it is not correctly rounded)"},
        {DIVISION_AND_FAILS_BY_FMA, "a / b of a = ", " in float is "},
        {FLUSHED_RESULTS, "a * b of a = ", "(denormal numbers are flushed to 0)"},
        {FLUSHED_OPERANDS, "a * b of a = ", "(denormal "},
        {CONTRACTED, "a * b + c, rounded twice, of a = ",
         "(a product and a sum are contracted into one operation)"},
        {ZERO_WITHOUT_SIGN, "a + 0 of a = -0x0p+0", "is -0x0p+0, expected 0x0p+0"},
        {LOST_ADDITION, "the sum 3 that all threads add to atomically", "in 64 bits"},
        {ROUNDED_TO_INT,
         "(64-bit integer) of a, within 2^62, of a = 0x1.316p-137, b = -0x1.9cp-143, ",
         "x = 0xf7ffff8800000001 in float is 1, expected 0 (denormal operands count as 0)"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const HdProbeReport report = probe(list[i].fault, HD_PRECISION_FLOAT);
        if (list[i].primitive == NULL) {
            assert_string_equal(report.found.difference, "");
        } else {
            expect_contains(report.found.difference, list[i].primitive);
            expect_contains(report.found.difference, list[i].cause);
        }
        assert_int_equal(report.found.rounds_by_fma, list[i].fault == DIVISION);
        if (list[i].fault != LOST_ADDITION)
            assert_int_equal(report.hash != hashes[0], list[i].primitive != NULL);
    }
}
