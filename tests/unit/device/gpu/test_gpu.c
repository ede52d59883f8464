/* SPDX-License-Identifier: MIT */
/* A GPU's memory, kernels and wavefront queue, of a GPU whose memory runs out and whose kernels are
   a letter. */
#define _XOPEN_SOURCE 700
#include "device/gpu/gpu.h"
#include "test_folder.h"

static HdError error;
static HdGpuProgram program;

static struct {
    size_t room;       /* bytes that may still be allocated */
    bool breaks;       /* allocating, loading and compiling fail, though memory is enough */
    int taken, living; /* memories */
    size_t most;       /* threads of a group that its kernels allow */
    bool has_kernels;
    int compiled;
} card;

/* ---- the driver ---- */

static HdStatus fake_allocate(void *of, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                              HdGpuRefusal *refusal, HdError *failure) {
    (void)of, (void)place;
    assert_null(memory->handle);
    if (card.breaks)
        return hd_fail(failure, HD_UNAVAILABLE, "it is broken");
    if (bytes > card.room) {
        *refusal = (HdGpuRefusal){true, "take", "NO_ROOM", true, (double)card.room};
        return HD_FAILED;
    }
    card.room -= bytes;
    card.taken++;
    card.living++;
    memory->data = memory->handle = malloc(bytes);
    memory->bytes = bytes;
    return HD_OK;
}

static void fake_release(void *of, HdGpuMemory *memory) {
    (void)of;
    card.room += memory->bytes;
    card.living--;
    free(memory->handle);
}

static HdStatus fake_write(void *of, const HdGpuMemory *memory, const void *data, size_t bytes,
                           HdGpuRefusal *refusal, HdError *failure) {
    (void)of, (void)refusal, (void)failure;
    assert_true(bytes > 0 && bytes <= memory->bytes);
    memcpy(memory->handle, data, bytes);
    return HD_OK;
}

static HdStatus fake_read(void *of, const HdGpuMemory *memory, void *to, size_t bytes,
                          HdError *failure) {
    (void)of, (void)failure;
    memcpy(to, memory->handle, bytes);
    return HD_OK;
}

static void fake_write_options(void *of, const HdKernelShape *shape, char *text, size_t capacity) {
    (void)of;
    snprintf(text, capacity, "planes %d probe %d", shape->needs.plane_bound, shape->is_probe);
}

static void fake_write_version(void *of, char *text, size_t capacity) {
    (void)of;
    snprintf(text, capacity, "1");
}

static HdStatus fake_compile(void *of, const HdKernelShape *shape, const char *options, char *maker,
                             size_t capacity, HdError *failure) {
    (void)of, (void)shape, (void)options;
    assert_false(card.has_kernels);
    card.compiled++;
    if (card.breaks)
        return hd_fail(failure, HD_UNAVAILABLE, "it is broken");
    snprintf(maker, capacity, "somebody");
    card.has_kernels = true;
    return HD_OK;
}

static HdStatus fake_load(void *of, const HdKernelShape *shape, const char *options,
                          const unsigned char *binary, size_t size, const char *maker,
                          HdError *failure) {
    (void)of, (void)shape, (void)options, (void)maker;
    assert_true(size == 1 && binary[0] == 'k');
    if (card.breaks)
        return hd_fail(failure, HD_FAILED, "it is too old");
    card.has_kernels = true;
    return HD_OK;
}

static unsigned char *fake_binary(const void *of, size_t *size) {
    (void)of;
    *size = 1;
    return (unsigned char *)strdup("k");
}

static void fake_unload(void *of) {
    (void)of;
    card.has_kernels = false;
}

static HdStatus fake_max_threads(void *of, size_t *threads, HdError *failure) {
    (void)of, (void)failure;
    *threads = card.most;
    return HD_OK;
}

static const size_t source_size = 4;

static const HdGpuDriver driver = {
    .groups = "blocks",
    .source = (const unsigned char *)"text",
    .source_size = &source_size,
    .allocate = fake_allocate,
    .release = fake_release,
    .write = fake_write,
    .read = fake_read,
    .write_options = fake_write_options,
    .write_version = fake_write_version,
    .compile = fake_compile,
    .load = fake_load,
    .binary = fake_binary,
    .unload = fake_unload,
    .max_threads = fake_max_threads,
};

static HdGpu gpu;

static int begin(void **unused) {
    (void)unused;
    memset(&card, 0, sizeof card);
    card.room = 10000000;
    card.most = 1024;
    gpu = (HdGpu){.driver = &driver, .name = "a GPU", .facts.memory = 3000000};
    setenv("HEDRON_CACHE", "off", 1);
    program =
        (HdGpuProgram){.cache = {.backend = "fake", .shape = {.lanes = 1, .group_size = 128}}};
    return 0;
}

/* ---- memory ---- */

static HdStatus reserve(HdGpuMemory *memory, HdGpuPlace place, size_t bytes) {
    return hd_gpu_reserve(&gpu, memory, place, bytes, "pixels", &error);
}

TEST(memory_is_kept_while_it_is_enough) {
    static const int bytes[] = {100, 100, 50, 2000}, taken[] = {1, 1, 1, 2};
    HdGpuMemory memory = {0};
    gpu.facts.at_once = 2000;
    for (int i = 0; i < 4; i++) {
        assert_int_equal(reserve(&memory, HD_GPU_DEVICE, (size_t)bytes[i]), HD_OK);
        assert_int_equal(card.taken, taken[i]);
        assert_int_equal(card.living, 1);
    }
    assert_int_equal(memory.bytes, 2000);
    assert_int_equal(reserve(&memory, HD_GPU_DEVICE, 2001), HD_UNAVAILABLE);
    assert_string_equal(
        error.message,
        "the pixels need 2.00 kB in one buffer; a GPU allows 2.00 kB of its 3.00 MB");
    hd_gpu_release(&gpu, &memory);
    hd_gpu_release(&gpu, &memory);
    assert_null(memory.handle);
    assert_int_equal(card.living, 0);
    /* An empty table fits. */
    assert_int_equal(hd_gpu_write_table(&gpu, &memory, NULL, 0, "lights", &error), HD_OK);
    assert_non_null(memory.handle);
    assert_int_equal(hd_gpu_write_table(&gpu, &memory, "solids", 6, "solids", &error), HD_OK);
    assert_memory_equal(memory.handle, "solids", 6);
    hd_gpu_release(&gpu, &memory);
}

TEST(a_lack_of_memory_is_reported) {
    HdGpuMemory memory = {0};
    card.room = 1000;
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
}

/* ---- the queue ---- */

static const HdWaveNeeds queue_needs = {.bytes = 4 * HD_WAVE_MIN_BYTES,
                                        .depth = 4,
                                        .grain = 32,
                                        .samples = 1 << 20,
                                        .samples_at_once = 32};

/* The queue of two workers; half of it is tried if memory is short. */
TEST(a_queue_is_cut_to_the_available_memory) {
    static const struct {
        size_t room;
        HdStatus status;
        size_t bytes;
    } cases[] = {{10000000, HD_OK, 4 * HD_WAVE_MIN_BYTES},
                 {5 * HD_WAVE_MIN_BYTES, HD_OK, 2 * HD_WAVE_MIN_BYTES},
                 {HD_WAVE_MIN_BYTES, HD_FAILED, HD_WAVE_MIN_BYTES}};
    for (int i = 0; i < 3; i++) {
        HdGpuWaveQueue queue = {0};
        HdWaveNeeds needs = queue_needs;
        card.room = cases[i].room;
        assert_int_equal(hd_gpu_wave_queue_reserve(&queue, &gpu, &needs, 2, &error),
                         cases[i].status);
        assert_int_equal(needs.bytes, cases[i].bytes);
        assert_int_equal(queue.is_cut, i > 0);
        assert_int_equal(queue.bytes, i > 0 ? cases[i].bytes : 0);
        for (int k = 0; cases[i].status == HD_OK && k < HD_WAVE_BUFFERS; k++)
            assert_int_equal(queue.buffers[k].bytes, queue.plan.bytes[k] * 2);
        hd_gpu_wave_queue_release(&queue, &gpu);
        assert_int_equal(card.living, 0);
    }
    expect_contains(error.message, "the rays of the queue need 2.");
}

TEST(a_queue_counts_from_0_and_reports_its_missing_memory) {
    HdGpuWaveQueue queue = {0};
    HdWaveNeeds needs = queue_needs;
    unsigned taken = 1;
    assert_int_equal(hd_gpu_wave_queue_empty(&queue, &gpu, &error), HD_OK);
    assert_int_equal(hd_gpu_wave_queue_read(&queue, &gpu, &taken, &error), HD_OK);
    assert_int_equal(taken, 0);
    hd_gpu_wave_queue_release(&queue, &gpu);
    assert_int_equal(card.living, 0);
    card.room = 0;
    assert_int_equal(hd_gpu_wave_queue_empty(&queue, &gpu, &error), HD_FAILED);
    expect_contains(error.message, "no room for the counter of the queue");
    card.breaks = true;
    assert_int_equal(hd_gpu_wave_queue_reserve(&queue, &gpu, &needs, 2, &error), HD_UNAVAILABLE);
    assert_string_equal(error.message, "it is broken");
}

/* ---- kernels ---- */

static HdStatus build(int planes) {
    const HdKernelNeeds needs = {.plane_bound = planes};
    return hd_gpu_build(&program, &gpu, &needs, &error);
}

static HdStatus build_probe(void) {
    return hd_gpu_build_probe(&program, &gpu, &error);
}

/* Expects so many kernels compiled in total. */
static void expect_compiled(HdStatus status, HdStatus expected, int compiled) {
    assert_int_equal(status, expected);
    assert_int_equal(card.compiled, compiled);
}

TEST(kernels_are_built_only_for_other_needs_or_the_probe) {
    expect_compiled(build(8), HD_OK, 1);
    expect_compiled(build(8), HD_OK, 1);
    expect_compiled(build(16), HD_OK, 2);
    assert_int_equal(program.cache.shape.needs.plane_bound, 16);
    expect_compiled(build_probe(), HD_OK, 3);
    expect_compiled(build_probe(), HD_OK, 3);
    assert_true(program.cache.shape.is_probe);
    program.cache.shape.rounds_by_fma = true;
    expect_compiled(build_probe(), HD_OK, 4);
    expect_compiled(build(16), HD_OK, 5);
    assert_false(program.cache.shape.is_probe);
}

TEST(groups_are_as_large_as_the_kernels_allow) {
    static const struct {
        size_t most;
        int group_size;
    } cases[] = {{1024, 128}, {128, 128}, {127, 64}, {1, 1}};
    for (int i = 0; i < 4; i++) {
        card.most = cases[i].most;
        assert_int_equal(build(8 << i), HD_OK);
        assert_int_equal(program.group_size, cases[i].group_size);
    }
    card.most = 64;
    assert_int_equal(build_probe(), HD_OK);
    assert_int_equal(program.group_size, 64);
    /* Threads that do not share items have none. */
    program.cache.shape.group_size = 0;
    program.group_size = program.block = 1;
    card.most = 0;
    assert_int_equal(build(8), HD_OK);
    assert_int_equal(program.group_size, 1);
}

TEST(requested_groups_are_not_made_smaller) {
    program.block = 128;
    card.most = 128;
    assert_int_equal(build(8), HD_OK);
    card.most = 127;
    assert_int_equal(build(16), HD_UNAVAILABLE);
    assert_string_equal(error.message,
                        "a GPU runs the kernel in blocks of at most 127 threads, not 128");
    assert_false(program.is_built || card.has_kernels);
    assert_int_equal(build_probe(), HD_UNAVAILABLE);
    assert_false(program.is_built || card.has_kernels);
}

TEST(failed_devices_are_tried_again) {
    card.breaks = true;
    expect_compiled(build(8), HD_UNAVAILABLE, 1);
    expect_compiled(build(8), HD_UNAVAILABLE, 2);
    expect_compiled(build_probe(), HD_UNAVAILABLE, 3);
    expect_compiled(build_probe(), HD_UNAVAILABLE, 4);
    card.breaks = false;
    assert_int_equal(build(8), HD_OK);
}

TEST(kernels_come_from_the_cache) {
    setenv("HEDRON_CACHE", "cache", 1);
    expect_compiled(build(8), HD_OK, 1);
    expect_contains(program.cache.note, "by somebody");
    hd_kernel_cache_accept(&program.cache);
    expect_compiled(build(16), HD_OK, 2); /* not accepted */
    program.is_built = false;
    expect_compiled(build(8), HD_OK, 2);
    assert_true(card.has_kernels);
    program.is_built = false;
    card.breaks = true;
    expect_compiled(build(8), HD_UNAVAILABLE, 3);
    expect_contains(program.cache.note, "the driver refused the cached kernels; it is too old");
}

EACH(begin, NULL)
