/* SPDX-License-Identifier: MIT */
/* The surface of a solid as convex facets, which planes cut into smaller ones. Two facets that meet
   have one side in common, with the same two points, whatever is cut: there are no gaps. */
#ifndef HD_SCENE_FACETS_H
#define HD_SCENE_FACETS_H

#include <stdbool.h>
#include <stdint.h>

#include "mesh/mesh.h"
#include "scene/platonic.h"

/* A side of a facet, which lies to its left as seen from outside. */
typedef struct HdFacetSide {
    int32_t from;       /* the point where it begins; it ends where the next one does */
    int32_t next, twin; /* of the same facet; of the facet beyond it, the other way round */
} HdFacetSide;

typedef struct HdFacet {
    int32_t side; /* one of its sides */
    int face, material;
} HdFacet;

/* Starts as {0}. */
typedef struct HdFacets {
    int point_count, side_count, facet_count;
    HdVec3 *points; /* owned, as are the others */
    HdFacetSide *sides;
    HdFacet *facets;
    int point_room, side_room, facet_room;
} HdFacets;

/* The points for which direction . point >= offset; the direction is unit. */
typedef struct HdHalfSpace {
    HdVec3 direction;
    double offset;
} HdHalfSpace;

/* Makes a facet of each face of the solid. False: out of memory. */
bool hd_facets_start(HdFacets *facets, const HdPlatonic *shape, int material);

/* Cuts the facets of a face, which are its own one and those from number `first` on, along the
   borders of what lies in all of the half spaces, and gives what does the material; on the facets
   of an odd material, the next one. Borders that come no nearer to a facet's points than 1e-9 pass
   through them. False: out of memory. */
bool hd_facets_carve(HdFacets *facets, int face, int first, const HdHalfSpace *borders, int count,
                     int material);

/* Adds each facet to the mesh as a fan of triangles, larger by `scale`, with the group face + 1.
   False: out of memory. */
bool hd_facets_fill_mesh(const HdFacets *facets, const HdPlatonic *shape, double scale,
                         HdMesh *mesh);

void hd_facets_free(HdFacets *facets);

#endif
