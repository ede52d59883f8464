/* SPDX-License-Identifier: MIT */
#include "cli/load_scene.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/builtin.h"
#include "input/check.h"
#include "input/load.h"
#include "render/survey.h"
#include "scene/contact.h"
#include "scene/triangulate.h"
#include "system/interrupt.h"

/* Far above any classic input, and small enough to read into memory without a thought. */
enum { MAX_INPUT_BYTES = 1 << 20 };

/* Of the discs of edge lights, where they become polygons. */
enum { DISC_SIDES = 16 };

/* What a reference has where nothing else was asked for. */
enum { REFERENCE_SAMPLES = 32 };
#define REFERENCE_ERROR (1.0 / 64.0)

static const char standard_input[] = "standard input";

static HdStatus read_stream(FILE *stream, const char *name, char *text, size_t most, size_t *size,
                            HdError *error) {
    *size = fread(text, 1, most + 1, stream);
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
    const char *name = path != NULL ? path : standard_input;
    size_t size = 0;
    char *text = malloc(MAX_INPUT_BYTES + 1);
    if (text == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the input");
    FILE *stream = path != NULL ? fopen(path, "rb") : stdin;
    HdStatus status =
        stream != NULL ? read_stream(stream, name, text, MAX_INPUT_BYTES, &size, error)
                       : hd_fail(error, HD_BAD_INPUT, "cannot open %s: %s", name, strerror(errno));
    if (status == HD_OK)
        status = hd_classic_parse(file, text, size, name, variant, error);
    if (stream != NULL && stream != stdin)
        fclose(stream);
    free(text);
    return status;
}

static HdStatus read_standard_input(HdSceneFile *file, const HdSceneSource *source,
                                    HdError *error) {
    size_t size = 0;
    char *text = malloc(HD_MAX_SCENE_BYTES + 1);
    if (text == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the scene");
    HdStatus status = read_stream(stdin, source->name, text, HD_MAX_SCENE_BYTES, &size, error);
    if (status == HD_OK)
        status = hd_scene_file_parse(file, text, size, source, error);
    free(text);
    return status;
}

const char *hd_operand_name(const char *operand) {
    return strcmp(operand, "-") == 0 ? standard_input : operand;
}

HdStatus hd_read_scene_file(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error) {
    HdSceneSource named = *source;
    named.name = standard_input;
    named.folder = "";
    return strcmp(path, "-") == 0 ? read_standard_input(file, &named, error)
                                  : hd_scene_file_read(file, path, source, error);
}

static HdStatus crop(HdScene *scene, const HdOptions *options, HdError *error) {
    if (options->crop.width == 0)
        return HD_OK;
    if (options->crop.left + options->crop.width > scene->width ||
        options->crop.top + options->crop.height > scene->height)
        return hd_fail(error, HD_BAD_INPUT, "the picture has %d x %d pixels, which end before that",
                       scene->width, scene->height);
    scene->crop = (HdCrop){scene->width, scene->height, options->crop.left, options->crop.top};
    scene->width = options->crop.width;
    scene->height = options->crop.height;
    return HD_OK;
}

static void set_numbers(HdScene *scene, const HdOptions *options) {
    if (options->size.width > 0) {
        scene->width = options->size.width;
        scene->height = options->size.height;
    }
    if (options->samples > 0)
        scene->samples_per_side = options->samples;
    if (options->depth >= 0)
        scene->depth = options->depth;
    if (options->cutoff >= 0.0)
        scene->cutoff = options->cutoff;
    if (options->max_error > 0.0)
        scene->max_error = options->max_error;
    if (options->sampling >= 0)
        scene->sampling = (HdSampling)options->sampling;
}

/* What follows from the error that is allowed: nothing else cuts rays off. */
static void set_by_error(HdScene *scene, const HdOptions *options) {
    if (options->reference) {
        scene->sampling = HD_SAMPLING_REFERENCE;
        if (options->samples == 0)
            scene->samples_per_side = REFERENCE_SAMPLES;
        if (options->max_error == 0.0)
            scene->max_error = REFERENCE_ERROR;
    }
    if (!(scene->max_error > 0.0))
        return;
    if (options->depth < 0)
        scene->depth = hd_survey_depth(scene);
    if (options->cutoff < 0.0)
        scene->cutoff = 0.0;
}

HdStatus hd_apply_scene_options(HdScene *scene, const HdOptions *options, HdError *error) {
    char given[256];
    hd_options_spell(options, false, given, sizeof given);
    set_numbers(scene, options);
    HdStatus status = given[0] != '\0' ? hd_scene_validate(scene, error) : HD_OK;
    if (status == HD_OK)
        status = crop(scene, options, error);
    if (status != HD_OK)
        hd_error_prefix(error, given);
    else
        set_by_error(scene, options);
    return status;
}

HdStatus hd_apply_geometry(HdScene *scene, const HdOptions *options, HdError *error) {
    int divisions = options->divisions > 0 ? options->divisions : 1;
    scene->accel = options->accel;
    if (options->geometry == HD_GEOMETRY_SOLIDS && options->divisions > 0)
        return hd_fail(error, HD_BAD_INPUT, "--divisions needs --geometry triangles");
    hd_scene_part_contacts(scene);
    if (options->geometry == HD_GEOMETRY_SOLIDS)
        return HD_OK;
    return hd_scene_triangulate(scene, DISC_SIDES, divisions, error);
}

static HdStatus read_default(HdSceneFile *file, const HdSceneSource *source, HdError *error) {
    size_t size;
    const char *text = hd_default_scene_text(&size);
    return hd_scene_file_parse(file, text, size, source, error);
}

HdStatus hd_read_scene(HdSceneFile *file, const HdOptions *options, HdError *error) {
    HdProblems notes = {.count = 0};
    const HdSceneSource source = {.name = hd_scene_name(options),
                                  .folder = "",
                                  .changes = options->changes,
                                  .change_count = options->change_count,
                                  .loads_files = true,
                                  .file_notes = &notes};
    HdStatus status = options->operand_count > 0
                          ? hd_read_scene_file(file, options->operands[0], &source, error)
                          : read_default(file, &source, error);
    if (status != HD_OK)
        return status;
    if (!options->quiet)
        hd_problems_print(&notes, stderr, "hedron", ": ");
    status = hd_apply_scene_options(&file->scene, options, error);
    if (status == HD_OK)
        status = hd_apply_geometry(&file->scene, options, error);
    if (status != HD_OK)
        hd_scene_file_free(file);
    return status;
}

const char *hd_scene_name(const HdOptions *options) {
    return options->operand_count > 0 ? hd_operand_name(options->operands[0])
                                      : "the built-in scene";
}
