/* SPDX-License-Identifier: MIT */
/* Materials of MTL files as ours. */
#ifndef HD_MESH_OBJ_MATERIAL_H
#define HD_MESH_OBJ_MATERIAL_H

#include "base/error.h"
#include "mesh/mesh.h"

/* The value of `illum` for a material that has none. */
enum { HD_MTL_NO_ILLUM = -1 };

/* The parameters that count, named as in the file. */
typedef struct HdMtlParameters {
    float Ka[3], Kd[3], Ks[3], Ke[3], Tf[3];
    float Ns, Ni, d;
    int illum; /* or HD_MTL_NO_ILLUM */
} HdMtlParameters;

/* A material without any: white and opaque. */
extern const HdMtlParameters hd_mtl_defaults;

/* Fills all of `material` but its name and its texture, by the table in docs/formats.md. Values
   that had to be changed to be legal are told in `notes`, whose lines begin with `place`. */
void hd_mtl_material(const HdMtlParameters *from, HdMeshMaterial *material, const char *place,
                     HdProblems *notes);

#endif
