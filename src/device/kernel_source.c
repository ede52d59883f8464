/* SPDX-License-Identifier: MIT */
#include "device/kernel_source.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>

#include "base/minmax.h"
#include "kernels/host/shared.h"

void hd_kernel_defines(const HdKernelShape *shape, char text[HD_KERNEL_DEFINES_SIZE]) {
    const struct {
        const char *name;
        int value;
    } list[] = {
        {"HD_LANES", shape->lanes},
        {"HD_DOUBLE", shape->precision == HD_PRECISION_DOUBLE},
        {"HD_PIXELS_PER_ITEM", shape->pixels_per_item},
        {"HD_GROUP_SIZE", shape->group_size},
        {"HD_WAVEFRONT", shape->wavefront},
        {"HD_FIRST_HITS", shape->first_hits},
        {"HD_PLANE_BOUND", shape->needs.plane_bound},
        {"HD_DEPTH_BOUND", shape->needs.depth_bound},
        {"HD_NODE_STACK", shape->needs.node_stack_bound},
        /* A wide node has at most as many children as lanes, and is no deeper than others. */
        {"HD_WIDE_STACK", shape->needs.node_stack_bound * shape->lanes},
        {"HD_REFRACTS", shape->needs.refracts},
        {"HD_LIT_FROM_BEHIND", shape->needs.lit_from_behind},
        {"HD_MANY_LIGHTS", shape->needs.many_lights},
        {"HD_BOUNDED", shape->needs.bounded},
        {"HD_CUT_OUTS", shape->needs.cut_outs},
        {"HD_ENVIRONMENT", shape->needs.environment},
        {"HD_SMALL_TABLES", shape->needs.small_tables},
        {"HD_STRICT", shape->math == HD_MATH_STRICT},
        {"HD_ROUNDED_BY_FMA", shape->rounds_by_fma},
        {"HD_PROBE", shape->is_probe},
    };
    int length = 0;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        length += snprintf(text + length, HD_KERNEL_DEFINES_SIZE - (size_t)length, " -D%s=%d",
                           list[i].name, list[i].value);
}

int hd_register_limit(const HdKernelShape *shape, int nvidia_arch, int asked) {
    bool is_large = shape->needs.many_lights || shape->needs.node_stack_bound > 0;
    if (asked > 0)
        return asked;
    if (nvidia_arch < 70)
        return 64;
    return shape->precision == HD_PRECISION_DOUBLE ? 128 : is_large ? 80 : 96;
}

const char *hd_kernel_name(const HdKernelShape *shape, HdKernel kernel) {
    bool has_groups = shape->group_size > 0;
    if (shape->is_probe)
        return kernel == HD_KERNEL_TRACE ? "hedron_probe" : NULL;
    switch (kernel) {
    case HD_KERNEL_TRACE:
        if (!shape->wavefront)
            return "hedron_render";
        return has_groups ? "hedron_trace_chunk" : "hedron_render_by_waves";
    case HD_KERNEL_STORE:
        return shape->wavefront && has_groups ? "hedron_store_batch" : NULL;
    case HD_KERNEL_SUM:
        return "hedron_sum_counts";
    case HD_KERNEL_FIRST_HITS:
        return shape->first_hits ? "hedron_first_hits" : NULL;
    default:
        return has_groups ? "hedron_encode" : NULL;
    }
}

/* Rounds up to a bound that scenes of similar size share, so that one build serves them all: the
   least power of two that is at least 8 and `count`. */
static int bound_for(int count) {
    int bound = 8;
    while (bound < count)
        bound *= 2;
    return bound;
}

HdKernelNeeds hd_kernel_needs(const HdSceneTables *tables) {
    enum { USUAL_STACK = 32 }; /* deep enough for nearly all meshes: few builds differ in it */
    const int stack = bound_for(hd_max(tables->node_stack, USUAL_STACK));
    return (HdKernelNeeds){
        .plane_bound = bound_for(tables->plane_count),
        .depth_bound = bound_for(tables->depth),
        .node_stack_bound = tables->node_stack > 0 ? stack : 0,
        .refracts = tables->refracts,
        .lit_from_behind = tables->lit_from_behind,
        /* With meshes too, branches would nest too deeply (docs/lost-light.md). */
        .many_lights = tables->many_lights && tables->node_stack == 0,
        .bounded = tables->bounded,
        .cut_outs = tables->cut_outs,
        .environment = tables->environment,
        .small_tables = tables->small_tables,
    };
}

bool hd_kernel_needs_equal(const HdKernelNeeds *a, const HdKernelNeeds *b) {
    return a->plane_bound == b->plane_bound && a->depth_bound == b->depth_bound &&
           a->node_stack_bound == b->node_stack_bound && a->refracts == b->refracts &&
           a->lit_from_behind == b->lit_from_behind && a->many_lights == b->many_lights &&
           a->bounded == b->bounded && a->cut_outs == b->cut_outs &&
           a->environment == b->environment && a->small_tables == b->small_tables;
}

void hd_kernel_needs_describe(const HdKernelNeeds *needs, char *text, int capacity) {
    snprintf(text, (size_t)capacity,
             "built for up to %d planes and depth %d, %s refraction, %s, %s%s%s%s%s",
             needs->plane_bound, needs->depth_bound, needs->refracts ? "with" : "without",
             needs->lit_from_behind ? "faces lit from behind" : "no faces lit from behind",
             needs->node_stack_bound > 0 ? "meshes" : "no meshes",
             needs->many_lights ? ", many lights" : "", needs->bounded ? ", error bounds" : "",
             needs->cut_outs ? ", cut-outs" : "", needs->environment ? ", an environment" : "");
}

int hd_kernel_item_count(int width, int height, int pixels_per_item) {
    int64_t columns = ((int64_t)width + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int64_t rows = ((int64_t)height + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int64_t items = columns * rows * (HD_BLOCK_PIXELS / pixels_per_item);
    return items > INT_MAX ? INT_MAX : (int)items;
}
