/* SPDX-License-Identifier: MIT */
/* Tests a device by this program, and reports the results. */
#ifndef HD_VERIFY_SELF_TEST_REPORT_H
#define HD_VERIFY_SELF_TEST_REPORT_H

#include "device/renderer.h"

typedef enum HdTestResult {
    HD_RESULT_RIGHT,   /* it computes correctly, possibly with division by fma */
    HD_RESULT_WRONG,   /* the report has the first difference */
    HD_RESULT_UNTESTED /* it is unusable or failed; the report has the reason */
} HdTestResult;

/* Names in a report, by HdTestResult. */
extern const char *const hd_test_result_names[];

typedef struct HdReportTest {
    char name[96]; /* "arithmetic in float" */
    int tuples;    /* tuples of operands; 0: a test of frames */
    int frames;    /* 0: a test of something else */
    bool by_fma;   /* division and roots are made of fma */
    uint64_t hash; /* of the results */
    HdTestResult result;
    char reason[2048]; /* reason for any result but HD_RESULT_RIGHT */
    double seconds;
} HdReportTest;

enum { HD_CERTIFICATE_TESTS = 16 };

typedef struct HdSelfTestReport {
    HdDevice device;
    char compiler[96]; /* compiler of its kernels; "" if unknown or built in */
    HdReportTest tests[HD_CERTIFICATE_TESTS];
    int test_count;
    HdTestResult result; /* of all tests: wrong if one is wrong, untested if one is untested or
                            there is none */
    double seconds;
    int64_t time; /* end of the test, in seconds since 1970 */
} HdSelfTestReport;

typedef enum HdTestEffort {
    HD_TEST_WHOLE, /* HD_PROBE_WHOLE tuples, all golden frames by both pipelines */
    HD_TEST_QUICK, /* HD_PROBE_QUICK tuples, small golden frames by the megakernel */
    HD_TEST_DEEP   /* the whole, and random scenes compared with plain C (random_scenes.h) */
} HdTestEffort;

/* Tests a device, ignoring remembered results, in float and, if it has it, in double: first the
   arithmetic probe of compiled kernels, then the golden frames. Remembers the arithmetic. Fails
   only with HD_INTERRUPTED; the report holds other failures. */
HdStatus hd_self_test(HdSelfTestReport *report, const HdDevice *device, HdTestEffort effort,
                      HdError *error);

#endif
