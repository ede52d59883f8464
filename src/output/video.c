/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "output/video.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "system/atomic_file.h"
#include "system/child.h"
#include "system/interrupt.h"

enum {
    TIMEOUT_S = 600, /* default of HEDRON_FFMPEG_PATIENCE */
    MAX_TIMEOUT_S = 86400,
    EXIT_TIMEOUT_MS = 3000 /* time to exit after it stopped reading */
};

struct HdVideo {
    HdChild ffmpeg;
    int timeout_ms; /* timeout of FFmpeg and ffprobe */
    HdVideoPlan plan;
    long frames;
    HdAtomicFile file; /* output of FFmpeg */
    char ffprobe[HD_MAX_PATH];
};

enum { MAX_ARGUMENTS = 64, MAX_EXCUSE = 600 };

static const uint8_t join_head[] = "ffconcat version 1.0\n";
static const char *const join_input[] = {
    "-f", "concat", "-safe", "0", "-protocol_whitelist", "file,pipe", "-i", "pipe:0", NULL};

static const char *const *output_arguments(const HdVideoPlan *plan) {
    if (plan->is_joined && plan->format->join_arguments != NULL)
        return plan->format->join_arguments;
    const HdCurve curve = plan->style.picture.curve;
    const bool is_small = plan->width < HD_SLICED_SIDE || plan->height < HD_SLICED_SIDE;
    return is_small && plan->format->small_film_arguments[curve] != NULL
               ? plan->format->small_film_arguments[curve]
               : plan->format->film_arguments[curve];
}

/* "file:" keeps FFmpeg from reading a protocol or an option into the name. */
static HdStatus start_ffmpeg(HdVideo *video, const char *ffmpeg, HdError *error) {
    char size[32], rate[16], target[HD_MAX_PATH + 8];
    snprintf(size, sizeof size, "%dx%d", video->plan.width, video->plan.height);
    snprintf(rate, sizeof rate, video->plan.style.is_ntsc ? "%d000/1001" : "%d",
             video->plan.style.frames_per_second);
    snprintf(target, sizeof target, "file:%s", video->file.temporary);
    /* clang-format off */
    const char *const start[] = {
        ffmpeg, "-nostdin", "-hide_banner", "-nostats", "-loglevel", "error", "-y", NULL};
    const char *const frames[] = {
        "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", size, "-framerate", rate,
        "-i", "pipe:0", NULL};
    /* clang-format on */
    const char *const *const parts[] = {start, video->plan.is_joined ? join_input : frames,
                                        output_arguments(&video->plan)};
    const char *arguments[MAX_ARGUMENTS + 2];
    size_t count = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        for (const char *const *word = parts[i]; *word != NULL && count < MAX_ARGUMENTS; word++)
            arguments[count++] = *word;
    arguments[count] = target;
    arguments[count + 1] = NULL;
    return hd_child_start(&video->ffmpeg, arguments, true, video->file.lock, error);
}

static HdStatus read_timeout(int *milliseconds, HdError *error) {
    const char *text = getenv("HEDRON_FFMPEG_PATIENCE");
    char *end;
    *milliseconds = 1000 * TIMEOUT_S;
    if (text == NULL || text[0] == '\0')
        return HD_OK;
    const long wanted = strtol(text, &end, 10);
    if (*end != '\0' || wanted < 1 || wanted > MAX_TIMEOUT_S)
        return hd_fail(error, HD_BAD_INPUT,
                       "HEDRON_FFMPEG_PATIENCE is '%.200s', expected whole seconds from 1 to %d",
                       text, MAX_TIMEOUT_S);
    *milliseconds = 1000 * (int)wanted;
    return HD_OK;
}

/* The file exists before FFmpeg starts, which reserves its name against other processes. */
static HdStatus open_film(HdVideo *video, const char *path, HdError *error) {
    char ffmpeg[HD_MAX_PATH];
    HD_TRY(read_timeout(&video->timeout_ms, error));
    HD_TRY(hd_child_find("ffmpeg", ffmpeg, error));
    HD_TRY(hd_child_find("ffprobe", video->ffprobe, error));
    HD_TRY(hd_atomic_file_reserve(&video->file, path, error));
    HD_TRY(start_ffmpeg(video, ffmpeg, error));
    /* If FFmpeg does not accept it, it will not accept the first part either. */
    if (video->plan.is_joined)
        hd_child_send(&video->ffmpeg, join_head, sizeof join_head - 1, video->timeout_ms);
    return HD_OK;
}

HdStatus hd_video_open(HdVideo **out, const char *path, const HdVideoPlan *plan, HdError *error) {
    HdVideo *video = malloc(sizeof *video);
    *out = NULL;
    if (video == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to make the film %s", path);
    *video = (HdVideo){.plan = *plan, .ffmpeg = {.input = -1, .output = -1}, .file = {.lock = -1}};
    const HdStatus status = open_film(video, path, error);
    if (status == HD_OK)
        *out = video;
    else
        hd_video_abort(video);
    return status;
}

static HdStatus fail_interrupted(const HdVideo *video, const char *program, HdError *error) {
    return hd_fail(error, HD_INTERRUPTED, "interrupted while %s worked on %s", program,
                   video->file.path);
}

/* Replaces FFmpeg's message if the file is gone, for it misleads. */
static void report_missing_file(const HdVideo *video, HdError *error) {
    HdError gone;
    if (hd_atomic_file_check(&video->file, &gone) != HD_OK)
        *error = gone;
}

static HdStatus fail_idle(const HdVideo *video, const char *program, const char *when,
                          HdChild *child, HdError *error) {
    return hd_fail(error, HD_FAILED,
                   "%s was idle for %d s %s of %s and was stopped (HEDRON_FFMPEG_PATIENCE sets the "
                   "seconds); it said: %s",
                   program, video->timeout_ms / 1000, when, video->file.path, hd_child_tail(child));
}

/* Reports an encoder that this FFmpeg was built without. */
static bool lacks_encoder(HdVideo *video, HdError *error) {
    const char *what = strstr(hd_child_tail(&video->ffmpeg), "Unknown encoder");
    if (what != NULL)
        hd_fail(error, HD_UNAVAILABLE,
                "FFmpeg cannot make %s: %.*s; expected an FFmpeg with that encoder, or another "
                "format of film",
                video->file.path, (int)strcspn(what, "\n"), what);
    return what != NULL;
}

static HdStatus fail_early(HdVideo *video, HdError *error) {
    char how[64];
    hd_child_end(&video->ffmpeg, EXIT_TIMEOUT_MS, how);
    if (hd_interrupt_signal() != 0)
        return fail_interrupted(video, "FFmpeg", error);
    if (lacks_encoder(video, error))
        return HD_UNAVAILABLE;
    hd_fail(error, HD_FAILED, "FFmpeg ended early (%s) at frame %ld of %s; it said: %s", how,
            video->frames, video->file.path, hd_child_tail(&video->ffmpeg));
    report_missing_file(video, error);
    return HD_FAILED;
}

/* Blocks while FFmpeg is busy. */
static HdStatus send(HdVideo *video, const void *bytes, size_t size, HdError *error) {
    char when[64];
    if (hd_child_send(&video->ffmpeg, bytes, size, video->timeout_ms))
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return fail_interrupted(video, "FFmpeg", error);
    if (!video->ffmpeg.is_stuck)
        return fail_early(video, error);
    hd_child_stop(&video->ffmpeg);
    snprintf(when, sizeof when, "at frame %ld", video->frames);
    return fail_idle(video, "FFmpeg", when, &video->ffmpeg, error);
}

HdStatus hd_video_add(HdVideo *video, const HdFrame *frame, HdError *error) {
    HD_TRY(send(video, frame->rgba, (size_t)frame->width * (size_t)frame->height * 4, error));
    video->frames++;
    return HD_OK;
}

/* Quotes as FFmpeg does, like a shell. Gives the times, since each film has its own only to a
   millisecond. */
static void describe_part(const HdVideo *video, const char *path, int frames, FILE *out) {
    const int rate = video->plan.style.frames_per_second;
    const int64_t second = video->plan.style.is_ntsc ? 1001000 : 1000000;
    const int64_t microseconds = (frames * second + rate / 2) / rate;
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
    if (out != NULL)
        describe_part(video, path, frames, out);
    HdStatus status = out != NULL && fclose(out) == 0
                          ? send(video, text, size, error)
                          : hd_fail(error, HD_FAILED, "out of memory: no room to join the film %s",
                                    video->file.path);
    free(text);
    video->frames += frames;
    return status;
}

static HdStatus end_ffmpeg(HdVideo *video, HdError *error) {
    char how[64];
    if (hd_child_end(&video->ffmpeg, video->timeout_ms, how))
        return HD_OK;
    if (hd_interrupt_signal() != 0)
        return fail_interrupted(video, "FFmpeg", error);
    if (video->ffmpeg.is_stuck)
        return fail_idle(video, "FFmpeg", "after the last frame", &video->ffmpeg, error);
    if (lacks_encoder(video, error))
        return HD_UNAVAILABLE;
    return hd_fail(error, HD_FAILED, "FFmpeg could not make %s (%s); it said: %s", video->file.path,
                   how, hd_child_tail(&video->ffmpeg));
}

/* FFmpeg exits with code 0 even if its input was cut short, so only the file itself can tell. */
static HdStatus count_frames(HdVideo *video, HdError *error) {
    char target[HD_MAX_PATH + 8], how[64], excuse[MAX_EXCUSE] = "", *end;
    HdChild ffprobe;
    snprintf(target, sizeof target, "file:%s", video->file.temporary);
    /* clang-format off */
    const char *const arguments[] = {
        video->ffprobe, "-v", "error", "-select_streams", "v:0", "-count_packets",
        "-show_entries", "stream=nb_read_packets", "-of", "csv=p=0", target, NULL};
    /* clang-format on */
    HD_TRY(hd_child_start(&ffprobe, arguments, false, -1, error));
    bool done = hd_child_end(&ffprobe, video->timeout_ms, how);
    if (!done && hd_interrupt_signal() != 0)
        return fail_interrupted(video, "ffprobe", error);
    if (ffprobe.is_stuck)
        return fail_idle(video, "ffprobe", "while it counted the frames", &ffprobe, error);
    /* FFmpeg's messages despite exit code 0: a full disk, say. */
    if (video->ffmpeg.tail_length > 0)
        snprintf(excuse, MAX_EXCUSE, "; FFmpeg had said: %.500s", hd_child_tail(&video->ffmpeg));
    const char *answer = hd_child_tail(&ffprobe);
    long found = strtol(answer, &end, 10);
    if (!done || *end != '\0')
        return hd_fail(error, HD_FAILED,
                       "ffprobe could not count the frames of %s (%s), expected %ld; it said: "
                       "%.500s%s",
                       video->file.path, how, video->frames, answer, excuse);
    if (found != video->frames)
        return hd_fail(error, HD_FAILED, "FFmpeg wrote %ld frames to %s, expected %ld%s", found,
                       video->file.path, video->frames, excuse);
    return HD_OK;
}

HdStatus hd_video_close(HdVideo *video, HdDurability durability, HdError *error) {
    HdStatus status = end_ffmpeg(video, error);
    if (status == HD_OK)
        status = count_frames(video, error);
    if (status == HD_FAILED)
        report_missing_file(video, error);
    if (status == HD_OK)
        status = hd_atomic_file_commit(&video->file, durability, error);
    hd_video_abort(video);
    return status;
}

void hd_video_abort(HdVideo *video) {
    hd_child_stop(&video->ffmpeg);
    hd_atomic_file_discard(&video->file);
    free(video);
}
