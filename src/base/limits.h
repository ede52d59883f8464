/* SPDX-License-Identifier: MIT */
/* Limits of a scene's values. The kernels work in float: within these limits no product of a
   distance, a coefficient, an intensity and the exposure overflows. Infinity and NaN cannot
   occur. */
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
    HD_MAX_OUTPUTS = 8,        /* outputs of a run */
    HD_MAX_DIVISIONS = 1000,   /* divisions of a triangle's side */
    HD_MAX_INSTANCES = 100000, /* meshes placed in a scene */
    HD_MAX_EDGE_COLOURS = 30   /* edges of a dodecahedron */
};

/* Reading meshes and their textures takes at most one HD_MESH_MEMORY_PART-th of the machine's
   memory. The rest is for the scene's tables, which are about as large. The absolute limit keeps a
   wrong file from occupying a large machine. */
#define HD_MESH_MEMORY_PART 2
#define HD_MAX_MESH_MEMORY  68719476736.0 /* bytes */

#define HD_MIN_LENGTH              1e-12
#define HD_MAX_NUMBER              1e12 /* coordinates, lengths, light */
#define HD_MAX_COEFFICIENT         1e6
#define HD_MAX_EXPOSURE            1e6
#define HD_MAX_ERROR               255.0 /* in 1/255 of white */
#define HD_MIN_ERROR               1e-3  /* or 0; bounds are quantised */
#define HD_MAX_FIELD_OF_VIEW       179.0 /* degrees */
#define HD_MAX_ROTATION            1e6   /* degrees, in either direction */
#define HD_MIN_INDEX_OF_REFRACTION 0.1
#define HD_MAX_INDEX_OF_REFRACTION 10.0

#endif
