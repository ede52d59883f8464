/* SPDX-License-Identifier: MIT */
/* Which of the program's PTX does what kernels of a shape would. */
#include "device/cuda/ptx.h"

#include "unit_test.h"

#define BOUNDS                                                                                     \
    { .plane_bound = 128, .depth_bound = 64, .node_stack_bound = 32 }

/* In place of the program's (--wrap). */
#define hd_cuda_ptx       __wrap_hd_cuda_ptx
#define hd_cuda_ptx_count __wrap_hd_cuda_ptx_count
extern const HdCudaPtx hd_cuda_ptx[];
extern const int hd_cuda_ptx_count;
const HdCudaPtx hd_cuda_ptx[] = {
    {.shape = {.group_size = 128, .is_probe = true}},
    {.shape = {.group_size = 128, .needs = BOUNDS}},
    {.shape = {.group_size = 128, .first_hits = true, .wavefront = true, .needs = BOUNDS}},
};
const int hd_cuda_ptx_count = sizeof hd_cuda_ptx / sizeof *hd_cuda_ptx;

/* The number of what is found; -1: nothing is. */
static int find(const HdKernelShape *shape) {
    const HdCudaPtx *found = hd_cuda_ptx_find(shape, 61);
    return found != NULL ? (int)(found - hd_cuda_ptx) : -1;
}

TEST(what_does_all_is_found) {
    const HdKernelShape probe = {.group_size = 128, .is_probe = true};
    const HdKernelShape largest = {.group_size = 128, .needs = BOUNDS};
    const HdKernelShape small = {.group_size = 64, .needs.plane_bound = 8};
    const HdKernelShape wavefront = {.wavefront = true};
    const HdKernelShape first_hits = {.wavefront = true, .first_hits = true};
    assert_int_equal(find(&probe), 0);
    assert_int_equal(find(&largest), 1);
    assert_int_equal(find(&small), 1);
    assert_int_equal(find(&wavefront), 2);
    assert_int_equal(find(&first_hits), 2);
}

TEST(what_does_less_is_not) {
    const HdKernelShape others[] = {
        {.group_size = 129},
        {.first_hits = true},
        {.rounds_by_fma = true},
        {.rounds_by_fma = true, .is_probe = true},
        {.precision = HD_PRECISION_DOUBLE},
        {.math = HD_MATH_FAST},
        {.needs.surveyed = true},
        {.needs.plane_bound = 129},
        {.needs.depth_bound = 65},
        {.needs.node_stack_bound = 33},
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_int_equal(find(&others[i]), -1);
}

TEST(older_devices_cannot_run_it) {
    const HdKernelShape any = {.group_size = 1};
    assert_non_null(hd_cuda_ptx_find(&any, 90));
    assert_null(hd_cuda_ptx_find(&any, 60));
    assert_true(hd_cuda_ptx_suits(61) && hd_cuda_ptx_suits(90));
    assert_false(hd_cuda_ptx_suits(60));
}
