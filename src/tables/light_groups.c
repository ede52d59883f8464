/* SPDX-License-Identifier: MIT */
/* Groups of lights near each other. */
#include <stdlib.h>

#include "tables/builder.h"

static double along(HdVec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* Ties are broken by number, so that every machine makes the same groups. */
static int compare_along(const HdGroupedLight *a, const HdGroupedLight *b, int axis) {
    double x = along(a->about, axis), y = along(b->about, axis);
    return x != y ? (x < y ? -1 : 1) : (a->light > b->light) - (a->light < b->light);
}

static int compare_x(const void *a, const void *b) {
    return compare_along(a, b, 0);
}
static int compare_y(const void *a, const void *b) {
    return compare_along(a, b, 1);
}
static int compare_z(const void *a, const void *b) {
    return compare_along(a, b, 2);
}

static int compare_number(const void *a, const void *b) {
    int i = ((const HdGroupedLight *)a)->light, j = ((const HdGroupedLight *)b)->light;
    return (i > j) - (i < j);
}

static double extent(const HdGroupedLight *lights, int count, int axis) {
    double least = along(lights[0].about, axis), most = least;
    for (int i = 1; i < count; i++) {
        double x = along(lights[i].about, axis);
        least = x < least ? x : least;
        most = x > most ? x : most;
    }
    return most - least;
}

static bool is_between(const HdGroupedLight *lights, int place) {
    return hd_length(hd_sub(lights[place - 1].about, lights[place].about)) > 0.0;
}

/* The place nearest to `place` that parts no edge's lights, if there is one. */
static int place_between(const HdGroupedLight *lights, int count, int place) {
    for (int off = 0; off < count; off++) {
        if (place - off > 0 && is_between(lights, place - off))
            return place - off;
        if (place + off < count && is_between(lights, place + off))
            return place + off;
    }
    return place;
}

/* There are no more groups than lights. */
static void split(HdGroupedLight *lights, int count, int first_group, int groups) {
    if (groups == 1) {
        qsort(lights, (size_t)count, sizeof *lights, compare_number);
        for (int i = 0; i < count; i++)
            lights[i].group = first_group;
        return;
    }
    int axis = 0;
    for (int other = 1; other < 3; other++)
        if (extent(lights, count, other) > extent(lights, count, axis))
            axis = other;
    static int (*const compare[])(const void *, const void *) = {compare_x, compare_y, compare_z};
    qsort(lights, (size_t)count, sizeof *lights, compare[axis]);
    int part = place_between(lights, count, (int)((int64_t)count * (groups / 2) / groups));
    int half = (int)(((int64_t)groups * part + count / 2) / count);
    half = half < 1 ? 1 : half < groups ? half : groups - 1;
    split(lights, part, first_group, half);
    split(lights + part, count - part, first_group + half, groups - half);
}

static bool share_edge(const HdLightSource *a, const HdLightSource *b) {
    return a->owner >= 0 && a->owner == b->owner && a->face[0] == b->face[0] &&
           a->face[1] == b->face[1];
}

/* Of the lights on the edge of number `first`, which follow each other; returns the next one. */
static int set_middle(HdBuilder *builder, int first) {
    HdGroupedLight *lights = builder->grouped;
    int next = first + 1;
    while (next < builder->light_count &&
           share_edge(&builder->sources[first], &builder->sources[next]))
        next++;
    HdVec3 middle = hd_scale(hd_add(lights[first].position, lights[next - 1].position), 0.5);
    for (int i = first; i < next; i++)
        lights[i].about = middle;
    return next;
}

void hd_builder_group_lights(HdBuilder *builder) {
    int groups = HD_LIGHT_GROUPS(builder->light_count);
    for (int i = 0; i < builder->light_count; i++) {
        const HdLightSource *source = &builder->sources[i];
        HdVec3 position = source->position;
        if (source->owner >= 0)
            position = hd_add(position, builder->scene->solids[source->owner].centre);
        builder->grouped[i] = (HdGroupedLight){position, position, .light = i};
    }
    for (int i = 0, next; i < builder->light_count; i = next)
        next = set_middle(builder, i);
    if (groups > 0)
        split(builder->grouped, builder->light_count, 0, groups);
}
