/* SPDX-License-Identifier: MIT */
/* The kernels' own bilinear lookup (kernels/common/texture.h) against the texture units': time and
   error. The same picture of 8-bit colours in every form. */
#include <cmath>

#include "../../kernels/cuda/dialect.h"
#include "check.h"

#include "../../kernels/common/texture.h"

enum { SIDE = 1024, THREADS = 256, LOOKUPS = 64, TIMED_ROUNDS = 20 };
enum { THREAD_COUNT = 1 << 18 };
enum { COHERENT, RANDOM };

/* Integers from integers (Steele, Lea and Flood 2014, SplitMix, of 32 bits). */
static __host__ __device__ __forceinline__ uint scramble(uint a) {
    a ^= a >> 16;
    a *= 0x7feb352du;
    a ^= a >> 15;
    a *= 0x846ca68bu;
    return a ^ a >> 16;
}

/* Coherent: a warp looks at 8 x 4 neighbours a little more than a texel apart, and goes on from
   there in small steps. */
static __device__ __forceinline__ float2 place_of(int kind, uint thread, uint step) {
    if (kind == RANDOM) {
        uint a = scramble(thread * LOOKUPS + step), b = scramble(a ^ 0x9e3779b9u);
        return make_float2(static_cast<float>(a >> 8) * 0x1p-24f,
                           static_cast<float>(b >> 8) * 0x1p-24f);
    }
    uint block = thread / 32, lane = thread % 32;
    float column = static_cast<float>(block % 128 * 8 + lane % 8);
    float row = static_cast<float>(block / 128 % 256 * 4 + lane / 8);
    float s = column * 1.1f + row * 0.1f + static_cast<float>(step) * 0.37f;
    float t = row * 1.1f - column * 0.1f + static_cast<float>(step) * 0.29f;
    s *= 1.0f / SIDE;
    t *= 1.0f / SIDE;
    return make_float2(s - floorf(s), t - floorf(t));
}

struct NoLookup {
    __device__ float3 operator()(float2 place) const {
        return make_float3(place.x, place.y, place.x);
    }
};

struct OwnLookup {
    const Picture *form;
    const uint *texels;
    __device__ float3 operator()(float2 place) const {
        Vec3 colour = sample_picture(form, texels, place.x, place.y);
        return make_float3(colour.x, colour.y, colour.z);
    }
};

struct HardwareLookup {
    cudaTextureObject_t texture;
    __device__ float3 operator()(float2 place) const {
        float4 colour = tex2D<float4>(texture, place.x, place.y);
        return make_float3(colour.x, colour.y, colour.z);
    }
};

template <typename Lookup> __global__ void look_up(Lookup lookup, int kind, float3 *results) {
    uint thread = blockIdx.x * blockDim.x + threadIdx.x;
    float3 sum = make_float3(0, 0, 0);
#pragma unroll 4
    for (uint step = 0; step < LOOKUPS; step++) {
        float3 colour = lookup(place_of(kind, thread, step));
        sum.x += colour.x;
        sum.y += colour.y;
        sum.z += colour.z;
    }
    results[thread] = sum;
}

/* The first lookup of each thread, against bilinear interpolation in double. */
template <typename Lookup>
__global__ void differ(Lookup lookup, const uchar4 *picture, double3 *differences) {
    uint thread = blockIdx.x * blockDim.x + threadIdx.x;
    float2 place = place_of(RANDOM, thread, 0);
    double x = fmin(fmax(static_cast<double>(place.x) * SIDE - 0.5, 0.0), SIDE - 1.0);
    double y = fmin(fmax(static_cast<double>(place.y) * SIDE - 0.5, 0.0), SIDE - 1.0);
    int column = static_cast<int>(x), row = static_cast<int>(y);
    int right = min(column + 1, SIDE - 1), below = min(row + 1, SIDE - 1);
    double across = x - column, down = y - row;
    uchar4 texels[4] = {picture[row * SIDE + column], picture[row * SIDE + right],
                        picture[below * SIDE + column], picture[below * SIDE + right]};
    double weights[4] = {(1 - across) * (1 - down), across * (1 - down), (1 - across) * down,
                         across * down};
    double3 truth = make_double3(0, 0, 0);
    for (int i = 0; i < 4; i++) {
        truth.x += weights[i] * texels[i].x;
        truth.y += weights[i] * texels[i].y;
        truth.z += weights[i] * texels[i].z;
    }
    float3 found = lookup(place);
    differences[thread] = make_double3(255.0 * static_cast<double>(found.x) - truth.x,
                                       255.0 * static_cast<double>(found.y) - truth.y,
                                       255.0 * static_cast<double>(found.z) - truth.z);
}

static void print_times(const char *name, double coherent, double random) {
    double lookups = static_cast<double>(THREAD_COUNT) * LOOKUPS;
    std::printf(", \"%s\": {\"coherent_ns\": %.6g, \"random_ns\": %.6g", name,
                1e6 * coherent / lookups, 1e6 * random / lookups);
}

template <typename Lookup> static void time_lookup(const char *name, Lookup lookup) {
    float3 *results = device_memory<float3>(THREAD_COUNT);
    double ms[2];
    for (int kind = COHERENT; kind <= RANDOM; kind++)
        ms[kind] = median_ms(
            TIMED_ROUNDS, [] {},
            [&] { look_up<<<THREAD_COUNT / THREADS, THREADS>>>(lookup, kind, results); });
    print_times(name, ms[COHERENT], ms[RANDOM]);
    CHECK(cudaFree(results));
}

template <typename Lookup>
static void print_error(const char *name, Lookup lookup, const uchar4 *picture) {
    double3 *memory = device_memory<double3>(THREAD_COUNT);
    std::vector<double3> differences(THREAD_COUNT);
    differ<<<THREAD_COUNT / THREADS, THREADS>>>(lookup, picture, memory);
    CHECK(cudaGetLastError());
    CHECK(cudaMemcpy(differences.data(), memory, THREAD_COUNT * sizeof(double3),
                     cudaMemcpyDeviceToHost));
    CHECK(cudaFree(memory));
    double largest = 0, squares = 0;
    for (const double3 &each : differences)
        for (double one : {each.x, each.y, each.z}) {
            largest = std::max(largest, std::fabs(one));
            squares += one * one;
        }
    std::printf(", \"error_%s\": {\"max\": %.6g, \"rms\": %.6g}", name, largest,
                std::sqrt(squares / (3.0 * THREAD_COUNT)));
}

/* Noise: neighbours have nothing in common, which is the worst case. Smooth: waves of 64 texels. */
static std::vector<uchar4> make_picture(bool smooth) {
    std::vector<uchar4> picture(SIDE * SIDE);
    for (uint i = 0; i < SIDE * SIDE; i++) {
        uint noise = scramble(i);
        double phase = 6.283185307179586 / 64, x = i % SIDE, y = i / SIDE;
        picture[i] =
            smooth
                ? make_uchar4(static_cast<unsigned char>(127.5 + 127 * sin(phase * x)),
                              static_cast<unsigned char>(127.5 + 127 * sin(phase * y)),
                              static_cast<unsigned char>(127.5 + 127 * cos(phase * (x + y))), 255)
                : make_uchar4(static_cast<unsigned char>(noise & 255),
                              static_cast<unsigned char>(noise >> 8 & 255),
                              static_cast<unsigned char>(noise >> 16 & 255), 255);
    }
    return picture;
}

template <typename Texel> struct Texture {
    cudaArray_t array = nullptr;
    cudaTextureObject_t object = 0;

    Texture(const std::vector<Texel> &texels, cudaTextureReadMode mode) {
        cudaChannelFormatDesc format = cudaCreateChannelDesc<Texel>();
        cudaResourceDesc resource = {};
        cudaTextureDesc description = {};
        CHECK(cudaMallocArray(&array, &format, SIDE, SIDE));
        CHECK(cudaMemcpy2DToArray(array, 0, 0, texels.data(), SIDE * sizeof(Texel),
                                  SIDE * sizeof(Texel), SIDE, cudaMemcpyHostToDevice));
        resource.resType = cudaResourceTypeArray;
        resource.res.array.array = array;
        description.addressMode[0] = description.addressMode[1] = cudaAddressModeClamp;
        description.filterMode = cudaFilterModeLinear;
        description.readMode = mode;
        description.normalizedCoords = 1;
        CHECK(cudaCreateTextureObject(&object, &resource, &description, nullptr));
    }
    Texture(const Texture &) = delete;
    ~Texture() {
        CHECK(cudaDestroyTextureObject(object));
        CHECK(cudaFreeArray(array));
    }
};

/* The picture on the device, and in the kernels' own form (scene_tables.h). */
struct Forms {
    uchar4 *picture;
    uint *texels;
    Picture *form;
};

static Forms make_own_forms(const std::vector<uchar4> &picture) {
    Forms forms;
    Picture form = {};
    std::vector<uint> texels;
    for (int row = 0; row <= SIDE; row++)
        for (int column = 0; column <= SIDE; column++) {
            const uchar4 &each = picture[row % SIDE * SIDE + column % SIDE];
            texels.push_back(each.x * 257u | each.y * 257u << 16);
            texels.push_back(each.z * 257u);
        }
    form.width = form.height = SIDE;
    form.is_clamped = 1;
    forms.picture = device_memory<uchar4>(picture.size());
    forms.texels = device_memory<uint>(texels.size());
    forms.form = device_memory<Picture>(1);
    CHECK(cudaMemcpy(forms.picture, picture.data(), picture.size() * sizeof(uchar4),
                     cudaMemcpyHostToDevice));
    CHECK(cudaMemcpy(forms.texels, texels.data(), texels.size() * sizeof(uint),
                     cudaMemcpyHostToDevice));
    CHECK(cudaMemcpy(forms.form, &form, sizeof form, cudaMemcpyHostToDevice));
    return forms;
}

static std::vector<float4> as_floats(const std::vector<uchar4> &picture) {
    std::vector<float4> floats;
    for (const uchar4 &each : picture)
        floats.push_back(make_float4(static_cast<float>(each.x) / 255.0f,
                                     static_cast<float>(each.y) / 255.0f,
                                     static_cast<float>(each.z) / 255.0f, 1));
    return floats;
}

static std::vector<ushort4> as_shorts(const std::vector<uchar4> &picture) {
    std::vector<ushort4> shorts;
    for (const uchar4 &each : picture)
        shorts.push_back(make_ushort4(static_cast<unsigned short>(each.x * 257),
                                      static_cast<unsigned short>(each.y * 257),
                                      static_cast<unsigned short>(each.z * 257), 65535));
    return shorts;
}

/* One picture in every form. */
struct TestImage {
    std::vector<uchar4> colours;
    Forms own;
    Texture<uchar4> bytes;
    Texture<ushort4> shorts;
    Texture<float4> floats;

    explicit TestImage(bool smooth)
        : colours(make_picture(smooth)), own(make_own_forms(colours)),
          bytes(colours, cudaReadModeNormalizedFloat),
          shorts(as_shorts(colours), cudaReadModeNormalizedFloat),
          floats(as_floats(colours), cudaReadModeElementType) {}
    TestImage(const TestImage &) = delete;
    ~TestImage() {
        CHECK(cudaFree(own.picture));
        CHECK(cudaFree(own.texels));
        CHECK(cudaFree(own.form));
    }
};

/* Times are of noise: they do not depend on the colours. */
template <typename Lookup>
static void study(const char *name, Lookup in_noise, const TestImage &noise, Lookup in_smooth,
                  const TestImage &smooth) {
    time_lookup(name, in_noise);
    print_error("noise", in_noise, noise.own.picture);
    print_error("smooth", in_smooth, smooth.own.picture);
    std::printf("}");
}

static void study_all() {
    TestImage noise(false), smooth(true);
    study("own", OwnLookup{noise.own.form, noise.own.texels}, noise,
          OwnLookup{smooth.own.form, smooth.own.texels}, smooth);
    study("hardware_8_bits", HardwareLookup{noise.bytes.object}, noise,
          HardwareLookup{smooth.bytes.object}, smooth);
    study("hardware_16_bits", HardwareLookup{noise.shorts.object}, noise,
          HardwareLookup{smooth.shorts.object}, smooth);
    study("hardware_floats", HardwareLookup{noise.floats.object}, noise,
          HardwareLookup{smooth.floats.object}, smooth);
}

int main() {
    begin_device();
    std::printf("{");
    print_device();
    std::printf(", \"lookups\": %lld, \"side\": %d", static_cast<long long>(THREAD_COUNT) * LOOKUPS,
                SIDE);
    time_lookup("none", NoLookup{});
    std::printf("}");
    study_all();
    std::printf("}\n");
    return 0;
}
