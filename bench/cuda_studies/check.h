/* SPDX-License-Identifier: MIT */
/* What both programs need of the CUDA runtime. They print one JSON object and end with 0, with 1
   where a call failed, with 3 where there is no device. */
#ifndef HD_CUDA_STUDIES_CHECK_H
#define HD_CUDA_STUDIES_CHECK_H

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#define CHECK(call) check_call((call), #call, __FILE__, __LINE__)

inline void check_call(cudaError_t error, const char *call, const char *file, int line) {
    if (error == cudaSuccess)
        return;
    std::fprintf(stderr, "%s:%d: %s: %s\n", file, line, call, cudaGetErrorString(error));
    std::exit(1);
}

inline void begin_device() {
    int count = 0;
    cudaError_t error = cudaGetDeviceCount(&count);
    if (error != cudaSuccess || count == 0) {
        std::fprintf(stderr, "no CUDA device: %s\n", cudaGetErrorString(error));
        std::exit(3);
    }
    CHECK(cudaSetDevice(0));
}

inline void print_device() {
    cudaDeviceProp device;
    CHECK(cudaGetDeviceProperties(&device, 0));
    std::printf("\"device\": \"%s\", \"multiprocessors\": %d", device.name,
                device.multiProcessorCount);
}

template <typename T> T *device_memory(size_t count) {
    void *memory = nullptr;
    CHECK(cudaMalloc(&memory, count * sizeof(T)));
    return static_cast<T *>(memory);
}

/* The median milliseconds on the device of `rounds` calls; `prepare` comes before each and does not
   count. */
template <typename Prepare, typename Work>
double median_ms(int rounds, Prepare prepare, Work work) {
    cudaEvent_t start, stop;
    std::vector<float> times;
    CHECK(cudaEventCreate(&start));
    CHECK(cudaEventCreate(&stop));
    for (int round = 0; round <= rounds; round++) {
        float ms = 0;
        prepare();
        CHECK(cudaEventRecord(start));
        work();
        CHECK(cudaGetLastError());
        CHECK(cudaEventRecord(stop));
        CHECK(cudaEventSynchronize(stop));
        CHECK(cudaEventElapsedTime(&ms, start, stop));
        if (round > 0) /* the first one warms up */
            times.push_back(ms);
    }
    CHECK(cudaEventDestroy(start));
    CHECK(cudaEventDestroy(stop));
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

#endif
