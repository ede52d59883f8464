/* SPDX-License-Identifier: MIT */
/* Renders on one NVIDIA device. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/cuda/compile.h"
#include "device/cuda/flight.h"
#include "device/cuda/memory.h"
#include "device/cuda/nvrtc.h"
#include "device/device_launch.h"
#include "device/kernel_cache.h"
#include "device/pipeline.h"
#include "device/wave_plan.h"
#include "kernels/host/shared.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "tables/room.h"

enum { BLOCK_THREADS = 128 };

typedef struct Renderer {
    HdCudaDriver driver;
    char name[256];
    HdCuDevice device;
    int arch;         /* 61 stands for sm_61 */
    int units;        /* multiprocessors */
    bool has_timeout; /* HdDevice.has_timeout */
    int launch_work;  /* of a launch; 0: by measurement */
    HdNvrtc nvrtc;    /* once kernels were compiled */
    HdKernelCache kernels;
    HdCudaCode code;     /* of the module */
    HdKernelShape shape; /* of the module, if there is one */
    HdCuContext context;
    HdCuModule module;
    HdCuFunction render, store; /* hd_kernel_tracing, hd_kernel_storing */
    HdCuFunction sum, encode;   /* hedron_sum_counts, hedron_encode */
    int registers, local_bytes; /* of `render` */
    HdCuStream stream;          /* of everything but the copies to the host */
    HdCudaMemory scene[HD_SCENE_TABLE_COUNT];
    HdCudaMemory frame[HD_FRAME_TABLE_COUNT];
    HdCudaMemory counts;
    HdCudaMemory thresholds; /* of `curve`, if there are any */
    HdCurve curve;
    HdCudaFlights flights;
    HdPipeline pipeline;
    int grid;           /* as asked for; 0: what suits the device */
    int depth;          /* of the scene */
    size_t queue_bytes; /* what the wavefront may use; 0: what suits the device */
    bool queue_is_cut;  /* the device refused more */
    HdWavePlan plan;
    HdCudaMemory queue_reals, queue_ints, queue_sums, queue_taken;
    HdCudaHostMemory taken; /* what the host reads of it */
} Renderer;

/* Calls a function of the driver: CALL(renderer, memory_free, cuMemFree, (pointer), error). */
#define CALL(renderer, member, function, arguments, error)                                         \
    hd_cuda_check(&(renderer)->driver, (renderer)->driver.member arguments, #function, error)

/* ---- devices ---- */

static HdStatus query(const HdCudaDriver *driver, HdCuDevice device, HdCuAttribute attribute,
                      int *value, HdError *error) {
    *value = 0;
    HdCuResult code = driver->device_attribute(value, attribute, device);
    if (code != HD_CU_SUCCESS)
        return hd_cuda_fail(driver, "cuDeviceGetAttribute", code, error);
    return HD_OK;
}

static HdStatus query_arch(const HdCudaDriver *driver, HdCuDevice device, int *arch,
                           HdError *error) {
    int minor;
    HdStatus status = query(driver, device, HD_CU_DEVICE_CAPABILITY_MAJOR, arch, error);
    if (status == HD_OK)
        status = query(driver, device, HD_CU_DEVICE_CAPABILITY_MINOR, &minor, error);
    if (status == HD_OK)
        *arch = 10 * *arch + minor;
    return status;
}

static HdStatus query_speed(const HdCudaDriver *driver, HdCuDevice handle, HdDevice *device,
                            HdError *error) {
    int khz;
    HdStatus status =
        query(driver, handle, HD_CU_DEVICE_MULTIPROCESSOR_COUNT, &device->compute_units, error);
    if (status == HD_OK)
        status = query(driver, handle, HD_CU_DEVICE_CLOCK_KHZ, &khz, error);
    if (status == HD_OK)
        device->clock_mhz = khz / 1000;
    return status;
}

static int query_driver_version(const HdCudaDriver *driver) {
    int version = 0;
    return driver->driver_version(&version) == HD_CU_SUCCESS ? version : 0;
}

static HdStatus query_device(HdDevice *device, const HdCudaDriver *driver, int index,
                             HdError *error) {
    HdCuDevice handle;
    HdCuResult code = driver->device_get(&handle, index);
    if (code != HD_CU_SUCCESS)
        return hd_cuda_fail(driver, "cuDeviceGet", code, error);
    code = driver->device_name(device->name, (int)sizeof device->name, handle);
    if (code != HD_CU_SUCCESS)
        return hd_cuda_fail(driver, "cuDeviceGetName", code, error);
    int arch;
    int version = query_driver_version(driver);
    HdStatus status = query_arch(driver, handle, &arch, error);
    int has_timeout = 0;
    if (status == HD_OK)
        status = query_speed(driver, handle, device, error);
    if (status == HD_OK)
        status = query(driver, handle, HD_CU_DEVICE_KERNEL_EXEC_TIMEOUT, &has_timeout, error);
    if (status != HD_OK)
        return status;
    device->nvidia_arch = arch;
    device->has_timeout = has_timeout != 0;
    snprintf(device->driver, sizeof device->driver, "sm_%d, driver for CUDA %d.%d", arch,
             version / 1000, version % 1000 / 10);
    /* Fails where there is no compiler, so that a choice among devices can pass it over. */
    return hd_nvrtc_check(device->name, arch, version / 1000, error);
}

/* A device that fails is listed with the reason; it does not hide the others. */
static void describe_device(HdDevice *device, const HdCudaDriver *driver, int index) {
    HdError error;
    memset(device, 0, sizeof *device);
    device->index = index;
    device->has_double = true;
    device->has_wide_atomics = true;
    snprintf(device->name, sizeof device->name, "CUDA device %d", index);
    if (query_device(device, driver, index, &error) != HD_OK)
        snprintf(device->unusable, sizeof device->unusable, "%.*s",
                 (int)sizeof device->unusable - 1, error.message);
}

static HdStatus count_devices(const HdCudaDriver *driver, int *count, HdError *error) {
    *count = 0;
    HdCuResult code = driver->device_count(count);
    if (code != HD_CU_SUCCESS)
        return hd_cuda_fail(driver, "cuDeviceGetCount", code, error);
    if (*count < 1)
        return hd_fail(error, HD_UNAVAILABLE, "the NVIDIA driver knows no device");
    return HD_OK;
}

static HdStatus cuda_enumerate(HdDevice *devices, int capacity, int *count, HdError *error) {
    HdCudaDriver driver;
    *count = 0;
    HdStatus status = hd_cuda_load_driver(&driver, error);
    int available = 0;
    if (status == HD_OK)
        status = count_devices(&driver, &available, error);
    if (status != HD_OK)
        return status;
    for (*count = 0; *count < available && *count < capacity; ++*count)
        describe_device(&devices[*count], &driver, *count);
    return HD_OK;
}

/* ---- open and close ---- */

static HdStatus open_device(Renderer *renderer, int index, HdError *error) {
    HdStatus status = hd_cuda_load_driver(&renderer->driver, error);
    if (status != HD_OK)
        return status;
    status = CALL(renderer, device_get, cuDeviceGet, (&renderer->device, index), error);
    if (status == HD_OK)
        status = query_arch(&renderer->driver, renderer->device, &renderer->arch, error);
    if (status == HD_OK)
        status = query(&renderer->driver, renderer->device, HD_CU_DEVICE_MULTIPROCESSOR_COUNT,
                       &renderer->units, error);
    return status;
}

/* The device's own context, which others in this process may share. Other threads may have made
   another one current, so every function of the backend pushes it and pops it again. */
static HdStatus retain_context(Renderer *renderer, HdError *error) {
    HdCuContext context = NULL;
    HdStatus status = CALL(renderer, context_retain, cuDevicePrimaryCtxRetain,
                           (&context, renderer->device), error);
    if (status == HD_OK)
        renderer->context = context;
    return status;
}

static HdStatus enter(const Renderer *renderer, HdError *error) {
    return CALL(renderer, context_push, cuCtxPushCurrent, (renderer->context), error);
}

static void leave(const Renderer *renderer) {
    HdCuContext popped;
    renderer->driver.context_pop(&popped);
}

static HdStatus create_streams(Renderer *renderer, HdError *error) {
    HdCudaOwner owner = {&renderer->driver, renderer->name};
    HdStatus status = enter(renderer, error);
    if (status != HD_OK)
        return status;
    status = hd_cuda_create_stream(&renderer->driver, &renderer->stream, error);
    if (status == HD_OK)
        status = hd_cuda_flights_open(&renderer->flights, &owner, error);
    leave(renderer);
    return status;
}

static void release(const Renderer *renderer, HdCudaMemory *memory) {
    HdCudaOwner owner = {&renderer->driver, renderer->name};
    hd_cuda_release(&owner, memory);
}

static void release_queue(Renderer *renderer) {
    release(renderer, &renderer->queue_reals);
    release(renderer, &renderer->queue_ints);
    release(renderer, &renderer->queue_sums);
}

static void unload_module(Renderer *renderer) {
    if (renderer->module)
        renderer->driver.module_unload(renderer->module);
    renderer->module = NULL;
}

static void release_all(Renderer *renderer) {
    HdCudaOwner owner = {&renderer->driver, renderer->name};
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        release(renderer, &renderer->scene[i]);
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        release(renderer, &renderer->frame[i]);
    release(renderer, &renderer->counts);
    release_queue(renderer);
    release(renderer, &renderer->queue_taken);
    release(renderer, &renderer->thresholds);
    hd_cuda_release_host(&owner, &renderer->taken);
    if (renderer->flights.owner.driver != NULL)
        hd_cuda_flights_close(&renderer->flights);
    unload_module(renderer);
    if (renderer->stream)
        renderer->driver.stream_destroy(renderer->stream);
}

static void cuda_close(void *state) {
    Renderer *renderer = state;
    if (renderer->context) {
        if (renderer->driver.context_push(renderer->context) == HD_CU_SUCCESS) {
            release_all(renderer);
            leave(renderer);
        }
        renderer->driver.context_release(renderer->device);
    }
    hd_nvrtc_close(&renderer->nvrtc);
    hd_cuda_code_free(&renderer->code);
    free(renderer);
}

static HdStatus cuda_open(const HdDevice *device, const HdRenderOptions *options, void **state,
                          HdError *error) {
    Renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a renderer");
    snprintf(renderer->name, sizeof renderer->name, "%s", device->name);
    hd_kernel_cache_begin(&renderer->kernels, device);
    renderer->shape = (HdKernelShape){
        .lanes = 1,
        .pixels_per_item = 1,
        .group_size = options->block > 0 ? options->block : BLOCK_THREADS,
        .wavefront = hd_pipeline_is_wavefront(options->pipeline),
        .precision = options->precision,
        .math = options->math,
    };
    renderer->pipeline = options->pipeline;
    renderer->grid = options->grid;
    renderer->queue_bytes = options->test.queue_bytes;
    renderer->launch_work = options->test.launch_work;
    renderer->has_timeout = device->has_timeout;
    HdStatus status = open_device(renderer, device->index, error);
    renderer->shape.register_limit =
        hd_register_limit(&renderer->shape, renderer->arch, options->registers);
    if (status == HD_OK)
        status = retain_context(renderer, error);
    if (status == HD_OK)
        status = create_streams(renderer, error);
    if (status != HD_OK) {
        cuda_close(renderer);
        return status;
    }
    *state = renderer;
    return HD_OK;
}

/* ---- memory ---- */

static HdStatus reserve(Renderer *renderer, HdCudaMemory *memory, size_t bytes, const char *what,
                        HdError *error) {
    return hd_cuda_reserve(&renderer->flights.owner, memory, bytes, what, error);
}

/* Copies in the order of the launches. Only from memory that the device reads by itself does the
   host not wait, and then `data` must live until the stream is through with it. */
static HdStatus copy(Renderer *renderer, const HdCudaMemory *memory, const void *data, size_t bytes,
                     HdError *error) {
    return CALL(renderer, copy_to_device_async, cuMemcpyHtoDAsync,
                (memory->pointer, data, bytes, renderer->stream), error);
}

/* An empty table needs a valid pointer too. */
static HdStatus copy_table(Renderer *renderer, HdCudaMemory *memory, const void *data, size_t bytes,
                           const char *what, HdError *error) {
    size_t room = bytes < HD_MIN_TABLE_BYTES ? HD_MIN_TABLE_BYTES : bytes;
    HdStatus status = reserve(renderer, memory, room, what, error);
    if (status != HD_OK || bytes == 0)
        return status;
    return copy(renderer, memory, data, bytes, error);
}

static HdStatus wait_for_stream(const Renderer *renderer, HdError *error) {
    return CALL(renderer, stream_synchronize, cuStreamSynchronize, (renderer->stream), error);
}

/* ---- upload ---- */

static HdStatus get_function(Renderer *renderer, HdCuFunction *function, const char *name,
                             HdError *error) {
    return CALL(renderer, module_function, cuModuleGetFunction, (function, renderer->module, name),
                error);
}

/* Threads share the registers of a multiprocessor. */
static HdStatus check_block(Renderer *renderer, HdError *error) {
    int most = 0;
    HdStatus status = CALL(renderer, function_attribute, cuFuncGetAttribute,
                           (&most, HD_CU_FUNCTION_MAX_THREADS, renderer->render), error);
    if (status == HD_OK && renderer->shape.group_size > most)
        status = hd_fail(error, HD_UNAVAILABLE,
                         "%s runs the kernel in blocks of at most %d threads, not %d",
                         renderer->name, most, renderer->shape.group_size);
    return status;
}

static HdStatus load_module(Renderer *renderer, HdError *error) {
    HdCuModule module = NULL;
    HdCuResult result = renderer->driver.module_load(&module, renderer->code.cubin);
    if (result != HD_CU_SUCCESS)
        return hd_fail(error, HD_FAILED,
                       "the driver, of CUDA %d, does not load what %s compiled for sm_%d "
                       "(cuModuleLoadData: %s)",
                       query_driver_version(&renderer->driver) / 1000, renderer->kernels.maker,
                       renderer->arch, hd_cuda_error_name(&renderer->driver, result));
    renderer->module = module;
    const char *tracing = hd_kernel_tracing(&renderer->shape);
    const char *storing = hd_kernel_storing(&renderer->shape);
    HdStatus status = get_function(renderer, &renderer->render, tracing, error);
    if (status == HD_OK && storing != NULL)
        status = get_function(renderer, &renderer->store, storing, error);
    if (status == HD_OK)
        status = get_function(renderer, &renderer->sum, "hedron_sum_counts", error);
    if (status == HD_OK)
        status = get_function(renderer, &renderer->encode, "hedron_encode", error);
    if (status == HD_OK)
        status = check_block(renderer, error);
    if (status == HD_OK)
        status = CALL(renderer, function_attribute, cuFuncGetAttribute,
                      (&renderer->registers, HD_CU_FUNCTION_REGISTERS, renderer->render), error);
    if (status == HD_OK)
        status =
            CALL(renderer, function_attribute, cuFuncGetAttribute,
                 (&renderer->local_bytes, HD_CU_FUNCTION_LOCAL_BYTES, renderer->render), error);
    if (status != HD_OK)
        unload_module(renderer);
    return status;
}

static HdStatus find_compiler(Renderer *renderer, HdError *error) {
    if (renderer->nvrtc.library)
        return HD_OK;
    int driver_major = query_driver_version(&renderer->driver) / 1000;
    return hd_nvrtc_open(&renderer->nvrtc, renderer->name, renderer->arch, driver_major, NULL,
                         error);
}

static HdStatus compile(Renderer *renderer, HdError *error) {
    char maker[32];
    double start = hd_monotonic_seconds();
    HdStatus status = find_compiler(renderer, error);
    if (status == HD_OK)
        status = hd_cuda_compile(&renderer->code, &renderer->nvrtc, renderer->arch,
                                 &renderer->shape, false, error);
    if (status != HD_OK)
        return status;
    snprintf(maker, sizeof maker, "NVRTC %d.%d", renderer->nvrtc.major, renderer->nvrtc.minor);
    hd_kernel_cache_compiled(&renderer->kernels, &renderer->shape, hd_cuda_read_code,
                             &renderer->code, maker, hd_monotonic_seconds() - start);
    return load_module(renderer, error);
}

/* True where the kernels were in the cache and the driver took them. */
static bool load_cached(Renderer *renderer, HdError *error) {
    if (!hd_cuda_find_cached(&renderer->code, &renderer->kernels, renderer->arch, &renderer->shape))
        return false;
    if (load_module(renderer, error) == HD_OK)
        return true;
    hd_kernel_cache_refuse(&renderer->kernels, error->message);
    hd_cuda_code_free(&renderer->code);
    return false;
}

static HdStatus build(Renderer *renderer, const HdKernelNeeds *needs, HdError *error) {
    HdKernelShape *shape = &renderer->shape;
    if (renderer->module && hd_kernel_needs_equal(&shape->needs, needs))
        return HD_OK;
    unload_module(renderer);
    hd_cuda_code_free(&renderer->code);
    hd_kernel_shape_set_needs(shape, needs);
    return load_cached(renderer, error) ? HD_OK : compile(renderer, error);
}

static HdStatus check_room(Renderer *renderer, const HdSceneTables *tables, HdError *error) {
    size_t available = 0, total = 0;
    HdStatus status = CALL(renderer, memory_info, cuMemGetInfo, (&available, &total), error);
    const HdRoom room = {.name = renderer->name, .advice = hd_room_advice, .memory = (double)total};
    return status == HD_OK ? hd_check_room(tables, &room, error) : status;
}

static HdStatus cuda_upload(void *state, const HdSceneTables *tables, HdError *error) {
    Renderer *renderer = state;
    HdKernelNeeds needs = hd_kernel_needs(tables);
    renderer->depth = tables->depth;
    const double longest = renderer->has_timeout ? HD_LAUNCH_SECONDS : HD_LAUNCH_SECONDS_FREE;
    renderer->flights.size = renderer->launch_work > 0
                                 ? hd_launch_size_fixed(renderer->launch_work)
                                 : hd_launch_size_start(renderer->units, longest);
    HdStatus status = enter(renderer, error);
    if (status != HD_OK)
        return status;
    status = check_room(renderer, tables, error);
    if (status == HD_OK)
        status = build(renderer, &needs, error);
    for (int i = 0; status == HD_OK && i < HD_SCENE_TABLE_COUNT; i++) {
        char what[64];
        snprintf(what, sizeof what, "scene's %s", hd_scene_table_content(i));
        status = copy_table(renderer, &renderer->scene[i], tables->table[i].data,
                            tables->table[i].bytes, what, error);
    }
    /* After a failure too: copies that are under way read the tables, which are the caller's. */
    HdError later;
    HdStatus finished = wait_for_stream(renderer, status == HD_OK ? error : &later);
    leave(renderer);
    return status == HD_OK ? finished : status;
}

/* ---- render ---- */

/* `count_slots` parts of the frame are counted one by one. */
static HdStatus prepare(Renderer *renderer, const HdCudaFlight *flight, const HdFrameTables *tables,
                        int count_slots, HdError *error) {
    HdStatus status = HD_OK;
    char *from = flight->tables.data;
    for (int i = 0; status == HD_OK && i < HD_FRAME_TABLE_COUNT; i++) {
        const HdTable *table = &tables->table[i];
        if (table->bytes > 0)
            memcpy(from, table->data, table->bytes);
        status = copy_table(renderer, &renderer->frame[i], from, table->bytes,
                            "tables of the frame", error);
        from += table->bytes;
    }
    if (status == HD_OK)
        status = reserve(renderer, &renderer->counts, sizeof(HdRayCounts) * (size_t)count_slots,
                         "counts of the work items", error);
    return status;
}

/* Takes memory for what the needs come to; where the device has too little left, for less. */
static HdStatus reserve_queue(Renderer *renderer, HdWaveNeeds *needs, HdError *error) {
    const HdCudaOwner *owner = &renderer->flights.owner;
    for (;;) {
        HdWavePlan plan = renderer->plan = hd_wave_plan(needs);
        size_t bytes = plan.real_bytes + plan.int_bytes + plan.sum_bytes;
        HdCuResult code = hd_cuda_try(owner, &renderer->queue_reals, plan.real_bytes);
        if (code == HD_CU_SUCCESS)
            code = hd_cuda_try(owner, &renderer->queue_ints, plan.int_bytes);
        if (code == HD_CU_SUCCESS)
            code = hd_cuda_try(owner, &renderer->queue_sums, plan.sum_bytes);
        if (code == HD_CU_SUCCESS)
            return HD_OK;
        release_queue(renderer);
        if (code != HD_CU_ERROR_OUT_OF_MEMORY || !hd_wave_halve(needs))
            return hd_cuda_refuse(owner, bytes, "rays of the queue", code, error);
        renderer->queue_bytes = needs->bytes;
        renderer->queue_is_cut = true;
    }
}

static HdStatus plan_waves(Renderer *renderer, int items, int samples_per_item, HdError *error) {
    HdStatus status = HD_OK;
    if (renderer->queue_bytes == 0) {
        size_t available, total = 0;
        status = CALL(renderer, memory_info, cuMemGetInfo, (&available, &total), error);
        renderer->queue_bytes = hd_wave_budget(total);
    }
    HdWaveNeeds needs = {
        .bytes = renderer->queue_bytes,
        .precision = renderer->shape.precision,
        .depth = renderer->depth,
        .grain = renderer->shape.group_size,
        .samples_at_once = samples_per_item,
        .samples = hd_wave_samples(items, samples_per_item),
    };
    return status == HD_OK ? reserve_queue(renderer, &needs, error) : status;
}

static HdStatus prepare_waves(Renderer *renderer, HdError *error) {
    static const unsigned none[HD_MIN_TABLE_BYTES / sizeof(unsigned)] = {0};
    HdStatus status =
        reserve(renderer, &renderer->queue_taken, sizeof none, "counter of the queue", error);
    if (status == HD_OK)
        status = hd_cuda_reserve_host(&renderer->flights.owner, &renderer->taken, sizeof none,
                                      "counter of the queue", error);
    if (status == HD_OK)
        status = copy(renderer, &renderer->queue_taken, none, sizeof none, error);
    return status;
}

static HdStatus launch_blocks(const Renderer *renderer, HdCuFunction function, int blocks,
                              void **arguments, HdError *error) {
    unsigned int threads = (unsigned int)renderer->shape.group_size;
    return CALL(
        renderer, launch, cuLaunchKernel,
        (function, (unsigned int)blocks, 1, 1, threads, 1, 1, 0, renderer->stream, arguments, NULL),
        error);
}

/* As many blocks as the items need, but no more than the grid may have. */
static HdStatus launch(const Renderer *renderer, HdCuFunction function, int items,
                       int items_per_block, void **arguments, HdError *error) {
    int blocks = (items + items_per_block - 1) / items_per_block;
    if (renderer->grid > 0 && blocks > renderer->grid)
        blocks = renderer->grid;
    return launch_blocks(renderer, function, blocks, arguments, error);
}

static HdStatus record(const Renderer *renderer, HdCuEvent event, HdError *error) {
    return CALL(renderer, event_record, cuEventRecord, (event, renderer->stream), error);
}

/* Call before a launch of so much work; the event `start` was recorded before the first one. */
static HdStatus begin_launch(const Renderer *renderer, HdCudaFlight *flight, bool is_first,
                             double work, HdError *error) {
    flight->began = is_first ? flight->start : flight->before;
    flight->work = work;
    return is_first ? HD_OK : record(renderer, flight->before, error);
}

/* Launches are queued one by one, so that a signal ends the frame between two of them, and so that
   each tells how large the next one may be. */
static HdStatus wait_between(Renderer *renderer, HdCudaFlight *flight, HdError *error) {
    HdStatus status = record(renderer, flight->between, error);
    if (status == HD_OK)
        status = CALL(renderer, event_synchronize, cuEventSynchronize, (flight->between), error);
    if (status == HD_OK)
        status = hd_cuda_flight_time_launch(&renderer->flights, flight, flight->between, error);
    if (status == HD_OK && hd_interrupt_signal() != 0)
        status = hd_fail(error, HD_INTERRUPTED, "interrupted in the midst of a frame");
    return status;
}

/* Fills in the tables; returns how many arguments these are. */
static int table_arguments(Renderer *renderer, void **arguments) {
    int n = 0;
    for (int i = 0; i < HD_SCENE_TABLE_COUNT; i++)
        arguments[n++] = &renderer->scene[i].pointer;
    for (int i = 0; i < HD_FRAME_TABLE_COUNT; i++)
        arguments[n++] = &renderer->frame[i].pointer;
    return n;
}

enum { MOST_ARGUMENTS = HD_SCENE_TABLE_COUNT + HD_FRAME_TABLE_COUNT + 16 };

static HdStatus launch_mega(Renderer *renderer, HdCudaFlight *flight, int items, HdError *error) {
    int block = renderer->shape.group_size;
    int first, count, samples = flight->samples, parts = hd_gpu_sample_parts(samples, block);
    const HdLaunchSize *size = &renderer->flights.size;
    void *arguments[MOST_ARGUMENTS];
    int n = table_arguments(renderer, arguments);
    arguments[n++] = &first;
    arguments[n++] = &count;
    arguments[n++] = &parts;
    arguments[n++] = &flight->pixels.pointer;
    arguments[n++] = &renderer->counts.pointer;
    HdStatus status = HD_OK;
    for (first = 0; status == HD_OK && first < items; first += count) {
        status = first > 0 ? wait_between(renderer, flight, error) : HD_OK;
        count = hd_launch_size_items(size, items - first, samples, block / parts);
        if (status == HD_OK)
            status = begin_launch(renderer, flight, first == 0, (double)count * samples, error);
        if (status == HD_OK)
            status = launch(renderer, renderer->render, count, block / parts, arguments, error);
    }
    return status;
}

typedef struct WaveLaunches {
    Renderer *renderer;
    HdCudaFlight *flight;
    int blocks; /* at most */
} WaveLaunches;

static HdStatus trace_step(void *context, const HdWaveStep *step, unsigned *taken, HdError *error) {
    const WaveLaunches *launches = context;
    Renderer *renderer = launches->renderer;
    int compact = renderer->pipeline == HD_PIPELINE_WAVEFRONT, is_first = step->is_first;
    HdWavePlan plan = renderer->plan;
    HdWaveStep own = *step;
    void *arguments[MOST_ARGUMENTS];
    int n = table_arguments(renderer, arguments);
    arguments[n++] = &renderer->queue_reals.pointer;
    arguments[n++] = &renderer->queue_ints.pointer;
    arguments[n++] = &renderer->queue_sums.pointer;
    arguments[n++] = &plan.queue_stride;
    arguments[n++] = &plan.sum_stride;
    arguments[n++] = &compact;
    arguments[n++] = &own.first_item;
    arguments[n++] = &own.level;
    arguments[n++] = &own.first;
    arguments[n++] = &own.count;
    arguments[n++] = &own.to;
    arguments[n++] = &own.taken_before;
    arguments[n++] = &is_first;
    arguments[n++] = &renderer->queue_taken.pointer;
    arguments[n++] = &renderer->counts.pointer;
    int block = renderer->shape.group_size;
    int blocks = (step->count + block - 1) / block;
    if (step->is_first || blocks > launches->blocks)
        blocks = launches->blocks;
    HdStatus status = begin_launch(renderer, launches->flight, step->is_first, step->count, error);
    if (status == HD_OK)
        status = launch_blocks(renderer, renderer->render, blocks, arguments, error);
    if (status == HD_OK)
        status = record(renderer, launches->flight->between, error);
    if (status == HD_OK)
        status = CALL(
            renderer, copy_to_host_async, cuMemcpyDtoHAsync,
            (renderer->taken.data, renderer->queue_taken.pointer, sizeof *taken, renderer->stream),
            error);
    if (status == HD_OK)
        status = wait_for_stream(renderer, error);
    if (status == HD_OK)
        status = hd_cuda_flight_time_launch(&renderer->flights, launches->flight,
                                            launches->flight->between, error);
    if (status == HD_OK)
        memcpy(taken, renderer->taken.data, sizeof *taken);
    return status;
}

static HdStatus store_batch(void *context, int first_item, int item_count, HdError *error) {
    const WaveLaunches *launches = context;
    Renderer *renderer = launches->renderer;
    HdWavePlan plan = renderer->plan;
    void *arguments[] = {&renderer->scene[HD_TABLE_header].pointer,
                         &renderer->frame[HD_TABLE_view].pointer,
                         &renderer->queue_sums.pointer,
                         &plan.sum_stride,
                         &first_item,
                         &item_count,
                         &launches->flight->pixels.pointer};
    return launch(renderer, renderer->store, item_count, renderer->shape.group_size, arguments,
                  error);
}

static HdStatus launch_waves(Renderer *renderer, HdCudaFlight *flight, int items, int blocks,
                             HdError *error) {
    WaveLaunches launches = {renderer, flight, blocks};
    HdWaveDevice device = {.context = &launches,
                           .trace = trace_step,
                           .store = store_batch,
                           .size = &renderer->flights.size};
    HdWaveFrame frame = {
        .items = items,
        .samples_per_item = flight->samples,
        .depth = renderer->depth,
        .grain = renderer->shape.group_size,
    };
    return hd_wave_run(&renderer->plan, &frame, &device, error);
}

static HdStatus launch_sum(Renderer *renderer, HdCudaFlight *flight, int count_slots,
                           HdError *error) {
    int workers = HD_SUM_WORKERS, block = renderer->shape.group_size;
    void *arguments[] = {&renderer->counts.pointer, &count_slots, &flight->sums.pointer, &workers};
    return launch_blocks(renderer, renderer->sum, (HD_SUM_WORKERS + block - 1) / block, arguments,
                         error);
}

static HdStatus trace(Renderer *renderer, HdCudaFlight *flight, int items, int count_slots,
                      HdError *error) {
    HdStatus status = record(renderer, flight->start, error);
    hd_launch_size_begin_frame(&renderer->flights.size);
    if (status == HD_OK)
        status = renderer->shape.wavefront
                     ? launch_waves(renderer, flight, items, count_slots, error)
                     : launch_mega(renderer, flight, items, error);
    if (status == HD_OK)
        status = launch_sum(renderer, flight, count_slots, error);
    return status == HD_OK ? record(renderer, flight->end, error) : status;
}

/* ---- 8 bits ---- */

static HdStatus copy_thresholds(Renderer *renderer, HdCurve curve, HdError *error) {
    int32_t thresholds[256];
    if (renderer->thresholds.pointer && renderer->curve == curve)
        return HD_OK;
    hd_curve_thresholds8(curve, thresholds);
    HdStatus status = reserve(renderer, &renderer->thresholds, sizeof thresholds,
                              "thresholds of the curve", error);
    if (status == HD_OK)
        status = copy(renderer, &renderer->thresholds, thresholds, sizeof thresholds, error);
    if (status == HD_OK)
        status = wait_for_stream(renderer, error);
    if (status != HD_OK)
        release(renderer, &renderer->thresholds);
    renderer->curve = curve;
    return status;
}

static HdStatus encode(Renderer *renderer, HdCudaFlight *flight, HdCurve curve, HdError *error) {
    int pixels = flight->width * flight->height;
    void *arguments[] = {&flight->pixels.pointer, &pixels, &renderer->thresholds.pointer,
                         &flight->image.pointer};
    HdStatus status = copy_thresholds(renderer, curve, error);
    if (status == HD_OK)
        status = launch(renderer, renderer->encode, pixels, renderer->shape.group_size, arguments,
                        error);
    return status;
}

/* ---- frames ---- */

/* Queues all that the frame needs, up to its copies. */
static HdStatus launch_frame(Renderer *renderer, HdCudaFlight *flight, const HdFrameTables *tables,
                             HdCurve curve, HdError *error) {
    int items =
        hd_kernel_item_count(tables->width, tables->height, renderer->shape.pixels_per_item);
    int samples = tables->samples, count_slots = items;
    HdStatus status = HD_OK;
    if (renderer->shape.wavefront) {
        status = plan_waves(renderer, items, samples, error);
        count_slots = hd_wave_groups(&renderer->plan, renderer->shape.group_size, renderer->grid);
        if (status == HD_OK)
            status = prepare_waves(renderer, error);
    }
    if (status == HD_OK)
        status = prepare(renderer, flight, tables, count_slots, error);
    if (status == HD_OK)
        status = trace(renderer, flight, items, count_slots, error);
    if (status == HD_OK && flight->encodes)
        status = encode(renderer, flight, curve, error);
    return status == HD_OK ? record(renderer, flight->ready, error) : status;
}

static HdStatus cuda_submit(void *state, const HdFrameTables *tables, const HdFrameWish *wish,
                            HdError *error) {
    Renderer *renderer = state;
    HdCudaFlight *flight;
    HdStatus status = enter(renderer, error);
    if (status != HD_OK)
        return status;
    status = hd_cuda_flight_begin(&renderer->flights, tables, !wish->radiance, &flight, error);
    if (status == HD_OK)
        status = launch_frame(renderer, flight, tables, wish->curve, error);
    if (status == HD_OK)
        status = hd_cuda_flight_send(&renderer->flights, flight, error);
    if (status != HD_OK) /* the next frame takes the flight's memory */
        renderer->driver.context_synchronize();
    leave(renderer);
    return status;
}

static HdStatus cuda_collect(void *state, HdFrame *frame, HdError *error) {
    Renderer *renderer = state;
    HdStatus status = enter(renderer, error);
    if (status != HD_OK)
        return status;
    status = hd_cuda_flight_collect(&renderer->flights, frame, error);
    leave(renderer);
    return status;
}

static double cuda_longest_launch(const void *state) {
    const Renderer *renderer = state;
    return renderer->flights.longest_launch;
}

static void cuda_drop(void *state) {
    Renderer *renderer = state;
    HdError ignored;
    if (enter(renderer, &ignored) != HD_OK)
        return;
    hd_cuda_flights_drop(&renderer->flights);
    leave(renderer);
}

static HdKernelCache *cuda_kernels(void *state) {
    Renderer *renderer = state;
    return &renderer->kernels;
}

static bool cuda_be_cautious(void *state) {
    Renderer *renderer = state;
    return hd_kernel_shape_be_cautious(&renderer->shape);
}

static void cuda_describe(const void *state, char *text, int capacity) {
    const Renderer *renderer = state;
    int length = snprintf(text, (size_t)capacity, "sm_%d, 1 lane of %s, blocks of %d threads, %s",
                          renderer->arch,
                          renderer->shape.precision == HD_PRECISION_DOUBLE ? "double" : "float",
                          renderer->shape.group_size, hd_pipeline_name(renderer->pipeline));
    if (renderer->module && length > 0 && length < capacity)
        length += snprintf(text + length, (size_t)(capacity - length),
                           ", %d registers and %d bytes of local memory a thread, %s",
                           renderer->registers, renderer->local_bytes, renderer->kernels.maker);
    if (renderer->queue_is_cut && length > 0 && length < capacity)
        hd_wave_tell_cut(renderer->queue_bytes, text + length, capacity - length);
}

const HdBackend hd_backend_cuda = {
    .name = "cuda",
    .enumerate = cuda_enumerate,
    .open = cuda_open,
    .upload = cuda_upload,
    .submit = cuda_submit,
    .collect = cuda_collect,
    .longest_launch = cuda_longest_launch,
    .drop = cuda_drop,
    .kernels = cuda_kernels,
    .be_cautious = cuda_be_cautious,
    .describe = cuda_describe,
    .close = cuda_close,
};
