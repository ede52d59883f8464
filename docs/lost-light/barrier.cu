// SPDX-License-Identifier: MIT
// A kernel in which ptxas saves a convergence barrier wrongly (CUDA 13.0, sm_90). More about it:
// ../lost-light.md. It needs no input, and prints how many of 4096 threads compute something else
// than the processor does with the same function:
//
//     nvcc -arch=sm_90 -DLEVELS=10 barrier.cu -o barrier && ./barrier
//
// LEVELS loops are within each other, and threads of a warp leave them at different times. With 8 all
// threads are right. With 10 there are more barriers than registers for them: the machine code has
// BMOV.32.CLEAR R, B0 within the loop of power() that threads leave last.
#include <cstdio>
#include <vector>

#ifndef LEVELS
#define LEVELS 10
#endif

enum { THREADS = 4096, BLOCK = 128, TURNS = 50 };

__host__ __device__ static unsigned next(unsigned x) {
    return x * 1664525u + 1013904223u;
}

// Both loops are left at the time that a thread's own n says.
__host__ __device__ static unsigned power(unsigned x, unsigned n) {
    for (; !(n & 1); n >>= 1)
        x = x * x + 1;
    unsigned result = x;
    for (n >>= 1; n; n >>= 1) {
        x = x * x + 1;
        if (n & 1)
            result = result * x;
    }
    return result;
}

template <int DEPTH> __host__ __device__ static void nest(unsigned &x, unsigned &sum) {
    x = next(x);
    for (unsigned turns = x >> 30; turns > 0; turns--) {
        nest<DEPTH - 1>(x, sum);
        sum = sum * 31 + x;
    }
}

template <> __host__ __device__ void nest<0>(unsigned &x, unsigned &sum) {
    x = next(x);
    if (x >> 29)
        sum += power(x, (x >> 20 & 63) + 1);
}

// `turn` is the same for all threads, so ptxas keeps it in a uniform register, which all threads of
// a warp share: right as long as they are together at the end of each turn.
__host__ __device__ static unsigned work(unsigned x, int turns) {
    unsigned sum = 0;
    for (int turn = 0; turn < turns; turn++) {
        nest<LEVELS>(x, sum);
        sum = sum * 31 + x;
    }
    return sum;
}

__global__ void run(unsigned *sums, int turns) {
    unsigned thread = blockIdx.x * blockDim.x + threadIdx.x;
    sums[thread] = work(thread * 2654435761u, turns);
}

int main() {
    std::vector<unsigned> sums(THREADS);
    unsigned *on_device = nullptr;
    cudaMalloc(&on_device, THREADS * sizeof *on_device);
    run<<<THREADS / BLOCK, BLOCK>>>(on_device, TURNS);
    cudaError_t code =
        cudaMemcpy(sums.data(), on_device, THREADS * sizeof *on_device, cudaMemcpyDeviceToHost);
    if (code != cudaSuccess) {
        std::printf("%s\n", cudaGetErrorString(code));
        return 2;
    }
    int wrong = 0;
    for (unsigned thread = 0; thread < THREADS; thread++)
        wrong += sums[thread] != work(thread * 2654435761u, TURNS);
    std::printf("%d levels: %d of %d threads are wrong\n", LEVELS, wrong, (int)THREADS);
    return wrong > 0;
}
