/* SPDX-License-Identifier: MIT */
/* Films by segments, made by programs in FFmpeg's place: frames of one pixel go into a file as they
   come, so that a film's bytes tell which frames it has, and in which order. */
#define _XOPEN_SOURCE 700
#include "output/film.h"

#include <dirent.h>

#include "system/atomic_file.h"
#include "test_folder.h"

enum { RATE = 24, FRAMES = 60, FIRST = 100 }; /* segments of 24, 24 and 12 */

static HdError error;
static int numbers[FRAMES];
static HdFrameList frames = {.frames = numbers, .count = FRAMES};
static HdOutputPlan plan;
static HdSegments segments;
static const HdOutput output = {.name = "out/film.mkv", .format = &hd_format_mkv, .is_film = true};

static void write_program(const char *path, const char *script) {
    write_bytes(path, script, strlen(script));
    assert_int_equal(chmod(path, 0777), 0);
}

static void write_counter(const char *more) {
    char script[200];
    snprintf(script, sizeof script,
             "#!/bin/sh\nfor last; do :; done\necho $(($(wc -c <\"${last#file:}\") / 4%s))\n",
             more);
    write_program("bin/ffprobe", script);
}

static int begin_group(void **state) {
    const char *path = getenv("PATH");
    char *search = malloc(strlen(path) + 100);
    if (search == NULL || make_test_folder(state) != 0 || mkdir("bin", 0777) != 0)
        return 1;
    sprintf(search, "%s/bin:%s", test_folder, path);
    setenv("PATH", search, 1);
    free(search);
    write_program("bin/ffmpeg",
                  "#!/bin/sh\nfor last; do :; done\nout=${last#file:}\ncase \"$*\" in\n"
                  "*concat*) sed -n \"s/^file 'file:\\(.*\\)'$/\\1/p\" |\n"
                  "while read -r part; do cat \"$part\"; done >\"$out\" ;;\n"
                  "*) cat >\"$out\" ;;\nesac\n");
    for (int i = 0; i < FRAMES; i++)
        numbers[i] = FIRST + i;
    return 0;
}

static int begin(void **state) {
    (void)state;
    remove_folder("out");
    hd_known_folders_forget();
    write_counter("");
    plan = (HdOutputPlan){.style = {{HD_CURVE_SRGB, 8}, RATE},
                          .keeps_films = true,
                          .resumes = true,
                          .fingerprint = 7};
    frames.count = FRAMES;
    return mkdir("out", 0777);
}

static void find(void) {
    assert_int_equal(hd_segments_find(&segments, &plan, &output, &frames, &error), HD_OK);
}

/* ---- segments ---- */

TEST(segments_are_of_whole_seconds) {
    static const struct {
        int rate, frames, length, count;
    } cases[] = {{1, 25, 24, 2},  {1, 24, 24, 1},  {5, 60, 25, 3},
                 {24, 48, 24, 2}, {24, 49, 24, 3}, {25, 25, 25, 1},
                 {25, 26, 25, 2}, {23, 60, 46, 2}, {60, 60, 60, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        plan.style.frames_per_second = cases[i].rate;
        frames.count = cases[i].frames;
        find();
        assert_int_equal(segments.count, cases[i].count);
        if (segments.count > 1)
            assert_int_equal(segments.length, cases[i].length);
        int left = frames.count;
        for (int k = 0; k < segments.count; k++) {
            assert_int_equal(hd_segment_begin(&segments, k), frames.count - left);
            left -= hd_segment_frames(&segments, k);
            assert_true(hd_segment_frames(&segments, k) > 0);
        }
        assert_int_equal(left, 0);
        hd_segments_free(&segments);
    }
}

TEST(what_is_not_kept_has_none) {
    const HdOutput picture = {.name = "out/a.png", .format = &hd_format_png};
    plan.keeps_films = false;
    find();
    assert_int_equal(segments.count, 1);
    assert_string_equal(segments.film, "out/film.mkv");
    assert_false(hd_segments_have(&segments, 0));
    hd_segments_free(&segments);
    plan.keeps_films = true;
    assert_int_equal(hd_segments_find(&segments, &plan, &picture, &frames, &error), HD_OK);
    assert_int_equal(segments.count, 1);
    assert_string_equal(segments.film, "");
    hd_segments_free(&segments);
}

/* Of the second one. */
static void name_of(char path[HD_MAX_PATH]) {
    find();
    assert_int_equal(hd_segment_path(&segments, 1, path, &error), HD_OK);
    hd_segments_free(&segments);
}

TEST(names_tell_what_decides_the_bytes) {
    char first[HD_MAX_PATH], other[HD_MAX_PATH];
    name_of(first);
    assert_memory_equal(first, "out/film.mkv.part-0001-", 23);
    assert_int_equal(strlen(first), 23 + 16);
    name_of(other);
    assert_string_equal(first, other);
    numbers[23]++, numbers[48]++; /* of those beside it */
    name_of(other);
    assert_string_equal(first, other);
    numbers[23]--, numbers[48]--;
    numbers[47]++;
    name_of(other);
    assert_string_not_equal(first, other);
    numbers[47]--;
    plan.fingerprint++;
    name_of(other);
    assert_string_not_equal(first, other);
    plan.fingerprint--;
    plan.style.frames_per_second = 12; /* as long */
    name_of(other);
    assert_string_not_equal(first, other);
}

TEST(what_others_have_there_stays) {
    static const char *const others[] = {"film.mkv",
                                         "film.mkv.part-",
                                         "film.mkv.part-1-xyz",
                                         "film.mkv.part-1-0123456789abcdef0",
                                         "afilm.mkv.part-1-a",
                                         "film.mkv.part-a-1",
                                         "film.mp4.part-1-a",
                                         "film.mkv.tmp-1-1"};
    static const char *const segments_of_others[] = {"film.mkv.part-0-a",
                                                     "film.mkv.part-12345-0123456789abcdef"};
    char path[100];
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        snprintf(path, sizeof path, "out/%s", others[i]);
        write_bytes(path, "x", 1);
    }
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "out/%s", segments_of_others[i]);
        write_bytes(path, "x", 1);
    }
    write_bytes("out/film.mkv.part-0-a.tmp-999999999-1", "x", 1);
    find();
    assert_int_equal(count_entries("out"), 8 + 2); /* what a killed run wrote to is gone */
    hd_segments_remove(&segments);
    assert_int_equal(count_entries("out"), 8);
    hd_segments_free(&segments);
    /* Likewise in the current folder. */
    assert_int_equal(chdir("out"), 0);
    write_bytes("film.mkv.part-0-a", "x", 1);
    const HdOutput here = {.name = "film.mkv", .format = &hd_format_mkv, .is_film = true};
    assert_int_equal(hd_segments_find(&segments, &plan, &here, &frames, &error), HD_OK);
    hd_segments_remove(&segments);
    hd_segments_free(&segments);
    assert_int_equal(count_entries("."), 8);
    assert_int_equal(chdir(".."), 0);
}

TEST(only_whole_files_are_taken_and_only_where_a_run_goes_on) {
    char path[HD_MAX_PATH];
    find();
    for (int i = 0; i < 3; i++) {
        assert_int_equal(hd_segment_path(&segments, i, path, &error), HD_OK);
        if (i == 1)
            assert_int_equal(mkdir(path, 0777), 0);
        else
            write_bytes(path, "x", i == 0 ? 1 : 0);
    }
    hd_segments_free(&segments);
    find();
    for (int i = 0; i < FRAMES; i++)
        assert_int_equal(hd_segments_have(&segments, i), i < RATE);
    hd_segments_free(&segments);
    plan.resumes = false;
    find();
    assert_false(hd_segments_have(&segments, 0));
    hd_segments_free(&segments);
}

/* ---- films ---- */

static HdFilm *film;

static void open_it(void) {
    find();
    assert_int_equal(hd_film_open(&film, &segments, 1, 1, &plan.style, HD_FLEETING, &error), HD_OK);
}

static HdStatus add(int from, int to) {
    HdStatus status = HD_OK;
    for (int i = from; i < to && status == HD_OK; i++) {
        uint8_t pixel[4] = {(uint8_t)i, 1, 2, 3};
        const HdFrame frame = {.width = 1, .height = 1, .rgba = pixel};
        status = hd_film_add(film, i, &frame, &error);
    }
    return status;
}

static void abort_it(void) {
    hd_film_abort(film);
    hd_segments_free(&segments);
}

/* The film is there, with every frame, and nothing else is. */
static void close_it(void) {
    uint8_t bytes[4 * FRAMES + 1];
    assert_int_equal(hd_film_close(film, &error), HD_OK);
    hd_segments_free(&segments);
    assert_int_equal(count_entries("out"), 1);
    FILE *file = fopen("out/film.mkv", "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), 4 * FRAMES);
    fclose(file);
    for (int i = 0; i < FRAMES; i++)
        assert_int_equal(bytes[4 * i], i);
}

TEST(segments_become_a_film) {
    open_it();
    assert_int_equal(add(0, FRAMES), HD_OK);
    for (int i = 0; i < 3; i++)
        assert_true(segments.is_whole[i]); /* once the last frame was taken */
    assert_int_equal(count_entries("out"), 3);
    close_it();
}

TEST(without_segments_it_is_made_in_one_go) {
    plan.keeps_films = false;
    open_it();
    assert_int_equal(add(0, FRAMES), HD_OK);
    close_it();
}

TEST(a_run_goes_on_behind_whole_segments) {
    open_it();
    assert_int_equal(add(0, 30), HD_OK);
    abort_it();
    assert_int_equal(count_entries("out"), 1);
    open_it();
    assert_true(hd_segments_have(&segments, 23));
    assert_false(hd_segments_have(&segments, 24));
    assert_int_equal(add(24, 48), HD_OK);
    abort_it();
    assert_int_equal(count_entries("out"), 2);
    open_it();
    assert_int_equal(add(48, FRAMES), HD_OK);
    close_it();
}

TEST(gaps_are_filled) {
    char path[HD_MAX_PATH];
    open_it();
    assert_int_equal(add(0, FRAMES), HD_OK);
    assert_int_equal(hd_segment_path(&segments, 1, path, &error), HD_OK);
    assert_int_equal(remove(path), 0);
    abort_it();
    open_it();
    assert_int_equal(add(24, 48), HD_OK);
    assert_true(segments.is_whole[1]); /* for nothing else is missing */
    abort_it();
    open_it(); /* all is there */
    close_it();
}

TEST(a_segment_that_fails_ends_it) {
    open_it();
    assert_int_equal(add(0, 24), HD_OK);
    assert_int_equal(add(24, 25), HD_OK);
    hd_film_abort(film);
    assert_true(segments.is_whole[0]);
    hd_segments_free(&segments);
    write_counter(" + 1");
    open_it();
    assert_int_equal(add(24, FRAMES), HD_FAILED);
    expect_contains(error.message, "FFmpeg wrote 25 frames to out/film.mkv.part-0001-");
    assert_false(segments.is_whole[1] || segments.is_whole[2]);
    abort_it();
    assert_int_equal(count_entries("out"), 1);
}

TEST(what_cannot_be_joined_keeps_its_segments) {
    open_it();
    assert_int_equal(add(0, FRAMES), HD_OK);
    write_counter(" - 1");
    assert_int_equal(hd_film_close(film, &error), HD_FAILED);
    expect_contains(error.message, "FFmpeg wrote 59 frames to out/film.mkv, expected 60");
    hd_segments_free(&segments);
    assert_int_equal(count_entries("out"), 3);
}

TEST(names_that_are_too_long_are_refused) {
    static char name[HD_MAX_PATH];
    const HdOutput longest = {.name = name, .format = &hd_format_mkv, .is_film = true};
    memset(name, 'a', sizeof name - 1);
    memcpy(name + sizeof name - 10, "/film.mkv", 10);
    assert_int_equal(hd_segments_find(&segments, &plan, &longest, &frames, &error), HD_BAD_INPUT);
    expect_contains(error.message, "is too long for those of its segments");
    hd_segments_free(&segments);
}

GROUP(begin_group, remove_test_folder)
EACH(begin, NULL)
