/* SPDX-License-Identifier: MIT */
/* What a wavefront's rays add to the picture, added by float atomics and in fixed point: the time,
   and how far runs differ. Reads a file of hedron_queue_order --record, a launch for each level. */
#include <cmath>
#include <cstdint>
#include <cstring>

#include "check.h"

enum { THREADS = 256, TIMED_ROUNDS = 20, RUNS = 10 };

struct Contribution {
    int32_t sample;
    float colour[3];
};

struct Recording {
    int32_t samples, per_pixel;
    std::vector<Contribution> items;
    std::vector<int32_t> levels; /* rays of each */
};

/* 2^40: cutting off what is below adds no error that a float could show. */
static const double TO_FIXED = 1099511627776.0;

/* Sums are arrays of `stride`, a channel behind the other, as the wavefront has them. `per_sum`
   samples share a sum. */
__global__ void add_floats(const Contribution *items, int count, int per_sum, int stride,
                           float *sums) {
    int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i >= count)
        return;
    float *sum = sums + items[i].sample / per_sum;
    for (int channel = 0; channel < 3; channel++)
        atomicAdd(sum + static_cast<size_t>(channel) * stride, items[i].colour[channel]);
}

__global__ void add_fixed(const Contribution *items, int count, int per_sum, int stride,
                          unsigned long long *sums) {
    int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i >= count)
        return;
    unsigned long long *sum = sums + items[i].sample / per_sum;
    for (int channel = 0; channel < 3; channel++) {
        float scaled = items[i].colour[channel] * static_cast<float>(TO_FIXED);
        atomicAdd(sum + static_cast<size_t>(channel) * stride,
                  static_cast<unsigned long long>(static_cast<long long>(scaled)));
    }
}

static void demand(bool right, const char *what) {
    if (right)
        return;
    std::fprintf(stderr, "image_sums: %s\n", what);
    std::exit(1);
}

static int32_t read_int(FILE *file) {
    int32_t number = 0;
    demand(std::fread(&number, sizeof number, 1, file) == 1, "the recording is cut off");
    return number;
}

static Recording read_recording(const char *path) {
    FILE *file = std::fopen(path, "rb");
    demand(file != nullptr, "cannot open the recording");
    Recording recording;
    recording.samples = read_int(file);
    recording.per_pixel = read_int(file);
    demand(recording.samples > 0 && recording.per_pixel > 0, "the recording has no samples");
    for (int32_t count = read_int(file); count > 0; count = read_int(file)) {
        size_t before = recording.items.size();
        recording.levels.push_back(count);
        recording.items.resize(before + static_cast<size_t>(count));
        demand(std::fread(recording.items.data() + before, sizeof(Contribution),
                          static_cast<size_t>(count), file) == static_cast<size_t>(count),
               "the recording is cut off");
    }
    std::fclose(file);
    for (const Contribution &item : recording.items)
        demand(item.sample >= 0 && item.sample < recording.samples, "a sample has a wrong number");
    return recording;
}

/* One way to add up. */
template <typename Sum> struct Adder {
    void (*kernel)(const Contribution *, int, int, int, Sum *);
    const Recording &recording;
    const Contribution *items; /* on the device */
    int per_sum;               /* samples */
    Sum *sums;                 /* on the device */

    int stride() const { return recording.samples / per_sum; }
    size_t count() const { return 3 * static_cast<size_t>(stride()); }
    void clear() const { CHECK(cudaMemset(sums, 0, count() * sizeof(Sum))); }
    void add() const {
        const Contribution *level = items;
        for (int32_t rays : recording.levels) {
            kernel<<<(rays + THREADS - 1) / THREADS, THREADS>>>(level, rays, per_sum, stride(),
                                                                sums);
            level += rays;
        }
    }
    std::vector<Sum> run() const {
        std::vector<Sum> host(count());
        clear();
        add();
        CHECK(cudaGetLastError());
        CHECK(cudaMemcpy(host.data(), sums, count() * sizeof(Sum), cudaMemcpyDeviceToHost));
        return host;
    }
};

static double to_double(float sum) {
    return static_cast<double>(sum);
}

static double to_double(unsigned long long sum) {
    return static_cast<double>(static_cast<long long>(sum)) / TO_FIXED;
}

/* How many floats lie between two that are not negative. */
static double ulps(double a, double b) {
    float low = static_cast<float>(a), high = static_cast<float>(b);
    int32_t low_bits, high_bits;
    std::memcpy(&low_bits, &low, sizeof low);
    std::memcpy(&high_bits, &high, sizeof high);
    return std::fabs(static_cast<double>(high_bits) - static_cast<double>(low_bits));
}

struct Spread {
    double largest = 0, squares = 0;
    size_t count = 0, differing = 0;

    void add(double difference) {
        largest = std::max(largest, difference);
        squares += difference * difference;
        count++;
        differing += difference != 0;
    }
    double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
    void print(const char *name) const {
        std::printf(", \"%s\": {\"max\": %.6g, \"rms\": %.6g, \"differing\": %.6g}", name, largest,
                    rms(), static_cast<double>(differing) / static_cast<double>(count));
    }
};

/* The mean of a pixel's samples in units of 1/255, as it would be shown. */
static double shown(double sum, int samples) {
    return 255 * std::min(1.0, sum / samples);
}

/* Runs 1 to RUNS - 1 against run 0, and run 0 against sums in double on the host. */
template <typename Sum> static void print_adder(const char *name, const Adder<Sum> &adder) {
    std::vector<double> truth(adder.count());
    for (const Contribution &item : adder.recording.items)
        for (int channel = 0; channel < 3; channel++)
            truth[static_cast<size_t>(channel) * adder.stride() + item.sample / adder.per_sum] +=
                static_cast<double>(item.colour[channel]);
    double ms = median_ms(
        TIMED_ROUNDS, [&] { adder.clear(); }, [&] { adder.add(); });
    std::vector<Sum> first = adder.run();
    Spread units, steps, bytes, error;
    for (size_t i = 0; i < first.size(); i++)
        error.add(
            std::fabs(shown(to_double(first[i]), adder.per_sum) - shown(truth[i], adder.per_sum)));
    for (int run = 1; run < RUNS; run++) {
        std::vector<Sum> other = adder.run();
        for (size_t i = 0; i < first.size(); i++) {
            double a = to_double(first[i]), b = to_double(other[i]);
            double one = shown(a, adder.per_sum), two = shown(b, adder.per_sum);
            units.add(std::fabs(one - two));
            bytes.add(std::fabs(std::floor(one + 0.5) - std::floor(two + 0.5)));
            steps.add(first[i] == other[i] ? 0 : std::max(1.0, ulps(a, b)));
        }
    }
    std::printf(", \"%s\": {\"ms\": %.6g, \"ns_each\": %.6g", name, ms,
                1e6 * ms / static_cast<double>(adder.recording.items.size()));
    units.print("runs_differ_by_255ths");
    steps.print("runs_differ_by_ulps");
    bytes.print("runs_differ_by_bytes");
    error.print("error_255ths");
    std::printf("}");
}

template <typename Sum>
static void study(const char *name, void (*kernel)(const Contribution *, int, int, int, Sum *),
                  const Recording &recording, const Contribution *items, int per_sum) {
    Adder<Sum> adder = {kernel, recording, items, per_sum, nullptr};
    adder.sums = device_memory<Sum>(adder.count());
    print_adder(name, adder);
    CHECK(cudaFree(adder.sums));
}

int main(int count, char **words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: image_sums RECORDING\n");
        return 2;
    }
    begin_device();
    Recording recording = read_recording(words[1]);
    size_t bytes = recording.items.size() * sizeof(Contribution);
    Contribution *items = device_memory<Contribution>(recording.items.size());
    CHECK(cudaMemcpy(items, recording.items.data(), bytes, cudaMemcpyHostToDevice));
    std::printf("{");
    print_device();
    std::printf(
        ", \"runs\": %d, \"contributions\": %zu, \"samples\": %d, \"samples_per_pixel\": %d, "
        "\"levels\": %zu",
        RUNS, recording.items.size(), recording.samples, recording.per_pixel,
        recording.levels.size());
    study("float_pixels", add_floats, recording, items, recording.per_pixel);
    study("fixed_pixels", add_fixed, recording, items, recording.per_pixel);
    study("float_samples", add_floats, recording, items, 1);
    study("fixed_samples", add_fixed, recording, items, 1);
    std::printf("}\n");
    return 0;
}
