/* SPDX-License-Identifier: MIT */
/* What of a material library fast_obj gets to see: whole and well-formed statements that it knows,
   with the values that it would get wrong put right. */
#ifndef HD_MESH_OBJ_MTL_TEXT_H
#define HD_MESH_OBJ_MTL_TEXT_H

#include "base/problems.h"
#include "mesh/obj/memory.h"
#include "mesh/obj/words.h"

/* The value of `illum` for a material that has none. */
enum { HD_MTL_NO_ILLUM = -1 };

/* What the name of a texture begins with, lest fast_obj takes its first sign for an option. */
#define HD_MTL_HERE "./"

typedef struct HdMtlSource {
    const char *path;   /* for notes */
    const char *folder; /* what the names of its textures are to begin with: empty or "folder/" */
    HdSpan text;
} HdMtlSource;

/* Makes the text for fast_obj, of which `*size` bytes are the memory's. `illum` stands as the first
   number of Kt, since fast_obj reads every illum as 0. Materials start with HD_MTL_NO_ILLUM and a
   shininess of 64; Tr becomes d; names of textures count from the OBJ file's
   folder and begin with HD_MTL_HERE. What is left out is told in `notes`, each kind of statement
   once. NULL: the memory does not suffice. */
char *hd_mtl_clean(const HdMtlSource *source, HdObjMemory *memory, HdProblems *notes, size_t *size);

#endif
