/* SPDX-License-Identifier: MIT */
/* Makes a film with FFmpeg's programs from raw frames. */
#ifndef HD_OUTPUT_VIDEO_H
#define HD_OUTPUT_VIDEO_H

#include <stdbool.h>

#include "base/error.h"
#include "image/format.h"
#include "system/atomic_file.h"

typedef struct HdVideo HdVideo;

/* A film's settled properties. */
typedef struct HdVideoPlan {
    const HdFormat *format; /* format of a film */
    int width, height;
    HdOutputStyle style;
    bool is_joined; /* joins other films (hd_video_add_part); otherwise gets frames */
} HdVideoPlan;

/* Finds FFmpeg ("ffmpeg" and "ffprobe" in PATH), makes missing folders, and starts FFmpeg without a
   shell, writing to a temporary file in the folder of `path`. Formats: MP4 and MOV are H.264, WebM
   is VP9, both yuv420p, BT.709, an odd width or height padded by one pixel. MKV is FFV1, lossless
   RGB. GIF has a palette for each frame, ordered dither, an endless loop, and times rounded to
   centiseconds. Frames are 8-bit RGBA of one size, alpha 255, on the style's curve, which the film
   names; a GIF must be sRGB, or it is HD_BAD_INPUT. Joined films have that size and style, and the
   segment format of `format`; only a GIF is encoded again. Fails with HD_UNAVAILABLE if FFmpeg is
   missing. */
HdStatus hd_video_open(HdVideo **video, const char *path, const HdVideoPlan *plan, HdError *error);

/* Adds the next film to join, and its number of frames. */
HdStatus hd_video_add_part(HdVideo *video, const char *path, int frames, HdError *error);

/* Sends a frame's `rgba` of the plan's size, unless one failed before. Blocks while FFmpeg is busy;
   fails if FFmpeg neither reads nor prints for 600 s, or HEDRON_FFMPEG_PATIENCE seconds. If FFmpeg
   exited, the error quotes the end of its output, or is HD_UNAVAILABLE if FFmpeg lacks the encoder;
   no signal occurs. */
HdStatus hd_video_add(HdVideo *video, const HdFrame *frame, HdError *error);

/* Completes a film that has frames, none of which failed. Waits for FFmpeg, with the same timeout,
   checks its exit code, compares the file's frame count (ffprobe) with the frames added, and
   renames the file. With HD_DURABLE syncs the file before and its name after. Frees `video` also on
   failure, which leaves no file. */
HdStatus hd_video_close(HdVideo *video, HdDurability durability, HdError *error);

/* Stops FFmpeg, removes the temporary file, frees `video`. */
void hd_video_abort(HdVideo *video);

#endif
