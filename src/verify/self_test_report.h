/* SPDX-License-Identifier: MIT */
/* What was tested of a device by this program, and what came of it. */
#ifndef HD_VERIFY_SELF_TEST_REPORT_H
#define HD_VERIFY_SELF_TEST_REPORT_H

#include "device/renderer.h"

typedef enum HdTestResult {
    HD_RESULT_RIGHT,   /* it computes rightly, if need be with division by fma */
    HD_RESULT_WRONG,   /* the first difference is told */
    HD_RESULT_UNTESTED /* it cannot be used, or failed; the reason is told */
} HdTestResult;

/* As in a certificate, by HdTestResult. */
extern const char *const hd_test_result_names[];

typedef struct HdReportTest {
    char name[96]; /* "arithmetic in float" */
    int tuples;    /* of operands; 0: it renders frames */
    int frames;    /* 0: it tests something else */
    bool by_fma;   /* division and roots are made of fma */
    uint64_t hash; /* of the results */
    HdTestResult result;
    char reason[2048]; /* of any other than HD_RESULT_RIGHT */
    double seconds;
} HdReportTest;

enum { HD_CERTIFICATE_TESTS = 16 };

typedef struct HdSelfTestReport {
    HdDevice device;
    char compiler[96]; /* of its kernels; "" where the driver does not tell or they are built in */
    HdReportTest tests[HD_CERTIFICATE_TESTS];
    int test_count;
    HdTestResult result; /* of all: wrong where one is, untested where one is or there is none */
    double seconds;
    int64_t time; /* of its end, in seconds since 1970 */
} HdSelfTestReport;

typedef enum HdTestEffort {
    HD_TEST_WHOLE, /* HD_PROBE_WHOLE tuples, all golden frames by both pipelines */
    HD_TEST_QUICK, /* HD_PROBE_QUICK tuples, small golden frames by the megakernel */
    HD_TEST_DEEP   /* the whole, and random scenes beside plain C (random_scenes.h) */
} HdTestEffort;

/* Tests a device, whatever is remembered of it, in float and, where it has it, in double: the
   arithmetic probe of kernels that are compiled, then the golden frames. What is found of the
   arithmetic is remembered. Fails with HD_INTERRUPTED only; other failures are a part of the
   certificate. */
HdStatus hd_certify(HdSelfTestReport *report, const HdDevice *device, HdTestEffort effort,
                    HdError *error);

#endif
