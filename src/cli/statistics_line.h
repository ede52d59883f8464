/* SPDX-License-Identifier: MIT */
/* The keys of a line of statistics: what writes each, and what the reference says of it. */
#ifndef HD_CLI_STATISTICS_LINE_H
#define HD_CLI_STATISTICS_LINE_H

#include <jansson.h>
#include <stddef.h>

#include "device/renderer.h"
#include "output/frame_store.h"
#include "scene/scene.h"

/* What a line is about. */
typedef struct HdStatisticsSource {
    const HdScene *scene;
    const HdDevice *device;
    const char *renderer; /* its own words, from hd_renderer_describe */
    const HdStoredFrame *stored;
} HdStatisticsSource;

typedef struct HdStatisticsKey HdStatisticsKey;
struct HdStatisticsKey {
    const char *part; /* object that holds the key; NULL: the line itself */
    const char *key;
    const char *unit;  /* NULL: none */
    const char *about; /* meaning, without a full stop */
    json_t *(*value)(const HdStatisticsKey *key, const HdStatisticsSource *source);
    size_t span; /* offset in HdFrameTimes of a stage's time */
    bool (*is_given)(const HdStatisticsSource *source); /* NULL: on each line of a new frame */
};

/* In the order of the line; a NULL key ends it. */
extern const HdStatisticsKey hd_statistics_keys[];

/* Returns the line as an object, or NULL without memory. */
json_t *hd_statistics_line(const HdStatisticsSource *source);

#endif
