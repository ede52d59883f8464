/* SPDX-License-Identifier: MIT */
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "cli/options.h"
#include "image/difference.h"
#include "image/picture.h"
#include "input/json.h"
#include "system/interrupt.h"
#include "system/path.h"

enum { PICTURES = 2, FIGURE_WIDTH = 20 };

/* Channel that is no colour and that both pictures have. */
typedef struct ExtraChannel {
    const char *name;
    int places[PICTURES];
    HdChannelDifference difference;
} ExtraChannel;

typedef struct Comparison {
    const HdOptions *options;
    const char *names[PICTURES];
    HdPictureReader *readers[PICTURES];
    HdPictureFacts facts[PICTURES];
    HdCurve curve;
    HdPictureValue *rows[PICTURES];
    double *errors;             /* errors of a row; NULL without a heat map */
    HdFrame map;                /* encoded heat map; without `rgba` none is requested */
    char map_path[HD_MAX_PATH]; /* its file */
    HdPictureDifference *difference;
    HdPictureFigures figures;
    ExtraChannel extra[HD_MAX_FURTHER];
    int extra_count;
} Comparison;

static const char *const channel_names[] = {"red", "green", "blue"};

/* ---- additional channels ---- */

/* Returns the channel's place in the picture; negative: it lacks that name. */
static int place_of_channel(const HdPictureFacts *facts, const char *name) {
    for (int i = 0; i < facts->further; i++)
        if (strcmp(facts->names[i], name) == 0)
            return i;
    return -1;
}

static void match_extra(Comparison *comparison) {
    const HdPictureFacts *facts = comparison->facts;
    for (int i = 0; i < facts[0].further; i++) {
        const char *name = facts[0].names[i];
        const int other = place_of_channel(&facts[1], name);
        if (other >= 0)
            comparison->extra[comparison->extra_count++] =
                (ExtraChannel){.name = name, .places = {i, other}};
    }
}

static void compare_extra(Comparison *comparison, int y) {
    HdPictureReader *const *readers = comparison->readers;
    for (int i = 0; i < comparison->extra_count; i++) {
        ExtraChannel *extra = &comparison->extra[i];
        const float *first = hd_picture_reader_further(readers[0], extra->places[0]);
        const float *second = hd_picture_reader_further(readers[1], extra->places[1]);
        for (int x = 0; x < comparison->facts[0].width; x++)
            hd_channel_difference_add(&extra->difference, first[x], second[x], x, y);
    }
}

/* Returns the channel with the largest difference, or NULL. */
static const ExtraChannel *largest_extra(const Comparison *comparison) {
    const ExtraChannel *most = NULL;
    double largest = 0.0;
    for (int i = 0; i < comparison->extra_count; i++)
        if (comparison->extra[i].difference.largest > largest) {
            most = &comparison->extra[i];
            largest = most->difference.largest;
        }
    return most;
}

static bool is_identical(const Comparison *comparison) {
    return comparison->figures.identical && largest_extra(comparison) == NULL;
}

/* ---- text ---- */

static void print_figure(double value, const char *unit) {
    char text[32] = "none";
    if (isinf(value))
        snprintf(text, sizeof text, "identical");
    else if (!isnan(value))
        snprintf(text, sizeof text, "%.6g%s", value, unit);
    printf("%*s", FIGURE_WIDTH, text);
}

static void print_figures(const char *name, const char *unit, double display, double linear) {
    printf("%-20s", name);
    print_figure(display, unit);
    print_figure(linear, unit);
    printf("\n");
}

static void format_place(const HdDifferenceFigures *figures, char text[64]) {
    if (figures->channel < 0)
        snprintf(text, 64, "nowhere");
    else
        snprintf(text, 64, "%d, %d %s", figures->x, figures->y, channel_names[figures->channel]);
}

static void print_place(const HdDifferenceFigures *display, const HdDifferenceFigures *linear) {
    char places[2][64];
    format_place(display, places[0]);
    format_place(linear, places[1]);
    printf("%-20s%*s%*s\n", "  at x, y", FIGURE_WIDTH, places[0], FIGURE_WIDTH, places[1]);
}

static void print_share(const char *name, double share) {
    printf("%-20s", name);
    print_figure(100.0 * share, " %");
    printf("\n");
}

static void print_extra(const Comparison *comparison) {
    const ExtraChannel *most = largest_extra(comparison);
    if (comparison->extra_count > 0)
        printf("\n%-20s%*s\n", "further channels", FIGURE_WIDTH, "largest difference");
    for (int i = 0; i < comparison->extra_count; i++) {
        const ExtraChannel *extra = &comparison->extra[i];
        const HdChannelDifference *difference = &extra->difference;
        char name[62];
        hd_escape(extra->name, name, sizeof name);
        if (difference->largest > 0.0)
            printf("  %-18s%*.6g at %d, %d%s\n", name, FIGURE_WIDTH, difference->largest,
                   difference->x, difference->y, extra == most ? ", the largest" : "");
        else
            printf("  %-18s%*s\n", name, FIGURE_WIDTH, "none");
    }
    for (int p = 0; p < PICTURES; p++)
        for (int i = 0; i < comparison->facts[p].further; i++) {
            char name[62];
            hd_escape(comparison->facts[p].names[i], name, sizeof name);
            if (place_of_channel(&comparison->facts[1 - p], comparison->facts[p].names[i]) < 0)
                printf("%-20s only in the %s\n", name, p == 0 ? "first" : "second");
        }
}

static void print_text(const Comparison *comparison) {
    const HdPictureFigures *figures = &comparison->figures;
    const HdDifferenceFigures *display = &figures->display, *linear = &figures->linear;
    for (int i = 0; i < PICTURES; i++) {
        const HdPictureFacts *facts = &comparison->facts[i];
        printf("%-7s %s: %s, %d bits, %d x %d pixels\n", i == 0 ? "first" : "second",
               comparison->names[i], facts->format->name, facts->bits, facts->width, facts->height);
    }
    printf("%-7s %s\n\n", "curve", hd_curve_names[comparison->curve]);
    printf("%-20s%*s%*s\n", "", FIGURE_WIDTH, "display, 0..255", FIGURE_WIDTH, "linear, 0..1");
    print_figures("RMSE", "", display->rmse, linear->rmse);
    print_figures("PSNR", " dB", display->psnr, linear->psnr);
    print_figures("mean error", "", display->mean, linear->mean);
    print_figures("99.9th percentile", "", display->p999, linear->p999);
    print_figures("largest error", "", display->largest, linear->largest);
    print_place(display, linear);
    print_share("pixels off by > 1", figures->above_1);
    print_share("pixels off by > 8", figures->above_8);
    if (figures->not_finite[0] + figures->not_finite[1] > 0)
        printf("%-20s%*" PRIu64 "%*" PRIu64 "\n", "NaN or infinite", FIGURE_WIDTH,
               figures->not_finite[0], FIGURE_WIDTH, figures->not_finite[1]);
    print_extra(comparison);
    if (is_identical(comparison))
        printf("\nThe pictures are identical.\n");
}

/* ---- JSON ---- */

static json_t *number_or_null(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *describe_place(const HdDifferenceFigures *figures) {
    if (figures->channel < 0)
        return json_null();
    return json_pack("{s:i, s:i, s:s}", "x", figures->x, "y", figures->y, "channel",
                     channel_names[figures->channel]);
}

static json_t *describe_figures(const HdDifferenceFigures *figures) {
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "rmse", number_or_null(figures->rmse),
                     "psnr", number_or_null(figures->psnr), "mean", number_or_null(figures->mean),
                     "p999", number_or_null(figures->p999), "largest",
                     number_or_null(figures->largest), "at", describe_place(figures));
}

static json_t *describe_picture(const Comparison *comparison, int i) {
    const HdPictureFacts *facts = &comparison->facts[i];
    return json_pack("{s:o, s:s, s:i, s:I}", "file", hd_json_device_text(comparison->names[i]),
                     "format", facts->format->name, "bits", facts->bits, "not_finite",
                     (json_int_t)comparison->figures.not_finite[i]);
}

static json_t *describe_extra(const Comparison *comparison) {
    json_t *list = json_array();
    for (int i = 0; i < comparison->extra_count; i++) {
        const ExtraChannel *extra = &comparison->extra[i];
        const HdChannelDifference *difference = &extra->difference;
        json_t *at = difference->largest > 0.0
                         ? json_pack("{s:i, s:i}", "x", difference->x, "y", difference->y)
                         : json_null();
        list = hd_json_append(list,
                              json_pack("{s:o, s:o, s:o}", "name", hd_json_device_text(extra->name),
                                        "largest", number_or_null(difference->largest), "at", at));
    }
    return list;
}

static HdStatus print_json(const Comparison *comparison, HdError *error) {
    const HdPictureFigures *figures = &comparison->figures;
    const ExtraChannel *most = largest_extra(comparison);
    json_t *root = json_pack(
        "{s:o, s:o, s:i, s:i, s:s, s:I, s:b, s:o, s:o, s:o, s:o, s:o, s:o}", "first",
        describe_picture(comparison, 0), "second", describe_picture(comparison, 1), "width",
        comparison->facts[0].width, "height", comparison->facts[0].height, "curve",
        hd_curve_names[comparison->curve], "pixels", (json_int_t)figures->pixels, "identical",
        is_identical(comparison), "display", describe_figures(&figures->display), "linear",
        describe_figures(&figures->linear), "above_1", number_or_null(figures->above_1), "above_8",
        number_or_null(figures->above_8), "channels", describe_extra(comparison), "most_different",
        hd_json_text_or_null(most != NULL ? most->name : NULL));
    return hd_json_print(root, "the figures", error);
}

/* ---- comparison ---- */

/* PFM has no curve, and is shown with the most common one. */
static HdStatus choose_curve(Comparison *comparison, HdError *error) {
    const HdPictureFacts *facts = comparison->facts;
    const bool is_png[] = {facts[0].format == &hd_format_png, facts[1].format == &hd_format_png};
    if (comparison->options->curve >= 0)
        comparison->curve = (HdCurve)comparison->options->curve;
    else if (is_png[0] && is_png[1] && facts[0].curve != facts[1].curve)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is marked as sRGB, but %s is not, so that it counts as linear; expected "
                       "the same curve, or --curve",
                       comparison->names[facts[0].curve == HD_CURVE_SRGB ? 0 : 1],
                       comparison->names[facts[0].curve == HD_CURVE_SRGB ? 1 : 0]);
    else if (is_png[0] || is_png[1])
        comparison->curve = facts[is_png[0] ? 0 : 1].curve;
    else
        comparison->curve = HD_CURVE_SRGB;
    return HD_OK;
}

static HdStatus open_pictures(Comparison *comparison, HdError *error) {
    const HdPictureFacts *first = &comparison->facts[0], *second = &comparison->facts[1];
    for (int i = 0; i < PICTURES; i++) {
        HD_TRY(hd_picture_reader_open(&comparison->readers[i], comparison->names[i], error));
        comparison->facts[i] = *hd_picture_reader_facts(comparison->readers[i]);
    }
    if (first->width != second->width || first->height != second->height)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s has %d x %d pixels, but %s has %d x %d; expected the same size",
                       comparison->names[0], first->width, first->height, comparison->names[1],
                       second->width, second->height);
    match_extra(comparison);
    return choose_curve(comparison, error);
}

static HdStatus open_map(Comparison *comparison, HdError *error) {
    const HdPictureFacts *facts = &comparison->facts[0];
    char *path = comparison->map_path;
    HD_TRY(hd_path_expand_home(comparison->options->diff, path, error));
    for (int i = 0; i < PICTURES; i++)
        if (hd_path_is_same(path, comparison->names[i]))
            return hd_fail(error, HD_BAD_INPUT, "--diff %s would replace the picture %s", path,
                           comparison->names[i]);
    comparison->errors = malloc((size_t)facts->width * sizeof *comparison->errors);
    if (comparison->errors == NULL)
        return HD_NO_ROOM(error, "a row of pixels");
    comparison->map = (HdFrame){.width = facts->width, .height = facts->height, .is_encoded = true};
    return hd_frame_add_rgba(&comparison->map, error);
}

static HdStatus start(Comparison *comparison, HdError *error) {
    const HdPictureFacts *facts = comparison->facts;
    const size_t width = (size_t)facts[0].width;
    const bool clamps = facts[0].format == &hd_format_png || facts[1].format == &hd_format_png;
    HD_TRY(hd_difference_create(&comparison->difference, clamps, error));
    for (int i = 0; i < PICTURES; i++) {
        comparison->rows[i] = malloc(width * 3 * sizeof *comparison->rows[i]);
        HD_TRY(hd_picture_reader_start(comparison->readers[i], comparison->curve, error));
        if (comparison->rows[i] == NULL)
            return HD_NO_ROOM(error, "a row of pixels");
    }
    return comparison->options->diff != NULL ? open_map(comparison, error) : HD_OK;
}

static HdStatus compare_row(Comparison *comparison, int y, HdError *error) {
    const int width = comparison->facts[0].width;
    for (int i = 0; i < PICTURES; i++)
        HD_TRY(hd_picture_reader_next(comparison->readers[i], comparison->rows[i], error));
    hd_difference_add_row(comparison->difference, comparison->rows[0], comparison->rows[1], width,
                          comparison->errors);
    compare_extra(comparison, y);
    for (int x = 0; x < width && comparison->errors != NULL; x++)
        hd_heat_colour(comparison->errors[x],
                       comparison->map.rgba + 4 * ((size_t)y * (size_t)width + (size_t)x));
    return HD_OK;
}

static HdStatus compare_rows(Comparison *comparison, HdError *error) {
    const HdPictureStyle style = {HD_CURVE_SRGB, 8, false};
    for (int y = 0; y < comparison->facts[0].height; y++) {
        if (hd_interrupt_signal() != 0)
            return hd_fail(error, HD_INTERRUPTED, "interrupted after %d rows", y);
        HD_TRY(compare_row(comparison, y, error));
    }
    return comparison->map.rgba != NULL
               ? hd_picture_write(&comparison->map, &style, comparison->map_path, error)
               : HD_OK;
}

/* ---- the command ---- */

/* Decides whether the exit code is 1. */
static HdStatus check_limits(const Comparison *comparison, HdError *error) {
    const HdPictureFigures *figures = &comparison->figures;
    const double limit = comparison->options->fail_above;
    const HdDifferenceFigures *display = &figures->display;
    if (figures->not_finite[0] + figures->not_finite[1] > 0)
        return hd_fail(error, HD_FAILED,
                       "%" PRIu64 " values of %s and %" PRIu64 " of %s are NaN or infinite",
                       figures->not_finite[0], comparison->names[0], figures->not_finite[1],
                       comparison->names[1]);
    if (limit >= 0.0 && display->largest > limit)
        return hd_fail(error, HD_FAILED,
                       "the largest error is %.6g of 255, at x %d, y %d in %s; --fail-above "
                       "allows %.6g",
                       display->largest, display->x, display->y, channel_names[display->channel],
                       limit);
    return HD_OK;
}

static void close_all(Comparison *comparison) {
    for (int i = 0; i < PICTURES; i++) {
        hd_picture_reader_close(comparison->readers[i]);
        free(comparison->rows[i]);
    }
    free(comparison->errors);
    hd_frame_free(&comparison->map);
    hd_difference_free(comparison->difference);
}

static HdStatus report(Comparison *comparison, HdError *error) {
    hd_difference_figures(comparison->difference, &comparison->figures);
    if (!comparison->options->json)
        print_text(comparison);
    else if (print_json(comparison, error) != HD_OK)
        return HD_FAILED;
    return check_limits(comparison, error);
}

HdStatus hd_command_compare(const HdOptions *options, HdError *error) {
    Comparison comparison = {
        .options = options,
        .names = {options->operands[0], options->operands[1]},
    };
    HdStatus status = open_pictures(&comparison, error);
    if (status == HD_OK)
        status = start(&comparison, error);
    if (status == HD_OK)
        status = compare_rows(&comparison, error);
    if (status == HD_OK)
        status = report(&comparison, error);
    close_all(&comparison);
    return status;
}
