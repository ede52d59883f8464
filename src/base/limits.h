/* SPDX-License-Identifier: MIT */
/* What the values of a scene may be at most and at least. The kernels work in float. Within these
   limits no product of a distance, a coefficient, an intensity and the exposure leaves its range,
   so neither infinity nor NaN can come up. */
#ifndef HD_BASE_LIMITS_H
#define HD_BASE_LIMITS_H

enum {
    HD_MAX_SOLIDS = 256,
    HD_MAX_LIGHTS = 100000, /* point lights and edge lights together */
    HD_MAX_DEPTH = 1000,
    HD_MAX_SAMPLES_PER_SIDE = 64,
    HD_MAX_IMAGE_SIDE = 65535,
    HD_MAX_IMAGE_PIXELS = 1 << 29, /* 6 GiB as floats */
    HD_MAX_TEXTURE_SIDE = 65535,
    HD_MAX_SHININESS = 65536,
    HD_MAX_FRAMES = 10000000,
    HD_MAX_OUTPUTS = 8,        /* of a run */
    HD_MAX_DIVISIONS = 1000,   /* of the side of a triangle */
    HD_MAX_INSTANCES = 100000, /* meshes in their places */
    HD_MAX_EDGE_COLOURS = 30   /* the edges of a dodecahedron */
};

/* Files of meshes and their textures take at most one of so many parts of the machine's memory
   while they are read, so that the scene's tables, which are about as large, find room as well; and
   never more than this, lest a wrong file keep a large machine busy. */
#define HD_MESH_MEMORY_PART 2
#define HD_MAX_MESH_MEMORY  68719476736.0 /* bytes */

#define HD_MIN_LENGTH              1e-12
#define HD_MAX_NUMBER              1e12 /* coordinates, lengths, light */
#define HD_MAX_COEFFICIENT         1e6
#define HD_MAX_EXPOSURE            1e6
#define HD_MAX_ERROR               255.0 /* steps of 255 */
#define HD_MIN_ERROR               1e-3  /* but for 0: bounds have steps of their own */
#define HD_MAX_FIELD_OF_VIEW       179.0 /* degrees */
#define HD_MAX_ROTATION            1e6   /* degrees, either way */
#define HD_MIN_INDEX_OF_REFRACTION 0.1
#define HD_MAX_INDEX_OF_REFRACTION 10.0

#endif
