/* SPDX-License-Identifier: MIT */
#include "image/picture.h"
#include "unit_test.h"

TEST(the_extension_selects_the_format) {
    const struct {
        const char *path;
        const HdFormat *format;
        bool is_film;
    } outputs[] = {{"a.data", &hd_format_data, false},
                   {"a.png", &hd_format_png, false},
                   {"a/b.PnG", &hd_format_png, false},
                   {"out/a.MKV", &hd_format_mkv, true},
                   {"a.gif", &hd_format_gif, true},
                   {".gif", &hd_format_gif, true},
                   {"a.mp4.png", &hd_format_png, false},
                   {"png", NULL, false},
                   {"", NULL, false},
                   {"a.mp4/b", NULL, false},
                   {"a.png ", NULL, false}};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        assert_ptr_equal(hd_format_of(outputs[i].path), outputs[i].format);
        assert_int_equal(hd_format_is_film(outputs[i].format), outputs[i].is_film);
    }
}

TEST(styles_that_a_format_lacks_are_refused) {
    static const struct {
        const char *path;
        HdPictureStyle style;
        const char *refusal;
    } cases[] = {
        {"a.gif", {HD_CURVE_SRGB, 8, false}, NULL},
        {"a.gif", {HD_CURVE_LINEAR, 8, false}, "a.gif cannot be linear, because GIF files"},
        {"a.png", {HD_CURVE_SRGB, 32, false}, "a.png cannot have 32 bits a channel"},
        {"a.exr", {HD_CURVE_LINEAR, 32, false}, NULL},
        {"a.mkv", {HD_CURVE_SRGB, 32, false}, NULL},
        {"a.other", {HD_CURVE_LINEAR, 32, false}, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        HdError error = {0};
        assert_int_equal(hd_format_check_style(cases[i].path, &cases[i].style, &error),
                         cases[i].refusal != NULL ? HD_BAD_INPUT : HD_OK);
        if (cases[i].refusal != NULL)
            expect_contains(error.message, cases[i].refusal);
    }
}
