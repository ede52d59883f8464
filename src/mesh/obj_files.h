/* SPDX-License-Identifier: MIT */
/* Files that OBJ and MTL files name. A backslash in a name counts as a slash. */
#ifndef HD_MESH_OBJ_FILES_H
#define HD_MESH_OBJ_FILES_H

#include "mesh/obj_reading.h"

/* Returns the expected form of a file name, which must stay in its folder or below; NULL: it
   does. */
const char *hd_obj_file_name_fault(HdSpan name);

/* Returns the folder of a path with its last slash, or nothing. */
HdSpan hd_obj_folder(HdSpan path);

/* A folder, and one below it that the name is relative to; each empty or with a final slash. */
typedef struct HdObjPlace {
    HdSpan base, folder;
} HdObjPlace;

/* Returns the path of a name; hd_obj_release() frees it. NULL: out of memory. */
char *hd_obj_path(HdObjMemory *memory, const HdObjPlace *place, HdSpan name);

/* Returns whether there is a regular file of the name, in quotes or with a comment behind it or
   neither. */
bool hd_obj_has_file(HdObjMemory *memory, const HdObjPlace *place, HdSpan name);

/* Finds such a file. If there is none, sets `*is_elsewhere` and looks for the last parts of the
   name, the longest first, in the folder and in the base, at last in other letter case. So a name
   from another machine finds the copy beside the mesh, and no name leaves the base. Returns the
   path as hd_obj_path, or NULL. */
char *hd_obj_find_file(HdObjMemory *memory, const HdObjPlace *place, HdSpan name,
                       bool *is_elsewhere);

#endif
