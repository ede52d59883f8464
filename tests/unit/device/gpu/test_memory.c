/* SPDX-License-Identifier: MIT */
/* A GPU's memory, and a wavefront's queue in it. */
#include "device/gpu/memory.h"

#include "device/gpu/wave_queue.h"
#include "fake_gpu.h"

static HdError error;
static HdGpu gpu;

static int begin(void **state) {
    (void)state;
    memset(&gpu_state, 0, sizeof gpu_state);
    gpu_state.room = 10000000;
    gpu = fake_gpu;
    return 0;
}

static HdStatus reserve(HdGpuMemory *memory, HdGpuPlace place, size_t bytes) {
    return hd_gpu_reserve(&gpu, memory, place, bytes, "pixels", &error);
}

TEST(memory_is_kept_while_it_is_enough) {
    static const int bytes[] = {100, 100, 50, 101}, taken[] = {1, 1, 1, 2};
    HdGpuMemory memory = {0};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(reserve(&memory, HD_GPU_DEVICE, (size_t)bytes[i]), HD_OK);
        assert_int_equal(gpu_state.taken, taken[i]);
    }
    assert_int_equal(memory.bytes, 101);
    assert_int_equal(gpu_state.living, 1);
    hd_gpu_release(&gpu, &memory);
    hd_gpu_release(&gpu, &memory);
    assert_null(memory.handle);
    assert_int_equal(gpu_state.living, 0);
}

TEST(tables_are_written_and_empty_ones_have_room) {
    HdGpuMemory memory = {0};
    assert_int_equal(hd_gpu_write_table(&gpu, &memory, NULL, 0, "lights", &error), HD_OK);
    assert_non_null(memory.handle);
    assert_int_equal(hd_gpu_write_table(&gpu, &memory, "solids", 6, "solids", &error), HD_OK);
    assert_memory_equal(memory.handle, "solids", 6);
    hd_gpu_release(&gpu, &memory);
}

TEST(too_large_a_buffer_is_refused) {
    HdGpuMemory memory = {0};
    gpu.facts.at_once = 2000;
    assert_int_equal(reserve(&memory, HD_GPU_DEVICE, 2000), HD_OK);
    assert_int_equal(reserve(&memory, HD_GPU_DEVICE, 2001), HD_UNAVAILABLE);
    assert_string_equal(
        error.message,
        "the pixels need 2.00 kB in one buffer; a GPU allows 2.00 kB of its 3.00 MB");
    hd_gpu_release(&gpu, &memory);
}

TEST(a_lack_of_memory_is_told) {
    HdGpuMemory memory = {0};
    gpu_state.room = 1000;
    assert_int_equal(reserve(&memory, HD_GPU_DEVICE, 1001), HD_FAILED);
    expect_contains(error.message, "the pixels need 1.00 kB; a GPU has 1.00 kB free of its 3.00 MB "
                                   "(take: NO_ROOM); ");
    assert_int_equal(reserve(&memory, HD_GPU_HOST, 1001), HD_FAILED);
    assert_string_equal(error.message,
                        "the system has no room for the pixels, 1.00 kB that stay in "
                        "memory (take: NO_ROOM)");
    const HdGpuRefusal silent = {true, "take", "NO_ROOM", false, 0.0};
    hd_gpu_refuse(&gpu, HD_GPU_DEVICE, 5, "pixels", &silent, &error);
    expect_contains(error.message, "a GPU has too little free");
    gpu_state.breaks = true;
    assert_int_equal(reserve(&memory, HD_GPU_DEVICE, 10), HD_UNAVAILABLE);
    assert_string_equal(error.message, "it is broken");
}

/* ---- the queue ---- */

static const HdWaveNeeds queue_needs = {.bytes = 4 * HD_WAVE_LEAST_BYTES,
                                        .depth = 4,
                                        .grain = 32,
                                        .samples = 1 << 20,
                                        .samples_at_once = 32};

/* Of two workers; half of it is tried where there is no room. */
TEST(a_queue_is_cut_to_what_there_is) {
    static const struct {
        size_t room;
        HdStatus status;
        size_t bytes;
    } cases[] = {{10000000, HD_OK, 4 * HD_WAVE_LEAST_BYTES},
                 {5 * HD_WAVE_LEAST_BYTES, HD_OK, 2 * HD_WAVE_LEAST_BYTES},
                 {HD_WAVE_LEAST_BYTES, HD_FAILED, HD_WAVE_LEAST_BYTES}};
    for (int i = 0; i < 3; i++) {
        HdGpuWaveQueue queue = {0};
        HdWaveNeeds needs = queue_needs;
        gpu_state.room = cases[i].room;
        assert_int_equal(hd_gpu_wave_queue_reserve(&queue, &gpu, &needs, 2, &error),
                         cases[i].status);
        assert_int_equal(needs.bytes, cases[i].bytes);
        assert_int_equal(queue.is_cut, i > 0);
        assert_int_equal(queue.bytes, i > 0 ? cases[i].bytes : 0);
        for (int k = 0; cases[i].status == HD_OK && k < HD_WAVE_BUFFERS; k++)
            assert_int_equal(queue.buffers[k].bytes, queue.plan.bytes[k] * 2);
        hd_gpu_wave_queue_release(&queue, &gpu);
        assert_int_equal(gpu_state.living, 0);
    }
    expect_contains(error.message, "the rays of the queue need 2.");
}

TEST(a_queue_counts_from_0_and_tells_what_it_lacks) {
    HdGpuWaveQueue queue = {0};
    HdWaveNeeds needs = queue_needs;
    unsigned taken = 1;
    assert_int_equal(hd_gpu_wave_queue_empty(&queue, &gpu, &error), HD_OK);
    assert_int_equal(hd_gpu_wave_queue_read(&queue, &gpu, &taken, &error), HD_OK);
    assert_int_equal(taken, 0);
    hd_gpu_wave_queue_release(&queue, &gpu);
    assert_int_equal(gpu_state.living, 0);
    gpu_state.room = 0;
    assert_int_equal(hd_gpu_wave_queue_empty(&queue, &gpu, &error), HD_FAILED);
    expect_contains(error.message, "no room for the counter of the queue");
    gpu_state.breaks = true;
    assert_int_equal(hd_gpu_wave_queue_reserve(&queue, &gpu, &needs, 2, &error), HD_UNAVAILABLE);
    assert_string_equal(error.message, "it is broken");
}

EACH(begin, NULL)
