/* SPDX-License-Identifier: MIT */
#include "output/film.h"

#include <pthread.h>
#include <stdlib.h>

/* A segment that got its last frame: FFmpeg ends, its frames are counted, it is synced and named.
 */
typedef struct Ending {
    pthread_t thread;
    bool has_thread;
    HdVideo *video; /* NULL: nothing is ending */
    HdDurability durability;
    int index;
    HdStatus status;
    HdError error;
} Ending;

struct HdFilm {
    HdSegments *segments;
    int width, height;
    HdOutputStyle style;
    HdDurability durability;
    HdVideo *video; /* NULL: none is being made */
    Ending ending;
};

static const HdFormat *format_of_film(const HdFilm *film) {
    return hd_format_of(film->segments->film);
}

/* Starts the segment, or the film where it has none. */
static HdStatus open_video(HdFilm *film, int index, HdError *error) {
    const HdSegments *segments = film->segments;
    const HdFormat *format = format_of_film(film);
    char path[HD_MAX_PATH];
    if (segments->count == 1)
        return hd_video_open(&film->video, segments->film, format, film->width, film->height,
                             &film->style, error);
    HdStatus status = hd_segment_path(segments, index, path, error);
    if (status == HD_OK)
        status = hd_video_open(&film->video, path, format->segment_format, film->width,
                               film->height, &film->style, error);
    return status;
}

/* The first segment from `index` on that is not whole; negative: there is none. */
static int next_missing(const HdSegments *segments, int index) {
    while (index < segments->count && hd_segments_have(segments, hd_segment_begin(segments, index)))
        index++;
    return index < segments->count ? index : -1;
}

HdStatus hd_film_open(HdFilm **out, HdSegments *segments, int width, int height,
                      const HdOutputStyle *style, HdDurability durability, HdError *error) {
    HdFilm *film = calloc(1, sizeof *film);
    const int first = next_missing(segments, 0);
    if (film == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to make the film %s",
                       segments->film);
    *film = (HdFilm){.segments = segments,
                     .width = width,
                     .height = height,
                     .style = *style,
                     .durability = durability};
    const HdStatus status = first >= 0 ? open_video(film, first, error) : HD_OK;
    if (status == HD_OK)
        *out = film;
    else
        hd_film_abort(film);
    return status;
}

static void *end_video(void *data) {
    Ending *ending = data;
    ending->status = hd_video_close(ending->video, ending->durability, &ending->error);
    return NULL;
}

/* Waits for the segment that is ending, if one is. */
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

/* The next one begins meanwhile, for this takes longer than many a frame. Where the system refuses
   a thread it waits. */
static HdStatus end_segment(HdFilm *film, int index, HdError *error) {
    Ending *ending = &film->ending;
    const HdStatus status = wait_for_segment(film, error);
    if (status != HD_OK)
        return status;
    *ending = (Ending){.video = film->video, .durability = film->durability, .index = index};
    film->video = NULL;
    ending->has_thread = pthread_create(&ending->thread, NULL, end_video, ending) == 0;
    if (!ending->has_thread)
        end_video(ending);
    return HD_OK;
}

HdStatus hd_film_add(HdFilm *film, int item, const HdFrame *frame, HdError *error) {
    const HdSegments *segments = film->segments;
    const int index = item / segments->length;
    const int last = hd_segment_begin(segments, index) + hd_segment_frames(segments, index) - 1;
    HdStatus status = film->video == NULL ? open_video(film, index, error) : HD_OK;
    if (status == HD_OK)
        status = hd_video_add(film->video, frame, error);
    if (status == HD_OK && item == last && segments->count > 1)
        status = end_segment(film, index, error);
    if (status == HD_OK && film->video == NULL && next_missing(segments, index + 1) < 0)
        status = wait_for_segment(film, error);
    return status;
}

static HdStatus join(HdFilm *film, HdError *error) {
    const HdSegments *segments = film->segments;
    HdStatus status = hd_video_join(&film->video, segments->film, format_of_film(film), film->width,
                                    film->height, &film->style, error);
    for (int i = 0; i < segments->count && status == HD_OK; i++) {
        char path[HD_MAX_PATH];
        status = hd_segment_path(segments, i, path, error);
        if (status == HD_OK)
            status = hd_video_add_part(film->video, path, hd_segment_frames(segments, i), error);
    }
    return status;
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
