/* SPDX-License-Identifier: MIT */
/* A film made by FFmpeg's programs from raw frames. */
#ifndef HD_OUTPUT_VIDEO_H
#define HD_OUTPUT_VIDEO_H

#include "base/error.h"
#include "image/format.h"
#include "system/atomic_file.h"

typedef struct HdVideo HdVideo;

/* Finds FFmpeg ("ffmpeg" and "ffprobe" in PATH), makes missing folders, and starts FFmpeg without a
   shell, writing to a temporary name beside `path`. The format must be a film's and tells what is
   made: MP4, H.264, yuv420p, BT.709, an odd width or height padded by one pixel; MKV, FFV1, the
   frames' RGB without loss; GIF, a palette for each frame, ordered dither, repeating for ever,
   times rounded to centiseconds. Frames are 8-bit RGBA of one size, alpha 255, on the style's
   curve, as the film says; a GIF can only say sRGB, and with another curve is HD_BAD_INPUT.
   HD_UNAVAILABLE where FFmpeg is missing. */
HdStatus hd_video_open(HdVideo **video, const char *path, const HdFormat *format, int width,
                       int height, const HdOutputStyle *style, HdError *error);

/* The same for a film that is joined of others, in the order of hd_video_add_part: films of that
   size and style, and of the format that segments of `format` have. Nothing is encoded again but a
   GIF. */
HdStatus hd_video_join(HdVideo **video, const char *path, const HdFormat *format, int width,
                       int height, const HdOutputStyle *style, HdError *error);

/* Names the next film, and how many frames it has. */
HdStatus hd_video_add_part(HdVideo *video, const char *path, int frames, HdError *error);

/* Hands over `rgba` of one frame; blocks while FFmpeg is busy. An FFmpeg that ended early is an
   error that quotes the end of what it said, never a signal. */
HdStatus hd_video_add(HdVideo *video, const HdFrame *frame, HdError *error);

/* Ends the film: waits for FFmpeg, checks its exit code, counts the frames of the file with ffprobe
   against the frames added, renames the file to its final name; with HD_DURABLE it is on the disk
   before, and its name afterwards. Frees `video` in every case; on failure no file is left. */
HdStatus hd_video_close(HdVideo *video, HdDurability durability, HdError *error);

/* Stops FFmpeg, removes the temporary file, frees `video`. */
void hd_video_abort(HdVideo *video);

#endif
