/* SPDX-License-Identifier: MIT */
/* Solids and shells of meshes that lie within others. Kernels know no other medium outside of a
   surface than one of index 1, so each index counts relative to that of the innermost solid or
   shell around it. */
#ifndef HD_SCENE_NESTING_H
#define HD_SCENE_NESTING_H

#include "mesh/shells.h"
#include "scene/scene.h"

typedef enum HdNestState {
    HD_NEST_WITHIN,  /* wholly within the other one */
    HD_NEST_CROSSES, /* begins within, but crosses or nearly touches the other one */
    HD_NEST_OPEN,    /* within, but one of the two is not closed */
    HD_NEST_MIXED,   /* within one whose clear triangles have several indices */
    HD_NEST_CAVITY,  /* turned inside out, but within nothing that refracts */
    HD_NEST_SKIPPED, /* not compared, nor what follows: it would take too long */
    HD_NEST_STATE_COUNT
} HdNestState;

/* A solid, or an instance of a mesh. */
typedef struct HdNestObject {
    bool is_solid;
    int number; /* among the scene's solids or instances */
} HdNestObject;

enum { HD_ALL_SHELLS = -1 };

/* A clear solid or shell of an instance, and another one. */
typedef struct HdNested {
    HdNestObject object, other;
    int shell; /* of the object's mesh, or HD_ALL_SHELLS; of a solid 0 */
    HdNestState state;
    double around; /* the other's index of refraction, not 1, if within; else 1 */
} HdNested;

/* Results in the order of solids, instances and shells. One within another has one of that state;
   one result stands for all shells of an instance if they lie within the same object. */
typedef struct HdNesting {
    int count, capacity;
    HdNested *list; /* owned */
    int mesh_count;
    HdShells *shells; /* owned; of each mesh; empty if they did not matter */
} HdNesting;

/* Finds what lies within what in a scene with built meshes. `for_notes` adds cavities, and the
   first pair of surfaces that refract and cross. HD_FAILED: out of memory. HD_INTERRUPTED: a signal
   came. `nesting` is then empty. */
HdStatus hd_nesting_find(HdNesting *nesting, const HdScene *scene, bool for_notes, HdError *error);

void hd_nesting_free(HdNesting *nesting);

/* Makes the indices relative: divides those of solids and sets HdInstance.around. A mesh gets more
   materials if its shells lie in different media. HD_BAD_INPUT: it needs too many. Other errors as
   above. */
HdStatus hd_scene_nest(HdScene *scene, HdError *error);

#endif
