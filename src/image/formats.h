/* SPDX-License-Identifier: MIT */
/* The formats that frames are stored in: the one table, and what the ending of a name means. */
#ifndef HD_IMAGE_FORMATS_H
#define HD_IMAGE_FORMATS_H

#include "image/format.h"

/* Each format is hd_format_NAME, and the ending of its files .NAME.
   mp4: H.264, 4:2:0; mkv: FFV1, lossless RGB; gif: 256 colours, repeats for ever.
   png: 8 or 16 bits, RGB; exr: half or float, linear; pfm: float, linear; data: 8 bits, RGBA. */
#define HD_FILM_FORMATS(FIRST, NEXT, LAST)    FIRST(mp4) NEXT(mkv) LAST(gif)
#define HD_PICTURE_FORMATS(FIRST, NEXT, LAST) FIRST(png) NEXT(exr) NEXT(pfm) LAST(data)

#define HD_FORMAT_DECLARED(name) extern const HdFormat hd_format_##name;
HD_FILM_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)
HD_PICTURE_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)

/* Of textures alone. */
HD_FORMAT_DECLARED(jpeg)

/* The endings for messages and help, as in ".png, .exr, .pfm or .data". */
#define HD_ENDING(name)       "." #name
#define HD_COMMA_ENDING(name) ", ." #name
#define HD_OR_ENDING(name)    " or ." #name
#define HD_FILM_ENDINGS       HD_FILM_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)
#define HD_PICTURE_ENDINGS    HD_PICTURE_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)

/* By the ending, in upper or lower case; NULL where it is of no format. */
const HdFormat *hd_format_of(const char *path);

/* NULL is none. */
bool hd_format_is_film(const HdFormat *format);

/* HD_BAD_INPUT where the path is that of a film that cannot say that its values are on the style's
   curve, or of a picture that cannot have so many bits. */
HdStatus hd_format_check_style(const char *path, const HdPictureStyle *style, HdError *error);

#endif
