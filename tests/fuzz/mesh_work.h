/* SPDX-License-Identifier: MIT */
#ifndef HD_MESH_WORK_H
#define HD_MESH_WORK_H

/* Reads the mesh at the path in 64 MiB, smooths it and builds its hierarchy, as loading a scene
   does, and ends the process where the mesh is not sound. */
void fuzz_read_mesh(const char *path);

#endif
