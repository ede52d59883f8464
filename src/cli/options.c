/* SPDX-License-Identifier: MIT */
#include "cli/options.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "input/classic.h"
#include "output/outputs.h"

enum {
    RENDERING = HD_COMMAND_CLASSIC | HD_COMMAND_RENDER,
    MEASURING = RENDERING | HD_COMMAND_TUNE,
    SHOWING = MEASURING | HD_COMMAND_VIEW,
    EVERYTHING = SHOWING | HD_COMMAND_CHECK | HD_COMMAND_CONVERT | HD_COMMAND_DEVICES |
                 HD_COMMAND_COMPARE | HD_COMMAND_NEW | HD_COMMAND_COMPLETE | HD_COMMAND_HELP |
                 HD_COMMAND_SELFTEST
};

#define QUOTED(number) #number,
static const char *const lane_counts[] = {HD_LANE_COUNTS(QUOTED) NULL};

const char *const hd_curve_names[] = {"linear", "srgb", NULL};

static const char modes[] = "--gpu, --cpu and --default";
static const char loudness[] = "--verbose and --quiet";

static HdStatus check_diff(const char *text, const char *option, HdError *error) {
    if (hd_format_of(text) == &hd_format_png)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a name that ends in .png", option,
                   text);
}

/* The columns of the table that a type needs. */
#define AT(member)   .offset = offsetof(HdOptions, member)
#define FLAG(member) .type = HD_OPTION_FLAG, AT(member)
#define INTEGER(member, least, most)                                                               \
    .type = HD_OPTION_INTEGER, AT(member), .low = (least), .high = (most)
#define REAL(member, least, most) .type = HD_OPTION_REAL, AT(member), .low = (least), .high = (most)
#define ONE_OF(kind, member, ...)                                                                  \
    .type = (kind), AT(member), .choices = (const char *const[]) {                                 \
        __VA_ARGS__, NULL                                                                          \
    }
#define CHOICE(member, ...)  ONE_OF(HD_OPTION_CHOICE, member, __VA_ARGS__)
#define TEXT(member, wanted) .type = HD_OPTION_TEXT, AT(member), .expected = (wanted)
#define TEXTS(kind, member, count, most)                                                           \
    .type = (kind), AT(member), .count_offset = offsetof(HdOptions, count), .high = (most)
#define COMMAND(taken) .type = HD_OPTION_COMMAND, .command = (taken)

#define ROW(...)            {__VA_ARGS__},
#define OPTION(member, ...) {__VA_ARGS__},
const HdOptionSpec hd_option_specs[] = {
#include "cli/option_table.h"
    {.name = NULL},
};
_Static_assert(HD_CLASSIC_VARIANTS == 10 && HD_CLASSIC_DEFAULT_VARIANT == 4 &&
                   HD_MAX_OUTPUTS == 8 && HD_MAX_CHANGES == 64 && HD_BLOCK_STEP == 32 &&
                   HD_MAX_IMAGE_SIDE == 65535,
               "the texts say so");

const HdOptionSpec *hd_option_next(const HdOptionSpec *spec, HdCommand command) {
    spec = spec == NULL ? hd_option_specs : spec + 1;
    while (spec->name != NULL && (spec->commands & (unsigned)command) == 0)
        spec++;
    return spec->name != NULL ? spec : NULL;
}

void hd_option_heading(const HdOptionSpec *spec, char *text, int capacity) {
    snprintf(text, (size_t)capacity, "%s%s%s%s%s", spec->short_name ? spec->short_name : "",
             spec->short_name ? ", " : "", spec->name, spec->value ? " " : "",
             spec->value ? spec->value : "");
}

/* The value of an option that was given; false: it was not, or is at its default. */
static bool spell_value(const HdOptionSpec *spec, const void *member, char *value, size_t size) {
    const HdPlannedSize *area = member;
    const HdPlannedCrop *crop = member;
    const int *number = member;
    const double *real = member;
    char text[HD_NUMBER_SIZE];
    switch (spec->type) {
    case HD_OPTION_FLAG:
        value[0] = '\0';
        return *(const bool *)member;
    case HD_OPTION_INTEGER:
        snprintf(value, size, " %d", *number);
        return *number != spec->unset;
    case HD_OPTION_REAL:
        hd_short_number(*real, text);
        snprintf(value, size, " %s", text);
        return *real != spec->unset;
    case HD_OPTION_CHOICE:
        snprintf(value, size, " %s", spec->choices[*number > 0 ? *number : 0]);
        return *number > 0;
    case HD_OPTION_SIZE:
        snprintf(value, size, " %dx%d", area->width, area->height);
        return area->width > 0;
    case HD_OPTION_CROP:
        snprintf(value, size, " %dx%d+%d+%d", crop->width, crop->height, crop->left, crop->top);
        return crop->width > 0;
    default:
        return false;
    }
}

static void append(char *text, size_t size, const char *more) {
    const size_t length = strlen(text);
    hd_escape(more, text + length, size - length);
}

static void spell_changes(const HdOptions *options, const char *name, char *text, size_t size) {
    for (int i = 0; i < options->scene.change_count; i++) {
        append(text, size, text[0] != '\0' ? " " : "");
        append(text, size, name);
        append(text, size, " ");
        append(text, size, options->scene.changes[i]);
    }
}

void hd_options_spell(const HdOptions *options, bool all, char *text, size_t size) {
    const HdOptionSpec *spec = NULL;
    char value[64];
    text[0] = '\0';
    while ((spec = hd_option_next(spec, options->command)) != NULL) {
        if (spec->role == HD_DECIDES_NO_PIXEL || (spec->role == HD_DECIDES_PIXELS && !all))
            continue;
        if (spec->type == HD_OPTION_CHANGES)
            spell_changes(options, spec->name, text, size);
        else if (spell_value(spec, (const char *)options + spec->offset, value, sizeof value)) {
            append(text, size, text[0] != '\0' ? " " : "");
            append(text, size, spec->name);
            append(text, size, value);
        }
    }
}
