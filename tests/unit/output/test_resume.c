/* SPDX-License-Identifier: MIT */
/* Which frames count as finished, and what is read back of them. */
#define _XOPEN_SOURCE 700

#include <stdlib.h>

#include "image/mark.h"
#include "image/picture.h"
#include "output/resume.h"
#include "system/atomic_file.h"
#include "test_folder.h"

enum { WIDTH = 19, HEIGHT = 7, FRAMES = 5 };

static HdError error;
static int numbers[FRAMES] = {2, 3, 5, 7, 11};
static const HdFrameList frames = {.frames = numbers, .count = FRAMES};

static HdOutputPlan plan_with(const char *first, const char *second, int bits) {
    const HdOutputStyle style = {.picture = {.curve = HD_CURVE_SRGB, .bits = bits},
                                 .frames_per_second = 30};
    const char *const names[] = {first, second};
    HdOutputPlan plan;
    assert_int_equal(hd_outputs_settle(&plan, names, second != NULL ? 2 : 1, &style,
                                       strchr(first, '%') != NULL ? FRAMES : 1, &error),
                     HD_OK);
    hd_outputs_mark(&plan, 12345, true);
    return plan;
}

static HdOutputPlan plan_of(const char *first, const char *second) {
    return plan_with(first, second, 8);
}

static HdFrame make_frame(int number) {
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        frame.rgb[i] = (float)((i * number) % 251) / 251.0f;
    return frame;
}

/* As the run of that plan would. */
static void write_frame(const HdOutputPlan *plan, int index, int number) {
    const HdPictureLabel label = {
        .scene = "",
        .options = "",
        .frame = number,
        .is_marked = true,
        .fingerprint = hd_picture_fingerprint(plan->fingerprint, number),
    };
    char path[HD_MAX_PATH];
    HdAtomicFile file;
    HdFrame frame = make_frame(number);
    assert_int_equal(hd_output_file(&plan->list[index], number, path, &error), HD_OK);
    assert_int_equal(hd_picture_prepare(&file, &frame, plan->list[index].format,
                                        &plan->style.picture, &label, path, &error),
                     HD_OK);
    assert_int_equal(hd_atomic_file_commit(&file, HD_FLEETING, &error), HD_OK);
    hd_frame_free(&frame);
}

static void expect_finished(const HdOutputPlan *plan, int expected) {
    HdResume resume;
    assert_int_equal(hd_resume_find(&resume, plan, &frames, &error), HD_OK);
    assert_int_equal(resume.finished_count, expected);
    assert_int_equal(resume.missing.count, FRAMES - expected);
    assert_ptr_equal(resume.all, &frames);
    for (int i = 0; i < resume.first_missing; i++)
        assert_true(resume.is_finished[i]);
    assert_true(resume.first_missing == FRAMES || !resume.is_finished[resume.first_missing]);
    for (int i = 0, next = 0; i < FRAMES; i++)
        if (!resume.is_finished[i])
            assert_int_equal(resume.missing.frames[next++], numbers[i]);
    hd_resume_free(&resume);
}

TEST(frames_with_the_right_mark_are_finished) {
    HdOutputPlan plan = plan_of("a/%d.png", NULL);
    expect_finished(&plan, 0);
    for (int i = 0; i < FRAMES; i++) {
        write_frame(&plan, 0, numbers[i]);
        expect_finished(&plan, i + 1);
    }
    plan.fingerprint++;
    expect_finished(&plan, 0);
    plan.fingerprint--;
    expect_finished(&plan, FRAMES);
    /* A frame under another's name. */
    assert_int_equal(rename("a/2.png", "a/3.png"), 0);
    expect_finished(&plan, FRAMES - 2);
}

TEST(files_of_other_kinds_are_not) {
    HdOutputPlan plan = plan_of("b/%d.png", NULL);
    for (int i = 0; i < FRAMES; i++)
        write_frame(&plan, 0, numbers[i]);
    assert_int_equal(truncate("b/2.png", 0), 0);
    assert_int_equal(unlink("b/3.png"), 0);
    assert_int_equal(mkdir("b/3.png", 0777), 0);
    assert_int_equal(unlink("b/5.png"), 0);
    assert_int_equal(mkfifo("b/5.png", 0600), 0);
    expect_finished(&plan, FRAMES - 3);
}

TEST(what_must_be_rendered_anyway_is_not) {
    const HdOutputPlan marks = plan_of("c/%d.png", NULL);
    for (int i = 0; i < FRAMES; i++)
        write_frame(&marks, 0, numbers[i]);
    HdOutputPlan plan = plan_of("c/%d.png", "c/%d.pfm");
    expect_finished(&plan, 0);
    plan = plan_of("c/%d.png", "c/%d.data");
    expect_finished(&plan, 0);
    plan = plan_of("c/%d.png", "c/film.mkv");
    expect_finished(&plan, FRAMES);
    plan = plan_with("c/%d.png", "c/film.mkv", 16);
    expect_finished(&plan, 0);
    plan = marks;
    hd_outputs_mark(&plan, marks.fingerprint, false);
    expect_finished(&plan, 0);
    const char *const name = "c/%d.png";
    assert_int_equal(hd_outputs_settle(&plan, &name, 1, &marks.style, FRAMES, &error), HD_OK);
    expect_finished(&plan, 0); /* it is not marked */
    plan = plan_of("c/film.mkv", NULL);
    expect_finished(&plan, 0);
    plan = plan_of("c/2.png", NULL);
    expect_finished(&plan, 0);
}

TEST(all_pictures_of_a_frame_must_be_there) {
    const HdOutputPlan plan = plan_of("d/%d.png", "e/%d.png");
    for (int i = 0; i < FRAMES; i++)
        write_frame(&plan, 0, numbers[i]);
    expect_finished(&plan, 0);
    write_frame(&plan, 1, numbers[1]);
    expect_finished(&plan, 1);
}

TEST(a_frame_is_read_back_as_it_was_encoded) {
    const HdOutputPlan plan = plan_of("f/film.mkv", "f/%d.png");
    HdFrame made = make_frame(7), read = make_frame(0);
    write_frame(&plan, 1, 7);
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

TEST(films_before_the_pictures_are_passed_over) {
    const char *const names[] = {"g/a.mkv", "g/b.mkv", "g/%d.png"};
    const HdOutputPlan pictures = plan_of("g/%d.png", NULL);
    HdOutputPlan plan;
    HdFrame read = make_frame(0);
    for (int i = 0; i < FRAMES; i++)
        write_frame(&pictures, 0, numbers[i]);
    assert_int_equal(hd_outputs_settle(&plan, names, 3, &pictures.style, FRAMES, &error), HD_OK);
    hd_outputs_mark(&plan, pictures.fingerprint, true);
    expect_finished(&plan, FRAMES);
    assert_int_equal(hd_frame_add_rgba(&read, &error), HD_OK);
    assert_int_equal(hd_resume_load(&plan, numbers[0], &read, &error), HD_OK);
    hd_frame_free(&read);
}
