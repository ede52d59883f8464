/* SPDX-License-Identifier: MIT */
/* OpenEXR through the library's C interface: radiance and alpha in half or float, layers in
   float. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/limits.h"
#include "image/format.h"

static bool begins(const unsigned char *bytes, size_t size) {
    return size >= 4 && memcmp(bytes, "\x76\x2f\x31\x01", 4) == 0;
}

#if HD_HAS_OPENEXR

#include <openexr.h>

/* Returns from the calling function with the result of a library call unless it succeeded. */
#define EXR_TRY(call)                                                                              \
    do {                                                                                           \
        const exr_result_t tried_ = (call);                                                        \
        if (tried_ != EXR_ERR_SUCCESS)                                                             \
            return tried_;                                                                         \
    } while (0)

enum { CHANNELS = 3, MESSAGE_SIZE = 256 };
static const uint64_t MAX_CHUNK_BYTES = UINT64_C(1) << 30;

/* Array of a frame that holds a channel. */
typedef enum Source { RADIANCE, FIRST, BOUNDS } Source;

/* A channel of a file; r, g, b come first. */
typedef struct Channel {
    const char *name;
    Source source;
    int offset;    /* among the pixel's numbers */
    HdLayer layer; /* its layer; radiance is always present */
} Channel;

static const Channel channels[] = {
    {"R", RADIANCE, 0, HD_LAYER_ALPHA},
    {"G", RADIANCE, 1, HD_LAYER_ALPHA},
    {"B", RADIANCE, 2, HD_LAYER_ALPHA},
    {"A", FIRST, HD_FIRST_ALPHA, HD_LAYER_ALPHA},
    {"Z", FIRST, HD_FIRST_DEPTH, HD_LAYER_DEPTH},
    {"normal.X", FIRST, HD_FIRST_NORMAL, HD_LAYER_NORMAL},
    {"normal.Y", FIRST, HD_FIRST_NORMAL + 1, HD_LAYER_NORMAL},
    {"normal.Z", FIRST, HD_FIRST_NORMAL + 2, HD_LAYER_NORMAL},
    {"object", FIRST, HD_FIRST_OBJECT, HD_LAYER_OBJECT},
    {"bound", BOUNDS, 0, HD_LAYER_BOUND},
};
enum { ALL_CHANNELS = sizeof channels / sizeof *channels };

/* State of the library's calls, with its first error message. */
typedef struct File {
    exr_context_t context;
    FILE *stream; /* not owned */
    const char *path;
    char message[MESSAGE_SIZE];
} File;

static void keep_message(exr_const_context_t context, exr_result_t code, const char *message) {
    void *data = NULL;
    if (exr_get_user_data(context, &data) != EXR_ERR_SUCCESS || data == NULL)
        return;
    File *file = data;
    if (file->message[0] == '\0')
        snprintf(file->message, sizeof file->message, "%s",
                 message != NULL ? message : exr_get_default_error_message(code));
}

static const char *message_of(const File *file, exr_result_t code) {
    return file->message[0] != '\0' ? file->message : exr_get_default_error_message(code);
}

static exr_context_initializer_t settings_of(File *file) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = keep_message;
    settings.user_data = file;
    settings.max_image_width = settings.max_image_height = HD_MAX_IMAGE_SIDE;
    return settings;
}

/* Writing */

static int64_t write_at(exr_const_context_t context, void *data, const void *bytes, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t report) {
    File *file = data;
    (void)context;
    (void)report;
    if (fseeko(file->stream, (off_t)offset, SEEK_SET) == 0 &&
        fwrite(bytes, 1, (size_t)size, file->stream) == size)
        return (int64_t)size;
    snprintf(file->message, sizeof file->message, "%s", strerror(errno));
    return -1;
}

/* Rounds to the nearest half, ties to even. NaN stays NaN; values beyond the range become the
   largest finite half. */
static uint16_t half_of(float value) {
    const double size = fabs((double)value);
    const uint16_t sign = signbit(value) ? 0x8000 : 0;
    int exponent;
    if (isnan(value))
        return (uint16_t)(sign | 0x7e00);
    if (size >= 65504.0)
        return (uint16_t)(sign | 0x7bff);
    if (size < 0x1p-14) /* steps of 2^-24 */
        return (uint16_t)(sign | (uint16_t)nearbyint(size * 0x1p24));
    frexp(size, &exponent); /* 2^(exponent - 1) <= size: 1024 steps up to the next power */
    const double steps = nearbyint(ldexp(size, 11 - exponent));
    return (uint16_t)(sign | (uint16_t)((exponent + 13) * 1024 + (int)steps));
}

/* Colour and alpha follow the style; object numbers exceed the precision of half. */
static exr_pixel_type_t type_of(const Channel *channel, bool is_half) {
    const bool is_picture = channel->source == RADIANCE || channel->layer == HD_LAYER_ALPHA;
    return is_half && is_picture ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
}

static exr_result_t add_channels(exr_context_t context, int part, const HdFrame *frame,
                                 bool is_half) {
    for (int i = 0; i < ALL_CHANNELS; i++) {
        const Channel *channel = &channels[i];
        const bool is_light = channel->source == RADIANCE;
        if (is_light || (frame->layers & HD_LAYER_BIT(channel->layer)) != 0)
            EXR_TRY(exr_add_channel(
                context, part, channel->name, type_of(channel, is_half),
                is_light ? EXR_PERCEPTUALLY_LOGARITHMIC : EXR_PERCEPTUALLY_LINEAR, 1, 1));
    }
    return EXR_ERR_SUCCESS;
}

/* Places a crop in the window of the whole picture. */
static exr_result_t write_windows(exr_context_t context, int part, const HdFrame *frame,
                                  const HdCrop *crop) {
    const exr_attr_box2i_t data = {.min.x = crop->left,
                                   .min.y = crop->top,
                                   .max.x = crop->left + frame->width - 1,
                                   .max.y = crop->top + frame->height - 1};
    const exr_attr_box2i_t display = {.max.x = crop->whole_width - 1,
                                      .max.y = crop->whole_height - 1};
    EXR_TRY((exr_result_t)exr_set_data_window(context, part, &data));
    return (exr_result_t)exr_set_display_window(context, part, &display);
}

static exr_result_t write_attributes(exr_context_t context, int part, const HdFrame *frame,
                                     bool is_half, const HdPictureLabel *label) {
    EXR_TRY(exr_initialize_required_attr_simple(context, part, frame->width, frame->height,
                                                EXR_COMPRESSION_ZIP));
    EXR_TRY(add_channels(context, part, frame, is_half));
    if (label == NULL)
        return EXR_ERR_SUCCESS;
    if (label->crop.whole_width > 0)
        EXR_TRY(write_windows(context, part, frame, &label->crop));
    EXR_TRY(exr_attr_set_string(context, part, "software", "hedron " HD_VERSION));
    EXR_TRY(exr_attr_set_string(context, part, "scene", label->scene));
    EXR_TRY(exr_attr_set_int(context, part, "frame", label->frame));
    return label->options[0] != '\0' ? exr_attr_set_string(context, part, "options", label->options)
                                     : EXR_ERR_SUCCESS;
}

static const Channel *channel_named(const char *name) {
    const Channel *channel = channels;
    while (strcmp(channel->name, name) != 0)
        channel++;
    return channel;
}

static float value_of(const HdFrame *frame, const Channel *channel, size_t pixel) {
    if (channel->source == RADIANCE)
        return frame->rgb[pixel * CHANNELS + (size_t)channel->offset];
    if (channel->source == BOUNDS)
        return frame->bounds[pixel];
    const float *first = frame->first + pixel * (size_t)frame->first_floats;
    if (channel->layer == HD_LAYER_DEPTH && first[HD_FIRST_OBJECT] == 0.0F)
        return INFINITY;
    return first[channel->offset];
}

/* Writes a channel of `count` pixels from `first` on; returns the end. */
static unsigned char *fill_plane(const HdFrame *frame, const exr_coding_channel_info_t *to,
                                 size_t first, size_t count, unsigned char *plane) {
    const Channel *channel = channel_named(to->channel_name);
    const bool is_half = to->data_type == EXR_PIXEL_HALF;
    for (size_t i = 0; i < count; i++) {
        const float value = value_of(frame, channel, first + i);
        const uint16_t half = is_half ? half_of(value) : 0;
        if (is_half)
            memcpy(plane + i * sizeof half, &half, sizeof half);
        else
            memcpy(plane + i * sizeof value, &value, sizeof value);
    }
    return plane + count * (is_half ? sizeof(uint16_t) : sizeof(float));
}

/* Writes the lines of a chunk, channel by channel. */
static void fill_chunk(exr_encode_pipeline_t *pipeline, const HdFrame *frame, int y, int lines,
                       unsigned char *plane) {
    const size_t width = (size_t)frame->width;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        const int bytes = channel->data_type == EXR_PIXEL_HALF ? 2 : 4;
        channel->user_pixel_stride = bytes;
        channel->user_line_stride = channel->width * bytes;
        channel->encode_from_ptr = plane;
        plane = fill_plane(frame, channel, width * (size_t)y, width * (size_t)lines, plane);
    }
}

static exr_result_t write_chunk(exr_context_t context, int part, int y, int lines,
                                const HdFrame *frame, unsigned char *planes,
                                exr_encode_pipeline_t *pipeline) {
    exr_chunk_info_t chunk;
    exr_attr_box2i_t window;
    EXR_TRY(exr_get_data_window(context, part, &window));
    EXR_TRY(exr_write_scanline_chunk_info(context, part, window.min.y + y, &chunk));
    EXR_TRY(y == 0 ? exr_encoding_initialize(context, part, &chunk, pipeline)
                   : exr_encoding_update(context, part, &chunk, pipeline));
    fill_chunk(pipeline, frame, y, lines, planes);
    if (y == 0)
        EXR_TRY(exr_encoding_choose_default_routines(context, part, pipeline));
    return exr_encoding_run(context, part, pipeline);
}

/* `planes` holds the lines of a chunk. */
static exr_result_t write_chunks(exr_context_t context, int part, int lines, const HdFrame *frame,
                                 unsigned char *planes) {
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t result = EXR_ERR_SUCCESS;
    for (int y = 0; y < frame->height && result == EXR_ERR_SUCCESS; y += lines) {
        const int count = y + lines <= frame->height ? lines : frame->height - y;
        result = write_chunk(context, part, y, count, frame, planes, &pipeline);
    }
    exr_encoding_destroy(context, &pipeline);
    return result;
}

static exr_result_t write_part(File *file, const HdFrame *frame, bool is_half,
                               const HdPictureLabel *label) {
    int part, lines = 0;
    EXR_TRY(exr_add_part(file->context, "frame", EXR_STORAGE_SCANLINE, &part));
    EXR_TRY(write_attributes(file->context, part, frame, is_half, label));
    EXR_TRY(exr_write_header(file->context));
    EXR_TRY(exr_get_scanlines_per_chunk(file->context, part, &lines));
    const size_t pixels = (size_t)frame->width * (size_t)lines;
    float *planes = malloc(pixels * ALL_CHANNELS * sizeof *planes); /* or halves */
    if (planes == NULL)
        return EXR_ERR_OUT_OF_MEMORY;
    const exr_result_t result =
        write_chunks(file->context, part, lines, frame, (unsigned char *)planes);
    free(planes);
    return result;
}

static HdStatus write_frame(const HdFrame *frame, const HdPictureStyle *style,
                            const HdPictureLabel *label, FILE *stream, const char *path,
                            HdError *error) {
    File file = {.stream = stream, .path = path};
    exr_context_initializer_t settings = settings_of(&file);
    settings.write_fn = write_at;
    exr_result_t result = exr_start_write(&file.context, path, EXR_WRITE_FILE_DIRECTLY, &settings);
    if (result == EXR_ERR_SUCCESS)
        result = write_part(&file, frame, style->bits < 32, label);
    const exr_result_t finished = exr_finish(&file.context);
    if (result == EXR_ERR_SUCCESS)
        result = finished;
    return result == EXR_ERR_SUCCESS
               ? HD_OK
               : hd_fail(error, HD_FAILED, "cannot write %s: %s", path, message_of(&file, result));
}

/* Reading */

/* A file being read: a single part of scan lines with R, G and B in half or float, and further such
   channels. */
typedef struct ExrRows {
    File file;
    int top, width, height, next;      /* of the data window; `next` counts from its top */
    int lines;                         /* lines of a chunk */
    int channels;                      /* channels that are read */
    const char *names[HD_MAX_FURTHER]; /* channels besides r, g, b; owned by the library */
    float *values;                     /* owned; one chunk */
    exr_decode_pipeline_t pipeline;
    bool has_pipeline;
} ExrRows;

static int64_t file_size(exr_const_context_t context, void *data) {
    const File *file = data;
    struct stat found;
    (void)context;
    return fstat(fileno(file->stream), &found) == 0 ? (int64_t)found.st_size : -1;
}

static int64_t read_at(exr_const_context_t context, void *data, void *bytes, uint64_t size,
                       uint64_t offset, exr_stream_error_func_ptr_t report) {
    const File *file = data;
    (void)context;
    (void)report;
    if (offset > INT64_MAX || fseeko(file->stream, (off_t)offset, SEEK_SET) != 0)
        return 0;
    const size_t count = fread(bytes, 1, (size_t)size, file->stream);
    return ferror(file->stream) != 0 ? -1 : (int64_t)count;
}

/* The library returns its out-of-memory code for corrupt data too; only the messages differ. */
static HdStatus fail_reading(const ExrRows *rows, exr_result_t code, HdError *error) {
    const char *message = message_of(&rows->file, code);
    const bool is_memory_short =
        strcmp(message, exr_get_default_error_message(EXR_ERR_OUT_OF_MEMORY)) == 0;
    return hd_fail(error, is_memory_short ? HD_FAILED : HD_BAD_INPUT,
                   "cannot read %s as OpenEXR: %s", rows->file.path, message);
}

/* Returns the channel's index in a pixel; negative: not read. */
static int place_of(const ExrRows *rows, const char *name) {
    for (int i = 0; i < CHANNELS; i++)
        if (strcmp(channels[i].name, name) == 0)
            return i;
    for (int i = CHANNELS; i < rows->channels; i++)
        if (strcmp(rows->names[i - CHANNELS], name) == 0)
            return i;
    return -1;
}

/* Selects full-resolution channels in half or float; returns false if R, G or B is not one. */
static bool find_channels(ExrRows *rows, const exr_attr_chlist_t *list, int *bits) {
    int found = 0;
    *bits = 16;
    rows->channels = CHANNELS;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *channel = &list->entries[i];
        const bool is_light = place_of(rows, channel->name.str) >= 0;
        const bool is_readable = channel->pixel_type != EXR_PIXEL_UINT &&
                                 channel->x_sampling == 1 && channel->y_sampling == 1;
        if (is_light && !is_readable)
            return false;
        if (is_light && channel->pixel_type == EXR_PIXEL_FLOAT)
            *bits = 32;
        found += is_light;
        if (!is_light && is_readable && rows->channels < CHANNELS + HD_MAX_FURTHER)
            rows->names[rows->channels++ - CHANNELS] = channel->name.str;
    }
    return found == CHANNELS;
}

typedef struct Head {
    int parts;
    exr_storage_t storage;
    const exr_attr_chlist_t *list;
    exr_attr_box2i_t window;
    uint64_t bytes; /* of a chunk */
} Head;

/* Reads all but `bytes`. */
static exr_result_t read_head(exr_const_context_t context, Head *head) {
    EXR_TRY(exr_get_count(context, &head->parts));
    EXR_TRY(exr_get_storage(context, 0, &head->storage));
    EXR_TRY(exr_get_channels(context, 0, &head->list));
    return exr_get_data_window(context, 0, &head->window);
}

static HdStatus check_head(ExrRows *rows, HdPictureFacts *facts, HdError *error) {
    const exr_const_context_t context = rows->file.context;
    const char *path = rows->file.path;
    Head head;
    exr_result_t result = read_head(context, &head);
    if (result != EXR_ERR_SUCCESS)
        return fail_reading(rows, result, error);
    if (head.parts != 1 || head.storage != EXR_STORAGE_SCANLINE)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is an OpenEXR of several parts, tiles or deep data, expected one part "
                       "of scan lines",
                       path);
    if (!find_channels(rows, head.list, &facts->bits))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is an OpenEXR without R, G and B in half or float for each pixel", path);
    const int64_t width = (int64_t)head.window.max.x - head.window.min.x + 1;
    const int64_t height = (int64_t)head.window.max.y - head.window.min.y + 1;
    if (width < 1 || width > HD_MAX_IMAGE_SIDE || height < 1 || height > HD_MAX_IMAGE_SIDE)
        return hd_fail(error, HD_BAD_INPUT, "%s has %lld x %lld pixels, expected 1..%d each", path,
                       (long long)width, (long long)height, HD_MAX_IMAGE_SIDE);
    result = exr_get_scanlines_per_chunk(context, 0, &rows->lines);
    if (result == EXR_ERR_SUCCESS)
        result = exr_get_chunk_unpacked_size(context, 0, &head.bytes);
    if (result != EXR_ERR_SUCCESS)
        return fail_reading(rows, result, error);
    if (rows->lines < 1 || head.bytes > MAX_CHUNK_BYTES)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s has lines that take %llu bytes at a time, expected at most %llu", path,
                       (unsigned long long)head.bytes, (unsigned long long)MAX_CHUNK_BYTES);
    rows->top = head.window.min.y;
    rows->width = facts->width = (int)width;
    rows->height = facts->height = (int)height;
    facts->further = rows->channels - CHANNELS;
    facts->names = rows->names;
    return HD_OK;
}

static HdStatus open_file(ExrRows *rows, HdPictureFacts *facts, HdError *error) {
    exr_context_initializer_t settings = settings_of(&rows->file);
    settings.read_fn = read_at;
    settings.size_fn = file_size;
    const exr_result_t result = exr_start_read(&rows->file.context, rows->file.path, &settings);
    if (result != EXR_ERR_SUCCESS)
        return fail_reading(rows, result, error);
    HD_TRY(check_head(rows, facts, error));
    const size_t values = (size_t)rows->width * (size_t)rows->channels * (size_t)rows->lines;
    rows->values = malloc(values * sizeof *rows->values);
    return rows->values != NULL ? HD_OK : fail_reading(rows, EXR_ERR_OUT_OF_MEMORY, error);
}

static void close_rows(void *state) {
    ExrRows *rows = state;
    if (rows->has_pipeline)
        exr_decoding_destroy(rows->file.context, &rows->pipeline);
    exr_finish(&rows->file.context);
    free(rows->values);
    free(rows);
}

static HdStatus open_rows(void **out, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error) {
    ExrRows *rows = calloc(1, sizeof *rows);
    if (rows == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", path);
    rows->file = (File){.stream = file, .path = path};
    *facts = (HdPictureFacts){.curve = HD_CURVE_LINEAR};
    const HdStatus status = open_file(rows, facts, error);
    if (status == HD_OK)
        *out = rows;
    else
        close_rows(rows);
    return status;
}

/* One plane for each channel: version 3.1 of the library corrupts four adjacent halves converted to
   floats in another order than the file's. */
static size_t plane_size(const ExrRows *rows) {
    return (size_t)rows->width * (size_t)rows->lines;
}

static void set_target(ExrRows *rows) {
    for (int i = 0; i < rows->pipeline.channel_count; i++) {
        exr_coding_channel_info_t *channel = &rows->pipeline.channels[i];
        const int place = place_of(rows, channel->channel_name);
        if (place < 0)
            continue;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = rows->width * (int)sizeof(float);
        channel->decode_to_ptr = (uint8_t *)(rows->values + plane_size(rows) * (size_t)place);
    }
}

static exr_result_t read_chunk(ExrRows *rows) {
    const exr_const_context_t context = rows->file.context;
    exr_chunk_info_t chunk;
    EXR_TRY(exr_read_scanline_chunk_info(context, 0, rows->top + rows->next, &chunk));
    const bool is_first = !rows->has_pipeline;
    rows->has_pipeline = true;
    EXR_TRY(is_first ? exr_decoding_initialize(context, 0, &chunk, &rows->pipeline)
                     : exr_decoding_update(context, 0, &chunk, &rows->pipeline));
    set_target(rows);
    if (is_first)
        EXR_TRY(exr_decoding_choose_default_routines(context, 0, &rows->pipeline));
    return exr_decoding_run(context, 0, &rows->pipeline);
}

/* Returns the last row's values of a channel. */
static const float *row_of(const ExrRows *rows, int channel) {
    const int line = (rows->next - 1) % rows->lines;
    return rows->values + plane_size(rows) * (size_t)channel + (size_t)rows->width * (size_t)line;
}

static HdStatus next_row(void *state, float *rgb, HdError *error) {
    ExrRows *rows = state;
    const exr_result_t result = rows->next % rows->lines == 0 ? read_chunk(rows) : EXR_ERR_SUCCESS;
    if (result != EXR_ERR_SUCCESS)
        return fail_reading(rows, result, error);
    rows->next++;
    for (int channel = 0; channel < CHANNELS; channel++) {
        const float *values = row_of(rows, channel);
        for (int x = 0; x < rows->width; x++)
            rgb[CHANNELS * x + channel] = values[x];
    }
    return HD_OK;
}

static const float *further_channel(const void *rows, int channel) {
    return row_of(rows, CHANNELS + channel);
}

const HdFormat hd_format_exr = {
    .name = "OpenEXR",
    .write = write_frame,
    .has_layers = true,
    .max_encoded_bits = 0,
    .begins = begins,
    .open_rows = open_rows,
    .next_row = next_row,
    .further_channel = further_channel,
    .close_rows = close_rows,
};

#else

static HdStatus fail_missing(const char *path, HdError *error) {
    return hd_fail(error, HD_UNAVAILABLE, "%s is an OpenEXR, and hedron was built without it",
                   path);
}

static HdStatus write_frame(const HdFrame *frame, const HdPictureStyle *style,
                            const HdPictureLabel *label, FILE *stream, const char *path,
                            HdError *error) {
    (void)frame;
    (void)style;
    (void)label;
    (void)stream;
    return fail_missing(path, error);
}

static HdStatus open_rows(void **rows, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error) {
    (void)rows;
    (void)file;
    (void)facts;
    return fail_missing(path, error);
}

const HdFormat hd_format_exr = {
    .name = "OpenEXR",
    .write = write_frame,
    .has_layers = true,
    .begins = begins,
    .open_rows = open_rows,
};

#endif
