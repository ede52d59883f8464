/* SPDX-License-Identifier: MIT */
#include "scene/triangulate/segments.h"

#include <stdbool.h>
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

static HdStatus no_memory(HdError *error) {
    return hd_fail(error, HD_FAILED, "out of memory: the outlines on a face are too many");
}

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

static HdStatus add_point(HdNetwork *network, HdVec2 point, HdError *error) {
    HdVec2 *points =
        hd_grown(network->points, sizeof *points, network->point_count, &network->point_room);
    if (points == NULL)
        return no_memory(error);
    network->points = points;
    points[network->point_count++] = point;
    return HD_OK;
}

static HdStatus add_segment(HdNetwork *network, int a, int b, HdError *error) {
    int32_t(*segments)[2] = hd_grown(network->segments, sizeof *segments, network->segment_count,
                                     &network->segment_room);
    if (segments == NULL)
        return no_memory(error);
    network->segments = segments;
    segments[network->segment_count][0] = a < b ? a : b;
    segments[network->segment_count][1] = a < b ? b : a;
    network->segment_count++;
    return HD_OK;
}

HdStatus hd_network_add(HdNetwork *network, HdVec2 a, HdVec2 b, HdError *error) {
    if (hd_length2(hd_sub2(b, a)) <= HD_SAME_PLACE)
        return HD_OK;
    HdStatus status = add_point(network, a, error);
    if (status == HD_OK)
        status = add_point(network, b, error);
    if (status == HD_OK)
        status = add_segment(network, network->point_count - 2, network->point_count - 1, error);
    return status;
}

static HdStatus add_mark(Marks *marks, int segment, int point, double along, HdError *error) {
    Mark *list = hd_grown(marks->list, sizeof *list, marks->count, &marks->room);
    if (list == NULL)
        return no_memory(error);
    marks->list = list;
    list[marks->count++] = (Mark){segment, point, along};
    return HD_OK;
}

static HdVec2 end_of(const HdNetwork *network, int segment, int end) {
    return network->points[network->segments[segment][end]];
}

/* A point's place as seen from a segment: how far along it, and how far to its left. */
static HdVec2 seen_from(const HdNetwork *network, int segment, HdVec2 point) {
    HdVec2 a = end_of(network, segment, 0), way = hd_sub2(end_of(network, segment, 1), a);
    HdVec2 offset = hd_sub2(point, a);
    double length = hd_length2(way);
    return (HdVec2){hd_dot2(way, offset) / length, hd_cross2(way, offset) / length};
}

/* Marks the ends of `other` that lie on the segment. */
static HdStatus mark_touches(HdNetwork *network, int segment, int other, Marks *marks,
                             bool *touches, HdError *error) {
    double length = hd_length2(hd_sub2(end_of(network, segment, 1), end_of(network, segment, 0)));
    for (int end = 0; end < 2; end++) {
        HdVec2 seen = seen_from(network, segment, end_of(network, other, end));
        if (fabs(seen.y) > HD_SAME_PLACE || seen.x < -HD_SAME_PLACE ||
            seen.x > length + HD_SAME_PLACE)
            continue;
        *touches = true;
        HdStatus status = add_mark(marks, segment, network->segments[other][end], seen.x, error);
        if (status != HD_OK)
            return status;
    }
    return HD_OK;
}

static HdStatus mark_crossing(HdNetwork *network, int segment, int other, Marks *marks,
                              HdError *error) {
    HdVec2 from = seen_from(network, segment, end_of(network, other, 0));
    HdVec2 to = seen_from(network, segment, end_of(network, other, 1));
    double first = seen_from(network, other, end_of(network, segment, 0)).y;
    double second = seen_from(network, other, end_of(network, segment, 1)).y;
    if (!(from.y * to.y < 0.0 && first * second < 0.0))
        return HD_OK;
    double t = from.y / (from.y - to.y);
    HdVec2 start = end_of(network, other, 0), end = end_of(network, other, 1);
    int point = network->point_count;
    HdStatus status = add_point(network, hd_mix2(start, end, t), error);
    if (status == HD_OK)
        status = add_mark(marks, segment, point, from.x + t * (to.x - from.x), error);
    if (status == HD_OK)
        status = add_mark(marks, other, point, t * hd_length2(hd_sub2(end, start)), error);
    return status;
}

/* Where one touches the other nothing else is looked for: cut there, they meet in an end. */
static HdStatus mark_pair(HdNetwork *network, int segment, int other, Marks *marks,
                          HdError *error) {
    bool touches = false;
    HdStatus status = mark_touches(network, segment, other, marks, &touches, error);
    if (status == HD_OK)
        status = mark_touches(network, other, segment, marks, &touches, error);
    if (status == HD_OK && !touches)
        status = mark_crossing(network, segment, other, marks, error);
    return status;
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
static HdStatus mark_pairs(HdNetwork *network, const Key *order, Marks *marks, HdError *error) {
    for (int i = 0; i < network->segment_count; i++) {
        int segment = order[i].number;
        double end = most_x(network, segment) + HD_SAME_PLACE;
        for (int j = i + 1; j < network->segment_count && order[j].value <= end; j++) {
            int other = order[j].number;
            if (!overlap_in_y(network, segment, other))
                continue;
            HdStatus status = mark_pair(network, segment, other, marks, error);
            if (status != HD_OK)
                return status;
        }
    }
    return HD_OK;
}

static HdStatus mark_segments(HdNetwork *network, Marks *marks, HdError *error) {
    Key *order = calloc((size_t)network->segment_count + 1, sizeof *order);
    if (order == NULL)
        return no_memory(error);
    HdStatus status = HD_OK;
    for (int s = 0; s < network->segment_count && status == HD_OK; s++) {
        order[s] = (Key){least_x(network, s), s};
        double length = hd_length2(hd_sub2(end_of(network, s, 1), end_of(network, s, 0)));
        status = add_mark(marks, s, network->segments[s][0], 0.0, error);
        if (status == HD_OK)
            status = add_mark(marks, s, network->segments[s][1], length, error);
    }
    if (status == HD_OK) {
        qsort(order, (size_t)network->segment_count, sizeof *order, compare_keys);
        status = mark_pairs(network, order, marks, error);
    }
    free(order);
    return status;
}

/* Leaves one of the points at each place; `now` tells each former point's number. The order is
   along a line that outlines are hardly parallel or at right angles to. */
static HdStatus join_points(HdNetwork *network, int *now, HdError *error) {
    int count = network->point_count, kept = 0;
    Key *order = calloc((size_t)count + 1, sizeof *order);
    Key *keys = calloc((size_t)count + 1, sizeof *keys);
    HdVec2 *points = calloc((size_t)count + 1, sizeof *points);
    if (order == NULL || keys == NULL || points == NULL) {
        free(order);
        free(keys);
        free(points);
        return no_memory(error);
    }
    for (int i = 0; i < count; i++)
        order[i] = (Key){0.8 * network->points[i].x + 0.6 * network->points[i].y, i};
    qsort(order, (size_t)count, sizeof *order, compare_keys);
    for (int i = 0; i < count; i++) {
        HdVec2 point = network->points[order[i].number];
        int same = kept - 1;
        while (same >= 0 && order[i].value - keys[same].value <= HD_SAME_PLACE &&
               hd_length2(hd_sub2(point, points[same])) > HD_SAME_PLACE)
            same--;
        if (same < 0 || order[i].value - keys[same].value > HD_SAME_PLACE) {
            same = kept++;
            keys[same] = order[i];
            points[same] = point;
        }
        now[order[i].number] = same;
    }
    free(order);
    free(keys);
    free(network->points);
    network->points = points;
    network->point_room = count;
    network->point_count = kept;
    return HD_OK;
}

static void drop_doubles(HdNetwork *network) {
    int kept = 0;
    if (network->segment_count > 0)
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
static HdStatus cut_at_marks(HdNetwork *network, Marks *marks, const int *now, bool *was_cut,
                             HdError *error) {
    qsort(marks->list, (size_t)marks->count, sizeof *marks->list, compare_marks);
    network->segment_count = 0;
    int pieces = 0;
    for (int i = 1; i < marks->count; i++) {
        const Mark *from = &marks->list[i - 1], *to = &marks->list[i];
        pieces = to->segment == from->segment ? pieces : 0;
        int a = now[from->point], b = now[to->point];
        if (to->segment != from->segment || a == b)
            continue;
        HdStatus status = add_segment(network, a, b, error);
        if (status != HD_OK)
            return status;
        *was_cut = *was_cut || ++pieces > 1;
    }
    drop_doubles(network);
    return HD_OK;
}

static HdStatus join_and_cut(HdNetwork *network, Marks *marks, bool *was_cut, HdError *error) {
    int *now = calloc((size_t)network->point_count + 1, sizeof *now);
    if (now == NULL)
        return no_memory(error);
    HdStatus status = join_points(network, now, error);
    if (status == HD_OK && marks->list != NULL)
        status = cut_at_marks(network, marks, now, was_cut, error);
    free(now);
    return status;
}

static HdStatus cut_once(HdNetwork *network, bool *was_cut, HdError *error) {
    Marks marks = {0};
    *was_cut = false;
    HdStatus status = mark_segments(network, &marks, error);
    if (status == HD_OK)
        status = join_and_cut(network, &marks, was_cut, error);
    free(marks.list);
    return status;
}

HdStatus hd_network_cut(HdNetwork *network, HdError *error) {
    /* A piece runs to points that were moved a little, and may touch others then. */
    enum { MOST_PASSES = 16 };
    bool was_cut = true;
    for (int pass = 0; was_cut && pass < MOST_PASSES; pass++) {
        HdStatus status = cut_once(network, &was_cut, error);
        if (status != HD_OK)
            return status;
    }
    return HD_OK;
}

void hd_network_free(HdNetwork *network) {
    free(network->points);
    free(network->segments);
    *network = (HdNetwork){0};
}
