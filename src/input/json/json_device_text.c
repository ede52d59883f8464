/* SPDX-License-Identifier: MIT */
#include "input/json/json_device_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

json_t *hd_json_device_text(const char *bytes) {
    json_t *text = json_string(bytes); /* refuses what is no UTF-8 */
    if (text != NULL)
        return text;
    size_t length = strlen(bytes);
    char *ascii = malloc(length + 1);
    if (ascii == NULL)
        return NULL;
    for (size_t i = 0; i <= length; i++)
        ascii[i] = (unsigned char)bytes[i] < 128 ? bytes[i] : '?';
    text = json_string(ascii);
    free(ascii);
    return text;
}

json_t *hd_json_text_or_null(const char *bytes) {
    return bytes != NULL && bytes[0] != '\0' ? hd_json_device_text(bytes) : json_null();
}

json_t *hd_json_count_or_null(int count) {
    return count > 0 ? json_integer(count) : json_null();
}

json_t *hd_json_append(json_t *list, json_t *item) {
    if (json_array_append_new(list, item) == 0)
        return list;
    json_decref(list);
    return NULL;
}

HdStatus hd_json_print(json_t *root, const char *what, HdError *error) {
    if (root == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for %s", what);
    int failed = json_dumpf(root, stdout, JSON_INDENT(2));
    json_decref(root);
    if (failed || putchar('\n') == EOF)
        return hd_fail(error, HD_FAILED, "cannot write to standard output");
    return HD_OK;
}
