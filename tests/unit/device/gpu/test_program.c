/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "device/gpu/program.h"

#include "device/kernel_cache.h"
#include "fake_gpu.h"
#include "test_folder.h"

static HdError error;
static HdGpuProgram program;

static int begin(void **state) {
    (void)state;
    memset(&gpu_state, 0, sizeof gpu_state);
    gpu_state.most = 1024;
    setenv("HEDRON_CACHE", "off", 1);
    program =
        (HdGpuProgram){.cache = {.backend = "fake", .shape = {.lanes = 1, .group_size = 128}}};
    return 0;
}

static HdStatus build(int planes) {
    const HdKernelNeeds needs = {.plane_bound = planes};
    return hd_gpu_build(&program, &fake_gpu, &needs, &error);
}

static HdStatus build_probe(void) {
    return hd_gpu_build_probe(&program, &fake_gpu, &error);
}

/* All in all so many kernels are compiled then. */
static void expect_compiled(HdStatus status, HdStatus expected, int compiled) {
    assert_int_equal(status, expected);
    assert_int_equal(gpu_state.compiled, compiled);
}

TEST(kernels_are_built_for_other_needs_or_the_probe_only) {
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
    } cases[] = {{1024, 128}, {128, 128}, {127, 64}, {64, 64}, {1, 1}};
    for (int i = 0; i < (int)(sizeof cases / sizeof *cases); i++) {
        gpu_state.most = cases[i].most;
        assert_int_equal(build(8 << i), HD_OK);
        assert_int_equal(program.group_size, cases[i].group_size);
    }
    gpu_state.most = 64;
    assert_int_equal(build_probe(), HD_OK);
    assert_int_equal(program.group_size, 64);
    /* Threads that do not share items have none. */
    program.cache.shape.group_size = 0;
    program.group_size = program.block = 1;
    gpu_state.most = 0;
    assert_int_equal(build(8), HD_OK);
    assert_int_equal(program.group_size, 1);
}

TEST(groups_that_were_asked_for_are_not_made_smaller) {
    program.block = 128;
    gpu_state.most = 128;
    assert_int_equal(build(8), HD_OK);
    gpu_state.most = 127;
    assert_int_equal(build(16), HD_UNAVAILABLE);
    assert_string_equal(error.message,
                        "a GPU runs the kernel in blocks of at most 127 threads, not 128");
    assert_false(program.is_built || gpu_state.has_kernels);
    assert_int_equal(build_probe(), HD_UNAVAILABLE);
    assert_false(program.is_built || gpu_state.has_kernels);
}

TEST(what_fails_is_tried_again) {
    char key[HD_KERNEL_KEY_LENGTH];
    gpu_state.breaks = true;
    expect_compiled(build(8), HD_UNAVAILABLE, 1);
    expect_compiled(build(8), HD_UNAVAILABLE, 2);
    hd_gpu_probe_key(&program, &fake_gpu, key, sizeof key);
    expect_contains(key, "options planes 0 probe 1\n");
    expect_contains(key, "driver 1\n");
    assert_false(program.cache.shape.is_probe);
    expect_compiled(build_probe(), HD_UNAVAILABLE, 3);
    expect_compiled(build_probe(), HD_UNAVAILABLE, 4);
    gpu_state.breaks = false;
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
    assert_int_equal(gpu_state.loaded, 1);
    program.is_built = false;
    gpu_state.refuses = true;
    expect_compiled(build(8), HD_OK, 3);
    expect_contains(program.cache.note,
                    "the driver refused the cached kernels; it is too old; compiled");
}

EACH(begin, NULL)
