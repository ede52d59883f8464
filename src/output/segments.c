/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "output/segments.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "output/fingerprint.h"
#include "system/atomic_file.h"

/* Whole seconds, so that the times of the frames are those of a film made in one go. */
static int length_of(int frames_per_second) {
    int length = frames_per_second;
    while (length < HD_LEAST_SEGMENT)
        length += frames_per_second;
    return length;
}

/* What is between the film's name and a segment's number. */
static const char infix[] = ".part-";

/* Which files lie beside a film. */
typedef enum Kind { WRITTEN, SEGMENTS } Kind;

static bool is_segment(const char *name) {
    int end = 0;
    return sscanf(name, "%*[0-9]-%*16[0-9a-f]%n", &end) == 0 && end > 0 && name[end] == '\0';
}

static bool is_of_kind(const char *entry, const char *film, Kind kind) {
    const size_t length = strlen(film);
    if (strncmp(entry, film, length) != 0 || strncmp(entry + length, infix, sizeof infix - 1) != 0)
        return false;
    if (kind == SEGMENTS)
        return is_segment(entry + length + sizeof infix - 1);
    return hd_temporary_name_length(entry) > 0;
}

/* What is written to is locked, and stays. */
static void remove_files(const HdSegments *segments, Kind kind) {
    const char *slash = strrchr(segments->film, '/');
    const char *film = slash != NULL ? slash + 1 : segments->film;
    char folder[HD_MAX_PATH] = "";
    memcpy(folder, segments->film, (size_t)(film - segments->film));
    folder[film - segments->film] = '\0';
    DIR *entries = opendir(folder[0] != '\0' ? folder : ".");
    const struct dirent *entry;
    while (entries != NULL && (entry = readdir(entries)) != NULL) {
        char path[HD_MAX_PATH + sizeof entry->d_name];
        if (!is_of_kind(entry->d_name, film, kind))
            continue;
        snprintf(path, sizeof path, "%s%s", folder, entry->d_name);
        if (kind == SEGMENTS)
            remove(path);
        else
            hd_temporary_remove_stale(path);
    }
    if (entries != NULL)
        closedir(entries);
}

static uint64_t name_of(const HdSegments *segments, const HdOutputPlan *plan,
                        const HdOutput *output, const HdFrameList *frames, int index) {
    const int begin = hd_segment_begin(segments, index);
    const char *format = output->format->name;
    uint64_t hash = hd_hash_bytes(plan->fingerprint, format, strlen(format));
    hash = hd_frame_fingerprint(hash, plan->style.frames_per_second);
    for (int i = 0; i < hd_segment_frames(segments, index); i++)
        hash = hd_frame_fingerprint(hash, frames->frames[begin + i]);
    return hash;
}

static HdStatus look_at_files(HdSegments *segments, const HdOutputPlan *plan,
                              const HdOutput *output, const HdFrameList *frames, HdError *error) {
    HdStatus status = HD_OK;
    remove_files(segments, WRITTEN);
    for (int i = 0; i < segments->count && status == HD_OK; i++) {
        char path[HD_MAX_PATH];
        struct stat found;
        segments->names[i] = name_of(segments, plan, output, frames, i);
        status = hd_segment_path(segments, i, path, error);
        segments->is_whole[i] = status == HD_OK && plan->resumes && lstat(path, &found) == 0 &&
                                S_ISREG(found.st_mode) && found.st_size > 0;
    }
    return status;
}

HdStatus hd_segments_find(HdSegments *segments, const HdOutputPlan *plan, const HdOutput *output,
                          const HdFrameList *frames, HdError *error) {
    *segments = (HdSegments){.frame_count = frames->count, .length = frames->count, .count = 1};
    HdStatus status = output->is_film ? hd_output_file(output, 0, segments->film, error) : HD_OK;
    if (status != HD_OK || !output->is_film || !plan->keeps_films)
        return status;
    const int length = length_of(plan->style.frames_per_second);
    if (frames->count <= length)
        return HD_OK;
    segments->length = length;
    segments->count = (frames->count + length - 1) / length;
    segments->names = calloc((size_t)segments->count, sizeof *segments->names);
    segments->is_whole = calloc((size_t)segments->count, sizeof *segments->is_whole);
    if (segments->names == NULL || segments->is_whole == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for a list of %d segments",
                       segments->count);
    return look_at_files(segments, plan, output, frames, error);
}

bool hd_segments_have(const HdSegments *segments, int item) {
    return segments->count > 1 && segments->is_whole[item / segments->length];
}

int hd_segment_begin(const HdSegments *segments, int index) {
    return index * segments->length;
}

int hd_segment_frames(const HdSegments *segments, int index) {
    const int rest = segments->frame_count - hd_segment_begin(segments, index);
    return rest < segments->length ? rest : segments->length;
}

HdStatus hd_segment_path(const HdSegments *segments, int index, char out[HD_MAX_PATH],
                         HdError *error) {
    const int length = snprintf(out, HD_MAX_PATH, "%s%s%04d-%016" PRIx64, segments->film, infix,
                                index, segments->names[index]);
    if (length >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "the name of the film %s is too long for those of its segments",
                       segments->film);
    return HD_OK;
}

void hd_segments_remove(const HdSegments *segments) {
    remove_files(segments, SEGMENTS);
}

void hd_segments_free(HdSegments *segments) {
    free(segments->names);
    free(segments->is_whole);
    *segments = (HdSegments){.count = 1};
}
