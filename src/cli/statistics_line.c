/* SPDX-License-Identifier: MIT */
#include "cli/statistics_line.h"

#include "input/json.h"

typedef HdStatisticsKey Key;
typedef HdStatisticsSource Source;

/* Defines a function that returns the value of a key as `made`. */
#define VALUE(name, made)                                                                          \
    static json_t *name(const Key *key, const Source *source) {                                    \
        (void)key;                                                                                 \
        (void)source;                                                                              \
        return made;                                                                               \
    }

VALUE(number, json_integer(source->stored->number))
VALUE(resumed, json_true())
VALUE(backend, json_string(source->device->backend->name))
VALUE(device_index, json_integer(source->device->index))
VALUE(width, json_integer(source->stored->frame->width))
VALUE(height, json_integer(source->stored->frame->height))
VALUE(samples, json_integer(source->scene->samples_per_side))
VALUE(depth, json_integer(source->scene->depth))
VALUE(primary, json_integer((json_int_t)source->stored->frame->primary_rays))
VALUE(mirrored, json_integer((json_int_t)source->stored->frame->mirrored_rays))
VALUE(transmitted, json_integer((json_int_t)source->stored->frame->transmitted_rays))
VALUE(shadow_tests, json_integer((json_int_t)source->stored->frame->shadow_tests))
VALUE(clamps, json_integer((json_int_t)source->stored->frame->clamps))
VALUE(largest_bound, json_real(source->stored->frame->largest_bound))
VALUE(mean_bound, json_real(source->stored->frame->mean_bound))

static json_t *device_name(const Key *key, const Source *source) {
    (void)key;
    return hd_json_device_text(source->device->name);
}

static json_t *renderer(const Key *key, const Source *source) {
    (void)key;
    return hd_json_device_text(source->renderer);
}

static const HdSpan *span_of(const Key *key, const Source *source) {
    return (const HdSpan *)(const void *)((const char *)&source->stored->times + key->span);
}

static json_t *seconds(const Key *key, const Source *source) {
    return json_real(span_of(key, source)->seconds);
}

static json_t *began(const Key *key, const Source *source) {
    const HdSpan *span = span_of(key, source);
    return span->began < 0.0 ? json_null() : json_real(span->began);
}

VALUE(longest_launch, source->stored->times.longest_launch < 0.0
                          ? json_null()
                          : json_real(1e3 * source->stored->times.longest_launch))

static bool is_resumed(const Source *source) {
    return source->stored->was_finished;
}

static bool has_bound(const Source *source) {
    return !source->stored->was_finished && source->stored->frame->has_bound;
}

#define STAGE(name, text)                                                                          \
    { "seconds", #name, "s", text, seconds, offsetof(HdFrameTimes, name), NULL }
#define BEGAN(name)                                                                                \
    {                                                                                              \
        "began", #name, "s", "Start of " #name "; null: it did nothing", began,                    \
            offsetof(HdFrameTimes, name), NULL                                                     \
    }

const HdStatisticsKey hd_statistics_keys[] = {
    {NULL, "frame", NULL, "Frame number", number, 0, NULL},
    {NULL, "resumed", NULL, "true: the frame was finished before; the line has nothing else",
     resumed, 0, is_resumed},
    {NULL, "backend", NULL, "Backend that rendered the frame", backend, 0, NULL},
    {NULL, "index", NULL, "Number of the device in its backend", device_index, 0, NULL},
    {NULL, "device", NULL, "Name of the device", device_name, 0, NULL},
    {NULL, "renderer", NULL, "Settings of the renderer, for people", renderer, 0, NULL},
    {NULL, "width", "pixels", "Width of the picture", width, 0, NULL},
    {NULL, "height", "pixels", "Height of the picture", height, 0, NULL},
    {NULL, "samples", NULL, "Columns of samples in a pixel: n of n x n", samples, 0, NULL},
    {NULL, "depth", NULL, "Maximum ray depth", depth, 0, NULL},
    STAGE(prepare, "Camera and its tables"),
    STAGE(trace, "Tracing on the device"),
    STAGE(copy, "Wait after tracing for the pixels, and for further layers with OpenEXR"),
    STAGE(convert, "Conversion to 8 bits for films; 0 if the device does it"),
    STAGE(store, "Encoding and writing of pictures"),
    STAGE(film, "Sending to FFmpeg, from the start of the first film to the end of the last"),
    BEGAN(prepare),
    BEGAN(trace),
    BEGAN(copy),
    BEGAN(convert),
    BEGAN(store),
    BEGAN(film),
    {NULL, "longest_launch_ms", "ms",
     "Longest time that a kernel kept a GPU from other work; null on CPUs, or if the driver does "
     "not say",
     longest_launch, 0, NULL},
    {"rays", "primary", NULL, "Rays from the eye", primary, 0, NULL},
    {"rays", "mirrored", NULL, "Reflected rays", mirrored, 0, NULL},
    {"rays", "transmitted", NULL, "Transmitted rays", transmitted, 0, NULL},
    {NULL, "shadow_tests", NULL, "Pairs of a point and a light that may reach it", shadow_tests, 0,
     NULL},
    {NULL, "clamps", NULL, "Contributions cut to 2^16", clamps, 0, NULL},
    {"missing", "largest", "1/255",
     "Bound on the truncation error of the worst pixel, without the error of sampling; only with "
     "--max-error or --reference",
     largest_bound, 0, has_bound},
    {"missing", "mean", "1/255", "The same, mean of all pixels", mean_bound, 0, has_bound},
    {NULL, NULL, NULL, NULL, NULL, 0, NULL},
};

static bool belongs(const Key *key, const Source *source) {
    if (key->is_given != NULL)
        return key->is_given(source);
    return !source->stored->was_finished || key->value == number;
}

/* Returns the object that holds the key, made if it is missing, or NULL without memory. */
static json_t *holder_of(json_t *line, const Key *key) {
    if (key->part != NULL && json_object_get(line, key->part) == NULL)
        json_object_set_new(line, key->part, json_object());
    return key->part != NULL ? json_object_get(line, key->part) : line;
}

json_t *hd_statistics_line(const HdStatisticsSource *source) {
    json_t *line = json_object();
    for (const Key *key = hd_statistics_keys; line != NULL && key->key != NULL; key++) {
        if (!belongs(key, source))
            continue;
        if (json_object_set_new(holder_of(line, key), key->key, key->value(key, source)) != 0) {
            json_decref(line);
            line = NULL;
        }
    }
    return line;
}
