/* SPDX-License-Identifier: MIT */
/* The objects of a scene that light may pass through, by shells (mesh/shells.h). */
#ifndef HD_SCENE_MEDIA_H
#define HD_SCENE_MEDIA_H

#include "mesh/hierarchy.h"
#include "scene/scene.h"
#include "scene/shell_gap.h"

/* The triangles of a shell that let rays pass. */
typedef struct HdMedium {
    bool is_clear; /* there are such */
    double index;  /* their index of refraction; NaN: several */
} HdMedium;

/* A mesh, or the faces of a solid. */
typedef struct HdMediumModel {
    const HdMesh *mesh;
    HdShells *shells;
    HdMedium *media; /* owned; of the mesh's own materials, by shell */
} HdMediumModel;

/* A solid, or an instance that lets rays pass. */
typedef struct HdMediumObject {
    const HdSolid *solid;       /* NULL: an instance */
    int number;                 /* of the solid or the instance */
    const HdMaterial *material; /* of all triangles; NULL: the mesh's own ones */
    HdMediumModel *model;       /* NULL without clear instances */
    HdPlacedMesh placed;
    HdVec3 lower, upper; /* box in the world */
} HdMediumObject;

typedef struct HdMedia {
    const HdScene *scene;
    int object_count;
    HdMediumObject *objects; /* the solids come first */
    HdMediumModel *models;   /* of the meshes, then of the solids */
    HdMesh *solids;          /* faces of the solids */
    HdShells *of_solids;
    HdHierarchy tree;   /* over the objects */
    HdThreadPool *pool; /* one thread */
} HdMedia;

/* Returns whether a material, or one of an instance's, refracts. */
bool hd_refracts(const HdMaterial *material);
bool hd_instance_refracts(const HdScene *scene, int number);

/* Returns whether anything has an index other than 1, opaque solids included. */
bool hd_has_media(const HdScene *scene);

/* Finds the objects of the scene, which must outlive them, and fills the shells of its meshes
   (`shells`, empty ones, one for each). HD_FAILED: no memory. To be freed also after a failure. */
HdStatus hd_media_find(HdMedia *media, const HdScene *scene, HdShells *shells, HdError *error);

void hd_media_free(HdMedia *media);

#endif
