/* SPDX-License-Identifier: MIT */
/* Scenes in which the ray of every pixel, and its shadow ray, is aimed at an edge or a corner of a
   closed mesh. The pixels show how often each ray crossed it.

   The sheets: a closed surface of a front and a back sheet. Their vertices lie on the rays of every
   second pixel in both directions, at random depths. So an even pixel of an even row looks at a
   corner, the others at a horizontal, vertical or diagonal edge, and all look at two surfaces. The
   surfaces transmit half of the light and do nothing else. Behind them are things of a known
   radiance, lit by one light at the eye, so that shadow rays return through the same edges. The
   radiance of the pixels is 2^-crossings of that without the sheets. At the rim, where the sheets
   meet, a ray may cross nothing or both of them.

   The mirrors: a wall of little mirrors, one for each pixel, reflects the eye's rays to corners and
   edges of a sphere about the eye, chosen at random: no two rays of a packet have one direction.

   The room: mirrors all about the eye, rough in front, so that a ray reflected beside an edge hits
   the next surface at once. None may escape.

   The wedge: a room of mirrors whose floor and ceiling meet at a sharp edge. */
#ifndef HD_LEAK_HUNT_H
#define HD_LEAK_HUNT_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/camera.h"
#include "scene/scene.h"

/* The place of the scene. */
typedef struct Placement {
    const char *name;
    double scale;
    HdVec3 offset;           /* in units of the scale */
    HdVec3 rotation_degrees; /* rotation of the mesh's coordinates to the world's; the eye always
                                looks along y */
    double stray; /* distance to the right of another mesh, where no ray goes, in units of the
                     scale; 0: there is none. Coordinates are rounded relative to the middle of
                     both. */
} Placement;

enum { PLACEMENT_COUNT = 8 };
extern const Placement placements[PLACEMENT_COUNT];

typedef enum HuntKind {
    HUNT_FLOOR,   /* the sheets before a floor */
    HUNT_SPOTS,   /* before little triangles behind few of the pixels: few shadow rays at a time */
    HUNT_SHADE,   /* before a floor, with sheets opaque to shadow rays */
    HUNT_MIRRORS, /* the mirrors in the sphere */
    HUNT_ROOM,    /* the eye in the room */
    HUNT_WEDGE,   /* the eye in the wedge */
    HUNT_KINDS
} HuntKind;

/* Expected crossings of a pixel's rays. */
typedef enum HuntPixel {
    PIXEL_FREE,  /* hits no sheet */
    PIXEL_RIM,   /* crosses nothing, or as many surfaces as those within */
    PIXEL_WITHIN /* crosses Hunt.surfaces */
} HuntPixel;

typedef struct Hunt {
    HdScene scene;
    HuntKind kind;
    const Placement *placement;
    int side; /* pixels of a row and of a column */
    int surfaces;
    HuntPixel *pixels; /* owned; and the next one */
    bool *is_lit;      /* pixels that have a shadow ray */
    HdVec3 light;      /* relative to the eye, in units of the scale */
    uint64_t random;
} Hunt;

/* Counts of rays that crossed too few, or too many, surfaces. */
typedef struct Catch {
    uint64_t rays, leaks, double_hits;
} Catch;

/* Makes a hunt; `side` is 4 k + 1, at least 33. The meshes are built. */
void hunt_begin(Hunt *hunt, HuntKind kind, const Placement *placement, int side, uint64_t seed);

/* Moves the light off the eye by a few times `step`, relative to the scene's size. */
void hunt_move_light(Hunt *hunt, double step);

/* Returns a camera at the eye, displaced by a few times `step`. */
HdCamera hunt_camera(Hunt *hunt, double step);

/* Adds to `caught` the errors of a frame rendered from a camera of hunt_camera. */
void hunt_judge(const Hunt *hunt, const float *rgb, Catch *caught);

void hunt_end(Hunt *hunt);

#endif
