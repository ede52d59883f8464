/* SPDX-License-Identifier: MIT */
#include "device/gpu/gpu.h"

#include <stdlib.h>
#include <string.h>

#include "system/machine.h"

enum { OPTIONS_LENGTH = 1024, VERSION_LENGTH = HD_KERNEL_KEY_LENGTH, MAKER_LENGTH = 48 };

/* By what the shape needs. */
static void limit_registers(const HdGpuProgram *program, HdKernelShape *shape) {
    if (program->nvidia_arch > 0)
        shape->register_limit = hd_register_limit(shape, program->nvidia_arch, program->registers);
}

/* A kernel that needs many registers may allow smaller groups only. */
static HdStatus limit_group_size(HdGpuProgram *program, const HdGpu *gpu, HdError *error) {
    size_t most = 0;
    HdStatus status = gpu->driver->most_threads(gpu->handle, &most, error);
    if (status != HD_OK || program->cache.shape.group_size == 0)
        return status;
    program->group_size = program->cache.shape.group_size;
    if (program->block > 0 && (size_t)program->block > most)
        return hd_fail(error, HD_UNAVAILABLE,
                       "%s runs the kernel in %s of at most %zu threads, not %d", gpu->name,
                       gpu->driver->groups, most, program->block);
    while (program->group_size > 1 && (size_t)program->group_size > most)
        program->group_size /= 2;
    return HD_OK;
}

/* True where the kernels were in the cache and the driver took them. */
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
    char maker[MAKER_LENGTH] = "";
    double start = hd_monotonic_seconds();
    HdStatus status = gpu->driver->compile(gpu->handle, &program->cache.shape, options, maker,
                                           sizeof maker, error);
    if (status == HD_OK)
        hd_kernel_cache_compiled(&program->cache, gpu->driver->binary, gpu->handle, maker,
                                 hd_monotonic_seconds() - start);
    return status;
}

HdStatus hd_gpu_build(HdGpuProgram *program, const HdGpu *gpu, const HdKernelNeeds *needs,
                      HdError *error) {
    char options[OPTIONS_LENGTH];
    HdKernelShape *shape = &program->cache.shape;
    if (program->is_built && !shape->is_probe && hd_kernel_needs_equal(&shape->needs, needs))
        return HD_OK;
    program->is_built = false;
    shape->is_probe = false;
    gpu->driver->unload(gpu->handle);
    shape->needs = *needs;
    limit_registers(program, shape);
    gpu->driver->write_options(gpu->handle, shape, options, sizeof options);
    HdStatus status =
        load_cached(program, gpu, options, error) ? HD_OK : compile(program, gpu, options, error);
    if (status == HD_OK)
        status = limit_group_size(program, gpu, error);
    if (status != HD_OK)
        gpu->driver->unload(gpu->handle);
    program->is_built = status == HD_OK;
    return status;
}

/* The bounds of a scene are nothing to the probe. */
static HdKernelShape probe_shape(const HdGpuProgram *program) {
    HdKernelShape shape = program->cache.shape;
    shape.needs = (HdKernelNeeds){0};
    shape.is_probe = true;
    limit_registers(program, &shape);
    return shape;
}

HdStatus hd_gpu_build_probe(HdGpuProgram *program, const HdGpu *gpu, HdError *error) {
    const HdGpuDriver *driver = gpu->driver;
    char options[OPTIONS_LENGTH], maker[MAKER_LENGTH];
    HdKernelShape *shape = &program->cache.shape;
    if (program->is_built && shape->is_probe && shape->rounds_by_fma == program->probes_by_fma)
        return HD_OK;
    program->is_built = false;
    driver->unload(gpu->handle);
    *shape = probe_shape(program);
    driver->write_options(gpu->handle, shape, options, sizeof options);
    HdStatus status = driver->compile(gpu->handle, shape, options, maker, sizeof maker, error);
    if (status == HD_OK)
        status = limit_group_size(program, gpu, error);
    if (status != HD_OK)
        driver->unload(gpu->handle);
    program->is_built = status == HD_OK;
    program->probes_by_fma = shape->rounds_by_fma;
    return status;
}

void hd_gpu_probe_key(const HdGpuProgram *program, const HdGpu *gpu, char *text, size_t capacity) {
    const HdGpuDriver *driver = gpu->driver;
    const HdKernelShape shape = probe_shape(program);
    char options[OPTIONS_LENGTH], version[VERSION_LENGTH];
    driver->write_options(gpu->handle, &shape, options, sizeof options);
    driver->write_version(gpu->handle, version, sizeof version);
    hd_kernel_cache_key(&program->cache, driver->source, *driver->source_size, options, version,
                        text, capacity);
}

/* ---- the arithmetic probe ---- */

HD_GPU_ARGUMENTS(Probe, add_probe, HD_PROBE_ARGUMENTS)

enum { OPERANDS = 3 };

/* What the kernel reads, then what it writes. */
typedef struct Room {
    HdGpuMemory operands[OPERANDS], bits, numbers, integers, sums, counters;
} Room;

typedef struct Part {
    HdGpuMemory *memory;
    const void *from; /* NULL: nothing is written */
    void *to;         /* NULL: nothing is read */
    size_t bytes;
} Part;

enum { PARTS = OPERANDS + 5 };

static void list_parts(Room *room, const HdProbeBatch *batch, HdProbeResults *results,
                       Part parts[PARTS]) {
    const size_t count = (size_t)batch->count, integers = sizeof(int64_t) * count;
    const size_t numbers =
        count * (batch->precision == HD_PRECISION_DOUBLE ? sizeof(double) : sizeof(float));
    const Part others[PARTS - OPERANDS] = {
        {&room->bits, batch->bits, NULL, integers},
        {&room->numbers, NULL, results->numbers, HD_PROBE_NUMBER_COUNT * numbers},
        {&room->integers, NULL, results->integers, HD_PROBE_INTEGER_COUNT * integers},
        {&room->sums, results->sums, results->sums, sizeof results->sums},
        {&room->counters, results->counters, results->counters, sizeof results->counters},
    };
    for (int i = 0; i < OPERANDS; i++)
        parts[i] = (Part){&room->operands[i], batch->operands[i], NULL, numbers};
    memcpy(parts + OPERANDS, others, sizeof others);
}

/* Few groups for each unit: the tuples are few. */
static HdStatus launch_probe(const HdGpuProgram *program, const HdGpu *gpu, const Room *room,
                             const HdProbeBatch *batch, HdError *error) {
    enum { TUPLES_PER_THREAD = 4 };
    const HdKernelShape *shape = &program->cache.shape;
    const Probe own = {.first = &room->operands[0],
                       .second = &room->operands[1],
                       .third = &room->operands[2],
                       .bits = &room->bits,
                       .count = batch->count,
                       .numbers = &room->numbers,
                       .integers = &room->integers,
                       .sums = &room->sums,
                       .counters = &room->counters};
    HdGpuLaunch launch = {.kernel = HD_KERNEL_TRACE, .group_size = program->group_size};
    int per_group = TUPLES_PER_THREAD * shape->lanes * program->group_size;
    launch.groups = (batch->count + per_group - 1) / per_group;
    add_probe(&launch, &own);
    return gpu->driver->launch(gpu->handle, &launch, NULL, error);
}

HdStatus hd_gpu_run_probe(const HdGpuProgram *program, const HdGpu *gpu, const HdProbeBatch *batch,
                          HdProbeResults *results, HdError *error) {
    static const char what[] = "numbers of the probe";
    const HdGpuDriver *driver = gpu->driver;
    Room room = {0};
    Part parts[PARTS];
    HdError later;
    HdStatus status = HD_OK;
    list_parts(&room, batch, results, parts);
    for (const Part *part = parts; status == HD_OK && part < parts + PARTS; part++)
        status = part->from != NULL
                     ? hd_gpu_write_table(gpu, part->memory, part->from, part->bytes, what, error)
                     : hd_gpu_reserve(gpu, part->memory, HD_GPU_DEVICE, part->bytes, what, error);
    if (status == HD_OK)
        status = launch_probe(program, gpu, &room, batch, error);
    if (status != HD_OK)
        driver->finish(gpu->handle, &later); /* copies may still read the operands */
    for (const Part *part = parts; status == HD_OK && part < parts + PARTS; part++)
        if (part->to != NULL)
            status = driver->read(gpu->handle, part->memory, part->to, part->bytes, error);
    for (int i = 0; i < PARTS; i++)
        hd_gpu_release(gpu, parts[i].memory);
    return status;
}
