/* SPDX-License-Identifier: MIT */
/* Temporary files of earlier runs that were killed. */
#ifndef HD_OUTPUT_STALE_FILES_H
#define HD_OUTPUT_STALE_FILES_H

#include "output/outputs.h"
#include "scene/frame_list.h"

/* Removes the temporary files (atomic_file.h) of these frames' outputs whose writer is gone. Those
   of a living process stay, for it has them locked: on other machines too where the file system
   shares its locks. What cannot be looked at or removed stays too. */
void hd_stale_files_remove(const HdOutputPlan *plan, const HdFrameList *frames);

#endif
