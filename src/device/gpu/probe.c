/* SPDX-License-Identifier: MIT */
#include "device/gpu/probe.h"

#include "device/gpu/arguments.h"

HD_GPU_ARGUMENTS(Probe, add_probe, HD_PROBE_ARGUMENTS)

typedef struct Room {
    HdGpuMemory operands[3], bits, numbers, integers, sums, counters;
} Room;

static void release(const HdGpu *gpu, Room *room) {
    for (int i = 0; i < 3; i++)
        hd_gpu_release(gpu, &room->operands[i]);
    hd_gpu_release(gpu, &room->bits);
    hd_gpu_release(gpu, &room->numbers);
    hd_gpu_release(gpu, &room->integers);
    hd_gpu_release(gpu, &room->sums);
    hd_gpu_release(gpu, &room->counters);
}

static size_t number_bytes(const HdProbeBatch *batch) {
    size_t each = batch->precision == HD_PRECISION_DOUBLE ? sizeof(double) : sizeof(float);
    return each * (size_t)batch->count;
}

static HdStatus write(const HdGpu *gpu, Room *room, const HdProbeBatch *batch,
                      const HdProbeResults *results, HdError *error) {
    static const char what[] = "numbers of the probe";
    size_t numbers = number_bytes(batch), integers = sizeof(int64_t) * (size_t)batch->count;
    HdStatus status = HD_OK;
    for (int i = 0; status == HD_OK && i < 3; i++)
        status =
            hd_gpu_write_table(gpu, &room->operands[i], batch->operands[i], numbers, what, error);
    if (status == HD_OK)
        status = hd_gpu_write_table(gpu, &room->bits, batch->bits, integers, what, error);
    if (status == HD_OK)
        status =
            hd_gpu_write_table(gpu, &room->sums, results->sums, sizeof results->sums, what, error);
    if (status == HD_OK)
        status = hd_gpu_write_table(gpu, &room->counters, results->counters,
                                    sizeof results->counters, what, error);
    if (status == HD_OK)
        status = hd_gpu_reserve(gpu, &room->numbers, HD_GPU_DEVICE, HD_PROBE_NUMBER_COUNT * numbers,
                                what, error);
    if (status == HD_OK)
        status = hd_gpu_reserve(gpu, &room->integers, HD_GPU_DEVICE,
                                HD_PROBE_INTEGER_COUNT * integers, what, error);
    return status;
}

/* Few groups for each unit: the tuples are few. */
static HdStatus launch(const HdGpuProgram *program, const HdGpu *gpu, const Room *room,
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

static HdStatus read(const HdGpu *gpu, const Room *room, const HdProbeBatch *batch,
                     HdProbeResults *results, HdError *error) {
    const HdGpuDriver *driver = gpu->driver;
    size_t numbers = HD_PROBE_NUMBER_COUNT * number_bytes(batch);
    size_t integers = HD_PROBE_INTEGER_COUNT * sizeof(int64_t) * (size_t)batch->count;
    HdStatus status = driver->read(gpu->handle, &room->numbers, results->numbers, numbers, error);
    if (status == HD_OK)
        status = driver->read(gpu->handle, &room->integers, results->integers, integers, error);
    if (status == HD_OK)
        status = driver->read(gpu->handle, &room->sums, results->sums, sizeof results->sums, error);
    if (status == HD_OK)
        status = driver->read(gpu->handle, &room->counters, results->counters,
                              sizeof results->counters, error);
    return status;
}

HdStatus hd_gpu_run_probe(const HdGpuProgram *program, const HdGpu *gpu, const HdProbeBatch *batch,
                          HdProbeResults *results, HdError *error) {
    Room room = {0};
    HdError later;
    HdStatus status = write(gpu, &room, batch, results, error);
    if (status == HD_OK)
        status = launch(program, gpu, &room, batch, error);
    if (status == HD_OK)
        status = read(gpu, &room, batch, results, error);
    else
        gpu->driver->finish(gpu->handle, &later); /* copies may still read the operands */
    release(gpu, &room);
    return status;
}
