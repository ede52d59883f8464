/* SPDX-License-Identifier: MIT */
/* Short ways to make meshes. For want of memory they end the program: see hd_golden_build. */
#ifndef HD_VERIFY_MESH_BUILDER_H
#define HD_VERIFY_MESH_BUILDER_H

#include "scene/scene.h"

/* Makes room in a scene; the caller frees it with the scene. */
void build_meshes(HdScene *scene, int meshes, int instances, int pictures);

/* A closed sphere of radius 1 in `rows` rings of 2 rows triangles each, pushed in and out by up to
   `bump`; `smooth` gives it normals, `mapped` texture coordinates. One material. */
void build_sphere_mesh(HdMesh *mesh, int rows, double bump, bool smooth, bool mapped,
                       const HdMaterial *material);

/* A cube from -1 to 1, of 12 triangles; faces 0 and 1 have the second material. */
void build_cube_mesh(HdMesh *mesh, const HdMaterial *first, const HdMaterial *second);

/* Places a mesh; the same scale for every axis. */
void build_instance(HdScene *scene, int index, int mesh, HdVec3 position, HdVec3 rotation,
                    double scale);

/* Builds the hierarchies of all meshes. */
void finish_meshes(HdScene *scene);

#endif
