/* SPDX-License-Identifier: MIT */
/* The materials of an OBJ file from the libraries that it names. */
#ifndef HD_MESH_OBJ_LIBRARIES_H
#define HD_MESH_OBJ_LIBRARIES_H

#include "mesh/mesh.h"
#include "mesh/obj/text.h"

/* Gives the mesh a material for each name of the text, which is taken from there: as its libraries
   define it or, where none does, white and opaque. What is not used is told in the text's notes.
   False: the memory does not suffice. */
bool hd_obj_read_materials(HdObjText *text, HdMesh *mesh);

#endif
