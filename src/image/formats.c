/* SPDX-License-Identifier: MIT */
#include "image/formats.h"

#include "system/path.h"

#define ROW(name) {"." #name, &hd_format_##name},

static const struct Row {
    const char *ending;
    const HdFormat *format;
} rows[] = {HD_FILM_FORMATS(ROW, ROW, ROW) HD_PICTURE_FORMATS(ROW, ROW, ROW)};

const HdFormat *hd_format_of(const char *path) {
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (hd_path_has_ending(path, rows[i].ending))
            return rows[i].format;
    return NULL;
}

bool hd_format_is_film(const HdFormat *format) {
    return format != NULL && format->film_arguments != NULL;
}

HdStatus hd_format_check_style(const char *path, const HdPictureStyle *style, HdError *error) {
    const HdFormat *format = hd_format_of(path);
    if (format != NULL && format->is_srgb_alone && style->curve != HD_CURVE_SRGB)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s cannot be linear, for a %s has no way to say so: expected output.curve "
                       "\"srgb\", or another film",
                       path, format->name);
    if (format == &hd_format_png && style->bits > 16)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s cannot have %d bits a channel: expected output.bits 8 or 16, or another "
                       "ending, such as .exr",
                       path, style->bits);
    return HD_OK;
}
