/* SPDX-License-Identifier: MIT */
#include "input/scene_file.h"

#include <stdlib.h>

void hd_scene_file_free(HdSceneFile *file) {
    for (int i = 0; i < file->mesh_entry_count; i++)
        free(file->mesh_entries[i].file);
    free(file->mesh_entries);
    hd_scene_free(&file->scene);
    *file = (HdSceneFile){.schema = ""};
}
