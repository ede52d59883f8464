/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <fcntl.h>
#include <png.h>
#include <signal.h>
#include <sys/resource.h>

#include "image/picture.h"
#include "test_folder.h"

static size_t read_bytes(const char *path, unsigned char *bytes, size_t room) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, room, file);
    fclose(file);
    return size;
}

/* Random enough that no compression makes it small. */
static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 16;
}

static const HdPictureStyle LINEAR_8 = {HD_CURVE_LINEAR, 8};

/* Values of whole bytes. */
static HdFrame make_frame(int width, int height) {
    HdError error = {0};
    HdFrame frame;
    uint32_t seed = 1;
    assert_int_equal(hd_frame_create(&frame, width, height, &error), HD_OK);
    for (size_t i = 0; i < (size_t)width * (size_t)height * 3; i++)
        frame.rgb[i] = (float)(next_random(&seed) & 255) / 255.0f;
    return frame;
}

static uint8_t byte_of(float value) {
    return (uint8_t)lrintf(value * 255.0f);
}

static void check_texture(const HdTexture *texture, const HdFrame *frame) {
    size_t values = (size_t)frame->width * (size_t)frame->height * 3;
    assert_int_equal(texture->width, frame->width);
    assert_int_equal(texture->height, frame->height);
    for (size_t i = 0; i < values; i++)
        assert_int_equal(texture->texels[i], byte_of(frame->rgb[i]) * 257);
}

/* Writes a frame and reads it as a texture. */
static HdTexture pass_through(const HdFrame *frame, const HdPictureStyle *style, const char *path) {
    HdError error = {0};
    HdTexture texture;
    assert_int_equal(hd_picture_write(frame, style, path, &error), HD_OK);
    assert_int_equal(hd_texture_read(&texture, path, style->curve, &error), HD_OK);
    return texture;
}

TEST(sizes_are_checked) {
    const int wrong[][2] = {{0, 1}, {1, 0}, {-1, 1}, {65536, 1}, {1, 65536}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        HdError error = {0};
        HdFrame frame = {.width = wrong[i][0], .height = wrong[i][1]};
        assert_int_equal(hd_frame_add_rgba(&frame, &error), HD_BAD_INPUT);
        assert_null(frame.rgba);
        expect_contains(error.message, "1..65535");
    }
    HdError error = {0};
    HdFrame frame = {.width = 65535, .height = 1};
    assert_int_equal(hd_frame_add_rgba(&frame, &error), HD_OK);
    hd_frame_free(&frame);
    assert_null(frame.rgba);
    hd_frame_free(&frame);
}

TEST(frames_become_bytes) {
    HdError error = {0};
    HdFrame frame = make_frame(301, 3);
    assert_int_equal(hd_frame_add_rgba(&frame, &error), HD_OK);
    for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
        uint8_t expected[3];
        hd_frame_encode(&frame, (HdCurve)curve);
        for (size_t i = 0; i < 301 * 3; i++) {
            hd_curve_encode8((HdCurve)curve, frame.rgb + 3 * i, 3, expected);
            assert_memory_equal(frame.rgba + 4 * i, expected, 3);
            assert_int_equal(frame.rgba[4 * i + 3], 255);
        }
    }
    hd_frame_free(&frame);
}

TEST(data_files_hold_the_bytes) {
    HdFrame frame = make_frame(259, 2);
    static unsigned char bytes[8 + 259 * 2 * 4 + 1];
    const unsigned char head[8] = {3, 1, 0, 0, 2, 0, 0, 0};
    HdTexture texture = pass_through(&frame, &LINEAR_8, "bytes/a/b.data");
    assert_int_equal(read_bytes("bytes/a/b.data", bytes, sizeof bytes), sizeof bytes - 1);
    assert_memory_equal(bytes, head, 8);
    for (size_t i = 0; i < 259 * 2; i++) {
        for (size_t c = 0; c < 3; c++)
            assert_int_equal(bytes[8 + 4 * i + c], byte_of(frame.rgb[3 * i + c]));
        assert_int_equal(bytes[8 + 4 * i + 3], 255);
    }
    assert_int_equal(count_entries("bytes/a"), 1);
    check_texture(&texture, &frame);
    hd_texture_clear(&texture);
    hd_frame_free(&frame);
}

TEST(png_files_hold_the_colours) {
    HdFrame frame = make_frame(67, 35);
    unsigned char head[29];
    HdTexture texture = pass_through(&frame, &LINEAR_8, "colours/a.PNG");
    assert_int_equal(count_entries("colours"), 1);
    assert_int_equal(read_bytes("colours/a.PNG", head, sizeof head), sizeof head);
    assert_memory_equal(head, "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x43\0\0\0\x23\x08\x02\0\0\0",
                        29);
    check_texture(&texture, &frame);
    hd_texture_clear(&texture);
    hd_frame_free(&frame);
}

/* Fills a small frame with values between the steps of 8 bits. */
static HdFrame make_fine_frame(void) {
    HdFrame frame = make_frame(13, 7);
    for (int i = 0; i < 13 * 7 * 3; i++)
        frame.rgb[i] = (float)i / (float)(13 * 7 * 3 - 1);
    return frame;
}

TEST(png_files_may_have_16_bits) {
    HdError error = {0};
    HdFrame frame = make_fine_frame();
    uint16_t expected[13 * 7 * 3];
    unsigned char head[25];
    for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
        const HdPictureStyle style = {(HdCurve)curve, 16};
        HdTexture texture;
        assert_int_equal(hd_picture_write(&frame, &style, "sixteen.png", &error), HD_OK);
        assert_int_equal(read_bytes("sixteen.png", head, sizeof head), sizeof head);
        assert_int_equal(head[24], 16);
        /* Read as it is, the texture has the codes of the file. */
        assert_int_equal(hd_texture_read(&texture, "sixteen.png", HD_CURVE_LINEAR, &error), HD_OK);
        hd_curve_encode16((HdCurve)curve, frame.rgb, 13 * 7 * 3, expected);
        assert_memory_equal(texture.texels, expected, sizeof expected);
        hd_texture_clear(&texture);
    }
    hd_frame_free(&frame);
}

/* Off the curve again, the values are those of the frame but for the rounding. */
TEST(textures_come_off_the_curve) {
    HdFrame frame = make_fine_frame();
    const struct {
        const char *path;
        int bits;
        double tolerance;
    } files[] = {{"off.png", 16, 5e-5}, {"off.png", 8, 5e-3}, {"off.data", 8, 5e-3}};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        const HdPictureStyle style = {HD_CURVE_SRGB, files[f].bits};
        HdTexture texture = pass_through(&frame, &style, files[f].path);
        for (int i = 0; i < 13 * 7 * 3; i++)
            expect_near(texture.texels[i] / 65535.0, (double)frame.rgb[i], files[f].tolerance);
        hd_texture_clear(&texture);
    }
    hd_frame_free(&frame);
}

static bool has_chunk(const char *path, const char *chunk, size_t size) {
    unsigned char bytes[200];
    size_t count = read_bytes(path, bytes, sizeof bytes);
    for (size_t i = 0; i + size <= count; i++)
        if (memcmp(bytes + i, chunk, size) == 0)
            return true;
    return false;
}

TEST(png_files_name_the_curve) {
    HdError error = {0};
    HdFrame frame = make_frame(3, 2);
    const HdPictureStyle srgb = {HD_CURVE_SRGB, 8};
    assert_int_equal(hd_picture_write(&frame, &srgb, "srgb.png", &error), HD_OK);
    assert_true(has_chunk("srgb.png", "\0\0\0\1sRGB\0", 9));
    assert_false(has_chunk("srgb.png", "gAMA", 4));
    assert_int_equal(hd_picture_write(&frame, &LINEAR_8, "linear.png", &error), HD_OK);
    assert_true(has_chunk("linear.png", "gAMA\0\1\x86\xa0", 8));
    assert_false(has_chunk("linear.png", "sRGB", 4));
    hd_frame_free(&frame);
}

/* Whatever the style, and what no other format can hold. */
TEST(pfm_files_hold_the_values) {
    HdError error = {0};
    const HdPictureStyle srgb = {HD_CURVE_SRGB, 8};
    HdFrame frame = make_frame(2, 3);
    unsigned char bytes[100];
    const unsigned char third_row[8] = {0, 0, 0x80, 0x3f, 0, 0, 0x20, 0xc0}; /* 1, -2.5 */
    frame.rgb[12] = 1.0f;
    frame.rgb[13] = -2.5f;
    frame.rgb[0] = 65536.0f;
    assert_int_equal(hd_picture_write(&frame, &srgb, "values.Pfm", &error), HD_OK);
    assert_int_equal(read_bytes("values.Pfm", bytes, sizeof bytes), 12 + 72);
    assert_memory_equal(bytes, "PF\n2 3\n-1.0\n", 12);
    assert_memory_equal(bytes + 12, third_row, 8);
    assert_memory_equal(bytes + 12 + 48, "\0\0\x80\x47", 4);
    hd_frame_free(&frame);
}

/* The classic mode's names need no ending. */
TEST(other_endings_are_the_data_format) {
    HdFrame frame = make_frame(3, 2);
    const char *const names[] = {"none", "other.ppm", "png", "apng", "a.png.data"};
    unsigned char bytes[33];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        HdTexture texture = pass_through(&frame, &LINEAR_8, names[i]);
        check_texture(&texture, &frame);
        assert_int_equal(read_bytes(names[i], bytes, sizeof bytes), 32);
        hd_texture_clear(&texture);
    }
    hd_frame_free(&frame);
}

TEST(older_files_are_replaced) {
    HdFrame frame = make_frame(3, 2);
    mkdir("older", 0777);
    write_bytes("older/a.data", "older", 5);
    HdTexture texture = pass_through(&frame, &LINEAR_8, "older/a.data");
    check_texture(&texture, &frame);
    assert_int_equal(count_entries("older"), 1);
    hd_texture_clear(&texture);
    hd_frame_free(&frame);
}

/* The temporary name of a process that died may be there already. */
TEST(stale_temporary_files_do_no_harm) {
    HdError error = {0};
    HdFrame frame = make_frame(3, 2);
    char stale[100];
    snprintf(stale, sizeof stale, "stale/a.data.tmp-%ld-0", (long)getpid());
    mkdir("stale", 0777);
    write_bytes(stale, "stale", 5);
    assert_int_equal(hd_picture_write(&frame, &LINEAR_8, "stale/a.data", &error), HD_OK);
    assert_int_equal(count_entries("stale"), 2);
    hd_frame_free(&frame);
}

TEST(long_names_can_be_written) {
    HdError error = {0};
    HdFrame frame = make_frame(3, 2);
    char name[256] = "";
    memset(name, 'n', sizeof name - 1);
    assert_int_equal(hd_picture_write(&frame, &LINEAR_8, name, &error), HD_OK);
    assert_int_equal(access(name, F_OK), 0);
    hd_frame_free(&frame);
}

/* A limit on the size of files stands for a disk that is full: large pictures fail while they are
   written, small ones when the file is closed. */
static void check_full_disk(const char *path, int width, int height, rlim_t room) {
    HdError error = {0};
    unsigned char bytes[6];
    HdFrame frame = make_frame(width, height);
    struct rlimit old, small;
    write_bytes(path, "older", 5);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    small = old;
    small.rlim_cur = room;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    HdStatus status = hd_picture_write(&frame, &LINEAR_8, path, &error);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    assert_int_equal(status, HD_FAILED);
    expect_contains(error.message, path);
    expect_contains(error.message, "File too large");
    assert_int_equal(read_bytes(path, bytes, sizeof bytes), 5);
    assert_memory_equal(bytes, "older", 5);
    hd_frame_free(&frame);
}

TEST(full_disks_leave_older_files) {
    mkdir("full", 0777);
    void (*old)(int) = signal(SIGXFSZ, SIG_IGN);
    check_full_disk("full/a.data", 2, 2, 4);
    check_full_disk("full/a.data", 300, 300, 10000);
    check_full_disk("full/a.png", 2, 2, 4);
    check_full_disk("full/a.png", 300, 300, 10000);
    check_full_disk("full/a.pfm", 2, 2, 4);
    check_full_disk("full/a.pfm", 300, 300, 10000);
    signal(SIGXFSZ, old);
    assert_int_equal(count_entries("full"), 3);
}

static void check_unwritable(const char *path, HdStatus status, const char *part) {
    HdError error = {0};
    HdFrame frame = make_frame(3, 2);
    assert_int_equal(hd_picture_write(&frame, &LINEAR_8, path, &error), status);
    expect_contains(error.message, part);
    expect_contains(error.message, path);
    hd_frame_free(&frame);
}

TEST(targets_that_are_no_files_are_refused) {
    struct stat found;
    mkdir("targets", 0777);
    mkdir("targets/folder.png", 0777);
    write_bytes("targets/file", "", 0);
    assert_int_equal(mkfifo("targets/pipe.png", 0666), 0);
    check_unwritable("targets/folder.png", HD_BAD_INPUT, "not a regular file");
    check_unwritable("targets/", HD_BAD_INPUT, "expected the name of a file");
    check_unwritable("", HD_BAD_INPUT, "expected the name of a file");
    check_unwritable("targets/pipe.png", HD_BAD_INPUT, "not a regular file");
    assert_int_equal(stat("targets/pipe.png", &found), 0);
    assert_true(S_ISFIFO(found.st_mode));
    check_unwritable("targets/file/a.png", HD_FAILED, "a file has that name");
    check_unwritable("targets/film.mp4", HD_BAD_INPUT, "its ending is that of a film");
    assert_int_equal(count_entries("targets"), 3);
}

static void put_int32(unsigned char *bytes, int64_t value) {
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)((uint64_t)value >> (8 * i) & 0xff);
}

static void check_refused(const void *bytes, size_t size, const char *part) {
    HdError error = {0};
    HdTexture texture = {1, 1, NULL};
    assert_int_equal(hd_texture_decode(&texture, bytes, size, "a name", HD_CURVE_LINEAR, &error),
                     HD_BAD_INPUT);
    assert_int_equal(texture.width, 0);
    assert_null(texture.texels);
    expect_contains(error.message, "a name");
    expect_contains(error.message, part);
}

TEST(wrong_data_is_refused) {
    const struct {
        int64_t width, height;
        const char *part;
    } sizes[] = {{0, 1, "say 0 x 1"},
                 {1, -1, "say 1 x -1"},
                 {INT32_MIN, 1, "say -2147483648 x 1"},
                 {65536, 1, "expected 1..65535"},
                 {1, 65536, "expected 1..65535"},
                 {2, 1, "has 12 bytes, expected 16 for 2 x 1"},
                 {65535, 65535, "expected 17179344908"}};
    unsigned char bytes[13] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        put_int32(bytes, sizes[i].width);
        put_int32(bytes + 4, sizes[i].height);
        check_refused(bytes, 12, sizes[i].part);
    }
    put_int32(bytes, 1);
    put_int32(bytes + 4, 1);
    check_refused(bytes, 11, "has 11 bytes, expected 12");
    check_refused(bytes, 13, "has 13 bytes, expected 12");
    check_refused(bytes, 7, "has 7 bytes");
    check_refused("", 0, "has 0 bytes");
    check_refused("# A picture as text", 19, "neither PNG, JPEG nor the data format");
    check_refused("GIF89a\1\0\1\0", 10, " is a GIF picture, expected PNG, JPEG or the data format");
    check_refused("RIFF\x24\0\0\0WEBPVP8 ", 16, "is a WebP picture");
    check_refused("BM\x46\0\0\0\0\0\0\0", 10, "is a BMP picture");
    check_refused("II*\0\x08\0\0\0\0\0", 10, "is a TIFF picture");
    check_refused("MM\0*\0\0\0\x08", 8, "is a TIFF picture");
}

TEST(large_data_is_no_texture) {
    HdError error = {0};
    HdTexture texture;
    size_t size = 8 + 65536 * 4;
    unsigned char *bytes = calloc(size, 1);
    assert_non_null(bytes);
    put_int32(bytes, 65536);
    put_int32(bytes + 4, 1);
    check_refused(bytes, size, "65536 x 1 pixels, expected 1..65535");
    put_int32(bytes, 1);
    put_int32(bytes + 4, 65535);
    assert_int_equal(hd_texture_decode(&texture, bytes, size - 4, "x", HD_CURVE_LINEAR, &error),
                     HD_OK);
    assert_int_equal(texture.height, 65535);
    free(texture.texels);
    free(bytes);
}

typedef struct Buffer {
    size_t size;
    unsigned char bytes[65536];
} Buffer;

static void append(png_structp png, png_bytep bytes, size_t count) {
    Buffer *buffer = png_get_io_ptr(png);
    assert_true(count <= sizeof buffer->bytes - buffer->size);
    memcpy(buffer->bytes + buffer->size, bytes, count);
    buffer->size += count;
}

static void flush_nothing(png_structp png) {
    (void)png;
}

/* One picture in one of PNG's kinds, and what should be read from it. */
typedef struct Sample {
    int type, depth, interlace, width, height;
    png_byte rows[32][32 * 8];
    png_bytep row_pointers[32];
    png_color palette[256];
    uint16_t expected[32 * 32 * 3];
    Buffer file;
} Sample;

static int count_channels(int type) {
    return type == PNG_COLOR_TYPE_GRAY || type == PNG_COLOR_TYPE_PALETTE ? 1
           : type == PNG_COLOR_TYPE_GRAY_ALPHA                           ? 2
           : type == PNG_COLOR_TYPE_RGB                                  ? 3
                                                                         : 4;
}

static void put_value(png_byte *row, int index, int depth, uint32_t value) {
    int bit = index * depth;
    if (depth == 16) {
        row[index * 2] = (png_byte)(value >> 8);
        row[index * 2 + 1] = (png_byte)value;
    } else {
        row[bit / 8] = (png_byte)(row[bit / 8] | value << (8 - depth - bit % 8));
    }
}

static void expect(Sample *sample, int pixel, const uint32_t *values) {
    uint32_t scale = 65535u / ((1u << sample->depth) - 1);
    for (int c = 0; c < 3; c++) {
        uint32_t value = values[count_channels(sample->type) >= 3 ? c : 0];
        const png_color *entry = &sample->palette[value & 255];
        png_byte entries[3] = {entry->red, entry->green, entry->blue};
        sample->expected[pixel * 3 + c] = sample->type == PNG_COLOR_TYPE_PALETTE
                                              ? (uint16_t)(entries[c] * 257)
                                              : (uint16_t)(value * scale);
    }
}

static void fill_sample(Sample *sample, uint32_t seed) {
    int channels = count_channels(sample->type);
    for (int i = 0; i < 256; i++)
        sample->palette[i] = (png_color){(png_byte)next_random(&seed), (png_byte)next_random(&seed),
                                         (png_byte)next_random(&seed)};
    for (int y = 0; y < sample->height; y++) {
        sample->row_pointers[y] = sample->rows[y];
        for (int x = 0; x < sample->width; x++) {
            uint32_t values[4];
            for (int c = 0; c < channels; c++) {
                values[c] = next_random(&seed) & ((1u << sample->depth) - 1);
                put_value(sample->rows[y], x * channels + c, sample->depth, values[c]);
            }
            expect(sample, y * sample->width + x, values);
        }
    }
}

static void encode_sample(Sample *sample, bool with_transparency) {
    const png_byte alphas[2] = {0, 100};
    const png_color_16 key = {1, 1, 1, 1, 1};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &sample->file, append, flush_nothing);
    png_set_IHDR(png, info, (png_uint_32)sample->width, (png_uint_32)sample->height, sample->depth,
                 sample->type, sample->interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (sample->type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, sample->palette, 1 << sample->depth);
    if (with_transparency)
        png_set_tRNS(png, info, alphas, 2, &key);
    png_set_gAMA(png, info, 0.2);
    png_write_info(png, info);
    png_write_image(png, sample->row_pointers);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
}

static Sample *make_sample(int type, int depth, int interlace, int width, int height,
                           bool with_transparency) {
    Sample *sample = calloc(1, sizeof *sample);
    assert_non_null(sample);
    sample->type = type;
    sample->depth = depth;
    sample->interlace = interlace;
    sample->width = width;
    sample->height = height;
    fill_sample(sample, (uint32_t)(type * 100 + depth));
    encode_sample(sample, with_transparency);
    return sample;
}

static void check_sample(const Sample *sample) {
    HdError error = {0};
    HdTexture texture;
    assert_int_equal(hd_texture_decode(&texture, sample->file.bytes, sample->file.size, "x",
                                       HD_CURVE_LINEAR, &error),
                     HD_OK);
    assert_int_equal(texture.width, sample->width);
    assert_int_equal(texture.height, sample->height);
    assert_memory_equal(texture.texels, sample->expected,
                        (size_t)(sample->width * sample->height) * 6);
    free(texture.texels);
}

TEST(every_kind_of_png_is_read) {
    const int kinds[][2] = {{PNG_COLOR_TYPE_GRAY, 1},        {PNG_COLOR_TYPE_GRAY, 2},
                            {PNG_COLOR_TYPE_GRAY, 4},        {PNG_COLOR_TYPE_GRAY, 8},
                            {PNG_COLOR_TYPE_GRAY, 16},       {PNG_COLOR_TYPE_RGB, 8},
                            {PNG_COLOR_TYPE_RGB, 16},        {PNG_COLOR_TYPE_PALETTE, 1},
                            {PNG_COLOR_TYPE_PALETTE, 2},     {PNG_COLOR_TYPE_PALETTE, 4},
                            {PNG_COLOR_TYPE_PALETTE, 8},     {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
                            {PNG_COLOR_TYPE_GRAY_ALPHA, 16}, {PNG_COLOR_TYPE_RGB_ALPHA, 8},
                            {PNG_COLOR_TYPE_RGB_ALPHA, 16}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (int variant = 0; variant < 8; variant++) {
            bool may_have_key = (kinds[i][0] & PNG_COLOR_MASK_ALPHA) == 0;
            int interlace = variant & 1 ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE;
            Sample *sample = make_sample(kinds[i][0], kinds[i][1], interlace, variant & 2 ? 13 : 1,
                                         variant & 2 ? 9 : 1, (variant & 4) != 0 && may_have_key);
            check_sample(sample);
            free(sample);
        }
}

static void start_capture(int *old_descriptor) {
    int file = open("stderr.txt", O_RDWR | O_CREAT | O_TRUNC, 0666);
    assert_true(file >= 0);
    fflush(stderr);
    *old_descriptor = dup(2);
    dup2(file, 2);
    close(file);
}

static off_t end_capture(int old_descriptor) {
    struct stat found;
    fflush(stderr);
    assert_int_equal(fstat(2, &found), 0);
    dup2(old_descriptor, 2);
    close(old_descriptor);
    return found.st_size;
}

/* A copy of its own size lets the sanitizer see a read past the end. */
static HdStatus decode_copy(const unsigned char *bytes, size_t size) {
    HdError error = {0};
    HdTexture texture;
    unsigned char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    HdStatus status = hd_texture_decode(&texture, copy, size, "x", HD_CURVE_LINEAR, &error);
    assert_true((status == HD_OK) == (texture.texels != NULL));
    assert_true(status == HD_OK || error.message[0] != '\0');
    free(texture.texels);
    free(copy);
    return status;
}

TEST(damaged_png_is_refused_quietly) {
    int old_descriptor;
    size_t accepted = 0;
    Sample *sample = make_sample(PNG_COLOR_TYPE_PALETTE, 4, PNG_INTERLACE_ADAM7, 13, 9, true);
    start_capture(&old_descriptor);
    for (size_t size = 0; size < sample->file.size; size++)
        accepted += decode_copy(sample->file.bytes, size) == HD_OK;
    for (size_t i = 0; i < sample->file.size; i++) {
        sample->file.bytes[i] ^= 0x10;
        decode_copy(sample->file.bytes, sample->file.size);
        sample->file.bytes[i] ^= 0x10;
    }
    off_t printed = end_capture(old_descriptor);
    assert_int_equal(accepted, 0);
    assert_int_equal(printed, 0);
    free(sample);
}

TEST(messages_of_libpng_are_passed_on) {
    Sample *sample = make_sample(PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_NONE, 13, 9, false);
    unsigned char *bytes = sample->file.bytes;
    check_refused(bytes, sample->file.size - 20, "the file ends too early");
    check_refused(bytes, 20, "IHDR");
    bytes[29] ^= 1;
    check_refused(bytes, sample->file.size, "IHDR: CRC error");
    bytes[17] = 1; /* width 65536 + 13 */
    check_refused(bytes, sample->file.size, "65549 x 9 pixels, expected 1..65535");
    bytes[17] = 0;
    bytes[23] = 0;
    check_refused(bytes, sample->file.size, "13 x 0 pixels, expected 1..65535");
    bytes[20] = 0xff;
    check_refused(bytes, sample->file.size, "13 x 4278190080 pixels");
    bytes[18] = bytes[19] = bytes[22] = bytes[23] = 0xff;
    bytes[20] = 0;
    check_refused(bytes, sample->file.size, "65535 x 65535 pixels, expected at most 268435456");
    free(sample);
}

static void check_unreadable(const char *path, const char *part) {
    HdError error = {0};
    HdTexture texture = {1, 1, NULL};
    assert_int_equal(hd_texture_read(&texture, path, HD_CURVE_LINEAR, &error), HD_BAD_INPUT);
    assert_int_equal(texture.width, 0);
    expect_contains(error.message, path);
    expect_contains(error.message, part);
}

TEST(unreadable_textures_are_named) {
    mkdir("textures", 0777);
    write_bytes("textures/empty", "", 0);
    assert_int_equal(mkfifo("textures/pipe", 0666), 0);
    check_unreadable("textures/missing", "No such file");
    check_unreadable("textures", "not a regular file");
    check_unreadable("textures/pipe", "not a regular file");
    check_unreadable("/dev/zero", "not a regular file");
    check_unreadable("textures/empty", "has 0 bytes");
    write_bytes("textures/sparse", "", 0);
    assert_int_equal(truncate("textures/sparse", (off_t)5 << 30), 0);
    check_unreadable("textures/sparse", "5368709120 bytes, expected at most 4294967296");
}
