/* SPDX-License-Identifier: MIT */
/* Frames, textures and pictures to compare as PNG. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <inttypes.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include <png.h>
#include <zlib.h>

#include "base/hash.h"
#include "base/limits.h"
#include "image/format.h"

/* Far above the needs of a picture, far below harmful sizes. */
enum { MAX_CHUNK_BYTES = 8 * 1024 * 1024, MAX_KEPT_CHUNKS = 128 };

/* Bytes of a file beyond twice those of its pixels: far more than texts and profiles take. */
enum { MAX_EXTRA_BYTES = 16 * 1024 * 1024 };

enum { MESSAGE_SIZE = 256, SIGNATURE_SIZE = 8 };

/* libpng reports an error by longjmp. Values that must survive it are members, not local
   variables. */
typedef struct PngReader {
    png_structp png;
    png_infop info;
    FILE *file;
    size_t allowed;   /* bytes left to read */
    const char *name; /* for messages */
    HdPictureFacts facts;
    bool is_interlaced, wants_alpha;
    int passes; /* over the same rows */
    int next;
    char message[MESSAGE_SIZE];
} PngReader;

typedef struct PngWriter {
    png_structp png;
    png_infop info;
    FILE *stream;
    uint64_t hash; /* hash of all bytes so far (hash.h) */
    uint16_t *row; /* owned */
    bool has_alpha;
    float *straight; /* owned; colours of a row without the background, with alpha only */
    char message[MESSAGE_SIZE];
} PngWriter;

static void on_error(png_structp png, png_const_charp message) {
    /* For our few texts libpng gives this message only if out of memory. */
    const bool lacks_memory = strcmp(message, "too many text chunks") == 0;
    snprintf(png_get_error_ptr(png), MESSAGE_SIZE, "%s", lacks_memory ? "out of memory" : message);
    png_longjmp(png, 1);
}

/* libpng would print warnings. */
static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static bool begins(const unsigned char *bytes, size_t size) {
    return size >= SIGNATURE_SIZE && png_sig_cmp(bytes, 0, SIGNATURE_SIZE) == 0;
}

/* Reading */

static void read_bytes(png_structp png, png_bytep out, size_t count) {
    PngReader *reader = png_get_io_ptr(png);
    if (count > reader->allowed)
        png_error(png, "the file has far more bytes than its pixels need");
    reader->allowed -= count;
    if (fread(out, 1, count, reader->file) != count)
        png_error(png, "the file ends too early");
}

static void limit_reading(png_structp png) {
    png_set_user_limits(png, HD_MAX_IMAGE_SIDE, HD_MAX_IMAGE_SIDE);
    png_set_chunk_malloc_max(png, MAX_CHUNK_BYTES);
    png_set_chunk_cache_max(png, MAX_KEPT_CHUNKS);
    /* Texts, profiles and gamma are not needed; skipping them also avoids their errors. */
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, (png_const_bytep) "sRGB", 1);
}

/* Replaces RGBA by three times A, in place. */
static void repeat_alpha(png_structp png, png_row_infop row, png_bytep data) {
    const size_t size = row->bit_depth / 8;
    (void)png;
    for (size_t i = 0; i < row->width; i++)
        for (size_t c = 0; c < 3; c++)
            memmove(data + (3 * i + c) * size, data + (4 * i + 3) * size, size);
}

/* Converts every kind to RGB, with 16 bits if it has them, otherwise 8; or to its alpha, if it has
   one and that is wanted. */
static void convert_to_rgb(png_structp png, png_infop info, bool wants_alpha) {
    const bool has_alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                           png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    if (!wants_alpha || !has_alpha) {
        png_set_strip_alpha(png);
        return;
    }
    png_set_read_user_transform_fn(png, repeat_alpha);
    png_set_user_transform_info(png, NULL, png_get_bit_depth(png, info) == 16 ? 16 : 8, 3);
}

static bool try_head(PngReader *reader) {
    png_structp png = reader->png;
    png_infop info = reader->info;
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_read_fn(png, reader, read_bytes);
    limit_reading(png);
    png_read_info(png, info);
    reader->is_interlaced = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
    reader->facts.curve =
        png_get_valid(png, info, PNG_INFO_sRGB) != 0 ? HD_CURVE_SRGB : HD_CURVE_LINEAR;
    convert_to_rgb(png, info, reader->wants_alpha);
    reader->passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    reader->facts.width = (int)png_get_image_width(png, info);
    reader->facts.height = (int)png_get_image_height(png, info);
    reader->facts.bits = png_get_bit_depth(png, info);
    if (png_get_rowbytes(png, info) * 8 !=
        (size_t)reader->facts.width * 3 * (size_t)reader->facts.bits)
        png_error(png, "unexpected size of a row");
    reader->allowed += 2 * png_get_rowbytes(png, info) * (size_t)reader->facts.height;
    return true;
}

static HdStatus fail_reading(const PngReader *reader, HdError *error) {
    return hd_fail(error, strstr(reader->message, "memory") != NULL ? HD_FAILED : HD_BAD_INPUT,
                   "cannot read %s as PNG: %s", reader->name, reader->message);
}

static void close_reader(void *rows) {
    PngReader *reader = rows;
    png_destroy_read_struct(&reader->png, &reader->info, NULL);
    free(reader);
}

/* Reads the header of a file from its start; `file` and `name` must stay valid. Rejects excessive
   chunks, and skips all but those of pixels and sRGB. Rejects a file larger than 16 MiB plus twice
   the size of its pixels. Faults of the file are HD_BAD_INPUT, here and below; HD_FAILED: out of
   memory. Returns NULL on error. */
static PngReader *open_reader(FILE *file, const char *name, bool wants_alpha, HdError *error) {
    PngReader *reader = malloc(sizeof *reader);
    if (reader == NULL) {
        hd_fail(error, HD_FAILED, "out of memory: no room to read %s", name);
        return NULL;
    }
    *reader = (PngReader){.file = file,
                          .allowed = MAX_EXTRA_BYTES,
                          .name = name,
                          .wants_alpha = wants_alpha,
                          .message = "out of memory"};
    reader->png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, reader->message, on_error, on_warning);
    if (reader->png != NULL)
        reader->info = png_create_info_struct(reader->png);
    if (reader->info != NULL && try_head(reader))
        return reader;
    fail_reading(reader, error);
    close_reader(reader);
    return NULL;
}

/* The bytes lie in the row that they become, so conversion runs backwards. 16 bits are big endian;
   8 bits fill the first half. */
static void make_codes(uint16_t *row, size_t values, int bits) {
    const unsigned char *bytes = (const unsigned char *)row;
    for (size_t i = values; i-- > 0;)
        row[i] = (uint16_t)(bits == 16 ? bytes[2 * i] << 8 | bytes[2 * i + 1] : bytes[i] * 257);
}

/* The last row must be followed by the end of the file. */
static bool try_rows(PngReader *reader, uint16_t *codes, int count) {
    const size_t values = (size_t)reader->facts.width * 3;
    if (setjmp(png_jmpbuf(reader->png)) != 0)
        return false;
    for (int pass = 0; pass < reader->passes; pass++)
        for (int row = 0; row < count; row++)
            png_read_row(reader->png, (png_bytep)(codes + values * (size_t)row), NULL);
    reader->next += count;
    if (reader->next == reader->facts.height)
        png_read_end(reader->png, NULL);
    return true;
}

/* Reads the next `count` rows from the top, all rows if interlaced: r, g, b of each pixel, 0..65535
   for any bit depth, without alpha. */
static HdStatus read_rows(PngReader *reader, uint16_t *codes, int count, HdError *error) {
    const size_t values = (size_t)reader->facts.width * 3;
    if (!try_rows(reader, codes, count))
        return fail_reading(reader, error);
    for (int row = 0; row < count; row++)
        make_codes(codes + values * (size_t)row, values, reader->facts.bits);
    return HD_OK;
}

/* Writing */

static void write_bytes(png_structp png, png_bytep bytes, size_t count) {
    PngWriter *writer = png_get_io_ptr(png);
    if (fwrite(bytes, 1, count, writer->stream) != count)
        png_error(png, strerror(errno));
    writer->hash = hd_hash_bytes(writer->hash, bytes, count);
}

static void flush_nothing(png_structp png) {
    (void)png;
}

/* Makes an uncompressed UTF-8 text. libpng does not modify its strings. */
static png_text text_of(const char *keyword, const char *text) {
    return (png_text){.compression = PNG_ITXT_COMPRESSION_NONE,
                      .key = (char *)keyword,
                      .text = (char *)text,
                      .itxt_length = strlen(text)};
}

static void set_texts(const PngWriter *writer, const HdPictureLabel *label) {
    char number[16];
    snprintf(number, sizeof number, "%d", label->frame);
    const png_text texts[] = {text_of("Software", "hedron " HD_VERSION),
                              text_of("Scene", label->scene), text_of("Frame", number),
                              text_of("Options", label->options)};
    png_set_text(writer->png, writer->info, texts, label->options[0] != '\0' ? 4 : 3);
}

/* Frames are many and short-lived. After the filter mostly zeros repeat: matching runs only is
   faster and smaller than level 1. */
static void write_head(PngWriter *writer, const HdFrame *frame, const HdPictureStyle *style,
                       const HdPictureLabel *label) {
    png_structp png = writer->png;
    png_set_write_fn(png, writer, write_bytes, flush_nothing);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, writer->info, (png_uint_32)frame->width, (png_uint_32)frame->height,
                 style->bits, writer->has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (style->curve == HD_CURVE_SRGB)
        png_set_sRGB(png, writer->info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA_fixed(png, writer->info, PNG_GAMMA_LINEAR);
    if (label != NULL)
        set_texts(writer, label);
    png_write_info(png, writer->info);
}

/* Stores 16-bit codes in big endian, in place. */
static void swap_codes(uint16_t *row, size_t values) {
    unsigned char *bytes = (unsigned char *)row;
    for (size_t i = 0; i < values; i++) {
        const unsigned code = row[i];
        bytes[2 * i] = (unsigned char)(code >> 8);
        bytes[2 * i + 1] = (unsigned char)(code & 0xff);
    }
}

static float alpha_of(const HdFrame *frame, size_t pixel) {
    return frame->first[pixel * (size_t)frame->first_floats + HD_FIRST_ALPHA];
}

/* Computes the colours of the objects alone: PNG's are not multiplied by alpha. */
static const float *make_straight(const PngWriter *writer, const HdFrame *frame, HdVec3 behind,
                                  size_t first) {
    const double background[] = {behind.x, behind.y, behind.z};
    for (size_t i = 0; i < 3 * (size_t)frame->width; i++) {
        const double alpha = (double)alpha_of(frame, first + i / 3),
                     seen = (double)frame->rgb[3 * first + i];
        writer->straight[i] =
            alpha > 0.0 ? (float)((seen - (1.0 - alpha) * background[i % 3]) / alpha) : 0.0F;
    }
    return writer->straight;
}

/* Inserts alpha after the codes of each pixel, which lie at the start of the row. */
static void insert_alpha(const HdFrame *frame, int bits, size_t first, unsigned char *bytes) {
    const size_t size = (size_t)bits / 8;
    for (size_t x = (size_t)frame->width; x-- > 0;) {
        const float alpha = alpha_of(frame, first + x);
        unsigned char *place = bytes + size * (4 * x + 3);
        uint16_t code;
        memmove(bytes + size * 4 * x, bytes + size * 3 * x, 3 * size);
        if (bits == 8) {
            hd_curve_encode8(HD_CURVE_LINEAR, &alpha, 1, place);
        } else {
            hd_curve_encode16(HD_CURVE_LINEAR, &alpha, 1, &code);
            memcpy(place, &code, sizeof code);
        }
    }
}

/* Fills a row of the file. */
static void make_row(const PngWriter *writer, const HdFrame *frame, const HdPictureStyle *style,
                     HdVec3 background, int y) {
    const size_t width = (size_t)frame->width, values = 3 * width, first = width * (size_t)y;
    unsigned char *bytes = (unsigned char *)writer->row;
    for (size_t i = 0; i < width && frame->is_encoded; i++)
        memcpy(bytes + 3 * i, frame->rgba + 4 * (first + i), 3);
    if (frame->is_encoded)
        return;
    const float *rgb = writer->has_alpha ? make_straight(writer, frame, background, first)
                                         : frame->rgb + 3 * first;
    if (style->bits == 8)
        hd_curve_encode8(style->curve, rgb, values, bytes);
    else
        hd_curve_encode16(style->curve, rgb, values, writer->row);
    if (writer->has_alpha)
        insert_alpha(frame, style->bits, first, bytes);
    if (style->bits > 8)
        swap_codes(writer->row, writer->has_alpha ? 4 * width : values);
}

/* ---- the end ---- */

enum { KEYWORD_SIZE = 7, TEXT_SIZE = 45, DATA_SIZE = KEYWORD_SIZE + TEXT_SIZE };
_Static_assert(HD_PNG_END_SIZE == 12 + DATA_SIZE + 12, "a chunk, and IEND behind it");

/* Stores a big-endian number. */
static void put_number(unsigned char *place, uint32_t number) {
    for (int i = 0; i < 4; i++)
        place[i] = (unsigned char)(number >> (24 - 8 * i));
}

static void make_end(uint64_t fingerprint, uint64_t bytes_hash,
                     unsigned char end[HD_PNG_END_SIZE]) {
    static const unsigned char last[12] = "\0\0\0\0IEND\xae\x42\x60\x82";
    char text[TEXT_SIZE + 1];
    snprintf(text, sizeof text, "frame %016" PRIx64 " bytes %016" PRIx64, fingerprint, bytes_hash);
    put_number(end, DATA_SIZE);
    memcpy(end + 4, "tEXthedron", 4 + KEYWORD_SIZE);
    memcpy(end + 8 + KEYWORD_SIZE, text, TEXT_SIZE);
    put_number(end + 8 + DATA_SIZE, (uint32_t)crc32(crc32(0, NULL, 0), end + 4, 4 + DATA_SIZE));
    memcpy(end + 12 + DATA_SIZE, last, sizeof last);
}

bool hd_png_is_whole(const unsigned char *bytes, size_t size, uint64_t fingerprint) {
    unsigned char end[HD_PNG_END_SIZE];
    if (size < HD_PNG_END_SIZE)
        return false;
    const size_t before = size - HD_PNG_END_SIZE;
    make_end(fingerprint, hd_hash_bytes(HD_HASH_START, bytes, before), end);
    return memcmp(bytes + before, end, sizeof end) == 0;
}

static void write_end(PngWriter *writer, const HdPictureLabel *label) {
    unsigned char end[HD_PNG_END_SIZE];
    if (label == NULL || !label->has_fingerprint) {
        png_write_end(writer->png, NULL);
        return;
    }
    make_end(label->fingerprint, writer->hash, end);
    if (fwrite(end, 1, sizeof end, writer->stream) != sizeof end)
        png_error(writer->png, strerror(errno));
}

static bool try_write(PngWriter *writer, const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label) {
    const HdVec3 background = label != NULL ? label->background : hd_vec3(0.0, 0.0, 0.0);
    if (setjmp(png_jmpbuf(writer->png)) != 0)
        return false;
    write_head(writer, frame, style, label);
    for (int y = 0; y < frame->height; y++) {
        make_row(writer, frame, style, background, y);
        png_write_row(writer->png, (png_const_bytep)writer->row);
    }
    write_end(writer, label);
    return true;
}

static HdStatus write_frame(const HdFrame *frame, const HdPictureStyle *style,
                            const HdPictureLabel *label, FILE *stream, const char *path,
                            HdError *error) {
    PngWriter writer = {.stream = stream, .hash = HD_HASH_START, .message = "out of memory"};
    writer.has_alpha = style->has_alpha && frame->first != NULL;
    writer.row = malloc((size_t)frame->width * 4 * sizeof *writer.row);
    if (writer.has_alpha)
        writer.straight = malloc((size_t)frame->width * 3 * sizeof *writer.straight);
    writer.png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, writer.message, on_error, on_warning);
    if (writer.png != NULL)
        writer.info = png_create_info_struct(writer.png);
    const bool good = writer.row != NULL && (writer.straight != NULL || !writer.has_alpha) &&
                      writer.info != NULL && try_write(&writer, frame, style, label);
    png_destroy_write_struct(&writer.png, &writer.info);
    free(writer.row);
    free(writer.straight);
    return good ? HD_OK : hd_fail(error, HD_FAILED, "cannot write %s: %s", path, writer.message);
}

/* ---- textures and frames that are read back ---- */

enum { SIZE_OFFSET = 16, SIZE_END = 24 };

static uint32_t get_uint32(const unsigned char bytes[4]) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* libpng rejects large pictures too, but does not report their size. */
static HdStatus create_texture(HdTexture *texture, const unsigned char *bytes, size_t size,
                               const char *name, HdError *error) {
    if (size < SIZE_END || memcmp(bytes + SIZE_OFFSET - 4, "IHDR", 4) != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot read %s: expected PNG's IHDR chunk after the signature", name);
    return hd_texture_create(texture, get_uint32(bytes + SIZE_OFFSET),
                             get_uint32(bytes + SIZE_OFFSET + 4), name, error);
}

static PngReader *open_bytes(const unsigned char *bytes, size_t size, const char *name,
                             bool wants_alpha, HdError *error) {
    FILE *file = fmemopen((void *)bytes, size, "rb"); /* only read */
    if (file == NULL) {
        hd_fail(error, HD_FAILED, "out of memory: no room to read %s", name);
        return NULL;
    }
    PngReader *reader = open_reader(file, name, wants_alpha, error);
    if (reader == NULL)
        fclose(file);
    return reader;
}

static void close_bytes(PngReader *reader) {
    fclose(reader->file);
    close_reader(reader);
}

static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdError *error) {
    HD_TRY(create_texture(texture, bytes, size, name, error));
    PngReader *reader = open_bytes(bytes, size, name, texture->is_mask, error);
    if (reader == NULL)
        return error->status;
    const HdStatus status = read_rows(reader, texture->texels, texture->height, error);
    close_bytes(reader);
    return status;
}

static HdStatus load_rows(HdFrame *frame, PngReader *reader, const char *name, HdError *error) {
    const size_t width = (size_t)frame->width;
    uint16_t *codes = malloc(width * 3 * sizeof *codes);
    if (codes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", name);
    HdStatus status = HD_OK;
    for (int y = 0; y < frame->height && status == HD_OK; y++) {
        uint8_t *rgba = frame->rgba + width * 4 * (size_t)y;
        status = read_rows(reader, codes, 1, error);
        for (size_t i = 0; i < 4 * width && status == HD_OK; i++)
            rgba[i] = i % 4 == 3 ? 255 : (uint8_t)(codes[i / 4 * 3 + i % 4] >> 8);
    }
    free(codes);
    return status;
}

static HdStatus load(HdFrame *frame, const unsigned char *bytes, size_t size, const char *name,
                     HdError *error) {
    HdStatus status;
    PngReader *reader = open_bytes(bytes, size, name, false, error);
    if (reader == NULL)
        return error->status;
    const HdPictureFacts *facts = &reader->facts;
    if (facts->width != frame->width || facts->height != frame->height || facts->bits != 8 ||
        reader->is_interlaced)
        status = hd_fail(error, HD_FAILED,
                         "cannot read %s as PNG: unexpected size or kind of picture", name);
    else
        status = load_rows(frame, reader, name, error);
    close_bytes(reader);
    frame->is_encoded |= status == HD_OK;
    return status;
}

/* ---- row by row ---- */

static HdStatus open_rows(void **rows, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error) {
    PngReader *reader = open_reader(file, path, false, error);
    if (reader == NULL)
        return error->status;
    if (reader->is_interlaced) {
        close_reader(reader);
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is an interlaced PNG, expected one without interlacing", path);
    }
    *rows = reader;
    *facts = reader->facts;
    return HD_OK;
}

/* Codes lie at the start of the row that they become, so conversion runs backwards. */
static HdStatus next_row(void *rows, float *rgb, HdError *error) {
    PngReader *reader = rows;
    void *codes = rgb;
    const HdStatus status = read_rows(reader, codes, 1, error);
    for (size_t i = (size_t)reader->facts.width * 3; i-- > 0 && status == HD_OK;) {
        uint16_t code;
        memcpy(&code, (const char *)codes + i * sizeof code, sizeof code);
        rgb[i] = code;
    }
    return status;
}

const HdFormat hd_format_png = {
    .name = "PNG",
    .write = write_frame,
    .max_encoded_bits = 8,
    .has_alpha = true,
    .load = load,
    .decode = decode,
    .begins = begins,
    .open_rows = open_rows,
    .next_row = next_row,
    .close_rows = close_reader,
    .is_on_curve = true,
};
