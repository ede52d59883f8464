/* SPDX-License-Identifier: MIT */
#include "image/picture.h"

#include <stdlib.h>

#include "image/png.h"
#include "system/path.h"

/* The largest texture as PNG with four 16-bit channels has 2 GiB before compression. */
static const int64_t MAX_TEXTURE_FILE = INT64_C(4) << 30;

HdStatus hd_picture_prepare(HdAtomicFile *file, const HdFrame *frame, const HdFormat *format,
                            const HdPictureStyle *style, const HdPictureLabel *label,
                            const char *path, HdError *error) {
    if (format->write == NULL)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write %s as a picture: its ending is that of a film", path);
    HdStatus status = hd_frame_check_size(frame, error);
    if (status == HD_OK)
        status = hd_atomic_file_open(file, path, error);
    if (status != HD_OK)
        return status;
    status = format->write(frame, style, label, file->stream, path, error);
    if (status != HD_OK)
        hd_atomic_file_discard(file);
    return status;
}

HdStatus hd_picture_write(const HdFrame *frame, const HdPictureStyle *style, const char *path,
                          HdError *error) {
    const HdFormat *format = hd_format_of(path);
    HdAtomicFile file;
    HdStatus status = hd_picture_prepare(&file, frame, format != NULL ? format : &hd_format_data,
                                         style, NULL, path, error);
    return status == HD_OK ? hd_atomic_file_commit(&file, HD_DURABLE, error) : status;
}

/* What is neither PNG nor JPEG may be in the data format, which has no signature. */
static const HdFormat *format_of_texture(const unsigned char *bytes, size_t size) {
    if (hd_image_is_png(bytes, size))
        return &hd_format_png;
    const bool is_jpeg = size >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
    return is_jpeg ? &hd_format_jpeg : &hd_format_data;
}

HdStatus hd_texture_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                           const char *name, HdCurve curve, HdError *error) {
    *texture = (HdTexture){0};
    HdStatus status =
        format_of_texture(bytes, size)->decode(texture, bytes, size, name, curve, error);
    if (status != HD_OK)
        hd_texture_clear(texture);
    return status;
}

HdStatus hd_texture_read(HdTexture *texture, const char *path, HdCurve curve, HdError *error) {
    unsigned char *bytes = NULL;
    size_t size = 0;
    *texture = (HdTexture){0};
    HdStatus status = hd_file_read(path, "texture", MAX_TEXTURE_FILE, &bytes, &size, error);
    if (status == HD_OK)
        status = hd_texture_decode(texture, bytes, size, path, curve, error);
    free(bytes);
    return status;
}
