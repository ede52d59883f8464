/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include <float.h>
#include <signal.h>
#include <stdlib.h>

#include "mesh/hierarchy.h"
#include "system/interrupt.h"
#include "system/machine.h"
#include "unit_test.h"
#include "wrapped.h"

static HdError error;
static HdThreadPool *pool;

/* The allocation with this number fails. -1: none. */
static int failing_allocation = -1, allocations;

static void *allocate_or_fail(size_t bytes) {
    if (allocations++ == failing_allocation)
        return NULL;
    return aligned_alloc(64, (bytes + 63) / 64 * 64);
}
REPLACE(hd_large_allocate, allocate_or_fail)

static int start_pool(void **state) {
    (void)state;
    return hd_thread_pool_create(&pool, 2, &error) != HD_OK;
}

static int end_pool(void **state) {
    (void)state;
    hd_thread_pool_destroy(pool);
    return 0;
}
GROUP(start_pool, end_pool)

static double half_area(const HdBox *box) {
    const double x = (double)box->upper[0] - (double)box->lower[0];
    const double y = (double)box->upper[1] - (double)box->lower[1];
    const double z = (double)box->upper[2] - (double)box->lower[2];
    return x * (y + z) + y * z;
}

/* Returns the next of a fixed sequence of numbers, from 0 to below 1. */
static double next_number(uint64_t *state) {
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 40) * 0x1p-24;
}

/* ---- boxes of many kinds ---- */

enum { MANY = 60000, COUNT = 9000, DEEP = 17 * 6 };
static HdBox boxes[MANY];

/* `fill` makes box number i. */
typedef struct Kind {
    void (*fill)(HdBox *box, int i);
    int count;
    HdHierarchyOptions options;
    int flat_axes;    /* bits */
    bool is_unsorted; /* children are not in order of their centres */
} Kind;

static HdStatus try_to_build(HdHierarchy *hierarchy, const Kind *kind, HdThreadPool *threads) {
    for (int i = 0; i < kind->count; i++) {
        kind->fill(&boxes[i], i);
        for (int axis = 0; axis < 3; axis++)
            if (kind->flat_axes >> axis & 1)
                boxes[i].upper[axis] = boxes[i].lower[axis];
    }
    return hd_hierarchy_build(hierarchy, boxes, kind->count, &kind->options, threads, &error);
}

static void small(HdBox *box, int i) {
    uint64_t seed = (uint64_t)i * 0x9E3779B97F4A7C15U;
    for (int axis = 0; axis < 3; axis++) {
        box->lower[axis] = (float)(next_number(&seed) - next_number(&seed));
        box->upper[axis] = box->lower[axis] + 0.01F * (float)next_number(&seed);
    }
}

/* In few dense places of very different sizes. */
static void clustered(HdBox *box, int i) {
    const int cluster = i % 7;
    const double spread = pow(0.2, cluster);
    uint64_t of_cluster = (uint64_t)(cluster + 1) * 0x9E3779B97F4A7C15U;
    uint64_t seed = (uint64_t)(i + 1) * 0x9E3779B97F4A7C15U;
    for (int axis = 0; axis < 3; axis++) {
        const double centre = 2.0 * next_number(&of_cluster) - 1.0;
        const double at = centre + spread * (next_number(&seed) - 0.5);
        box->lower[axis] = (float)at;
        box->upper[axis] = (float)(at + 0.05 * spread * next_number(&seed));
    }
}

static void identical(HdBox *box, int i) {
    (void)i;
    *box = (HdBox){{0.1F, 0.2F, 0.3F}, {0.4F, 0.5F, 0.6F}};
}

/* Neither a box nor their union has an area. */
static void points_in_a_line(HdBox *box, int i) {
    const float y = (float)(i * 7919 % COUNT);
    *box = (HdBox){{0.5F, y, 0.25F}, {0.5F, y, 0.25F}};
}

/* From the smallest to the largest floats. */
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

/* Points on the axes, each 64 times nearer to the origin than the last. The outermost point has a
   bin of its own and all others share one, so that each split removes one point. */
static void deep(HdBox *box, int i) {
    *box = (HdBox){{0}, {0}};
    box->lower[i % 6 / 2] = box->upper[i % 6 / 2] = ldexpf(i % 2 == 0 ? 1.0F : -1.0F, -6 * (i / 6));
}

/* ---- requirements on a hierarchy ---- */

/* The contents below a child. */
typedef struct Below {
    HdBox box;
    double lowest[3], highest[3]; /* bounds of twice the centres */
    int items, depth;
    double cost; /* expected cost, times the area of the box */
} Below;

typedef struct Check {
    const HdHierarchy *hierarchy;
    const Kind *kind;
    int next_node, next_item, empty_leaves;
    bool seen[MANY];
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
    assert_true(count <= check->kind->options.max_in_leaf);
    check->next_item += count;
    for (int i = first; i < first + count; i++) {
        const int item = check->hierarchy->order[i];
        assert_false(check->seen[item]);
        check->seen[item] = true;
        Below one = {.box = boxes[item], .items = 1};
        for (int axis = 0; axis < 3; axis++)
            one.lowest[axis] = one.highest[axis] =
                (double)one.box.lower[axis] + (double)one.box.upper[axis];
        add(&below, &one);
    }
    below.cost = half_area(&below.box) * count;
    return below;
}

static void check_order(const Check *check, const Below *left, const Below *right, int axis) {
    if (check->kind->is_unsorted || right->items == 0)
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
    all.cost += (double)check->kind->options.node_cost * half_area(&all.box);
    /* Otherwise it should have been a leaf; within float accuracy. */
    if (number > 0 && all.items <= check->kind->options.max_in_leaf && all.depth < 60)
        assert_true(all.cost <= half_area(&all.box) * all.items * (1.0 + 1e-5) + 1e-30);
    return all;
}

/* ---- requirements on a wide one ---- */

static HdBox box_of(const HdWideHierarchy *wide, int node, int child) {
    HdBox box;
    const float *bounds = wide->bounds + (size_t)node * 6 * (size_t)wide->width;
    for (int axis = 0; axis < 3; axis++) {
        box.lower[axis] = bounds[axis * wide->width + child];
        box.upper[axis] = bounds[(3 + axis) * wide->width + child];
    }
    return box;
}

typedef struct WideCheck {
    const HdHierarchy *hierarchy;
    const HdWideHierarchy *wide;
    int next_node, depth;
} WideCheck;

/* The nodes that a wide node merged. */
typedef struct Merged {
    int number, count, binary[16];   /* the binary nodes that its children come from */
    double min_opened, largest_left; /* areas */
} Merged;

/* Visits the merged binary nodes, in the order of their items. */
static void check_merged(const WideCheck *check, int node, Merged *merged) {
    const HdBuildNode *binary = &check->hierarchy->nodes[node];
    const HdWideHierarchy *wide = check->wide;
    for (int side = 0; side < 2; side++) {
        const int32_t child = binary->child[side];
        if (child == ~0)
            continue;
        const double area = half_area(&binary->box[side]);
        if (child >= 0 && wide->root_of[child] < 0) {
            merged->min_opened = fmin(merged->min_opened, area);
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

/* Compares a wide node with the binary node that it comes from, and all below. */
static void check_wide(WideCheck *check, int node, int depth) {
    const HdWideHierarchy *wide = check->wide;
    Merged merged = {.number = wide->root_of[node], .min_opened = HUGE_VAL, .largest_left = -1.0};
    assert_int_equal(merged.number, check->next_node++);
    check->depth = depth > check->depth ? depth : check->depth;
    check_merged(check, node, &merged);
    /* The largest were opened, while there was space. */
    assert_true(merged.min_opened >= merged.largest_left);
    assert_true(merged.count == wide->width || merged.largest_left < 0.0);
    for (int i = merged.count; i < wide->width; i++) {
        const HdBox box = box_of(wide, merged.number, i);
        assert_int_equal(wide->child[merged.number * wide->width + i], ~0);
        for (int axis = 0; axis < 3; axis++)
            assert_true(box.lower[axis] > box.upper[axis]);
    }
    for (int i = 0; i < merged.count; i++)
        if (merged.binary[i] >= 0)
            check_wide(check, merged.binary[i], depth + 1);
}

static void check_widths(const HdHierarchy *hierarchy) {
    for (int width = 2; width <= 16; width *= 2) {
        HdWideHierarchy wide;
        assert_int_equal(hd_hierarchy_widen(&wide, hierarchy, width, &error), HD_OK);
        assert_int_equal(wide.width, width);
        assert_int_equal((uintptr_t)wide.bounds % 64, 0);
        WideCheck check = {.hierarchy = hierarchy, .wide = &wide};
        check_wide(&check, 0, 1);
        assert_int_equal(check.depth, wide.depth);
        assert_int_equal(check.next_node, wide.node_count);
        for (int i = 0; i < hierarchy->node_count; i++)
            check.next_node -= wide.root_of[i] >= 0;
        assert_int_equal(check.next_node, 0);
        hd_wide_hierarchy_free(&wide);
    }
}

/* Builds a hierarchy and wide ones of it, and checks all requirements; `*cost` is the expected cost
   of a ray that hits it. */
static HdHierarchy build(const Kind *kind, double *cost) {
    static Check check;
    HdHierarchy hierarchy;
    if (try_to_build(&hierarchy, kind, pool) != HD_OK)
        fail_msg("%s", error.message);
    check = (Check){.hierarchy = &hierarchy, .kind = kind};
    const Below all = check_node(&check, 0);
    assert_int_equal(all.items, kind->count);
    assert_int_equal(check.next_item, kind->count);
    assert_int_equal(check.next_node, hierarchy.node_count);
    assert_int_equal(all.depth, hierarchy.depth);
    assert_true(hierarchy.depth <= HD_MAX_HIERARCHY_DEPTH);
    assert_int_equal(check.empty_leaves, hierarchy.nodes[0].child[1] == ~0 ? 1 : 0);
    check_widths(&hierarchy);
    *cost = all.cost / half_area(&all.box);
    return hierarchy;
}

/* Nodes of no cost divide everything; nodes of too high a cost divide only what must be. Flat boxes
   have no volume, no area, or nothing. */
TEST(boxes_of_every_kind_are_divided) {
    enum { DEEPEST = HD_MAX_HIERARCHY_DEPTH };
    static const struct {
        Kind kind;
        int min_nodes, max_nodes, min_depth, max_depth;
        double max_cost; /* found by experiment */
    } cases[] = {
        {{small, COUNT, {0.0F, 15}, 0, false}, COUNT - 1, COUNT - 1, 1, 30, 0.0577},
        {{small, COUNT, {1.0F, 4}, 1, false}, 1, COUNT, 1, 30, 38.9},
        {{small, COUNT, {1.0F, 4}, 6, false}, 1, COUNT, 1, 30, 38.1},
        {{small, COUNT, {1.0F, 4}, 7, false}, 1, COUNT, 1, 30, 37.7},
        {{small, COUNT, {1000.0F, 15}, 0, false}, 1, COUNT / 7, 1, 30, 1e9},
        {{identical, COUNT, {1.0F, 4}, 0, false}, 1, COUNT, 1, 13, 1e9},
        {{points_in_a_line, COUNT, {0.0F, 4}, 0, false}, COUNT - 1, COUNT - 1, 1, 30, 1e9},
        {{of_all_sizes, COUNT, {1.0F, 4}, 0, true}, 1, COUNT, 1, DEEPEST, 67.9},
        {{clustered, COUNT, {1.0F, 4}, 0, false}, 1, COUNT, 1, 30, 10.82},
        {{deep, DEEP, {0.0F, 1}, 0, true}, 1, COUNT, DEEPEST, DEEPEST, 1e9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double cost;
        HdHierarchy hierarchy = build(&cases[i].kind, &cost);
        assert_in_range(hierarchy.node_count, cases[i].min_nodes, cases[i].max_nodes);
        assert_in_range(hierarchy.depth, cases[i].min_depth, cases[i].max_depth);
        if (cost > cases[i].max_cost)
            fail_msg("the cost of case %zu is %g", i, cost);
        hd_hierarchy_free(&hierarchy);
    }
}

TEST(any_number_of_boxes_works) {
    for (int count = 1; count <= 200; count++) {
        double cost;
        const Kind kind = {small, count, {1.0F, 1 + count % HD_MAX_LEAF}, 0, false};
        HdHierarchy hierarchy = build(&kind, &cost);
        hd_hierarchy_free(&hierarchy);
    }
}

TEST(same_for_any_number_of_threads) {
    static const Kind kind = {clustered, MANY, {1.0F, 4}, 0, false};
    double cost;
    HdHierarchy expected = build(&kind, &cost);
    for (int threads = 1; threads <= 3; threads += 2) {
        HdThreadPool *other;
        HdHierarchy hierarchy;
        assert_int_equal(hd_thread_pool_create(&other, threads, &error), HD_OK);
        assert_int_equal(try_to_build(&hierarchy, &kind, other), HD_OK);
        assert_int_equal(hierarchy.depth, expected.depth);
        assert_int_equal(hierarchy.node_count, expected.node_count);
        assert_memory_equal(hierarchy.order, expected.order, MANY * sizeof(int32_t));
        assert_memory_equal(hierarchy.nodes, expected.nodes,
                            (size_t)expected.node_count * sizeof *expected.nodes);
        hd_hierarchy_free(&hierarchy);
        hd_thread_pool_destroy(other);
    }
    hd_hierarchy_free(&expected);
}

/* Leaves nothing if it fails. */
static HdStatus build_few(void) {
    static const Kind kind = {small, 6000, {1.0F, 4}, 0, false};
    HdHierarchy hierarchy;
    HdWideHierarchy wide = {0};
    HdStatus status = try_to_build(&hierarchy, &kind, pool);
    assert_int_equal(hierarchy.nodes != NULL, status == HD_OK);
    assert_int_equal(hierarchy.order != NULL, status == HD_OK);
    if (status == HD_OK) {
        status = hd_hierarchy_widen(&wide, &hierarchy, 8, &error);
        assert_int_equal(wide.bounds != NULL, status == HD_OK);
        assert_int_equal(wide.child != NULL, status == HD_OK);
        assert_int_equal(wide.root_of != NULL, status == HD_OK);
    }
    hd_wide_hierarchy_free(&wide);
    hd_hierarchy_free(&hierarchy);
    return status;
}

/* Each allocation fails in turn, until all succeed. Widening allocates twice at the start, once for
   the boxes, and at least once to grow. */
TEST(a_lack_of_memory_is_an_error) {
    HdStatus status = HD_FAILED;
    for (failing_allocation = 0; status != HD_OK; failing_allocation++) {
        allocations = 0;
        status = build_few();
        if (status != HD_OK) {
            assert_int_equal(status, HD_FAILED);
            expect_contains(error.message, "out of memory: no room for ");
        }
    }
    assert_int_equal(failing_allocation - 1, allocations);
    failing_allocation = -1;
    assert_true(allocations >= 5);
}

/* The last one: the signal stays. */
TEST(a_build_can_be_interrupted) {
    hd_interrupt_install();
    raise(SIGTERM);
    assert_int_equal(build_few(), HD_INTERRUPTED);
}
