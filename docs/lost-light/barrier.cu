// SPDX-License-Identifier: MIT
// ptxas 13.0 re-saves a spilled convergence barrier on the divergent exit of a loop. The warp then
// falls apart, and a loop counter in a uniform register is incremented too often. The program needs
// no input, and prints how many of 4096 threads differ from the same function on the processor:
//
//     nvcc -arch=sm_90 -DLEVELS=10 barrier.cu -o barrier && ./barrier
//
// Expected: 0 of 4096 threads are wrong. Seen on an H100 (driver 580.159, nvcc V13.0.88): 0 with
// LEVELS=8 and 9, 4096 with 10 and 11. See ../lost-light.md.
#include <cstdio>
#include <cstdlib>
#include <vector>

#ifndef LEVELS
#define LEVELS 10
#endif

enum { THREADS = 4096, BLOCK = 128, TURNS = 50 };

__host__ __device__ static unsigned next(unsigned x) {
    return x * 1664525u + 1013904223u;
}

// Each thread's n sets its trip counts. ptxas spills the barrier of the second loop.
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

static void check(cudaError_t code) {
    if (code == cudaSuccess)
        return;
    std::printf("%s\n", cudaGetErrorString(code));
    std::exit(2);
}

int main() {
    std::vector<unsigned> sums(THREADS);
    unsigned *on_device = nullptr;
    check(cudaMalloc(&on_device, THREADS * sizeof *on_device));
    check(cudaMemset(on_device, 0, THREADS * sizeof *on_device));
    run<<<THREADS / BLOCK, BLOCK>>>(on_device, TURNS);
    check(cudaGetLastError());
    check(cudaMemcpy(sums.data(), on_device, THREADS * sizeof *on_device, cudaMemcpyDeviceToHost));
    int wrong = 0;
    for (unsigned thread = 0; thread < THREADS; thread++)
        wrong += sums[thread] != work(thread * 2654435761u, TURNS);
    std::printf("%d levels: %d of %d threads are wrong\n", LEVELS, wrong, (int)THREADS);
    return wrong > 0;
}
