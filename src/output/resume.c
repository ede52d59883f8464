/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "output/resume.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "image/format.h"
#include "output/fingerprint.h"
#include "system/interrupt.h"
#include "system/path.h"

static const int64_t MAX_PICTURE_BYTES = INT64_C(1) << 36;

/* A file that cannot be read is not finished. The caller frees `*bytes` even then. */
static bool read_whole(const HdOutputPlan *plan, const HdOutput *output, int number,
                       unsigned char **bytes, size_t *size) {
    char path[HD_MAX_PATH];
    HdError ignored;
    *bytes = NULL;
    return hd_output_file(output, number, path, &ignored) == HD_OK &&
           hd_file_read(path, "picture", MAX_PICTURE_BYTES, bytes, size, &ignored) == HD_OK &&
           hd_png_is_whole(*bytes, *size, hd_frame_fingerprint(plan->fingerprint, number));
}

static const HdOutput *first_picture(const HdOutputPlan *plan) {
    const HdOutput *output = plan->list;
    while (output->is_film)
        output++;
    return output;
}

bool hd_resume_film_lacks(const HdResume *resume, int output, int item) {
    const HdSegments *film = &resume->films[output];
    return film->film[0] != '\0' && !hd_segments_have(film, item);
}

/* Films are made of pictures of 8 bits, which hold the background. */
bool hd_resume_keeps(const HdResume *resume, const HdOutputPlan *plan, int item) {
    if (plan->film_count < plan->count && plan->style.picture.bits == 8 &&
        !plan->style.picture.has_alpha)
        return true;
    for (int i = 0; i < plan->count; i++)
        if (hd_resume_film_lacks(resume, i, item))
            return false;
    return true;
}

static bool is_finished(const HdResume *resume, const HdOutputPlan *plan, int item) {
    bool whole = hd_resume_keeps(resume, plan, item);
    for (int i = 0; i < plan->count && whole; i++) {
        unsigned char *bytes = NULL;
        size_t size;
        whole = plan->list[i].is_film ||
                read_whole(plan, &plan->list[i], resume->all->frames[item], &bytes, &size);
        free(bytes);
    }
    return whole;
}

typedef struct Presence {
    HdFrameNames names;
    bool *is_there; /* entries found, by index in the list */
} Presence;

static void note_presence(void *context, const char *entry) {
    Presence *presence = context;
    const int place = hd_frame_names_place(&presence->names, entry, strlen(entry), false);
    if (place >= 0)
        presence->is_there[place] = true;
}

/* Marks frames that have an entry in the first picture output, all of whose frames have numbers;
   one listing of its folder serves all frames. */
static void mark_present(HdResume *resume, const HdOutputPlan *plan) {
    Presence presence = {.is_there = resume->is_finished};
    HdError ignored;
    if (hd_frame_names_find(&presence.names, first_picture(plan), resume->all, &ignored) == HD_OK)
        hd_path_visit(presence.names.folder, note_presence, &presence);
}

static HdStatus look_at_frames(HdResume *resume, const HdOutputPlan *plan, HdError *error) {
    if (plan->resumes && plan->film_count < plan->count)
        mark_present(resume, plan);
    else if (plan->resumes)
        memset(resume->is_finished, true, (size_t)resume->all->count);
    for (int i = 0; i < resume->all->count; i++) {
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted after 0 of %d frames",
                           resume->all->count);
        resume->is_finished[i] = resume->is_finished[i] && is_finished(resume, plan, i);
        if (resume->is_finished[i])
            resume->finished_count++;
        else
            resume->missing.frames[resume->missing.count++] = resume->all->frames[i];
        if (resume->missing.count == 0)
            resume->first_missing = i + 1;
    }
    return HD_OK;
}

HdStatus hd_resume_find(HdResume *resume, const HdOutputPlan *plan, const HdFrameList *frames,
                        HdError *error) {
    const size_t count = (size_t)frames->count;
    *resume = (HdResume){.all = frames};
    resume->missing.frames = malloc(count * sizeof *resume->missing.frames);
    resume->is_finished = calloc(count, sizeof *resume->is_finished);
    if (resume->missing.frames == NULL || resume->is_finished == NULL)
        return HD_NO_ROOM(error, "a list of %zu frames", count);
    for (int i = 0; i < plan->count; i++)
        HD_TRY(hd_segments_find(&resume->films[i], plan, &plan->list[i], frames, error));
    return look_at_frames(resume, plan, error);
}

HdStatus hd_resume_load(const HdOutputPlan *plan, int number, HdFrame *frame, HdError *error) {
    unsigned char *bytes;
    size_t size;
    const HdOutput *output = first_picture(plan);
    HdStatus status = HD_FAILED;
    if (read_whole(plan, output, number, &bytes, &size))
        status = output->format->load(frame, bytes, size, output->name, error);
    else
        hd_fail(error, HD_FAILED,
                "frame %d of %s was finished, but has changed since or cannot be read: start the "
                "run again",
                number, output->name);
    free(bytes);
    return status;
}

void hd_resume_free(HdResume *resume) {
    hd_frame_list_free(&resume->missing);
    free(resume->is_finished);
    for (int i = 0; i < HD_MAX_OUTPUTS; i++)
        hd_segments_free(&resume->films[i]);
    *resume = (HdResume){0};
}

/* ---- files of killed runs ---- */

enum { ORPHAN_POLLS = 1000 /* 10 ms each */ };

typedef struct Search {
    HdFrameNames names; /* names of the output's files, or of folders with one each */
    bool is_film;
    bool is_done; /* nothing was found that needs waiting */
} Search;

static void remove_if_stale(void *context, const char *entry) {
    Search *search = context;
    const HdFrameNames *names = &search->names;
    const size_t length = hd_temporary_name_length(entry), film = strlen(names->prefix);
    const bool is_of_segment =
        search->is_film && strncmp(entry, names->prefix, film) == 0 &&
        strncmp(entry + film, HD_SEGMENT_INFIX, strlen(HD_SEGMENT_INFIX)) == 0;
    char path[HD_MAX_PATH];
    if (length == 0 ||
        (!is_of_segment &&
         hd_frame_names_place(names, entry, length, length == HD_TEMPORARY_MAX_KEPT) < 0))
        return;
    if (snprintf(path, sizeof path, "%s%s", names->folder, entry) < HD_MAX_PATH)
        search->is_done &= hd_temporary_remove_stale(path);
}

/* Searches the own folder of one frame. */
static void search_own_folder(void *context, const char *entry) {
    Search *search = context;
    const HdFrameNames *names = &search->names;
    Search own = {.names.frames = names->frames, .is_done = true};
    char path[HD_MAX_PATH];
    if (hd_frame_names_place(names, entry, strlen(entry), false) < 0 ||
        snprintf(path, sizeof path, "%s%s%s", names->folder, entry, names->rest) >= HD_MAX_PATH)
        return;
    const size_t folder = hd_folder_length(path);
    memcpy(own.names.folder, path, folder);
    memcpy(own.names.prefix, path + folder, strlen(path + folder));
    hd_path_visit(own.names.folder, remove_if_stale, &own);
    search->is_done &= own.is_done;
}

static bool remove_stale(const HdOutputPlan *plan, const HdFrameList *frames) {
    bool is_done = true;
    for (int i = 0; i < plan->count; i++) {
        Search search = {.is_film = plan->list[i].is_film, .is_done = true};
        HdError ignored;
        if (hd_frame_names_find(&search.names, &plan->list[i], frames, &ignored) != HD_OK)
            continue;
        hd_path_visit(search.names.folder,
                      search.names.rest[0] == '\0' ? remove_if_stale : search_own_folder, &search);
        is_done &= search.is_done;
    }
    return is_done;
}

void hd_stale_files_remove(const HdOutputPlan *plan, const HdFrameList *frames) {
    const struct timespec poll_interval = {.tv_nsec = 10000000};
    for (int i = 0; i < ORPHAN_POLLS && hd_interrupt_signal() == 0; i++) {
        if (remove_stale(plan, frames))
            return;
        nanosleep(&poll_interval, NULL);
    }
}
