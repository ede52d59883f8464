/* SPDX-License-Identifier: MIT */
/* Tests of the shared kernel functions, called from C, beyond the frames of the conformance suite:
   odd numbers, accuracy, bounds. Included once for each HD_LANES and precision. */
#include <stdbool.h>

#include "cpu/dialect.h"
#include "kernels/common/wavefront.h"
#include "unit_test.h"

TEST(contributions_are_clamped) {
    const fixed64 most = (fixed64)1 << 56;
    const struct {
        real radiance, weight;
        fixed64 expected;
        int clamps;
    } cases[] = {{R(1.0), R(0.5), (fixed64)1 << 39, 0},
                 {R(65536.0), R(1.0), most, 0},
                 {R(65537.0), R(1.0), most, 1},
                 {(real)INFINITY, R(1.0), most, 1},
                 {(real)NAN, R(1.0), 0, 0},
                 {R(-3.0), R(1.0), 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vint counted = splat_int(0);
        vfix fixed = contribution(mask_all(), splat(cases[i].radiance), splat(cases[i].weight),
                                  R(1099511627776.0), &counted);
        if (lane_fix(&fixed, 0) != cases[i].expected || lane_int(&counted, 0) != cases[i].clamps)
            fail_msg("a radiance of %g", (double)cases[i].radiance);
    }
}

/* docs/numerics.md relies on both limits, in units of the last place. */
TEST(reciprocals_are_accurate) {
    const long double unit = sizeof(real) == sizeof(float) ? 0x1p-23L : 0x1p-52L;
    for (int i = 0; i < 20000; i++) {
        const real number = (real)ldexp(1.0 + (double)i * 3.7e-5, i * 37 % 200 - 100);
        vreal inverse = reciprocal(splat(number)), root = reciprocal_root(splat(number));
        const long double exact = (long double)number;
        assert_true(fabsl((long double)lane_real(&inverse, 0) * exact - 1.0L) < unit);
        assert_true(fabsl((long double)lane_real(&root, 0) * sqrtl(exact) - 1.0L) < 1.5L * unit);
    }
}

static Vec3 refract_at_level(Vec3 direction, real relative_index, vmask *total) {
    Vec3 normal = vec3_splat(R(0.0), R(0.0), R(1.0));
    return refract(direction, normal, vec3_dot(normal, direction), splat(relative_index), total);
}

/* A direction may be longer than 1 by rounding: grazing and upright rays must not become NaN, and
   its length must not propagate from face to face. */
TEST(refraction_survives_rounding) {
    vmask total;
    const real ulp = sizeof(real) == 4 ? R(1.1920928955078125e-7) : R(2.220446049250313e-16);
    Vec3 after = refract_at_level(vec3_splat(R(0.0), R(0.0), R(-1.0) - ulp), R(2.0), &total);
    assert_true(lane_real(&after.z, 0) == R(-1.0));
    after = refract_at_level(vec3_splat(R(1.0) + ulp, R(0.0), -ulp), R(0.5), &total);
    assert_false(any_lane(total));
    expect_near((double)lane_real(&after.x, 0), 0.5, 1e-5);
    after = refract_at_level(vec3_splat(R(1.0) + ulp, R(0.0), -ulp), R(1.5), &total);
    assert_true(lane_int(&total, HD_LANES - 1) == -1);
    expect_near((double)lane_real(&after.x, 0), 1.0, 1e-5);
    after = refract_at_level(vec3_splat(R(0.3003), R(0.0), R(-0.95489)), R(1.3), &total);
    vreal length = vec3_dot(after, after);
    expect_near((double)lane_real(&length, 0), 1.0, 1e-5);
}

TEST(pictures_repeat_or_end) {
    enum { WIDTH = 4, HEIGHT = 2 };
    static const struct {
        int is_clamped;
        double s, t, red; /* in units of a texel */
    } cases[] = {
        {0, 0.125, 0.25, 0},     {0, 5.375, -1.25, 11000},
        {0, 1.0, 0.25, 15000},   /* between column 3 and column 0 */
        {0, 1.0625, 0.25, 7500}, /* nearer to 0 */
        {0, 0.125, 1.125, 250},  {0, 0.125 - 1e-9, 0.25 - 1e-9, 0},
        {0, 0.125, 0.0, 500},    {1, 0.125, 0.25, 0},
        {1, 0.5, 0.5, 15500},    {1, 1.0, 1.0, 31000},
        {1, -3.0, 0.5, 500},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Picture picture = {0, WIDTH, HEIGHT, cases[i].is_clamped};
        uint texels[2 * (WIDTH + 1) * (HEIGHT + 1) + 2];
        for (uint place = 0; place < (WIDTH + 1) * (HEIGHT + 1); place++) {
            uint column = place % (WIDTH + 1), row = place / (WIDTH + 1);
            bool is_beyond = column == WIDTH || row == HEIGHT;
            /* Coordinates beyond the end of a picture that does not repeat count nowhere. */
            texels[2 * place] = is_beyond && cases[i].is_clamped
                                    ? 65535
                                    : 10000 * (column % WIDTH) + 1000 * (row % HEIGHT);
            texels[2 * place + 1] = 0;
        }
        Vec3 c = sample_picture(&picture, texels, splat((real)cases[i].s), splat((real)cases[i].t));
        if (fabs((double)lane_real(&c.x, 0) * 65535.0 - cases[i].red) > 0.05)
            fail_msg("case %zu: %g", i, (double)lane_real(&c.x, 0) * 65535.0);
    }
}

TEST(attenuations_add_up) {
    vreal share = passing_share(splat_int(0), splat_int(0));
    assert_true(lane_real(&share, 0) == R(1.0));
    share = passing_share(splat_int(HD_DARK_DENSITY), splat_int(0));
    assert_true(lane_real(&share, 0) == R(0.0));
    for (int i = 1; i < 1000; i++) {
        share = passing_share(splat_int(i * 20011), splat_int(i * 1009));
        double density = i * 20011 * 0x1p-24 + i * 1009 * 0x1p-48;
        double error = (double)lane_real(&share, 0) / pow(2.0, -density) - 1.0;
        assert_true(fabs(error) < (HD_DOUBLE ? 1e-15 : 2.5e-7));
    }
}

/* ---- truncation in scenes with an error bound ---- */

/* Lanes in turn: out of a solid, into it, from the fourth mesh. */
enum { CHANNELS = 3, WAYS = 3, DEAD_LANE = 1 };
static const double seen_times[WAYS] = {1.0, 2.0, 4.0};

/* Makes rays of weight (lane + 1) / 4 in one channel. */
static Ray make_ray(int channel) {
    Ray ray = eye_ray(vec3_zero(), ~eq_int(lane_numbers(), splat_int(DEAD_LANE)));
    ray.weight = vec3_zero();
    vreal *parts[CHANNELS] = {&ray.weight.x, &ray.weight.y, &ray.weight.z};
    *parts[channel] = splat(R(0.25)) + to_real(lane_numbers()) * R(0.25);
    vint inside = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++) {
        set_lane_int(&ray.last_hit, lane, lane % WAYS == 2 ? 4 : 0);
        set_lane_int(&inside, lane, lane % WAYS == 1);
    }
    ray.inside = eq_int(inside, splat_int(1));
    return ray;
}

#define NO_TABLE(type, name) const type *name = NULL;

/* The bound is the greatest radiance visible from a ray's origin, times the exposure; one at the
   limit is not below it. At the scene's depth all end, and those of a weight below 0.5. Ended rays
   add to the sum. All numbers are sums of few powers of two, so that nothing is rounded. */
TEST(rays_that_end_are_bounded) {
    static const struct {
        double limit;
        int level;
        real cutoff;
    } cases[] = {{12.0, 2, R(0.0)}, {1.0, 5, R(0.0)}, {0.0, 2, R(0.5)}};
    Header no_header = {.bounded = 1, .exposure = R(2.0), .floor_end = 1};
    Object solid_and_meshes[2] = {{0}};
    for (int i = 0; i < CHANNELS; i++) {
        const double most = 1 << i;
        solid_and_meshes[0].seen_outside[i] = (real)(seen_times[0] * most);
        solid_and_meshes[0].seen_inside[i] = (real)(seen_times[1] * most);
        solid_and_meshes[1].seen_outside[i] = (real)(seen_times[2] * most);
        solid_and_meshes[1].seen_inside[i] = (real)(seen_times[2] * most);
    }
    for (int i = 0; i < CHANNELS * 3; i++) {
        int channel = i / 3, k = i % 3;
        double each = 0.5 * (1 << channel);
        View no_view = {.bound_to_fixed = R(16384.0),
                        .depth = 5,
                        .bound_cutoff = (real)(cases[k].limit * each),
                        .cutoff = cases[k].cutoff};
        Ray ray = make_ray(channel);
        Sample sample = empty_sample();
        HD_SCENE_TABLES(NO_TABLE) HD_FRAME_TABLES(NO_TABLE) header = &no_header;
        view = &no_view;
        objects = solid_and_meshes;
        end_rays(SCENE_ARGUMENTS cases[k].level, &ray, &sample);
        vint going_on = vselect_int(ray.alive, splat_int(1), splat_int(0));
        for (int lane = 0; lane < HD_LANES; lane++) {
            double bound = each * (lane + 1) * seen_times[lane % WAYS];
            bool is_over = k == 0 ? bound < 12.0 * each : k == 1 || lane == 0;
            int64_t added = lane != DEAD_LANE && is_over ? (int64_t)(bound * 16384.0 + 1.0) : 0;
            assert_int_equal(lane_fix(&sample.bound, lane), added);
            assert_int_equal(lane_int(&going_on, lane), lane != DEAD_LANE && !is_over);
        }
    }
}
