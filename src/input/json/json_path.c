/* SPDX-License-Identifier: MIT */
#include "input/json/json_path.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "input/json/words.h"

static bool is_plain(const char *key) {
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const size_t length = strlen(key);
    return length > 0 && length <= 64 && strspn(key, letters) == length;
}

size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key) {
    char quoted[HD_WORDS_SIZE];
    const size_t length = strlen(path);
    const size_t room = HD_JSON_PATH_SIZE - length;
    if (is_plain(key)) {
        snprintf(path + length, room, "%s%s", length > 0 ? "." : "", key);
    } else {
        hd_quoted(key, quoted);
        snprintf(path + length, room, "[%s]", quoted);
    }
    return length;
}

size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index) {
    const size_t length = strlen(path);
    snprintf(path + length, HD_JSON_PATH_SIZE - length, "[%zu]", index);
    return length;
}
