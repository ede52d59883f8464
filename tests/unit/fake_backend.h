/* SPDX-License-Identifier: MIT */
/* A backend for tests: plain C in place of a backend that compiles kernels at run time, with
   switchable faults. */
#ifndef HD_TEST_FAKE_BACKEND_H
#define HD_TEST_FAKE_BACKEND_H

#include <stdatomic.h>
#include <stdlib.h>

#include "device/kernel_cache.h"
#include "device/renderer.h"
#include "render/backends.h"
#include "unit_test.h"
#include "verify/probe_operands.h"

typedef enum FakePoint { FAKE_OPEN, FAKE_UPLOAD, FAKE_SUBMIT, FAKE_COLLECT } FakePoint;

static struct {
    bool is_missing;        /* open fails */
    bool fails;             /* rendering fails */
    bool renders_wrongly;   /* a bit of the picture's last number is wrong */
    bool is_right_in_waves; /* not by the wavefront */
    bool hides_binary;      /* refuses memory */
    bool adds_wrongly;      /* in every precision */
    bool divides_wrongly;   /* except by fused operations */
    const char *options;
    /* Reported tracing time of a frame; NULL: the real one. */
    double (*trace_seconds)(const HdRenderOptions *options);
    /* Returns whether opening fails; NULL: never. */
    bool (*refuses)(const HdRenderOptions *options);
    /* Called at each of these points, with the device's number, on the thread that reaches it; may
       wait, or make the device fail. NULL: nothing happens. */
    HdStatus (*event)(FakePoint point, int index, HdError *error);
    atomic_int opened, probed, compiled, loaded, rendered, dropped;
    /* Description of the kernels that were built last. */
    atomic_bool divides_by_fma;
    char key[HD_KERNEL_KEY_LENGTH];
} fake;

typedef struct FakeRenderer {
    void *c;
    HdKernelCache kernels;
    bool is_built;
    int index;
    HdRenderOptions options;
} FakeRenderer;

static HdStatus fake_event(FakePoint point, int index, HdError *error) {
    return fake.event != NULL ? fake.event(point, index, error) : HD_OK;
}

static HdStatus fake_open(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                          HdError *error) {
    fake.opened++;
    if (fake.is_missing)
        return hd_fail(error, HD_UNAVAILABLE, "it is missing");
    if (fake.refuses != NULL && fake.refuses(options))
        return hd_fail(error, HD_UNAVAILABLE, "it refuses");
    HdStatus status = fake_event(FAKE_OPEN, device->index, error);
    if (status != HD_OK)
        return status;
    FakeRenderer *opened = calloc(1, sizeof *opened);
    assert_non_null(opened);
    opened->index = device->index;
    opened->options = *options;
    hd_kernel_cache_begin(&opened->kernels, device->backend->name, device->name, device->driver);
    opened->kernels.shape =
        (HdKernelShape){.lanes = 1, .precision = options->precision, .math = options->math};
    *renderer = opened;
    HdRenderOptions of_c = *options;
    of_c.lanes = opened->kernels.shape.lanes;
    return hd_backend_c.functions->open(device, &of_c, &opened->c, error);
}

static unsigned char *fake_read(const void *context, size_t *size) {
    (void)context;
    unsigned char *binary = fake.hides_binary ? NULL : malloc(4);
    if (binary != NULL)
        memcpy(binary, "fake", 4);
    *size = 4;
    return binary;
}

static void fake_build(FakeRenderer *renderer) {
    static const char source[] = "text";
    unsigned char *binary;
    size_t size;
    const char *options = fake.options != NULL ? fake.options : "";
    renderer->is_built = true;
    fake.divides_by_fma = renderer->kernels.shape.rounds_by_fma;
    const bool is_found = hd_kernel_cache_find(&renderer->kernels, source, sizeof source, options,
                                               "1", &binary, &size);
    if (fake.event == NULL)
        memcpy(fake.key, renderer->kernels.key, sizeof fake.key);
    if (is_found) {
        assert_memory_equal(binary, "fake", 4);
        free(binary);
        fake.loaded++;
        return;
    }
    fake.compiled++;
    hd_kernel_cache_compiled(&renderer->kernels, fake_read, NULL, "nobody", 0.001);
}

static HdStatus fake_upload(void *state, const HdSceneTables *tables, HdError *error) {
    FakeRenderer *renderer = state;
    HdKernelNeeds needs = hd_kernel_needs(tables);
    if (!renderer->is_built || !hd_kernel_needs_equal(&needs, &renderer->kernels.shape.needs)) {
        renderer->kernels.shape.needs = needs;
        fake_build(renderer);
    }
    HdStatus status = fake_event(FAKE_UPLOAD, renderer->index, error);
    return status != HD_OK ? status : hd_backend_c.functions->upload(renderer->c, tables, error);
}

static HdStatus fake_submit(void *state, const HdFrameTables *tables, const HdFrameRequest *request,
                            HdError *error) {
    (void)tables, (void)request; /* plain C has no work yet */
    return fake_event(FAKE_SUBMIT, ((FakeRenderer *)state)->index, error);
}

static HdStatus fake_collect(void *state, const HdFrameTables *tables, HdFrame *frame,
                             HdError *error) {
    FakeRenderer *renderer = state;
    fake.rendered++;
    HdStatus status = fake_event(FAKE_COLLECT, renderer->index, error);
    if (status == HD_OK && fake.fails)
        status = hd_fail(error, HD_FAILED, "it fails");
    if (status == HD_OK)
        status = hd_backend_c.functions->collect(renderer->c, tables, frame, error);
    if (status != HD_OK)
        return status;
    if (fake.trace_seconds != NULL)
        frame->trace_seconds = fake.trace_seconds(&renderer->options);
    bool is_right = fake.is_right_in_waves && hd_pipeline_is_wavefront(renderer->options.pipeline);
    if (fake.renders_wrongly && !is_right)
        *(unsigned char *)&frame->rgb[frame->width * frame->height * 3 - 1] ^= 1;
    return HD_OK;
}

static void fake_drop(void *state) {
    (void)state;
    fake.dropped++;
}

static HdKernelCache *fake_kernels(void *state) {
    return &((FakeRenderer *)state)->kernels;
}

/* In float. */
static HdStatus fake_probe(void *state, const HdProbeBatch *batch, HdProbeResults *results,
                           HdError *error) {
    FakeRenderer *renderer = state;
    float *numbers = results->numbers;
    (void)error;
    fake.probed++;
    if (batch->precision == HD_PRECISION_DOUBLE)
        hd_probe_expect_double(batch, results);
    else
        hd_probe_expect_float(batch, results);
    if (fake.adds_wrongly)
        numbers[HD_PROBE_NUMBER_sum * batch->count + 7] = 0.125f;
    if (fake.divides_wrongly && !renderer->kernels.shape.rounds_by_fma)
        numbers[HD_PROBE_NUMBER_quotient * batch->count + 7] = 0.125f;
    return HD_OK;
}

static int fake_lanes(const void *state) {
    return ((const FakeRenderer *)state)->kernels.shape.lanes;
}

static void fake_describe(const void *renderer, char *text, int capacity) {
    (void)renderer, (void)capacity;
    text[0] = '\0';
}

static void fake_close(void *state) {
    FakeRenderer *renderer = state;
    hd_backend_c.functions->close(renderer->c);
    free(renderer);
}

static const HdRendererFunctions fake_functions = {
    .open = fake_open,
    .upload = fake_upload,
    .submit = fake_submit,
    .collect = fake_collect,
    .drop = fake_drop,
    .kernels = fake_kernels,
    .probe = fake_probe,
    .lanes = fake_lanes,
    .describe = fake_describe,
    .close = fake_close,
};

static const HdBackend fake_backend = {
    .name = "fake",
    .functions = &fake_functions,
};

static inline HdDevice fake_device(void) {
    return (HdDevice){
        .backend = &fake_backend, .name = "Fake 1000", .driver = "driver 7", .has_double = true};
}

#endif
