/* SPDX-License-Identifier: MIT */
#include "output/publisher.h"

#include <stdlib.h>
#include <string.h>

#include "system/durable.h"

/* A frame that waits, with its place given to another one. */
typedef struct Waiting {
    HdStoredFrame stored;
    HdFrame frame;
    HdAtomicFile files[HD_MAX_OUTPUTS];
    int file_count;
} Waiting;

struct HdPublisher {
    HdPublisherPlan plan;
    HdFolderSet synced;
    int count;
    Waiting list[]; /* as many as may wait */
};

HdStatus hd_publisher_create(HdPublisher **out, const HdPublisherPlan *plan, HdError *error) {
    HdPublisher *publisher = calloc(1, sizeof *publisher + (size_t)plan->most * sizeof(Waiting));
    *out = publisher;
    if (publisher == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %d frames that wait",
                       plan->most);
    publisher->plan = *plan;
    return HD_OK;
}

/* ---- steps; each for the first `count` frames, of which it returns how many it was done for ----
 */

static HdStatus sync_files(const HdPublisher *publisher, Waiting *waiting, HdError *error) {
    HdStatus status = HD_OK;
    for (int i = 0; i < waiting->file_count && status == HD_OK; i++)
        if (publisher->plan.durability == HD_DURABLE)
            status = hd_atomic_file_sync(&waiting->files[i], error);
    return status;
}

static HdStatus name_files(const HdPublisher *publisher, Waiting *waiting, HdError *error) {
    HdStatus status = HD_OK;
    (void)publisher;
    for (int i = 0; i < waiting->file_count && status == HD_OK; i++)
        status = hd_atomic_file_publish(&waiting->files[i], error);
    return status;
}

typedef HdStatus Step(const HdPublisher *publisher, Waiting *waiting, HdError *error);

/* Fills `error` for the first frame that fails, and leaves it alone where none does. */
static int go(HdPublisher *publisher, Step *step, int count, HdError *error) {
    HdError own;
    for (int i = 0; i < count; i++)
        if (step(publisher, &publisher->list[i], &own) != HD_OK) {
            *error = own;
            return i;
        }
    return count;
}

/* Frames that follow each other lie mostly in one folder. Finished ones are looked after too, whose
   names may not have come to the disk before an earlier run was killed. */
static HdStatus sync_folders(HdPublisher *publisher, const HdOutput *output, int count,
                             HdError *error) {
    char path[HD_MAX_PATH], last[HD_MAX_PATH] = "";
    HdStatus status = HD_OK;
    for (int i = 0; i < count && status == HD_OK; i++) {
        status = hd_output_file(output, publisher->list[i].stored.number, path, error);
        const size_t length = hd_folder_length(path);
        if (status != HD_OK ||
            (i > 0 && length == hd_folder_length(last) && memcmp(path, last, length) == 0))
            continue;
        status = hd_sync_folder(&publisher->synced, path, error);
        memcpy(last, path, sizeof last);
    }
    return status;
}

static HdStatus sync_names(HdPublisher *publisher, int count, HdError *error) {
    const HdOutputPlan *outputs = publisher->plan.outputs;
    HdStatus status = HD_OK;
    for (int i = 0; i < outputs->count && status == HD_OK; i++)
        if (!outputs->list[i].is_film && publisher->plan.durability == HD_DURABLE)
            status = sync_folders(publisher, &outputs->list[i], count, error);
    return status;
}

static HdStatus tell(const HdPublisher *publisher, Waiting *waiting, HdError *error) {
    waiting->stored.frame = &waiting->frame;
    return publisher->plan.stored(publisher->plan.context, &waiting->stored, error);
}

static void drop_all(HdPublisher *publisher) {
    for (int i = 0; i < publisher->count; i++)
        for (int k = 0; k < publisher->list[i].file_count; k++)
            hd_atomic_file_discard(&publisher->list[i].files[k]);
    publisher->count = 0;
}

HdStatus hd_publisher_settle(HdPublisher *publisher, HdError *error) {
    HdError own = {.status = HD_OK};
    int count = go(publisher, sync_files, publisher->count, &own);
    count = go(publisher, name_files, count, &own);
    HdError unsynced;
    if (sync_names(publisher, count, &unsynced) == HD_OK) {
        go(publisher, tell, count, &own);
    } else {
        own = unsynced;
    }
    drop_all(publisher);
    if (own.status != HD_OK)
        *error = own;
    return own.status;
}

/* ---- */

HdStatus hd_publisher_add(HdPublisher *publisher, const HdStoredFrame *stored, HdAtomicFile *files,
                          HdError *error) {
    if (publisher->count == publisher->plan.most) {
        HdStatus status = hd_publisher_settle(publisher, error);
        if (status != HD_OK)
            return status;
    }
    Waiting *waiting = &publisher->list[publisher->count++];
    waiting->stored = *stored;
    waiting->frame = *stored->frame;
    waiting->frame.rgb = NULL;
    waiting->frame.rgba = NULL;
    waiting->file_count = 0;
    for (int i = 0; i < HD_MAX_OUTPUTS; i++) {
        if (files[i].lock < 0)
            continue;
        waiting->files[waiting->file_count++] = files[i];
        files[i].lock = -1;
    }
    return HD_OK;
}

void hd_publisher_free(HdPublisher *publisher) {
    if (publisher == NULL)
        return;
    drop_all(publisher);
    free(publisher);
}
