/* SPDX-License-Identifier: MIT */
/* Parses the command lines of the programs that render on every backend. */
#ifndef HD_TESTS_OPTIONS_H
#define HD_TESTS_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "device/backend.h"

enum { EXIT_USAGE = 2, EXIT_SKIPPED = 77, LANE_COUNTS = 5, ALL = -1 };
extern const int lane_counts[LANE_COUNTS];
extern const char *const lane_names[LANE_COUNTS + 1];
extern const char *const precision_names[3];

/* An option and its destination, one of the pointers. */
typedef struct Option {
    const char *name;
    bool *flag; /* without a value */
    const HdBackend **backend;
    const char **text;
    uint64_t *seed;
    int *number;                /* 0 or more; with `choices` the index of one of these */
    const char *const *choices; /* ends with NULL */
} Option;

/* Parses the arguments; `options` ends with one without a name. Returns false and prints a message
   if something is not understood. */
bool parse_options(const Option *options, int count, char **arguments);

#endif
