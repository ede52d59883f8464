/* SPDX-License-Identifier: MIT */
/* Begin and end of every call, contexts, and reports of misuse. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fake.h"

enum { FIRST_FAILING = 3 };

struct CUctx_st {
    int retained;
    HdCuResult lost; /* the result of every later call */
};

static struct CUctx_st primary;
static _Thread_local bool is_current; /* the primary context, in this thread */
static pthread_mutex_t one_thread = PTHREAD_MUTEX_INITIALIZER;

double fake_number(const char *variable, double otherwise) {
    const char *value = getenv(variable);
    return value != NULL ? atof(value) : otherwise;
}

int fake_capability(void) {
    return (int)fake_number("FAKE_CUDA_CAPABILITY", 61.0);
}

/* Makes the file, to notify a test. */
static void hang(const char *event) {
    FILE *file = fopen(event, "w");
    if (file != NULL)
        fclose(file);
    for (;;)
        pause();
}

static bool is_to_fail(const char *function) {
    static int calls;
    const char *failing = getenv("FAKE_CUDA_FAILS"), *event = getenv("FAKE_CUDA_HANGS");
    bool is_time = failing != NULL && strcmp(failing, function) == 0 &&
                   ++calls >= (int)fake_number("FAKE_CUDA_FAILS_AT", FIRST_FAILING);
    if (is_time && event != NULL)
        hang(event);
    return is_time;
}

static HdCuResult check_context(const char *function) {
    if (!is_current)
        return fake_misuse(FAKE_INVALID_CONTEXT, "%s without a current context", function);
    if (primary.retained == 0)
        return fake_misuse(HD_CU_ERROR_CONTEXT_IS_DESTROYED, "%s in a context that is released",
                           function);
    return primary.lost;
}

HdCuResult fake_enter(const char *function, bool needs_context) {
    pthread_mutex_lock(&one_thread);
    if (is_to_fail(function))
        return (HdCuResult)fake_number("FAKE_CUDA_ERROR", HD_CU_ERROR_OUT_OF_MEMORY);
    return needs_context ? check_context(function) : HD_CU_SUCCESS;
}

void fake_leave(HdCuResult *entered) {
    (void)entered;
    pthread_mutex_unlock(&one_thread);
}

HdCuResult fake_misuse(HdCuResult code, const char *format, ...) {
    char text[512];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    fprintf(stderr, "fake driver: %s\n", text);
    return code;
}

void fake_lose(HdCuResult code, const char *what) {
    if (primary.lost == HD_CU_SUCCESS)
        primary.lost = fake_misuse(code, "%s", what);
}

HdCuResult fake_lost(void) {
    return primary.lost;
}

/* ---- contexts: there is one ---- */

HdCuResult cuDevicePrimaryCtxRetain(HdCuContext *context, HdCuDevice device) {
    FAKE_CALL_ANYWHERE(cuDevicePrimaryCtxRetain);
    if (device != 0)
        return fake_misuse(FAKE_INVALID_VALUE, "a context of device %d, of 1", device);
    primary.retained++;
    *context = &primary;
    return HD_CU_SUCCESS;
}

HdCuResult cuDevicePrimaryCtxRelease_v2(HdCuDevice device) {
    FAKE_CALL_ANYWHERE(cuDevicePrimaryCtxRelease);
    if (device != 0 || primary.retained == 0)
        return fake_misuse(FAKE_INVALID_CONTEXT,
                           "the program releases a context that it does not hold");
    primary.retained--;
    int left = fake_living_count() + fake_memory_count();
    if (primary.retained == 0 && left != 0 && primary.lost == HD_CU_SUCCESS)
        return fake_misuse(FAKE_INVALID_VALUE, "%d things were not freed", left);
    return HD_CU_SUCCESS;
}

HdCuResult cuCtxSetCurrent(HdCuContext context) {
    FAKE_CALL_ANYWHERE(cuCtxSetCurrent);
    if (context != &primary || primary.retained == 0)
        return fake_misuse(FAKE_INVALID_CONTEXT, "a context is made current that is none");
    is_current = true;
    return HD_CU_SUCCESS;
}
