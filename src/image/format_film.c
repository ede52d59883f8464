/* SPDX-License-Identifier: MIT */
/* Films: FFmpeg's arguments for each file format. */
#include "image/format.h"

/* clang-format off */
#define MP4_FILE "-movflags", "+faststart", "-f", "mp4"
#define MP4_ARGUMENTS(CURVE) \
    "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", \
    "-c:v", "libx264", "-preset", "superfast", "-crf", "18", "-pix_fmt", "yuv420p", \
    "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", CURVE, \
    "-color_range", "tv", MP4_FILE, NULL

/* Players show BT.709 as they show sRGB. */
static const char *const mp4_arguments[] = {MP4_ARGUMENTS("bt709")};
static const char *const linear_mp4_arguments[] = {MP4_ARGUMENTS("linear")};

/* Every frame is a key frame, so players can seek to it. Without random numbers in the container
   the same frames give the same bytes. */
#define MKV_FILE "-fflags", "+bitexact", "-f", "matroska"
#define MKV_ARGUMENTS(CURVE) \
    "-c:v", "ffv1", "-g", "1", "-pix_fmt", "bgr0", "-colorspace", "rgb", \
    "-color_primaries", "bt709", "-color_trc", CURVE, "-color_range", "pc", \
    MKV_FILE, NULL

/* Slices are coded in parallel and have checksums, but FFmpeg fails if they have few pixels. */
#define SLICED "-level", "3", "-slices", "16", "-slicecrc", "1"
#define WHOLE "-level", "1"
#define MKV_CURVES(SLICES) \
    {[HD_CURVE_LINEAR] = {SLICES, MKV_ARGUMENTS("linear")}, \
     [HD_CURVE_SRGB] = {SLICES, MKV_ARGUMENTS("iec61966-2-1")}}
static const char *const sliced_mkv_arguments[][32] = MKV_CURVES(SLICED);
static const char *const whole_mkv_arguments[][32] = MKV_CURVES(WHOLE);

/* One palette a frame: a common one would keep all frames in memory. The ordered dither keeps
   static parts unchanged, and compresses well. */
static const char gif_filters[] =
    "split[seen][painted];"
    "[seen]palettegen=stats_mode=single:reserve_transparent=0[palette];"
    "[painted][palette]paletteuse=new=1:dither=bayer:bayer_scale=4";
static const char *const mp4_join[] = {"-c", "copy", MP4_FILE, NULL};
static const char *const mkv_join[] = {"-c", "copy", MKV_FILE, NULL};
static const char *const gif_arguments[] = {
    "-filter_complex", gif_filters, "-loop", "0", "-f", "gif", NULL};
/* clang-format on */

const HdFormat hd_format_mp4 = {
    .name = "MP4",
    .film_arguments = {linear_mp4_arguments, mp4_arguments},
    .segment_format = &hd_format_mp4,
    .join_arguments = mp4_join,
};
const HdFormat hd_format_mkv = {
    .name = "MKV",
    .film_arguments = {sliced_mkv_arguments[0], sliced_mkv_arguments[1]},
    .small_film_arguments = {whole_mkv_arguments[0], whole_mkv_arguments[1]},
    .segment_format = &hd_format_mkv,
    .join_arguments = mkv_join,
};
/* Its frames depend on each other, so it has no segments. */
const HdFormat hd_format_gif = {
    .name = "GIF",
    .film_arguments = {gif_arguments, gif_arguments},
    .is_srgb_only = true,
    .segment_format = &hd_format_mkv,
};
