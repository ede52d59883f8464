/* SPDX-License-Identifier: MIT */
#include "input/json.h"

#include <ctype.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

HdStatus hd_json_fail_at(const char *text, size_t position, const char *name, const char *what,
                         HdError *error) {
    int line = 1, column = 1;
    for (size_t i = 0; i < position; i++) {
        column = text[i] == '\n' ? 1 : column + 1;
        line += text[i] == '\n';
    }
    return hd_fail(error, HD_BAD_INPUT, "%s:%d:%d: %s", name, line, column, what);
}

HdStatus hd_json_check_count(const char *text, size_t size, const char *name, HdError *error) {
    char what[96];
    int values = 1;
    for (size_t i = 0; i < size; i++) {
        values += text[i] == '[' || text[i] == '{' || text[i] == ',';
        if (values <= HD_MAX_JSON_VALUES)
            continue;
        snprintf(what, sizeof what, "there are too many values, expected at most %d",
                 (int)HD_MAX_JSON_VALUES);
        return hd_json_fail_at(text, i, name, what, error);
    }
    return HD_OK;
}

static bool is_space(char c) {
    return c != '\0' && strchr(" \t\r\n", c) != NULL;
}

static bool has_comma_before(const char *text, size_t end) {
    while (end > 0 && is_space(text[end - 1]))
        end--;
    return end > 0 && text[end - 1] == ',';
}

/* Returns a hint for the word or number that ends at `end`. */
static const char *hint_of_word(const char *text, size_t end) {
    static const char *const words[] = {"true", "false", "null", "none", "nil"};
    static const char *const numbers[] = {"nan", "inf", "infinity"};
    char word[16] = "";
    size_t start = end;
    while (start > 0 && (isalnum((unsigned char)text[start - 1]) || strchr("+-.", text[start - 1])))
        start--;
    for (size_t i = 0; i + 1 < sizeof word && start + i < end; i++)
        word[i] = (char)tolower((unsigned char)text[start + i]);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(word, words[i]) == 0)
            return "JSON says true, false or null";
    bool is_number = word[0] != '\0' && strchr("+-.0123456789", word[0]) != NULL;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        is_number |= strcmp(word, numbers[i]) == 0;
    return is_number ? "a number in JSON looks like 0.5, -2 or 1e3, and none is NaN or infinite"
                     : NULL;
}

const char *hd_json_hint(const char *text, size_t position) {
    if (position == 0)
        return NULL;
    const char last = text[position - 1];
    if (last == '}' && has_comma_before(text, position - 1))
        return "JSON has no comma before '}'";
    if (last == ']' && has_comma_before(text, position - 1))
        return "JSON has no comma before ']'";
    if (last == '/' || last == '#')
        return "JSON has no comments, but an object may have \"$comment\": \"...\"";
    if (last == '\'')
        return "use double quotes";
    return hint_of_word(text, position);
}

/* Words */

void hd_quoted(const char *text, char out[HD_WORDS_SIZE]) {
    char start[108];
    const size_t taken = hd_escape(text, start, sizeof start);
    snprintf(out, HD_WORDS_SIZE, "\"%s%s\"", start, text[taken] != '\0' ? "..." : "");
}

void hd_json_list_keys(const json_t *object, char out[HD_KEYS_SIZE]) {
    enum { ENOUGH = 300 }; /* bytes; another name and the rest fit behind them */
    const char *key;
    json_t *ignored;
    size_t left = json_object_size(object);
    out[0] = '\0';
    json_object_foreach((json_t *)object, key, ignored) {
        char name[HD_WORDS_SIZE];
        if (strlen(out) > ENOUGH)
            break;
        hd_quoted(key, name);
        hd_add_text(out, HD_KEYS_SIZE, ", ", "%s", name);
        left--;
    }
    if (left > 0)
        hd_add_text(out, HD_KEYS_SIZE, " ", "and %zu more", left);
}

void hd_json_words(const json_t *value, char out[HD_WORDS_SIZE]) {
    const size_t count = json_array_size(value);
    char text[HD_WORDS_SIZE];
    if (json_is_string(value)) {
        hd_quoted(json_string_value(value), text);
        snprintf(out, HD_WORDS_SIZE, "a string, %.120s", text);
    } else if (json_is_number(value)) {
        hd_short_number(json_number_value(value), out);
    } else if (json_is_array(value)) {
        snprintf(out, HD_WORDS_SIZE, "an array of %zu element%s", count, count == 1 ? "" : "s");
    } else {
        snprintf(out, HD_WORDS_SIZE, "%s",
                 json_is_object(value)  ? "an object"
                 : json_is_true(value)  ? "true"
                 : json_is_false(value) ? "false"
                                        : "null");
    }
}

static bool is_plain(const char *key) {
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const size_t length = strlen(key);
    return length > 0 && length <= 64 && strspn(key, letters) == length;
}

size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key) {
    char quoted[HD_WORDS_SIZE];
    const size_t length = strlen(path);
    const size_t capacity = HD_JSON_PATH_SIZE - length;
    if (is_plain(key)) {
        snprintf(path + length, capacity, "%s%s", length > 0 ? "." : "", key);
    } else {
        hd_quoted(key, quoted);
        snprintf(path + length, capacity, "[%s]", quoted);
    }
    return length;
}

size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index) {
    const size_t length = strlen(path);
    snprintf(path + length, HD_JSON_PATH_SIZE - length, "[%zu]", index);
    return length;
}

/* Memory */

static atomic_bool failed;

static void *allocate(size_t bytes) {
    void *memory = malloc(bytes);
    if (memory == NULL)
        atomic_store(&failed, true);
    return memory;
}

void hd_json_memory_watch(void) {
    atomic_store(&failed, false);
    json_set_alloc_funcs(allocate, free);
}

bool hd_json_memory_failed(void) {
    return atomic_load(&failed);
}

/* ---- output of commands ---- */

json_t *hd_json_device_text(const char *bytes) {
    json_t *text = json_string(bytes); /* rejects invalid UTF-8 */
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
        return HD_NO_ROOM(error, "%s", what);
    int lost = json_dumpf(root, stdout, JSON_INDENT(2));
    json_decref(root);
    if (lost || putchar('\n') == EOF)
        return hd_fail(error, HD_FAILED, "cannot write to standard output");
    return HD_OK;
}
