/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "output/film.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/minmax.h"
#include "output/fingerprint.h"

/* ---- segments ---- */

static uint64_t name_of(const HdSegments *segments, const HdOutputPlan *plan,
                        const HdOutput *output, const HdFrameList *frames, int index) {
    const int begin = index * segments->length;
    const char *format = output->format->name;
    uint64_t hash = hd_hash_bytes(plan->fingerprint, format, strlen(format));
    const int rate = plan->style.frames_per_second;
    hash = hd_frame_fingerprint(hash, plan->style.is_ntsc ? -rate : rate);
    for (int i = 0; i < hd_segment_frames(segments, index); i++)
        hash = hd_frame_fingerprint(hash, frames->frames[begin + i]);
    return hash;
}

static HdStatus look_at_files(HdSegments *segments, const HdOutputPlan *plan,
                              const HdOutput *output, const HdFrameList *frames, HdError *error) {
    for (int i = 0; i < segments->count; i++) {
        char path[HD_MAX_PATH];
        struct stat found;
        segments->names[i] = name_of(segments, plan, output, frames, i);
        HD_TRY(hd_segment_path(segments, i, path, error));
        segments->is_whole[i] = plan->resumes && lstat(path, &found) == 0 &&
                                S_ISREG(found.st_mode) && found.st_size > 0;
    }
    return HD_OK;
}

HdStatus hd_segments_find(HdSegments *segments, const HdOutputPlan *plan, const HdOutput *output,
                          const HdFrameList *frames, HdError *error) {
    *segments = (HdSegments){.frame_count = frames->count, .length = frames->count, .count = 1};
    if (!output->is_film)
        return HD_OK;
    HD_TRY(hd_output_file(output, 0, segments->film, error));
    /* Whole seconds, or 1.001 s, so that frame times equal those of a film made in one go. */
    const int rate = plan->style.frames_per_second;
    const int length = (HD_MIN_SEGMENT + rate - 1) / rate * rate;
    if (!plan->has_fingerprint || frames->count <= length)
        return HD_OK;
    segments->length = length;
    segments->count = (frames->count + length - 1) / length;
    segments->names = calloc((size_t)segments->count, sizeof *segments->names);
    segments->is_whole = calloc((size_t)segments->count, sizeof *segments->is_whole);
    if (segments->names == NULL || segments->is_whole == NULL)
        return HD_NO_ROOM(error, "a list of %d segments", segments->count);
    return look_at_files(segments, plan, output, frames, error);
}

bool hd_segments_have(const HdSegments *segments, int item) {
    return segments->count > 1 && segments->is_whole[item / segments->length];
}

int hd_segment_frames(const HdSegments *segments, int index) {
    return hd_min(segments->frame_count - index * segments->length, segments->length);
}

HdStatus hd_segment_path(const HdSegments *segments, int index, char out[HD_MAX_PATH],
                         HdError *error) {
    const int length = snprintf(out, HD_MAX_PATH, "%s" HD_SEGMENT_INFIX "%04d-%016" PRIx64,
                                segments->film, index, segments->names[index]);
    if (length >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "the name of the film %s is too long for those of its segments",
                       segments->film);
    return HD_OK;
}

static void remove_segment(void *context, const char *entry) {
    const char *path = context;
    const size_t folder = hd_folder_length(path), length = strlen(path + folder);
    char found[HD_MAX_PATH];
    int end = 0;
    if (strncmp(entry, path + folder, length) != 0 ||
        sscanf(entry + length, HD_SEGMENT_INFIX "%*[0-9]-%*16[0-9a-f]%n", &end) != 0 || end == 0 ||
        entry[length + (size_t)end] != '\0')
        return;
    if (snprintf(found, sizeof found, "%.*s%s", (int)folder, path, entry) < HD_MAX_PATH)
        remove(found);
}

void hd_segments_remove(const HdSegments *segments) {
    char film[HD_MAX_PATH], folder[HD_MAX_PATH];
    snprintf(film, sizeof film, "%s", segments->film);
    snprintf(folder, sizeof folder, "%.*s", (int)hd_folder_length(film), film);
    hd_path_visit(folder, remove_segment, film);
}

void hd_segments_free(HdSegments *segments) {
    free(segments->names);
    free(segments->is_whole);
    *segments = (HdSegments){.count = 1};
}

/* ---- the film ---- */

/* A complete segment in its last steps: FFmpeg ends, its frames are counted, and it is synced and
   named. */
typedef struct Ending {
    pthread_t thread;
    bool has_thread;
    HdVideo *video; /* NULL: none */
    int index;
    HdStatus status;
    HdError error;
} Ending;

struct HdFilm {
    HdSegments *segments;
    HdVideoPlan plan;
    HdDurability durability;
    HdVideo *video; /* NULL: none in progress */
    Ending ending;
};

/* Starts the segment, or the film if it has none. */
static HdStatus open_video(HdFilm *film, int index, HdError *error) {
    HdVideoPlan plan = film->plan;
    char path[HD_MAX_PATH];
    if (film->segments->count == 1)
        return hd_video_open(&film->video, film->segments->film, &plan, error);
    plan.format = plan.format->segment_format;
    HD_TRY(hd_segment_path(film->segments, index, path, error));
    return hd_video_open(&film->video, path, &plan, error);
}

/* Returns the first missing segment from `index` on, or -1. */
static int next_missing(const HdSegments *segments, int index) {
    while (index < segments->count && hd_segments_have(segments, index * segments->length))
        index++;
    return index < segments->count ? index : -1;
}

HdStatus hd_film_open(HdFilm **out, HdSegments *segments, const HdOutputPlan *plan, int width,
                      int height, HdError *error) {
    HdFilm *film = calloc(1, sizeof *film);
    const int first = next_missing(segments, 0);
    if (film == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to make the film %s",
                       segments->film);
    *film = (HdFilm){
        .segments = segments,
        .plan = {hd_format_of(segments->film), width, height, plan->style, false},
        .durability = plan->durability,
    };
    const HdStatus status = first >= 0 ? open_video(film, first, error) : HD_OK;
    if (status == HD_OK)
        *out = film;
    else
        hd_film_abort(film);
    return status;
}

static void *end_video(void *data) {
    HdFilm *film = data;
    film->ending.status = hd_video_close(film->ending.video, film->durability, &film->ending.error);
    return NULL;
}

/* Waits for the segment that is ending, if any. */
static HdStatus wait_for_segment(HdFilm *film, HdError *error) {
    Ending *ending = &film->ending;
    if (ending->video == NULL)
        return HD_OK;
    if (ending->has_thread)
        pthread_join(ending->thread, NULL);
    ending->video = NULL;
    if (ending->status != HD_OK)
        *error = ending->error;
    else
        film->segments->is_whole[ending->index] = true;
    return ending->status;
}

/* Ends the segment on a thread while the next one begins, for this may take longer than many
   frames. If the system refuses a thread, blocks. */
static HdStatus end_segment(HdFilm *film, int index, HdError *error) {
    Ending *ending = &film->ending;
    HD_TRY(wait_for_segment(film, error));
    *ending = (Ending){.video = film->video, .index = index};
    film->video = NULL;
    ending->has_thread = pthread_create(&ending->thread, NULL, end_video, film) == 0;
    if (!ending->has_thread)
        end_video(film);
    return HD_OK;
}

HdStatus hd_film_add(HdFilm *film, int item, const HdFrame *frame, HdError *error) {
    const HdSegments *segments = film->segments;
    const int index = item / segments->length;
    const int last = index * segments->length + hd_segment_frames(segments, index) - 1;
    if (film->video == NULL)
        HD_TRY(open_video(film, index, error));
    HD_TRY(hd_video_add(film->video, frame, error));
    if (item == last && segments->count > 1)
        HD_TRY(end_segment(film, index, error));
    const bool is_last = film->video == NULL && next_missing(segments, index + 1) < 0;
    return is_last ? wait_for_segment(film, error) : HD_OK;
}

static HdStatus join(HdFilm *film, HdError *error) {
    const HdSegments *segments = film->segments;
    HdVideoPlan plan = film->plan;
    plan.is_joined = true;
    HD_TRY(hd_video_open(&film->video, segments->film, &plan, error));
    for (int i = 0; i < segments->count; i++) {
        char path[HD_MAX_PATH];
        HD_TRY(hd_segment_path(segments, i, path, error));
        HD_TRY(hd_video_add_part(film->video, path, hd_segment_frames(segments, i), error));
    }
    return HD_OK;
}

HdStatus hd_film_close(HdFilm *film, HdError *error) {
    HdStatus status = wait_for_segment(film, error);
    if (status == HD_OK && film->segments->count > 1)
        status = join(film, error);
    if (status == HD_OK) {
        status = hd_video_close(film->video, film->durability, error);
        film->video = NULL;
    }
    if (status == HD_OK)
        hd_segments_remove(film->segments);
    hd_film_abort(film);
    return status;
}

void hd_film_abort(HdFilm *film) {
    HdError ignored;
    wait_for_segment(film, &ignored);
    if (film->video != NULL)
        hd_video_abort(film->video);
    free(film);
}
