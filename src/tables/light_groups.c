/* SPDX-License-Identifier: MIT */
/* Groups of lights near each other. */
#include <stdlib.h>

#include "tables/builder.h"

static double along(HdVec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* Ties are broken by number, so that every machine makes the same groups. */
static int compare_along(const HdGroupedLight *a, const HdGroupedLight *b, int axis) {
    double x = along(a->position, axis), y = along(b->position, axis);
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

static double extent(const HdGroupedLight *lights, int count, int axis) {
    double least = along(lights[0].position, axis), most = least;
    for (int i = 1; i < count; i++) {
        double x = along(lights[i].position, axis);
        least = x < least ? x : least;
        most = x > most ? x : most;
    }
    return most - least;
}

static void split(HdGroupedLight *lights, int count, int first_group, int groups) {
    if (groups == 1) {
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
    int half = groups / 2, part = (int)((int64_t)count * half / groups);
    split(lights, part, first_group, half);
    split(lights + part, count - part, first_group + half, groups - half);
}

void hd_builder_group_lights(HdBuilder *builder) {
    int groups = HD_LIGHT_GROUPS(builder->light_count);
    for (int i = 0; i < builder->light_count; i++) {
        const HdLightSource *source = &builder->sources[i];
        HdVec3 position = source->position;
        if (source->owner >= 0)
            position = hd_add(position, builder->scene->solids[source->owner].centre);
        builder->grouped[i] = (HdGroupedLight){.position = position, .light = i};
    }
    if (groups > 0)
        split(builder->grouped, builder->light_count, 0, groups);
}
