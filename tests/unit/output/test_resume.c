/* SPDX-License-Identifier: MIT */
/* The frames that count as finished, and the values read back of them. */
#define _XOPEN_SOURCE 700

#include <stdlib.h>

#include "image/picture.h"
#include "output/fingerprint.h"
#include "output/resume.h"
#include "system/atomic_file.h"
#include "test_folder.h"

enum { WIDTH = 19, HEIGHT = 7, FRAMES = 5 };

static HdError error;
static int numbers[FRAMES] = {2, 3, 5, 7, 11};
static const HdFrameList frames = {.frames = numbers, .count = FRAMES};

static HdOutputPlan plan_of(const char *first, const char *second, int bits) {
    const HdOutputStyle style = {
        .picture = {HD_CURVE_SRGB, abs(bits), bits < 0}, /* negative: with alpha */
        .frames_per_second = 30};
    const char *const names[] = {first, second};
    HdOutputPlan plan;
    assert_int_equal(hd_outputs_settle(&plan, names, second != NULL ? 2 : 1, &style,
                                       strchr(first, '%') != NULL ? FRAMES : 1, &error),
                     HD_OK);
    hd_outputs_set_fingerprint(&plan, 12345, true);
    return plan;
}

static HdFrame make_frame(int number) {
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        frame.rgb[i] = (float)((i * number) % 251) / 251.0f;
    return frame;
}

/* Writes a frame as the run of that plan would. */
static void write_frame(const HdOutputPlan *plan, int index, int number) {
    const HdPictureLabel label = {
        .scene = "",
        .options = "",
        .frame = number,
        .has_fingerprint = true,
        .fingerprint = hd_frame_fingerprint(plan->fingerprint, number),
    };
    char path[HD_MAX_PATH];
    HdAtomicFile file;
    HdFrame frame = make_frame(number);
    assert_int_equal(hd_output_file(&plan->list[index], number, path, &error), HD_OK);
    assert_int_equal(hd_picture_prepare(&file, &frame, plan->list[index].format,
                                        &plan->style.picture, &label, path, &error),
                     HD_OK);
    assert_int_equal(hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, &error), HD_OK);
    hd_frame_free(&frame);
}

static HdOutputPlan write_frames(const char *name) {
    const HdOutputPlan plan = plan_of(name, NULL, 8);
    for (int i = 0; i < FRAMES; i++)
        write_frame(&plan, 0, numbers[i]);
    return plan;
}

static void expect_finished(const HdOutputPlan *plan, int expected) {
    HdResume resume;
    assert_int_equal(hd_resume_find(&resume, plan, &frames, &error), HD_OK);
    assert_int_equal(resume.finished_count, expected);
    assert_int_equal(resume.missing.count, FRAMES - expected);
    for (int i = 0; i < resume.first_missing; i++)
        assert_true(resume.is_finished[i]);
    assert_true(resume.first_missing == FRAMES || !resume.is_finished[resume.first_missing]);
    for (int i = 0, next = 0; i < FRAMES; i++)
        if (!resume.is_finished[i])
            assert_int_equal(resume.missing.frames[next++], numbers[i]);
    hd_resume_free(&resume);
}

TEST(whole_pictures_with_the_right_fingerprint_are_finished) {
    HdOutputPlan plan = plan_of("a/%d.png", NULL, 8);
    expect_finished(&plan, 0);
    write_frame(&plan, 0, numbers[3]);
    expect_finished(&plan, 1);
    write_frames("a/%d.png");
    expect_finished(&plan, FRAMES);
    plan.fingerprint++;
    expect_finished(&plan, 0);
    plan.fingerprint--;
    assert_int_equal(rename("a/2.png", "a/3.png"), 0); /* under another's name */
    expect_finished(&plan, FRAMES - 2);
    assert_int_equal(unlink("a/3.png"), 0);
    assert_int_equal(mkfifo("a/3.png", 0600), 0);
    assert_int_equal(truncate("a/5.png", 0), 0);
    expect_finished(&plan, FRAMES - 3);
}

TEST(frames_that_are_always_rendered_are_not_finished) {
    static const struct {
        const char *first, *second;
        int bits, finished;
    } cases[] = {{"c/%d.png", "c/%d.pfm", 8, 0},    {"c/%d.png", "c/film.mkv", 8, FRAMES},
                 {"c/%d.png", "c/film.mkv", 16, 0}, {"c/%d.png", "c/film.mkv", -8, 0},
                 {"c/%d.png", "d/%d.png", 8, 1}, /* all files of a frame must exist */
                 {"c/film.mkv", NULL, 8, 0},        {"c/2.png", NULL, 8, 0}};
    HdOutputPlan plan = write_frames("c/%d.png");
    const HdOutputPlan two = plan_of("c/%d.png", "d/%d.png", 8);
    write_frame(&two, 1, numbers[1]);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdOutputPlan other = plan_of(cases[i].first, cases[i].second, cases[i].bits);
        expect_finished(&other, cases[i].finished);
    }
    hd_outputs_set_fingerprint(&plan, plan.fingerprint, false);
    expect_finished(&plan, 0);
}

/* From the first output that is no film. */
TEST(a_frame_is_read_back_as_it_was_encoded) {
    const char *const names[] = {"f/a.mkv", "f/b.mkv", "f/%d.png"};
    HdOutputPlan plan = write_frames("f/%d.png");
    const HdOutputStyle style = plan.style;
    assert_int_equal(hd_outputs_settle(&plan, names, 3, &style, FRAMES, &error), HD_OK);
    hd_outputs_set_fingerprint(&plan, 12345, true);
    expect_finished(&plan, FRAMES);
    HdFrame made = make_frame(7), read = make_frame(0);
    assert_int_equal(hd_frame_add_rgba(&made, &error), HD_OK);
    assert_int_equal(hd_frame_add_rgba(&read, &error), HD_OK);
    hd_frame_encode(&made, HD_CURVE_SRGB);
    assert_int_equal(hd_resume_load(&plan, 7, &read, &error), HD_OK);
    assert_true(read.is_encoded);
    assert_memory_equal(read.rgba, made.rgba, WIDTH * HEIGHT * 4);
    assert_int_equal(truncate("f/7.png", 100), 0);
    assert_int_equal(hd_resume_load(&plan, 7, &read, &error), HD_FAILED);
    expect_contains(error.message, "frame 7 of f/%d.png was finished, but has changed since");
    hd_frame_free(&made);
    hd_frame_free(&read);
}
