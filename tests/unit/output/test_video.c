/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <sys/wait.h>

#include "image/formats.h"
#include "output/video.h"
#include "system/atomic_file.h"
#include "test_folder.h"

static char *old_path;

static int set_up_group(void **state) {
    const char *path = getenv("PATH");
    old_path = strdup(path == NULL ? "/usr/bin:/bin" : path);
    return old_path == NULL || make_test_folder(state) != 0;
}

static int tear_down_group(void **state) {
    free(old_path);
    return remove_test_folder(state);
}

/* Every test begins with an empty folder "out" and the true PATH. */
static int set_up(void **state) {
    (void)state;
    setenv("PATH", old_path, 1);
    remove_folder("out");
    remove_folder("bin");
    hd_known_folders_forget();
    return mkdir("out", 0777) != 0 || mkdir("bin", 0777) != 0;
}

/* No test may leave a process or a descriptor behind. */
static int tear_down(void **state) {
    (void)state;
    static int descriptors = 0;
    setenv("PATH", old_path, 1);
    if (waitpid(-1, NULL, WNOHANG) != -1 || errno != ECHILD) {
        fprintf(stderr, "a process is left\n");
        return 1;
    }
    if (access("/proc/self/fd", R_OK) != 0)
        return 0;
    int open_now = count_entries("/proc/self/fd");
    if (descriptors == 0)
        descriptors = open_now;
    if (descriptors != open_now)
        fprintf(stderr, "%d descriptors are open, expected %d\n", open_now, descriptors);
    return descriptors != open_now;
}

static void need_ffmpeg(void) {
    if (system("ffmpeg -version >/dev/null 2>&1 && ffprobe -version >/dev/null 2>&1") != 0)
        skip();
}

static void write_file(const char *path, const char *text, mode_t mode) {
    write_bytes(path, text, strlen(text));
    assert_int_equal(chmod(path, mode), 0);
}

/* Puts a program first in PATH. $REAL is the PATH without it. */
static void fake(const char *name, const char *script) {
    char text[1000], path[100];
    char *search = malloc(strlen(test_folder) + strlen(old_path) + 10);
    assert_non_null(search);
    snprintf(text, sizeof text, "#!/bin/sh\n%s\n", script);
    snprintf(path, sizeof path, "bin/%s", name);
    write_file(path, text, 0777);
    sprintf(search, "%s/bin:%s", test_folder, old_path);
    setenv("PATH", search, 1);
    setenv("REAL", old_path, 1);
    free(search);
}

static HdFrame make_frame(int width, int height, const uint8_t colour[4]) {
    HdError error = {0};
    HdFrame frame = {.width = width, .height = height};
    assert_int_equal(hd_frame_add_rgba(&frame, &error), HD_OK);
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        memcpy(frame.rgba + i * 4, colour, 4);
    return frame;
}

static const HdOutputStyle STYLE = {{HD_CURVE_SRGB, 8}, 25};
static const HdOutputStyle LINEAR = {{HD_CURVE_LINEAR, 8}, 25};

static const uint8_t RED[4] = {255, 0, 0, 255};

static void open_film(HdVideo **video, int width, int height) {
    HdError error = {0};
    const char *path = "out/film.mp4";
    assert_int_equal(hd_video_open(video, path, hd_format_of(path), width, height, &STYLE, &error),
                     HD_OK);
}

/* Makes a film and ends it as a caller would, whatever happens. */
static HdStatus make_film(const char *path, int width, int height, int frames, HdError *error) {
    HdVideo *video = NULL;
    HdStatus status = hd_video_open(&video, path, hd_format_of(path), width, height, &STYLE, error);
    assert_true((status == HD_OK) == (video != NULL));
    if (status != HD_OK)
        return status;
    HdFrame frame = make_frame(width, height, RED);
    for (int i = 0; i < frames && status == HD_OK; i++)
        status = hd_video_add(video, &frame, error);
    hd_frame_free(&frame);
    if (status == HD_OK)
        return hd_video_close(video, HD_FLEETING, error);
    hd_video_abort(video);
    return status;
}

/* The film must fail, say why, and leave no file. */
static void check_failure(int width, int height, int frames, HdStatus expected, const char *part) {
    HdError error = {0};
    assert_int_equal(make_film("out/film.mp4", width, height, frames, &error), expected);
    assert_int_equal(error.status, expected);
    expect_contains(error.message, part);
    assert_int_equal(count_entries("out"), 0);
}

static void check_output(const char *command, const char *expected) {
    char text[1000] = "";
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t size = fread(text, 1, sizeof text - 1, pipe);
    text[size] = '\0';
    assert_int_equal(pclose(pipe), 0);
    assert_string_equal(text, expected);
}

TEST(films_have_all_frames) {
    HdError error = {0};
    need_ffmpeg();
    assert_int_equal(make_film("out/new/film.mp4", 64, 48, 7, &error), HD_OK);
    assert_int_equal(count_entries("out/new"), 1);
    check_output("ffprobe -v error -count_packets -show_entries stream=codec_name,width,height,"
                 "pix_fmt,color_range,color_space,color_transfer,color_primaries,r_frame_rate,"
                 "nb_read_packets -of default=nk=1:nw=1 out/new/film.mp4",
                 "h264\n64\n48\nyuv420p\ntv\nbt709\nbt709\nbt709\n25/1\n7\n");
}

TEST(odd_sizes_are_padded) {
    HdError error = {0};
    need_ffmpeg();
    assert_int_equal(make_film("out/film.mp4", 33, 17, 2, &error), HD_OK);
    check_output("ffprobe -v error -show_entries stream=width,height -of csv=p=0 out/film.mp4",
                 "34,18\n");
    assert_int_equal(make_film("out/tiny.mp4", 1, 1, 1, &error), HD_OK);
    check_output("ffprobe -v error -show_entries stream=width,height -of csv=p=0 out/tiny.mp4",
                 "2,2\n");
}

/* Makes a film of these frames, which are of one size. */
static void film_frames(const char *path, const HdFrame *frames, int count,
                        const HdOutputStyle *style) {
    HdError error = {0};
    HdVideo *video = NULL;
    HdStatus status = hd_video_open(&video, path, hd_format_of(path), frames[0].width,
                                    frames[0].height, style, &error);
    for (int i = 0; i < count && status == HD_OK; i++)
        status = hd_video_add(video, &frames[i], &error);
    if (status == HD_OK)
        status = hd_video_close(video, HD_FLEETING, &error);
    if (status != HD_OK)
        fail_msg("%s", error.message);
}

/* Decodes a film into bytes of this pixel format; all of them must be there. */
static void decode_film(const char *path, const char *format, uint8_t *bytes, size_t size) {
    char command[200];
    uint8_t more;
    snprintf(command, sizeof command, "ffmpeg -nostdin -v error -i %s -f rawvideo -pix_fmt %s -",
             path, format);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    assert_int_equal(fread(bytes, 1, size, pipe), size);
    assert_int_equal(fread(&more, 1, 1, pipe), 0);
    assert_int_equal(pclose(pipe), 0);
}

enum { FLAT_COLOURS = 8, FLAT_SIDE = 64, FLAT_PIXELS = FLAT_SIDE * FLAT_SIDE };
static const uint8_t flat_colours[FLAT_COLOURS][4] = {
    {255, 0, 0, 255}, {0, 255, 0, 255},    {0, 0, 255, 255},  {255, 255, 255, 255},
    {0, 0, 0, 255},   {200, 100, 50, 255}, {30, 60, 90, 255}, {128, 128, 128, 255}};

/* A frame for each colour. */
static void film_colours(const char *path) {
    HdFrame frames[FLAT_COLOURS];
    for (int i = 0; i < FLAT_COLOURS; i++)
        frames[i] = make_frame(FLAT_SIDE, FLAT_SIDE, flat_colours[i]);
    film_frames(path, frames, FLAT_COLOURS, &STYLE);
    for (int i = 0; i < FLAT_COLOURS; i++)
        hd_frame_free(&frames[i]);
}

/* ITU-R BT.709 with luma from 16 to 235 and chroma from 16 to 240. BT.601 gives red a luma of 81
   instead of 63, and the full range gives white one of 255. */
TEST(colours_follow_bt709) {
    enum { FRAME = FLAT_PIXELS * 3 / 2, QUARTER = FLAT_PIXELS / 4 };
    static uint8_t planes[FLAT_COLOURS * FRAME];
    need_ffmpeg();
    film_colours("out/film.mp4");
    decode_film("out/film.mp4", "yuv420p", planes, sizeof planes);
    for (int i = 0; i < FLAT_COLOURS; i++) {
        const uint8_t *rgb = flat_colours[i], *frame = planes + i * FRAME;
        const double luma = (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) / 255.0;
        const double blue = (rgb[2] / 255.0 - luma) / 1.8556,
                     red = (rgb[0] / 255.0 - luma) / 1.5748;
        expect_near(frame[FLAT_PIXELS / 2 + 32], 16.0 + 219.0 * luma, 1.5);
        expect_near(frame[FLAT_PIXELS + QUARTER / 2 + 16], 128.0 + 224.0 * blue, 1.5);
        expect_near(frame[FLAT_PIXELS + QUARTER * 3 / 2 + 16], 128.0 + 224.0 * red, 1.5);
    }
}

/* A player that heeds the tags shows what was given. */
TEST(colours_come_back) {
    const char *const paths[] = {"out/film.mp4", "out/film.mkv", "out/film.gif"};
    const double tolerances[] = {4, 0, 2};
    static uint8_t rgb[FLAT_COLOURS * FLAT_PIXELS * 3];
    need_ffmpeg();
    for (int f = 0; f < 3; f++) {
        film_colours(paths[f]);
        decode_film(paths[f], "rgb24", rgb, sizeof rgb);
        for (int i = 0; i < FLAT_COLOURS; i++)
            for (int c = 0; c < 3; c++)
                expect_near(rgb[(i * FLAT_PIXELS + FLAT_PIXELS / 2 + 32) * 3 + c],
                            flat_colours[i][c], tolerances[f]);
    }
}

enum { NOISE_FRAMES = 5 };

static void make_noise(HdFrame frames[NOISE_FRAMES], int width, int height) {
    uint32_t seed = 1;
    for (int i = 0; i < NOISE_FRAMES; i++) {
        frames[i] = make_frame(width, height, RED);
        for (size_t j = 0; j < (size_t)width * (size_t)height * 4; j++)
            if (j % 4 != 3)
                frames[i].rgba[j] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
    }
}

static void free_frames(HdFrame frames[NOISE_FRAMES]) {
    for (int i = 0; i < NOISE_FRAMES; i++)
        hd_frame_free(&frames[i]);
}

TEST(mkv_files_are_tagged) {
    HdError error = {0};
    need_ffmpeg();
    assert_int_equal(make_film("out/film.MKV", 33, 17, 7, &error), HD_OK);
    check_output("ffprobe -v error -count_packets -show_entries stream=codec_name,width,height,"
                 "color_range,color_space,color_transfer,color_primaries,r_frame_rate,"
                 "nb_read_packets -of default=nk=1:nw=1 out/film.MKV",
                 "ffv1\n33\n17\npc\ngbr\niec61966-2-1\nbt709\n25/1\n7\n");
}

TEST(films_say_that_they_are_linear) {
    need_ffmpeg();
    HdFrame frame = make_frame(64, 64, RED);
    film_frames("out/film.mp4", &frame, 1, &LINEAR);
    film_frames("out/film.mkv", &frame, 1, &LINEAR);
    check_output("ffprobe -v error -show_entries stream=color_range,color_space,color_transfer,"
                 "color_primaries -of default=nk=1:nw=1 out/film.mp4",
                 "tv\nbt709\nlinear\nbt709\n");
    check_output("ffprobe -v error -show_entries stream=color_range,color_space,color_transfer,"
                 "color_primaries -of default=nk=1:nw=1 out/film.mkv",
                 "pc\ngbr\nlinear\nbt709\n");
    hd_frame_free(&frame);
}

TEST(mkv_loses_nothing) {
    const int sizes[][2] = {{1, 1}, {1, 100}, {4, 4}, {33, 17}, {63, 200}, {64, 64}, {101, 67}};
    static uint8_t rgba[NOISE_FRAMES * 63 * 200 * 4];
    need_ffmpeg();
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        HdFrame frames[NOISE_FRAMES];
        size_t size = (size_t)(sizes[s][0] * sizes[s][1] * 4);
        make_noise(frames, sizes[s][0], sizes[s][1]);
        film_frames("out/film.mkv", frames, NOISE_FRAMES, &STYLE);
        decode_film("out/film.mkv", "rgba", rgba, NOISE_FRAMES * size);
        for (size_t i = 0; i < NOISE_FRAMES; i++)
            assert_memory_equal(rgba + i * size, frames[i].rgba, size);
        free_frames(frames);
    }
}

TEST(gif_repeats_for_ever) {
    unsigned char bytes[900];
    const char loop[] = "\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0";
    HdError error = {0};
    bool found = false;
    need_ffmpeg();
    assert_int_equal(make_film("out/film.gif", 33, 17, 3, &error), HD_OK);
    check_output("ffprobe -v error -count_packets -show_entries stream=codec_name,width,height,"
                 "nb_read_packets -of csv=p=0 out/film.gif",
                 "gif,33,17,3\n");
    FILE *file = fopen("out/film.gif", "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (size_t i = 0; i + sizeof loop <= size; i++)
        found |= memcmp(bytes + i, loop, sizeof loop) == 0;
    assert_true(found);
    assert_int_equal(make_film("out/tiny.gif", 1, 1, 1, &error), HD_OK);
    assert_int_equal(count_entries("out"), 2);
}

/* The format has centiseconds: the whole is as long as it should be, and no frame is lost. */
TEST(gif_keeps_the_time) {
    const struct {
        int rate;
        const char *durations;
    } films[] = {{25, "4\n4\n4\n4\n4\n"}, {30, "3\n4\n3\n3\n3\n"}, {100, "1\n1\n1\n1\n1\n"}};
    HdFrame frames[NOISE_FRAMES];
    need_ffmpeg();
    make_noise(frames, 33, 17);
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        const HdOutputStyle style = {STYLE.picture, films[i].rate};
        film_frames("out/film.gif", frames, NOISE_FRAMES, &style);
        check_output("ffprobe -v error -min_delay 0 -show_entries packet=duration -of csv=p=0 "
                     "out/film.gif",
                     films[i].durations);
    }
    free_frames(frames);
}

/* A frame with more colours than a palette. */
TEST(gif_is_close_to_the_frame) {
    enum { SIDE = 128 };
    HdFrame frame = make_frame(SIDE, SIDE, RED);
    static uint8_t rgba[SIDE * SIDE * 4];
    double sum = 0.0;
    need_ffmpeg();
    for (int i = 0; i < SIDE * SIDE; i++) {
        frame.rgba[4 * i] = (uint8_t)(i % SIDE);
        frame.rgba[4 * i + 1] = (uint8_t)(i / SIDE);
        frame.rgba[4 * i + 2] = 60;
    }
    film_frames("out/film.gif", &frame, 1, &STYLE);
    decode_film("out/film.gif", "rgba", rgba, sizeof rgba);
    for (int i = 0; i < SIDE * SIDE * 4; i++)
        sum += abs(rgba[i] - frame.rgba[i]);
    expect_near(sum / (SIDE * SIDE * 3), 0.0, 4.0);
    hd_frame_free(&frame);
}

TEST(names_reach_ffmpeg_unchanged) {
    HdError error = {0};
    need_ffmpeg();
    assert_int_equal(make_film("out/a 'b' $c: %d; \"d\".mp4", 16, 16, 1, &error), HD_OK);
    assert_int_equal(access("out/a 'b' $c: %d; \"d\".mp4", F_OK), 0);
    assert_int_equal(chdir("out"), 0);
    HdStatus first = make_film("-y.mkv", 16, 16, 1, &error);
    HdStatus second = make_film("http:x.gif", 16, 16, 1, &error);
    assert_int_equal(chdir(".."), 0);
    assert_int_equal(first, HD_OK);
    assert_int_equal(second, HD_OK);
    assert_int_equal(count_entries("out"), 3);
}

/* Later ones would have to fit into the first ones' room if nobody read them. */
TEST(large_films_pass_through) {
    HdError error = {0};
    need_ffmpeg();
    assert_int_equal(make_film("out/film.mp4", 640, 480, 30, &error), HD_OK);
    assert_int_equal(count_entries("out"), 1);
}

TEST(films_without_frames_fail) {
    need_ffmpeg();
    check_failure(16, 16, 0, HD_FAILED, "no frames");
}

TEST(aborted_films_leave_nothing) {
    HdError error = {0};
    HdVideo *video;
    HdFrame frame = make_frame(640, 480, RED);
    need_ffmpeg();
    write_file("out/film.mp4", "older", 0666);
    open_film(&video, 640, 480);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_OK);
    assert_int_equal(count_entries("out"), 2);
    hd_video_abort(video);
    assert_int_equal(count_entries("out"), 1);
    check_output("cat out/film.mp4", "older");
    hd_frame_free(&frame);
}

TEST(frames_of_another_size_are_refused) {
    HdError error = {0};
    HdVideo *video;
    HdFrame right = make_frame(32, 16, RED), wrong = make_frame(16, 32, RED);
    need_ffmpeg();
    open_film(&video, 32, 16);
    assert_int_equal(hd_video_add(video, &wrong, &error), HD_BAD_INPUT);
    expect_contains(error.message, "16 x 32 pixels");
    assert_int_equal(hd_video_add(video, &right, &error), HD_OK);
    assert_int_equal(hd_video_close(video, HD_FLEETING, &error), HD_OK);
    hd_frame_free(&right);
    hd_frame_free(&wrong);
}

TEST(wrong_settings_are_refused) {
    HdError error = {0};
    HdVideo *video;
    const HdOutputStyle none = {STYLE.picture, 0};
    check_failure(0, 16, 1, HD_BAD_INPUT, "0 x 16 pixels, expected 1..65535");
    check_failure(16, 65536, 1, HD_BAD_INPUT, "16 x 65536 pixels, expected 1..65535");
    assert_int_equal(
        hd_video_open(&video, "out/a.mp4", hd_format_of("out/a.mp4"), 16, 16, &none, &error),
        HD_BAD_INPUT);
    expect_contains(error.message, "0 frames a second");
    assert_int_equal(
        hd_video_open(&video, "out/a.png", hd_format_of("out/a.png"), 16, 16, &STYLE, &error),
        HD_BAD_INPUT);
    expect_contains(error.message, "out/a.png has another ending, expected .mp4, .mkv or .gif");
    assert_int_equal(
        hd_video_open(&video, "out/a.gif", hd_format_of("out/a.gif"), 16, 16, &LINEAR, &error),
        HD_BAD_INPUT);
    expect_contains(error.message, "out/a.gif cannot be linear, for a GIF has no way to say so");
}

TEST(missing_programs_are_unavailable) {
    char only_bin[100];
    snprintf(only_bin, sizeof only_bin, "/nonexistent::%s/bin", test_folder);
    setenv("PATH", only_bin, 1);
    check_failure(16, 16, 1, HD_UNAVAILABLE, "\"ffmpeg\"");
    write_file("bin/ffmpeg", "#!/bin/sh\nexit 0\n", 0777);
    check_failure(16, 16, 1, HD_UNAVAILABLE, "\"ffprobe\"");
    mkdir("bin/ffprobe", 0777);
    check_failure(16, 16, 1, HD_UNAVAILABLE, "\"ffprobe\"");
    rmdir("bin/ffprobe");
    write_file("bin/ffprobe", "#!/bin/sh\nexit 0\n", 0777);
    write_file("bin/ffmpeg", "#!/nonexistent/interpreter\n", 0777);
    check_failure(16, 16, 1, HD_UNAVAILABLE, "cannot start");
    setenv("PATH", ":/nonexistent", 1); /* the empty item is the current folder */
    assert_int_equal(chdir("bin"), 0);
    hd_known_folders_forget(); /* their names are another folder's now */
    check_failure(16, 16, 1, HD_UNAVAILABLE, "cannot start ./ffmpeg");
    assert_int_equal(chdir(".."), 0);
    hd_known_folders_forget();
    setenv("PATH", only_bin, 1);
    write_file("bin/ffmpeg", "#!/bin/sh\nexit 0\n", 0666);
    if (geteuid() != 0)
        check_failure(16, 16, 1, HD_UNAVAILABLE, "\"ffmpeg\"");
}

TEST(an_early_end_is_an_error_not_a_signal) {
    fake("ffprobe", "exit 0");
    fake("ffmpeg", "echo first complaint >&2; echo last complaint >&2; exit 3");
    check_failure(640, 480, 10, HD_FAILED, "(exit code 3)");
    check_failure(640, 480, 10, HD_FAILED, "first complaint\nlast complaint");
    fake("ffmpeg", "exit 0");
    check_failure(640, 480, 10, HD_FAILED, "ended early (exit code 0)");
    fake("ffmpeg", "kill -9 $$");
    check_failure(640, 480, 10, HD_FAILED, "ended early (signal 9)");
    fake("ffmpeg", "head -c 2000000 >/dev/null; exit 4");
    check_failure(640, 480, 10, HD_FAILED, "frame 1 of out/film.mp4; it said: (nothing)");
}

TEST(failed_films_take_no_more_frames) {
    HdError error = {0};
    HdVideo *video;
    HdFrame frame = make_frame(640, 480, RED);
    fake("ffprobe", "exit 0");
    fake("ffmpeg", "exit 1");
    open_film(&video, 640, 480);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_FAILED);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_FAILED);
    expect_contains(error.message, "takes no more frames");
    assert_int_equal(hd_video_close(video, HD_FLEETING, &error), HD_FAILED);
    assert_int_equal(count_entries("out"), 0);
    hd_frame_free(&frame);
}

TEST(wrong_exit_codes_are_errors) {
    fake("ffprobe", "echo 2");
    fake("ffmpeg", "cat >/dev/null; echo no room >&2; exit 1");
    check_failure(16, 16, 2, HD_FAILED, "(exit code 1); it said: no room");
    fake("ffmpeg", "cat >/dev/null; kill -11 $$");
    check_failure(16, 16, 2, HD_FAILED, "(signal 11)");
}

TEST(much_output_blocks_nothing) {
    fake("ffprobe", "echo 2");
    fake("ffmpeg", "yes something is wrong | head -n 50000 >&2; cat >/dev/null; "
                   "yes something is wrong | head -n 50000 >&2; echo the end >&2; exit 1");
    check_failure(640, 480, 2, HD_FAILED, "something is wrong\nthe end");
}

TEST(files_that_are_no_films_are_errors) {
    need_ffmpeg();
    fake("ffmpeg", "cat >/dev/null; exit 0");
    check_failure(16, 16, 2, HD_FAILED, "ffprobe could not count the frames of out/film.mp4");
    fake("ffmpeg", "(head -c 3072; cat >/dev/null) | PATH=$REAL ffmpeg \"$@\"");
    check_failure(16, 16, 5, HD_FAILED, "wrote 3 frames to out/film.mp4, expected 5");
    fake("ffmpeg", "cat >/dev/null; exit 0");
    fake("ffprobe", "echo 2 or 3");
    check_failure(16, 16, 2, HD_FAILED, "it said: 2 or 3");
    fake("ffprobe", "echo 2; exit 1");
    check_failure(16, 16, 2, HD_FAILED, "(exit code 1)");
    fake("ffprobe", "exit 0");
    check_failure(16, 16, 2, HD_FAILED, "it said: (nothing)");
    remove("bin/ffprobe");
    fake("ffprobe", "exec rm \"$0\"");
    fake("ffmpeg", "cat >/dev/null; rm \"${0%ffmpeg}ffprobe\"");
    check_failure(16, 16, 2, HD_UNAVAILABLE, "cannot start");
}

TEST(targets_in_the_way_are_errors) {
    HdError error = {0};
    need_ffmpeg();
    mkdir("out/folder.mp4", 0777);
    write_file("out/file", "", 0666);
    assert_int_equal(make_film("out/folder.mp4", 16, 16, 1, &error), HD_BAD_INPUT);
    assert_int_equal(make_film("out/file/film.mp4", 16, 16, 1, &error), HD_FAILED);
    assert_int_equal(count_entries("out"), 2);
    assert_int_equal(count_entries("out/folder.mp4"), 0);
}

TEST(targets_that_come_in_the_way_are_errors) {
    HdError error = {0};
    HdVideo *video;
    HdFrame frame = make_frame(16, 16, RED);
    need_ffmpeg();
    open_film(&video, 16, 16);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_OK);
    assert_int_equal(mkdir("out/film.mp4", 0777), 0);
    assert_int_not_equal(hd_video_close(video, HD_DURABLE, &error), HD_OK);
    assert_int_equal(count_entries("out"), 1);
    hd_frame_free(&frame);
}

TEST(names_that_are_too_long_are_refused) {
    static char path[HD_MAX_PATH + 1];
    HdError error = {0};
    need_ffmpeg();
    memset(path, '/', HD_MAX_PATH);
    memcpy(path, "out", 3);
    memcpy(path + HD_MAX_PATH - 5, "a.mp4", 5);
    assert_int_equal(make_film(path, 16, 16, 1, &error), HD_BAD_INPUT);
    expect_contains(error.message, "is too long, expected fewer than 4096 bytes");
}

/* Were they waited for, the test would run into its time limit. */
TEST(programs_that_hang_are_stopped) {
    HdVideo *video;
    fake("ffprobe", "exit 0");
    fake("ffmpeg", "sleep 600; exit 0");
    open_film(&video, 64, 48);
    hd_video_abort(video);
    fake("ffmpeg", "exec <&-; sleep 600");
    check_failure(640, 480, 10, HD_FAILED, "(signal 9)");
}

/* A shell would clear the signals that it finds blocked, so that this program itself plays FFmpeg.
 */
static int play_ffmpeg(void) {
    sigset_t blocked;
    sigprocmask(SIG_BLOCK, NULL, &blocked);
    while (getchar() != EOF)
        ;
    fputs(sigismember(&blocked, SIGTERM) ? "SIGTERM is blocked" : "SIGTERM is free", stderr);
    return 1;
}

TEST(blocked_signals_do_not_reach_ffmpeg) {
    sigset_t blocked, old;
    fake("ffprobe", "exit 0");
    assert_int_equal(symlink(unit_program, "bin/ffmpeg"), 0);
    sigfillset(&blocked);
    sigprocmask(SIG_BLOCK, &blocked, &old);
    check_failure(16, 16, 1, HD_FAILED, "SIGTERM is free");
    sigprocmask(SIG_SETMASK, &old, NULL);
}

/* The standard streams' numbers then go to the video's own descriptors. */
TEST(closed_standard_streams_do_no_harm) {
    int status = 0;
    need_ffmpeg();
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        HdError error = {0};
        for (int i = 0; i < 3; i++)
            close(i);
        _exit(make_film("out/film.mp4", 32, 16, 3, &error) == HD_OK ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_int_equal(count_entries("out"), 1);
}

GROUP(set_up_group, tear_down_group)
EACH(set_up, tear_down)

INSTEAD_OF("ffmpeg", play_ffmpeg)
