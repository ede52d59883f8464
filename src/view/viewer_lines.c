/* SPDX-License-Identifier: MIT */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "view/viewer.h"
#include "view/viewer_state.h"

typedef struct Lines {
    char (*text)[HD_VIEW_LINE];
    int count;
} Lines;

/* Cuts what is too long for a line where there is a space, and goes on below. */
static void add_text(Lines *lines, const char *text) {
    while (*text != '\0' && lines->count < HD_VIEW_LINES) {
        size_t length = strcspn(text, "\n");
        if (length > HD_VIEW_LINE - 2) {
            length = HD_VIEW_LINE - 2;
            while (length > HD_VIEW_LINE / 2 && text[length] != ' ')
                length--;
        }
        snprintf(lines->text[lines->count++], HD_VIEW_LINE, "%.*s", (int)length, text);
        text += length;
        text += *text == ' ' || *text == '\n';
    }
}

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
add(Lines *lines, const char *format, ...) {
    char text[4600];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    add_text(lines, text);
}

static void add_settings(Lines *lines, const HdViewer *viewer, int number) {
    const HdViewSide *side = &viewer->sides[number];
    const HdScene *scene = &side->file.scene;
    const bool is_split = viewer->side_count > 1;
    char device[512], problem[4096], prefix[24] = "";
    hd_view_worker_describe(side->worker, device, sizeof device, problem, sizeof problem);
    if (is_split)
        snprintf(prefix, sizeof prefix, "%s%s: ", number == 0 ? "left" : "right",
                 viewer->active == number ? " *" : "");
    add(lines, "%s%s", prefix, device);
    add(lines, "%s%s, depth %d, %s, %d x %d samples", prefix,
        side->plan.devices.render.precision == HD_PRECISION_DOUBLE ? "double" : "float",
        scene->depth, scene->sampling == HD_SAMPLING_ADAPTIVE ? "adaptive" : "grid",
        scene->samples_per_side, scene->samples_per_side);
    if (problem[0] != '\0')
        add(lines, "! %s", problem);
    if (side->mistake[0] != '\0' && number == 0)
        add(lines, "! %s", side->mistake);
}

static void add_whole(Lines *lines, const HdViewImage *image) {
    char bound[64] = "";
    if (image->has_bound)
        snprintf(bound, sizeof bound, ", error bound %.2g of 255", image->largest_bound);
    add(lines, "finished: %d x %d, %.0f ms, %.1f Mrays/s%s", image->width, image->height,
        1e3 * image->seconds, 1e-6 * (double)image->rays / image->seconds, bound);
}

static void add_speed(Lines *lines, const HdViewer *viewer, const HdViewImage *image) {
    if (image->width == 0)
        add(lines, "waiting for the first picture");
    else if (image->is_settled)
        add_whole(lines, image);
    else if (viewer->settling != 0)
        add(lines, "refining: %d x %d samples, %.0f %%", image->detail.samples,
            image->detail.samples, 100.0 * image->share);
    else
        add(lines, "moving: %d x %d, %d x %d, depth %d, %.1f ms, %.1f frames/s, %.1f Mrays/s",
            image->width, image->height, image->detail.samples, image->detail.samples,
            image->detail.depth, 1e3 * image->seconds,
            viewer->picture_seconds > 0.0 ? 1.0 / viewer->picture_seconds : 0.0,
            1e-6 * (double)image->rays / image->seconds);
}

static void add_difference(Lines *lines, const HdViewer *viewer) {
    const HdSplitFigures *figures = &viewer->figures;
    if (figures->is_unlike)
        add(lines, "difference: the pictures have different sizes");
    else
        add(lines, "difference x %d below: largest %d of 255, %.2f %% of the pixels", viewer->gain,
            figures->largest, 100.0 * figures->share);
}

static void add_place(Lines *lines, const HdViewer *viewer) {
    const int count = viewer->sides[0].file.scene.frame_count;
    if (viewer->is_free)
        add(lines, "a view of your own; h: help");
    else
        add(lines, "frame %d of %d%s; h: help", viewer->frame, count,
            viewer->is_playing ? ", playing" : "");
}

int hd_viewer_lines(HdViewer *viewer, char text[HD_VIEW_LINES][HD_VIEW_LINE]) {
    Lines lines = {.text = text};
    for (int i = 0; i < viewer->side_count && !viewer->hides_figures; i++) {
        add_settings(&lines, viewer, i);
        add_speed(&lines, viewer, &viewer->sides[i].image);
    }
    if (!viewer->hides_figures && viewer->side_count > 1)
        add_difference(&lines, viewer);
    if (!viewer->hides_figures)
        add_place(&lines, viewer);
    if (viewer->saves)
        add(&lines, "once the picture is finished, it goes to a file");
    if (viewer->hides_figures && viewer->sides[0].mistake[0] != '\0')
        add(&lines, "! %s", viewer->sides[0].mistake);
    add(&lines, "%s", viewer->note);
    for (int i = 0; viewer->shows_help && hd_view_key_lines[i] != NULL; i++)
        add(&lines, "%s", hd_view_key_lines[i]);
    return lines.count;
}
