/* SPDX-License-Identifier: MIT */
#include "output/frame_store.h"

#include <stdbool.h>
#include <stdlib.h>

#include "device/renderer.h"
#include "output/parcel.h"
#include "output/stages.h"
#include "system/machine.h"

enum {
    MOST_OPEN_PICTURES = 256, /* each takes two descriptors until it has its name */
    /* More would only wait for the memory that they share. */
    MAX_ENCODERS = 16,
    /* Beside what is encoded: one is traced, one converted, one on its way to FFmpeg, one waits. */
    SPARE_FRAMES = 4,
    /* For each tracer beside the first: frames that others finish before it has finished one. */
    FRAMES_OF_A_TRACER = 8
};
static const size_t MAX_BYTES = (size_t)1 << 30; /* of all frames under way, for each tracer */

typedef struct Place {
    HdParcel *parcel;
    int tracer;
    HdFrameTimes times;
    HdSpan films[HD_MAX_OUTPUTS]; /* by output */
} Place;

typedef struct Film {
    HdFrameStore *store;
    int index; /* of the output */
} Film;

struct HdFrameStore {
    HdFrameStorePlan plan;
    HdStages *stages;
    Place *places; /* a frame's is its place in the list modulo their number */
    int place_count;
    int stored;
    Film films[HD_MAX_OUTPUTS];
    HdStage list[HD_MAX_STAGES];
    int stage_count;
};

_Static_assert(HD_MAX_STAGES >= HD_MAX_OUTPUTS + 3, "a stage for each film, and three more");

static Place *place_of(HdFrameStore *store, int item) {
    return &store->places[item % store->place_count];
}

static HdSpan begin(const HdFrameStore *store) {
    return (HdSpan){.began = hd_monotonic_seconds() - store->plan.start};
}

static void end(const HdFrameStore *store, HdSpan *span) {
    span->seconds = hd_monotonic_seconds() - store->plan.start - span->began;
}

static bool was_finished(const HdFrameStore *store, int item) {
    return store->plan.resume != NULL && store->plan.resume->is_finished[item];
}

static HdStatus convert(void *context, int item, HdError *error) {
    HdFrameStore *store = context;
    Place *place = place_of(store, item);
    if (was_finished(store, item)) /* which nobody traced */
        return hd_resume_load(hd_outputs_plan(store->plan.outputs),
                              store->plan.frames->frames[item], hd_parcel_frame(place->parcel),
                              error);
    if (hd_parcel_frame(place->parcel)->is_encoded)
        return HD_OK;
    place->times.convert = begin(store);
    hd_parcel_convert(place->parcel);
    end(store, &place->times.convert);
    return HD_OK;
}

static HdStatus add_to_film(void *context, int item, HdError *error) {
    const Film *film = context;
    Place *place = place_of(film->store, item);
    HdSpan *span = &place->films[film->index];
    *span = begin(film->store);
    HdStatus status = hd_parcel_film(place->parcel, film->index, error);
    end(film->store, span);
    return status;
}

static HdStatus write_pictures(void *context, int item, HdError *error) {
    HdFrameStore *store = context;
    Place *place = place_of(store, item);
    if (was_finished(store, item))
        return HD_OK;
    place->times.store = begin(store);
    HdStatus status = hd_parcel_write(place->parcel, store->plan.frames->frames[item], error);
    end(store, &place->times.store);
    return status;
}

static HdSpan span_of_films(const HdFrameStore *store, const Place *place) {
    HdSpan whole = {.began = -1.0};
    double ended = 0.0;
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        const HdSpan *span = &place->films[i];
        if (hd_outputs_film(store->plan.outputs, i) == NULL)
            continue;
        if (whole.began < 0.0 || span->began < whole.began)
            whole.began = span->began;
        if (span->began + span->seconds > ended)
            ended = span->began + span->seconds;
    }
    if (whole.began >= 0.0)
        whole.seconds = ended - whole.began;
    return whole;
}

/* Pictures get their names in the order of the frames, so that a run that ends early leaves its
   first frames and no others. */
static HdStatus publish(void *context, int item, HdError *error) {
    HdFrameStore *store = context;
    Place *place = place_of(store, item);
    HdStatus status = hd_parcel_publish(place->parcel, error);
    if (status != HD_OK)
        return status;
    store->stored = item + 1;
    place->times.film = span_of_films(store, place);
    HdStoredFrame stored = {
        .number = store->plan.frames->frames[item],
        .tracer = place->tracer,
        .done = item + 1,
        .frame = hd_parcel_frame(place->parcel),
        .was_finished = was_finished(store, item),
        .times = place->times,
    };
    return store->plan.stored(store->plan.context, &stored, error);
}

/* Returns the stage's bit. */
static unsigned add_stage(HdFrameStore *store, HdStage stage) {
    store->list[store->stage_count] = stage;
    return 1u << store->stage_count++;
}

static int least(int a, int b) {
    return a < b ? a : b;
}

/* More than there are for the encoders. */
static int spare_count(const HdFrameStorePlan *plan) {
    return SPARE_FRAMES + FRAMES_OF_A_TRACER * (plan->tracers - 1);
}

/* Where tracing has all processors too, they share them; elsewhere none of them idles. */
static int encoder_count(const HdFrameStorePlan *plan) {
    bool has_pictures =
        hd_outputs_film_count(plan->outputs) < hd_outputs_plan(plan->outputs)->count;
    if (!has_pictures)
        return 0;
    return least(least(hd_processor_count(), MAX_ENCODERS), plan->frames->count);
}

/* Reading frames back takes longer than converting them. */
static int converter_count(const HdFrameStorePlan *plan) {
    bool reads = plan->resume != NULL && plan->resume->finished_count > 0;
    return reads ? encoder_count(plan) : 1;
}

static void add_films(HdFrameStore *store) {
    const int converters = converter_count(&store->plan);
    unsigned converted = 0;
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        if (hd_outputs_film(store->plan.outputs, i) == NULL)
            continue;
        if (converted == 0)
            converted = add_stage(
                store, (HdStage){.work = convert, .context = store, .threads = converters});
        store->films[i] = (Film){.store = store, .index = i};
        add_stage(store, (HdStage){.work = add_to_film,
                                   .context = &store->films[i],
                                   .threads = 1,
                                   .after = converted});
    }
}

static void list_stages(HdFrameStore *store) {
    add_films(store);
    int encoders = encoder_count(&store->plan);
    if (encoders > 0)
        add_stage(store, (HdStage){.work = write_pictures, .context = store, .threads = encoders});
    unsigned all = (1u << store->stage_count) - 1;
    add_stage(store, (HdStage){.work = publish, .context = store, .threads = 1, .after = all});
}

static int choose_place_count(const HdFrameStorePlan *plan) {
    int wanted = least(encoder_count(plan) + spare_count(plan), plan->frames->count);
    int pictures = hd_outputs_plan(plan->outputs)->count - hd_outputs_film_count(plan->outputs);
    if (pictures > 0)
        wanted = least(wanted, MOST_OPEN_PICTURES / pictures);
    size_t fitting = MAX_BYTES * (size_t)plan->tracers /
                     hd_parcel_bytes(plan->outputs, plan->width, plan->height);
    if (fitting < 1)
        return 1;
    return fitting < (size_t)wanted ? (int)fitting : wanted;
}

static HdStatus create_places(HdFrameStore *store, HdError *error) {
    const HdFrameStorePlan *plan = &store->plan;
    int count = choose_place_count(plan);
    HdStatus status = HD_OK;
    store->places = calloc((size_t)count, sizeof *store->places);
    if (store->places == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %d frames", count);
    for (; store->place_count < count && status == HD_OK; store->place_count++)
        status = hd_parcel_create(&store->places[store->place_count].parcel, plan->outputs,
                                  plan->width, plan->height, error);
    return status;
}

static void destroy(HdFrameStore *store) {
    for (int i = 0; i < store->place_count; i++)
        hd_parcel_free(store->places[i].parcel);
    free(store->places);
    free(store);
}

HdStatus hd_frame_store_start(HdFrameStore **out, const HdFrameStorePlan *plan, HdError *error) {
    HdFrameStore *store = calloc(1, sizeof *store);
    *out = NULL;
    if (store == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to store frames");
    store->plan = *plan;
    list_stages(store);
    HdStatus status = create_places(store, error);
    if (status == HD_OK)
        status = hd_stages_start(
            &store->stages, store->list, store->stage_count, plan->frames->count,
            plan->resume != NULL ? plan->resume->is_finished : NULL, store->place_count, error);
    if (status == HD_OK)
        *out = store;
    else
        destroy(store);
    return status;
}

/* A tracer alone begins frames before there is room for them. One of several may be given an
   earlier frame than those it has begun, which others wait for: it begins what it can finish. */
int hd_frame_store_take(HdFrameStore *store, bool (*wants)(void *context, int left), void *context,
                        bool waits) {
    const HdTaker taker = {
        .wants = wants,
        .context = context,
        .ahead = store->plan.tracers == 1 ? HD_FRAMES_IN_FLIGHT : 0,
    };
    return hd_stages_take(store->stages, &taker, waits);
}

bool hd_frame_store_wait(HdFrameStore *store, int place) {
    return hd_stages_wait(store->stages, place);
}

HdFrame *hd_frame_store_frame(HdFrameStore *store, int place, HdFrameTimes **times) {
    static const HdSpan nothing = {.began = -1.0};
    Place *found = place_of(store, place);
    found->times = (HdFrameTimes){nothing, nothing, nothing, nothing, nothing, nothing, -1.0};
    *times = &found->times;
    return hd_parcel_frame(found->parcel);
}

void hd_frame_store_give(HdFrameStore *store, int place, int tracer) {
    place_of(store, place)->tracer = tracer;
    hd_stages_give(store->stages, place);
}

void hd_frame_store_give_back(HdFrameStore *store, int place) {
    hd_stages_give_back(store->stages, place);
}

void hd_frame_store_ask_again(HdFrameStore *store) {
    hd_stages_ask_again(store->stages);
}

void hd_frame_store_fail(HdFrameStore *store, int place, const HdError *error) {
    hd_stages_fail(store->stages, place, error);
}

void hd_frame_store_stop(HdFrameStore *store) {
    hd_stages_stop(store->stages);
}

HdStatus hd_frame_store_end(HdFrameStore *store, int *stored_count, HdError *error) {
    HdStatus status = hd_stages_end(store->stages, error);
    *stored_count = store->stored;
    destroy(store);
    return status;
}
