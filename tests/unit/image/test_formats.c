/* SPDX-License-Identifier: MIT */
#include "image/formats.h"
#include "unit_test.h"

TEST(the_ending_tells_the_format) {
    const struct {
        const char *path;
        const HdFormat *format;
        bool is_film;
    } outputs[] = {{"a.data", &hd_format_data, false},
                   {"a.png", &hd_format_png, false},
                   {"a/b.PnG", &hd_format_png, false},
                   {"a.exr", &hd_format_exr, false},
                   {"a.pfm", &hd_format_pfm, false},
                   {"a.mp4", &hd_format_mp4, true},
                   {"out/a.MKV", &hd_format_mkv, true},
                   {"a.gif", &hd_format_gif, true},
                   {"a.png.data", &hd_format_data, false},
                   {".gif", &hd_format_gif, true},
                   {"a.mp4.png", &hd_format_png, false},
                   {"png", NULL, false},
                   {"apng", NULL, false},
                   {"", NULL, false},
                   {"a.mp4/b", NULL, false},
                   {"a.png ", NULL, false},
                   {"a.jpg", NULL, false},
                   {"a.mp4.tmp", NULL, false}};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        assert_ptr_equal(hd_format_of(outputs[i].path), outputs[i].format);
        assert_int_equal(hd_format_is_film(outputs[i].format), outputs[i].is_film);
    }
}

/* Counts the formats of a list such as ".mp4, .mkv or .gif"; each is a film, or none is. */
static int count_formats(const char *list, bool are_films) {
    char words[64];
    int count = 0;
    assert_true(strlen(list) < sizeof words);
    memcpy(words, list, strlen(list) + 1);
    for (char *word = strtok(words, ", "); word != NULL; word = strtok(NULL, ", "))
        if (strcmp(word, "or") != 0) {
            const HdFormat *format = hd_format_of(word);
            assert_non_null(format);
            assert_int_equal(hd_format_is_film(format), are_films);
            assert_int_equal(format->write == NULL, are_films);
            count++;
        }
    return count;
}

#define COUNTED(name) +1

TEST(the_lists_name_every_format) {
    assert_string_equal(HD_FILM_ENDINGS, ".mp4, .mkv or .gif");
    assert_int_equal(count_formats(HD_FILM_ENDINGS, true),
                     HD_FILM_FORMATS(COUNTED, COUNTED, COUNTED));
    assert_int_equal(count_formats(HD_PICTURE_ENDINGS, false),
                     HD_PICTURE_FORMATS(COUNTED, COUNTED, COUNTED));
}

static void expect_style(const char *path, HdCurve curve, int bits, const char *refusal) {
    HdError error = {0};
    const HdPictureStyle style = {.curve = curve, .bits = bits};
    const HdStatus status = hd_format_check_style(path, &style, &error);
    assert_int_equal(status, refusal != NULL ? HD_BAD_INPUT : HD_OK);
    if (refusal != NULL)
        expect_contains(error.message, refusal);
}

TEST(what_a_format_cannot_say_is_refused) {
    expect_style("a.gif", HD_CURVE_SRGB, 8, NULL);
    expect_style("a.gif", HD_CURVE_LINEAR, 8, "a.gif cannot be linear, for a GIF");
    expect_style("a.mp4", HD_CURVE_LINEAR, 8, NULL);
    expect_style("a.png", HD_CURVE_LINEAR, 16, NULL);
    expect_style("a.png", HD_CURVE_SRGB, 32, "a.png cannot have 32 bits a channel");
    expect_style("a.exr", HD_CURVE_LINEAR, 32, NULL);
    expect_style("a.mkv", HD_CURVE_SRGB, 32, NULL);
    expect_style("a.other", HD_CURVE_LINEAR, 32, NULL);
}
