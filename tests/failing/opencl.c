/* SPDX-License-Identifier: MIT */
/* A driver that fails, preloaded before the OpenCL library. FAILING_OPENCL is the name of a
   function, FAILING_OPENCL_AT the number of its first call that fails, from 1. FAILING_OPENCL_TIMES
   is how many of them fail, by default all from there, and FAILING_OPENCL_CODE their error.
   FAILING_OPENCL_HANGS, if set, is a file that is made before the call waits for ever.
   FAILING_OPENCL_TEXT is a text that the compiler mistakes for FAILING_OPENCL_FOR, everywhere in a
   program. FAILING_OPENCL_NAME is the name of each device. With FAILING_OPENCL_LIES the driver
   claims a hundred devices too many, and texts of all the memory that there is, which it then
   writes to.

   With FAILING_OPENCL_NS the devices are GPUs whose queues have no profiling, and each work item
   takes so many nanoseconds. The clock advances only while the host waits for the queue, to the end
   of its work. At its end the program appends to the file FAILING_OPENCL_REPORT the number of
   launches and the number of those that took more than 50 ms. */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "real.h"

#pragma GCC diagnostic ignored "-Wdeprecated-declarations" /* hedron uses the functions of 1.2 */

static atomic_int calls, launches, too_long;
static atomic_long now = 1, over = 1; /* nanoseconds */

/* The kernel provides other clocks: the thread that asks the time may hold the loader's lock. */
int clock_gettime(clockid_t clock, struct timespec *time) {
    if (clock != CLOCK_MONOTONIC || getenv("FAILING_OPENCL_NS") == NULL)
        return (int)syscall(SYS_clock_gettime, clock, time);
    *time = (struct timespec){now / 1000000000, now % 1000000000};
    return 0;
}

__attribute__((destructor)) static void report(void) {
    const char *name = getenv("FAILING_OPENCL_REPORT");
    int file = name != NULL && launches > 0 ? open(name, O_WRONLY | O_CREAT | O_APPEND, 0666) : -1;
    if (file >= 0 && dprintf(file, "%d %d\n", launches, too_long) > 0)
        close(file);
}

/* Returns the call's error, or CL_SUCCESS. */
static cl_int failure_of(const char *function) {
    const char *failing = getenv("FAILING_OPENCL"), *mark = getenv("FAILING_OPENCL_HANGS");
    if (failing == NULL || strcmp(failing, function) != 0)
        return CL_SUCCESS;
    long past = atomic_fetch_add(&calls, 1) + 1 - number_of("FAILING_OPENCL_AT", 1);
    if (past < 0 || past >= number_of("FAILING_OPENCL_TIMES", INT_MAX))
        return CL_SUCCESS;
    if (mark != NULL) {
        close(open(mark, O_CREAT | O_WRONLY | O_CLOEXEC, 0666));
        for (;;)
            pause();
    }
    return (cl_int)number_of("FAILING_OPENCL_CODE", CL_OUT_OF_RESOURCES);
}

/* Calls that return a code, and calls that return a handle and the code by their last argument. */
#define CODED(name, parameters, arguments)                                                         \
    cl_int name parameters {                                                                       \
        cl_int(*real) parameters;                                                                  \
        cl_int failure = failure_of(#name);                                                        \
        find_real(#name, &real);                                                                   \
        return failure != CL_SUCCESS ? failure : real arguments;                                   \
    }
/* Calls that wait do so even then: nobody may use memory that a copy still reads. */
#define WAITING(name, parameters, arguments)                                                       \
    cl_int name parameters {                                                                       \
        cl_int(*real) parameters;                                                                  \
        cl_int failure = failure_of(#name);                                                        \
        find_real(#name, &real);                                                                   \
        cl_int code = real arguments;                                                              \
        now = over;                                                                                \
        return failure != CL_SUCCESS ? failure : code;                                             \
    }
#define MADE(type, name, parameters, arguments)                                                    \
    type name parameters {                                                                         \
        type(*real) parameters;                                                                    \
        cl_int failure = failure_of(#name);                                                        \
        find_real(#name, &real);                                                                   \
        if (failure == CL_SUCCESS)                                                                 \
            return real arguments;                                                                 \
        if (code != NULL)                                                                          \
            *code = failure;                                                                       \
        return NULL;                                                                               \
    }

/* No queue has these without profiling. */
static cl_command_queue_properties offered(cl_command_queue_properties wanted) {
    return getenv("FAILING_OPENCL_NS") != NULL && wanted != 0 ? ~(cl_command_queue_properties)0
                                                              : wanted;
}

static cl_command_queue queued(cl_command_queue queue, size_t items) {
    long length = number_of("FAILING_OPENCL_NS", 0) * (long)items;
    over = (over > now ? over : now) + length;
    launches++;
    too_long += length > 50000000;
    return queue;
}

typedef void(CL_CALLBACK *OnContext)(const char *, const void *, size_t, void *);
typedef void(CL_CALLBACK *OnProgram)(cl_program, void *);

CODED(clGetPlatformIDs, (cl_uint capacity, cl_platform_id *list, cl_uint *count),
      (capacity, list, count))

cl_int clGetDeviceIDs(cl_platform_id platform, cl_device_type type, cl_uint capacity,
                      cl_device_id *list, cl_uint *count) {
    cl_int (*real)(cl_platform_id, cl_device_type, cl_uint, cl_device_id *, cl_uint *);
    cl_int failure = failure_of("clGetDeviceIDs");
    find_real("clGetDeviceIDs", &real);
    cl_int code = failure != CL_SUCCESS ? failure : real(platform, type, capacity, list, count);
    if (code == CL_SUCCESS && count != NULL && getenv("FAILING_OPENCL_LIES") != NULL)
        *count += 100;
    return code;
}

/* Answers with a text, as the function below. */
static cl_int answer(const char *text, size_t room, void *value, size_t *size) {
    const bool lies = getenv("FAILING_OPENCL_LIES") != NULL;
    if (value != NULL && lies && room > strlen(text) + 1)
        memset(value, 'x', room);
    else if (value != NULL)
        memcpy(value, text, strlen(text) + 1);
    if (size != NULL)
        *size = lies ? SIZE_MAX : strlen(text) + 1;
    return CL_SUCCESS;
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t room, void *value,
                       size_t *size) {
    cl_int (*real)(cl_device_id, cl_device_info, size_t, void *, size_t *);
    const char *name = getenv("FAILING_OPENCL_NAME");
    find_real("clGetDeviceInfo", &real);
    if (name != NULL && what == CL_DEVICE_NAME)
        return answer(name, room, value, size);
    cl_int code = real(device, what, room, value, size);
    if (getenv("FAILING_OPENCL_NS") != NULL && what == CL_DEVICE_TYPE && value != NULL)
        *(cl_device_type *)value = CL_DEVICE_TYPE_GPU;
    return code;
}

MADE(cl_context, clCreateContext,
     (const cl_context_properties *properties, cl_uint count, const cl_device_id *devices,
      OnContext notify, void *user, cl_int *code),
     (properties, count, devices, notify, user, code))
MADE(cl_command_queue, clCreateCommandQueue,
     (cl_context context, cl_device_id device, cl_command_queue_properties properties,
      cl_int *code),
     (context, device, offered(properties), code))

/* Returns a copy with every `from` replaced; the caller frees it. */
static char *replaced(const char *text, const char *from, const char *by) {
    size_t room = strlen(text) + 1;
    for (const char *at = text; (at = strstr(at, from)) != NULL; at += strlen(from))
        room += strlen(by);
    char *whole = calloc(room, 1), *end = whole;
    for (const char *at = text; whole != NULL && *at != '\0';) {
        bool is_met = strncmp(at, from, strlen(from)) == 0;
        size_t length = is_met ? strlen(by) : 1;
        memcpy(end, is_met ? by : at, length);
        end += length;
        at += is_met ? strlen(from) : 1;
    }
    return whole;
}

/* Hedron's programs are one text each. */
cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char **texts,
                                     const size_t *lengths, cl_int *code) {
    cl_program (*real)(cl_context, cl_uint, const char **, const size_t *, cl_int *);
    const char *from = getenv("FAILING_OPENCL_TEXT"), *by = getenv("FAILING_OPENCL_FOR");
    find_real("clCreateProgramWithSource", &real);
    if (from == NULL || by == NULL)
        return real(context, count, texts, lengths, code);
    char *text = replaced(texts[0], from, by);
    const char *changed[] = {text};
    cl_program program = real(context, 1, changed, NULL, code);
    free(text);
    return program;
}

CODED(clBuildProgram,
      (cl_program program, cl_uint count, const cl_device_id *devices, const char *options,
       OnProgram notify, void *user),
      (program, count, devices, options, notify, user))
MADE(cl_kernel, clCreateKernel, (cl_program program, const char *name, cl_int *code),
     (program, name, code))
MADE(cl_mem, clCreateBuffer,
     (cl_context context, cl_mem_flags flags, size_t bytes, void *host, cl_int *code),
     (context, flags, bytes, host, code))
CODED(clSetKernelArg, (cl_kernel kernel, cl_uint index, size_t bytes, const void *value),
      (kernel, index, bytes, value))
CODED(clEnqueueWriteBuffer,
      (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t bytes,
       const void *from, cl_uint count, const cl_event *waits, cl_event *event),
      (queue, buffer, blocking, offset, bytes, from, count, waits, event))
CODED(clEnqueueReadBuffer,
      (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t bytes,
       void *to, cl_uint count, const cl_event *waits, cl_event *event),
      (queue, buffer, blocking, offset, bytes, to, count, waits, event))
MADE(void *, clEnqueueMapBuffer,
     (cl_command_queue queue, cl_mem buffer, cl_bool blocking, cl_map_flags flags, size_t offset,
      size_t bytes, cl_uint count, const cl_event *waits, cl_event *event, cl_int *code),
     (queue, buffer, blocking, flags, offset, bytes, count, waits, event, code))
CODED(clEnqueueNDRangeKernel,
      (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
       const size_t *global, const size_t *local, cl_uint count, const cl_event *waits,
       cl_event *event),
      (queued(queue, global[0]), kernel, dimensions, offset, global, local, count, waits, event))
WAITING(clWaitForEvents, (cl_uint count, const cl_event *events), (count, events))
CODED(clFlush, (cl_command_queue queue), (queue))
WAITING(clFinish, (cl_command_queue queue), (queue))
