/* SPDX-License-Identifier: MIT */
#include "choice/record.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "base/hash.h"
#include "device/kernel_source.h"
#include "system/cache_folder.h"

enum { KEY_LENGTH = 1 << 14 };

static int power_of_two(double number) {
    return number < 1.0 ? 0 : (int)ceil(log2(number));
}

static int count_planes(const HdScene *scene) {
    int planes = 0;
    for (int i = 0; i < scene->solid_count; i++) {
        HdPlatonic shape;
        hd_platonic(scene->solids[i].kind, &shape);
        planes += shape.face_count;
    }
    return planes;
}

/* The key's first lines, for jobs whose measurements serve each other; returns their length. */
static int write_job(const HdScene *scene, const HdRenderOptions *options, char *text,
                     size_t capacity) {
    double samples =
        (double)scene->samples_per_side * scene->samples_per_side * scene->width * scene->height;
    return snprintf(
        text, capacity,
        "hedron %s, kernels %016" PRIx64 "\n2^%d samples, 2^%d planes, 2^%d triangles in "
        "2^%d places, %s floor, 2^%d lights, 2^%d endless ones, depth 2^%d\nprecision %d, "
        "math %d, pipeline %d, %d lanes, %d "
        "threads, block %d, grid "
        "%d%s, launches of %g ms\n",
        HD_VERSION, hd_hash_bytes(HD_HASH_START, hd_opencl_source, hd_opencl_source_size),
        power_of_two(samples), power_of_two(count_planes(scene)),
        power_of_two((double)hd_scene_triangle_count(scene)), power_of_two(scene->instance_count),
        scene->floor.present ? "a" : "no", power_of_two(hd_scene_light_count(scene)),
        power_of_two(hd_scene_endless_light_count(scene)), power_of_two(scene->depth),
        (int)options->precision, (int)options->math, (int)options->pipeline, options->lanes,
        options->threads, options->block, options->grid,
        options->has_deep_trees ? ", deep trees" : "", options->launch_ms);
}

static void write_key(const HdScene *scene, const HdRenderOptions *options, const char *devices,
                      char key[KEY_LENGTH]) {
    const int length = write_job(scene, options, key, KEY_LENGTH);
    snprintf(key + length, (size_t)(KEY_LENGTH - length), "%s", devices);
}

HdStatus hd_record_put(const char *kind, const HdScene *scene, const HdRenderOptions *options,
                       const char *devices, const char *text, HdError *error) {
    char key[KEY_LENGTH];
    write_key(scene, options, devices, key);
    return hd_cache_put_text(kind, key, text, error);
}

bool hd_record_get(const char *kind, const HdScene *scene, const HdRenderOptions *options,
                   const char *devices, char *text, size_t capacity) {
    char key[KEY_LENGTH];
    HdError ignored;
    write_key(scene, options, devices, key);
    return hd_cache_get_text(kind, key, text, capacity, &ignored) == HD_OK;
}
