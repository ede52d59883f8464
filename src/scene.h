/* SPDX-License-Identifier: MIT */
/* The scene as its author describes it: world space, right-handed, z up, double precision. */
#ifndef HD_SCENE_H
#define HD_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"
#include "platonic.h"
#include "vec3.h"

enum {
    HD_MAX_SOLIDS = 256,
    HD_MAX_LIGHTS = 100000, /* point lights and edge lights together */
    HD_MAX_DEPTH = 1000,
    HD_MAX_SAMPLES_PER_SIDE = 64,
    HD_MAX_IMAGE_SIDE = 65535,
    HD_MAX_SHININESS = 65536
};

/* Phong's terms and the two rays that go on. reflection + transmission <= 1. */
typedef struct HdMaterial {
    HdVec3 colour;      /* 0..1; tints diffuse light and what passes through */
    HdVec3 mirror_tint; /* 0..1; tints the mirror image */
    double ambient;
    double diffuse;
    double specular;
    int shininess; /* exponent, 1..HD_MAX_SHININESS */
    double reflection;
    double transmission;
} HdMaterial;

/* Point lights at (k + 1/2) / per_edge along every edge of a solid, each seen as a disc. */
typedef struct HdEdgeLights {
    int per_edge;
    HdVec3 intensity;        /* of each light; 0: a bright spot that lights nothing */
    double falloff_distance; /* d0 of 1 / (1 + (d / d0)^2); 0: no falloff */
    double disc_radius;
    HdVec3 disc_radiance;
} HdEdgeLights;

typedef struct HdSolid {
    HdSolidKind kind;
    HdVec3 centre;
    double circumradius;
    HdMaterial face;
    double rim_width; /* measured in the face, from the edge inwards; 0: no rim */
    HdMaterial rim;
    HdEdgeLights lights;
} HdSolid;

typedef struct HdLight {
    HdVec3 position;
    HdVec3 intensity;
    double falloff_distance; /* 0: no falloff */
} HdLight;

/* Linear values, 16 bits a channel, row by row from the top: r, g, b, r, g, b, ... */
typedef struct HdTexture {
    int width, height;
    uint16_t *texels; /* owned; width * height * 3 */
} HdTexture;

/* A flat convex quadrilateral. The texture's top left, top right, bottom right and bottom left
   corners lie at corner 0, 1, 2 and 3. */
typedef struct HdFloor {
    bool present;
    HdVec3 corners[4];
    HdMaterial material;
    HdTexture texture; /* width 0: none */
} HdFloor;

/* r(t) = r0 + r_amplitude * sin(r_frequency * t + r_phase), z(t) likewise,
   phi(t) = phi0 + phi_frequency * t, for t in [0, 2 pi). */
typedef struct HdCylinderPath {
    double r0, z0, phi0;
    double r_amplitude, z_amplitude;
    double r_frequency, z_frequency, phi_frequency;
    double r_phase, z_phase;
} HdCylinderPath;

typedef struct HdScene {
    int frame_count;
    HdCylinderPath eye, target;
    double field_of_view_degrees; /* horizontal */
    int width, height;
    int samples_per_side; /* n of the n x n samples of a pixel */
    int depth;            /* primary rays have depth 0 */
    double cutoff;        /* rays whose weight falls below it in every channel end; 0: off */
    double exposure;
    HdVec3 background;
    int solid_count;
    HdSolid *solids; /* owned */
    int light_count;
    HdLight *lights; /* owned; the edge lights are not among them */
    HdFloor floor;
} HdScene;

/* Checks every value; on failure the error names the first one that is wrong and what was expected.
   Library code may rely on a scene that passed. */
HdStatus hd_scene_validate(const HdScene *scene, HdError *error);

/* Frees what the scene owns and clears it. */
void hd_scene_free(HdScene *scene);

#endif
