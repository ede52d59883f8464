/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/png.h"

#include <errno.h>
#include <string.h>

#include <zlib.h>

#include "base/hash.h"
#include "base/limits.h"

/* Far above what a picture needs, far below what would hurt. */
enum { MAX_CHUNK_BYTES = 8 * 1024 * 1024, MAX_KEPT_CHUNKS = 128 };

static void on_error(png_structp png, png_const_charp message) {
    snprintf(png_get_error_ptr(png), HD_PNG_MESSAGE_SIZE, "%s", message);
    png_longjmp(png, 1);
}

/* libpng would print warnings. */
static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

png_structp hd_png_create_reader(char message[HD_PNG_MESSAGE_SIZE]) {
    return png_create_read_struct(PNG_LIBPNG_VER_STRING, message, on_error, on_warning);
}

png_structp hd_png_create_writer(char message[HD_PNG_MESSAGE_SIZE]) {
    return png_create_write_struct(PNG_LIBPNG_VER_STRING, message, on_error, on_warning);
}

HdStatus hd_png_reading_status(const char *message) {
    return strstr(message, "memory") != NULL ? HD_FAILED : HD_BAD_INPUT;
}

void hd_png_limit_reading(png_structp png) {
    png_set_user_limits(png, HD_MAX_IMAGE_SIDE, HD_MAX_IMAGE_SIDE);
    png_set_chunk_malloc_max(png, MAX_CHUNK_BYTES);
    png_set_chunk_cache_max(png, MAX_KEPT_CHUNKS);
    /* Texts, profiles and gamma have no use here: skipped, they cannot do harm either. */
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
}

void hd_png_convert_to_rgb(png_structp png) {
    png_set_expand(png);
    png_set_strip_alpha(png);
    png_set_gray_to_rgb(png);
}

static void write_bytes(png_structp png, png_bytep bytes, size_t count) {
    HdPngSink *sink = png_get_io_ptr(png);
    if (fwrite(bytes, 1, count, sink->stream) != count)
        png_error(png, strerror(errno));
    sink->hash = hd_hash_bytes(sink->hash, bytes, count);
}

static void flush_nothing(png_structp png) {
    (void)png;
}

/* Frames are many and short-lived. After the filter what repeats is mostly zeros, and looking for
   nothing else is both faster and smaller than level 1. */
void hd_png_begin_rgb(png_structp png, png_infop info, HdPngSink *sink, int width, int height,
                      int bits) {
    sink->hash = HD_HASH_START;
    png_set_write_fn(png, sink, write_bytes, flush_nothing);
    png_set_compression_strategy(png, Z_RLE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
}
