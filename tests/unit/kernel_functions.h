/* SPDX-License-Identifier: MIT */
/* Tests of the shared kernel functions, called from C; included once for each HD_LANES. */
#include <stdbool.h>

#include "cpu/dialect.h"
#include "kernels/common/wavefront.h"
#include "unit_test.h"

#define CLOSE(found, expected) assert_true(fabs((double)(found) - (double)(expected)) < 1e-5)

/* A bundle whose lanes differ: lane l holds start + l * step. */
static vreal ramp(real start, real step) {
    return splat(start) + to_real(lane_numbers()) * step;
}

static vint int_ramp(int start, int step) {
    vint v = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++)
        set_lane_int(&v, lane, start + lane * step);
    return v;
}

TEST(masks_tell_lanes_apart) {
    vint numbers = int_ramp(0, 1);
    vmask last = eq_int(numbers, splat_int(HD_LANES - 1));
    assert_true(any_lane(last));
    assert_false(any_lane(mask_none()));
    assert_true(any_lane(mask_all()));
    assert_int_equal(first_lane(last), HD_LANES - 1);
    assert_int_equal(first_lane(mask_all()), 0);
    assert_true(all_same(splat_int(7)));
    assert_int_equal(all_same(numbers), HD_LANES == 1);
    vint picked = pick_int(last, splat_int(5), numbers);
    assert_int_equal(lane_int(&picked, HD_LANES - 1), 5);
    vint spread = spread_first(int_ramp(3, 1), last);
    for (int lane = 0; lane < HD_LANES; lane++)
        assert_int_equal(lane_int(&spread, lane), 3 + HD_LANES - 1);
    spread = spread_first(splat_int(-1), mask_none());
    assert_int_equal(lane_int(&spread, 0), 0);
}

TEST(lesser_and_greater_drop_nan) {
    vreal nan = splat((real)NAN), one = splat(R(1.0)), two = splat(R(2.0));
    vreal r = lesser(nan, one);
    assert_true(lane_real(&r, 0) == R(1.0));
    r = greater(nan, one);
    assert_true(lane_real(&r, 0) == R(1.0));
    r = lesser(one, two);
    assert_true(lane_real(&r, 0) == R(1.0));
    r = greater(one, two);
    assert_true(lane_real(&r, 0) == R(2.0));
}

TEST(multiply_add_rounds_once) {
    /* (1 + e)(1 - e) - 1 = -e^2: lost if the product is rounded on its own. */
    real e = sizeof(real) == 4 ? R(1.1920928955078125e-7) : R(2.220446049250313e-16);
    vreal r = multiply_add(splat(R(1.0) + e), splat(R(1.0) - e), splat(R(-1.0)));
    for (int lane = 0; lane < HD_LANES; lane++)
        assert_true(lane_real(&r, lane) == -e * e);
}

TEST(lowest_bits) {
    for (int bit = 0; bit < 32; bit++) {
        assert_int_equal(lowest_bit((uint)1 << bit), bit);
        assert_int_equal(lowest_bit(~(uint)0 << bit), bit);
    }
}

TEST(powers) {
    vreal x = ramp(R(0.5), R(0.05));
    for (int n = 1; n <= 70; n++) {
        vreal common = power(x, splat_int(n), n), mixed = power(x, splat_int(n), 0);
        for (int lane = 0; lane < HD_LANES; lane++) {
            CLOSE(lane_real(&common, lane), pow((double)lane_real(&x, lane), n));
            assert_true(lane_real(&common, lane) == lane_real(&mixed, lane));
        }
    }
    vint exponents = int_ramp(1, 3);
    vreal r = power(x, exponents, 0);
    for (int lane = 0; lane < HD_LANES; lane++)
        CLOSE(lane_real(&r, lane), pow((double)lane_real(&x, lane), 1 + 3 * lane));
}

static fixed64 one_contribution(real radiance, real weight, int *clamps) {
    vint counted = splat_int(0);
    vfix fixed =
        contribution(mask_all(), splat(radiance), splat(weight), R(1099511627776.0), &counted);
    *clamps = lane_int(&counted, 0);
    return lane_fix(&fixed, 0);
}

TEST(contributions_are_clamped) {
    int clamps;
    assert_true(one_contribution(R(1.0), R(0.5), &clamps) == (fixed64)1 << 39);
    assert_int_equal(clamps, 0);
    assert_true(one_contribution(R(65536.0), R(1.0), &clamps) == (fixed64)1 << 56);
    assert_int_equal(clamps, 0);
    assert_true(one_contribution(R(65537.0), R(1.0), &clamps) == (fixed64)1 << 56);
    assert_int_equal(clamps, 1);
    assert_true(one_contribution((real)INFINITY, R(1.0), &clamps) == (fixed64)1 << 56);
    assert_int_equal(clamps, 1);
    assert_true(one_contribution((real)NAN, R(1.0), &clamps) == 0);
    assert_true(one_contribution(R(-3.0), R(1.0), &clamps) == 0);
    assert_int_equal(clamps, 0);
}

/* The greatest relative error over numbers of many sizes, in units of the type's epsilon. */
static double worst_error(vreal (*function)(vreal), long double (*exact)(long double)) {
    const double epsilon = sizeof(real) == sizeof(float) ? 0x1p-23 : 0x1p-52;
    double worst = 0.0;
    for (int i = 0; i < 200000; i++) {
        double number = ldexp(1.0 + (double)i * 3.7e-6, i * 37 % 200 - 100);
        vreal found = function(splat((real)number));
        long double expected = exact((long double)(real)number);
        double error =
            (double)fabsl((long double)lane_real(&found, HD_LANES - 1) / expected - 1.0L);
        worst = error > worst ? error : worst;
    }
    return worst / epsilon;
}

static vreal reciprocal_of(vreal x) {
    return reciprocal(x);
}
static vreal reciprocal_root_of(vreal x) {
    return reciprocal_root(x);
}
static long double exact_reciprocal(long double x) {
    return 1.0L / x;
}
static long double exact_reciprocal_root(long double x) {
    return 1.0L / sqrtl(x);
}

TEST(reciprocals_are_accurate) {
    assert_true(worst_error(reciprocal_of, exact_reciprocal) < 1.0);
    assert_true(worst_error(reciprocal_root_of, exact_reciprocal_root) < 1.5);
}

TEST(fetching_by_lane) {
    Vector table[40];
    for (int i = 0; i < 40; i++)
        table[i] = (Vector){(real)i, (real)(2 * i), (real)(-i), R(0.0)};
    vint index = int_ramp(3, 2);
    Vec3 v = fetch_vector(table, index);
    for (int lane = 0; lane < HD_LANES; lane++) {
        assert_true(lane_real(&v.x, lane) == (real)(3 + 2 * lane));
        assert_true(lane_real(&v.y, lane) == (real)(6 + 4 * lane));
        assert_true(lane_real(&v.z, lane) == (real)(-3 - 2 * lane));
    }
}

/* A map in the plane z = 0 with the given corners, corner 0 at (s, t) = (0, 0). */
static FloorMap map_of(const double a[4], const double b[4]) {
    FloorMap map = {.axis_a = {R(1.0)}, .axis_b = {R(0.0), R(1.0)}};
    map.origin[0] = (real)a[0];
    map.origin[1] = (real)b[0];
    map.e[0] = (real)(a[1] - a[0]);
    map.e[1] = (real)(b[1] - b[0]);
    map.f[0] = (real)(a[3] - a[0]);
    map.f[1] = (real)(b[3] - b[0]);
    map.g[0] = (real)(a[0] - a[1] + a[2] - a[3]);
    map.g[1] = (real)(b[0] - b[1] + b[2] - b[3]);
    map.orientation = map.e[0] * map.f[1] - map.e[1] * map.f[0] < R(0.0) ? R(-1.0) : R(1.0);
    return map;
}

TEST(floor_coordinates_invert_the_map) {
    static const double quads[][2][4] = {
        {{-5, 5, 5, -5}, {5, 5, -5, -5}},     /* a square, clockwise */
        {{0, 4, 5, 1}, {0, 0, 3, 3}},         /* a parallelogram */
        {{-1, 1, 6, -5}, {5, 4, -4, -3}},     /* a general quadrilateral */
        {{-0.1, 0.1, 8, -8}, {3, 3, -3, -3}}, /* a strong trapezium */
        {{-8, 8, 0.1, -0.1}, {-3, -3, 3, 3}}, /* the other way round */
    };
    for (size_t q = 0; q < sizeof quads / sizeof quads[0]; q++) {
        const double *a = quads[q][0], *b = quads[q][1];
        FloorMap map = map_of(a, b);
        for (int i = 0; i <= 10; i++)
            for (int j = 0; j <= 10; j++) {
                double s = i / 10.0, t = j / 10.0, w[4];
                vreal found_s, found_t;
                w[0] = (1 - s) * (1 - t);
                w[1] = s * (1 - t);
                w[2] = s * t;
                w[3] = (1 - s) * t;
                double x = 0, y = 0;
                for (int c = 0; c < 4; c++) {
                    x += w[c] * a[c];
                    y += w[c] * b[c];
                }
                floor_coordinates(&map, vec3_splat((real)x, (real)y, R(0.0)), &found_s, &found_t);
                assert_true(fabs((double)lane_real(&found_s, 0) - s) < 3e-4);
                assert_true(fabs((double)lane_real(&found_t, 0) - t) < 3e-4);
            }
    }
}

TEST(texels_are_interpolated) {
    enum { WIDTH = 3, HEIGHT = 2 };
    uint texels[(WIDTH + 1) * (HEIGHT + 1) * 2];
    Picture picture = {.width = WIDTH, .height = HEIGHT, .is_clamped = 1};
    for (size_t i = 0; i < sizeof texels / sizeof *texels; i++)
        texels[i] = 0xffffffff; /* what no picture has counts nowhere */
    for (uint i = 0; i < WIDTH * HEIGHT; i++) {
        uint *texel = texels + 2 * (i / WIDTH * (WIDTH + 1) + i % WIDTH);
        texel[0] = i * 10000u | (65535u - i * 10000u) << 16;
        texel[1] = i * 5000u;
    }
    /* texel centres, then half-way between two, then beyond the border's centres */
    Vec3 c = sample_picture(&picture, texels, splat(R(0.5) / R(3.0)), splat(R(0.25)));
    CLOSE(lane_real(&c.x, 0), 0.0);
    CLOSE(lane_real(&c.y, 0), 1.0);
    c = sample_picture(&picture, texels, splat(R(2.5) / R(3.0)), splat(R(0.75)));
    CLOSE(lane_real(&c.x, 0), 50000.0 / 65535.0);
    CLOSE(lane_real(&c.z, 0), 25000.0 / 65535.0);
    c = sample_picture(&picture, texels, splat(R(1.0) / R(3.0)), splat(R(0.5)));
    CLOSE(lane_real(&c.x, 0), 20000.0 / 65535.0);
    c = sample_picture(&picture, texels, splat(R(1.0)), splat(R(1.0)));
    CLOSE(lane_real(&c.x, 0), 50000.0 / 65535.0);
    c = sample_picture(&picture, texels, splat(R(0.0)), splat(R(0.0)));
    CLOSE(lane_real(&c.x, 0), 0.0);
}

/* The direction that meets a face of normal (0, 0, 1) at an angle; lanes have angles of their own.
 */
static Vec3 falling(vreal sine) {
    vreal cosine = square_root(splat(R(1.0)) - sine * sine);
    return vec3(sine, splat(R(0.0)), -cosine);
}

static Vec3 refract_at_level(Vec3 direction, vreal relative_index, vmask *total) {
    Vec3 normal = vec3_splat(R(0.0), R(0.0), R(1.0));
    return refract(direction, normal, vec3_dot(normal, direction), relative_index, total);
}

TEST(rays_bend_by_snells_law) {
    static const double indices[] = {0.4, 0.75, 0.999, 1.001, 1.5, 2.45};
    for (int i = 0; i < 6; i++)
        for (int step = 0; step < 20; step++) {
            vmask total;
            vreal sine = ramp((real)step * R(0.04), R(0.01));
            Vec3 bent = refract_at_level(falling(sine), splat((real)indices[i]), &total);
            vreal length = vec3_dot(bent, bent);
            for (int lane = 0; lane < HD_LANES; lane++) {
                double expected = indices[i] * (double)lane_real(&sine, lane);
                assert_int_equal(lane_int(&total, lane), expected > 1.0 ? -1 : 0);
                CLOSE(lane_real(&length, lane), 1.0);
                CLOSE(lane_real(&bent.y, lane), 0.0);
                if (expected < 1.0)
                    CLOSE(lane_real(&bent.x, lane), expected);
                assert_true(lane_real(&bent.z, lane) < R(0.0));
            }
        }
}

TEST(index_one_and_upright_rays_go_straight) {
    vmask total;
    Vec3 before = falling(ramp(R(0.1), R(0.06)));
    Vec3 after = refract_at_level(before, splat(R(1.0)), &total);
    assert_false(any_lane(total));
    for (int lane = 0; lane < HD_LANES; lane++) {
        assert_true(lane_real(&after.x, lane) == lane_real(&before.x, lane));
        assert_true(lane_real(&after.z, lane) == lane_real(&before.z, lane));
    }
    after = refract_at_level(vec3_splat(R(0.0), R(0.0), R(-1.0)), ramp(R(0.5), R(0.2)), &total);
    assert_false(any_lane(total));
    for (int lane = 0; lane < HD_LANES; lane++) {
        assert_true(lane_real(&after.x, lane) == R(0.0));
        assert_true(lane_real(&after.z, lane) == R(-1.0));
    }
}

/* A direction may be longer than 1 by rounding; grazing and upright rays must not become NaN. */
TEST(refraction_survives_rounding) {
    vmask total;
    const real ulp = sizeof(real) == 4 ? R(1.1920928955078125e-7) : R(2.220446049250313e-16);
    Vec3 after = refract_at_level(vec3_splat(R(0.0), R(0.0), R(-1.0) - ulp), splat(R(2.0)), &total);
    assert_true(lane_real(&after.z, 0) == R(-1.0));
    after = refract_at_level(vec3_splat(R(1.0) + ulp, R(0.0), -ulp), splat(R(0.5)), &total);
    assert_false(any_lane(total));
    CLOSE(lane_real(&after.x, 0), 0.5);
    after = refract_at_level(vec3_splat(R(1.0) + ulp, R(0.0), -ulp), splat(R(1.5)), &total);
    assert_true(lane_int(&total, HD_LANES - 1) == -1);
    CLOSE(lane_real(&after.x, 0), 1.0);
}

/* The vector form is longer or shorter than 1 where the ray's direction is: it must not pass that
   on from face to face. */
TEST(refracted_directions_have_length_one) {
    vmask total;
    Vec3 before = vec3_scale(falling(splat(R(0.3))), splat(R(1.001)));
    Vec3 after = refract_at_level(before, splat(R(1.3)), &total);
    vreal length = vec3_dot(after, after);
    CLOSE(lane_real(&length, 0), 1.0);
}

TEST(materials_have_two_sides) {
    Material material = {.reflection = R(0.125),
                         .transmission = R(0.25),
                         .inner_reflection = R(0.5),
                         .inner_transmission = R(0.375),
                         .index_of_refraction = R(2.0),
                         .inverse_index = R(0.5)};
    vmask first = eq_int(int_ramp(0, 1), splat_int(0));
    LaneMaterial seen = splat_material(&material, first);
    for (int lane = 0; lane < HD_LANES; lane++) {
        assert_true(lane_real(&seen.reflection, lane) == (lane == 0 ? R(0.125) : R(0.5)));
        assert_true(lane_real(&seen.transmission, lane) == (lane == 0 ? R(0.25) : R(0.375)));
        assert_true(lane_real(&seen.relative_index, lane) == (lane == 0 ? R(0.5) : R(2.0)));
    }
    assert_false(any_lane(seen.lit_from_behind));
}

TEST(faces_turn_over) {
    vint numbers = int_ramp(0, 1);
    Surface surface;
    LitPoints points;
    surface.normal = vec3_splat(R(0.0), R(0.6), R(-0.8));
    surface.material = no_material();
    surface.material.diffuse = splat(R(0.5));
    surface.material.specular = splat(R(0.75));
    surface.material.transmission =
        pick(lt_int(numbers, splat_int(7)), splat(R(0.25)), splat(R(0.0)));
    surface.material.lit_from_behind = lt_int(numbers, splat_int(6));
    points.active = lt_int(numbers, splat_int(5));
    points.inside = lt_int(numbers, splat_int(2));
    turn_over(&surface, &points);
    for (int lane = 0; lane < HD_LANES; lane++) {
        assert_true(lane_real(&surface.normal.y, lane) == R(-0.6));
        assert_true(lane_real(&surface.normal.z, lane) == R(0.8));
        assert_true(lane_real(&surface.material.diffuse, lane) == (lane < 7 ? R(0.125) : R(0.0)));
        assert_true(lane_real(&surface.material.specular, lane) == R(0.0));
        assert_int_equal(lane_int(&points.active, lane), lane < 5 ? -1 : 0);
        assert_int_equal(lane_int(&points.inside, lane), lane >= 2 ? -1 : 0);
    }
    surface.material.lit_from_behind = mask_none();
    turn_over(&surface, &points);
    assert_false(any_lane(points.active));
}

TEST(falloff_ends) {
    Light light = {.inverse_falloff_squared = R(-0.25)};
    static const real squared[] = {R(0.0), R(1.0), R(2.0), R(3.0), R(4.0), R(5.0), R(1e30)};
    static const real shares[] = {R(1.0), R(0.5625), R(0.25), R(0.0625), R(0.0), R(0.0), R(0.0)};
    for (int i = 0; i < 7; i++) {
        vreal share = falloff_at(&light, splat(squared[i]));
        vmask beyond = beyond_falloff(&light, splat(squared[i]));
        assert_true(lane_real(&share, 0) == shares[i]);
        assert_true(lane_real(&share, HD_LANES - 1) == shares[i]);
        assert_int_equal(lane_int(&beyond, HD_LANES - 1), squared[i] < R(4.0) ? 0 : -1);
    }
    light.inverse_falloff_squared = R(0.25);
    vreal share = falloff_at(&light, splat(R(12.0)));
    assert_true(lane_real(&share, 0) == R(0.25));
    assert_false(any_lane(beyond_falloff(&light, splat(R(12.0)))));
    light.inverse_falloff_squared = R(0.0);
    share = falloff_at(&light, splat(R(12.0)));
    assert_true(lane_real(&share, 0) == R(1.0));
}

TEST(every_pixel_has_one_place) {
    enum { WIDTH = 21, HEIGHT = 13, BLOCKS = 3 * 2 };
    View view = {.width = WIDTH, .height = HEIGHT};
    int seen[HEIGHT][WIDTH] = {{0}};
    for (int place = 0; place < BLOCKS * HD_BLOCK_PIXELS; place++) {
        Pixel pixel = pixel_in_block(block_of_item(&view, place / HD_BLOCK_PIXELS), place);
        if (in_picture(&view, pixel))
            seen[pixel.y][pixel.x]++;
    }
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            assert_int_equal(seen[y][x], 1);
}

TEST(samples_fill_the_lanes) {
    View view = {.forward = {R(0.0), R(1.0)},
                 .right = {R(0.001)},
                 .down = {R(0.0), R(0.0), R(-0.001)},
                 .width = 8,
                 .height = 8,
                 .samples = 9,
                 .grid_side = 3,
                 .first_column = 1 - 8 * 3,
                 .first_row = 1 - 8 * 3};
    int live = 0;
    for (int first = 0; first < HD_BLOCK_PIXELS * 9; first += HD_LANES) {
        Vec3 direction;
        vmask alive = sample_directions(&view, NULL, NULL, 0, first, &direction);
        for (int lane = 0; lane < HD_LANES; lane++)
            live += lane_int(&alive, lane) != 0;
        vreal length = vec3_dot(direction, direction);
        CLOSE(lane_real(&length, 0), 1.0);
    }
    assert_int_equal(live, 64 * 9);
}

TEST(live_lanes_are_stored_side_by_side) {
    real reals[3 * HD_LANES];
    int ints[3 * HD_LANES], offset[HD_LANES];
    for (int left_out = 0; left_out <= HD_LANES; left_out++) {
        vint numbers = int_ramp(5, 1);
        vreal values = ramp(R(5.0), R(1.0));
        vmask m = ~eq_int(numbers, splat_int(5 + left_out));
        int count = lane_offsets(m, offset);
        assert_int_equal(count, HD_LANES - (left_out < HD_LANES));
        store_lanes(reals + 1, m, offset, &values);
        store_lanes_int(ints + 1, offset, &numbers);
        for (int i = 0; i < count; i++) {
            assert_int_equal(ints[1 + i], 5 + i + (i >= left_out));
            assert_true(reals[1 + i] == (real)ints[1 + i]);
        }
    }
}

TEST(numbers_are_loaded_from_anywhere) {
    real reals[HD_LANES + 1];
    int ints[HD_LANES + 1];
    for (int i = 0; i <= HD_LANES; i++) {
        reals[i] = (real)i;
        ints[i] = -i;
    }
    vreal values = load_reals(reals + 1);
    vint numbers = load_ints(ints + 1);
    for (int lane = 0; lane < HD_LANES; lane++) {
        assert_true(lane_real(&values, lane) == (real)(lane + 1));
        assert_int_equal(lane_int(&numbers, lane), -lane - 1);
    }
}

/* ---- triangles: the surface of an octahedron cut as finely as wanted, about the origin ---- */

enum { SPLITS = 3, MESH_TRIANGLES = 8 * SPLITS * SPLITS };

typedef struct MeshPoint {
    real x, y, z;
} MeshPoint;

/* The point i, j of a side's triangle, the same numbers from whichever side it is asked for. */
static MeshPoint point_of_side(int side, int i, int j) {
    int k = SPLITS - i - j;
    real length = (real)sqrt((double)(i * i + j * j + k * k));
    MeshPoint p = {(real)i / length, (real)j / length, (real)k / length};
    p.x = side & 1 ? -p.x : p.x;
    p.y = side & 2 ? -p.y : p.y;
    p.z = side & 4 ? -p.z : p.z;
    return p;
}

static int add_triangle(MeshPoint (*mesh)[3], int count, int side, MeshPoint a, MeshPoint b,
                        MeshPoint c) {
    bool is_mirrored = ((side & 1) + (side >> 1 & 1) + (side >> 2 & 1)) % 2 == 1;
    mesh[count][0] = a;
    mesh[count][1] = is_mirrored ? c : b;
    mesh[count][2] = is_mirrored ? b : c;
    return count + 1;
}

static void build_mesh(MeshPoint (*mesh)[3]) {
    int count = 0;
    for (int side = 0; side < 8; side++)
        for (int i = 0; i < SPLITS; i++)
            for (int j = 0; j < SPLITS - i; j++) {
                count = add_triangle(mesh, count, side, point_of_side(side, i, j),
                                     point_of_side(side, i + 1, j), point_of_side(side, i, j + 1));
                if (i + j < SPLITS - 1)
                    count = add_triangle(mesh, count, side, point_of_side(side, i + 1, j),
                                         point_of_side(side, i + 1, j + 1),
                                         point_of_side(side, i, j + 1));
            }
    assert_int_equal(count, MESH_TRIANGLES);
}

static Vec3 splat_point(MeshPoint p) {
    return vec3_splat(p.x, p.y, p.z);
}

/* How often each lane's ray enters and leaves in front of its origin. */
static void count_crossings(MeshPoint (*mesh)[3], Vec3 origin, Vec3 direction, vint *entered,
                            vint *left) {
    LastAxis last = nearest_axis(direction);
    origin = turn(last, origin);
    direction = turn(last, direction);
    RayFrame frame = ray_frame(origin, direction);
    Slabs slabs = ray_slabs(origin, direction, splat(R(1.0)));
    *entered = *left = splat_int(0);
    for (int i = 0; i < MESH_TRIANGLES; i++) {
        TriangleCrossing crossing;
        vmask met = cross_triangle(&frame, &slabs, mask_all(), turn(last, splat_point(mesh[i][0])),
                                   turn(last, splat_point(mesh[i][1])),
                                   turn(last, splat_point(mesh[i][2])), &crossing);
        if (!any_lane(met))
            continue;
        met = met & le(splat(R(0.0)), crossing.t);
        *entered = count_lanes(*entered, met & crossing.entering);
        *left = count_lanes(*left, met & ~crossing.entering);
    }
}

static double next_random(uint64_t *state) {
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) * 0x1p-53;
}

/* A point of an edge of the mesh: a corner, the middle, anywhere. */
static MeshPoint aim(MeshPoint (*mesh)[3], uint64_t *state) {
    const MeshPoint *triangle = mesh[(int)(next_random(state) * MESH_TRIANGLES)];
    int corner = (int)(next_random(state) * 3.0), kind = (int)(next_random(state) * 3.0);
    real share = kind == 0 ? R(0.0) : kind == 1 ? R(0.5) : (real)next_random(state);
    MeshPoint a = triangle[corner], b = triangle[(corner + 1) % 3];
    return (MeshPoint){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                       a.z + share * (b.z - a.z)};
}

/* Whether a ray along the x axis through that point certainly meets the mesh. */
static bool is_far_from_rim(MeshPoint p) {
    return p.y * p.y + p.z * p.z < R(0.4);
}

/* From within, a ray through an edge or a corner leaves exactly once. */
TEST(rays_leave_a_closed_mesh_once) {
    static MeshPoint mesh[MESH_TRIANGLES][3];
    uint64_t random = 1;
    build_mesh(mesh);
    for (int i = 0; i < 3000; i++) {
        vint entered, left;
        MeshPoint at = aim(mesh, &random);
        real inside = i % 4 == 0 ? R(0.0) : R(0.3);
        Vec3 origin = vec3(ramp(inside * (real)(next_random(&random) - 0.5), inside / 64),
                           splat(inside * (real)(next_random(&random) - 0.5)),
                           splat(inside * (real)(next_random(&random) - 0.5)));
        Vec3 direction = vec3_sub(splat_point(at), origin);
        if (is_far_from_rim(at)) { /* along an axis, where it meets a corner to the last bit */
            direction = vec3_splat(i % 2 ? R(1.0) : R(-1.0), R(0.0), R(0.0));
            origin = vec3_splat(R(0.0), at.y, at.z);
        }
        count_crossings(mesh, origin, direction, &entered, &left);
        for (int lane = 0; lane < HD_LANES; lane++) {
            assert_int_equal(lane_int(&entered, lane), 0);
            assert_int_equal(lane_int(&left, lane), 1);
        }
    }
}

/* From outside it enters as often as it leaves. The mesh is not quite convex: along its rim a ray
   may do so twice. */
TEST(rays_enter_a_closed_mesh_as_often_as_they_leave) {
    static MeshPoint mesh[MESH_TRIANGLES][3];
    uint64_t random = 2;
    int entered_in_all = 0;
    build_mesh(mesh);
    for (int i = 0; i < 3000; i++) {
        vint entered, left;
        MeshPoint at = aim(mesh, &random);
        static const double distances[] = {2.0, 100.0, 1e5, 1e9};
        double far = distances[i % 4];
        Vec3 origin = vec3(splat((real)(far * (next_random(&random) + 1.0))),
                           splat((real)(far * (next_random(&random) - 0.5))),
                           ramp((real)(far * (next_random(&random) - 0.5)), (real)(far / 64)));
        bool is_level = i % 5 == 0; /* along an axis */
        if (is_level)
            origin = vec3_splat((real)far, at.y, at.z);
        count_crossings(mesh, origin, vec3_sub(splat_point(at), origin), &entered, &left);
        if (is_level && is_far_from_rim(at))
            assert_int_equal(lane_int(&entered, 0), 1);
        for (int lane = 0; lane < HD_LANES; lane++) {
            assert_int_equal(lane_int(&entered, lane), lane_int(&left, lane));
            assert_in_range(lane_int(&entered, lane), 0, 2);
            entered_in_all += lane_int(&entered, lane);
        }
    }
    assert_in_range(entered_in_all, 1000 * HD_LANES, 3000 * HD_LANES);
}

TEST(what_filters_light_adds_up) {
    vreal share = passing_share(splat_int(0), splat_int(0));
    assert_true(lane_real(&share, 0) == R(1.0));
    share = passing_share(splat_int(3 * HD_OCTAVE), splat_int(0));
    CLOSE(lane_real(&share, 0), 0.125);
    share = passing_share(splat_int(HD_OCTAVE / 2), splat_int(0));
    CLOSE(lane_real(&share, 0), sqrt(0.5));
    share = passing_share(splat_int(HD_DARK_OCTAVES), splat_int(0));
    assert_true(lane_real(&share, 0) == R(0.0));
    for (int i = 1; i < 1000; i++) {
        share = passing_share(splat_int(i * 20011), splat_int(i * 1009));
        double octaves = i * 20011 * 0x1p-24 + i * 1009 * 0x1p-48;
        double error = (double)lane_real(&share, 0) / pow(2.0, -octaves) - 1.0;
        assert_true(fabs(error) < (HD_DOUBLE ? 1e-15 : 2.5e-7));
    }
}

TEST(pictures_repeat_or_end) {
    Picture repeats = {0, 4, 2, 0}, ends = {0, 4, 2, 1};
    uint texels[2 * 5 * 3 + 2] = {0};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 5; column++)
            texels[2 * (5 * row + column)] = (uint)(10000 * (column % 4) + 1000 * (row % 2));
    Vec3 c = sample_picture(&repeats, texels, splat(R(0.125)), splat(R(0.25)));
    CLOSE(lane_real(&c.x, 0), 0.0);
    c = sample_picture(&repeats, texels, splat(R(5.375)), splat(R(-1.25)));
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(11000.0), 1.0);
    c = sample_picture(&repeats, texels, splat(R(1.0)), splat(R(0.25))); /* between 3 and 0 */
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(15000.0), 1.0);
    c = sample_picture(&repeats, texels, splat(R(1.0625)), splat(R(0.25))); /* nearer to 0 */
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(7500.0), 1.0);
    c = sample_picture(&repeats, texels, splat(R(0.125)), splat(R(1.125)));
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(250.0), 1.0);
    c = sample_picture(&repeats, texels, splat(R(0.125) - R(1e-9)), splat(R(0.25) - R(1e-9)));
    CLOSE(lane_real(&c.x, 0), 0.0);
    c = sample_picture(&repeats, texels, splat(R(0.125)), splat(R(0.0)));
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(500.0), 1.0);
    c = sample_picture(&ends, texels, splat(R(1.0)), splat(R(1.0)));
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(31000.0), 1.0);
    c = sample_picture(&ends, texels, splat(R(-3.0)), splat(R(0.5)));
    CLOSE(lane_real(&c.x, 0) * R(65535.0) / R(500.0), 1.0);
}

/* ---- what is left out of surveyed scenes ---- */

enum { CHANNELS = 3, DEAD_LANE = 1 };
static const real channel_bounds[CHANNELS] = {R(1.0), R(2.0), R(4.0)};

typedef struct Ends {
    Header header;
    Object objects[2]; /* a solid, and all meshes */
    View view;
    vmask alive; /* all lanes but DEAD_LANE */
    Sample sample;
} Ends;

/* All numbers are sums of few powers of two, so that nothing is rounded. */
static Ends ends_below(real bound_cutoff) {
    Ends ends = {.sample = empty_sample()};
    ends.header.surveyed = 1;
    ends.header.exposure = R(2.0);
    ends.view.bound_to_fixed = R(16384.0);
    ends.view.depth = 5;
    ends.view.bound_cutoff = bound_cutoff;
    ends.alive = ~eq_int(lane_numbers(), splat_int(DEAD_LANE));
    return ends;
}

/* (lane + 1) / 4 in one channel. */
static Vec3 weights_of(int channel) {
    Vec3 weight = vec3_zero();
    vreal ramped = ramp(R(0.25), R(0.25));
    weight.x = channel == 0 ? ramped : weight.x;
    weight.y = channel == 1 ? ramped : weight.y;
    weight.z = channel == 2 ? ramped : weight.z;
    return weight;
}

static bool has_lane(vmask m, int lane) {
    vint picked = pick_int(m, splat_int(1), splat_int(0));
    return lane_int(&picked, lane) != 0;
}

/* What is over is added to the sum; the other lanes that were alive go on. */
static void expect_end(const Ends *ends, vmask going_on, int lane, double bound, bool is_over) {
    bool was_alive = lane != DEAD_LANE;
    int64_t added = was_alive && is_over ? (int64_t)(bound * 16384.0 + 1.0) : 0;
    assert_int_equal(lane_fix(&ends->sample.bound, lane), added);
    assert_int_equal(has_lane(going_on, lane), was_alive && !is_over);
}

#define NO_TABLE(type, name) const type *name = NULL;
#define ONLY_TABLES_OF(ends)                                                                       \
    HD_SCENE_TABLES(NO_TABLE) HD_FRAME_TABLES(NO_TABLE) header = &(ends)->header;                  \
    view = &(ends)->view

enum { WAYS = 3 }; /* of lanes in turn: out of the solid, into it, from the fourth mesh */
static const double seen_times[WAYS] = {1.0, 2.0, 4.0};

static vmask end_rays_of(Ends *ends, int level, int channel) {
    ONLY_TABLES_OF(ends);
    objects = ends->objects;
    ends->header.floor_end = 1;
    for (int i = 0; i < CHANNELS; i++) {
        ends->objects[0].seen_outside[i] = channel_bounds[i];
        ends->objects[0].seen_inside[i] = (real)seen_times[1] * channel_bounds[i];
        ends->objects[1].seen_outside[i] = ends->objects[1].seen_inside[i] =
            (real)seen_times[2] * channel_bounds[i];
    }
    Ray ray = eye_ray(vec3_zero(), ends->alive);
    ray.weight = weights_of(channel);
    vint inside = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++) {
        set_lane_int(&ray.touched, lane, lane % WAYS == 2 ? 4 : 0);
        set_lane_int(&inside, lane, lane % WAYS == 1);
    }
    ray.inside = eq_int(inside, splat_int(1));
    end_rays(SCENE_ARGUMENTS level, &ray, &ends->sample);
    return ray.alive;
}

/* By the greatest radiance that is seen from where a ray leaves, times the exposure; a bound that
   is the limit is not below it. */
TEST(rays_that_end_are_bounded) {
    for (int channel = 0; channel < CHANNELS; channel++) {
        double each = 0.5 * (double)channel_bounds[channel], bounds[HD_LANES];
        for (int lane = 0; lane < HD_LANES; lane++)
            bounds[lane] = each * (lane + 1) * seen_times[lane % WAYS];
        Ends ends = ends_below((real)(12.0 * each));
        vmask going_on = end_rays_of(&ends, 2, channel);
        for (int lane = 0; lane < HD_LANES; lane++)
            expect_end(&ends, going_on, lane, bounds[lane], bounds[lane] < 12.0 * each);
        ends = ends_below((real)each);
        going_on = end_rays_of(&ends, ends.view.depth, channel);
        for (int lane = 0; lane < HD_LANES; lane++)
            expect_end(&ends, going_on, lane, bounds[lane], true);
        ends = ends_below(R(0.0));
        ends.view.cutoff = R(0.5);
        going_on = end_rays_of(&ends, 2, channel);
        for (int lane = 0; lane < HD_LANES; lane++)
            expect_end(&ends, going_on, lane, bounds[lane], lane == 0);
    }
}

/* Lights in both of the surface's sides where it is lit from behind: in every second lane. */
TEST(lights_that_are_left_out_are_bounded) {
    static const double colours[CHANNELS] = {0.5, 0.25, 1.0};
    for (int channel = 0; channel < CHANNELS; channel++) {
        double arriving = 0.5 * (double)channel_bounds[channel];
        double limit = 4.0 * arriving * (0.75 * colours[channel] + 0.25);
        Ends ends = ends_below((real)limit);
        ONLY_TABLES_OF(&ends);
        for (int i = 0; i < CHANNELS; i++)
            ends.header.light_bound[i] = channel_bounds[i];
        LaneMaterial material = no_material();
        material.colour = vec3_splat(R(0.5), R(0.25), R(1.0));
        material.diffuse = splat(R(0.5));
        material.specular = splat(R(0.25));
        material.transmission = splat(R(0.5));
        material.lit_from_behind = eq_int(lane_numbers() & 1, splat_int(1));
        vmask lit =
            end_lights(SCENE_ARGUMENTS ends.alive, weights_of(channel), &material, &ends.sample);
        for (int lane = 0; lane < HD_LANES; lane++) {
            double diffuse = lane % 2 == 1 ? 0.75 : 0.5;
            double bound = arriving * (lane + 1) * (diffuse * colours[channel] + 0.25);
            expect_end(&ends, lit, lane, bound, bound < limit);
        }
    }
}
