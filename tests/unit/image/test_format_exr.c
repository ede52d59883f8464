/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <fcntl.h>
#include <math.h>

#include "image/picture.h"
#include "image/row_reader.h"
#include "test_folder.h"

/* Two chunks of 16 lines and a part of one. */
enum { WIDTH = 13, HEIGHT = 35, VALUES = WIDTH * HEIGHT * 3 };

static const HdPictureStyle HALF = {HD_CURVE_SRGB, 8}, FLOAT = {HD_CURVE_SRGB, 32};
static const HdPictureLabel LABEL = {.scene = "a.json", .options = "--depth 3", .frame = 7};

static HdError error;

static void write_picture(const float values[VALUES], const HdPictureStyle *style) {
    HdAtomicFile file;
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    memcpy(frame.rgb, values, VALUES * sizeof *values);
    assert_int_equal(
        hd_picture_prepare(&file, &frame, &hd_format_exr, style, &LABEL, "a.exr", &error), HD_OK);
    assert_int_equal(hd_atomic_file_commit(&file, HD_FLEETING, &error), HD_OK);
    hd_frame_free(&frame);
}

/* The values of a file; those of `display` are left out. */
static HdStatus read_picture(const char *path, double values[VALUES], int bits) {
    HdPictureReader *reader;
    HdPictureValue row[WIDTH * 3];
    HdStatus status = hd_picture_reader_open(&reader, path, &error);
    if (status != HD_OK)
        return status;
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    status = facts->width == WIDTH && facts->height == HEIGHT ? HD_OK : HD_BAD_INPUT;
    if (status == HD_OK && bits > 0) {
        assert_int_equal(facts->bits, bits);
        assert_ptr_equal(facts->format, &hd_format_exr);
        assert_int_equal(facts->curve, HD_CURVE_LINEAR);
    }
    if (status == HD_OK)
        status = hd_picture_reader_start(reader, HD_CURVE_SRGB, &error);
    for (int y = 0; y < HEIGHT && status == HD_OK; y++) {
        status = hd_picture_reader_next(reader, row, &error);
        for (int i = 0; i < WIDTH * 3 && status == HD_OK; i++)
            values[y * WIDTH * 3 + i] = row[i].linear;
    }
    hd_picture_reader_close(reader);
    return status;
}

TEST(floats_come_back) {
    float values[VALUES];
    double read[VALUES];
    for (int i = 0; i < VALUES; i++)
        values[i] = (float)(i * i) / 977.0f - 3.0f;
    values[5] = 1e30f;
    write_picture(values, &FLOAT);
    assert_int_equal(read_picture("a.exr", read, 32), HD_OK);
    for (int i = 0; i < VALUES; i++)
        assert_true(read[i] == (double)values[i]);
}

TEST(halves_are_the_nearest) {
    static const struct {
        float value;
        double half;
    } cases[] = {{0.0f, 0.0},
                 {1.0f, 1.0},
                 {-2.5f, -2.5},
                 {0x1.004p0f, 0x1.004p0},
                 {0x1.002p0f, 1.0},           /* a tie, to the even one below */
                 {0x1.006p0f, 0x1.008p0},     /* to the even one above */
                 {0x1.002002p0f, 0x1.004p0},  /* above a tie */
                 {0x1.fffp0f, 2.0},           /* into the next power */
                 {0x1p-14f, 0x1p-14},         /* the least normal one */
                 {0x1.ff8p-15f, 0x1.ff8p-15}, /* steps of 2^-24 */
                 {0x1.ffcp-15f, 0x1p-14},     /* a tie */
                 {0x1.8p-24f, 0x1p-23},       /* a tie */
                 {0x1p-25f, 0.0},             /* a tie */
                 {0x1.000002p-25f, 0x1p-24},
                 {-0x1p-30f, 0.0},
                 {65504.0f, 65504.0},
                 {65519.0f, 65504.0},
                 {1e6f, 65504.0},
                 {-1e30f, -65504.0}};
    float values[VALUES] = {0.0f};
    double read[VALUES];
    const int count = sizeof cases / sizeof *cases;
    for (int i = 0; i < count; i++)
        values[i] = cases[i].value;
    values[count] = NAN;
    write_picture(values, &HALF);
    assert_int_equal(read_picture("a.exr", read, 16), HD_OK);
    for (int i = 0; i < count; i++)
        if (read[i] != cases[i].half)
            fail_msg("%a became %a, expected %a", (double)cases[i].value, read[i], cases[i].half);
    assert_true(isnan(read[count]));
}

/* Numbers that half has not. */
static float number_at(int pixel, int which) {
    return (float)(70001 + 16 * pixel + which);
}

static void fill_layers(HdFrame *frame) {
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int k = 0; k < frame->first_floats; k++)
            frame->first[i * frame->first_floats + k] = number_at(i, k);
        frame->first[i * frame->first_floats + HD_FIRST_ALPHA] = (float)(i % 5) / 4.0F;
        for (int k = 0; k < HD_EFFORT_FLOATS && frame->effort != NULL; k++)
            frame->effort[i * HD_EFFORT_FLOATS + k] = number_at(i, 10 + k);
    }
    if (frame->first_floats > 1) /* nothing is met there */
        frame->first[HD_FIRST_DEPTH] = frame->first[HD_FIRST_OBJECT] = 0.0F;
}

static void write_layers(unsigned layers) {
    HdAtomicFile file;
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    assert_int_equal(hd_frame_add_layers(&frame, layers, &error), HD_OK);
    fill_layers(&frame);
    assert_int_equal(
        hd_picture_prepare(&file, &frame, &hd_format_exr, &HALF, &LABEL, "a.exr", &error), HD_OK);
    assert_int_equal(hd_atomic_file_commit(&file, HD_FLEETING, &error), HD_OK);
    hd_frame_free(&frame);
}

/* What a channel should hold in a pixel. */
static float expected_of(const char *name, int pixel) {
    static const char *const firsts[] = {"A", "Z", "normal.X", "normal.Y", "normal.Z", "object"};
    if (strcmp(name, "A") == 0)
        return (float)(pixel % 5) / 4.0F;
    if (pixel == 0 && strcmp(name, "Z") == 0)
        return INFINITY;
    if (pixel == 0 && strcmp(name, "object") == 0)
        return 0.0F;
    for (int i = 0; i < HD_MOST_FIRST_FLOATS; i++)
        if (strcmp(firsts[i], name) == 0)
            return number_at(pixel, i);
    return number_at(pixel, strcmp(name, "samples") == 0 ? 10 : 11);
}

/* The file's further channels are those, and hold what they should. */
static void expect_channels(const char *const *names, int count) {
    HdPictureReader *reader;
    HdPictureValue row[WIDTH * 3];
    assert_int_equal(hd_picture_reader_open(&reader, "a.exr", &error), HD_OK);
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    assert_int_equal(facts->bits, 16);
    assert_int_equal(facts->further, count);
    for (int i = 0; i < count; i++)
        assert_string_equal(facts->names[i], names[i]);
    assert_int_equal(hd_picture_reader_start(reader, HD_CURVE_SRGB, &error), HD_OK);
    for (int y = 0; y < HEIGHT; y++) {
        assert_int_equal(hd_picture_reader_next(reader, row, &error), HD_OK);
        for (int i = 0; i < count * WIDTH; i++) {
            const int x = i % WIDTH;
            const float found = hd_picture_reader_further(reader, i / WIDTH)[x];
            const float expected = expected_of(names[i / WIDTH], y * WIDTH + x);
            if (found != expected)
                fail_msg("%s at %d, %d: %g, expected %g", names[i / WIDTH], x, y, (double)found,
                         (double)expected);
        }
    }
    hd_picture_reader_close(reader);
}

TEST(layers_become_channels) {
    static const char *const all[] = {"A",        "Z",        "bound",  "normal.X",
                                      "normal.Y", "normal.Z", "object", "samples"};
    static const char *const some[] = {"A", "object"};
    static const char *const effort[] = {"A", "samples"};
    const unsigned alpha = HD_LAYER_BIT(HD_LAYER_ALPHA);
    write_layers(2 * alpha - 1);
    expect_channels(all, 8);
    write_layers(alpha | HD_LAYER_BIT(HD_LAYER_OBJECT));
    expect_channels(some, 2);
    write_layers(alpha | HD_LAYER_BIT(HD_LAYER_SAMPLES));
    expect_channels(effort, 2);
    write_layers(alpha);
    expect_channels(all, 1);
}

static void start_capture(int *old_descriptor) {
    const int file = open("stderr.txt", O_RDWR | O_CREAT | O_TRUNC, 0666);
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

/* Whatever is wrong with a file, it is told by a status and a message alone. */
TEST(damaged_files_are_refused_quietly) {
    static unsigned char bytes[65536];
    float values[VALUES];
    double read[VALUES];
    int old_descriptor;
    for (int i = 0; i < VALUES; i++)
        values[i] = (float)(i % 17);
    write_picture(values, &HALF);
    FILE *file = fopen("a.exr", "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    start_capture(&old_descriptor);
    int accepted = 0, unexpected = 0;
    for (size_t i = 0; i < size; i++) {
        write_bytes("cut.exr", bytes, i);
        accepted += read_picture("cut.exr", read, 0) == HD_OK;
    }
    for (size_t i = 0; i < size; i++) {
        bytes[i] ^= 0x11;
        write_bytes("bent.exr", bytes, size);
        const HdStatus status = read_picture("bent.exr", read, 0);
        unexpected += status != HD_OK && status != HD_BAD_INPUT;
        bytes[i] ^= 0x11;
    }
    const off_t printed = end_capture(old_descriptor);
    assert_int_equal(accepted, 0);
    assert_int_equal(unexpected, 0);
    assert_int_equal(printed, 0);
    write_bytes("cut.exr", bytes, size - 40);
    assert_int_equal(read_picture("cut.exr", read, 0), HD_BAD_INPUT);
    expect_contains(error.message, "cannot read cut.exr as OpenEXR: ");
}

/* Where the first `text` stands. */
static unsigned char *find(unsigned char *bytes, size_t size, const char *text) {
    for (size_t i = 0; i + strlen(text) <= size; i++)
        if (memcmp(bytes + i, text, strlen(text)) == 0)
            return bytes + i;
    fail_msg("there is no %s in the file", text);
    return NULL;
}

static void expect_refused(const unsigned char *bytes, size_t size, const char *part) {
    double read[VALUES];
    write_bytes("bad.exr", bytes, size);
    assert_int_equal(read_picture("bad.exr", read, 0), HD_BAD_INPUT);
    expect_contains(error.message, "bad.exr");
    expect_contains(error.message, part);
}

TEST(other_kinds_are_refused) {
    static unsigned char bytes[65536];
    float values[VALUES] = {0.0f};
    write_picture(values, &HALF);
    FILE *file = fopen("a.exr", "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    /* Behind a channel's name and its zero byte: the type, four bytes, and 8 more to the sampling.
     */
    unsigned char *green = find(bytes, size, "chlist") + 7 + 4 + 18;
    assert_int_equal(green[0], 'G');
    green[0] = 'H';
    expect_refused(bytes, size, "is an OpenEXR without R, G and B");
    green[0] = 'G';
    green[2] = 0; /* whole numbers */
    expect_refused(bytes, size, "is an OpenEXR without R, G and B");
    green[2] = 1;
    /* The data window: its type's name, the size, and four numbers. */
    unsigned char *window = find(bytes, size, "dataWindow") + 11 + 6 + 4;
    window[8 + 3] = 0x7f;
    expect_refused(bytes, size, "cannot read bad.exr as OpenEXR");
    window[8 + 3] = 0;
    window[8 + 2] = 2;
    expect_refused(bytes, size, "cannot read bad.exr as OpenEXR");
}
