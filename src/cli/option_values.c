/* SPDX-License-Identifier: MIT */
#include "cli/option_values.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An option that was given. */
typedef struct Given {
    HdOptions *options;
    const HdOptionSpec *spec;
    const char *text; /* its value */
    void *member;     /* of the options: what it sets */
} Given;

static void *at(HdOptions *options, size_t offset) {
    return (char *)options + offset;
}

static HdStatus fail_expecting(const Given *given, const char *expected, HdError *error) {
    return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected %s", given->spec->name, given->text,
                   expected);
}

/* ---- nothing ---- */

static HdStatus apply_flag(const Given *given, HdError *error) {
    const char *only_one_of = given->spec->only_one_of;
    *(bool *)given->member = true;
    for (const HdOptionSpec *other = hd_option_specs; other->name != NULL; other++)
        if (only_one_of != NULL && other->only_one_of == only_one_of && other != given->spec &&
            *(const bool *)at(given->options, other->offset))
            return hd_fail(error, HD_BAD_INPUT, "only one of %s may be given", only_one_of);
    return HD_OK;
}

static HdStatus apply_command(const Given *given, HdError *error) {
    (void)error;
    given->options->help_topic.command = given->options->command;
    given->options->command = given->spec->command;
    return HD_OK;
}

/* ---- numbers ---- */

static size_t digits(const char *text) {
    return strspn(text, "0123456789");
}

/* "1", "0.5", ".5" and "1e-3": what strtod takes beyond it is no number on a command line. */
static bool is_decimal(const char *text) {
    size_t whole = digits(text), fraction = 0;
    text += whole;
    if (*text == '.') {
        fraction = digits(text + 1);
        text += 1 + fraction;
    }
    if (*text == 'e' || *text == 'E') {
        text += 1 + (text[1] == '-' || text[1] == '+');
        if (digits(text) == 0)
            return false;
        text += digits(text);
    }
    return whole + fraction > 0 && *text == '\0';
}

/* Moves `*text` past a whole number in the range and one of the characters `ends`, of "" the end of
   the text. */
static bool take_number(const char **text, const char *ends, double low, double high, int *out) {
    char *rest;
    errno = 0;
    if (digits(*text) == 0)
        return false;
    const long value = strtol(*text, &rest, 10);
    const bool has_end = *rest == '\0' ? *ends == '\0' : strchr(ends, *rest) != NULL;
    if (!has_end || errno != 0 || (double)value < low || (double)value > high)
        return false;
    *out = (int)value;
    *text = rest + (*rest != '\0');
    return true;
}

static HdStatus apply_integer(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    const char *rest = given->text;
    char expected[64];
    int *out = given->member;
    if (!take_number(&rest, "", spec->low, spec->high, out))
        snprintf(expected, sizeof expected, "a whole number from %.0f to %.0f", spec->low,
                 spec->high);
    else if (spec->step != 0 && *out % spec->step != 0)
        snprintf(expected, sizeof expected, "a multiple of %d", spec->step);
    else
        return HD_OK;
    return fail_expecting(given, expected, error);
}

static HdStatus apply_real(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    const double value = is_decimal(given->text) ? strtod(given->text, NULL) : (double)NAN;
    char expected[64];
    *(double *)given->member = value;
    if (value >= spec->low && (spec->below_high ? value < spec->high : value <= spec->high))
        return HD_OK;
    snprintf(expected, sizeof expected, "a number from %g to %s%g", spec->low,
             spec->below_high ? "below " : "", spec->high);
    return fail_expecting(given, expected, error);
}

static HdStatus apply_size(const Given *given, HdError *error) {
    HdPlannedSize *size = given->member;
    const char *rest = given->text;
    if (take_number(&rest, "xX", 1, HD_MAX_IMAGE_SIDE, &size->width) &&
        take_number(&rest, "", 1, HD_MAX_IMAGE_SIDE, &size->height))
        return HD_OK;
    return fail_expecting(given, given->spec->expected, error);
}

static HdStatus apply_crop(const Given *given, HdError *error) {
    HdPlannedCrop *crop = given->member;
    const char *rest = given->text;
    if (take_number(&rest, "x", 1, HD_MAX_IMAGE_SIDE, &crop->width) &&
        take_number(&rest, "+", 1, HD_MAX_IMAGE_SIDE, &crop->height) &&
        take_number(&rest, "+", 0, HD_MAX_IMAGE_SIDE, &crop->left) &&
        take_number(&rest, "", 0, HD_MAX_IMAGE_SIDE, &crop->top))
        return HD_OK;
    return fail_expecting(given, given->spec->expected, error);
}

/* ---- words ---- */

int hd_option_choice(const char *const *choices, const char *text) {
    for (int i = 0; choices[i] != NULL; i++)
        if (strcmp(choices[i], text) == 0)
            return i;
    return -1;
}

void hd_option_list_choices(const char *const *choices, char *text, int capacity) {
    size_t used = 0, room = (size_t)capacity;
    text[0] = '\0';
    for (int i = 0; choices[i] != NULL && used < room; i++) {
        const char *separator = i == 0 ? "" : choices[i + 1] == NULL ? " or " : ", ";
        used += (size_t)snprintf(text + used, room - used, "%s%s", separator, choices[i]);
    }
}

/* With the first choice that begins with the text; nothing completes an empty one. */
static HdStatus fail_choosing(const Given *given, HdError *error) {
    const size_t length = strlen(given->text);
    char list[256];
    hd_option_list_choices(given->spec->choices, list, sizeof list);
    for (const char *const *choice = given->spec->choices; *choice != NULL && length > 0; choice++)
        if (strncmp(given->text, *choice, length) == 0)
            return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected %s; did you mean '%s'?",
                           given->spec->name, given->text, list, *choice);
    return fail_expecting(given, list, error);
}

static HdStatus apply_choice(const Given *given, HdError *error) {
    const int number = hd_option_choice(given->spec->choices, given->text);
    if (number < 0)
        return fail_choosing(given, error);
    if (given->spec->type == HD_OPTION_WORD)
        *(const char **)given->member = number > 0 ? given->text : NULL;
    else
        *(int *)given->member = given->spec->type == HD_OPTION_NUMERAL ? atoi(given->text) : number;
    return HD_OK;
}

/* The word up to a comma. */
static int choice_of_length(const char *const *choices, const char *word, size_t length) {
    for (int i = 0; choices[i] != NULL; i++)
        if (strncmp(choices[i], word, length) == 0 && choices[i][length] == '\0')
            return i;
    return -1;
}

static HdStatus apply_set(const Given *given, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    unsigned *set = given->member;
    *set = 0;
    for (const char *word = given->text;;) {
        const size_t length = strcspn(word, ",");
        const int number = choice_of_length(spec->choices, word, length);
        if (number < 0) {
            char list[256];
            hd_option_list_choices(spec->choices, list, sizeof list);
            return hd_fail(error, HD_BAD_INPUT,
                           "%s has '%.*s', expected some of %s, separated by commas", spec->name,
                           (int)length, word, list);
        }
        if ((*set >> number & 1) != 0)
            return hd_fail(error, HD_BAD_INPUT, "%s has %s twice", spec->name,
                           spec->choices[number]);
        *set |= 1u << number;
        if (word[length] == '\0')
            return HD_OK;
        word += length + 1;
    }
}

/* ---- texts ---- */

static HdStatus set_text(const Given *given, const char **out, HdError *error) {
    const HdOptionSpec *spec = given->spec;
    *out = given->text;
    if (spec->check != NULL && spec->check(given->text, spec->name, error) != HD_OK)
        return error->status;
    if (given->text[0] == '\0' && spec->expected != NULL)
        return hd_fail(error, HD_BAD_INPUT, "%s is empty, expected %s", spec->name, spec->expected);
    return HD_OK;
}

static HdStatus apply_text(const Given *given, HdError *error) {
    return set_text(given, given->member, error);
}

static HdStatus apply_texts(const Given *given, HdError *error) {
    const char **texts = given->member;
    int *count = at(given->options, given->spec->count_offset);
    if (*count == (int)given->spec->high)
        return hd_fail(error, HD_BAD_INPUT, "%s '%.4000s' is one too many, expected at most %d",
                       given->spec->name, given->text, *count);
    return set_text(given, &texts[(*count)++], error);
}

static HdStatus apply_change(const Given *given, HdError *error) {
    const char *equals = strchr(given->text, '=');
    if (equals == NULL || equals == given->text)
        return fail_expecting(given, given->spec->expected, error);
    return apply_texts(given, error);
}

/* ---- all types ---- */

void hd_options_reset(HdOptions *options) {
    memset(options, 0, sizeof *options);
    for (const HdOptionSpec *spec = hd_option_specs; spec->name != NULL; spec++)
        if (spec->type == HD_OPTION_REAL)
            *(double *)at(options, spec->offset) = spec->unset;
        else if (spec->type == HD_OPTION_INTEGER || spec->type == HD_OPTION_CHOICE)
            *(int *)at(options, spec->offset) = spec->unset;
}

HdStatus hd_option_apply(HdOptions *options, const HdOptionSpec *spec, const char *value,
                         HdError *error) {
    static HdStatus (*const apply[])(const Given *, HdError *) = {
        [HD_OPTION_FLAG] = apply_flag,       [HD_OPTION_COMMAND] = apply_command,
        [HD_OPTION_INTEGER] = apply_integer, [HD_OPTION_REAL] = apply_real,
        [HD_OPTION_CHOICE] = apply_choice,   [HD_OPTION_NUMERAL] = apply_choice,
        [HD_OPTION_WORD] = apply_choice,     [HD_OPTION_SET] = apply_set,
        [HD_OPTION_SIZE] = apply_size,       [HD_OPTION_CROP] = apply_crop,
        [HD_OPTION_TEXT] = apply_text,       [HD_OPTION_TEXTS] = apply_texts,
        [HD_OPTION_CHANGES] = apply_change,
    };
    const Given given = {options, spec, value, at(options, spec->offset)};
    return apply[spec->type](&given, error);
}
