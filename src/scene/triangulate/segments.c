/* SPDX-License-Identifier: MIT */
#include "scene/triangulate/segments.h"

#include <stdlib.h>
#include <string.h>

#include "base/growth.h"

/* A point on a segment. */
typedef struct Mark {
    int segment;
    int point;
    double along; /* distance from the segment's first end */
} Mark;

typedef struct Marks {
    int count, room;
    Mark *list;
} Marks;

/* What points and segments are sorted by. */
typedef struct Key {
    double value;
    int number;
} Key;

static int compare_keys(const void *left, const void *right) {
    const Key *a = left, *b = right;
    if (a->value != b->value)
        return a->value < b->value ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static int compare_marks(const void *left, const void *right) {
    const Mark *a = left, *b = right;
    if (a->segment != b->segment)
        return a->segment < b->segment ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return (a->point > b->point) - (a->point < b->point);
}

static int compare_segments(const void *left, const void *right) {
    const int32_t *a = left, *b = right;
    if (a[0] != b[0])
        return a[0] < b[0] ? -1 : 1;
    return (a[1] > b[1]) - (a[1] < b[1]);
}

static bool add_point(HdNetwork *network, HdVec2 point) {
    return hd_append(&network->points, sizeof point, &network->point_count, &network->point_room,
                     &point);
}

static bool add_segment(HdNetwork *network, int a, int b) {
    const int32_t segment[2] = {a < b ? a : b, a < b ? b : a};
    return hd_append(&network->segments, sizeof segment, &network->segment_count,
                     &network->segment_room, segment);
}

bool hd_network_add(HdNetwork *network, HdVec2 a, HdVec2 b) {
    if (hd_length2(hd_sub2(b, a)) <= HD_SAME_PLACE)
        return true;
    return add_point(network, a) && add_point(network, b) &&
           add_segment(network, network->point_count - 2, network->point_count - 1);
}

static bool add_mark(Marks *marks, int segment, int point, double along) {
    const Mark mark = {segment, point, along};
    return hd_append(&marks->list, sizeof mark, &marks->count, &marks->room, &mark);
}

static HdVec2 end_of(const HdNetwork *network, int segment, int end) {
    return network->points[network->segments[segment][end]];
}

static double length_of(const HdNetwork *network, int segment) {
    return hd_length2(hd_sub2(end_of(network, segment, 1), end_of(network, segment, 0)));
}

/* A point's place as seen from a segment: how far along it, and how far to its left. */
static HdVec2 seen_from(const HdNetwork *network, int segment, HdVec2 point) {
    HdVec2 a = end_of(network, segment, 0), way = hd_sub2(end_of(network, segment, 1), a);
    HdVec2 offset = hd_sub2(point, a);
    double length = hd_length2(way);
    return (HdVec2){hd_dot2(way, offset) / length, hd_cross2(way, offset) / length};
}

/* Marks the ends of `other` that lie on the segment. */
static bool mark_touches(const HdNetwork *network, int segment, int other, Marks *marks) {
    const double length = length_of(network, segment);
    for (int end = 0; end < 2; end++) {
        HdVec2 seen = seen_from(network, segment, end_of(network, other, end));
        if (fabs(seen.y) <= HD_SAME_PLACE && seen.x >= -HD_SAME_PLACE &&
            seen.x <= length + HD_SAME_PLACE &&
            !add_mark(marks, segment, network->segments[other][end], seen.x))
            return false;
    }
    return true;
}

static bool mark_crossing(HdNetwork *network, int segment, int other, Marks *marks) {
    HdVec2 from = seen_from(network, segment, end_of(network, other, 0));
    HdVec2 to = seen_from(network, segment, end_of(network, other, 1));
    double first = seen_from(network, other, end_of(network, segment, 0)).y;
    double second = seen_from(network, other, end_of(network, segment, 1)).y;
    if (!(from.y * to.y < 0.0 && first * second < 0.0))
        return true;
    double t = from.y / (from.y - to.y);
    HdVec2 start = end_of(network, other, 0), end = end_of(network, other, 1);
    int point = network->point_count;
    return add_point(network, hd_mix2(start, end, t)) &&
           add_mark(marks, segment, point, from.x + t * (to.x - from.x)) &&
           add_mark(marks, other, point, t * length_of(network, other));
}

/* Where one touches the other nothing else is looked for: cut there, they meet in an end. */
static bool mark_pair(HdNetwork *network, int segment, int other, Marks *marks) {
    const int before = marks->count;
    if (!mark_touches(network, segment, other, marks) ||
        !mark_touches(network, other, segment, marks))
        return false;
    return marks->count > before || mark_crossing(network, segment, other, marks);
}

static double least_x(const HdNetwork *network, int segment) {
    return fmin(end_of(network, segment, 0).x, end_of(network, segment, 1).x);
}

static double most_x(const HdNetwork *network, int segment) {
    return fmax(end_of(network, segment, 0).x, end_of(network, segment, 1).x);
}

static bool overlap_in_y(const HdNetwork *network, int segment, int other) {
    double a = end_of(network, segment, 0).y, b = end_of(network, segment, 1).y;
    double c = end_of(network, other, 0).y, d = end_of(network, other, 1).y;
    return fmin(a, b) <= fmax(c, d) + HD_SAME_PLACE && fmin(c, d) <= fmax(a, b) + HD_SAME_PLACE;
}

/* From left to right each segment is held against those that begin before it ends. */
static bool mark_pairs(HdNetwork *network, const Key *order, Marks *marks) {
    for (int i = 0; i < network->segment_count; i++) {
        int segment = order[i].number;
        double end = most_x(network, segment) + HD_SAME_PLACE;
        for (int j = i + 1; j < network->segment_count && order[j].value <= end; j++)
            if (overlap_in_y(network, segment, order[j].number) &&
                !mark_pair(network, segment, order[j].number, marks))
                return false;
    }
    return true;
}

static bool mark_ends(const HdNetwork *network, int segment, Marks *marks) {
    return add_mark(marks, segment, network->segments[segment][0], 0.0) &&
           add_mark(marks, segment, network->segments[segment][1], length_of(network, segment));
}

static bool mark_segments(HdNetwork *network, Marks *marks) {
    Key *order = calloc((size_t)network->segment_count, sizeof *order);
    bool has_room = order != NULL;
    for (int s = 0; s < network->segment_count && has_room; s++) {
        order[s] = (Key){least_x(network, s), s};
        has_room = mark_ends(network, s, marks);
    }
    if (has_room) {
        qsort(order, (size_t)network->segment_count, sizeof *order, compare_keys);
        has_room = mark_pairs(network, order, marks);
    }
    free(order);
    return has_room;
}

/* Puts one of the points at each place into `points`, and into `now` each former point's number.
   The order, for which `keys` is, is along a line that outlines are hardly parallel or at right
   angles to. */
static void join_points(HdNetwork *network, Key *keys, HdVec2 *points, int *now) {
    int count = network->point_count, kept = 0;
    for (int i = 0; i < count; i++)
        keys[i] = (Key){0.8 * network->points[i].x + 0.6 * network->points[i].y, i};
    qsort(keys, (size_t)count, sizeof *keys, compare_keys);
    for (int i = 0; i < count; i++) {
        const Key key = keys[i];
        HdVec2 point = network->points[key.number];
        int same = kept - 1;
        while (same >= 0 && key.value - keys[same].value <= HD_SAME_PLACE &&
               hd_length2(hd_sub2(point, points[same])) > HD_SAME_PLACE)
            same--;
        if (same < 0 || key.value - keys[same].value > HD_SAME_PLACE) {
            same = kept++;
            keys[same] = key;
            points[same] = point;
        }
        now[key.number] = same;
    }
    network->point_count = kept;
}

static void drop_doubles(HdNetwork *network) {
    int kept = 0;
    qsort(network->segments, (size_t)network->segment_count, sizeof *network->segments,
          compare_segments);
    for (int i = 0; i < network->segment_count; i++) {
        const int32_t *segment = network->segments[i];
        if (kept > 0 && compare_segments(network->segments[kept - 1], segment) == 0)
            continue;
        memmove(network->segments[kept++], segment, sizeof *network->segments);
    }
    network->segment_count = kept;
}

/* Puts the pieces between the marks in place of the segments, and tells whether any was cut. */
static bool cut_at_marks(HdNetwork *network, Marks *marks, const int *now, bool *was_cut) {
    qsort(marks->list, (size_t)marks->count, sizeof *marks->list, compare_marks);
    network->segment_count = 0;
    int pieces = 0;
    for (int i = 1; i < marks->count; i++) {
        const Mark *from = &marks->list[i - 1], *to = &marks->list[i];
        pieces = to->segment == from->segment ? pieces : 0;
        int a = now[from->point], b = now[to->point];
        if (to->segment != from->segment || a == b)
            continue;
        if (!add_segment(network, a, b))
            return false;
        *was_cut |= ++pieces > 1;
    }
    drop_doubles(network);
    return true;
}

static bool join_and_cut(HdNetwork *network, Marks *marks, bool *was_cut) {
    const int count = network->point_count;
    Key *keys = calloc((size_t)count, sizeof *keys);
    HdVec2 *points = calloc((size_t)count, sizeof *points), *former = points;
    int *now = calloc((size_t)count, sizeof *now);
    bool has_room = keys != NULL && points != NULL && now != NULL;
    if (has_room) {
        join_points(network, keys, points, now);
        former = network->points;
        network->points = points;
        network->point_room = count;
        has_room = cut_at_marks(network, marks, now, was_cut);
    }
    free(keys);
    free(former);
    free(now);
    return has_room;
}

bool hd_network_cut(HdNetwork *network) {
    /* A piece runs to points that were moved a little, and may touch others then. */
    enum { MOST_PASSES = 16 };
    bool was_cut = network->segment_count > 0, has_room = true;
    for (int pass = 0; was_cut && has_room && pass < MOST_PASSES; pass++) {
        Marks marks = {0};
        was_cut = false;
        has_room = mark_segments(network, &marks) && join_and_cut(network, &marks, &was_cut);
        free(marks.list);
    }
    return has_room;
}

void hd_network_free(HdNetwork *network) {
    free(network->points);
    free(network->segments);
    *network = (HdNetwork){0};
}
