/* SPDX-License-Identifier: MIT */
#include "device/self_test.h"

#include "device/self_test_scenes.h"
#include "input/check.h"
#include "kernels/host/shared.h"
#include "unit_test.h"

static HdError error;

static HdDevice c_device(void) {
    HdDevice device;
    int count;
    assert_int_equal(hd_backend_enumerate(&hd_backend_c, &device, 1, &count, &error), HD_OK);
    return device;
}

static bool passes(int lanes, HdPrecision precision, bool refracts, bool lit_from_behind) {
    HdDevice device = c_device();
    HdRenderOptions options = {.lanes = lanes, .threads = 1, .precision = precision};
    void *renderer;
    assert_int_equal(hd_backend_c.functions->open(&device, &options, &renderer, &error), HD_OK);
    HdSceneTables like = {.precision = precision,
                          .lanes = hd_backend_c.functions->lanes(renderer),
                          .node_stack = 1,
                          .refracts = refracts,
                          .lit_from_behind = lit_from_behind};
    HdSelfTestFrame frame;
    bool is_wrong;
    HdStatus status =
        hd_self_test(&hd_backend_c, renderer, &device, &like, &frame, &is_wrong, &error);
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
    const HdDevice device = c_device();
    int failed = 0;
    for (int i = 0; i < 8; i++) {
        HdPrecision precision = i < 4 ? HD_PRECISION_FLOAT : HD_PRECISION_DOUBLE;
        for (int k = 0; k < 5 && lanes[k] <= device.most_lanes[precision]; k++)
            failed += !passes(lanes[k], precision, (i & 2) != 0, (i & 1) != 0);
    }
    assert_int_equal(failed, 0);
}

/* Over each mesh and all of them there is a hierarchy, with nodes for rays alone. */
TEST(frames_are_valid_and_fit_every_build) {
    for (int i = 0; i < 4 * HD_SELF_TEST_FRAMES; i++) {
        const HdSelfTestFrame frame = (HdSelfTestFrame)(i / 4);
        const bool is_mesh = frame == HD_SELF_TEST_MESH;
        HdScene scene;
        HdSceneTables tables;
        assert_int_equal(hd_self_test_scene(&scene, frame, (i & 2) != 0, (i & 1) != 0, &error),
                         HD_OK);
        assert_int_equal(hd_scene_validate(&scene, &error), HD_OK);
        assert_int_equal(hd_compile_scene(&tables, &scene, HD_PRECISION_FLOAT, 4, &error), HD_OK);
        assert_true(tables.plane_count <= hd_kernel_bound(0));
        assert_true(tables.depth <= hd_kernel_bound(0));
        if (frame != HD_SELF_TEST_FLOOR) {
            assert_int_equal(tables.refracts, (i & 2) != 0);
            assert_int_equal(tables.lit_from_behind, (i & 1) != 0);
        }
        assert_int_equal(tables.node_stack > 1, is_mesh);
        assert_int_equal(tables.table[HD_TABLE_wide_children].bytes > 0, is_mesh);
        if (is_mesh)
            assert_int_equal(tables.table[HD_TABLE_top_items].bytes,
                             (size_t)scene.instance_count * sizeof(int32_t));
        HdSceneTables shallow = tables;
        shallow.node_stack = is_mesh;
        HdKernelNeeds needs = hd_kernel_needs(&tables), least = hd_kernel_needs(&shallow);
        assert_true(hd_kernel_needs_equal(&needs, &least));
        hd_scene_tables_free(&tables);
        hd_scene_free(&scene);
    }
}

static void write_stamp(int variant, int node_stack_bound, char stamp[160]) {
    HdKernelShape shape = {.precision = variant < 4 ? HD_PRECISION_FLOAT : HD_PRECISION_DOUBLE,
                           .needs = {.node_stack_bound = node_stack_bound,
                                     .refracts = (variant & 2) != 0,
                                     .lit_from_behind = variant & 1}};
    hd_self_test_stamp(&shape, stamp, 160);
}

/* What the frames are to find must change them; kernels that can search meshes must pass a third
   one, and their entries say so. */
TEST(the_stamp_names_each_frame) {
    char stamps[8][160], mesh_stamps[8][160];
    for (int i = 0; i < 8; i++) {
        write_stamp(i, 0, stamps[i]);
        write_stamp(i, 32, mesh_stamps[i]);
        const size_t shorter = strlen(stamps[i]) - 1;
        assert_int_equal(stamps[i][shorter], ')');
        assert_memory_equal(mesh_stamps[i], stamps[i], shorter);
        assert_int_equal(strlen(mesh_stamps[i]), shorter + strlen(", 0123456789abcdef)"));
        for (int k = 0; k < i; k++) {
            assert_string_not_equal(stamps[k], stamps[i]);
            assert_string_not_equal(strrchr(mesh_stamps[k], ','), strrchr(mesh_stamps[i], ','));
        }
    }
}
