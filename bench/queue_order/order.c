/* SPDX-License-Identifier: MIT */
/* One build of the orders; HD_BUILD names it, HD_BUILD_SET is its instruction set. */
#include "order.h"

#include <stdlib.h>
#include <string.h>

#include "../kernel_rates/processor_time.h"
#include "cpu/kernel_tables.h"
#include "kernels/common/wavefront.h"

/* A level's rays: up to two runs of places. */
typedef struct Queue {
    real *reals;
    int *ints;
    int stride; /* places */
    int first[2], count[2];
} Queue;

/* What a ray adds to its sample. */
typedef struct Contribution {
    int32_t sample;
    float red, green, blue;
} Contribution;

typedef struct Recorder {
    FILE *file;
    Contribution *items; /* of the level being traced */
    int count;
} Recorder;

typedef struct Waves {
    const HdTable *scene, *frame;
    HdQueueOrder order;
    bool counts;
    Recorder *recorder; /* NULL: nothing is written */
    int per_item;       /* samples of an item */
    Queue now, next;
    fixed64 *sums;
    int sum_stride;
    int *keys, *starts; /* keys: as many as `now` has places */
    int key_room, key_count;
    HdOrderResult *result;
} Waves;

/* ---- memory ---- */

static size_t whole_lines(size_t bytes) {
    return (bytes + 63) / 64 * 64 + 64;
}

/* Makes room for that many rays; those that were there are lost. */
static bool reserve(Queue *queue, int places) {
    int stride = ((places / WAVE_SPARE + 1) | 1) * WAVE_SPARE;
    if (queue->stride >= stride)
        return true;
    free(queue->reals);
    free(queue->ints);
    queue->stride = stride;
    queue->reals =
        aligned_alloc(64, whole_lines(sizeof(real) * (WAVE_REALS * (size_t)stride + WAVE_SPARE)));
    queue->ints =
        aligned_alloc(64, whole_lines(sizeof(int) * (WAVE_INTS * (size_t)stride + WAVE_SPARE)));
    return queue->reals != NULL && queue->ints != NULL;
}

static bool reserve_keys(Waves *waves) {
    int places = waves->now.stride;
    if (waves->key_room >= places)
        return true;
    free(waves->keys);
    waves->key_room = places;
    waves->keys = malloc(sizeof *waves->keys * ((size_t)places + WAVE_SPARE));
    return waves->keys != NULL;
}

static void free_waves(Waves *waves) {
    free(waves->now.reals);
    free(waves->now.ints);
    free(waves->next.reals);
    free(waves->next.ints);
    free(waves->sums);
    free(waves->keys);
    free(waves->starts);
}

static bool begin_waves(Waves *waves, int items) {
    const View *view = waves->frame[HD_TABLE_view].data;
    const Header *header = waves->scene[HD_TABLE_header].data;
    const Object *objects = waves->scene[HD_TABLE_objects].data;
    const Object *last = objects + header->object_count - 1;
    waves->per_item = HD_PIXELS_PER_ITEM * view->samples;
    waves->sum_stride = waves->per_item * items;
    /* A face and a side, or a state of a ray, which is less. */
    waves->key_count = 4 * (last->first_plane + last->plane_count) + 4;
    waves->sums = aligned_alloc(
        64, whole_lines(sizeof(fixed64) * (WAVE_SUMS * (size_t)waves->sum_stride + WAVE_SPARE)));
    waves->starts = malloc(sizeof *waves->starts * ((size_t)waves->key_count + 1));
    return waves->sums != NULL && waves->starts != NULL;
}

/* ---- a level ---- */

static int live_lanes(vmask alive) {
    vint ones = pick_int(alive, splat_int(1), splat_int(0));
    int live = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        live += lane_int(&ones, lane);
    return live;
}

static void record(Waves *waves, const Ray *ray, vint numbers, const Sample *sample) {
    const View *view = waves->frame[HD_TABLE_view].data;
    vint live = pick_int(ray->alive, splat_int(1), splat_int(0));
    for (int lane = 0; lane < HD_LANES; lane++)
        if (lane_int(&live, lane)) {
            Contribution *item = waves->recorder->items + waves->recorder->count++;
            item->sample = lane_int(&numbers, lane);
            item->red = (float)lane_fix(&sample->r, lane) / view->to_fixed;
            item->green = (float)lane_fix(&sample->g, lane) / view->to_fixed;
            item->blue = (float)lane_fix(&sample->b, lane) / view->to_fixed;
        }
}

static int has_faces(const Waves *waves) {
    const Header *header = waves->scene[HD_TABLE_header].data;
    return header->instance_count > 0;
}

/* The rays that go on from a bundle join the next queue. */
FN void append(Waves *waves, const Ray *mirror, const Ray *through, vint numbers) {
    Queue *to = &waves->next;
    int *mirrored = to->count + (waves->order == HD_ORDER_SEGMENTS);
    int compact = waves->order != HD_ORDER_UNCOMPACTED;
    *mirrored += append_rays(to->reals, to->ints, NULL, to->stride, 0, compact,
                             to->first[waves->order == HD_ORDER_SEGMENTS] + *mirrored, mirror,
                             has_faces(waves), numbers);
    to->count[0] += append_rays(to->reals, to->ints, NULL, to->stride, 0, compact,
                                to->first[0] + to->count[0], through, has_faces(waves), numbers);
}

static void trace_first(Waves *waves, int first_item, int items) {
    HD_DECLARE_TABLES(waves->scene, waves->frame)
    for (int number = 0; number < items * waves->per_item; number += HD_LANES) {
        Sample sample = empty_sample();
        Ray mirror, through;
        int within = number % waves->per_item;
        Ray ray = first_rays(SAMPLE_ARGUMENTS first_item + number / waves->per_item, within,
                             waves->per_item - within);
        vint numbers = numbers_from(number);
        mirror.alive = through.alive = mask_none();
        if (any_lane(ray.alive))
            follow(SCENE_ARGUMENTS & ray, 0, &sample, &mirror, &through);
        set_sums(NULL, NULL, waves->sums, 0, waves->sum_stride, 1, number, 0, &sample);
        if (waves->recorder != NULL)
            record(waves, &ray, numbers, &sample);
        append(waves, &mirror, &through, numbers);
        waves->result->first_rays += (uint64_t)live_lanes(ray.alive);
    }
}

static Ray load(const Waves *waves, const Queue *queue, int place, int count, vint *numbers) {
    return load_rays(queue->reals, queue->ints, NULL, queue->stride, 0, 1, place, count,
                     has_faces(waves), numbers);
}

static void trace_run(Waves *waves, int level, int first, int count) {
    HD_DECLARE_TABLES(waves->scene, waves->frame)
    for (int i = 0; i < count; i += HD_LANES) {
        Sample sample = empty_sample();
        Ray mirror, through;
        vint numbers;
        Ray ray = load(waves, &waves->now, first + i, count - i, &numbers);
        follow(SCENE_ARGUMENTS & ray, level, &sample, &mirror, &through);
        add_to_sums(NULL, NULL, waves->sums, 0, waves->sum_stride, 1, ray.alive, numbers, 0,
                    &sample);
        if (waves->recorder != NULL)
            record(waves, &ray, numbers, &sample);
        append(waves, &mirror, &through, numbers);
        waves->result->rays += (uint64_t)live_lanes(ray.alive);
        waves->result->bundles++;
    }
}

/* ---- what rays have in common ---- */

/* How many different numbers the live lanes hold. */
static int different(vint numbers, vmask alive) {
    vint live = pick_int(alive, splat_int(1), splat_int(0));
    int found[HD_LANES], count = 0;
    for (int lane = 0; lane < HD_LANES; lane++) {
        int i = 0;
        while (i < count && found[i] != lane_int(&numbers, lane))
            i++;
        if (lane_int(&live, lane) && i == count)
            found[count++] = lane_int(&numbers, lane);
    }
    return count;
}

/* 0: nothing is met; else the face's number and 1. */
static vint faces_met(const Waves *waves, const Ray *ray) {
    HD_DECLARE_TABLES(waves->scene, waves->frame)
    Reference reference = reference_of(SCENE_ARGUMENTS ray->touched, 0);
    Hit hit = closest_hit(SCENE_ARGUMENTS ray, reference);
    return pick_int(lt_int(hit.object, splat_int(0)), splat_int(0), hit.face + 1);
}

static void count_differences(Waves *waves, int first, int count) {
    for (int i = 0; i < count; i += HD_LANES) {
        vint numbers;
        Ray ray = load(waves, &waves->now, first + i, count - i, &numbers);
        waves->result->touched += (uint64_t)different(ray_state(&ray), ray.alive);
        waves->result->met += (uint64_t)different(faces_met(waves, &ray), ray.alive);
    }
}

/* ---- sorting ---- */

/* The face that a point of an object's surface lies on: the nearest one. */
static int face_at(const Waves *waves, int object, real x, real y, real z) {
    const Object *solid = (const Object *)waves->scene[HD_TABLE_objects].data + object;
    const Plane *plane = (const Plane *)waves->scene[HD_TABLE_planes].data + solid->first_plane;
    real nearest = REAL_LARGE;
    int face = 0;
    /* The floor's other planes only bound it. */
    int count = object < ((const Header *)waves->scene[HD_TABLE_header].data)->solid_count
                    ? solid->plane_count
                    : 1;
    for (int k = 0; k < count; k++, plane++) {
        real along = plane->x * x + plane->y * y + plane->z * z;
        real behind = solid->paired && along < 0 ? -along : along;
        real distance = fabsf(behind - plane->distance);
        if (distance < nearest) {
            nearest = distance;
            face = 2 * (solid->first_plane + k) + (behind != along);
        }
    }
    return face;
}

static void find_keys(Waves *waves) {
    const Queue *queue = &waves->now;
    size_t stride = (size_t)queue->stride;
    int count = queue->count[0];
    if (waves->order == HD_ORDER_MET) {
        for (int i = 0; i < count; i += HD_LANES) {
            vint numbers;
            Ray ray = load(waves, queue, i, count - i, &numbers);
            vint met = faces_met(waves, &ray);
            for (int lane = 0; lane < HD_LANES; lane++)
                waves->keys[i + lane] = lane_int(&met, lane);
        }
        return;
    }
    for (int i = 0; i < count; i++) {
        int state = queue->ints[i];
        const real *origin = queue->reals + i;
        waves->keys[i] =
            waves->order == HD_ORDER_TOUCHED
                ? state
                : 2 * face_at(waves, state >> 1, origin[0], origin[stride], origin[2 * stride]) +
                      (state & 1);
    }
}

/* By counting, so that rays with the same key keep their order and stay near their neighbours in
   the picture. */
static void sort_queue(Waves *waves) {
    const Queue *from = &waves->now;
    Queue *to = &waves->next;
    size_t from_stride = (size_t)from->stride, to_stride = (size_t)to->stride;
    int count = from->count[0], *starts = waves->starts, *places = waves->keys;
    memset(starts, 0, sizeof *starts * ((size_t)waves->key_count + 1));
    for (int i = 0; i < count; i++)
        starts[waves->keys[i] + 1]++;
    for (int key = 0; key < waves->key_count; key++)
        starts[key + 1] += starts[key];
    for (int i = 0; i < count; i++)
        places[i] = starts[waves->keys[i]]++;
    for (size_t array = 0; array < WAVE_REALS; array++)
        for (int i = 0; i < count; i++)
            to->reals[array * to_stride + (size_t)places[i]] =
                from->reals[array * from_stride + (size_t)i];
    for (size_t array = 0; array < WAVE_INTS; array++)
        for (int i = 0; i < count; i++)
            to->ints[array * to_stride + (size_t)places[i]] =
                from->ints[array * from_stride + (size_t)i];
}

static void swap_queues(Waves *waves) {
    Queue other = waves->now;
    waves->now = waves->next;
    waves->next = other;
}

static bool sort_level(Waves *waves) {
    int count = waves->now.count[0];
    double start = hd_processor_seconds();
    if (!reserve_keys(waves) || !reserve(&waves->next, count))
        return false;
    find_keys(waves);
    double middle = hd_processor_seconds();
    sort_queue(waves);
    waves->next.first[0] = 0;
    waves->next.count[0] = count;
    waves->next.count[1] = 0;
    swap_queues(waves);
    waves->result->key_seconds += middle - start;
    waves->result->sort_seconds += hd_processor_seconds() - middle;
    return true;
}

/* ---- batches ---- */

static uint64_t mix_words(uint64_t digest, uint64_t word) {
    return (digest ^ word) * 0x100000001b3u;
}

static void add_to_digest(Waves *waves, int samples) {
    for (int channel = 0; channel < HD_RADIANCE_SUMS; channel++)
        for (int i = 0; i < samples; i++)
            waves->result->digest = mix_words(
                waves->result->digest, (uint64_t)waves->sums[channel * waves->sum_stride + i]);
}

static int round_up(int count) {
    return (count + HD_LANES - 1) / HD_LANES * HD_LANES;
}

/* Every ray has two that go on at most, and a bundle may keep its dead ones. */
static bool empty_next(Waves *waves, int rays) {
    int half = 2 * round_up(rays) + 2 * HD_LANES;
    waves->next.first[0] = 0;
    waves->next.first[1] = half / 2;
    waves->next.count[0] = waves->next.count[1] = 0;
    return reserve(&waves->next, half);
}

static bool write_level(const Waves *waves) {
    Recorder *recorder = waves->recorder;
    int32_t count = recorder->count;
    recorder->count = 0;
    return fwrite(&count, sizeof count, 1, recorder->file) == 1 &&
           fwrite(recorder->items, sizeof *recorder->items, (size_t)count, recorder->file) ==
               (size_t)count;
}

static bool reserve_records(const Waves *waves, int rays) {
    if (waves->recorder == NULL)
        return true;
    free(waves->recorder->items);
    waves->recorder->items = malloc(sizeof *waves->recorder->items * (size_t)(rays + HD_LANES));
    return waves->recorder->items != NULL;
}

static bool trace_level(Waves *waves, int level) {
    Queue *now = &waves->now;
    int rays = round_up(now->count[0]) + round_up(now->count[1]);
    bool sorts = waves->order >= HD_ORDER_TOUCHED;
    if (sorts && !sort_level(waves))
        return false;
    if (!empty_next(waves, rays) || !reserve_records(waves, rays))
        return false;
    for (int i = 0; waves->counts && i < 2; i++)
        count_differences(waves, now->first[i], now->count[i]);
    double start = hd_processor_seconds();
    for (int i = 0; i < 2; i++)
        trace_run(waves, level, now->first[i], now->count[i]);
    waves->result->trace_seconds += hd_processor_seconds() - start;
    return waves->recorder == NULL || write_level(waves);
}

static bool trace_levels(Waves *waves, int first_item, int items) {
    const View *view = waves->frame[HD_TABLE_view].data;
    int samples = items * waves->per_item;
    if (!empty_next(waves, samples) || !reserve_records(waves, samples))
        return false;
    double start = hd_processor_seconds();
    trace_first(waves, first_item, items);
    waves->result->first_seconds += hd_processor_seconds() - start;
    if (waves->recorder != NULL && !write_level(waves))
        return false;
    for (int level = 1; level <= view->depth; level++) {
        swap_queues(waves);
        if (waves->now.count[0] + waves->now.count[1] == 0)
            break;
        if (!trace_level(waves, level))
            return false;
    }
    return true;
}

/* As the kernels of CPUs do it: an item is a batch. */
static bool trace_by_product(Waves *waves, int first_item, int items) {
    HD_DECLARE_TABLES(waves->scene, waves->frame)
    RayCounts counts = {0};
    if (!reserve(&waves->now, wave_least_capacity(view->depth, round_up(waves->per_item))))
        return false;
    double start = hd_processor_seconds();
    for (int item = 0; item < items; item++)
        trace_batch(SCENE_ARGUMENTS waves->now.reals, waves->now.ints,
                    waves->sums + item * waves->per_item, waves->now.stride, waves->sum_stride, 1,
                    first_item + item, 0, waves->per_item, &counts);
    waves->result->trace_seconds += hd_processor_seconds() - start;
    return true;
}

static bool trace_batch_of(Waves *waves, int first_item, int items) {
    bool done = waves->order == HD_ORDER_PRODUCT ? trace_by_product(waves, first_item, items)
                                                 : trace_levels(waves, first_item, items);
    if (done)
        add_to_digest(waves, items * waves->per_item);
    return done;
}

static int items_of(const HdTable *frame) {
    const View *view = frame[HD_TABLE_view].data;
    int across = (view->width + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    int down = (view->height + HD_BLOCK_SIDE - 1) / HD_BLOCK_SIDE;
    return across * down * (HD_BLOCK_PIXELS / HD_PIXELS_PER_ITEM);
}

static bool run(const HdTable *scene, const HdTable *frame, HdQueueOrder order, HdBatches batches,
                bool counts, HdOrderResult *result) {
    HdOrderResult warm_up = {0};
    Waves waves = {
        .scene = scene, .frame = frame, .order = order, .counts = counts, .result = &warm_up};
    const View *view = frame[HD_TABLE_view].data;
    int per_item = HD_PIXELS_PER_ITEM * view->samples;
    int items = items_of(frame);
    int size = batches.samples > per_item ? batches.samples / per_item : 1;
    size = size < items ? size : items;
    int every = (items - 1) / (batches.most / per_item + 1) + 1;
    int begin = every / 2 * size < items ? every / 2 * size : 0; /* one alone is in the middle */
    /* The first batch warms the caches and has the pages of the queues brought in. */
    bool done = begin_waves(&waves, size) && trace_batch_of(&waves, begin, size);
    memset(result, 0, sizeof *result);
    waves.result = result;
    for (int first = begin; done && first < items; first += size * every)
        done = trace_batch_of(&waves, first, items - first < size ? items - first : size);
    free_waves(&waves);
    return done;
}

static bool record_frame(const HdTable *scene, const HdTable *frame, FILE *file) {
    HdOrderResult result = {0};
    Recorder recorder = {.file = file};
    Waves waves = {.scene = scene,
                   .frame = frame,
                   .order = HD_ORDER_APPENDED,
                   .recorder = &recorder,
                   .result = &result};
    int items = items_of(frame);
    bool done = begin_waves(&waves, items);
    int32_t head[2] = {items * waves.per_item, waves.per_item / HD_PIXELS_PER_ITEM}, end = 0;
    done = done && fwrite(head, sizeof head, 1, file) == 1 && trace_levels(&waves, 0, items) &&
           fwrite(&end, sizeof end, 1, file) == 1;
    free(recorder.items);
    free_waves(&waves);
    return done;
}

extern const HdOrderBuild HD_BUILD;
const HdOrderBuild HD_BUILD = {
    .instruction_set = HD_BUILD_SET,
    .lanes = HD_LANES,
    .run = run,
    .record = record_frame,
};
