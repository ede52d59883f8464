/* SPDX-License-Identifier: MIT */
/* Solids that touch each other, the floor or a light. If faces coincide, rounding alone would
   decide which of them a ray meets first. */
#ifndef HD_SCENE_CONTACT_H
#define HD_SCENE_CONTACT_H

#include "scene/scene.h"

/* Return the penetration depth: the length of the shortest move that leaves the two touching. If
   they are separate, the result is negative and at most their distance in size. It is never below
   `least`. */
double hd_solid_depth(const HdSolid *a, const HdSolid *b, double least);
double hd_floor_depth(const HdSolid *solid, const HdFloor *floor, double least);

/* Returns the length of the shortest move that leaves the two at most touching; 0 if they are
   separate or share only a face, an edge or a corner. Tolerates 1e-9 of the smaller circumradius
   plus the rounding of large coordinates. */
double hd_solid_overlap(const HdSolid *a, const HdSolid *b);

/* Returns whether `inner` lies within `outer`, clear of its faces by a 16384th of its circumradius.
 */
bool hd_solid_holds(const HdSolid *outer, const HdSolid *inner);

/* Returns the innermost of `count` solids that holds the solid of this number; -1: none. */
int hd_solid_around(const HdSolid *solids, int count, int number);

typedef enum HdContact {
    HD_CONTACT_NONE,
    HD_CONTACT_TOUCHES,  /* touch without overlap */
    HD_CONTACT_OVERLAPS, /* overlap, no faces coincide */
    HD_CONTACT_SHARES    /* overlap, and faces or parts of them coincide */
} HdContact;

/* Classify the contact. Distances below 2^-21 of the radii and of the centres' distance count as 0.
 */
HdContact hd_solids_contact(const HdSolid *a, const HdSolid *b);
HdContact hd_floor_contact(const HdSolid *solid, const HdFloor *floor);
/* Counts the lights on the solid's surface and stores the number of the first one. */
int hd_touching_lights(const HdSolid *solid, const HdLight *lights, int count, int *first);

/* Returns whether parts of the two surfaces coincide. */
bool hd_contact_coincides(HdContact contact);

/* Separates touching surfaces of a valid scene: solids shrink about their centres. Faces that
   coincided then have a relative gap of at least 2^-21, some 5e-7, which no picture shows. Each
   solid, in the scene's order, shrinks by the fewest steps of 2^-20 that separate it from the
   floor, from lights on its faces and from earlier solids. The floor does not move. A solid that
   would shrink by more than a 1024th stays as it is. */
void hd_scene_separate_contacts(HdScene *scene);

/* Removes instances whose mesh an earlier one has in the same place, as their triangles would
   coincide, and sets `*dropped` to their number. HD_FAILED: out of memory. */
HdStatus hd_scene_drop_second_instances(HdScene *scene, int *dropped, HdError *error);

#endif
