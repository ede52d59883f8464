/* SPDX-License-Identifier: MIT */
#include "options.h"
#include "render/backends.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const int lane_counts[LANE_COUNTS] = {1, 2, 4, 8, 16};
const char *const lane_names[LANE_COUNTS + 1] = {"1", "2", "4", "8", "16", NULL};
const char *const precision_names[3] = {"float", "double", NULL};

static bool parse_number(const char *text, uint64_t most, uint64_t *value) {
    char *end;
    errno = 0;
    *value = strtoull(text, &end, 10);
    return isdigit((unsigned char)*text) && *end == '\0' && errno == 0 && *value <= most;
}

static bool take(const Option *option, const char *value) {
    uint64_t number = 0;
    if (option->text != NULL)
        return (*option->text = value) != NULL;
    if (option->backend != NULL)
        return (*option->backend = hd_backend_find(value)) != NULL;
    if (option->seed != NULL)
        return parse_number(value, UINT64_MAX, option->seed);
    if (option->choices == NULL && !parse_number(value, INT_MAX, &number))
        return false;
    while (option->choices != NULL && strcmp(option->choices[number], value) != 0)
        if (option->choices[++number] == NULL)
            return false;
    *option->number = (int)number;
    return true;
}

bool parse_options(const Option *options, int count, char **arguments) {
    for (int i = 1; i < count; i++) {
        const Option *option = options;
        while (option->name != NULL && strcmp(option->name, arguments[i]) != 0)
            option++;
        if (option->name != NULL && option->flag != NULL) {
            *option->flag = true;
        } else if (option->name == NULL || i + 1 == count || !take(option, arguments[i + 1])) {
            fprintf(stderr, "not understood: %s\n", arguments[i]);
            return false;
        } else {
            i++;
        }
    }
    return true;
}
