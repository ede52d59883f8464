/* SPDX-License-Identifier: MIT */
/* Textures as JPEG: grey and colour, 8 bits. */
#define _POSIX_C_SOURCE 200809L

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jerror.h> /* needs jpeglib.h first */
#include <jpeglib.h>

#include "image/format.h"

/* Encoders write a dozen; each covers the whole picture, however few bytes it has. */
enum { MAX_SCANS = 64 };

/* libjpeg reports an error by longjmp. Values that must survive it are members, not local
   variables. */
typedef struct Reader {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    jmp_buf back;
    size_t size; /* bytes of the file */
    bool is_memory_short;
    bool is_cut_short;
    char message[JMSG_LENGTH_MAX];
} Reader;

static void on_error(j_common_ptr jpeg) {
    Reader *reader = jpeg->client_data;
    reader->is_memory_short = reader->errors.msg_code == JERR_OUT_OF_MEMORY;
    reader->errors.format_message(jpeg, reader->message);
    longjmp(reader->back, 1);
}

/* Returns whether the picture ends early, with bytes enough that its pixels take no time without
   them. libjpeg reads an end marker after the last byte. */
static bool ends_early(const Reader *reader) {
    enum { PIXELS_PER_BYTE = 4096 }; /* a dozen times those of one colour */
    const struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    const int code = reader->errors.msg_code;
    const bool is_end =
        code == JWRN_JPEG_EOF || (code == JWRN_HIT_MARKER && jpeg->unread_marker == JPEG_EOI);
    return is_end && (uint64_t)jpeg->image_width * jpeg->image_height / PIXELS_PER_BYTE <=
                         (uint64_t)reader->size;
}

/* libjpeg fills missing or wrong pixels with grey. The ignored warnings change no pixel. */
static void on_message(j_common_ptr jpeg, int level) {
    Reader *reader = jpeg->client_data;
    const int code = jpeg->err->msg_code;
    if (level >= 0 || code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR)
        return;
    if (!ends_early(reader))
        on_error(jpeg);
    reader->is_cut_short = true;
}

static void on_progress(j_common_ptr jpeg) {
    Reader *reader = jpeg->client_data;
    if (reader->jpeg.input_scan_number <= MAX_SCANS)
        return;
    snprintf(reader->message, sizeof reader->message, "more than %d scans", MAX_SCANS);
    longjmp(reader->back, 1);
}

static bool try_head(Reader *reader, const unsigned char *bytes, size_t size) {
    reader->jpeg.err = jpeg_std_error(&reader->errors);
    reader->errors.error_exit = on_error;
    reader->errors.emit_message = on_message;
    reader->progress.progress_monitor = on_progress;
    reader->jpeg.client_data = reader;
    if (setjmp(reader->back) != 0)
        return false;
    jpeg_create_decompress(&reader->jpeg);
    reader->jpeg.progress = &reader->progress;
    jpeg_mem_src(&reader->jpeg, bytes, (unsigned long)size);
    jpeg_read_header(&reader->jpeg, TRUE);
    return true;
}

/* Makes decoding identical for every processor: an integer inverse transform, and no smoothing
   between the blocks of a file that ends early. Chroma is interpolated as by default. */
static void set_exact(struct jpeg_decompress_struct *jpeg) {
    jpeg->dct_method = JDCT_ISLOW;
    jpeg->do_block_smoothing = FALSE;
    jpeg->out_color_space = JCS_RGB;
}

/* The bytes lie at the start of the row that they become, so conversion runs backwards. The last
   row must be followed by the end of the file. */
static bool try_rows(Reader *reader, const HdTexture *texture) {
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    const size_t values = (size_t)texture->width * 3;
    if (setjmp(reader->back) != 0)
        return false;
    set_exact(jpeg);
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        uint16_t *row = texture->texels + values * jpeg->output_scanline;
        unsigned char *bytes = (unsigned char *)row;
        jpeg_read_scanlines(jpeg, &bytes, 1);
        for (size_t i = values; i-- > 0;)
            row[i] = (uint16_t)(bytes[i] * 257);
    }
    jpeg_finish_decompress(jpeg);
    return true;
}

static HdStatus fail_reading(const Reader *reader, const char *name, HdError *error) {
    return hd_fail(error, reader->is_memory_short ? HD_FAILED : HD_BAD_INPUT,
                   "cannot read %s as JPEG: %s", name, reader->message);
}

static HdStatus decode_with(Reader *reader, HdTexture *texture, const unsigned char *bytes,
                            size_t size, const char *name, HdError *error) {
    const struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    if (!try_head(reader, bytes, size))
        return fail_reading(reader, name, error);
    if (jpeg->num_components != 1 && jpeg->num_components != 3)
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture %s is a JPEG of %d colours (4 are those of print, CMYK), "
                       "expected 1 or 3",
                       name, jpeg->num_components);
    HD_TRY(hd_texture_create(texture, jpeg->image_width, jpeg->image_height, name, error));
    if (!try_rows(reader, texture))
        return fail_reading(reader, name, error);
    texture->is_cut_short = reader->is_cut_short;
    return HD_OK;
}

static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdError *error) {
    Reader reader = {.size = size};
    const HdStatus status = decode_with(&reader, texture, bytes, size, name, error);
    jpeg_destroy_decompress(&reader.jpeg);
    return status;
}

static bool begins(const unsigned char *bytes, size_t size) {
    return size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0;
}

const HdFormat hd_format_jpeg = {.name = "JPEG", .decode = decode, .begins = begins};
