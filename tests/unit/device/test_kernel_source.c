/* SPDX-License-Identifier: MIT */
/* Names and definitions that specialise kernels. */
#include "device/kernel_source.h"

#include <limits.h>

#include "unit_test.h"

TEST(registers_suit_the_card_and_the_scene) {
    static const struct {
        HdKernelShape shape;
        int arch, asked, expected;
    } cases[] = {
        {{0}, 90, 0, 96},
        {{0}, 70, 0, 96},
        {{0}, 69, 0, 64},
        {{0}, 61, 200, 200},
        {{.needs.many_lights = true}, 90, 0, 80},
        {{.needs.many_lights = true}, 61, 0, 64},
        {{.needs.node_stack_bound = 32}, 90, 0, 80},
        {{.needs.node_stack_bound = 32}, 61, 0, 64},
        {{.precision = HD_PRECISION_DOUBLE}, 90, 0, 128},
        {{.precision = HD_PRECISION_DOUBLE, .needs.many_lights = true}, 90, 0, 128},
        {{.precision = HD_PRECISION_DOUBLE}, 61, 0, 64},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int limit = hd_register_limit(&cases[i].shape, cases[i].arch, cases[i].asked);
        if (limit != cases[i].expected)
            fail_msg("case %zu has %d registers, expected %d", i, limit, cases[i].expected);
    }
}

TEST(each_shape_has_its_kernels) {
    static const struct {
        HdKernelShape shape;
        const char *names; /* of the kernels in their order */
    } cases[] = {
        {{0}, "hedron_render - hedron_sum_counts - - "},
        {{.wavefront = true, .first_hits = true},
         "hedron_render_by_waves - hedron_sum_counts - hedron_first_hits "},
        {{.wavefront = true, .group_size = 1},
         "hedron_trace_chunk hedron_store_batch hedron_sum_counts hedron_encode - "},
        {{.first_hits = true, .group_size = 1},
         "hedron_render - hedron_sum_counts hedron_encode hedron_first_hits "},
        {{.first_hits = true, .group_size = 1, .is_probe = true}, "hedron_probe - - - - "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char names[200] = "";
        for (int k = 0; k < HD_KERNEL_COUNT; k++) {
            const char *name = hd_kernel_name(&cases[i].shape, (HdKernel)k);
            strcat(strcat(names, name != NULL ? name : "-"), " ");
        }
        assert_string_equal(names, cases[i].names);
    }
}

TEST(scenes_of_similar_size_need_the_same) {
    HdSceneTables tables = {.plane_count = 20, .depth = 9, .bounded = true};
    const HdKernelNeeds plain = hd_kernel_needs(&tables);
    const HdKernelNeeds expected = {.plane_bound = 32, .depth_bound = 16, .bounded = true};
    assert_true(hd_kernel_needs_equal(&plain, &expected));
    tables.node_stack = 1;
    assert_int_equal(hd_kernel_needs(&tables).node_stack_bound, 32);
    tables.node_stack = 33;
    tables.plane_count = 16;
    assert_int_equal(hd_kernel_needs(&tables).node_stack_bound, 64);
    assert_int_equal(hd_kernel_needs(&tables).plane_bound, 16);
    tables.refracts = tables.lit_from_behind = true;
    assert_true(hd_kernel_needs(&tables).refracts && hd_kernel_needs(&tables).lit_from_behind);
    for (int i = 0; i < 10; i++) {
        HdKernelNeeds other = expected;
        other.plane_bound += i == 0;
        other.depth_bound += i == 1;
        other.node_stack_bound += i == 2;
        other.refracts ^= i == 3;
        other.lit_from_behind ^= i == 4;
        other.bounded ^= i == 5;
        other.many_lights ^= i == 6;
        other.small_tables ^= i == 7;
        other.cut_outs ^= i == 8;
        other.environment ^= i == 9;
        assert_false(hd_kernel_needs_equal(&expected, &other));
    }
}

TEST(needs_are_printed_in_words) {
    char text[200];
    HdKernelNeeds needs = {.plane_bound = 8, .depth_bound = 16};
    hd_kernel_needs_describe(&needs, text, sizeof text);
    assert_string_equal(text, "built for up to 8 planes and depth 16, without refraction, no faces "
                              "lit from behind, no meshes");
    needs.refracts = needs.lit_from_behind = needs.many_lights = needs.bounded = needs.cut_outs =
        needs.environment = true;
    needs.node_stack_bound = 32;
    hd_kernel_needs_describe(&needs, text, sizeof text);
    expect_contains(text, "16, with refraction, faces lit from behind, meshes, many lights, error "
                          "bounds, cut-outs, an environment");
}

/* Neighbours in the list have other values. */
TEST(all_features_of_a_shape_are_defined) {
    char text[HD_KERNEL_DEFINES_SIZE];
    const HdKernelShape shape = {.lanes = 4,
                                 .precision = HD_PRECISION_DOUBLE,
                                 .pixels_per_item = 2,
                                 .group_size = 96,
                                 .wavefront = true,
                                 .needs = {.plane_bound = 8,
                                           .depth_bound = 16,
                                           .node_stack_bound = 32,
                                           .refracts = true,
                                           .many_lights = true,
                                           .environment = true},
                                 .math = HD_MATH_FAST,
                                 .rounds_by_fma = true};
    hd_kernel_defines(&shape, text);
    assert_string_equal(text,
                        " -DHD_LANES=4 -DHD_DOUBLE=1 -DHD_PIXELS_PER_ITEM=2"
                        " -DHD_GROUP_SIZE=96 -DHD_WAVEFRONT=1 -DHD_FIRST_HITS=0"
                        " -DHD_PLANE_BOUND=8 -DHD_DEPTH_BOUND=16 -DHD_NODE_STACK=32"
                        " -DHD_WIDE_STACK=128 -DHD_REFRACTS=1 -DHD_LIT_FROM_BEHIND=0"
                        " -DHD_MANY_LIGHTS=1 -DHD_BOUNDED=0 -DHD_CUT_OUTS=0 -DHD_ENVIRONMENT=1"
                        " -DHD_SMALL_TABLES=0 -DHD_STRICT=0 -DHD_ROUNDED_BY_FMA=1 -DHD_PROBE=0");
}

TEST(blocks_cover_the_picture) {
    static const int cases[][4] = {
        {1, 1, 64, 1}, {8, 8, 64, 1},           {9, 8, 64, 2},
        {8, 9, 16, 8}, {17, 25, 1, 3 * 4 * 64}, {65536, 65536, 1, INT_MAX},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(hd_kernel_item_count(cases[i][0], cases[i][1], cases[i][2]), cases[i][3]);
}
