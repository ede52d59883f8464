/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <float.h>
#include <signal.h>

#include "hierarchy_setup.h"
#include "system/interrupt.h"

/* What is found below a child. */
typedef struct Below {
    HdBox box;
    double lowest[3], highest[3]; /* of twice the centres */
    int items, depth;
    double cost; /* expected, times the area of the box */
} Below;

typedef struct Check {
    const HdHierarchy *hierarchy;
    const HdBox *boxes;
    HdHierarchyOptions options;
    int next_node, next_item;
    unsigned char *seen;
    int empty_leaves;
    bool sorted; /* whether children must lie in order of their centres */
} Check;

static Below nothing(void) {
    Below below = {.items = 0};
    for (int axis = 0; axis < 3; axis++) {
        below.box.lower[axis] = INFINITY;
        below.box.upper[axis] = -INFINITY;
        below.lowest[axis] = HUGE_VAL;
        below.highest[axis] = -HUGE_VAL;
    }
    return below;
}

static void add(Below *below, const Below *other) {
    for (int axis = 0; axis < 3; axis++) {
        below->box.lower[axis] = fminf(below->box.lower[axis], other->box.lower[axis]);
        below->box.upper[axis] = fmaxf(below->box.upper[axis], other->box.upper[axis]);
        below->lowest[axis] = fmin(below->lowest[axis], other->lowest[axis]);
        below->highest[axis] = fmax(below->highest[axis], other->highest[axis]);
    }
    below->items += other->items;
    below->cost += other->cost;
    if (below->depth < other->depth)
        below->depth = other->depth;
}

static Below check_leaf(Check *check, int32_t child) {
    const int first = ~child >> HD_LEAF_SHIFT, count = ~child & HD_MAX_LEAF;
    Below below = nothing();
    if (count == 0) {
        check->empty_leaves++;
        return below;
    }
    assert_int_equal(first, check->next_item);
    assert_true(count <= check->options.most_in_leaf);
    check->next_item += count;
    for (int i = first; i < first + count; i++) {
        const int item = check->hierarchy->order[i];
        assert_false(check->seen[item]);
        check->seen[item] = 1;
        Below one = {.box = check->boxes[item], .items = 1};
        for (int axis = 0; axis < 3; axis++)
            one.lowest[axis] = one.highest[axis] =
                (double)one.box.lower[axis] + (double)one.box.upper[axis];
        add(&below, &one);
    }
    below.cost = half_area(&below.box) * count;
    return below;
}

static void check_order(const Check *check, const Below *left, const Below *right, int axis) {
    if (!check->sorted || right->items == 0)
        return;
    /* Sums are rounded before they are compared. */
    const double largest = fmax(fabs(right->highest[axis]), fabs(left->lowest[axis]));
    assert_true(right->highest[axis] >= left->lowest[axis]);
    assert_true(left->highest[axis] <= right->lowest[axis] + largest * 0x1p-22);
}

static Below check_node(Check *check, int number) {
    assert_int_equal(number, check->next_node);
    check->next_node++;
    const HdBuildNode *node = &check->hierarchy->nodes[number];
    Below sides[2], all = nothing();
    for (int side = 0; side < 2; side++) {
        const int32_t child = node->child[side];
        sides[side] = child >= 0 ? check_node(check, child) : check_leaf(check, child);
        assert_memory_equal(&node->box[side], &sides[side].box, sizeof(HdBox));
        add(&all, &sides[side]);
    }
    assert_in_range(node->axis, 0, 2);
    check_order(check, &sides[0], &sides[1], node->axis);
    all.depth++;
    all.cost += (double)check->options.node_cost * half_area(&all.box);
    /* Otherwise it should have been a leaf; as far as floats tell. */
    if (number > 0 && all.items <= check->options.most_in_leaf && all.depth < 60)
        assert_true(all.cost <= half_area(&all.box) * all.items * (1.0 + 1e-5) + 1e-30);
    return all;
}

/* Everything that a hierarchy is to be; returns its expected cost for a ray that meets it. */
static double check_all(const HdHierarchy *hierarchy, const HdBox *boxes, int count,
                        const HdHierarchyOptions *options, bool sorted) {
    Check check = {hierarchy, boxes, *options, 0, 0, calloc((size_t)count, 1), 0, sorted};
    const Below all = check_node(&check, 0);
    assert_int_equal(all.items, count);
    assert_int_equal(check.next_item, count);
    assert_int_equal(check.next_node, hierarchy->node_count);
    assert_int_equal(all.depth, hierarchy->depth);
    assert_true(hierarchy->depth <= HD_MAX_HIERARCHY_DEPTH);
    assert_int_equal(check.empty_leaves, hierarchy->nodes[0].child[1] == ~0 ? 1 : 0);
    free(check.seen);
    return all.cost / half_area(&all.box);
}

/* Builds and checks with the usual options. */
static HdHierarchy build_usual(const HdBox *boxes, int count) {
    HdHierarchy hierarchy = build(boxes, count, &usual);
    check_all(&hierarchy, boxes, count, &usual, true);
    return hierarchy;
}

static void expect_same(const HdHierarchy *hierarchy, const HdHierarchy *expected, int count) {
    assert_int_equal(hierarchy->depth, expected->depth);
    assert_int_equal(hierarchy->node_count, expected->node_count);
    assert_memory_equal(hierarchy->order, expected->order, (size_t)count * sizeof(int32_t));
}

TEST(any_number_of_boxes) {
    for (int count = 1; count <= 50000; count += count < 200 ? 1 : 49800) {
        const HdHierarchyOptions options = {1.0F, 1 + count % HD_MAX_LEAF};
        HdBox *boxes = random_boxes(count, count <= 200 ? 0.5 : 0.05, 1.0, (uint64_t)count);
        HdHierarchy hierarchy = build(boxes, count, &options);
        check_all(&hierarchy, boxes, count, &options, true);
        hd_hierarchy_free(&hierarchy);
        free(boxes);
    }
}

TEST(one_box_makes_a_root) {
    const HdBox box = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
    HdHierarchy hierarchy = build_usual(&box, 1);
    assert_int_equal(hierarchy.node_count, 1);
    assert_int_equal(hierarchy.nodes->child[0], ~1);
    assert_int_equal(hierarchy.nodes->child[1], ~0);
    hd_hierarchy_free(&hierarchy);
}

TEST(two_boxes_are_divided_where_it_pays) {
    /* Apart on y most; the second one is lower. */
    const HdBox boxes[2] = {{{0, 5, 0}, {1, 6, 1}}, {{1, 0, 0}, {2, 1, 1}}};
    const HdHierarchyOptions cheap = {0.1F, 4}, dear = {2.0F, 4};
    HdHierarchy hierarchy = build(boxes, 2, &cheap);
    assert_int_equal(hierarchy.nodes[0].child[0], ~(0 << HD_LEAF_SHIFT | 1));
    assert_int_equal(hierarchy.nodes[0].child[1], ~(1 << HD_LEAF_SHIFT | 1));
    assert_int_equal(hierarchy.nodes[0].axis, 1);
    assert_int_equal(hierarchy.order[0], 1);
    hd_hierarchy_free(&hierarchy);
    hierarchy = build(boxes, 2, &dear);
    assert_int_equal(hierarchy.nodes[0].child[0], ~(0 << HD_LEAF_SHIFT | 2));
    assert_int_equal(hierarchy.nodes[0].child[1], ~0);
    hd_hierarchy_free(&hierarchy);
}

TEST(same_for_any_number_of_threads) {
    enum { MANY = 60000 };
    static const int thread_counts[] = {1, 3, 8};
    HdBox *boxes = clustered_boxes(MANY);
    HdHierarchy expected = build(boxes, MANY, &usual);
    for (int i = 0; i < 3; i++) {
        HdThreadPool *other;
        HdHierarchy hierarchy;
        assert_int_equal(hd_thread_pool_create(&other, thread_counts[i], &error), HD_OK);
        assert_int_equal(hd_hierarchy_build(&hierarchy, boxes, MANY, &usual, other, &error), HD_OK);
        expect_same(&hierarchy, &expected, MANY);
        assert_memory_equal(hierarchy.nodes, expected.nodes,
                            (size_t)expected.node_count * sizeof *expected.nodes);
        hd_hierarchy_free(&hierarchy);
        hd_thread_pool_destroy(other);
    }
    hd_hierarchy_free(&expected);
    free(boxes);
}

/* ---- boxes of many kinds: what the box `i` of COUNT is ---- */

enum { COUNT = 9000 };

static void small(HdBox *box, int i) {
    uint64_t seed = (uint64_t)i * 0x9E3779B97F4A7C15U;
    for (int axis = 0; axis < 3; axis++) {
        box->lower[axis] = (float)(next_number(&seed) - next_number(&seed));
        box->upper[axis] = box->lower[axis] + 0.01F * (float)next_number(&seed);
    }
}

static void identical(HdBox *box, int i) {
    (void)i;
    *box = (HdBox){{0.1F, 0.2F, 0.3F}, {0.4F, 0.5F, 0.6F}};
}

/* Neither a box has an area, nor what holds them all. */
static void points_in_a_line(HdBox *box, int i) {
    const float y = (float)(i * 7919 % COUNT);
    *box = (HdBox){{0.5F, y, 0.25F}, {0.5F, y, 0.25F}};
}

/* From the smallest to the largest floats there are. */
static void of_all_sizes(HdBox *box, int i) {
    uint64_t seed = (uint64_t)i * 0x9E3779B97F4A7C15U;
    for (int axis = 0; axis < 3; axis++) {
        const double size = ldexp(1.0, (int)(277.0 * next_number(&seed)) - 149);
        box->lower[axis] = i == 1  ? FLT_MAX
                           : i < 3 ? -FLT_MAX
                                   : (float)(size * -next_number(&seed));
        box->upper[axis] = i == 2 ? -FLT_MAX : i < 3 ? FLT_MAX : (float)(size * next_number(&seed));
    }
}

/* Nodes that cost nothing divide everything; nodes that cost too much nothing that may stay. Flat
   boxes are without a volume, without an area, without anything. */
TEST(boxes_of_every_kind_are_divided) {
    static const struct {
        void (*fill)(HdBox *box, int i);
        HdHierarchyOptions options;
        bool sorted;
        int flat_axes, least_nodes, most_nodes, most_depth;
    } kinds[] = {
        {small, {0.0F, 15}, true, 0, COUNT - 1, COUNT - 1, 30},
        {small, {1.0F, 4}, true, 1, 1, COUNT, 30},
        {small, {1.0F, 4}, true, 6, 1, COUNT, 30},
        {small, {1.0F, 4}, true, 7, 1, COUNT, 30},
        {small, {1000.0F, 15}, true, 0, 1, COUNT / 7, 30},
        {identical, {1.0F, 4}, true, 0, 1, COUNT, 13},
        {points_in_a_line, {0.0F, 4}, true, 0, COUNT - 1, COUNT - 1, 30},
        {of_all_sizes, {1.0F, 4}, false, 0, 1, COUNT, HD_MAX_HIERARCHY_DEPTH},
    };
    HdBox *boxes = malloc(COUNT * sizeof *boxes);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (int i = 0; i < COUNT; i++) {
            kinds[k].fill(&boxes[i], i);
            for (int axis = 0; axis < 3; axis++)
                if (kinds[k].flat_axes >> axis & 1)
                    boxes[i].upper[axis] = boxes[i].lower[axis];
        }
        HdHierarchy hierarchy = build(boxes, COUNT, &kinds[k].options);
        check_all(&hierarchy, boxes, COUNT, &kinds[k].options, kinds[k].sorted);
        assert_in_range(hierarchy.node_count, kinds[k].least_nodes, kinds[k].most_nodes);
        assert_in_range(hierarchy.depth, 1, kinds[k].most_depth);
        hd_hierarchy_free(&hierarchy);
    }
    free(boxes);
}

/* The same boxes times a power of two have the same hierarchy, however large or small they are. */
TEST(scale_does_not_matter) {
    static const double scales[] = {1.0, 0x1p-100, 0x1p-40, 0x1p40, 0x1p100, 0x1p126};
    HdHierarchy expected = {0};
    for (int i = 0; i < (int)(sizeof scales / sizeof *scales); i++) {
        HdBox *boxes = random_boxes(COUNT, 0.03, scales[i], 13);
        HdHierarchy hierarchy = build_usual(boxes, COUNT);
        free(boxes);
        if (i == 0) {
            expected = hierarchy;
            continue;
        }
        expect_same(&hierarchy, &expected, COUNT);
        hd_hierarchy_free(&hierarchy);
    }
    hd_hierarchy_free(&expected);
}

TEST(depth_is_bounded) {
    HdBox boxes[DEEP_BOXES];
    fill_deep(boxes);
    const HdHierarchyOptions options = {0.0F, 1};
    HdHierarchy hierarchy = build(boxes, DEEP_BOXES, &options);
    check_all(&hierarchy, boxes, DEEP_BOXES, &options, false);
    assert_int_equal(hierarchy.depth, HD_MAX_HIERARCHY_DEPTH);
    hd_hierarchy_free(&hierarchy);
}

/* For a ray that meets them; as tried out. */
TEST(splits_are_cheap) {
    HdBox *boxes = clustered_boxes(COUNT);
    HdHierarchy hierarchy = build(boxes, COUNT, &usual);
    assert_true(check_all(&hierarchy, boxes, COUNT, &usual, true) < 11.84);
    hd_hierarchy_free(&hierarchy);
    free(boxes);
}

/* Leaves nothing where it does not succeed. */
static HdStatus build_few(void) {
    HdBox *boxes = random_boxes(6000, 0.1, 1.0, 19);
    HdHierarchy hierarchy;
    const HdStatus status = hd_hierarchy_build(&hierarchy, boxes, 6000, &usual, pool, &error);
    assert_int_equal(hierarchy.nodes != NULL, status == HD_OK);
    assert_int_equal(hierarchy.order != NULL, status == HD_OK);
    hd_hierarchy_free(&hierarchy);
    free(boxes);
    return status;
}

TEST(tells_when_memory_runs_out) {
    assert_true(fail_each(build_few) > 1);
}

/* The last one: the signal stays. */
TEST(can_be_interrupted) {
    hd_interrupt_install();
    raise(SIGTERM);
    assert_int_equal(build_few(), HD_INTERRUPTED);
}
