/* SPDX-License-Identifier: MIT */
/* Whether the files of a scene are other than before. */
#ifndef HD_VIEW_WATCH_H
#define HD_VIEW_WATCH_H

#include <stdint.h>

#include "input/scene_file.h"

/* A number that changes when one of the files is written or replaced: that of the scene (NULL:
   none), and its texture and meshes. */
uint64_t hd_watch_files(const char *path, const HdSceneFile *file);

#endif
