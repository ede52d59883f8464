/* SPDX-License-Identifier: MIT */
/* The data format: int32 width, int32 height, then r g b a, little endian. */
#define _POSIX_C_SOURCE 200809L

#include "image/format.h"

#include <errno.h>
#include <stdbool.h>
#include <string.h>

#include "base/limits.h"
#include "base/low_bytes.h"
#include "base/minmax.h"

enum { HEAD_SIZE = 8 };

static int64_t get_int32(const unsigned char bytes[4]) {
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)bytes[i] << (8 * i);
    return bits > INT32_MAX ? (int64_t)bits - (INT64_C(1) << 32) : (int64_t)bits;
}

static HdStatus write(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error) {
    enum { AT_ONCE = 1024 };
    const size_t pixels = (size_t)frame->width * (size_t)frame->height;
    unsigned char head[HEAD_SIZE];
    uint8_t encoded[4 * AT_ONCE];
    (void)label; /* cannot hold metadata */
    hd_put_low_bytes(head, (uint32_t)frame->width, 4);
    hd_put_low_bytes(head + 4, (uint32_t)frame->height, 4);
    bool good = fwrite(head, 1, HEAD_SIZE, stream) == HEAD_SIZE;
    for (size_t first = 0; first < pixels && good; first += AT_ONCE) {
        const size_t count = hd_min_size(pixels - first, AT_ONCE);
        const uint8_t *rgba = frame->is_encoded ? frame->rgba + 4 * first : encoded;
        if (!frame->is_encoded)
            hd_curve_encode_rgba(style->curve, frame->rgb + 3 * first, count, encoded);
        good = fwrite(rgba, 4, count, stream) == count;
    }
    return good ? HD_OK : hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(errno));
}

/* Everything except PNG and JPEG arrives here, so wrong sizes usually mean another format. */
static HdStatus check_head(const unsigned char *bytes, size_t size, const char *name,
                           HdError *error) {
    if (size < HEAD_SIZE)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is neither PNG, JPEG nor the data format: it has %zu bytes, expected at "
                       "least %d",
                       name, size, HEAD_SIZE);
    int64_t width = get_int32(bytes), height = get_int32(bytes + 4);
    if (width < 1 || width > HD_MAX_IMAGE_SIDE || height < 1 || height > HD_MAX_IMAGE_SIDE)
        return hd_fail(
            error, HD_BAD_INPUT,
            "%s is neither PNG, JPEG nor the data format: its first 8 bytes say %lld x %lld "
            "pixels, expected 1..%d each",
            name, (long long)width, (long long)height, HD_MAX_IMAGE_SIDE);
    uint64_t expected = HEAD_SIZE + (uint64_t)width * (uint64_t)height * 4;
    if (size != expected)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s has %zu bytes, expected %llu for %lld x %lld pixels in the data format",
                       name, size, (unsigned long long)expected, (long long)width,
                       (long long)height);
    return HD_OK;
}

/* ---- files of other kinds ---- */

/* Names a file by its first bytes; NULL: not known. */
static const char *kind_by_signature(const unsigned char *bytes, size_t size) {
    static const struct {
        size_t at, size;
        const char *bytes, *kind;
    } known[] = {
        {0, 4, "GIF8", "a GIF picture"},
        {8, 4, "WEBP", "a WebP picture"},
        {0, 2, "BM", "a BMP picture"},
        {0, 3, "II*", "a TIFF picture"},
        {0, 4, "MM\0*", "a TIFF picture"},
        {4, 7, "ftypavi", "an AVIF picture"},
        {4, 7, "ftyphei", "a HEIC picture"},
        {4, 8, "ftypmif1", "an AVIF or HEIC picture"},
        {0, 4, "DDS ", "a DDS picture"},
        {0, 4, "8BPS", "a Photoshop file"},
        {0, 4, "\x76\x2f\x31\x01", "an OpenEXR picture"},
        {0, 2, "#?", "a Radiance picture"},
        {0, 19, "version https://git-", "a pointer of Git LFS ('git lfs pull' fetches the file)"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (size >= known[i].at + known[i].size &&
            memcmp(bytes + known[i].at, known[i].bytes, known[i].size) == 0)
            return known[i].kind;
    return NULL;
}

/* Names a file of tags, which starts with "<" after a byte order mark and blanks. */
static const char *kind_by_tag(const unsigned char *bytes, size_t size) {
    enum { LOOKED_AT = 512 };
    char head[LOOKED_AT + 1] = {0};
    size_t first = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    memcpy(head, bytes, hd_min_size(size, LOOKED_AT));
    first += strspn(head + first, " \t\r\n");
    if (head[first] != '<')
        return NULL;
    return strstr(head, "<svg") != NULL || strstr(head, "<?xml") != NULL ? "an SVG or XML file"
                                                                         : "a web page (HTML)";
}

/* TGA has a signature at its end, if any, and few legal values in its head. */
static bool is_tga(const unsigned char *bytes, size_t size) {
    static const char mark[] = "TRUEVISION-XFILE."; /* and a NUL */
    if (size >= sizeof mark && memcmp(bytes + size - sizeof mark, mark, sizeof mark) == 0)
        return true;
    if (size < 18 || bytes[1] > 1 || bytes[2] > 11 || (bytes[2] & 7) == 0 || (bytes[2] & 4) != 0)
        return false;
    const bool has_size = (bytes[12] | bytes[13]) != 0 && (bytes[14] | bytes[15]) != 0;
    return has_size && strchr("\x08\x0f\x10\x18\x20", bytes[16]) != NULL && bytes[16] != 0;
}

/* Names the kind of a file that is no picture in the data format, if it is known. */
static HdStatus refuse_foreign(const unsigned char *bytes, size_t size, const char *name,
                               HdError *error) {
    const char *kind = kind_by_signature(bytes, size);
    if (kind == NULL)
        kind = kind_by_tag(bytes, size);
    if (kind == NULL && is_tga(bytes, size))
        kind = "a TGA picture";
    if (size == 0)
        kind = "an empty file";
    if (kind == NULL)
        return HD_BAD_INPUT;
    return hd_fail(error, HD_BAD_INPUT, "%s is %s, expected PNG, JPEG or the data format", name,
                   kind);
}

static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdError *error) {
    if (check_head(bytes, size, name, error) != HD_OK)
        return refuse_foreign(bytes, size, name, error);
    HD_TRY(hd_texture_create(texture, (uint32_t)get_int32(bytes), (uint32_t)get_int32(bytes + 4),
                             name, error));
    const unsigned char *rgba = bytes + HEAD_SIZE;
    const size_t pixels = (size_t)texture->width * (size_t)texture->height;
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            texture->texels[i * 3 + c] = (uint16_t)(rgba[i * 4 + c] * 257);
    return HD_OK;
}

/* Any style can be converted to its 8 bits. */
const HdFormat hd_format_data = {
    .name = "the data format",
    .write = write,
    .max_encoded_bits = 16,
    .decode = decode,
};
