/* SPDX-License-Identifier: MIT */
#include "cli/notes.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/text.h"
#include "device/kernel_source.h"

static void note_meshes(const HdScene *scene) {
    int64_t dropped = 0;
    for (int i = 0; i < scene->mesh_count; i++)
        dropped += scene->meshes[i].degenerate_count;
    fprintf(stderr,
            "meshes    %d with %" PRId64 " triangles, and %" PRId64
            " without an area left out; in %d place%s, %d texture%s\n",
            scene->mesh_count, hd_scene_triangle_count(scene), dropped, scene->instance_count,
            hd_plural(scene->instance_count), scene->picture_count,
            hd_plural(scene->picture_count));
}

static void note_accuracy(const HdScene *scene) {
    static const char *const samplings[] = {
        [HD_SAMPLING_GRID] = "all samples of each pixel",
        [HD_SAMPLING_ADAPTIVE] = "as many samples as each pixel needs",
        [HD_SAMPLING_REFERENCE] = "dense samples",
    };
    fprintf(stderr, "accuracy  %s; ", samplings[scene->sampling]);
    if (scene->max_error > 0.0)
        fprintf(stderr,
                "rays and lights are left out that change no pixel by more than %g of 255 steps\n",
                scene->max_error);
    else
        fprintf(stderr, "rays end by depth and cut-off\n");
}

void hd_note_scene(const char *name, const HdScene *scene) {
    const int lights = hd_scene_light_count(scene);
    fprintf(stderr,
            "scene     %s: %d solid%s, %s floor, %d light%s, %d frame%s of %d x %d pixels, %d x %d "
            "samples, depth %d\n",
            name, scene->solid_count, hd_plural(scene->solid_count),
            scene->floor.present ? "a" : "no", lights, hd_plural(lights), scene->frame_count,
            hd_plural(scene->frame_count), scene->width, scene->height, scene->samples_per_side,
            scene->samples_per_side, scene->depth);
    if (scene->mesh_count > 0)
        note_meshes(scene);
    if (hd_scene_is_surveyed(scene))
        note_accuracy(scene);
}

void hd_note_outputs(const HdOutputPlan *plan, int frame_count) {
    fprintf(stderr, "outputs   ");
    for (int i = 0; i < plan->count; i++)
        fprintf(stderr, "%s%s", i > 0 ? ", " : "", plan->list[i].name);
    fprintf(stderr, " (%d frame%s, %d bits where the format has a choice, %s)\n", frame_count,
            hd_plural(frame_count), plan->style.picture.bits,
            plan->style.picture.curve == HD_CURVE_SRGB ? "sRGB" : "linear");
}

void hd_note_device(const HdDevice *device, const char *why) {
    fprintf(stderr, "device    %s %d, %s (%s): %s\n", device->backend->name, device->index,
            device->name, device->driver, why);
}

void hd_note_launch(const HdLaunch *launch) {
    char line[128];
    hd_launch_describe(launch, line, sizeof line);
    fprintf(stderr, "launch    %s: the best for this kind of scene, by 'hedron tune'\n", line);
}

void hd_note_renderer_line(const char *renderer) {
    fprintf(stderr, "renderer  %s\n", renderer);
}

void hd_note_renderer(const HdDevice *device, const char *renderer, const char *kernels,
                      const HdSceneTables *tables) {
    char line[256];
    HdKernelNeeds needs = hd_kernel_needs(tables);
    hd_note_renderer_line(renderer);
    hd_kernel_needs_describe(&needs, line, sizeof line);
    fprintf(stderr, "kernels   %d planes; %s\n", tables->plane_count,
            device->backend->functions->kernels == NULL ? "compiled ahead, for scenes of any size"
                                                        : line);
    if (kernels[0] != '\0')
        fprintf(stderr, "build     %s\n", kernels);
}

void hd_note_dropped(const HdDevice *device, const char *why) {
    fprintf(stderr,
            "hedron: %s:%d (%s) failed, so other devices trace its frames from here on: %s\n",
            device->backend->name, device->index, device->name, why);
}

void hd_note_missing(const HdScene *scene, double missing) {
    if (scene->max_error > 0.0 && missing > scene->max_error)
        fprintf(stderr,
                "hedron: up to %.3g steps of 255 may be missing from a pixel, more than the %g of "
                "--max-error: rays end by --depth or --cutoff, or the scene has too many of them\n",
                missing, scene->max_error);
}
