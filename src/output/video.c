/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "output/video.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/limits.h"
#include "image/picture.h"
#include "system/atomic_file.h"
#include "system/child.h"
#include "system/durable.h"
#include "system/interrupt.h"

struct HdVideo {
    HdChild ffmpeg;
    const HdFormat *format;
    HdOutputStyle style;
    bool is_joined; /* of films, which FFmpeg is told; otherwise it gets frames */
    int width, height;
    long frames;
    char path[HD_MAX_PATH];
    char temporary[HD_MAX_PATH]; /* empty: there is no file */
    int lock;                    /* of that file; -1: there is none */
    char ffprobe[HD_MAX_PATH];
};

static HdStatus check_settings(const char *path, const HdFormat *format, int width, int height,
                               const HdOutputStyle *style, HdError *error) {
    if (width < 1 || width > HD_MAX_IMAGE_SIDE || height < 1 || height > HD_MAX_IMAGE_SIDE)
        return hd_fail(error, HD_BAD_INPUT, "the film %s has %d x %d pixels, expected 1..%d each",
                       path, width, height, HD_MAX_IMAGE_SIDE);
    if (!hd_format_is_film(format))
        return hd_fail(error, HD_BAD_INPUT,
                       "the film %s has another ending, expected " HD_FILM_ENDINGS, path);
    if (style->frames_per_second < 1)
        return hd_fail(error, HD_BAD_INPUT,
                       "the film %s has %d frames a second, expected at least 1", path,
                       style->frames_per_second);
    return hd_format_check_style(path, &style->picture, error);
}

enum { MAX_ARGUMENTS = 64, MAX_EXCUSE = 600 };

typedef struct Arguments {
    size_t count;
    const char *words[MAX_ARGUMENTS + 1]; /* NULL after the last */
} Arguments;

static void append(Arguments *arguments, const char *const *words) {
    while (*words != NULL && arguments->count < MAX_ARGUMENTS)
        arguments->words[arguments->count++] = *words++;
}

static const char *const join_input[] = {
    "-f", "concat", "-safe", "0", "-protocol_whitelist", "file,pipe", "-i", "pipe:0", NULL};

static const char *const *output_arguments(const HdVideo *video) {
    const HdFormat *format = video->format;
    if (video->is_joined && format->join_arguments != NULL)
        return format->join_arguments;
    return format->film_arguments(video->width, video->height, video->style.picture.curve);
}

/* "file:" keeps FFmpeg from reading a protocol or an option into the name. */
static HdStatus start_ffmpeg(HdVideo *video, const char *ffmpeg, HdError *error) {
    char size[32], rate[16], target[HD_MAX_PATH + 8];
    snprintf(size, sizeof size, "%dx%d", video->width, video->height);
    snprintf(rate, sizeof rate, "%d", video->style.frames_per_second);
    snprintf(target, sizeof target, "file:%s", video->temporary);
    /* clang-format off */
    const char *const start[] = {
        ffmpeg, "-nostdin", "-hide_banner", "-nostats", "-loglevel", "error", "-y", NULL};
    const char *const frames[] = {
        "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", size, "-framerate", rate,
        "-i", "pipe:0", NULL};
    /* clang-format on */
    const char *const end[] = {target, NULL};
    Arguments arguments = {0};
    append(&arguments, start);
    append(&arguments, video->is_joined ? join_input : frames);
    append(&arguments, output_arguments(video));
    append(&arguments, end);
    return hd_child_start(&video->ffmpeg, arguments.words, true, video->temporary, video->lock,
                          error);
}

static void remove_file(HdVideo *video) {
    if (video->temporary[0] != '\0')
        hd_temporary_remove(video->temporary);
    video->temporary[0] = '\0';
    if (video->lock >= 0)
        close(video->lock);
    video->lock = -1;
}

/* FFmpeg is given a name that exists: so it is taken against other processes. */
static HdStatus reserve_file(HdVideo *video, HdError *error) {
    HdStatus status =
        hd_temporary_create(video->path, HD_MODE_USUAL, video->temporary, &video->lock, error);
    if (status != HD_OK) {
        video->temporary[0] = '\0';
        video->lock = -1;
    }
    return status;
}

static HdStatus open_film(HdVideo *video, const char *path, HdError *error) {
    char ffmpeg[HD_MAX_PATH];
    HdStatus status = hd_child_find("ffmpeg", ffmpeg, error);
    if (status == HD_OK)
        status = hd_child_find("ffprobe", video->ffprobe, error);
    if (status == HD_OK && strlen(path) >= HD_MAX_PATH)
        status = hd_fail(error, HD_BAD_INPUT,
                         "the name of the film %s is too long, expected fewer than %d bytes", path,
                         HD_MAX_PATH);
    if (status != HD_OK)
        return status;
    memcpy(video->path, path, strlen(path) + 1);
    status = reserve_file(video, error);
    if (status == HD_OK)
        status = start_ffmpeg(video, ffmpeg, error);
    return status;
}

static HdStatus start_film(HdVideo **video, const char *path, const HdVideo *settings,
                           HdError *error) {
    *video = NULL;
    HdStatus status = check_settings(path, settings->format, settings->width, settings->height,
                                     &settings->style, error);
    if (status != HD_OK)
        return status;
    HdVideo *film = malloc(sizeof *film);
    if (film == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to make the film %s", path);
    *film = *settings;
    film->ffmpeg.input = film->ffmpeg.output = film->lock = -1;
    status = open_film(film, path, error);
    if (status == HD_OK)
        *video = film;
    else
        hd_video_abort(film);
    return status;
}

HdStatus hd_video_open(HdVideo **video, const char *path, const HdFormat *format, int width,
                       int height, const HdOutputStyle *style, HdError *error) {
    const HdVideo settings = {.format = format, .width = width, .height = height, .style = *style};
    return start_film(video, path, &settings, error);
}

HdStatus hd_video_join(HdVideo **video, const char *path, const HdFormat *format, int width,
                       int height, const HdOutputStyle *style, HdError *error) {
    const HdVideo settings = {
        .format = format, .width = width, .height = height, .style = *style, .is_joined = true};
    const HdStatus status = start_film(video, path, &settings, error);
    static const char head[] = "ffconcat version 1.0\n";
    /* Where FFmpeg does not take it, it does not take the first part either. */
    if (status == HD_OK)
        hd_child_send(&(*video)->ffmpeg, (const uint8_t *)head, sizeof head - 1);
    return status;
}

static HdStatus fail_interrupted(const HdVideo *video, const char *program, HdError *error) {
    return hd_fail(error, HD_INTERRUPTED, "interrupted while %s worked on %s", program,
                   video->path);
}

/* FFmpeg's words on a file that is gone mislead. */
static void blame_folder(const HdVideo *video, HdError *error) {
    HdError gone;
    if (hd_temporary_check(video->temporary, video->path, &gone) != HD_OK)
        *error = gone;
}

static HdStatus fail_stuck(const HdVideo *video, const char *program, const char *when,
                           HdChild *child, HdError *error) {
    return hd_fail(
        error, HD_FAILED,
        "%s stood still for %d s %s of %s and was ended (HEDRON_FFMPEG_PATIENCE sets the "
        "seconds); it said: %s",
        program, child->patience_s, when, video->path, hd_child_said(child));
}

static HdStatus fail_early(HdVideo *video, HdError *error) {
    char how[64];
    if (video->ffmpeg.is_stuck) {
        hd_child_stop(&video->ffmpeg);
        snprintf(how, sizeof how, "at frame %ld", video->frames);
        return fail_stuck(video, "FFmpeg", how, &video->ffmpeg, error);
    }
    hd_child_end(&video->ffmpeg, HD_CHILD_SILENCE_MS, how);
    hd_fail(error, HD_FAILED,
            "FFmpeg ended early (%s) while it was given frame %ld of %s; it said: %s", how,
            video->frames, video->path, hd_child_said(&video->ffmpeg));
    blame_folder(video, error);
    return HD_FAILED;
}

HdStatus hd_video_add(HdVideo *video, const HdFrame *frame, HdError *error) {
    if (frame->width != video->width || frame->height != video->height)
        return hd_fail(error, HD_BAD_INPUT,
                       "a frame of %d x %d pixels for the film %s, expected %d x %d", frame->width,
                       frame->height, video->path, video->width, video->height);
    if (video->ffmpeg.pid == 0)
        return hd_fail(error, HD_FAILED, "the film %s failed at frame %ld, it takes no more frames",
                       video->path, video->frames);
    if (!hd_child_send(&video->ffmpeg, frame->rgba,
                       (size_t)frame->width * (size_t)frame->height * 4))
        return hd_interrupt_signal() != 0 ? fail_interrupted(video, "FFmpeg", error)
                                          : fail_early(video, error);
    video->frames++;
    return HD_OK;
}

/* In single quotes, which FFmpeg reads as a shell does. The times are told, since each film knows
   its own only to a millisecond. */
static void describe_part(const HdVideo *video, const char *path, int frames, FILE *out) {
    const int rate = video->style.frames_per_second;
    const int64_t microseconds = ((int64_t)frames * 1000000 + rate / 2) / rate;
    fputs("file 'file:", out);
    for (const char *at = path; *at != '\0'; at++)
        if (*at == '\'')
            fputs("'\\''", out);
        else
            fputc(*at, out);
    fprintf(out, "'\nduration %" PRId64 ".%06" PRId64 "\n", microseconds / 1000000,
            microseconds % 1000000);
}

HdStatus hd_video_add_part(HdVideo *video, const char *path, int frames, HdError *error) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to join the film %s", video->path);
    describe_part(video, path, frames, out);
    HdStatus status = HD_OK;
    if (fclose(out) != 0)
        status =
            hd_fail(error, HD_FAILED, "out of memory: no room to join the film %s", video->path);
    else if (!hd_child_send(&video->ffmpeg, (const uint8_t *)text, size))
        status = hd_interrupt_signal() != 0 ? fail_interrupted(video, "FFmpeg", error)
                                            : fail_early(video, error);
    free(text);
    video->frames += frames;
    return status;
}

static HdStatus end_ffmpeg(HdVideo *video, HdError *error) {
    char how[64];
    if (video->ffmpeg.pid == 0)
        return hd_fail(error, HD_FAILED, "the film %s failed at frame %ld", video->path,
                       video->frames);
    if (video->frames == 0)
        return hd_fail(error, HD_FAILED, "the film %s has no frames, expected at least 1",
                       video->path);
    if (hd_child_end(&video->ffmpeg, HD_CHILD_WHILE_IT_WORKS, how))
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return fail_interrupted(video, "FFmpeg", error);
    if (video->ffmpeg.is_stuck)
        return fail_stuck(video, "FFmpeg", "after the last frame", &video->ffmpeg, error);
    return hd_fail(error, HD_FAILED, "FFmpeg could not make %s (%s); it said: %s", video->path, how,
                   hd_child_said(&video->ffmpeg));
}

/* What FFmpeg said although it ended with code 0, with room for it: a full disk, say. */
static const char *excuse(HdVideo *video, char words[MAX_EXCUSE]) {
    if (video->ffmpeg.said_length == 0)
        return "";
    snprintf(words, MAX_EXCUSE, "; FFmpeg had said: %.500s", hd_child_said(&video->ffmpeg));
    return words;
}

/* FFmpeg ends with code 0 even where its input was cut short, so only the file itself tells. */
static HdStatus count_frames(HdVideo *video, HdError *error) {
    char target[HD_MAX_PATH + 8], how[64], words[MAX_EXCUSE], *end;
    HdChild ffprobe;
    snprintf(target, sizeof target, "file:%s", video->temporary);
    /* clang-format off */
    const char *const arguments[] = {
        video->ffprobe, "-v", "error", "-select_streams", "v:0", "-count_packets",
        "-show_entries", "stream=nb_read_packets", "-of", "csv=p=0", target, NULL};
    /* clang-format on */
    HdStatus status = hd_child_start(&ffprobe, arguments, false, NULL, -1, error);
    if (status != HD_OK)
        return status;
    bool done = hd_child_end(&ffprobe, HD_CHILD_WHILE_IT_WORKS, how);
    if (!done && hd_interrupt_signal() != 0)
        return fail_interrupted(video, "ffprobe", error);
    if (ffprobe.is_stuck)
        return fail_stuck(video, "ffprobe", "while it counted the frames", &ffprobe, error);
    const char *answer = hd_child_said(&ffprobe);
    long found = strtol(answer, &end, 10);
    if (!done || *end != '\0')
        return hd_fail(error, HD_FAILED,
                       "ffprobe could not count the frames of %s (%s), expected %ld; it said: "
                       "%.500s%s",
                       video->path, how, video->frames, answer, excuse(video, words));
    if (found != video->frames)
        return hd_fail(error, HD_FAILED, "FFmpeg wrote %ld frames to %s, expected %ld%s", found,
                       video->path, video->frames, excuse(video, words));
    return HD_OK;
}

/* By its name, for FFmpeg may have put another file in the place of ours. */
static HdStatus sync_file(const HdVideo *video, HdError *error) {
    int descriptor = open(video->temporary, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return hd_fail(error, HD_FAILED, "cannot open %s: %s", video->temporary, strerror(errno));
    HdStatus status = hd_sync_file(descriptor, video->path, error);
    close(descriptor);
    return status;
}

static HdStatus publish(HdVideo *video, HdDurability durability, HdError *error) {
    HdFolderSet synced = {0};
    HdStatus status = durability == HD_DURABLE ? sync_file(video, error) : HD_OK;
    if (status != HD_OK)
        return status;
    status = hd_temporary_publish(video->temporary, video->path, error);
    video->temporary[0] = '\0';
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_sync_folder(&synced, video->path, error);
    return status;
}

HdStatus hd_video_close(HdVideo *video, HdDurability durability, HdError *error) {
    HdStatus status = end_ffmpeg(video, error);
    if (status == HD_OK)
        status = count_frames(video, error);
    if (status == HD_FAILED)
        blame_folder(video, error);
    if (status == HD_OK)
        status = publish(video, durability, error);
    hd_video_abort(video);
    return status;
}

void hd_video_abort(HdVideo *video) {
    hd_child_stop(&video->ffmpeg);
    remove_file(video);
    free(video);
}
