/* SPDX-License-Identifier: MIT */
#include "expect.h"
#include "image/file_kind.h"

static void the_ending_tells_the_kind(void **state) {
    (void)state;
    const struct {
        const char *path;
        HdOutputKind kind;
        bool is_film;
    } outputs[] = {{"a.data", HD_OUTPUT_DATA, false},      {"a.png", HD_OUTPUT_PNG, false},
                   {"a/b.PnG", HD_OUTPUT_PNG, false},      {"a.pfm", HD_OUTPUT_PFM, false},
                   {"a.mp4", HD_OUTPUT_MP4, true},         {"out/a.MKV", HD_OUTPUT_MKV, true},
                   {"a.gif", HD_OUTPUT_GIF, true},         {"a.png.data", HD_OUTPUT_DATA, false},
                   {".gif", HD_OUTPUT_GIF, true},          {"a.mp4.png", HD_OUTPUT_PNG, false},
                   {"png", HD_OUTPUT_UNKNOWN, false},      {"apng", HD_OUTPUT_UNKNOWN, false},
                   {"", HD_OUTPUT_UNKNOWN, false},         {"a.mp4/b", HD_OUTPUT_UNKNOWN, false},
                   {"a.png ", HD_OUTPUT_UNKNOWN, false},   {"a.jpg", HD_OUTPUT_UNKNOWN, false},
                   {"a.mp4.tmp", HD_OUTPUT_UNKNOWN, false}};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        assert_int_equal(hd_output_kind(outputs[i].path), outputs[i].kind);
        assert_int_equal(hd_output_is_film(outputs[i].kind), outputs[i].is_film);
    }
}

/* Adds the kinds of a list such as ".mp4, .mkv or .gif"; each is a film, or none is. */
static void note_endings(const char *list, bool are_films, unsigned *seen) {
    char words[64];
    assert_true(strlen(list) < sizeof words);
    memcpy(words, list, strlen(list) + 1);
    for (char *word = strtok(words, ", "); word != NULL; word = strtok(NULL, ", "))
        if (strcmp(word, "or") != 0) {
            const HdOutputKind kind = hd_output_kind(word);
            assert_int_equal(hd_output_is_film(kind), are_films);
            *seen |= 1u << kind;
        }
}

static void the_lists_name_every_kind(void **state) {
    (void)state;
    unsigned seen = 0;
    note_endings(HD_FILM_ENDINGS, true, &seen);
    note_endings(HD_PICTURE_ENDINGS, false, &seen);
    assert_int_equal(seen, (2u << HD_OUTPUT_GIF) - 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ending_tells_the_kind),
        cmocka_unit_test(the_lists_name_every_kind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
