/* SPDX-License-Identifier: MIT */
/* The meshes of the hunt. All have one material and are not built yet; their coordinates are those
   of the eye, which looks along y with x to the right. The eye's ray through a pixel is
   hunt_pixel_ray. */
#ifndef HD_LEAK_HUNT_MESH_MATERIALS_H
#define HD_LEAK_HUNT_MESH_MATERIALS_H

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

/* Half the picture's width at distance 1. */
#define HUNT_TANGENT 0.5

/* Pixels to the right of and below the rim; as many more lie on the other sides. */
enum { HUNT_RIM = 8 };

/* Returns the ray as far as y = 1; pixels count from the top left one. */
HdVec3 hunt_pixel_ray(int side, int x, int y);

/* Returns zeroed memory, or ends the program. */
void *hunt_allocate(size_t count, size_t size);

typedef enum HuntMeshMaterial {
    MATERIAL_SHEETS, /* two sheets, about y = 2 and y = 3, joined at y = 2.5 */
    MATERIAL_ROOM,   /* a room about the eye, whose far wall is as rough as the back sheet */
    MATERIAL_WEDGE   /* a smooth one whose floor and ceiling meet at 10 degrees at y = 2.5 */
} HuntMeshMaterial;

/* Makes a surface; `roughness` is in pixels. */
void build_mesh_material(HdMesh *mesh, HuntMeshMaterial mesh_material, int side, double roughness,
                         const HdMaterial *material, uint64_t *random);

/* Makes a small triangle at y = `depth` in the middle of each chosen pixel. */
void build_spots(HdMesh *mesh, int side, const bool *chosen, double depth,
                 const HdMaterial *material);

/* Makes one in all pixels, with normals that mirror the eye's ray to an edge or corner of `target`,
   whose vertices are rotated by `rotation_degrees`. */
void build_mirrors(HdMesh *mesh, int side, double depth, const HdMesh *target,
                   HdVec3 rotation_degrees, const HdMaterial *material, uint64_t *random);

#endif
