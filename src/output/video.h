/* SPDX-License-Identifier: MIT */
/* A film made by FFmpeg's programs from raw frames. */
#ifndef HD_OUTPUT_VIDEO_H
#define HD_OUTPUT_VIDEO_H

#include <stdbool.h>

#include "base/error.h"
#include "image/format.h"
#include "system/atomic_file.h"

typedef struct HdVideo HdVideo;

/* As the outputs were settled. */
typedef struct HdVideoPlan {
    const HdFormat *format; /* of a film */
    int width, height;
    HdOutputStyle style;
    bool is_joined; /* of other films, which hd_video_add_part names; otherwise it gets frames */
} HdVideoPlan;

/* Finds FFmpeg ("ffmpeg" and "ffprobe" in PATH), makes missing folders, and starts FFmpeg without a
   shell, writing to a temporary name beside `path`. The format tells what is made: MP4, H.264,
   yuv420p, BT.709, an odd width or height padded by one pixel; MKV, FFV1, the frames' RGB without
   loss; GIF, a palette for each frame, ordered dither, repeating for ever, times rounded to
   centiseconds. Frames are 8-bit RGBA of one size, alpha 255, on the style's curve, as the film
   says; a GIF can only say sRGB, and with another curve is HD_BAD_INPUT. Films that are joined are
   of that size and style, and of the format that segments of `format` have; nothing is encoded
   again but a GIF. HD_UNAVAILABLE where FFmpeg is missing. */
HdStatus hd_video_open(HdVideo **video, const char *path, const HdVideoPlan *plan, HdError *error);

/* Names the next film, and how many frames it has. */
HdStatus hd_video_add_part(HdVideo *video, const char *path, int frames, HdError *error);

/* Hands over `rgba` of one frame of the plan's size, unless one failed before; blocks while FFmpeg
   is busy, but at most for 600 s, or what HEDRON_FFMPEG_PATIENCE says, while it takes nothing and
   says nothing. An FFmpeg that ended early is an error that quotes the end of what it said, never a
   signal. */
HdStatus hd_video_add(HdVideo *video, const HdFrame *frame, HdError *error);

/* Ends a film that has frames, none of which failed: waits for FFmpeg, with the same patience,
   checks its exit code, counts the frames of the file with ffprobe against the frames added,
   renames the file to its final name; with HD_DURABLE it is on the disk before, and its name
   afterwards. Frees `video` in every case; on failure no file is left. */
HdStatus hd_video_close(HdVideo *video, HdDurability durability, HdError *error);

/* Stops FFmpeg, removes the temporary file, frees `video`. */
void hd_video_abort(HdVideo *video);

#endif
