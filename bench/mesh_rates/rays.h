/* SPDX-License-Identifier: MIT */
/* Rays to search a mesh with, the same ones for hedron's kernels and for their rival. */
#ifndef HD_BENCH_RAYS_H
#define HD_BENCH_RAYS_H

#include "object.h"

typedef enum HdRayKind {
    HD_RAYS_PRIMARY,  /* of a view, in the order of the picture's blocks */
    HD_RAYS_MIRRORED, /* those that primary ones become at the triangles */
    HD_RAYS_DIFFUSE,  /* from where primary ones meet the object, in random directions */
    HD_RAYS_SHADOW,   /* from there to a light: what lies between is multiplied up */
    HD_RAY_KINDS
} HdRayKind;

extern const char *const hd_ray_kind_names[HD_RAY_KINDS];

enum { HD_RAY_WIDTH = 16 }; /* the number of rays is a multiple of it */

/* Arrays of `count` numbers each, relative to the object's centre; owned. The directions are unit,
   but those to a light, which end there. */
typedef struct HdRays {
    HdRayKind kind;
    int count;
    float *origin[3], *direction[3];
    int *triangle;  /* that the ray leaves; -1: none */
    int *is_inside; /* it runs on that triangle's inner side */
} HdRays;

/* What rays meet: the distance in lengths of the direction, and the triangle, -1: none. */
typedef struct HdHits {
    float *t;
    int *triangle;
    int *is_entering;
    float *passing[3]; /* of shadow rays: the share of light that passes, by channel */
} HdHits;

bool hd_rays_create(HdRays *rays, HdRayKind kind, int count);
void hd_rays_free(HdRays *rays);
bool hd_hits_create(HdHits *hits, int count);
void hd_hits_free(HdHits *hits);

/* Rays of the view of the object's camera, `side` by `side`, a power of two. */
void hd_rays_look(HdRays *rays, const HdObject *object, int side);

/* Segments from the eye at edges and corners of the sphere that face it, of which each is at
   `distance` of the direction. They end beyond the sphere, within the shell: so each crosses the
   surface as often on its way in as on its way out. */
void hd_rays_aim(HdRays *rays, const HdObject *object, float *distance);

/* The rays of another kind from where `from` met the object, as `hits` say. Where they met nothing
   the rays of `from` stay. */
void hd_rays_continue(HdRays *rays, const HdObject *object, const HdRays *from, const HdHits *hits);

#endif
