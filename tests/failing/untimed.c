/* SPDX-License-Identifier: MIT */
/* Preloaded before the OpenCL library, a GPU whose queues have no profiling: the driver's devices
   are GPUs, each work item takes UNTIMED_NS nanoseconds, and the clock, by which the host alone can
   tell, only goes on while it waits for them. At its end the program appends to the file
   UNTIMED_REPORT how many launches there were and how many of them took more than UNTIMED_LONGEST
   milliseconds. */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "real.h"

#pragma GCC diagnostic ignored "-Wdeprecated-declarations" /* what 1.2 had is what is used */

enum { MARKS = 8 };

/* When everything queued before an event will be over. */
typedef struct Mark {
    cl_event event;
    uint64_t end;
} Mark;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static uint64_t now = 1, end = 1; /* nanoseconds */
static Mark marks[MARKS];
static int newest, launches, too_long;

#define REAL(name, parameters)                                                                     \
    cl_int(*real) parameters;                                                                      \
    find_real(#name, &real)

static void wait_until(uint64_t time) {
    pthread_mutex_lock(&lock);
    now = time > now ? time : now;
    pthread_mutex_unlock(&lock);
}

/* The kernel is asked: a look for the function behind this one would take the loader's lock, whose
   owner may wait for a sanitizer's allocator that wants the time. */
int clock_gettime(clockid_t clock, struct timespec *time) {
    if (clock != CLOCK_MONOTONIC)
        return (int)syscall(SYS_clock_gettime, clock, time);
    pthread_mutex_lock(&lock);
    *time = (struct timespec){.tv_sec = (time_t)(now / 1000000000),
                              .tv_nsec = (long)(now % 1000000000)};
    pthread_mutex_unlock(&lock);
    return 0;
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t capacity, void *value,
                       size_t *size) {
    REAL(clGetDeviceInfo, (cl_device_id, cl_device_info, size_t, void *, size_t *));
    cl_int code = real(device, what, capacity, value, size);
    const cl_device_type gpu = CL_DEVICE_TYPE_GPU;
    if (code == CL_SUCCESS && what == CL_DEVICE_TYPE && value != NULL)
        memcpy(value, &gpu, sizeof gpu);
    return code;
}

cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                      cl_command_queue_properties properties, cl_int *code) {
    cl_command_queue (*real)(cl_context, cl_device_id, cl_command_queue_properties, cl_int *);
    find_real("clCreateCommandQueue", &real);
    if ((properties & CL_QUEUE_PROFILING_ENABLE) == 0)
        return real(context, device, properties, code);
    *code = CL_INVALID_QUEUE_PROPERTIES;
    return NULL;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *global, const size_t *local,
                              cl_uint count, const cl_event *waits, cl_event *event) {
    REAL(clEnqueueNDRangeKernel,
         (cl_command_queue, cl_kernel, cl_uint, const size_t *, const size_t *, const size_t *,
          cl_uint, const cl_event *, cl_event *));
    uint64_t length = (uint64_t)number_of("UNTIMED_NS", 0) * global[0];
    pthread_mutex_lock(&lock);
    end = (end > now ? end : now) + length;
    launches++;
    too_long += length > 1000000 * (uint64_t)number_of("UNTIMED_LONGEST", 0);
    pthread_mutex_unlock(&lock);
    return real(queue, kernel, dimensions, offset, global, local, count, waits, event);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                           size_t bytes, void *to, cl_uint count, const cl_event *waits,
                           cl_event *event) {
    REAL(clEnqueueReadBuffer, (cl_command_queue, cl_mem, cl_bool, size_t, size_t, void *, cl_uint,
                               const cl_event *, cl_event *));
    cl_int code = real(queue, buffer, blocking, offset, bytes, to, count, waits, event);
    pthread_mutex_lock(&lock);
    if (event != NULL)
        marks[newest++ % MARKS] = (Mark){*event, end};
    uint64_t over = blocking ? end : now;
    pthread_mutex_unlock(&lock);
    wait_until(over);
    return code;
}

cl_int clWaitForEvents(cl_uint count, const cl_event *events) {
    REAL(clWaitForEvents, (cl_uint, const cl_event *));
    cl_int code = real(count, events);
    uint64_t over = 0;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < MARKS; i++)
        if (marks[i].event == events[0] && marks[i].end > over)
            over = marks[i].end;
    pthread_mutex_unlock(&lock);
    wait_until(over);
    return code;
}

cl_int clFinish(cl_command_queue queue) {
    REAL(clFinish, (cl_command_queue));
    cl_int code = real(queue);
    pthread_mutex_lock(&lock);
    uint64_t over = end;
    pthread_mutex_unlock(&lock);
    wait_until(over);
    return code;
}

__attribute__((destructor)) static void report(void) {
    const char *path = getenv("UNTIMED_REPORT");
    FILE *file = path != NULL && launches > 0 ? fopen(path, "a") : NULL;
    if (file == NULL)
        return;
    fprintf(file, "%d %d\n", launches, too_long);
    fclose(file);
}
