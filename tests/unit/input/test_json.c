/* SPDX-License-Identifier: MIT */
#include "input/json.h"

#include "scene_text.h"

static HdError error;

/* Parses `begin`, so many times the piece, and `end`; succeeds if the message is NULL. */
static void check(const char *begin, const char *piece, int count, const char *end,
                  const char *message) {
    const size_t size = strlen(piece), before = strlen(begin);
    char *text = malloc(before + size * (size_t)count + strlen(end) + 1);
    assert_non_null(text);
    strcpy(text, begin);
    for (int i = 0; i < count; i++)
        memcpy(text + before + size * (size_t)i, piece, size);
    strcpy(text + before + size * (size_t)count, end);
    const HdStatus status = hd_json_check_count(text, strlen(text), "a", &error);
    assert_int_equal(status, message == NULL ? HD_OK : HD_BAD_INPUT);
    if (message != NULL)
        assert_string_equal(error.message, message);
    free(text);
}

TEST(test_values) {
    /* The array, its first element, and one after each comma. */
    const int count = (HD_MAX_JSON_VALUES - 3) / 2;
    check("[{}", ",[]", count, "]", NULL);
    check("[{},\n0,0", ",[]", count, "]",
          "a:2:4499996: there are too many values, expected at most 3000000");
}

/* The parser's own limit. */
TEST(test_depth) {
    char text[3001] = "";
    memset(text, '[', sizeof text - 1);
    expect_refused(text, NULL, "a.json:1:2049: maximum parsing depth reached near '['");
}

/* Errors are reported from the begin on, and counted to the end. */
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

TEST(test_hints) {
    static const char number[] = "a number in JSON", word[] = "true, false or null";
    static const char *const cases[][2] = {{"", NULL},
                                           {" }", NULL},
                                           {"[1]", NULL},
                                           {"truely", NULL},
                                           {"[1, \t\n]", "no comma before ']'"},
                                           {"{\"a\": 1,}", "no comma before '}'"},
                                           {"#", "$comment"},
                                           {"'", "double quotes"},
                                           {"[inf", number},
                                           {"-Infinity", number},
                                           {"0x10", number},
                                           {"1.", number},
                                           {"True", word},
                                           {"{\"a\": nil", word},
                                           {"FALSE", word}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *hint = hd_json_hint(cases[i][0], strlen(cases[i][0]));
        if ((hint == NULL) != (cases[i][1] == NULL))
            fail_msg("'%s': %s", cases[i][0], hint != NULL ? hint : "no hint");
        if (hint != NULL)
            expect_contains(hint, cases[i][1]);
    }
}
