/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "output/frame_store.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/minmax.h"
#include "image/picture.h"
#include "output/fingerprint.h"
#include "system/atomic_file.h"
#include "system/machine.h"

enum {
    /* Each takes a descriptor until it is renamed, and as many wait for that. */
    MAX_OPEN_PICTURES = 128,
    SPARE_DESCRIPTORS = 2, /* for a folder, and for statistics that are opened late */
    /* More would only wait for shared memory bandwidth. */
    MAX_ENCODERS = 16,
    /* Besides frames being encoded: one traced, one converted, one sent to FFmpeg, one waiting. */
    SPARE_FRAMES = 4,
    /* For each worker but the first: frames that others finish while it traces one. */
    FRAMES_PER_WORKER = 8
};

/* Memory of all frames in flight, for each worker. */
static const size_t MAX_BYTES = (size_t)1 << 30;

/* A frame in progress. One thread at a time works on it, except films, which take it in parallel.
 */
typedef struct Slot {
    HdFrame frame; /* frame with `rgba` if films need it or a device may encode */
    HdAtomicFile files[HD_MAX_OUTPUTS]; /* closed; without a lock: not written, or handed on */
    int worker;
    HdFrameTimes times;
    HdSpan films[HD_MAX_OUTPUTS]; /* times by output */
} Slot;

/* A frame that waits to be published; its slot is in use again. */
typedef struct Waiting {
    HdStoredFrame stored;
    HdFrame frame;
    HdAtomicFile files[HD_MAX_OUTPUTS];
    int file_count;
} Waiting;

typedef struct Film {
    HdFrameStore *store;
    int index; /* index of the output */
    HdFilm *film;
} Film;

struct HdFrameStore {
    HdFrameStorePlan plan;
    HdStages *stages;
    Slot *slots; /* slot of a frame: its index in the list modulo slot_count */
    int slot_count;
    Waiting *waiting; /* frames to publish, at most slot_count */
    int waiting_count;
    int stored;
    Film films[HD_MAX_OUTPUTS]; /* films by output; without a video: pictures */
    HdStage list[HD_MAX_STAGES];
    int stage_count;
};

_Static_assert(HD_MAX_STAGES >= HD_MAX_OUTPUTS + 3, "a stage for each film, and three more");

static Slot *slot_of(HdFrameStore *store, int item) {
    return &store->slots[item % store->slot_count];
}

static int number_of(const HdFrameStore *store, int item) {
    return store->plan.resume->all->frames[item];
}

static bool was_finished(const HdFrameStore *store, int item) {
    return store->plan.resume->is_finished[item];
}

static HdSpan begin_span(const HdFrameStore *store) {
    return (HdSpan){.began = hd_monotonic_seconds() - store->plan.start};
}

static void end_span(const HdFrameStore *store, HdSpan *span) {
    span->seconds = hd_monotonic_seconds() - store->plan.start - span->began;
}

/* ---- stages ---- */

static HdStatus convert(void *context, int item, HdError *error) {
    HdFrameStore *store = context;
    const HdOutputPlan *outputs = store->plan.outputs;
    Slot *slot = slot_of(store, item);
    bool is_lacking = !was_finished(store, item);
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        is_lacking |= hd_resume_film_lacks(store->plan.resume, i, item);
    if (!is_lacking)
        return HD_OK;
    if (was_finished(store, item)) /* so no worker traced it */
        return hd_resume_load(outputs, number_of(store, item), &slot->frame, error);
    if (slot->frame.is_encoded)
        return HD_OK;
    slot->times.convert = begin_span(store);
    hd_frame_encode(&slot->frame, outputs->style.picture.curve);
    end_span(store, &slot->times.convert);
    return HD_OK;
}

/* Blocks while FFmpeg is busy. */
static HdStatus add_to_film(void *context, int item, HdError *error) {
    const Film *film = context;
    Slot *slot = slot_of(film->store, item);
    HdSpan *span = &slot->films[film->index];
    *span = (HdSpan){.began = -1.0};
    if (!hd_resume_film_lacks(film->store->plan.resume, film->index, item))
        return HD_OK;
    *span = begin_span(film->store);
    HdStatus status = hd_film_add(film->film, item, &slot->frame, error);
    end_span(film->store, span);
    return status;
}

/* Writes the picture to a temporary file. */
static HdStatus write_picture(const HdOutputPlan *outputs, int index, Slot *slot, int number,
                              HdError *error) {
    const HdPictureLabel label = {
        .scene = outputs->scene,
        .options = outputs->options,
        .frame = number,
        .crop = outputs->crop,
        .background = outputs->background,
        .has_fingerprint = outputs->has_fingerprint,
        .fingerprint = hd_frame_fingerprint(outputs->fingerprint, number),
    };
    HdAtomicFile *file = &slot->files[index];
    char path[HD_MAX_PATH];
    HD_TRY(hd_output_file(&outputs->list[index], number, path, error));
    HD_TRY(hd_picture_prepare(file, &slot->frame, outputs->list[index].format,
                              &outputs->style.picture, &label, path, error));
    return hd_atomic_file_close(file, error);
}

static HdStatus write_pictures(void *context, int item, HdError *error) {
    HdFrameStore *store = context;
    const HdOutputPlan *outputs = store->plan.outputs;
    Slot *slot = slot_of(store, item);
    HdStatus status = HD_OK;
    if (was_finished(store, item))
        return HD_OK;
    slot->times.store = begin_span(store);
    for (int i = 0; i < outputs->count && status == HD_OK; i++)
        if (!outputs->list[i].is_film)
            status = write_picture(outputs, i, slot, number_of(store, item), error);
    end_span(store, &slot->times.store);
    return status;
}

static HdSpan span_of_films(const HdFrameStore *store, const Slot *slot) {
    HdSpan whole = {.began = -1.0};
    double ended = 0.0;
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        const HdSpan *span = &slot->films[i];
        if (store->films[i].film == NULL || span->began < 0.0)
            continue;
        whole.began = whole.began < 0.0 ? span->began : fmin(whole.began, span->began);
        ended = fmax(ended, span->began + span->seconds);
    }
    if (whole.began >= 0.0)
        whole.seconds = ended - whole.began;
    return whole;
}

/* ---- the last stage publishes pictures and counts frames as stored, in their order, so that an
   interrupted run leaves its first frames only. It publishes several together, since syncing many
   files takes about as long as one ---- */

/* Applies the step to the files of the first `count` frames; returns the number of frames done. On
   failure fills `error`, otherwise leaves it alone. */
static int do_step(HdFrameStore *store, HdStatus (*step)(HdAtomicFile *, HdError *), int count,
                   HdError *error) {
    for (int i = 0; i < count; i++)
        for (int k = 0; k < store->waiting[i].file_count; k++)
            if (step(&store->waiting[i].files[k], error) != HD_OK)
                return i;
    return count;
}

/* Consecutive frames mostly share a folder. Includes finished frames, whose names may not have been
   synced before an earlier run was killed. */
static HdStatus sync_folders(const HdFrameStore *store, const HdOutput *output, int count,
                             HdError *error) {
    char path[HD_MAX_PATH], last[HD_MAX_PATH] = "";
    for (int i = 0; i < count; i++) {
        HD_TRY(hd_output_file(output, store->waiting[i].stored.number, path, error));
        const size_t length = hd_folder_length(path);
        if (i > 0 && length == hd_folder_length(last) && memcmp(path, last, length) == 0)
            continue;
        HD_TRY(hd_sync_folder(path, error));
        memcpy(last, path, sizeof last);
    }
    return HD_OK;
}

static HdStatus sync_names(const HdFrameStore *store, int count, HdError *error) {
    const HdOutputPlan *outputs = store->plan.outputs;
    for (int i = 0; i < outputs->count && outputs->durability == HD_DURABLE; i++)
        if (!outputs->list[i].is_film)
            HD_TRY(sync_folders(store, &outputs->list[i], count, error));
    return HD_OK;
}

static HdStatus report_stored(HdFrameStore *store, int count, HdError *error) {
    for (int i = 0; i < count; i++) {
        store->stored = store->waiting[i].stored.done;
        HD_TRY(store->plan.stored(store->plan.context, &store->waiting[i].stored, error));
    }
    return HD_OK;
}

static void drop_waiting(HdFrameStore *store) {
    for (int i = 0; i < store->waiting_count; i++)
        for (int k = 0; k < store->waiting[i].file_count; k++)
            hd_atomic_file_discard(&store->waiting[i].files[k]);
    store->waiting_count = 0;
}

/* Syncs all files before it renames them, and syncs all names before it reports frames. After a
   failure at a frame, the frames before it are stored and later ones are gone. Only if reporting
   fails do frames that waited with it keep their names. */
static HdStatus settle(void *context, HdError *error) {
    HdFrameStore *store = context;
    HdError first = {.status = HD_OK}, own;
    int count = store->waiting_count;
    if (store->plan.outputs->durability == HD_DURABLE)
        count = do_step(store, hd_atomic_file_sync, count, &first);
    count = do_step(store, hd_atomic_file_publish, count, &first);
    if (sync_names(store, count, &own) != HD_OK || report_stored(store, count, &own) != HD_OK)
        first = own;
    drop_waiting(store);
    if (first.status != HD_OK)
        *error = first;
    return first.status;
}

/* Takes over the files written for the frame. */
static void keep_waiting(Waiting *waiting, Slot *slot) {
    waiting->frame = slot->frame;
    waiting->frame.rgb = NULL;
    waiting->frame.rgba = NULL;
    waiting->file_count = 0;
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        if (slot->files[i].lock < 0)
            continue;
        waiting->files[waiting->file_count++] = slot->files[i];
        slot->files[i].lock = -1;
    }
}

static HdStatus publish(void *context, int item, HdError *error) {
    HdFrameStore *store = context;
    Slot *slot = slot_of(store, item);
    if (store->waiting_count == store->slot_count)
        HD_TRY(settle(store, error));
    Waiting *waiting = &store->waiting[store->waiting_count++];
    keep_waiting(waiting, slot);
    waiting->stored = (HdStoredFrame){
        .number = number_of(store, item),
        .worker = slot->worker,
        .done = item + 1,
        .frame = &waiting->frame,
        .was_finished = was_finished(store, item),
        .times = slot->times,
    };
    waiting->stored.times.film = span_of_films(store, slot);
    return HD_OK;
}

/* ---- stages and their capacity ---- */

/* Adds a stage and returns its bit. */
static unsigned add_stage(HdFrameStore *store, HdStage stage) {
    store->list[store->stage_count] = stage;
    return 1u << store->stage_count++;
}

static int picture_count(const HdFrameStorePlan *plan) {
    return plan->outputs->count - plan->outputs->film_count;
}

/* Uses all processors: they share them with tracing on the CPU, and would idle otherwise. */
static int encoder_count(const HdFrameStorePlan *plan) {
    if (picture_count(plan) == 0)
        return 0;
    return hd_min(hd_min(hd_processor_count(), MAX_ENCODERS), plan->resume->all->count);
}

static void list_stages(HdFrameStore *store) {
    const int encoders = encoder_count(&store->plan);
    unsigned converted = 0;
    /* Loading frames from pictures takes longer than converting them. */
    const int readers = store->plan.resume->finished_count > 0 ? encoders : 1;
    if (store->plan.outputs->film_count > 0)
        converted = add_stage(
            store, (HdStage){.work = convert, .context = store, .threads = hd_max(readers, 1)});
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        if (store->films[i].film != NULL)
            add_stage(store, (HdStage){.work = add_to_film,
                                       .context = &store->films[i],
                                       .threads = 1,
                                       .after = converted});
    if (encoders > 0)
        add_stage(store, (HdStage){.work = write_pictures, .context = store, .threads = encoders});
    unsigned all = (1u << store->stage_count) - 1;
    add_stage(
        store,
        (HdStage){.work = publish, .settle = settle, .context = store, .threads = 1, .after = all});
}

static bool has_image(const HdOutputPlan *outputs) {
    return outputs->film_count > 0 || !outputs->request.radiance;
}

static size_t bytes_of_slot(const HdFrameStorePlan *plan) {
    const size_t pixels = (size_t)plan->width * (size_t)plan->height;
    const size_t layers = hd_layer_bytes(plan->outputs->request.layers);
    return sizeof(Slot) + pixels * (3 * sizeof(float) + layers) +
           (has_image(plan->outputs) ? 4 * pixels : 0);
}

/* A picture has one more descriptor while it is closed. */
static int count_slots_by_descriptors(int pictures) {
    const int fitting = (hd_free_descriptors() - SPARE_DESCRIPTORS) / (2 * pictures + 1);
    return hd_max(hd_min(fitting, MAX_OPEN_PICTURES / pictures), 1);
}

static int choose_place_count(const HdFrameStorePlan *plan) {
    const int spare = SPARE_FRAMES + FRAMES_PER_WORKER * (plan->workers - 1);
    int wanted = hd_min(encoder_count(plan) + spare, plan->resume->all->count);
    if (picture_count(plan) > 0)
        wanted = hd_min(wanted, count_slots_by_descriptors(picture_count(plan)));
    const size_t fitting = MAX_BYTES * (size_t)plan->workers / bytes_of_slot(plan);
    return hd_max((int)hd_min_size(fitting, (size_t)wanted), 1);
}

/* ---- start ---- */

/* Makes the folders and checks that the pictures of the first frame can be written. */
static HdStatus probe_pictures(const HdFrameStorePlan *plan, HdError *error) {
    for (int i = 0; i < plan->outputs->count && plan->resume->missing.count > 0; i++) {
        const HdOutput *output = &plan->outputs->list[i];
        char path[HD_MAX_PATH];
        HdAtomicFile file;
        if (output->is_film)
            continue;
        HD_TRY(hd_output_file(output, plan->resume->missing.frames[0], path, error));
        HD_TRY(hd_atomic_file_reserve(&file, path, error));
        hd_atomic_file_discard(&file);
    }
    return HD_OK;
}

static HdStatus open_films(HdFrameStore *store, HdError *error) {
    const HdFrameStorePlan *plan = &store->plan;
    for (int i = 0; i < plan->outputs->count; i++) {
        store->films[i] = (Film){.store = store, .index = i};
        if (plan->outputs->list[i].is_film)
            HD_TRY(hd_film_open(&store->films[i].film, &plan->resume->films[i], plan->outputs,
                                plan->width, plan->height, error));
    }
    return HD_OK;
}

static HdStatus create_slot(Slot *slot, const HdFrameStorePlan *plan, HdError *error) {
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        slot->files[i].lock = -1;
    HD_TRY(hd_frame_create(&slot->frame, plan->width, plan->height, error));
    if (has_image(plan->outputs))
        HD_TRY(hd_frame_add_rgba(&slot->frame, error));
    return hd_frame_add_layers(&slot->frame, plan->outputs->request.layers, error);
}

static HdStatus create_places(HdFrameStore *store, HdError *error) {
    const int count = choose_place_count(&store->plan);
    store->slots = calloc((size_t)count, sizeof *store->slots);
    store->waiting = calloc((size_t)count, sizeof *store->waiting);
    if (store->slots == NULL || store->waiting == NULL)
        return HD_NO_ROOM(error, "%d frames", count);
    while (store->slot_count < count)
        HD_TRY(create_slot(&store->slots[store->slot_count++], &store->plan, error));
    return HD_OK;
}

/* Discards pictures that are not published. */
static void free_slots(HdFrameStore *store) {
    drop_waiting(store);
    for (int i = 0; i < store->slot_count; i++) {
        Slot *slot = &store->slots[i];
        for (int k = 0; k < HD_MAX_OUTPUTS; k++)
            hd_atomic_file_discard(&slot->files[k]);
        hd_frame_free(&slot->frame);
    }
    free(store->slots);
    free(store->waiting);
}

static void drop_films(HdFrameStore *store) {
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        if (store->films[i].film != NULL)
            hd_film_abort(store->films[i].film);
        store->films[i].film = NULL;
    }
}

/* Discards the films; pictures stay. */
static void destroy(HdFrameStore *store) {
    drop_films(store);
    free(store);
}

static HdStatus start(HdFrameStore *store, HdError *error) {
    const HdResume *resume = store->plan.resume;
    HD_TRY(probe_pictures(&store->plan, error));
    HD_TRY(open_films(store, error));
    HD_TRY(create_places(store, error));
    list_stages(store);
    return hd_stages_start(&store->stages, store->list, store->stage_count, resume->all->count,
                           resume->is_finished, store->slot_count, error);
}

HdStatus hd_frame_store_start(HdFrameStore **out, const HdFrameStorePlan *plan, HdError *error) {
    HdFrameStore *store = calloc(1, sizeof *store);
    *out = NULL;
    if (store == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to store frames");
    store->plan = *plan;
    hd_stale_files_remove(plan->outputs, plan->resume->all);
    const HdStatus status = start(store, error);
    if (status == HD_OK) {
        *out = store;
    } else {
        free_slots(store);
        destroy(store);
    }
    return status;
}

/* ---- frames ---- */

HdStages *hd_frame_store_stages(HdFrameStore *store) {
    return store->stages;
}

HdFrame *hd_frame_store_frame(HdFrameStore *store, int item, int worker, HdFrameTimes **times) {
    static const HdSpan nothing = {.began = -1.0};
    Slot *found = slot_of(store, item);
    found->worker = worker;
    found->times = (HdFrameTimes){nothing, nothing, nothing, nothing, nothing, nothing, -1.0};
    *times = &found->times;
    return &found->frame;
}

/* ---- end ---- */

/* If a film fails, later ones are discarded; earlier ones stay. */
static HdStatus close_films(HdFrameStore *store, HdError *error) {
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        HdFilm *film = store->films[i].film;
        store->films[i].film = NULL;
        if (film != NULL)
            HD_TRY(hd_film_close(film, error));
    }
    return HD_OK;
}

/* Reports an interruption, and which frames are kept. From here on `is_finished` says which frames
   need not be rendered again; pictures without a fingerprint stay too, but need `--frames`. */
static void report_interrupted(const HdFrameStore *store, HdError *error) {
    const HdOutputPlan *outputs = store->plan.outputs;
    HdResume *resume = store->plan.resume;
    const bool is_marked = outputs->can_resume && outputs->has_fingerprint;
    char kept[HD_FRAMES_TEXT], others[HD_FRAMES_TEXT], more[256] = "";
    for (int i = 0; i < resume->all->count; i++)
        resume->is_finished[i] = i >= store->stored ? resume->is_finished[i]
                                 : is_marked        ? hd_resume_keeps(resume, outputs, i)
                                                    : outputs->film_count == 0;
    hd_frame_list_write(resume->all, resume->is_finished, true, kept);
    hd_frame_list_write(resume->all, resume->is_finished, false, others);
    if (kept[0] == '\0' && store->stored > 0)
        snprintf(more, sizeof more, "; the same command renders all frames again");
    else if (kept[0] != '\0' && is_marked)
        snprintf(more, sizeof more, "; frames kept: %s; the same command%s goes on with %s", kept,
                 outputs->resumes ? "" : " without --again",
                 others[0] != '\0' ? others : "the films");
    else if (kept[0] != '\0' && others[0] != '\0')
        snprintf(more, sizeof more, "; frames kept: %s; --frames %s renders the others", kept,
                 others);
    hd_fail(error, HD_INTERRUPTED, "interrupted after %d of %d frames%s", store->stored,
            resume->all->count, more);
}

/* A failure in the store precedes the caller's: its frames are earlier. */
HdStatus hd_frame_store_end(HdFrameStore *store, HdStatus traced, HdError *error) {
    HdStatus status = hd_stages_end(store->stages, error);
    free_slots(store);
    if (status == HD_OK)
        status = traced;
    if (status == HD_INTERRUPTED) {
        drop_films(store);
        report_interrupted(store, error);
    }
    if (status == HD_OK)
        status = close_films(store, error);
    destroy(store);
    return status;
}
