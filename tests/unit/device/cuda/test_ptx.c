/* SPDX-License-Identifier: MIT */
/* Choosing the program's PTX for kernels of a shape. */
#include "device/cuda/compile.h"

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

TEST(suitable_ptx_is_found) {
    static const struct {
        HdKernelShape shape;
        int expected;
    } cases[] = {
        {{.group_size = 128, .is_probe = true}, 0},
        {{.group_size = 128, .needs = BOUNDS}, 1},
        {{.group_size = 64, .needs.plane_bound = 8}, 1},
        {{.wavefront = true}, 2},
        {{.wavefront = true, .first_hits = true}, 2},
        {{.group_size = 129}, -1},
        {{.first_hits = true}, -1},
        {{.rounds_by_fma = true}, -1},
        {{.rounds_by_fma = true, .is_probe = true}, -1},
        {{.precision = HD_PRECISION_DOUBLE}, -1},
        {{.math = HD_MATH_FAST}, -1},
        {{.needs.bounded = true}, -1},
        {{.needs.plane_bound = 129}, -1},
        {{.needs.depth_bound = 65}, -1},
        {{.needs.node_stack_bound = 33}, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdCudaPtx *found = hd_cuda_ptx_find(&cases[i].shape, 61);
        const int number = found != NULL ? (int)(found - hd_cuda_ptx) : -1;
        if (number != cases[i].expected)
            fail_msg("for shape %zu PTX %d is found, not %d", i, number, cases[i].expected);
    }
    const HdKernelShape any = {.group_size = 1};
    assert_ptr_equal(hd_cuda_ptx_find(&any, 90), &hd_cuda_ptx[1]);
    assert_true(hd_cuda_ptx_suits(61) && hd_cuda_ptx_suits(90));
    /* Older devices cannot run it. */
    assert_null(hd_cuda_ptx_find(&any, 60));
    assert_false(hd_cuda_ptx_suits(60));
}
