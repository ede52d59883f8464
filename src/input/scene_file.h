/* SPDX-License-Identifier: MIT */
/* What a scene file (docs/reference/scene.md) tells, and how it is read. */
#ifndef HD_INPUT_SCENE_FILE_H
#define HD_INPUT_SCENE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include "base/error.h"
#include "image/curve.h"
#include "image/format.h"
#include "scene/scene.h"
#include "system/path.h"

enum { HD_DEFAULT_FRAMES_PER_SECOND = 30, HD_MAX_FRAMES_PER_SECOND = 240 };

/* What becomes of the frames. */
typedef struct HdOutputSettings {
    char path[HD_MAX_PATH]; /* empty: not said */
    HdOutputStyle style;
} HdOutputSettings;

/* Which normals a mesh has. */
typedef enum HdMeshNormals {
    HD_NORMALS_FILE, /* those of its file, else it is flat */
    HD_NORMALS_FLAT,
    HD_NORMALS_SMOOTH /* hd_mesh_smooth makes them */
} HdMeshNormals;

/* A mesh in its place, as the scene file tells it. Entries that agree in file, normals and crease
   share a mesh. */
typedef struct HdMeshEntry {
    char *file; /* owned; ready to open, "~" aside */
    HdMeshNormals normals;
    double crease_degrees; /* of smooth normals */
    HdInstance instance;   /* but for the number of its mesh */
} HdMeshEntry;

typedef struct HdSceneFile {
    int version;              /* of the format, of which there is one */
    char schema[HD_MAX_PATH]; /* where the JSON Schema is, for editors; empty: not said */
    HdScene scene;            /* hd_scene_file_load_texture loads the floor's texture, and
                                 hd_scene_file_load_meshes the meshes, their instances and pictures */
    int mesh_entry_count;
    HdMeshEntry *mesh_entries; /* owned */
    HdOutputSettings output;
    char texture_path[HD_MAX_PATH]; /* empty: none; ready to open, "~" aside */
    HdCurve texture_curve;
} HdSceneFile;

/* One "--set" of the command line, "camera.field_of_view=40": the value is JSON, or, where it is
   not, a string. What holds the value must be there, but for "image", "camera" and "output". */
typedef const char *HdSceneChange;

typedef struct HdSceneSource {
    const char *name;   /* for messages */
    const char *folder; /* where relative paths of files count from; "": the current one */
    const HdSceneChange *changes; /* applied before anything is checked; messages name them */
    int change_count;
    bool loads_files; /* the texture and the meshes; tells what is wrong with them along with the
                         rest */
    HdProblems *file_notes; /* gets what of the files of meshes is not used, where they are loaded;
                               NULL: nothing does */
    HdProblems *notes;      /* gets what is seldom meant (notes.h), and the whole sequence is
                               checked; NULL: neither */
} HdSceneSource;

static inline void hd_scene_file_free(HdSceneFile *file) {
    for (int i = 0; i < file->mesh_entry_count; i++)
        free(file->mesh_entries[i].file);
    free(file->mesh_entries);
    hd_scene_free(&file->scene);
    *file = (HdSceneFile){.version = 0};
}

enum { HD_MAX_SCENE_BYTES = 32 << 20 };

/* Reads a scene from `size` bytes of JSON, fills in every default, and checks all of it. Messages
   begin with the name and tell every problem: with line and column where the text is not JSON or
   repeats a key, otherwise with the JSON path, as "solids[1].circumradius is -1, expected ...",
   behind "--set CHANGE: " where a change brought the value. On failure `file` is left empty. */
HdStatus hd_scene_file_parse(HdSceneFile *file, const char *text, size_t size,
                             const HdSceneSource *source, HdError *error);

/* The same from a file of at most HD_MAX_SCENE_BYTES, which gives the name and the folder. */
HdStatus hd_scene_file_read(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error);

#endif
