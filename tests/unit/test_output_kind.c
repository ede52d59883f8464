/* SPDX-License-Identifier: MIT */
#include "expect.h"
#include "output_kind.h"

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

/* Each name in the list is of a kind, and no kind is left out. */
static void the_list_names_every_kind(void **state) {
    (void)state;
    char list[200];
    unsigned seen = 0;
    assert_true(strlen(hd_output_endings()) < sizeof list);
    memcpy(list, hd_output_endings(), strlen(hd_output_endings()) + 1);
    for (char *word = strtok(list, ", "); word != NULL; word = strtok(NULL, ", "))
        if (strcmp(word, "or") != 0) {
            HdOutputKind kind = hd_output_kind(word);
            assert_int_equal(strncmp(word, "film.", 5) == 0, hd_output_is_film(kind));
            seen |= 1u << kind;
        }
    assert_int_equal(seen, (2u << HD_OUTPUT_GIF) - 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ending_tells_the_kind),
        cmocka_unit_test(the_list_names_every_kind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
