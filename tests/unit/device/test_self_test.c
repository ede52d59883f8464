/* SPDX-License-Identifier: MIT */
#include "device/self_test.h"

#include "unit_test.h"

static HdError error;

static bool passes(const HdDevice *device, int lanes, HdPrecision precision, bool refracts,
                   bool lit_from_behind) {
    HdRenderOptions options = {.lanes = lanes, .threads = 1, .precision = precision};
    void *renderer;
    assert_int_equal(hd_backend_c.functions->open(device, &options, &renderer, &error), HD_OK);
    HdSceneTables like = {.precision = precision,
                          .lanes = hd_backend_c.functions->lanes(renderer),
                          .node_stack = 1,
                          .refracts = refracts,
                          .lit_from_behind = lit_from_behind};
    HdSelfTestFrame frame;
    bool is_wrong;
    HdStatus status =
        hd_self_test(&hd_backend_c, renderer, device, &like, &frame, &is_wrong, &error);
    assert_int_equal(is_wrong, status == HD_UNAVAILABLE);
    hd_backend_c.functions->close(renderer);
    if (status != HD_OK)
        print_error("precision %d, refraction %d, light from behind %d, %d lanes: %s\n",
                    (int)precision, refracts, lit_from_behind, lanes, error.message);
    return status == HD_OK;
}

/* Every frame that fails is told, for what it tells is what to commit where kernels changed. */
TEST(the_c_backend_passes) {
    static const int lanes[] = {0, 1, 4, 8, 16};
    HdDevice device;
    int count, failed = 0;
    assert_int_equal(hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error), HD_OK);
    for (int i = 0; i < 8; i++) {
        HdPrecision precision = i < 4 ? HD_PRECISION_FLOAT : HD_PRECISION_DOUBLE;
        for (int k = 0; k < 5 && lanes[k] <= device.most_lanes[precision]; k++)
            failed += !passes(&device, lanes[k], precision, (i & 2) != 0, (i & 1) != 0);
    }
    assert_int_equal(failed, 0);
}

/* Kernels that can search meshes pass one more frame than those with the same other needs. */
TEST(the_stamp_names_each_frame) {
    char stamps[16][160];
    for (int i = 0; i < 16; i++) {
        const HdKernelShape shape = {.precision = i < 8 ? HD_PRECISION_FLOAT : HD_PRECISION_DOUBLE,
                                     .needs = {.refracts = (i & 4) != 0,
                                               .lit_from_behind = (i & 2) != 0,
                                               .node_stack_bound = i % 2 * 32}};
        hd_self_test_stamp(&shape, stamps[i], sizeof stamps[i]);
        for (int k = i % 2; k < i; k += 2)
            assert_string_not_equal(i % 2 == 0 ? stamps[k] : strrchr(stamps[k], ','),
                                    i % 2 == 0 ? stamps[i] : strrchr(stamps[i], ','));
        if (i % 2 == 1)
            assert_memory_equal(stamps[i], stamps[i - 1], strlen(stamps[i - 1]) - 1);
    }
}
