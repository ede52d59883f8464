/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "picture_files.h"

/* Two chunks of 16 lines and a part of one. */
enum { WIDTH = 13, HEIGHT = 35, VALUES = WIDTH * HEIGHT * 3 };

static const HdPictureStyle HALF = {HD_CURVE_SRGB, 8, false}, FLOAT = {HD_CURVE_SRGB, 32, false};
static const HdPictureLabel LABEL = {
    .scene = "a.json", .options = "--depth 3", .frame = 7, .crop = {640, 480, 100, 417}};

static HdError error;

static void write_picture(const float values[VALUES], const HdPictureStyle *style) {
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    memcpy(frame.rgb, values, VALUES * sizeof *values);
    write_frame(&frame, &hd_format_exr, style, &LABEL, "a.exr");
}

static void read_back(HdPictureValue values[VALUES], int bits) {
    HdPictureFacts facts;
    assert_int_equal(read_picture("a.exr", HD_CURVE_SRGB, &facts, values, VALUES, &error), HD_OK);
    assert_int_equal(facts.width, WIDTH);
    assert_int_equal(facts.height, HEIGHT);
    assert_int_equal(facts.bits, bits);
    assert_ptr_equal(facts.format, &hd_format_exr);
    assert_int_equal(facts.curve, HD_CURVE_LINEAR);
}

TEST(floats_read_back_equal) {
    float values[VALUES];
    HdPictureValue read[VALUES];
    for (int i = 0; i < VALUES; i++)
        values[i] = (float)(i * i) / 977.0f - 3.0f;
    values[5] = 1e30f;
    write_picture(values, &FLOAT);
    read_back(read, 32);
    for (int i = 0; i < VALUES; i++)
        assert_true(read[i].linear == (double)values[i]);
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
    HdPictureValue read[VALUES];
    const int count = sizeof cases / sizeof *cases;
    for (int i = 0; i < count; i++)
        values[i] = cases[i].value;
    values[count] = NAN;
    write_picture(values, &HALF);
    read_back(read, 16);
    for (int i = 0; i < count; i++)
        if (read[i].linear != cases[i].half)
            fail_msg("%a became %a, expected %a", (double)cases[i].value, read[i].linear,
                     cases[i].half);
    assert_true(isnan(read[count].linear));
}

/* Returns a number that half does not have: of a layer's channel, by the place of its name. */
static float number_at(int pixel, int which) {
    return (float)(70001 + 16 * pixel + which);
}

/* Channels of the first hit are in the order of the names. */
TEST(layers_become_channels) {
    enum { COUNT = 7, BOUND = 2 };
    static const char *const names[COUNT] = {"A",        "Z",        "bound", "normal.X",
                                             "normal.Y", "normal.Z", "object"};
    HdFrame frame;
    HdPictureReader *reader;
    HdPictureValue row[WIDTH * 3];
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    assert_int_equal(hd_frame_add_layers(&frame, 2 * HD_LAYER_BIT(HD_LAYER_ALPHA) - 1, &error),
                     HD_OK);
    assert_int_equal(frame.first_floats, COUNT - 1);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int k = 0; k < frame.first_floats; k++)
            frame.first[i * frame.first_floats + k] = number_at(i, k < BOUND ? k : k + 1);
        frame.first[i * frame.first_floats + HD_FIRST_ALPHA] = (float)(i % 5) / 4.0F;
        frame.bounds[i] = number_at(i, BOUND);
    }
    /* the first pixel hits nothing */
    frame.first[HD_FIRST_DEPTH] = frame.first[HD_FIRST_OBJECT] = 0.0F;
    write_frame(&frame, &hd_format_exr, &HALF, &LABEL, "a.exr");
    assert_int_equal(hd_picture_reader_open(&reader, "a.exr", &error), HD_OK);
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    assert_int_equal(facts->bits, 16);
    assert_int_equal(facts->further, COUNT);
    assert_int_equal(hd_picture_reader_start(reader, HD_CURVE_SRGB, &error), HD_OK);
    for (int y = 0; y < HEIGHT; y++) {
        assert_int_equal(hd_picture_reader_next(reader, row, &error), HD_OK);
        for (int i = 0; i < COUNT * WIDTH; i++) {
            const int channel = i / WIDTH, x = i % WIDTH, pixel = y * WIDTH + x;
            float expected = channel == 0 ? (float)(pixel % 5) / 4.0F : number_at(pixel, channel);
            if (pixel == 0 && channel == 1)
                expected = INFINITY;
            if (pixel == 0 && channel == 6)
                expected = 0.0F;
            const float found = hd_picture_reader_further(reader, channel)[x];
            if (found != expected)
                fail_msg("%s at %d, %d: %g, expected %g", names[channel], x, y, (double)found,
                         (double)expected);
            assert_string_equal(facts->names[channel], names[channel]);
        }
    }
    hd_picture_reader_close(reader);
}

static unsigned char bytes[65536];
static size_t size;

/* Bytes of a written picture. */
static void get_bytes(void) {
    float values[VALUES];
    for (int i = 0; i < VALUES; i++)
        values[i] = (float)(i % 17);
    write_picture(values, &HALF);
    size = read_bytes("a.exr", bytes, sizeof bytes);
}

static HdStatus read_bytes_back(size_t count) {
    HdPictureFacts facts;
    HdPictureValue read[VALUES];
    write_bytes("bad.exr", bytes, count);
    return read_picture("bad.exr", HD_CURVE_SRGB, &facts, read, VALUES, &error);
}

TEST(cut_files_are_refused_quietly) {
    int accepted = 0;
    get_bytes();
    const int capture = begin_capture();
    for (size_t i = 0; i < size; i += i < 400 ? 7 : 101)
        accepted += read_bytes_back(i) == HD_OK;
    assert_int_equal(end_capture(capture), 0);
    assert_int_equal(accepted, 0);
    assert_int_equal(read_bytes_back(size - 40), HD_BAD_INPUT);
    expect_contains(error.message, "cannot read bad.exr as OpenEXR: ");
}

/* Returns the offset of the first `text`. */
static unsigned char *find(const char *text) {
    for (size_t i = 0; i + strlen(text) <= size; i++)
        if (memcmp(bytes + i, text, strlen(text)) == 0)
            return bytes + i;
    fail_msg("there is no %s in the file", text);
    return NULL;
}

/* Four numbers of two bytes and two zero bytes, the low byte first. */
static void expect_window(const unsigned char *window, const int expected[4]) {
    for (int i = 0; i < 4; i++)
        assert_int_equal(window[4 * i] | window[4 * i + 1] << 8, expected[i]);
}

TEST(a_crop_keeps_its_place) {
    static const int data[] = {100, 417, 100 + WIDTH - 1, 417 + HEIGHT - 1},
                     display[] = {0, 0, 639, 479};
    get_bytes();
    expect_window(find("dataWindow") + 11 + 6 + 4, data);
    expect_window(find("displayWindow") + 14 + 6 + 4, display);
}

TEST(other_kinds_are_refused) {
    get_bytes();
    find("a.json"); /* the label */
    find("--depth 3");
    /* After a channel's name and its zero byte come the type, four bytes, and 8 more to the
       sampling. After the name of the data window's type come its size and four numbers. */
    unsigned char *green = find("chlist") + 7 + 4 + 18;
    unsigned char *window = find("dataWindow") + 11 + 6 + 4;
    const struct {
        unsigned char *at, value;
        const char *message;
    } changes[] = {
        {green, 'H', "bad.exr is an OpenEXR without R, G and B"},
        {green + 2, 0, "bad.exr is an OpenEXR without R, G and B"}, /* whole numbers */
        {window + 8 + 3, 0x7f, "cannot read bad.exr as OpenEXR"},
        {window + 8 + 2, 2, "cannot read bad.exr as OpenEXR"},
    };
    assert_int_equal(green[0], 'G');
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        const unsigned char before = *changes[i].at;
        *changes[i].at = changes[i].value;
        assert_int_equal(read_bytes_back(size), HD_BAD_INPUT);
        expect_contains(error.message, changes[i].message);
        *changes[i].at = before;
    }
}
