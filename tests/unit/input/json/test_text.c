/* SPDX-License-Identifier: MIT */
#include "input/json/text.h"

#include <stdlib.h>
#include <string.h>

#include "scene_text.h"

static HdError error;

/* As many of each piece as told, one after the other; the caller frees it. */
static char *repeat(const char *begin, const char *piece, int count, const char *end) {
    const size_t size = strlen(piece), before = strlen(begin);
    char *text = malloc(before + size * (size_t)count + strlen(end) + 1);
    assert_non_null(text);
    memcpy(text, begin, before);
    for (int i = 0; i < count; i++)
        memcpy(text + before + size * (size_t)i, piece, size);
    memcpy(text + before + size * (size_t)count, end, strlen(end) + 1);
    return text;
}

static void expect_passes(const char *text) {
    assert_int_equal(hd_json_check_limits(text, strlen(text), "a", &error), HD_OK);
}

static void expect_fails(const char *text, const char *message) {
    assert_int_equal(hd_json_check_limits(text, strlen(text), "a", &error), HD_BAD_INPUT);
    assert_string_equal(error.message, message);
}

TEST(test_values) {
    /* The array, its first element, and one behind each comma. */
    char *most = repeat("[{}", ",[]", (HD_MAX_JSON_VALUES - 3) / 2, "]");
    char *more = repeat("[{},\n0,0", ",[]", (HD_MAX_JSON_VALUES - 3) / 2, "]");
    expect_passes(most);
    expect_fails(more, "a:2:4499996: there are too many values, expected at most 3000000");
    free(most);
    free(more);
}

TEST(test_depth) {
    char *most = repeat("", "[", HD_MAX_JSON_DEPTH, "");
    char *more = repeat("", "{", HD_MAX_JSON_DEPTH + 1, "");
    char *beside = repeat("", "[{}]", 2 * HD_MAX_JSON_DEPTH, "]");
    expect_passes(most);
    expect_passes(beside);
    expect_fails(
        more, "a:1:33: there are too many arrays and objects in each other, expected at most 32");
    free(most);
    free(more);
    free(beside);
}

TEST(test_strings_do_not_count) {
    char *text = repeat("\"\\\\\\\"", "[", HD_MAX_JSON_DEPTH + 1, "\"");
    char *after = repeat("\"\\\\\"", "[", HD_MAX_JSON_DEPTH + 1, "");
    expect_passes(text);
    expect_fails(
        after, "a:1:37: there are too many arrays and objects in each other, expected at most 32");
    free(text);
    free(after);
}

TEST(test_scenes) {
    char *deep = repeat("{\"hedron\": ", "[", HD_MAX_JSON_DEPTH, "");
    expect_refused(deep, NULL, "a.json:1:43: there are too many arrays and objects in each other");
    free(deep);
}

/* What is wrong is told from the begin on, and counted to the end. */
TEST(test_many_problems) {
    char text[100000];
    size_t used =
        (size_t)snprintf(text, sizeof text, "{\"hedron\": 1, \"camera\": {\"eye\": [9, 0, 0]}");
    for (int i = 0; i < 4000; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, ", \"key %d\": 0", i);
    snprintf(text + used, sizeof text - used, ", \"lights\": [%s]}", "{\"position\": 1}");
    const char *message = expect_refused(text, NULL, "a.json: 4001 problems\n");
    expect_contains(message, "[\"key 0\"] is an unknown key, expected ");
    expect_contains(message, "\n  and more of them");
}

static void expect_hint(const char *text, const char *hint) {
    const char *found = hd_json_hint(text, strlen(text));
    if (hint == NULL)
        assert_null(found);
    else
        expect_contains(found != NULL ? found : "(none)", hint);
}

TEST(test_hints) {
    static const char number[] = "a number in JSON", word[] = "true, false or null";
    expect_hint("", NULL);
    expect_hint("[1, \t\n]", "no comma before ']'");
    expect_hint("{\"a\": 1,}", "no comma before '}'");
    expect_hint("]", NULL);
    expect_hint(" }", NULL);
    expect_hint("[1]", NULL);
    expect_hint("{ /", "$comment");
    expect_hint("#", "$comment");
    expect_hint("'", "double quotes");
    expect_hint("NaN", number);
    expect_hint("[-.5", number);
    expect_hint("[inf", number);
    expect_hint("True", word);
    expect_hint("{\"a\": nil", word);
    expect_hint("truely", NULL);
    expect_hint("[\"", NULL);
}
