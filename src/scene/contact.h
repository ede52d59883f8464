/* SPDX-License-Identifier: MIT */
/* Solids that touch: each other, the floor or a light. Where faces coincide, rounding alone would
   say which of them a ray meets first. */
#ifndef HD_SCENE_CONTACT_H
#define HD_SCENE_CONTACT_H

#include "scene/scene.h"

/* How deep the two lie in each other: the length of the shortest move that leaves them touching.
   Negative where they lie apart: then no more than their distance, and where it is not greater than
   `least`, `least`. */
double hd_solid_depth(const HdSolid *a, const HdSolid *b, double least);
double hd_floor_depth(const HdSolid *solid, const HdFloor *floor, double least);

/* The length of the shortest move that leaves the two at most touching; 0 where they touch (share a
   face, an edge or a corner) or lie apart. Up to 1e-9 of the smaller one's circumradius, and what
   the rounding of large coordinates may amount to, counts as touching. */
double hd_solid_overlap(const HdSolid *a, const HdSolid *b);

/* The same for a solid and a floor, a flat one: its corners count as if they lay in the plane that
   passes nearest to them. */
double hd_floor_overlap(const HdSolid *solid, const HdFloor *floor);

typedef enum HdContact {
    HD_CONTACT_NONE,
    HD_CONTACT_TOUCHES,  /* without lying in each other */
    HD_CONTACT_OVERLAPS, /* no faces coincide */
    HD_CONTACT_SHARES    /* they overlap, and faces, or parts of them, coincide */
} HdContact;

/* How two solids, and a solid and the floor, lie to each other. What is nearer than 2^-21 of their
   radii and of the distance of their centres counts as the same place. */
HdContact hd_solids_contact(const HdSolid *a, const HdSolid *b);
HdContact hd_floor_contact(const HdSolid *solid, const HdFloor *floor);
/* How many of the lights are on the solid's surface, and the number of the first one of them. */
int hd_touching_lights(const HdSolid *solid, const HdLight *lights, int count, int *first);

/* Whether anything of the two is in the same place. */
bool hd_contact_coincides(HdContact contact);

/* Draws apart what touches, of a valid scene: solids shrink about their centres, so that faces that
   coincided have a gap of at least 2^-21 of what is said above, some 5e-7, which no picture shows.
   The order of the scene decides: each solid shrinks by as many steps of 2^-20 as it takes to
   differ from the floor, which does not move, from lights on its faces, and from earlier solids. A
   solid that would shrink by more than a 1024th stays as it is. */
void hd_scene_part_contacts(HdScene *scene);

#endif
