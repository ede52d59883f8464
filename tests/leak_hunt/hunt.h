/* SPDX-License-Identifier: MIT */
/* Scenes in which the ray of every pixel, and its shadow ray, is aimed at an edge or a corner of a
   closed mesh, and what the pixels then tell about how often each ray crossed it.

   The sheets: a closed skin of a front and a back sheet whose vertices lie on the rays of every
   second pixel in both directions, at random depths. So an even pixel of an even row looks at a
   corner, the others at a horizontal, vertical or diagonal edge, and all look at two surfaces. The
   surfaces pass half of what comes and do nothing else. Behind them are things of a known radiance,
   lit by one light at the eye, so that shadow rays run back through the same edges. The radiance of
   the pixels is 2^-crossings of what it is without the skin. At the skin's rim, where the sheets
   meet, a ray may cross nothing or both of them.

   The mirrors: a wall of little mirrors, one for each pixel, throws the eye's rays at corners and
   edges of a sphere about the eye, chosen at random: no two rays of a packet go the same way.

   The room: mirrors all about the eye, rough in front, so that rays meet the next surface at once
   where they are thrown back beside an edge. None may come out.

   The wedge: a room of mirrors whose floor and ceiling meet at a sharp edge. */
#ifndef HD_LEAK_HUNT_H
#define HD_LEAK_HUNT_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/camera.h"
#include "scene/scene.h"

/* Where the scene is put. */
typedef struct Placement {
    const char *name;
    double scale;
    HdVec3 offset;           /* in units of the scale */
    HdVec3 rotation_degrees; /* of the skin's coordinates to the world's; the eye always looks along
                                y */
    double stray; /* how far to the right another mesh is, where no ray goes, in units of the scale;
                     0: there is none. Coordinates are rounded relative to the middle of both. */
} Placement;

enum { PLACEMENT_COUNT = 8 };
extern const Placement placements[PLACEMENT_COUNT];

typedef enum HuntKind {
    HUNT_FLOOR,   /* the sheets before a floor */
    HUNT_SPOTS,   /* before little triangles behind few of the pixels: few shadow rays at a time */
    HUNT_SHADE,   /* before a floor, the skin being opaque to shadow rays */
    HUNT_MIRRORS, /* the mirrors in the sphere */
    HUNT_ROOM,    /* the eye in the room */
    HUNT_WEDGE,   /* the eye in the wedge */
    HUNT_KINDS
} HuntKind;

/* What is known of a pixel's rays. */
typedef enum HuntPixel {
    PIXEL_FREE,  /* meets no skin */
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

/* Rays that crossed less, or more, than they ought to. */
typedef struct Catch {
    uint64_t rays, leaks, double_hits;
} Catch;

/* `side` is 4 k + 1, at least 33. The meshes are built. */
void hunt_begin(Hunt *hunt, HuntKind kind, const Placement *placement, int side, uint64_t seed);

/* Moves the light off the eye by a few times `step`, relative to the scene's size. */
void hunt_move_light(Hunt *hunt, double step);

/* A camera at the eye, but for a few times `step`. */
HdCamera hunt_camera(Hunt *hunt, double step);

/* Adds to `caught` what a frame, rendered from a camera of hunt_camera, shows. */
void hunt_judge(const Hunt *hunt, const float *rgb, Catch *caught);

void hunt_end(Hunt *hunt);

#endif
