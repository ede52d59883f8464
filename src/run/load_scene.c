/* SPDX-License-Identifier: MIT */
#include "run/load_scene.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/check.h"
#include "input/classic.h"
#include "input/files.h"
#include "input/scene_file.h"
#include "render/bound_pass.h"
#include "scene/contact.h"
#include "scene/nesting.h"
#include "scene/triangulate.h"
#include "system/interrupt.h"

/* Far above any classic input, yet small enough to read into memory. */
enum { MAX_INPUT_BYTES = 1 << 20 };

/* Sides of the polygons that replace discs of edge lights. */
enum { DISC_SIDES = 16 };

static const char standard_input[] = "standard input";

const char *hd_scene_name(const char *path) {
    return path == NULL ? "the built-in scene" : strcmp(path, "-") == 0 ? standard_input : path;
}

/* Reads up to `most` bytes, or until an interrupt; the caller frees the text. */
static HdStatus read_stream(FILE *stream, const char *name, size_t most, char **text, size_t *size,
                            HdError *error) {
    *text = malloc(most + 1);
    if (*text == NULL)
        return HD_NO_ROOM(error, "the scene");
    *size = fread(*text, 1, most + 1, stream);
    if (hd_interrupt_signal() != 0)
        return hd_fail(error, HD_INTERRUPTED, "interrupted while reading %s", name);
    if (ferror(stream))
        return hd_fail(error, stream == stdin ? HD_FAILED : HD_BAD_INPUT, "cannot read %s: %s",
                       name, strerror(errno));
    if (*size > most)
        return hd_fail(error, HD_BAD_INPUT, "%s is longer than %zu bytes", name, most);
    return HD_OK;
}

HdStatus hd_read_classic(HdSceneFile *file, const char *path, int variant, HdError *error) {
    const char *name = hd_scene_name(path);
    char *text = NULL;
    size_t size = 0;
    FILE *stream = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    HdStatus status =
        stream != NULL ? read_stream(stream, name, MAX_INPUT_BYTES, &text, &size, error)
                       : hd_fail(error, HD_BAD_INPUT, "cannot open %s: %s", name, strerror(errno));
    if (status == HD_OK)
        status = hd_classic_parse(file, text, size, name, variant, error);
    if (stream != NULL && stream != stdin)
        fclose(stream);
    free(text);
    return status;
}

HdStatus hd_read_scene(HdSceneFile *file, const char *path, const HdSceneSource *source,
                       HdError *error) {
    HdSceneSource named = *source;
    HdStatus status = HD_OK;
    char *read = NULL;
    size_t size = 0;
    if (path != NULL && strcmp(path, "-") != 0)
        return hd_scene_file_read(file, path, source, error);
    named.name = hd_scene_name(path);
    const char *text = hd_default_scene_text(&size);
    if (path != NULL) {
        status = read_stream(stdin, standard_input, HD_MAX_SCENE_BYTES, &read, &size, error);
        text = read;
    }
    if (status == HD_OK)
        status = hd_scene_file_parse(file, text, size, &named, error);
    free(read);
    return status;
}

static void set_numbers(HdScene *scene, const HdScenePlan *plan) {
    if (plan->size.width > 0) {
        scene->width = plan->size.width;
        scene->height = plan->size.height;
    }
    if (plan->samples > 0) {
        scene->samples_per_side = plan->samples;
        scene->sample_rows = 0;
    }
    if (plan->max_error > 0.0)
        scene->max_error = plan->max_error;
}

static HdStatus crop(HdScene *scene, const HdPlannedArea *part, HdError *error) {
    if (part->left + part->width > scene->width || part->top + part->height > scene->height)
        return hd_fail(error, HD_BAD_INPUT, "the area ends outside the picture of %d x %d pixels",
                       scene->width, scene->height);
    scene->crop = (HdCrop){scene->width, scene->height, part->left, part->top};
    scene->width = part->width;
    scene->height = part->height;
    return HD_OK;
}

HdStatus hd_scene_apply_numbers(HdScene *scene, const HdScenePlan *plan, HdError *error) {
    set_numbers(scene, plan);
    HdStatus status = plan->given[0] != '\0' ? hd_scene_validate(scene, error) : HD_OK;
    if (status == HD_OK && plan->crop.width > 0)
        status = crop(scene, &plan->crop, error);
    if (status != HD_OK) {
        hd_error_prefix(error, plan->given);
        return status;
    }
    if (plan->sampling >= 0)
        scene->sampling = (HdSampling)plan->sampling;
    hd_bound_pass_end_rays(scene);
    if (plan->depth >= 0)
        scene->depth = plan->depth;
    if (plan->cutoff >= 0.0)
        scene->cutoff = plan->cutoff;
    return HD_OK;
}

static HdStatus apply_geometry(HdScene *scene, const HdScenePlan *plan, HdError *error) {
    scene->accel = plan->accel;
    if (plan->geometry == HD_GEOMETRY_SOLIDS && plan->divisions > 0)
        return hd_fail(error, HD_BAD_INPUT, "--divisions needs --geometry triangles");
    hd_scene_separate_contacts(scene);
    HD_TRY(hd_scene_nest(scene, error));
    if (plan->geometry == HD_GEOMETRY_SOLIDS)
        return HD_OK;
    return hd_scene_triangulate(scene, DISC_SIDES, plan->divisions > 0 ? plan->divisions : 1,
                                error);
}

HdStatus hd_load_scene(HdSceneFile *file, const HdScenePlan *plan, HdProblems *notes,
                       HdError *error) {
    const HdSceneSource source = {.folder = "",
                                  .changes = plan->changes,
                                  .change_count = plan->change_count,
                                  .is_strict = plan->strict_files,
                                  .loads_files = true,
                                  .file_notes = notes};
    HdStatus status = plan->is_classic ? hd_read_classic(file, "-", plan->variant, error)
                                       : hd_read_scene(file, plan->path, &source, error);
    if (status != HD_OK && notes != NULL)
        *notes = (HdProblems){.count = 0};
    HD_TRY(status);
    status = hd_scene_apply_numbers(&file->scene, plan, error);
    if (status == HD_OK && plan->is_classic)
        status = hd_scene_file_load_texture(file, notes, error);
    if (status == HD_OK)
        status = apply_geometry(&file->scene, plan, error);
    if (status != HD_OK)
        hd_scene_file_free(file);
    return status;
}
