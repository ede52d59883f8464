/* SPDX-License-Identifier: MIT */
/* Films by segments, made by fake programs: frames of one pixel go into a file as they come, so
   that a film's bytes show its frames and their order. */
#define _XOPEN_SOURCE 700
#include "output/film.h"

#include "fake_programs.h"
#include "system/atomic_file.h"

enum { RATE = 24, FRAMES = 60 }; /* segments of 24, 24 and 12 */

static HdError error;
static int numbers[FRAMES];
static HdFrameList frames = {.frames = numbers, .count = FRAMES};
static HdOutputPlan plan;
static HdSegments segments;
static HdOutput output;

static int begin(void **state) {
    (void)state;
    remove_folder("out");
    hd_known_folders_forget();
    fake_films(4, 0);
    plan = (HdOutputPlan){.style = {{HD_CURVE_SRGB, 8, false}, RATE, false},
                          .has_fingerprint = true,
                          .resumes = true,
                          .fingerprint = 7};
    output = (HdOutput){.name = "out/it's.mkv", .format = &hd_format_mkv, .is_film = true};
    for (int i = 0; i < FRAMES; i++)
        numbers[i] = 100 + i;
    frames.count = FRAMES;
    return mkdir("out", 0777);
}

static void find(void) {
    hd_segments_free(&segments);
    assert_int_equal(hd_segments_find(&segments, &plan, &output, &frames, &error), HD_OK);
}

/* ---- segments ---- */

TEST(segments_are_of_whole_seconds) {
    static const struct {
        int rate, frames, length, count;
    } cases[] = {{1, 25, 24, 2},  {1, 24, 24, 1},  {5, 60, 25, 3},
                 {24, 49, 24, 3}, {23, 60, 46, 2}, {60, 60, 60, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        plan.style.frames_per_second = cases[i].rate;
        frames.count = cases[i].frames;
        find();
        assert_int_equal(segments.count, cases[i].count);
        if (segments.count > 1)
            assert_int_equal(segments.length, cases[i].length);
        int left = frames.count;
        for (int k = 0; k < segments.count; k++) {
            assert_int_equal(k * segments.length, frames.count - left);
            left -= hd_segment_frames(&segments, k);
            assert_true(hd_segment_frames(&segments, k) > 0);
        }
        assert_int_equal(left, 0);
    }
}

/* Compares the path of the second segment. */
static void expect_name(const char *expected, bool is_same) {
    char path[HD_MAX_PATH];
    find();
    assert_int_equal(hd_segment_path(&segments, 1, path, &error), HD_OK);
    assert_true((strcmp(path, expected) == 0) == is_same);
}

TEST(names_depend_on_everything_that_decides_the_bytes) {
    char first[HD_MAX_PATH];
    find();
    assert_int_equal(hd_segment_path(&segments, 1, first, &error), HD_OK);
    assert_memory_equal(first, "out/it's.mkv.part-0001-", 23);
    assert_int_equal(strlen(first), 23 + 16);
    numbers[23]++, numbers[48]++; /* the files beside it */
    expect_name(first, true);
    numbers[47]++;
    expect_name(first, false);
    numbers[47]--;
    plan.fingerprint++;
    expect_name(first, false);
    plan.fingerprint--;
    plan.style.frames_per_second = 12; /* as long */
    expect_name(first, false);
    plan.style.frames_per_second = RATE;
    plan.style.is_ntsc = true;
    expect_name(first, false);
    plan.style.is_ntsc = false;
    output.format = &hd_format_mp4;
    expect_name(first, false);
}

TEST(other_programs_files_stay) {
    static const char *const names[] = {"it's.mkv.part-0-a",
                                        "it's.mkv.part-12345-0123456789abcdef",
                                        "it's.mkv",
                                        "it's.mkv.part-1-xyz",
                                        "it's.mkv.part-1-0123456789abcdef0",
                                        "an it's.mkv.part-1-a",
                                        "it's.mkv.part-a-1",
                                        "it's.mkv.tmp-1-1"};
    assert_int_equal(chdir("out"), 0);
    for (int k = 0; k < 2; k++) { /* with a folder in the film's name, and in the current one */
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            write_bytes(names[i], "x", 1);
        output.name = k == 0 ? "../out/it's.mkv" : "it's.mkv";
        find();
        hd_segments_remove(&segments);
        assert_int_equal(count_entries("."), 6);
    }
    assert_int_equal(chdir(".."), 0);
}

TEST(only_a_continued_run_uses_files_and_only_whole_ones) {
    char path[HD_MAX_PATH];
    find();
    for (int i = 0; i < 3; i++) {
        assert_int_equal(hd_segment_path(&segments, i, path, &error), HD_OK);
        if (i == 1)
            assert_int_equal(mkdir(path, 0777), 0);
        else
            write_bytes(path, "x", i == 0 ? 1 : 0);
    }
    find();
    for (int i = 0; i < FRAMES; i++)
        assert_int_equal(hd_segments_have(&segments, i), i < RATE);
    plan.resumes = false;
    find();
    assert_false(hd_segments_have(&segments, 0));
    plan.has_fingerprint = false; /* then only the film exists */
    find();
    assert_int_equal(segments.count, 1);
    assert_string_equal(segments.film, "out/it's.mkv");
    plan.has_fingerprint = true;
    output = (HdOutput){.name = "out/a.png", .format = &hd_format_png};
    find();
    assert_true(segments.count == 1 && segments.film[0] == '\0');
    /* Names must leave space for those of segments. */
    static char name[HD_MAX_PATH];
    hd_segments_free(&segments);
    memset(name, 'a', sizeof name - 1);
    memcpy(name + sizeof name - 10, "/film.mkv", 10);
    output = (HdOutput){.name = name, .format = &hd_format_mkv, .is_film = true};
    assert_int_equal(hd_segments_find(&segments, &plan, &output, &frames, &error), HD_BAD_INPUT);
    expect_contains(error.message, "is too long for those of its segments");
}

/* ---- films ---- */

static HdFilm *film;

static HdStatus add(int from, int to) {
    HdStatus status = HD_OK;
    for (int i = from; i < to && status == HD_OK; i++) {
        uint8_t pixel[4] = {(uint8_t)i, 1, 2, 3};
        const HdFrame frame = {.width = 1, .height = 1, .rgba = pixel};
        status = hd_film_add(film, i, &frame, &error);
    }
    return status;
}

/* Opens it, as another run would, and adds these frames. */
static void add_in_new_run(int from, int to) {
    find();
    assert_int_equal(hd_film_open(&film, &segments, &plan, 1, 1, &error), HD_OK);
    assert_int_equal(add(from, to), HD_OK);
}

static void abort_it(int left) {
    hd_film_abort(film);
    assert_int_equal(count_entries("out"), left);
}

/* Closes the film, which then has every frame, and no other file remains. */
static void close_it(void) {
    uint8_t bytes[4 * FRAMES + 1];
    assert_int_equal(hd_film_close(film, &error), HD_OK);
    assert_int_equal(count_entries("out"), 1);
    assert_int_equal(read_bytes("out/it's.mkv", bytes, sizeof bytes), 4 * FRAMES);
    for (int i = 0; i < FRAMES; i++)
        assert_int_equal(bytes[4 * i], i);
}

TEST(gaps_are_filled) {
    char path[HD_MAX_PATH];
    add_in_new_run(0, 30);
    abort_it(1); /* another run continues after it */
    add_in_new_run(24, FRAMES);
    for (int i = 0; i < 3; i++)
        assert_true(segments.is_whole[i]); /* after the last frame was taken */
    assert_int_equal(hd_segment_path(&segments, 1, path, &error), HD_OK);
    assert_int_equal(remove(path), 0);
    abort_it(2);
    add_in_new_run(24, 48);
    assert_true(segments.is_whole[1]); /* nothing else is missing */
    abort_it(3);
    add_in_new_run(0, 0); /* all of it exists */
    close_it();
}

TEST(a_segment_that_fails_ends_it) {
    add_in_new_run(0, 25);
    abort_it(1);
    fake_films(4, 1);
    add_in_new_run(24, 24);
    assert_int_equal(add(24, FRAMES), HD_FAILED);
    expect_contains(error.message, "FFmpeg wrote 25 frames to out/it's.mkv.part-0001-");
    assert_false(segments.is_whole[1] || segments.is_whole[2]);
    abort_it(1);
}

TEST(a_failed_join_keeps_the_segments) {
    add_in_new_run(0, FRAMES);
    fake_films(4, -1);
    assert_int_equal(hd_film_close(film, &error), HD_FAILED);
    expect_contains(error.message, "FFmpeg wrote 59 frames to out/it's.mkv, expected 60");
    assert_int_equal(count_entries("out"), 3);
}

GROUP(make_folder_for_programs, remove_test_folder)
EACH(begin, NULL)
