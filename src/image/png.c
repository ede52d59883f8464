/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/png.h"

#include <errno.h>
#include <inttypes.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include <png.h>
#include <zlib.h>

#include "base/hash.h"
#include "base/limits.h"

/* Far above what a picture needs, far below what would hurt. */
enum { MAX_CHUNK_BYTES = 8 * 1024 * 1024, MAX_KEPT_CHUNKS = 128 };

/* Of a file besides twice what its pixels take: far more than texts and profiles have. */
enum { MAX_BESIDES = 16 * 1024 * 1024 };

enum { MESSAGE_SIZE = 256, SIGNATURE_SIZE = 8 };

/* libpng reports an error by a jump. Everything that must outlive it lives here, not in local
   variables. */
struct HdPngReader {
    png_structp png;
    png_infop info;
    HdPngSource source; /* of memory the part not read yet */
    size_t allowed;     /* to be read still */
    const char *name;
    HdPngFacts facts;
    int passes; /* over the same rows */
    int next;
    char message[MESSAGE_SIZE];
};

struct HdPngWriter {
    png_structp png;
    png_infop info;
    FILE *stream;
    const char *path;
    uint64_t hash; /* of the bytes so far (hash.h) */
    char message[MESSAGE_SIZE];
};

static void on_error(png_structp png, png_const_charp message) {
    /* We write few texts: libpng says so of any that it has no memory for. */
    const bool lacks_memory = strcmp(message, "too many text chunks") == 0;
    snprintf(png_get_error_ptr(png), MESSAGE_SIZE, "%s", lacks_memory ? "out of memory" : message);
    png_longjmp(png, 1);
}

/* libpng would print warnings. */
static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

bool hd_image_is_png(const unsigned char *bytes, size_t size) {
    return size >= SIGNATURE_SIZE && png_sig_cmp(bytes, 0, SIGNATURE_SIZE) == 0;
}

/* Reading */

static void read_bytes(png_structp png, png_bytep out, size_t count) {
    HdPngReader *reader = png_get_io_ptr(png);
    HdPngSource *source = &reader->source;
    if (count > reader->allowed)
        png_error(png, "the file has far more bytes than its pixels need");
    reader->allowed -= count;
    if (source->file != NULL ? fread(out, 1, count, source->file) != count : count > source->size)
        png_error(png, "the file ends too early");
    if (source->file != NULL)
        return;
    memcpy(out, source->bytes, count);
    source->bytes += count;
    source->size -= count;
}

static void limit_reading(png_structp png) {
    png_set_user_limits(png, HD_MAX_IMAGE_SIDE, HD_MAX_IMAGE_SIDE);
    png_set_chunk_malloc_max(png, MAX_CHUNK_BYTES);
    png_set_chunk_cache_max(png, MAX_KEPT_CHUNKS);
    /* Texts, profiles and gamma have no use here: skipped, they cannot do harm either. */
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, (png_const_bytep) "sRGB", 1);
}

/* Every kind becomes RGB, with 16 bits where it has as many, otherwise with 8. */
static void convert_to_rgb(png_structp png) {
    png_set_expand(png);
    png_set_strip_alpha(png);
    png_set_gray_to_rgb(png);
}

static bool try_head(HdPngReader *reader) {
    png_structp png = reader->png;
    png_infop info = reader->info;
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_read_fn(png, reader, read_bytes);
    limit_reading(png);
    png_read_info(png, info);
    reader->facts.is_interlaced = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
    reader->facts.is_srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
    convert_to_rgb(png);
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

static HdStatus fail_reading(const HdPngReader *reader, HdError *error) {
    return hd_fail(error, strstr(reader->message, "memory") != NULL ? HD_FAILED : HD_BAD_INPUT,
                   "cannot read %s as PNG: %s", reader->name, reader->message);
}

HdStatus hd_png_open(HdPngReader **out, const HdPngSource *source, const char *name,
                     HdPngFacts *facts, HdError *error) {
    HdPngReader *reader = malloc(sizeof *reader);
    if (reader == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", name);
    *reader = (HdPngReader){
        .source = *source, .allowed = MAX_BESIDES, .name = name, .message = "out of memory"};
    reader->png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, reader->message, on_error, on_warning);
    if (reader->png != NULL)
        reader->info = png_create_info_struct(reader->png);
    if (reader->info == NULL || !try_head(reader)) {
        const HdStatus status = fail_reading(reader, error);
        hd_png_close(reader);
        return status;
    }
    *facts = reader->facts;
    *out = reader;
    return HD_OK;
}

/* The last row is followed by the end of the file, which has to be there. */
static bool try_rows(HdPngReader *reader, uint16_t *codes, int count) {
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

/* The bytes lie in the row that they become: PNG's 16 bits are big endian, and 8 bits fill the
   first half, so that the way goes from the end. */
static void make_codes(uint16_t *row, size_t values, int bits) {
    const unsigned char *bytes = (const unsigned char *)row;
    for (size_t i = values; i-- > 0;)
        row[i] = (uint16_t)(bits == 16 ? bytes[2 * i] << 8 | bytes[2 * i + 1] : bytes[i] * 257);
}

HdStatus hd_png_read_rows(HdPngReader *reader, uint16_t *codes, int count, HdError *error) {
    const size_t values = (size_t)reader->facts.width * 3;
    if (!try_rows(reader, codes, count))
        return fail_reading(reader, error);
    for (int row = 0; row < count; row++)
        make_codes(codes + values * (size_t)row, values, reader->facts.bits);
    return HD_OK;
}

void hd_png_close(HdPngReader *reader) {
    if (reader == NULL)
        return;
    png_destroy_read_struct(&reader->png, &reader->info, NULL);
    free(reader);
}

/* Writing */

static void write_bytes(png_structp png, png_bytep bytes, size_t count) {
    HdPngWriter *writer = png_get_io_ptr(png);
    if (fwrite(bytes, 1, count, writer->stream) != count)
        png_error(png, strerror(errno));
    writer->hash = hd_hash_bytes(writer->hash, bytes, count);
}

static void flush_nothing(png_structp png) {
    (void)png;
}

enum { MAX_TEXTS = 4, NUMBER_SIZE = 16 };

/* Text in UTF-8 that is not compressed. libpng writes to none of it. */
static png_text text_of(const char *keyword, const char *text) {
    return (png_text){.compression = PNG_ITXT_COMPRESSION_NONE,
                      .key = (char *)keyword,
                      .text = (char *)text,
                      .itxt_length = strlen(text)};
}

/* Returns how many there are. */
static int make_texts(const HdPictureLabel *label, char number[NUMBER_SIZE],
                      png_text texts[MAX_TEXTS]) {
    if (label == NULL)
        return 0;
    snprintf(number, NUMBER_SIZE, "%d", label->frame);
    texts[0] = text_of("Software", "hedron " HD_VERSION);
    texts[1] = text_of("Scene", label->scene);
    texts[2] = text_of("Frame", number);
    texts[3] = text_of("Options", label->options);
    return label->options[0] != '\0' ? MAX_TEXTS : MAX_TEXTS - 1;
}

/* Frames are many and short-lived. After the filter what repeats is mostly zeros, and looking for
   nothing else is both faster and smaller than level 1. */
static bool try_begin(HdPngWriter *writer, const HdPngFacts *facts, png_text *texts, int count) {
    png_structp png = writer->png;
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_write_fn(png, writer, write_bytes, flush_nothing);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, writer->info, (png_uint_32)facts->width, (png_uint_32)facts->height,
                 facts->bits, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (facts->is_srgb)
        png_set_sRGB(png, writer->info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA_fixed(png, writer->info, PNG_GAMMA_LINEAR);
    png_set_text(png, writer->info, texts, count);
    png_write_info(png, writer->info);
    return true;
}

static bool try_row(HdPngWriter *writer, const unsigned char *row) {
    if (setjmp(png_jmpbuf(writer->png)) != 0)
        return false;
    png_write_row(writer->png, row);
    return true;
}

/* ---- the end ---- */

enum { KEYWORD_SIZE = 7, TEXT_SIZE = 45, DATA_SIZE = KEYWORD_SIZE + TEXT_SIZE };
_Static_assert(HD_PNG_END_SIZE == 12 + DATA_SIZE + 12, "a chunk, and IEND behind it");

/* PNG is big endian. */
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

static bool try_end(HdPngWriter *writer, const HdPictureLabel *label) {
    unsigned char end[HD_PNG_END_SIZE];
    if (setjmp(png_jmpbuf(writer->png)) != 0)
        return false;
    if (label == NULL || !label->has_fingerprint) {
        png_write_end(writer->png, NULL);
        return true;
    }
    make_end(label->fingerprint, writer->hash, end);
    if (fwrite(end, 1, sizeof end, writer->stream) != sizeof end)
        png_error(writer->png, strerror(errno));
    return true;
}

static HdStatus status_of(bool good, const HdPngWriter *writer, HdError *error) {
    return good ? HD_OK
                : hd_fail(error, HD_FAILED, "cannot write %s: %s", writer->path, writer->message);
}

HdStatus hd_png_begin(HdPngWriter **out, FILE *stream, const char *path, const HdPngFacts *facts,
                      const HdPictureLabel *label, HdError *error) {
    char number[NUMBER_SIZE];
    png_text texts[MAX_TEXTS];
    const int count = make_texts(label, number, texts);
    HdPngWriter *writer = malloc(sizeof *writer);
    if (writer == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to write %s", path);
    *writer = (HdPngWriter){
        .stream = stream, .path = path, .hash = HD_HASH_START, .message = "out of memory"};
    writer->png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, writer->message, on_error, on_warning);
    if (writer->png != NULL)
        writer->info = png_create_info_struct(writer->png);
    const HdStatus status =
        status_of(writer->info != NULL && try_begin(writer, facts, texts, count), writer, error);
    if (status == HD_OK)
        *out = writer;
    else
        hd_png_free(writer);
    return status;
}

HdStatus hd_png_write_row(HdPngWriter *writer, const unsigned char *row, HdError *error) {
    return status_of(try_row(writer, row), writer, error);
}

HdStatus hd_png_end(HdPngWriter *writer, const HdPictureLabel *label, HdError *error) {
    return status_of(try_end(writer, label), writer, error);
}

void hd_png_free(HdPngWriter *writer) {
    if (writer == NULL)
        return;
    png_destroy_write_struct(&writer->png, &writer->info);
    free(writer);
}
