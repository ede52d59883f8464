/* SPDX-License-Identifier: MIT */
#include "device/gpu/gpu.h"

#include <stdlib.h>
#include <string.h>

#include "system/machine.h"

enum { OPTIONS_LENGTH = 1024, VERSION_LENGTH = HD_KERNEL_KEY_LENGTH, MAKER_LENGTH = 48 };

/* A kernel that needs many registers may allow only smaller groups. */
static HdStatus limit_group_size(HdGpuProgram *program, const HdGpu *gpu, HdError *error) {
    size_t most = 0;
    HD_TRY(gpu->driver->max_threads(gpu->handle, &most, error));
    if (program->cache.shape.group_size == 0)
        return HD_OK;
    program->group_size = program->cache.shape.group_size;
    if (program->block > 0 && (size_t)program->block > most)
        return hd_fail(error, HD_UNAVAILABLE,
                       "%s runs the kernel in %s of at most %zu threads, not %d", gpu->name,
                       gpu->driver->groups, most, program->block);
    while (program->group_size > 1 && (size_t)program->group_size > most)
        program->group_size /= 2;
    return HD_OK;
}

/* Returns whether the kernels were cached and the driver accepted them. */
static bool load_cached(HdGpuProgram *program, const HdGpu *gpu, const char *options,
                        HdError *error) {
    const HdGpuDriver *driver = gpu->driver;
    HdKernelCache *cache = &program->cache;
    char version[VERSION_LENGTH];
    unsigned char *binary;
    size_t size;
    driver->write_version(gpu->handle, version, sizeof version);
    if (!hd_kernel_cache_find(cache, driver->source, *driver->source_size, options, version,
                              &binary, &size))
        return false;
    bool is_loaded = driver->load(gpu->handle, &program->cache.shape, options, binary, size,
                                  cache->maker, error) == HD_OK;
    free(binary);
    if (!is_loaded) {
        hd_kernel_cache_refuse(cache, error->message);
        driver->unload(gpu->handle);
    }
    return is_loaded;
}

static HdStatus compile(HdGpuProgram *program, const HdGpu *gpu, const char *options,
                        HdError *error) {
    HdKernelCache *cache = &program->cache;
    char maker[MAKER_LENGTH] = "";
    double start = hd_monotonic_seconds();
    HD_TRY(gpu->driver->compile(gpu->handle, &cache->shape, options, maker, sizeof maker, error));
    if (!cache->shape.is_probe)
        hd_kernel_cache_compiled(cache, gpu->driver->binary, gpu->handle, maker,
                                 hd_monotonic_seconds() - start);
    return HD_OK;
}

/* Builds the kernels of the cache's shape, replacing others. */
static HdStatus build(HdGpuProgram *program, const HdGpu *gpu, HdError *error) {
    char options[OPTIONS_LENGTH];
    HdKernelShape *shape = &program->cache.shape;
    program->is_built = false;
    gpu->driver->unload(gpu->handle);
    if (program->nvidia_arch > 0)
        shape->register_limit = hd_register_limit(shape, program->nvidia_arch, program->registers);
    gpu->driver->write_options(gpu->handle, shape, options, sizeof options);
    HdStatus status = !shape->is_probe && load_cached(program, gpu, options, error)
                          ? HD_OK
                          : compile(program, gpu, options, error);
    if (status == HD_OK)
        status = limit_group_size(program, gpu, error);
    if (status != HD_OK)
        gpu->driver->unload(gpu->handle);
    program->is_built = status == HD_OK;
    return status;
}

HdStatus hd_gpu_build(HdGpuProgram *program, const HdGpu *gpu, const HdKernelNeeds *needs,
                      HdError *error) {
    HdKernelShape *shape = &program->cache.shape;
    if (program->is_built && !shape->is_probe && hd_kernel_needs_equal(&shape->needs, needs))
        return HD_OK;
    shape->is_probe = false;
    shape->needs = *needs;
    return build(program, gpu, error);
}

/* The probe does not depend on a scene's bounds. */
HdStatus hd_gpu_build_probe(HdGpuProgram *program, const HdGpu *gpu, HdError *error) {
    HdKernelShape *shape = &program->cache.shape;
    if (program->is_built && shape->is_probe && shape->rounds_by_fma == program->probes_by_fma)
        return HD_OK;
    shape->is_probe = true;
    shape->needs = (HdKernelNeeds){0};
    program->probes_by_fma = shape->rounds_by_fma;
    return build(program, gpu, error);
}

HD_GPU_ARGUMENTS(Probe, add_probe, HD_PROBE_ARGUMENTS)

enum { PARTS = 8 };

/* Few groups for each unit suffice for few tuples. */
static HdStatus launch_probe(const HdGpuProgram *program, const HdGpu *gpu,
                             const HdGpuMemory capacity[PARTS], int count, HdError *error) {
    enum { TUPLES_PER_THREAD = 4 };
    const Probe own = {.first = &capacity[0],
                       .second = &capacity[1],
                       .third = &capacity[2],
                       .bits = &capacity[3],
                       .count = count,
                       .numbers = &capacity[4],
                       .integers = &capacity[5],
                       .sums = &capacity[6],
                       .counters = &capacity[7]};
    HdGpuLaunch launch = {.kernel = HD_KERNEL_TRACE, .group_size = program->group_size};
    int per_group = TUPLES_PER_THREAD * program->cache.shape.lanes * program->group_size;
    launch.groups = (count + per_group - 1) / per_group;
    add_probe(&launch, &own);
    return gpu->driver->launch(gpu->handle, &launch, NULL, error);
}

HdStatus hd_gpu_run_probe(const HdGpuProgram *program, const HdGpu *gpu, const HdProbeBatch *batch,
                          HdProbeResults *results, HdError *error) {
    static const char what[] = "numbers of the probe";
    const size_t count = (size_t)batch->count, integers = sizeof(int64_t) * count;
    const size_t numbers =
        count * (batch->precision == HD_PRECISION_DOUBLE ? sizeof(double) : sizeof(float));
    const struct {
        const void *from; /* NULL: not written */
        void *to;         /* NULL: not read */
        size_t bytes;
    } parts[PARTS] = {
        {batch->operands[0], NULL, numbers},
        {batch->operands[1], NULL, numbers},
        {batch->operands[2], NULL, numbers},
        {batch->bits, NULL, integers},
        {NULL, results->numbers, HD_PROBE_NUMBER_COUNT * numbers},
        {NULL, results->integers, HD_PROBE_INTEGER_COUNT * integers},
        {results->sums, results->sums, sizeof results->sums},
        {results->counters, results->counters, sizeof results->counters},
    };
    HdGpuMemory capacity[PARTS] = {0};
    HdError later;
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < PARTS; i++)
        status =
            parts[i].from != NULL
                ? hd_gpu_write_table(gpu, &capacity[i], parts[i].from, parts[i].bytes, what, error)
                : hd_gpu_reserve(gpu, &capacity[i], HD_GPU_DEVICE, parts[i].bytes, what, error);
    if (status == HD_OK)
        status = launch_probe(program, gpu, capacity, batch->count, error);
    if (status != HD_OK)
        gpu->driver->finish(gpu->handle, &later); /* copies may still read the operands */
    for (int i = 0; status == HD_OK && i < PARTS; i++)
        if (parts[i].to != NULL)
            status =
                gpu->driver->read(gpu->handle, &capacity[i], parts[i].to, parts[i].bytes, error);
    for (int i = 0; i < PARTS; i++)
        hd_gpu_release(gpu, &capacity[i]);
    return status;
}
