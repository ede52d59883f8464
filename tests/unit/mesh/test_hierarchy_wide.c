/* SPDX-License-Identifier: MIT */
#include "hierarchy_setup.h"

static HdBox box_of(const HdWideHierarchy *wide, int node, int child) {
    HdBox box;
    const float *bounds = wide->bounds + (size_t)node * 6 * (size_t)wide->width;
    for (int axis = 0; axis < 3; axis++) {
        box.lower[axis] = bounds[axis * wide->width + child];
        box.upper[axis] = bounds[(3 + axis) * wide->width + child];
    }
    return box;
}

typedef struct Check {
    const HdHierarchy *hierarchy;
    const HdWideHierarchy *wide;
    int next_node, depth;
} Check;

/* What a wide node merged. */
typedef struct Merged {
    int number, count, binary[16];     /* the binary nodes that its children come from */
    double least_opened, largest_left; /* areas */
} Merged;

/* Goes through the binary nodes that were merged, in the order of their items. */
static void check_merged(const Check *check, int node, Merged *merged) {
    const HdBuildNode *binary = &check->hierarchy->nodes[node];
    const HdWideHierarchy *wide = check->wide;
    for (int side = 0; side < 2; side++) {
        const int32_t child = binary->child[side];
        if (child == ~0)
            continue;
        const double area = half_area(&binary->box[side]);
        if (child >= 0 && wide->root_of[child] < 0) {
            merged->least_opened = fmin(merged->least_opened, area);
            check_merged(check, child, merged);
            continue;
        }
        assert_true(merged->count < wide->width);
        const HdBox box = box_of(wide, merged->number, merged->count);
        assert_memory_equal(&box, &binary->box[side], sizeof box);
        assert_int_equal(wide->child[merged->number * wide->width + merged->count],
                         child < 0 ? child : wide->root_of[child]);
        merged->binary[merged->count++] = child;
        if (child >= 0)
            merged->largest_left = fmax(merged->largest_left, area);
    }
}

/* Compares the wide node of a binary one with what it comes from, and all below. */
static void check_node(Check *check, int node, int depth) {
    const HdWideHierarchy *wide = check->wide;
    Merged merged = {.number = wide->root_of[node], .least_opened = HUGE_VAL, .largest_left = -1.0};
    assert_int_equal(merged.number, check->next_node++);
    check->depth = depth > check->depth ? depth : check->depth;
    check_merged(check, node, &merged);
    /* The largest were opened, as long as there was room. */
    assert_true(merged.least_opened >= merged.largest_left);
    assert_true(merged.count == wide->width || merged.largest_left < 0.0);
    for (int i = merged.count; i < wide->width; i++) {
        const HdBox box = box_of(wide, merged.number, i);
        assert_int_equal(wide->child[merged.number * wide->width + i], ~0);
        for (int axis = 0; axis < 3; axis++)
            assert_true(box.lower[axis] > box.upper[axis]);
    }
    for (int i = 0; i < merged.count; i++)
        if (merged.binary[i] >= 0)
            check_node(check, merged.binary[i], depth + 1);
}

static void check_widths(const HdBox *boxes, int count) {
    HdHierarchy hierarchy = build(boxes, count, &usual);
    for (int width = 2; width <= 16; width *= 2) {
        HdWideHierarchy wide;
        assert_int_equal(hd_hierarchy_widen(&wide, &hierarchy, width, &error), HD_OK);
        assert_int_equal(wide.width, width);
        assert_int_equal((uintptr_t)wide.bounds % 64, 0);
        Check check = {.hierarchy = &hierarchy, .wide = &wide};
        check_node(&check, 0, 1);
        assert_int_equal(check.depth, wide.depth);
        assert_int_equal(check.next_node, wide.node_count);
        for (int i = 0; i < hierarchy.node_count; i++)
            check.next_node -= wide.root_of[i] >= 0;
        assert_int_equal(check.next_node, 0);
        hd_wide_hierarchy_free(&wide);
    }
    hd_hierarchy_free(&hierarchy);
}

TEST(children_are_those_of_merged_nodes) {
    for (int count = 1; count <= 200; count++) {
        HdBox *boxes = random_boxes(count, 0.5, 1.0, (uint64_t)count);
        check_widths(boxes, count);
        free(boxes);
    }
    HdBox *boxes = clustered_boxes(10000);
    check_widths(boxes, 10000);
    free(boxes);
    HdBox deep[DEEP_BOXES];
    fill_deep(deep);
    check_widths(deep, DEEP_BOXES);
}

static HdHierarchy clustered;

static HdStatus widen(void) {
    HdWideHierarchy wide;
    const HdStatus status = hd_hierarchy_widen(&wide, &clustered, 8, &error);
    assert_int_equal(wide.bounds != NULL && wide.child != NULL && wide.root_of != NULL,
                     status == HD_OK);
    assert_int_equal(wide.bounds == NULL && wide.child == NULL && wide.root_of == NULL,
                     status != HD_OK);
    hd_wide_hierarchy_free(&wide);
    return status;
}

/* Two at the start, one for the boxes, and at least once it has to grow. */
TEST(tells_when_memory_runs_out) {
    HdBox *boxes = clustered_boxes(3000);
    clustered = build(boxes, 3000, &usual);
    assert_true(fail_each(widen) >= 4);
    hd_hierarchy_free(&clustered);
    free(boxes);
}
