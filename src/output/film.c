/* SPDX-License-Identifier: MIT */
#include "output/film.h"

#include <stdlib.h>

struct HdFilm {
    HdSegments *segments;
    int width, height;
    HdOutputStyle style;
    HdDurability durability;
    HdVideo *video; /* NULL: none is being made */
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

HdStatus hd_film_open(HdFilm **out, HdSegments *segments, int width, int height,
                      const HdOutputStyle *style, HdDurability durability, HdError *error) {
    HdFilm *film = calloc(1, sizeof *film);
    int index = 0;
    if (film == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to make the film %s",
                       segments->film);
    *film = (HdFilm){segments, width, height, *style, durability, NULL};
    while (index < segments->count && hd_segments_have(segments, hd_segment_begin(segments, index)))
        index++;
    HdStatus status = index < segments->count ? open_video(film, index, error) : HD_OK;
    if (status == HD_OK)
        *out = film;
    else
        hd_film_abort(film);
    return status;
}

/* Where it is a segment's: a film has more to come, or is closed with the others. */
static HdStatus end_segment(HdFilm *film, int index, HdError *error) {
    HdVideo *video = film->video;
    film->video = NULL;
    const HdStatus status = hd_video_close(video, film->durability, error);
    film->segments->is_whole[index] = status == HD_OK;
    return status;
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
    HdStatus status = film->segments->count > 1 ? join(film, error) : HD_OK;
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
    if (film->video != NULL)
        hd_video_abort(film->video);
    free(film);
}
