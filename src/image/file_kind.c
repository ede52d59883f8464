/* SPDX-License-Identifier: MIT */
#include "image/file_kind.h"

#include "system/path.h"

static const struct Format {
    const char *ending;
    HdOutputKind kind;
    bool is_film;
} formats[] = {
    {".mp4", HD_OUTPUT_MP4, true},  {".mkv", HD_OUTPUT_MKV, true},
    {".gif", HD_OUTPUT_GIF, true},  {".png", HD_OUTPUT_PNG, false},
    {".pfm", HD_OUTPUT_PFM, false}, {".data", HD_OUTPUT_DATA, false},
};

enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

HdOutputKind hd_output_kind(const char *path) {
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (hd_path_has_ending(path, formats[i].ending))
            return formats[i].kind;
    return HD_OUTPUT_UNKNOWN;
}

bool hd_output_is_film(HdOutputKind kind) {
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (formats[i].kind == kind)
            return formats[i].is_film;
    return false;
}

bool hd_name_is_film(const char *path) {
    return hd_output_is_film(hd_output_kind(path));
}
