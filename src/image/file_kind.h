/* SPDX-License-Identifier: MIT */
/* What the ending of an output's name means; nothing else decides it. */
#ifndef HD_IMAGE_FILE_KIND_H
#define HD_IMAGE_FILE_KIND_H

#include <stdbool.h>

typedef enum HdOutputKind {
    HD_OUTPUT_UNKNOWN,
    HD_OUTPUT_DATA, /* .data: 8 bits, RGBA */
    HD_OUTPUT_PNG,  /* .png: 8 or 16 bits, RGB */
    HD_OUTPUT_PFM,  /* .pfm: float, linear */
    HD_OUTPUT_MP4,  /* .mp4: H.264, 4:2:0 */
    HD_OUTPUT_MKV,  /* .mkv: FFV1, lossless RGB */
    HD_OUTPUT_GIF   /* .gif: 256 colours, repeats for ever */
} HdOutputKind;

/* By the ending, in upper or lower case. */
HdOutputKind hd_output_kind(const char *path);

bool hd_output_is_film(HdOutputKind kind);

/* The same by the ending of a name. */
bool hd_name_is_film(const char *path);

/* For messages and help. */
#define HD_FILM_ENDINGS    ".mp4, .mkv or .gif"
#define HD_PICTURE_ENDINGS ".png, .pfm or .data"

#endif
