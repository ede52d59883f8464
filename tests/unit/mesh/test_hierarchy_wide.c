/* SPDX-License-Identifier: MIT */
#include "hierarchy_setup.h"

static const int widths[] = {2, 4, 8, 16};
enum { WIDTH_COUNT = sizeof widths / sizeof *widths };

static HdWideHierarchy widen(const HdHierarchy *hierarchy, int width) {
    HdWideHierarchy wide;
    if (hd_hierarchy_widen(&wide, hierarchy, width, &error) != HD_OK)
        fail_msg("%s", error.message);
    assert_int_equal(wide.width, width);
    assert_int_equal((uintptr_t)wide.bounds % 64, 0);
    return wide;
}

static HdBox box_of(const HdWideHierarchy *wide, int node, int child) {
    HdBox box;
    const float *bounds = wide->bounds + (size_t)node * 6 * (size_t)wide->width;
    for (int axis = 0; axis < 3; axis++) {
        box.lower[axis] = bounds[axis * wide->width + child];
        box.upper[axis] = bounds[(3 + axis) * wide->width + child];
    }
    return box;
}

/* Compares a wide node with the binary node that it comes from. */
typedef struct Check {
    const HdHierarchy *hierarchy;
    const HdWideHierarchy *wide;
    int next_node;
    int matched; /* nodes of the binary hierarchy with a wide one */
    /* Of the wide node at hand: */
    int number, next_child;
    double least_opened, largest_left; /* areas */
} Check;

/* Goes through the binary nodes that were merged, in the order of their items. */
static void check_merged(Check *check, int node) {
    const HdBuildNode *binary = &check->hierarchy->nodes[node];
    for (int side = 0; side < 2; side++) {
        const int32_t child = binary->child[side];
        if (child == ~0)
            continue;
        const double area = half_area(&binary->box[side]);
        if (child >= 0 && check->wide->root_of[child] < 0) {
            check->least_opened = fmin(check->least_opened, area);
            check_merged(check, child);
            continue;
        }
        assert_true(check->next_child < check->wide->width);
        const HdBox box = box_of(check->wide, check->number, check->next_child);
        assert_memory_equal(&box, &binary->box[side], sizeof box);
        const int32_t got =
            check->wide->child[check->number * check->wide->width + check->next_child++];
        assert_int_equal(got, child < 0 ? child : check->wide->root_of[child]);
        if (child >= 0)
            check->largest_left = fmax(check->largest_left, area);
    }
}

/* Returns the depth below, this node counted. */
static int check_node(Check *check, int node) {
    const int width = check->wide->width;
    const int number = check->wide->root_of[node];
    assert_int_equal(number, check->next_node);
    check->next_node++;
    check->matched++;
    check->number = number;
    check->next_child = 0;
    check->least_opened = HUGE_VAL;
    check->largest_left = -1.0;
    check_merged(check, node);
    /* The largest were opened, as long as there was room. */
    assert_true(check->least_opened >= check->largest_left);
    assert_true(check->next_child == width || check->largest_left < 0.0);
    for (int i = check->next_child; i < width; i++) {
        const HdBox box = box_of(check->wide, number, i);
        assert_int_equal(check->wide->child[number * width + i], ~0);
        for (int axis = 0; axis < 3; axis++)
            assert_true(box.lower[axis] > box.upper[axis]);
    }
    /* Below; the binary nodes are those that the children came from. */
    int depth = 0;
    for (int i = 0; i < width; i++) {
        const int32_t child = check->wide->child[number * width + i];
        if (child < 0)
            continue;
        assert_true(child > number);
        int below = 0;
        while (check->wide->root_of[below] != child)
            below++;
        const int found = check_node(check, below);
        depth = found > depth ? found : depth;
    }
    return depth + 1;
}

static void check_all(const HdHierarchy *hierarchy, const HdWideHierarchy *wide) {
    Check check = {.hierarchy = hierarchy, .wide = wide};
    const int depth = check_node(&check, 0);
    assert_int_equal(depth, wide->depth);
    assert_int_equal(check.next_node, wide->node_count);
    int matched = 0;
    for (int i = 0; i < hierarchy->node_count; i++)
        matched += wide->root_of[i] >= 0;
    assert_int_equal(matched, check.matched);
}

static void check_widths(const HdBox *boxes, int count) {
    HdHierarchy hierarchy = build(boxes, count, &usual);
    for (int i = 0; i < WIDTH_COUNT; i++) {
        HdWideHierarchy wide = widen(&hierarchy, widths[i]);
        check_all(&hierarchy, &wide);
        hd_wide_hierarchy_free(&wide);
    }
    hd_hierarchy_free(&hierarchy);
}

TEST(few_boxes) {
    for (int count = 1; count <= 200; count++) {
        HdBox *boxes = random_boxes(count, 0.5, 1.0, (uint64_t)count);
        check_widths(boxes, count);
        free(boxes);
    }
}

TEST(many_boxes) {
    enum { COUNT = 10000 };
    HdBox *boxes = clustered_boxes(COUNT);
    check_widths(boxes, COUNT);
    free(boxes);
}

TEST(deep_hierarchies) {
    HdBox boxes[DEEP_BOXES];
    fill_deep(boxes);
    check_widths(boxes, DEEP_BOXES);
}

TEST(tells_when_memory_runs_out) {
    enum { COUNT = 3000 };
    HdBox *boxes = clustered_boxes(COUNT);
    HdHierarchy hierarchy = build(boxes, COUNT, &usual);
    int failures = 0;
    for (bool widened = false; !widened; failures++) {
        HdWideHierarchy wide;
        allocations = 0;
        failing_allocation = failures;
        const HdStatus status = hd_hierarchy_widen(&wide, &hierarchy, 8, &error);
        failing_allocation = -1;
        widened = status == HD_OK;
        if (!widened) {
            assert_int_equal(status, HD_FAILED);
            expect_contains(error.message, "out of memory");
            assert_null(wide.bounds);
            assert_null(wide.child);
            assert_null(wide.root_of);
        }
        hd_wide_hierarchy_free(&wide);
    }
    /* Two at the start, one for the boxes, and at least once it had to grow. */
    assert_true(failures - 1 >= 4);
    hd_hierarchy_free(&hierarchy);
    free(boxes);
}
