/* SPDX-License-Identifier: MIT */
/* Streams and events. Queued operations run as late as possible: when somebody waits for them. So
   memory that is reused too early, and a missing wait, become visible. Time passes only while
   kernels run: their real time, or FAKE_CUDA_THREAD_NS nanoseconds for each of their threads. With
   FAKE_CUDA_SKIPS they do nothing, in no time. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/hash.h"
#include "fake.h"

enum { MAX_OPERATIONS = 4096 };

struct CUstream_st {
    unsigned int flags;
};

struct CUevent_st {
    unsigned int flags;
    bool was_recorded; /* and maybe the record was not run yet */
    bool is_reached;   /* it was */
    double time;       /* ms, then */
};

typedef struct Operation {
    enum { COPY_TO_DEVICE, COPY_TO_HOST, LAUNCH, RECORD, WAIT } kind;
    HdCuStream stream;
    bool done;
    HdCuPointer device; /* COPY_* */
    void *host;
    void *staged;  /* the bytes of memory that the host may change */
    uint64_t hash; /* the bytes that it may not */
    size_t bytes;
    FakeLaunch launch; /* LAUNCH */
    HdCuEvent event;   /* RECORD, WAIT */
} Operation;

static double now; /* ms */
static Operation queue[MAX_OPERATIONS];
static int queued;

/* ---- running ---- */

static double seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void run_launch(const FakeLaunch *launch) {
    double start = seconds();
    if (getenv("FAKE_CUDA_SKIPS") != NULL)
        return;
    fake_run_launch(launch);
    double reported = fake_number("FAKE_CUDA_THREAD_NS", -1.0);
    double threads = (double)launch->blocks.x * (double)launch->threads.x;
    now += reported >= 0.0 ? 1e-6 * reported * threads : 1e3 * (seconds() - start);
}

static uint64_t hash_of(const void *data, size_t bytes) {
    return hd_hash_words(HD_HASH_START, data, bytes, 1);
}

static void copy_to_device(const Operation *copy) {
    void *to = fake_memory(copy->device, copy->bytes);
    const void *from = copy->staged != NULL ? copy->staged : copy->host;
    if (to == NULL || (copy->staged == NULL && !fake_is_pinned(from, copy->bytes)))
        fake_lose(HD_CU_ERROR_ILLEGAL_ADDRESS, "memory was freed before it was copied");
    else if (copy->staged == NULL && hash_of(from, copy->bytes) != copy->hash)
        fake_lose(HD_CU_ERROR_ILLEGAL_ADDRESS, "memory was changed before it was copied");
    else
        memcpy(to, from, copy->bytes);
}

static void copy_to_host(const Operation *copy) {
    const void *from = fake_memory(copy->device, copy->bytes);
    if (from == NULL || !fake_is_pinned(copy->host, copy->bytes))
        fake_lose(HD_CU_ERROR_ILLEGAL_ADDRESS, "memory was freed before it was copied");
    else
        memcpy(copy->host, from, copy->bytes);
}

static void carry_out(Operation *operation);

/* Runs a stream up to and including operation number `last`. */
static void run_stream(const struct CUstream_st *stream, int last) {
    for (int i = 0; i <= last; i++)
        if (queue[i].stream == stream && !queue[i].done)
            carry_out(&queue[i]);
}

/* Runs up to the event's last record before operation number `before`. */
static void run_to_event(const struct CUevent_st *event, int before) {
    for (int i = before - 1; i >= 0; i--)
        if (queue[i].kind == RECORD && queue[i].event == event) {
            run_stream(queue[i].stream, i);
            return;
        }
}

/* Runs an operation; after the context is lost nothing happens any more. */
static void carry_out(Operation *operation) {
    operation->done = true;
    if (operation->kind == WAIT)
        run_to_event(operation->event, (int)(operation - queue));
    if (fake_lost() != HD_CU_SUCCESS) {
        /* it stays unchanged */
    } else if (operation->kind == COPY_TO_DEVICE) {
        copy_to_device(operation);
    } else if (operation->kind == COPY_TO_HOST) {
        copy_to_host(operation);
    } else if (operation->kind == LAUNCH) {
        run_launch(&operation->launch);
    } else if (operation->kind == RECORD) {
        operation->event->time = now;
        operation->event->is_reached = true;
    }
    free(operation->staged);
    free(operation->launch.arguments);
}

void fake_expect_idle(void) {
    bool is_idle = true;
    for (int i = 0; i < queued; i++)
        is_idle = is_idle && queue[i].done;
    if (!is_idle)
        fake_misuse(HD_CU_SUCCESS, "something was freed that may be in use");
}

static void run_all(void) {
    for (int i = 0; i < queued; i++)
        if (!queue[i].done)
            carry_out(&queue[i]);
}

/* ---- queueing ---- */

static void forget_done(void) {
    int kept = 0;
    for (int i = 0; i < queued; i++)
        if (!queue[i].done)
            queue[kept++] = queue[i];
    queued = kept;
}

static HdCuResult put(Operation operation) {
    forget_done();
    if (queued == MAX_OPERATIONS)
        return fake_misuse(HD_CU_ERROR_OUT_OF_MEMORY, "the program never waits for queued work");
    queue[queued++] = operation;
    return fake_lost();
}

static HdCuResult check_stream(HdCuStream stream) {
    if (fake_lives(FAKE_STREAM, stream))
        return HD_CU_SUCCESS;
    return fake_misuse(FAKE_INVALID_HANDLE, "a stream is used that is not there");
}

static HdCuResult check_event(HdCuEvent event, bool must_be_recorded) {
    if (!fake_lives(FAKE_EVENT, event))
        return fake_misuse(FAKE_INVALID_HANDLE, "an event is used that is not there");
    if (must_be_recorded && !event->was_recorded)
        return fake_misuse(FAKE_INVALID_HANDLE, "an event is used that was never recorded");
    return HD_CU_SUCCESS;
}

static HdCuResult check_copy(HdCuPointer device, const void *host, size_t bytes,
                             HdCuStream stream) {
    if (bytes == 0 || host == NULL || fake_memory(device, bytes) == NULL)
        return fake_misuse(FAKE_INVALID_VALUE, "a copy of %zu bytes exceeds the allocation", bytes);
    return check_stream(stream);
}

HdCuResult fake_queue_launch(HdCuStream stream, FakeLaunch launch) {
    HdCuResult code = check_stream(stream);
    if (code == HD_CU_SUCCESS)
        return put((Operation){.kind = LAUNCH, .stream = stream, .launch = launch});
    free(launch.arguments);
    return code;
}

/* Memory that the driver did not allocate is read before the call returns. */
HdCuResult cuMemcpyHtoDAsync_v2(HdCuPointer to, const void *from, size_t bytes, HdCuStream stream) {
    FAKE_CALL(cuMemcpyHtoDAsync);
    HdCuResult code = check_copy(to, from, bytes, stream);
    if (code != HD_CU_SUCCESS)
        return code;
    Operation copy = {.kind = COPY_TO_DEVICE,
                      .stream = stream,
                      .device = to,
                      .host = (void *)from,
                      .bytes = bytes};
    if (fake_is_pinned(from, bytes)) {
        copy.hash = hash_of(from, bytes);
        return put(copy);
    }
    copy.staged = malloc(bytes);
    if (copy.staged == NULL)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    memcpy(copy.staged, from, bytes);
    return put(copy);
}

/* Memory that the driver did not allocate is filled before the call returns. */
HdCuResult cuMemcpyDtoHAsync_v2(void *to, HdCuPointer from, size_t bytes, HdCuStream stream) {
    FAKE_CALL(cuMemcpyDtoHAsync);
    HdCuResult code = check_copy(from, to, bytes, stream);
    if (code != HD_CU_SUCCESS)
        return code;
    if (fake_is_pinned(to, bytes))
        return put((Operation){
            .kind = COPY_TO_HOST, .stream = stream, .device = from, .host = to, .bytes = bytes});
    run_stream(stream, queued - 1);
    memcpy(to, fake_memory(from, bytes), bytes);
    return fake_lost();
}

/* ---- streams ---- */

HdCuResult cuStreamCreate(HdCuStream *stream, unsigned int flags) {
    FAKE_CALL(cuStreamCreate);
    if (flags != HD_CU_STREAM_NON_BLOCKING)
        return fake_misuse(FAKE_INVALID_VALUE, "a stream that waits for others");
    *stream = fake_create(FAKE_STREAM, sizeof **stream);
    return *stream != NULL ? HD_CU_SUCCESS : HD_CU_ERROR_OUT_OF_MEMORY;
}

HdCuResult cuStreamDestroy_v2(HdCuStream stream) {
    FAKE_CALL(cuStreamDestroy);
    fake_expect_idle();
    HdCuResult code = check_stream(stream);
    fake_forget(FAKE_STREAM, stream);
    return code;
}

HdCuResult cuStreamSynchronize(HdCuStream stream) {
    FAKE_CALL(cuStreamSynchronize);
    HdCuResult code = check_stream(stream);
    if (code != HD_CU_SUCCESS)
        return code;
    run_stream(stream, queued - 1);
    return fake_lost();
}

HdCuResult cuStreamWaitEvent(HdCuStream stream, HdCuEvent event, unsigned int flags) {
    FAKE_CALL(cuStreamWaitEvent);
    HdCuResult code = flags == 0 ? check_stream(stream) : FAKE_INVALID_VALUE;
    if (code == HD_CU_SUCCESS)
        code = check_event(event, true);
    if (code == HD_CU_SUCCESS)
        code = put((Operation){.kind = WAIT, .stream = stream, .event = event});
    return code;
}

HdCuResult cuCtxSynchronize(void) {
    FAKE_CALL(cuCtxSynchronize);
    run_all();
    return fake_lost();
}

/* ---- events ---- */

HdCuResult cuEventCreate(HdCuEvent *event, unsigned int flags) {
    FAKE_CALL(cuEventCreate);
    *event = fake_create(FAKE_EVENT, sizeof **event);
    if (*event == NULL)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    (*event)->flags = flags;
    return HD_CU_SUCCESS;
}

HdCuResult cuEventDestroy_v2(HdCuEvent event) {
    FAKE_CALL(cuEventDestroy);
    fake_expect_idle();
    HdCuResult code = check_event(event, false);
    fake_forget(FAKE_EVENT, event);
    return code;
}

HdCuResult cuEventRecord(HdCuEvent event, HdCuStream stream) {
    FAKE_CALL(cuEventRecord);
    HdCuResult code = check_event(event, false);
    if (code == HD_CU_SUCCESS)
        code = check_stream(stream);
    if (code != HD_CU_SUCCESS)
        return code;
    event->was_recorded = true;
    event->is_reached = false;
    return put((Operation){.kind = RECORD, .stream = stream, .event = event});
}

HdCuResult cuEventSynchronize(HdCuEvent event) {
    FAKE_CALL(cuEventSynchronize);
    HdCuResult code = check_event(event, true);
    if (code != HD_CU_SUCCESS)
        return code;
    run_to_event(event, queued);
    return fake_lost();
}

/* An operation takes a millisecond even if no time passed. */
HdCuResult cuEventElapsedTime(float *milliseconds, HdCuEvent start, HdCuEvent end) {
    FAKE_CALL(cuEventElapsedTime);
    HdCuResult code = check_event(start, true);
    if (code == HD_CU_SUCCESS)
        code = check_event(end, true);
    if (code != HD_CU_SUCCESS)
        return code;
    if (((start->flags | end->flags) & HD_CU_EVENT_DISABLE_TIMING) != 0)
        return fake_misuse(FAKE_INVALID_HANDLE, "an event is asked for a time that it has not");
    if (!start->is_reached || !end->is_reached)
        return fake_misuse(FAKE_NOT_READY, "an event is asked for its time before it is reached");
    double passed = end->time - start->time;
    *milliseconds = passed > 0.0 ? (float)passed : 1.0F;
    return HD_CU_SUCCESS;
}
