/* SPDX-License-Identifier: MIT */
#include "input/scene_texts.h"

#include <string.h>

#include "base/text.h"
#include "image/file_kind.h"
#include "input/builtin.h"
#include "input/json/words.h"
#include "system/path.h"

bool hd_check_file_name(HdSceneReport *report, const json_t *value) {
    const size_t length = json_string_length(value);
    if (length >= HD_MAX_PATH) {
        hd_report(report, "has %zu bytes, expected fewer than %d", length, HD_MAX_PATH);
        return false;
    }
    for (const char *c = json_string_value(value); *c != '\0'; c++)
        if (hd_control_bytes(c) > 0) {
            hd_report_value(report, value, "a name without control characters");
            return false;
        }
    return true;
}

void hd_check_output_path(HdSceneReport *report, const char *path) {
    char quoted[HD_WORDS_SIZE];
    HdError error;
    const HdOutputKind kind = hd_output_kind(path);
    hd_quoted(path, quoted);
    if (path[0] == '\0')
        return;
    if (kind == HD_OUTPUT_UNKNOWN)
        hd_report(report,
                  "is %s, expected the name of a film (" HD_FILM_ENDINGS
                  ") or of a picture (" HD_PICTURE_ENDINGS ")",
                  quoted);
    else if (hd_output_is_film(kind) && hd_pattern_has_number(path))
        hd_report(report,
                  "is %s, expected a film without a number (%%d or #) in its name, or pictures "
                  "(" HD_PICTURE_ENDINGS ")",
                  quoted);
    else if (!hd_output_is_film(kind) && strpbrk(path, "%#") != NULL &&
             hd_pattern_check(path, &error) != HD_OK)
        hd_report(report, "cannot be used: %s", error.message);
}

bool hd_check_texture_path(HdSceneReport *report, const char *path) {
    static const char built_in[] = "builtin:";
    char quoted[HD_WORDS_SIZE];
    if (strncmp(path, built_in, strlen(built_in)) != 0 || strcmp(path, HD_BUILTIN_TEXTURE) == 0)
        return true;
    hd_quoted(path, quoted);
    hd_report(report, "is %s, which is unknown, expected \"" HD_BUILTIN_TEXTURE "\" or a file",
              quoted);
    return false;
}
