/* SPDX-License-Identifier: MIT */
#include "device/cuda/ptx.h"

bool hd_cuda_ptx_suits(int arch) {
    return hd_cuda_ptx_count > 0 && arch >= HD_CUDA_PTX_ARCH;
}

/* Surveyed pixels are laid out otherwise; the probe has nothing of pipelines and first
   hits. */
static bool does_all(const HdKernelShape *ptx, const HdKernelShape *shape) {
    return shape->is_probe == ptx->is_probe && !shape->rounds_by_fma &&
           (shape->is_probe ||
            (shape->wavefront == ptx->wavefront && (ptx->first_hits || !shape->first_hits))) &&
           shape->precision == ptx->precision && shape->math == ptx->math &&
           shape->group_size <= ptx->group_size && shape->needs.surveyed == ptx->needs.surveyed &&
           shape->needs.plane_bound <= ptx->needs.plane_bound &&
           shape->needs.depth_bound <= ptx->needs.depth_bound &&
           shape->needs.node_stack_bound <= ptx->needs.node_stack_bound;
}

const HdCudaPtx *hd_cuda_ptx_find(const HdKernelShape *shape, int arch) {
    for (int i = 0; i < hd_cuda_ptx_count && arch >= HD_CUDA_PTX_ARCH; i++)
        if (does_all(&hd_cuda_ptx[i].shape, shape))
            return &hd_cuda_ptx[i];
    return NULL;
}
