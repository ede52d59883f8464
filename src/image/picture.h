/* SPDX-License-Identifier: MIT */
/* Pictures in files: the table of formats for frames, and reading of textures and pictures to
   compare. */
#ifndef HD_IMAGE_PICTURE_H
#define HD_IMAGE_PICTURE_H

#include "base/limits.h"
#include "image/format.h"
#include "system/atomic_file.h"

/* hd_format_NAME is the format of files ending in .NAME. mp4, mov: H.264, 4:2:0; webm: VP9, 4:2:0;
   mkv: FFV1, lossless RGB; gif: 256 colours, endless loop. png: 8 or 16 bits, RGB; exr: half or
   float, linear; pfm: float, linear; data: 8 bits, RGBA. */
#define HD_FILM_FORMATS(FIRST, NEXT, LAST)    FIRST(mp4) NEXT(mov) NEXT(webm) NEXT(mkv) LAST(gif)
#define HD_PICTURE_FORMATS(FIRST, NEXT, LAST) FIRST(png) NEXT(exr) NEXT(pfm) LAST(data)

#define HD_FORMAT_DECLARED(name) extern const HdFormat hd_format_##name;
HD_FILM_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)
HD_PICTURE_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)

/* Textures only. */
HD_FORMAT_DECLARED(jpeg)

/* The endings for messages and help, as in ".png, .exr, .pfm or .data". */
#define HD_ENDING(name)       "." #name
#define HD_COMMA_ENDING(name) ", ." #name
#define HD_OR_ENDING(name)    " or ." #name
#define HD_FILM_ENDINGS       HD_FILM_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)
#define HD_PICTURE_ENDINGS    HD_PICTURE_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)

/* Returns the format of the ending, in upper or lower case; NULL: none. */
const HdFormat *hd_format_of(const char *path);

/* Returns whether a format is a film; NULL is not. */
bool hd_format_is_film(const HdFormat *format);

/* Returns whether files of a format can have alpha. */
bool hd_format_has_alpha(const HdFormat *format);

/* Returns the film's frames in a second. */
double hd_frame_rate(const HdOutputStyle *style);

/* Returns HD_BAD_INPUT for a film that cannot tag the style's curve, or a picture without so many
   bits. */
HdStatus hd_format_check_style(const char *path, const HdPictureStyle *style, HdError *error);

/* Writes a frame as a picture under a temporary name next to `path`, and creates missing folders.
   Finish with hd_atomic_file_commit or hd_atomic_file_discard. Rejects film formats. The data
   format: int32 width, int32 height, then r g b a, 8 bits each, little endian. PNG: RGB, with an
   sRGB chunk for that curve, and a gAMA chunk of 1 for linear values. PFM: float, rows from the
   bottom. An encoded frame must be on the style's curve and can only give 8 bits. PNG stores the
   label; NULL: nothing. After a failure no file is left and an existing one is untouched. */
HdStatus hd_picture_prepare(HdAtomicFile *file, const HdFrame *frame, const HdFormat *format,
                            const HdPictureStyle *style, const HdPictureLabel *label,
                            const char *path, HdError *error);

/* As above in the format of the path's ending, else the data format; also renames. */
HdStatus hd_picture_write(const HdFrame *frame, const HdPictureStyle *style, const char *path,
                          HdError *error);

/* Reads a texture and linearises it: PNG of any kind, JPEG of 8 bits in grey or three colours, or
   the data format, detected by the first bytes. Drops alpha. At most 65535 pixels a side and 2^28
   in all. */
HdStatus hd_texture_read(HdTexture *texture, const char *path, HdCurve curve, HdError *error);

/* As above from memory; `name` is for messages. */
HdStatus hd_texture_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                           const char *name, HdCurve curve, HdError *error);

/* Reads a mask, 0 transparent to 65535 opaque in all channels: the alpha, or if that is opaque
   everywhere or there is none, the mean of the channels on their curve. */
HdStatus hd_mask_read(HdTexture *mask, const char *path, HdError *error);

/* Maximum of display values. Values of 8 and 16 bits are integers on this scale, so their
   differences are exact; 257 is 1/255. */
#define HD_DISPLAY_TOP  65535.0
#define HD_DISPLAY_STEP 257.0

/* A pixel's channel in both spaces. */
typedef struct HdPictureValue {
    double linear;  /* light; 1 is white; PFM values as stored */
    double display; /* clamped to 0..1, on the curve, times HD_DISPLAY_TOP */
} HdPictureValue;

/* A reader needs memory for one row only (OpenEXR: a few): PNG, OpenEXR and PFM, detected by the
   first bytes. */
typedef struct HdPictureReader HdPictureReader;

/* Opens a regular file and reads its header. PNG: every kind without interlacing; drops alpha.
   OpenEXR: one part of scan lines with R, G and B, and up to HD_MAX_FURTHER other channels. PFM:
   colour, either byte order. HD_BAD_INPUT for others, with the file's name and the expected
   kind. */
HdStatus hd_picture_reader_open(HdPictureReader **reader, const char *path, HdError *error);

const HdPictureFacts *hd_picture_reader_facts(const HdPictureReader *reader);

/* Sets the curve of display values and of PNG values, whatever its chunks say. Call it once, before
   the first row. */
HdStatus hd_picture_reader_start(HdPictureReader *reader, HdCurve curve, HdError *error);

/* Reads the next row from the top: 3 values a pixel. */
HdStatus hd_picture_reader_next(HdPictureReader *reader, HdPictureValue *values, HdError *error);

/* Returns the last row of a further channel, by index into the names; valid until the next row. */
const float *hd_picture_reader_further(const HdPictureReader *reader, int channel);

/* NULL is allowed. */
void hd_picture_reader_close(HdPictureReader *reader);

#endif
