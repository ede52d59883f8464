/* SPDX-License-Identifier: MIT */
/* What kernels are called and specialised by. */
#include "device/kernel_source.h"

#include <limits.h>

#include "unit_test.h"

TEST(registers_suit_the_card_and_the_block) {
    static const struct {
        HdPrecision precision;
        int group_size, arch, asked, expected;
    } cases[] = {{HD_PRECISION_FLOAT, 128, 90, 0, 128},   {HD_PRECISION_FLOAT, 128, 70, 0, 128},
                 {HD_PRECISION_FLOAT, 128, 69, 0, 64},    {HD_PRECISION_DOUBLE, 128, 90, 0, 128},
                 {HD_PRECISION_FLOAT, 512, 90, 0, 128},   {HD_PRECISION_FLOAT, 544, 90, 0, 120},
                 {HD_PRECISION_FLOAT, 1024, 90, 0, 64},   {HD_PRECISION_DOUBLE, 1024, 61, 0, 64},
                 {HD_PRECISION_FLOAT, 128, 61, 200, 200}, {HD_PRECISION_FLOAT, 1024, 90, 255, 255}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdKernelShape shape = {.precision = cases[i].precision,
                                     .group_size = cases[i].group_size};
        assert_int_equal(hd_register_limit(&shape, cases[i].arch, cases[i].asked),
                         cases[i].expected);
    }
}

TEST(registers_suit_many_lights_meshes_and_every_block) {
    HdKernelShape shape = {.group_size = 128};
    assert_int_equal(hd_register_limit(&shape, 61, 0), 64);
    assert_int_equal(hd_register_limit(&shape, 70, 0), 128);
    assert_int_equal(hd_register_limit(&shape, 90, 0), 128);
    assert_int_equal(hd_register_limit(&shape, 90, 96), 96);
    shape.needs.many_lights = true;
    assert_int_equal(hd_register_limit(&shape, 61, 0), 64);
    assert_int_equal(hd_register_limit(&shape, 90, 0), 96);
    shape.precision = HD_PRECISION_DOUBLE;
    assert_int_equal(hd_register_limit(&shape, 61, 0), 64);
    assert_int_equal(hd_register_limit(&shape, 90, 0), 128);
    shape.needs.many_lights = false;
    assert_int_equal(hd_register_limit(&shape, 90, 0), 128);
    shape.precision = HD_PRECISION_FLOAT;
    shape.needs.node_stack_bound = 32;
    assert_int_equal(hd_register_limit(&shape, 61, 0), 64);
    assert_int_equal(hd_register_limit(&shape, 90, 0), 96);
    shape.needs.node_stack_bound = 0;
    /* All threads of a block must find room. */
    shape.precision = HD_PRECISION_FLOAT;
    for (shape.group_size = HD_BLOCK_STEP; shape.group_size <= HD_MAX_BLOCK;
         shape.group_size += HD_BLOCK_STEP) {
        int limit = hd_register_limit(&shape, 90, 0);
        assert_true(limit >= 64 && limit <= 128 && limit % 8 == 0);
        assert_true(limit * shape.group_size <= 65536);
    }
}

static void expect_names(const HdKernelShape *shape, const char *const names[HD_KERNEL_COUNT]) {
    for (int i = 0; i < HD_KERNEL_COUNT; i++) {
        const char *name = hd_kernel_name(shape, (HdKernel)i);
        assert_true((name == NULL) == (names[i] == NULL));
        if (name != NULL)
            assert_string_equal(name, names[i]);
    }
}

TEST(each_shape_has_its_kernels) {
    HdKernelShape shape = {0};
    expect_names(&shape,
                 (const char *const[]){"hedron_render", NULL, "hedron_sum_counts", NULL, NULL});
    shape.wavefront = shape.first_hits = true;
    expect_names(&shape, (const char *const[]){"hedron_render_by_waves", NULL, "hedron_sum_counts",
                                               NULL, "hedron_first_hits"});
    shape.group_size = 1;
    expect_names(&shape,
                 (const char *const[]){"hedron_trace_take", "hedron_store_batch",
                                       "hedron_sum_counts", "hedron_encode", "hedron_first_hits"});
    shape.wavefront = false;
    expect_names(&shape, (const char *const[]){"hedron_render", NULL, "hedron_sum_counts",
                                               "hedron_encode", "hedron_first_hits"});
    shape.is_probe = true;
    expect_names(&shape, (const char *const[]){"hedron_probe", NULL, NULL, NULL, NULL});
}

TEST(bounds_are_powers_of_two) {
    static const int counts[][2] = {{0, 8}, {8, 8}, {9, 16}, {16, 16}, {17, 32}, {1000, 1024}};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        assert_int_equal(hd_kernel_bound(counts[i][0]), counts[i][1]);
}

TEST(scenes_of_similar_size_need_the_same) {
    HdSceneTables tables = {.plane_count = 20, .depth = 9, .surveyed = true};
    const HdKernelNeeds plain = hd_kernel_needs(&tables);
    const HdKernelNeeds expected = {.plane_bound = 32, .depth_bound = 16, .surveyed = true};
    assert_true(hd_kernel_needs_equal(&plain, &expected));
    tables.node_stack = 1;
    assert_int_equal(hd_kernel_needs(&tables).node_stack_bound, 32);
    tables.node_stack = 33;
    assert_int_equal(hd_kernel_needs(&tables).node_stack_bound, 64);
    tables.refracts = tables.lit_from_behind = true;
    assert_true(hd_kernel_needs(&tables).refracts && hd_kernel_needs(&tables).lit_from_behind);
    for (int i = 0; i < 8; i++) {
        HdKernelNeeds other = expected;
        other.plane_bound += i == 0;
        other.depth_bound += i == 1;
        other.node_stack_bound += i == 2;
        other.refracts ^= i == 3;
        other.lit_from_behind ^= i == 4;
        other.surveyed ^= i == 5;
        other.many_lights ^= i == 6;
        other.small_tables ^= i == 7;
        assert_false(hd_kernel_needs_equal(&expected, &other));
    }
}

TEST(needs_are_told_in_words) {
    char text[200];
    HdKernelNeeds needs = {.plane_bound = 8, .depth_bound = 16};
    hd_kernel_needs_describe(&needs, text, sizeof text);
    assert_string_equal(text, "built for up to 8 planes and depth 16, without refraction, no faces "
                              "lit from behind, no meshes");
    needs.refracts = needs.lit_from_behind = needs.many_lights = needs.surveyed = true;
    needs.node_stack_bound = 32;
    hd_kernel_needs_describe(&needs, text, sizeof text);
    assert_string_equal(text, "built for up to 8 planes and depth 16, with refraction, faces lit "
                              "from behind, meshes, many lights, with surveys");
}

TEST(whatever_a_shape_has_is_defined) {
    char text[HD_KERNEL_DEFINES_SIZE];
    HdKernelShape shape = {.lanes = 4,
                           .pixels_per_item = 2,
                           .group_size = 96,
                           .needs = {.plane_bound = 8, .depth_bound = 16, .node_stack_bound = 32},
                           .precision = HD_PRECISION_DOUBLE,
                           .math = HD_MATH_FAST};
    hd_kernel_defines(&shape, text);
    assert_string_equal(text, " -DHD_LANES=4 -DHD_DOUBLE=1 -DHD_PIXELS_PER_ITEM=2"
                              " -DHD_GROUP_SIZE=96 -DHD_WAVEFRONT=0 -DHD_FIRST_HITS=0"
                              " -DHD_PLANE_BOUND=8 -DHD_DEPTH_BOUND=16 -DHD_NODE_STACK=32"
                              " -DHD_WIDE_STACK=128 -DHD_REFRACTS=0 -DHD_LIT_FROM_BEHIND=0"
                              " -DHD_MANY_LIGHTS=0 -DHD_SURVEYED=0 -DHD_SMALL_TABLES=0"
                              " -DHD_STRICT=0 -DHD_ROUNDED_BY_FMA=0 -DHD_PROBE=0");
    shape.wavefront = shape.first_hits = shape.rounds_by_fma = shape.is_probe = true;
    shape.needs.refracts = shape.needs.lit_from_behind = true;
    shape.needs.many_lights = shape.needs.surveyed = shape.needs.small_tables = true;
    shape.precision = HD_PRECISION_FLOAT;
    shape.math = HD_MATH_STRICT;
    hd_kernel_defines(&shape, text);
    assert_string_equal(text, " -DHD_LANES=4 -DHD_DOUBLE=0 -DHD_PIXELS_PER_ITEM=2"
                              " -DHD_GROUP_SIZE=96 -DHD_WAVEFRONT=1 -DHD_FIRST_HITS=1"
                              " -DHD_PLANE_BOUND=8 -DHD_DEPTH_BOUND=16 -DHD_NODE_STACK=32"
                              " -DHD_WIDE_STACK=128 -DHD_REFRACTS=1 -DHD_LIT_FROM_BEHIND=1"
                              " -DHD_MANY_LIGHTS=1 -DHD_SURVEYED=1 -DHD_SMALL_TABLES=1"
                              " -DHD_STRICT=1 -DHD_ROUNDED_BY_FMA=1 -DHD_PROBE=1");
}

TEST(blocks_cover_the_picture) {
    assert_int_equal(hd_kernel_item_count(1, 1, 64), 1);
    assert_int_equal(hd_kernel_item_count(8, 8, 64), 1);
    assert_int_equal(hd_kernel_item_count(9, 8, 64), 2);
    assert_int_equal(hd_kernel_item_count(8, 9, 16), 8);
    assert_int_equal(hd_kernel_item_count(17, 25, 1), 3 * 4 * 64);
    assert_int_equal(hd_kernel_item_count(65536, 65536, 1), INT_MAX);
}
