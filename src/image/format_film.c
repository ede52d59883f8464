/* SPDX-License-Identifier: MIT */
/* Films: FFmpeg's arguments for each file format. */
#include "image/format.h"

/* clang-format off */
#define YUV(CURVE) \
    "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", \
    "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", \
    "-color_trc", CURVE, "-color_range", "tv"
#define MP4_FILE(FORMAT) "-movflags", "+faststart", "-f", FORMAT
#define MP4_ARGUMENTS(CURVE, FORMAT) \
    YUV(CURVE), "-c:v", "libx264", "-preset", "superfast", "-crf", "18", MP4_FILE(FORMAT), NULL

/* Players show BT.709 as they show sRGB. */
#define MP4_CURVES(FORMAT) \
    {[HD_CURVE_LINEAR] = {MP4_ARGUMENTS("linear", FORMAT)}, \
     [HD_CURVE_SRGB] = {MP4_ARGUMENTS("bt709", FORMAT)}}
static const char *const mp4_arguments[][32] = MP4_CURVES("mp4");
static const char *const mov_arguments[][32] = MP4_CURVES("mov");

/* Without random numbers in the container the same frames give the same bytes. */
#define WEBM_FILE "-fflags", "+bitexact", "-f", "webm"
#define WEBM_ARGUMENTS(CURVE) \
    YUV(CURVE), "-c:v", "libvpx-vp9", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1", \
    "-crf", "20", "-b:v", "0", WEBM_FILE, NULL
static const char *const webm_arguments[] = {WEBM_ARGUMENTS("bt709")};
static const char *const linear_webm_arguments[] = {WEBM_ARGUMENTS("linear")};

/* Every frame is a key frame, so players can seek to it. */
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
static const char *const mp4_join[] = {"-c", "copy", MP4_FILE("mp4"), NULL};
static const char *const mov_join[] = {"-c", "copy", MP4_FILE("mov"), NULL};
static const char *const webm_join[] = {"-c", "copy", WEBM_FILE, NULL};
static const char *const mkv_join[] = {"-c", "copy", MKV_FILE, NULL};
static const char *const gif_arguments[] = {
    "-filter_complex", gif_filters, "-loop", "0", "-f", "gif", NULL};
/* clang-format on */

const HdFormat hd_format_mp4 = {
    .name = "MP4",
    .film_arguments = {mp4_arguments[0], mp4_arguments[1]},
    .segment_format = &hd_format_mp4,
    .join_arguments = mp4_join,
};
const HdFormat hd_format_mov = {
    .name = "MOV",
    .film_arguments = {mov_arguments[0], mov_arguments[1]},
    .segment_format = &hd_format_mov,
    .join_arguments = mov_join,
};
const HdFormat hd_format_webm = {
    .name = "WebM",
    .film_arguments = {linear_webm_arguments, webm_arguments},
    .segment_format = &hd_format_webm,
    .join_arguments = webm_join,
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
