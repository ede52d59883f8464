/* SPDX-License-Identifier: MIT */
#include "output_kind.h"

#include <stddef.h>

#include "paths.h"

HdOutputKind hd_output_kind(const char *path) {
    static const struct {
        const char *ending;
        HdOutputKind kind;
    } endings[] = {{".data", HD_OUTPUT_DATA}, {".png", HD_OUTPUT_PNG}, {".pfm", HD_OUTPUT_PFM},
                   {".mp4", HD_OUTPUT_MP4},   {".mkv", HD_OUTPUT_MKV}, {".gif", HD_OUTPUT_GIF}};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (hd_path_has_ending(path, endings[i].ending))
            return endings[i].kind;
    return HD_OUTPUT_UNKNOWN;
}

bool hd_output_is_film(HdOutputKind kind) {
    return kind == HD_OUTPUT_MP4 || kind == HD_OUTPUT_MKV || kind == HD_OUTPUT_GIF;
}

const char *hd_output_endings(void) {
    return "film.mp4, film.mkv, film.gif, picture.png, picture.pfm or picture.data";
}
