/* SPDX-License-Identifier: MIT */
/* Scenes as JSON (docs/formats.md). One table of fields (scene_fields.h) drives the reader, the
   writer and the JSON Schema. */
#ifndef HD_SCENE_FILE_H
#define HD_SCENE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "curve.h"
#include "outputs.h"
#include "paths.h"
#include "scene.h"

enum {
    HD_MAX_SCENE_BYTES = 32 << 20,
    HD_DEFAULT_FRAMES_PER_SECOND = 30,
    HD_MAX_FRAMES_PER_SECOND = 240
};

/* What becomes of the frames. */
typedef struct HdOutputSettings {
    char path[HD_MAX_PATH]; /* empty: not said */
    HdOutputStyle style;
} HdOutputSettings;

typedef struct HdSceneFile {
    char schema[HD_MAX_PATH]; /* where the JSON Schema is, for editors; empty: not said */
    HdScene scene;            /* the floor's texture is loaded by hd_scene_file_load_texture */
    HdOutputSettings output;
    char texture_path[HD_MAX_PATH]; /* empty: none; ready to open, "~" aside */
    HdCurve texture_curve;
} HdSceneFile;

/* One "--set" of the command line, "camera.field_of_view=40": the value is JSON, or, where it is
   not, a string. What holds the value must be there, but for "image", "camera" and "output". */
typedef const char *HdSceneChange;

typedef struct HdSceneSource {
    const char *name;   /* for messages */
    const char *folder; /* where a relative path of a texture counts from; "": the current one */
    const HdSceneChange *changes; /* applied before anything is checked; messages name them */
    int change_count;
    bool loads_texture; /* and tells what is wrong with it along with the rest */
    HdProblems *notes;  /* gets what is seldom meant (scene_notes.h), and the whole sequence is
                           checked; NULL: neither */
} HdSceneSource;

/* Reads a scene from `size` bytes of JSON, fills in every default, and checks all of it. Messages
   begin with the name and tell every problem: with line and column where the text is not JSON or
   repeats a key, otherwise with the JSON path, as "solids[1].circumradius is -1, expected ...",
   behind "--set CHANGE: " where a change brought the value. On failure `file` is left empty. */
HdStatus hd_scene_file_parse(HdSceneFile *file, const char *text, size_t size,
                             const HdSceneSource *source, HdError *error);

/* The same from a file of at most HD_MAX_SCENE_BYTES, which gives the name and the folder. */
HdStatus hd_scene_file_read(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error);

/* Reads the texture that the scene names, if any: the embedded "builtin:floor", or a file. */
HdStatus hd_scene_file_load_texture(HdSceneFile *file, HdError *error);

/* Writes a scene, which must be valid, as JSON that reads back as the same scene, number for number
   (only a point light beyond 2^39 may come back a rounding off). Materials get names: "solid_1",
   "rim_1", "floor". Fails with HD_BAD_INPUT where a path is not UTF-8. */
HdStatus hd_scene_file_print(FILE *out, const HdSceneFile *file, HdError *error);

/* Writes the JSON Schema (draft 2020-12) of the format. */
HdStatus hd_scene_schema_print(FILE *out, HdError *error);

void hd_scene_file_free(HdSceneFile *file);

#endif
