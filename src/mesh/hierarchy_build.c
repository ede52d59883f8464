/* SPDX-License-Identifier: MIT */
#include "mesh/hierarchy.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/hierarchy_subtree.h"
#include "system/interrupt.h"
#include "system/machine.h"

/* All threads build the top level by level, over all items of a level. One thread builds each small
   enough rest as a subtree. The result does not depend on the number of threads, because every
   partition is stable. Nor does it depend on the caller's floating-point environment, because the
   threads do all rounding. */
enum {
    MAX_PIECES = 256, /* pieces of a level, about */
    MIN_PIECE = 4096,
    MAX_TASKS = MAX_PIECES * HD_MAX_HIERARCHY_DEPTH + 1,
    MAX_CHUNKS = 2 * MAX_PIECES
};

/* A node of the top: a child >= 0 is another one, otherwise ~child is a task. */
typedef struct TopNode {
    HdBounds box[2];
    int child[2], axis;
} TopNode;

/* A subtree to build. */
typedef struct Task {
    HdGroup group;
    HdItem *items, *spare;
    HdBranch branch;
    int node_count, first_node;
} Task;

/* A node of the current level to divide. */
typedef struct Open {
    HdGroup group;
    int *link; /* where its parent stores its number */
    HdBinning binning;
    HdSplit split;
    int first_chunk, chunk_count;
} Open;

/* A chunk of an open node, or of all items. */
typedef struct Chunk {
    const Open *open;
    int begin, end;
    int left, right; /* destinations of its items */
    HdBounds box;
    HdBounds centres[2];
} Chunk;

/* State of building the top; its size is fixed. */
typedef struct Top {
    TopNode nodes[MAX_TASKS];
    Task tasks[MAX_TASKS];
    Task *ordered_tasks[MAX_TASKS]; /* the tasks in the order of processing */
    Open opens[2][MAX_PIECES];      /* open nodes of this level and the next, alternating */
    Chunk chunks[MAX_CHUNKS];
    HdBins bins[MAX_CHUNKS]; /* bins of each chunk */
} Top;

typedef struct Build {
    const HdBox *boxes;
    int count, piece;
    const HdHierarchyOptions *options;
    HdThreadPool *pool;
    HdError *error;
    HdLanes unit;
    void *memory;           /* two items for each box, later the nodes of the hierarchy */
    HdItem *items, *others; /* `others` receives moved items */
    HdBuildNode *nodes;     /* nodes of subtrees, each at the number of its first item */
    int32_t *order;
    Top *top;
    Open *opens, *next_opens;
    int root, top_count, task_count, open_count, next_open_count, chunk_count;
    HdBuildNode *result;
} Build;

static bool is_interrupted(const void *context) {
    (void)context;
    return hd_interrupt_signal() != 0;
}

static HdStatus run(Build *build, int count, HdThreadWork *work) {
    if (!hd_thread_pool_run(build->pool, count, work, build, is_interrupted))
        return hd_fail(build->error, HD_INTERRUPTED, "interrupted while a hierarchy was built");
    return HD_OK;
}

static void load_chunk(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    Chunk *chunk = &build->top->chunks[number];
    chunk->box = hd_bounds_empty();
    for (int i = chunk->begin; i < chunk->end; i++) {
        const float *lower = build->boxes[i].lower, *upper = build->boxes[i].upper;
        HdItem *item = &build->items[i];
        item->lower.parts.xyz[0] = lower[0];
        item->lower.parts.xyz[1] = lower[1];
        item->lower.parts.xyz[2] = lower[2];
        item->lower.parts.tag = i | HD_ITEM_TAG;
        item->upper.lanes = (HdLanes){upper[0], upper[1], upper[2], 0.0F};
        hd_bounds_add(&chunk->box, item->lower.lanes, item->upper.lanes);
    }
}

static void bound_centres(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    Chunk *chunk = &build->top->chunks[number];
    HdBounds centres = hd_bounds_empty();
    for (int i = chunk->begin; i < chunk->end; i++) {
        const HdLanes centre = hd_item_centre(&build->items[i], build->unit);
        hd_bounds_add(&centres, centre, centre);
    }
    chunk->centres[0] = centres;
}

/* Returns the unit of hd_item_centre. */
static HdLanes find_unit(const HdBounds *box) {
    float largest = 0.0F;
    for (int axis = 0; axis < 3; axis++) {
        largest = fmaxf(largest, fabsf(box->lower[axis]));
        largest = fmaxf(largest, fabsf(box->upper[axis]));
    }
    int exponent;
    (void)frexpf(largest, &exponent);
    if (exponent > 126)
        exponent = 126;
    if (exponent < -126)
        exponent = -126;
    const float unit = ldexpf(1.0F, -exponent);
    return (HdLanes){unit, unit, unit, 0.0F};
}

static void add_chunks(Build *build, int first, int count, const Open *open) {
    const int pieces = (count + build->piece - 1) / build->piece;
    for (int i = 0; i < pieces; i++) {
        Chunk *chunk = &build->top->chunks[build->chunk_count++];
        chunk->open = open;
        chunk->begin = first + (int)((int64_t)count * i / pieces);
        chunk->end = first + (int)((int64_t)count * (i + 1) / pieces);
    }
}

static void add_task(Build *build, const HdGroup *group, HdItem *items, HdItem *spare, int *link) {
    *link = ~build->task_count;
    build->top->tasks[build->task_count++] =
        (Task){.group = *group, .items = items, .spare = spare};
}

/* Makes a task or an open node of a group that lies in `others` until the next swap. */
static void add_group(Build *build, const HdGroup *group, int *link) {
    if (group->count > build->piece)
        build->next_opens[build->next_open_count++] = (Open){.group = *group, .link = link};
    else
        add_task(build, group, build->others, build->items, link);
}

static void swap(Build *build) {
    HdItem *items = build->items;
    build->items = build->others;
    build->others = items;
    Open *opens = build->opens;
    build->opens = build->next_opens;
    build->next_opens = opens;
    build->open_count = build->next_open_count;
    build->next_open_count = 0;
}

static HdStatus load(Build *build) {
    add_chunks(build, 0, build->count, NULL);
    HD_TRY(run(build, build->chunk_count, load_chunk));
    HdGroup root = {.first = 0, .count = build->count, .depth = 1};
    root.box = root.centres = hd_bounds_empty();
    for (int i = 0; i < build->chunk_count; i++)
        hd_bounds_merge(&root.box, &build->top->chunks[i].box);
    build->unit = find_unit(&root.box);
    HD_TRY(run(build, build->chunk_count, bound_centres));
    for (int i = 0; i < build->chunk_count; i++)
        hd_bounds_merge(&root.centres, &build->top->chunks[i].centres[0]);
    /* `add_group` expects the items in `others`. */
    swap(build);
    add_group(build, &root, &build->root);
    swap(build);
    return HD_OK;
}

static void bin_chunk(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    const Chunk *chunk = &build->top->chunks[number];
    const HdBinning binning = hd_binning_of(&chunk->open->group, build->unit);
    hd_bins_clear(&build->top->bins[number], &binning);
    hd_bins_add(&build->top->bins[number], &binning, build->items + chunk->begin,
                chunk->end - chunk->begin);
}

static void plan_moves(const Build *build, const Open *open) {
    int left = open->group.first, right = left + open->split.left_count;
    for (int i = open->first_chunk; i < open->first_chunk + open->chunk_count; i++) {
        Chunk *chunk = &build->top->chunks[i];
        chunk->left = left;
        chunk->right = right;
        for (int bin = 0; bin < open->binning.count; bin++)
            *(bin < open->split.bin ? &left : &right) +=
                build->top->bins[i].count[bin][open->split.axis];
    }
}

static void choose_split(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    Open *open = &build->opens[number];
    open->split.axis = -1;
    if (hd_group_is_deep(&open->group, build->options))
        return;
    open->binning = hd_binning_of(&open->group, build->unit);
    HdBins all;
    hd_bins_clear(&all, &open->binning);
    for (int i = open->first_chunk; i < open->first_chunk + open->chunk_count; i++)
        hd_bins_merge(&all, &open->binning, &build->top->bins[i]);
    open->split = hd_bins_choose(&all, &open->binning);
    if (open->split.axis >= 0)
        plan_moves(build, open);
}

static void move_chunk(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    Chunk *chunk = &build->top->chunks[number];
    const Open *open = chunk->open;
    if (open->split.axis < 0)
        return;
    int place[2] = {chunk->left, chunk->right};
    HdBounds centres[2] = {hd_bounds_empty(), hd_bounds_empty()};
    for (int i = chunk->begin; i < chunk->end; i++) {
        const HdItem *item = &build->items[i];
        const int side = hd_bin_on(&open->binning, item, open->split.axis) >= open->split.bin;
        const HdLanes centre = hd_item_centre(item, build->unit);
        build->others[place[side]++] = *item;
        hd_bounds_add(&centres[side], centre, centre);
    }
    chunk->centres[0] = centres[0];
    chunk->centres[1] = centres[1];
}

static void divide(Build *build, const Open *open) {
    const HdSplit *split = &open->split;
    const HdGroup *group = &open->group;
    const int middle = group->first + split->left_count, depth = group->depth + 1;
    HdGroup sides[2] = {
        {group->first, split->left_count, depth, split->left, hd_bounds_empty()},
        {middle, group->count - split->left_count, depth, split->right, hd_bounds_empty()}};
    TopNode *top = &build->top->nodes[build->top_count];
    *open->link = build->top_count++;
    top->axis = split->axis;
    for (int side = 0; side < 2; side++) {
        top->box[side] = sides[side].box;
        for (int i = open->first_chunk; i < open->first_chunk + open->chunk_count; i++)
            hd_bounds_merge(&sides[side].centres, &build->top->chunks[i].centres[side]);
        add_group(build, &sides[side], &top->child[side]);
    }
}

static HdStatus divide_level(Build *build) {
    build->chunk_count = 0;
    for (int i = 0; i < build->open_count; i++) {
        Open *open = &build->opens[i];
        open->first_chunk = build->chunk_count;
        add_chunks(build, open->group.first, open->group.count, open);
        open->chunk_count = build->chunk_count - open->first_chunk;
    }
    HD_TRY(run(build, build->chunk_count, bin_chunk));
    HD_TRY(run(build, build->open_count, choose_split));
    HD_TRY(run(build, build->chunk_count, move_chunk));
    for (int i = 0; i < build->open_count; i++) {
        const Open *open = &build->opens[i];
        if (open->split.axis >= 0)
            divide(build, open);
        else /* its items were not moved */
            add_task(build, &open->group, build->items, build->others, open->link);
    }
    swap(build);
    return HD_OK;
}

static void build_task(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    Task *task = build->top->ordered_tasks[number];
    const int first = task->group.first, end = first + task->group.count;
    HdSubtree subtree = {build->options, build->unit,          task->items,
                         task->spare,    build->nodes + first, 0};
    task->branch = hd_subtree_build(&subtree, &task->group);
    task->node_count = subtree.node_count;
    for (int i = first; i < end; i++)
        build->order[i] = task->items[i].lower.parts.tag & ~HD_ITEM_TAG;
}

static int larger_first(const void *a, const void *b) {
    const int x = (*(Task *const *)a)->group.count, y = (*(Task *const *)b)->group.count;
    return (x < y) - (x > y);
}

static HdStatus build_subtrees(Build *build) {
    for (int i = 0; i < build->task_count; i++)
        build->top->ordered_tasks[i] = &build->top->tasks[i];
    qsort(build->top->ordered_tasks, (size_t)build->task_count, sizeof(void *), larger_first);
    return run(build, build->task_count, build_task);
}

static void copy_task(void *context, int thread, int number) {
    (void)thread;
    const Build *build = context;
    const Task *task = build->top->ordered_tasks[number];
    const HdBuildNode *from = build->nodes + task->group.first;
    HdBuildNode *to = build->result + task->first_node;
    for (int i = 0; i < task->node_count; i++) {
        to[i] = from[i];
        for (int side = 0; side < 2; side++)
            if (to[i].child[side] >= 0)
                to[i].child[side] += task->first_node;
    }
}

/* Numbers the nodes below `top` depth first from *next on, and writes those of the top. Returns the
   height. */
static int place(Build *build, int top, int *next, int32_t *child) {
    if (top < 0) {
        Task *task = &build->top->tasks[~top];
        task->first_node = *next;
        *next += task->node_count;
        *child = task->branch.child + (task->branch.child >= 0 ? task->first_node : 0);
        return task->branch.height;
    }
    const TopNode *node = &build->top->nodes[top];
    const int number = (*next)++;
    int32_t children[2];
    const int left = place(build, node->child[0], next, &children[0]);
    const int right = place(build, node->child[1], next, &children[1]);
    build->result[number] =
        (HdBuildNode){{hd_bounds_box(&node->box[0]), hd_bounds_box(&node->box[1])},
                      {children[0], children[1]},
                      node->axis};
    *child = number;
    return 1 + (left > right ? left : right);
}

/* The nodes reuse the memory of the items, which are larger and no longer needed: new memory takes
   longer to get than to fill. */
static HdStatus assemble(Build *build, HdHierarchy *hierarchy) {
    int32_t root;
    int count = 0;
    hierarchy->nodes = build->result = build->memory;
    build->memory = NULL;
    hierarchy->depth = place(build, build->root, &count, &root);
    hierarchy->node_count = count;
    if (root < 0) { /* a leaf only: add a root */
        const HdBounds none = hd_bounds_empty(), *all = &build->top->tasks[0].group.box;
        hierarchy->node_count = hierarchy->depth = 1;
        hierarchy->nodes[0] =
            (HdBuildNode){{hd_bounds_box(all), hd_bounds_box(&none)}, {root, ~0}, 0};
        return HD_OK;
    }
    const HdStatus status = run(build, build->task_count, copy_task);
    HdBuildNode *shrunk = realloc(hierarchy->nodes, (size_t)count * sizeof *shrunk);
    if (shrunk != NULL)
        hierarchy->nodes = shrunk;
    return status;
}

static bool allocate(Build *build, HdHierarchy *hierarchy) {
    _Static_assert(sizeof(HdBuildNode) <= 2 * sizeof(HdItem), "nodes take the place of items");
    const size_t count = (size_t)build->count;
    build->memory = hd_large_allocate(2 * count * sizeof(HdItem));
    build->nodes = hd_large_allocate(count * sizeof *build->nodes);
    build->top = malloc(sizeof *build->top); /* small pages: usually little of it is used */
    hierarchy->order = hd_large_allocate(count * sizeof *hierarchy->order);
    if (build->memory == NULL || build->nodes == NULL || build->top == NULL ||
        hierarchy->order == NULL)
        return false;
    build->opens = build->top->opens[0];
    build->next_opens = build->top->opens[1];
    build->items = build->memory;
    build->others = build->items + count;
    build->order = hierarchy->order;
    return true;
}

static HdStatus build_all(Build *build, HdHierarchy *hierarchy) {
    if (!allocate(build, hierarchy))
        return HD_NO_ROOM(build->error, "a hierarchy over %d boxes", build->count);
    HD_TRY(load(build));
    while (build->open_count > 0)
        HD_TRY(divide_level(build));
    HD_TRY(build_subtrees(build));
    return assemble(build, hierarchy);
}

HdStatus hd_hierarchy_build(HdHierarchy *hierarchy, const HdBox *boxes, int count,
                            const HdHierarchyOptions *options, HdThreadPool *pool, HdError *error) {
    Build build = {
        .boxes = boxes, .count = count, .options = options, .pool = pool, .error = error};
    build.piece = (count + MAX_PIECES - 1) / MAX_PIECES;
    if (build.piece < MIN_PIECE)
        build.piece = MIN_PIECE;
    *hierarchy = (HdHierarchy){0};
    const HdStatus status = build_all(&build, hierarchy);
    free(build.memory);
    free(build.nodes);
    free(build.top);
    if (status != HD_OK)
        hd_hierarchy_free(hierarchy);
    return status;
}

void hd_hierarchy_free(HdHierarchy *hierarchy) {
    free(hierarchy->nodes);
    free(hierarchy->order);
    *hierarchy = (HdHierarchy){0};
}
