/* SPDX-License-Identifier: MIT */
/* Films: what FFmpeg is told about the file. */
#include "image/format.h"

enum { MIN_SLICED_SIDE = 64 };

/* clang-format off */
static const char *const mp4_arguments[] = {
    "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
    "-c:v", "libx264", "-preset", "superfast", "-crf", "18", "-pix_fmt", "yuv420p",
    "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
    "-color_range", "tv", "-movflags", "+faststart", "-f", "mp4", NULL};

/* Every frame is a key frame, so that players can jump to it. The container is given no random
   number, so that the same frames make the same bytes. */
#define MKV_ARGUMENTS \
    "-c:v", "ffv1", "-g", "1", "-pix_fmt", "bgr0", "-colorspace", "rgb", \
    "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "pc", \
    "-fflags", "+bitexact", "-f", "matroska", NULL

/* Slices are coded side by side and have checksums, but FFmpeg errs where they are few pixels. */
static const char *const sliced_mkv_arguments[] = {
    "-level", "3", "-slices", "16", "-slicecrc", "1", MKV_ARGUMENTS};
static const char *const whole_mkv_arguments[] = {"-level", "1", MKV_ARGUMENTS};

/* A palette for each frame: one for all would keep every frame in memory until the last. The ordered
   dither keeps still what does not move, and compresses well. */
static const char gif_filters[] =
    "split[seen][painted];"
    "[seen]palettegen=stats_mode=single:reserve_transparent=0[palette];"
    "[painted][palette]paletteuse=new=1:dither=bayer:bayer_scale=4";
static const char *const gif_arguments[] = {
    "-filter_complex", gif_filters, "-loop", "0", "-f", "gif", NULL};
/* clang-format on */

static const char *const *mp4(int width, int height) {
    (void)width;
    (void)height;
    return mp4_arguments;
}

static const char *const *mkv(int width, int height) {
    bool is_sliced = width >= MIN_SLICED_SIDE && height >= MIN_SLICED_SIDE;
    return is_sliced ? sliced_mkv_arguments : whole_mkv_arguments;
}

static const char *const *gif(int width, int height) {
    (void)width;
    (void)height;
    return gif_arguments;
}

const HdFormat hd_format_mp4 = {.name = "MP4", .film_arguments = mp4};
const HdFormat hd_format_mkv = {.name = "MKV", .film_arguments = mkv};
const HdFormat hd_format_gif = {.name = "GIF", .film_arguments = gif};
