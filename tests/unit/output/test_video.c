/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <signal.h>
#include <sys/wait.h>

#include "fake_programs.h"
#include "image/picture.h"
#include "output/video.h"
#include "system/atomic_file.h"

static HdError error;
/* Every test begins with an empty folder "out", and without fake programs. */
static int begin(void **state) {
    (void)state;
    remove_folder("out");
    remove_folder("bin");
    hd_known_folders_forget();
    return mkdir("out", 0777) != 0 || mkdir("bin", 0777) != 0;
}

/* No test may leave a process or a descriptor behind. */
static int end(void **state) {
    static int descriptors = 0;
    const int open_now = count_entries("/proc/self/fd");
    (void)state;
    if (descriptors == 0)
        descriptors = open_now;
    if (descriptors != open_now)
        fprintf(stderr, "%d descriptors are open, expected %d\n", open_now, descriptors);
    if (waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD)
        return descriptors != open_now;
    fprintf(stderr, "a process is left\n");
    return 1;
}

static void need_ffmpeg(void) {
    if (system("command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null") != 0)
        skip();
}

static HdFrame make_frame(int width, int height, const uint8_t colour[4]) {
    HdFrame frame = {.width = width, .height = height};
    assert_int_equal(hd_frame_add_rgba(&frame, &error), HD_OK);
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        memcpy(frame.rgba + i * 4, colour, 4);
    return frame;
}

static const HdOutputStyle STYLE = {{HD_CURVE_SRGB, 8, false}, 25, false};
static const HdOutputStyle LINEAR = {{HD_CURVE_LINEAR, 8, false}, 25, false};
static const uint8_t RED[4] = {255, 0, 0, 255};

static HdStatus open_film(HdVideo **video, const char *path, int width, int height,
                          const HdOutputStyle *style) {
    const HdVideoPlan plan = {hd_format_of(path), width, height, *style, false};
    const HdStatus status = hd_video_open(video, path, &plan, &error);
    assert_true((status == HD_OK) == (*video != NULL));
    return status;
}

/* Makes a film of these frames, which are of one size, and ends it as a caller would, whatever
   happens. */
static HdStatus film_frames(const char *path, const HdFrame *frames, int count,
                            const HdOutputStyle *style) {
    HdVideo *video;
    HdStatus status = open_film(&video, path, frames[0].width, frames[0].height, style);
    if (status != HD_OK)
        return status;
    for (int i = 0; i < count && status == HD_OK; i++)
        status = hd_video_add(video, &frames[i], &error);
    if (status == HD_OK)
        return hd_video_close(video, HD_WITHOUT_SYNC, &error);
    hd_video_abort(video);
    return status;
}

/* Makes it of as many red frames, at most three. */
static HdStatus make_film(const char *path, int width, int height, int count,
                          const HdOutputStyle *style) {
    HdFrame frame = make_frame(width, height, RED);
    const HdFrame frames[] = {frame, frame, frame};
    const HdStatus status = film_frames(path, frames, count, style);
    hd_frame_free(&frame);
    return status;
}

/* Expects the film to fail, say why, and leave no file. */
static void check_failure(int side, int frames, HdStatus expected, const char *part) {
    assert_int_equal(make_film("out/film.mp4", side, side, frames, &STYLE), expected);
    expect_contains(error.message, part);
    assert_int_equal(count_entries("out"), 0);
}

/* Compares ffprobe's values of these properties, one a line. */
static void check_film(const char *path, const char *properties, const char *expected) {
    char command[300], text[1000] = "";
    snprintf(command, sizeof command,
             "PATH=${PATH#*:} ffprobe -v error -min_delay 0 -count_packets -show_entries %s -of "
             "default=nk=1:nw=1 %s",
             properties, path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    text[fread(text, 1, sizeof text - 1, pipe)] = '\0';
    assert_int_equal(pclose(pipe), 0);
    assert_string_equal(text, expected);
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

enum { COLOURS = 8, FRAMES = COLOURS + 1 };
enum { SIDE = 64, PIXELS = SIDE * SIDE, MIDDLE = PIXELS / 2 + 32 };
static const uint8_t colours[COLOURS][4] = {
    {255, 0, 0, 255}, {0, 255, 0, 255},    {0, 0, 255, 255},  {255, 255, 255, 255},
    {0, 0, 0, 255},   {200, 100, 50, 255}, {30, 60, 90, 255}, {128, 128, 128, 255}};

/* Makes a frame for each colour, and one with more colours than a palette has. A player that
   follows the tags shows the original. */
static void film_colours(const char *path, int rate, bool is_ntsc, double tolerance) {
    const HdOutputStyle style = {STYLE.picture, rate, is_ntsc};
    static uint8_t rgb[FRAMES * PIXELS * 3];
    double off = 0.0;
    HdFrame frames[FRAMES];
    for (int i = 0; i < FRAMES; i++)
        frames[i] = make_frame(SIDE, SIDE, colours[i % COLOURS]);
    for (int i = 0; i < PIXELS; i++) {
        frames[COLOURS].rgba[4 * i] = (uint8_t)(i % SIDE * 2);
        frames[COLOURS].rgba[4 * i + 1] = (uint8_t)(i / SIDE * 2);
    }
    assert_int_equal(film_frames(path, frames, FRAMES, &style), HD_OK);
    decode_film(path, "rgb24", rgb, sizeof rgb);
    for (int i = 0; i < COLOURS; i++)
        for (int c = 0; c < 3; c++)
            expect_near(rgb[(i * PIXELS + MIDDLE) * 3 + c], colours[i][c], tolerance);
    for (int i = 0; i < PIXELS * 3; i++)
        off += abs(rgb[COLOURS * PIXELS * 3 + i] - frames[COLOURS].rgba[i / 3 * 4 + i % 3]);
    expect_near(off / (PIXELS * 3), 0.0, 4.0);
    for (int i = 0; i < FRAMES; i++)
        hd_frame_free(&frames[i]);
}

TEST(films_in_yuv_follow_bt709) {
    static const struct {
        const char *path;
        int rate;
        bool is_ntsc;
        const char *expected;
    } films[] = {
        {"out/new/film.mp4", 25, false,
         "h264\n64\n64\nyuv420p\ntv\nbt709\nbt709\nbt709\n25/1\n9\n"},
        {"out/new/film.MOV", 24, true,
         "h264\n64\n64\nyuv420p\ntv\nbt709\nbt709\nbt709\n24000/1001\n9\n"},
        {"out/new/film.webm", 30, true,
         "vp9\n64\n64\nyuv420p\ntv\nbt709\nbt709\nbt709\n30000/1001\n9\n"},
    };
    need_ffmpeg();
    for (int i = 0; i < 3; i++) {
        film_colours(films[i].path, films[i].rate, films[i].is_ntsc, 4.0);
        assert_int_equal(count_entries("out/new"), i + 1);
        check_film(films[i].path,
                   "stream=codec_name,width,height,pix_fmt,color_range,color_space,color_transfer,"
                   "color_primaries,r_frame_rate,nb_read_packets",
                   films[i].expected);
    }
}

/* Counting frames takes longer than making a small film. */
static void trust_count(int frames) {
    char script[20];
    snprintf(script, sizeof script, "echo %d", frames);
    fake("ffprobe", script);
}

static const char tags[] = "stream=codec_name,width,height,color_range,color_space,color_transfer,"
                           "color_primaries,r_frame_rate,nb_read_packets";

TEST(mp4_is_tagged_linear_and_odd_sizes_are_padded) {
    need_ffmpeg();
    trust_count(1);
    assert_int_equal(make_film("out/film.mp4", 33, 1, 1, &LINEAR), HD_OK);
    check_film("out/film.mp4", tags, "h264\n34\n2\ntv\nbt709\nlinear\nbt709\n25/1\n1\n");
}

/* Cut into slices if both sides have 64 pixels, or not. */
TEST(mkv_loses_nothing) {
    static const struct {
        const char *path;
        int width, height;
        const HdOutputStyle *style;
        const char *tags;
    } films[] = {
        {"out/film.mkv", 1, 100, &LINEAR, "ffv1\n1\n100\npc\ngbr\nlinear\nbt709\n25/1\n3\n"},
        {"out/film.MKV", 67, 64, &STYLE, "ffv1\n67\n64\npc\ngbr\niec61966-2-1\nbt709\n25/1\n3\n"}};
    static uint8_t rgba[3 * 67 * 64 * 4];
    uint32_t seed = 1;
    need_ffmpeg();
    trust_count(3);
    for (int k = 0; k < 2; k++) {
        HdFrame frames[3];
        const size_t size = (size_t)(films[k].width * films[k].height * 4);
        for (int i = 0; i < 3; i++) {
            frames[i] = make_frame(films[k].width, films[k].height, RED);
            for (size_t j = 0; j < size; j++)
                if (j % 4 != 3)
                    frames[i].rgba[j] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
        }
        assert_int_equal(film_frames(films[k].path, frames, 3, films[k].style), HD_OK);
        check_film(films[k].path, tags, films[k].tags);
        decode_film(films[k].path, "rgba", rgba, 3 * size);
        for (size_t i = 0; i < 3; i++) {
            assert_memory_equal(rgba + i * size, frames[i].rgba, size);
            hd_frame_free(&frames[i]);
        }
    }
}

/* The format has centiseconds: the total is as long as it should be, and no frame is lost. */
TEST(gif_keeps_the_time) {
    need_ffmpeg();
    film_colours("out/film.gif", 30, false, 2.0);
    check_film("out/film.gif", "packet=duration:stream=codec_name,width,height",
               "3\n4\n3\n3\n4\n3\n3\n4\n4\ngif\n64\n64\n");
    trust_count(1);
    assert_int_equal(make_film("out/tiny.gif", 1, 1, 1, &STYLE), HD_OK);
}

TEST(names_reach_ffmpeg_unchanged) {
    const char name[] = "http:a 'b' $c: %d; \"d\".mkv";
    need_ffmpeg();
    assert_int_equal(chdir("out"), 0);
    assert_int_equal(make_film(name, 16, 16, 1, &STYLE), HD_OK);
    assert_int_equal(access(name, F_OK), 0);
    assert_int_equal(chdir(".."), 0);
}

/* ---- fake programs in place of FFmpeg ---- */

TEST(an_old_film_stays_until_replaced) {
    HdVideo *video;
    struct stat found;
    HdFrame frame = make_frame(32, 16, RED);
    fake_films(32 * 16 * 4, 0);
    write_bytes("out/film.mp4", "older", 5);
    assert_int_equal(open_film(&video, "out/film.mp4", 32, 16, &STYLE), HD_OK);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_OK);
    assert_int_equal(count_entries("out"), 2);
    hd_video_abort(video);
    assert_int_equal(count_entries("out"), 1);
    assert_true(stat("out/film.mp4", &found) == 0 && found.st_size == 5);
    assert_int_equal(make_film("out/film.mp4", 32, 16, 1, &STYLE), HD_OK);
    assert_true(stat("out/film.mp4", &found) == 0 && found.st_size == 32 * 16 * 4);
    hd_frame_free(&frame);
}

TEST(the_timeout_is_whole_seconds) {
    static const char *const wrong[] = {"0", "86401", "1.5", "1s"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        setenv("HEDRON_FFMPEG_PATIENCE", wrong[i], 1);
        check_failure(16, 1, HD_BAD_INPUT, wrong[i]);
    }
    fake("ffprobe", "exit 0");
    fake("ffmpeg", "exec sleep 1000");
    setenv("HEDRON_FFMPEG_PATIENCE", "1", 1);
    check_failure(16, 1, HD_FAILED,
                  "FFmpeg was idle for 1 s after the last frame of out/film.mp4 and was stopped");
    check_failure(600, 2, HD_FAILED, "FFmpeg was idle for 1 s at frame 0 of out/film.mp4");
    unsetenv("HEDRON_FFMPEG_PATIENCE");
}

TEST(failures_of_the_programs_are_reported) {
    enum { LARGE = 600 }; /* a frame of that side exceeds all buffers */
    static const struct {
        const char *ffmpeg, *ffprobe;
        int side;
        const char *why;
    } cases[] = {
        {"echo first >&2; echo last >&2; exit 3", "exit 0", LARGE,
         "FFmpeg ended early (exit code 3) at frame 0 of out/film.mp4; it said: "
         "first\nlast"},
        {"exit 0", "exit 0", LARGE, "ended early (exit code 0)"},
        {"head -c 2000000 >/dev/null; exit 4", "exit 0", LARGE,
         "frame 1 of out/film.mp4; it said: (nothing)"},
        {"cat >/dev/null; echo no room >&2; exit 1", "echo 2", 16,
         "FFmpeg could not make out/film.mp4 (exit code 1); it said: no room"},
        {"cat >/dev/null", "echo 2 or 3", 16,
         "ffprobe could not count the frames of out/film.mp4 (exit code 0), expected 2; it said: "
         "2 or 3"},
        {"cat >/dev/null", "echo 2; exit 1", 16, "(exit code 1)"},
        {"cat >/dev/null", "exit 0", 16, "it said: (nothing)"},
        {"cat >/dev/null; echo full >&2", "exit 0", 16, "(nothing); FFmpeg had said: full"},
        {"cat >/dev/null; echo full >&2", "echo 1", 16,
         "FFmpeg wrote 1 frames to out/film.mp4, expected 2; FFmpeg had said: full"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fake("ffmpeg", cases[i].ffmpeg);
        fake("ffprobe", cases[i].ffprobe);
        check_failure(cases[i].side, 2, HD_FAILED, cases[i].why);
    }
    HdVideo *video;
    HdFrame frame = make_frame(LARGE, LARGE, RED);
    fake("ffmpeg", "exit 1");
    assert_int_equal(open_film(&video, "out/film.mp4", LARGE, LARGE, &STYLE), HD_OK);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_FAILED);
    hd_video_abort(video);
    hd_frame_free(&frame);
    fake("ffmpeg", "cat >/dev/null; rm \"${0%ffmpeg}ffprobe\"");
    check_failure(16, 2, HD_UNAVAILABLE, "cannot start");
}

TEST(targets_in_the_way_are_errors) {
    HdVideo *video;
    HdFrame frame = make_frame(16, 16, RED);
    fake_films(16 * 16 * 4, 0);
    mkdir("out/folder.mp4", 0777);
    write_bytes("out/file", "", 0);
    assert_int_equal(make_film("out/folder.mp4", 16, 16, 1, &STYLE), HD_BAD_INPUT);
    assert_int_equal(make_film("out/file/film.mp4", 16, 16, 1, &STYLE), HD_FAILED);
    assert_int_equal(open_film(&video, "out/film.mp4", 16, 16, &STYLE), HD_OK);
    assert_int_equal(hd_video_add(video, &frame, &error), HD_OK);
    assert_int_equal(mkdir("out/film.mp4", 0777), 0); /* now this one, too */
    assert_int_not_equal(hd_video_close(video, HD_DURABLE, &error), HD_OK);
    assert_int_equal(count_entries("out"), 3);
    hd_frame_free(&frame);
}

/* A shell would clear the signals that it finds blocked, so this program itself plays FFmpeg. */
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
    check_failure(16, 1, HD_FAILED, "SIGTERM is free");
    sigprocmask(SIG_SETMASK, &old, NULL);
}

/* The standard streams' numbers then go to the video's own descriptors. */
TEST(closed_standard_streams_do_no_harm) {
    int status = 0;
    fake_films(32 * 16 * 4, 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        for (int i = 0; i < 3; i++)
            close(i);
        _exit(make_film("out/film.mp4", 32, 16, 3, &STYLE) == HD_OK ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_int_equal(count_entries("out"), 1);
}

TEST(an_encoder_that_is_missing_is_named) {
    fake("ffprobe", "exit 0");
    fake("ffmpeg", "echo \"Unknown encoder 'libx265'\" >&2; exit 1");
    check_failure(16, 1, HD_UNAVAILABLE, "film.mp4: Unknown encoder 'libx265'; expected an FFmpeg");
}

/* The last one, because they are still missing afterwards. */
TEST(missing_programs_are_unavailable) {
    char only_bin[100];
    snprintf(only_bin, sizeof only_bin, "/nonexistent:%s/bin", test_folder);
    setenv("PATH", only_bin, 1);
    check_failure(16, 1, HD_UNAVAILABLE, "\"ffmpeg\"");
    fake("ffmpeg", "exit 0");
    check_failure(16, 1, HD_UNAVAILABLE, "\"ffprobe\"");
    fake("ffprobe", "exit 0");
    write_bytes("bin/ffmpeg", "#!/nonexistent/interpreter\n", 27);
    check_failure(16, 1, HD_UNAVAILABLE, "cannot start");
}

GROUP(make_folder_for_programs, remove_test_folder)
EACH(begin, end)

INSTEAD_OF("ffmpeg", play_ffmpeg)
