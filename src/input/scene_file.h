/* SPDX-License-Identifier: MIT */
/* Contents of a scene file (docs/reference/scene.md), and its reader. */
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

/* Output of the frames. */
typedef struct HdOutputSettings {
    char path[HD_MAX_PATH]; /* empty: not given */
    HdOutputStyle style;
} HdOutputSettings;

/* Normals of a mesh. */
typedef enum HdMeshNormals {
    HD_NORMALS_FILE, /* those of its file, else flat */
    HD_NORMALS_FLAT,
    HD_NORMALS_SMOOTH /* made by hd_mesh_smooth */
} HdMeshNormals;

/* A placed mesh of a scene file. Entries that agree in file, normals, crease and ambient share a
   mesh. */
typedef struct HdMeshEntry {
    char *file; /* owned; path to open, "~" not expanded */
    HdMeshNormals normals;
    double crease_degrees; /* crease angle of smooth normals */
    double ambient;        /* factor of the file's Ka */
    double size;           /* 0: none; the instances of the scene are fitted to it
                              (hd_instance_fit) */
    HdInstance instance;   /* instance without the index of its mesh, not fitted */
} HdMeshEntry;

typedef struct HdSceneFile {
    int version;              /* format version; there is one */
    char schema[HD_MAX_PATH]; /* location of the JSON Schema, for editors; empty: not given */
    HdScene scene;            /* hd_scene_file_load_texture loads the floor's texture,
                                 hd_scene_file_load_environment the environment's,
                                 hd_scene_file_load_meshes the meshes, instances and pictures */
    int mesh_entry_count;
    HdMeshEntry *mesh_entries; /* owned */
    bool is_strict;            /* as in HdSceneSource */
    HdOutputSettings output;
    char texture_path[HD_MAX_PATH]; /* path to open, "~" not expanded; empty: none */
    HdCurve texture_curve;
} HdSceneFile;

/* A "--set" of the command line, "camera.field_of_view=40"; the value is JSON, or else a string.
   The parent object must exist, except "image", "camera" and "output". */
typedef const char *HdSceneChange;

typedef struct HdSceneSource {
    const char *name;             /* name in messages */
    const char *folder;           /* base of relative paths; "": the current folder */
    const HdSceneChange *changes; /* applied before any check; messages name them */
    int change_count;
    bool is_strict;         /* refuse files with faults that readers could pass over */
    bool loads_files;       /* load textures and meshes, and report problems with them */
    HdProblems *file_notes; /* notes on unused contents of loaded mesh files; NULL: none */
    HdProblems *notes; /* notes of notes.h and of a check of the whole sequence; NULL: neither */
} HdSceneSource;

static inline void hd_scene_file_free(HdSceneFile *file) {
    for (int i = 0; i < file->mesh_entry_count; i++)
        free(file->mesh_entries[i].file);
    free(file->mesh_entries);
    hd_scene_free(&file->scene);
    *file = (HdSceneFile){.version = 0};
}

enum { HD_MAX_SCENE_BYTES = 32 << 20 };

/* Reads a scene from `size` bytes of JSON, fills in defaults, and checks it. The error begins with
   the name and lists all problems. Invalid JSON and repeated keys have line and column. Other
   problems have a JSON path, as in "solids[1].circumradius is -1, expected ...", after "--set
   CHANGE: " if a change set the value. On failure `file` is empty. */
HdStatus hd_scene_file_parse(HdSceneFile *file, const char *text, size_t size,
                             const HdSceneSource *source, HdError *error);

/* Reads a file of at most HD_MAX_SCENE_BYTES, which supplies name and folder. */
HdStatus hd_scene_file_read(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error);

#endif
