/* SPDX-License-Identifier: MIT */
/* What a material library says, statement by statement: each is checked and kept in one go. */
#ifndef HD_MESH_OBJ_MTL_TEXT_H
#define HD_MESH_OBJ_MTL_TEXT_H

#include "base/error.h"
#include "mesh/obj/material.h"
#include "mesh/obj/names.h"

typedef struct HdMtlDefinition {
    HdMtlParameters parameters;
    char *texture; /* owned; NULL: none */
    bool is_defined;
} HdMtlDefinition;

/* The materials that a mesh names. */
typedef struct HdMtlDefinitions {
    const HdNameTable *names;
    HdMtlDefinition *of; /* for each name */
    int32_t *order;      /* the numbers of those that are defined, in the order of the libraries */
    int count;
} HdMtlDefinitions;

typedef struct HdMtlSource {
    const char *path;   /* for notes */
    HdSpan text;        /* all of it */
    HdSpan mesh_folder; /* what paths of textures begin with, */
    HdSpan folder;      /* and go on with: each empty, or with a slash at its end */
} HdMtlSource;

/* Takes the definitions of materials that are named and not defined yet, with all parameters that
   they do not give as in hd_mtl_defaults; Tr becomes d. What is left out is told in `notes`, each
   kind of statement once. False: the memory does not suffice. */
bool hd_mtl_read(const HdMtlSource *source, HdMtlDefinitions *definitions, HdObjMemory *memory,
                 HdProblems *notes);

#endif
