/* SPDX-License-Identifier: MIT */
/* The scene as its author describes it: world space, right-handed, z up, double precision. */
#ifndef HD_SCENE_SCENE_H
#define HD_SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "base/limits.h"
#include "base/vector.h"
#include "image/format.h"
#include "mesh/mesh.h"
#include "scene/platonic.h"

/* A light's attenuation at distance d: 1 / (1 + (d / distance)^2), or (1 - (d / end)^2)^2 up to d =
   end and 0 beyond. If both are 0, the light does not fade. */
typedef struct HdFalloff {
    double distance;
    double end;
} HdFalloff;

/* Point lights at (k + 1/2) / per_edge along every edge of a solid, each visible as a disc. */
typedef struct HdEdgeLights {
    int per_edge;
    int colour_count; /* edge e has colour e modulo colour_count; at least 1 if there are lights */
    HdVec3 colours[HD_MAX_EDGE_COLOURS]; /* 0..1 */
    double intensity; /* intensity of each light, times its colour; 0: a bright spot that lights
                         nothing */
    HdFalloff falloff;
    double disc_radius;
    double disc_radiance; /* times the light's colour */
} HdEdgeLights;

typedef struct HdSolid {
    HdSolidKind kind;
    HdVec3 centre;
    double circumradius;
    HdVec3 rotation_degrees; /* rotation from the canonical orientation: about x, then y, then z */
    HdMaterial face;
    double rim_width; /* width in the face, from the edge inwards; 0: no rim */
    HdMaterial rim;
    HdEdgeLights lights;
} HdSolid;

typedef struct HdLight {
    HdVec3 position;
    HdVec3 intensity;
    HdFalloff falloff;
} HdLight;

/* A flat convex quadrilateral. Corners 0, 1, 2 and 3 carry the texture's top left, top right,
   bottom right and bottom left corners. */
typedef struct HdFloor {
    bool present;
    HdVec3 corners[4];
    HdMaterial material;
    HdTexture texture; /* width 0: none */
} HdFloor;

typedef struct HdPicture {
    HdTexture texture;
    bool is_clamped; /* clamped at its border; otherwise it repeats */
} HdPicture;

/* A picture all around, twice as wide as high, that adds to the background. Seen from within, its
   columns are in equal steps of the angle about the z axis, its rows in equal steps from it. */
typedef struct HdEnvironment {
    char *file;              /* owned; path to open, "~" not expanded; NULL: none is named */
    HdCurve curve;           /* of the values in the file, if it is a texture */
    double intensity;        /* factor of all texels */
    double rotation_degrees; /* about the z axis; at 0 the middle is towards the x axis */
    HdTexture texture;       /* width 0: none */
    double top;              /* what 65535 in a texel stands for, before `intensity` */
} HdEnvironment;

/* A mesh's axis that points up. With y, (x, y, z) becomes (x, -z, y). */
typedef enum HdUpAxis { HD_UP_Z, HD_UP_Y } HdUpAxis;

/* A placed mesh: its points are scaled, then turned upright, then rotated as solids are, then
   moved. */
typedef struct HdInstance {
    int mesh;  /* index in HdScene.meshes */
    int entry; /* number among the meshes of the scene file, which may list others; -1: none */
    HdUpAxis up;
    HdVec3 position;
    HdVec3 rotation_degrees;
    HdVec3 scale;      /* none is 0; a negative one mirrors, and outer sides stay outer ones */
    bool has_material; /* `material` replaces all of the mesh's own materials */
    HdMaterial material;
    double *around; /* owned; the index of refraction around each material of the mesh, to which
                       the material's own is relative; NULL: 1 (hd_scene_nest) */
} HdInstance;

/* How rays search triangles. */
typedef enum HdAccel { HD_ACCEL_AUTO, HD_ACCEL_BRUTE, HD_ACCEL_BVH } HdAccel;

/* Representation of solids and the floor. With triangles (hd_scene_triangulate), the first
   instances of the scene are its solids, in order, then the floor. The solids themselves are then
   invisible, but their edge lights still shine. */
typedef enum HdGeometry { HD_GEOMETRY_SOLIDS, HD_GEOMETRY_TRIANGLES } HdGeometry;

/* r(t) = r0 + r_amplitude * sin(r_frequency * t + r_phase), z(t) likewise, phi(t) = phi0 +
   phi_frequency * t, for t in [0, 2 pi). Angles are in radians. */
typedef struct HdCylinderPath {
    double r0, z0, phi0;
    double r_amplitude, z_amplitude;
    double r_frequency, z_frequency, phi_frequency;
    double r_phase, z_phase;
} HdCylinderPath;

/* Positions of the eye or the target: a cylinder path, or always `point` if `is_fixed`. */
typedef struct HdPath {
    bool is_fixed;
    HdVec3 point;
    HdCylinderPath cylinder;
} HdPath;

/* Positions of a pixel's samples (sample_pattern.h). */
typedef enum HdSampling {
    HD_SAMPLING_GRID,        /* the middles of cells */
    HD_SAMPLING_MULTIJITTER, /* one in each cell, and one in each of as many columns and rows */
    HD_SAMPLING_REFERENCE    /* likewise, at random in them */
} HdSampling;

/* X(value, name): the samplings that scenes and options name, in the order of HdSampling. */
#define HD_SAMPLINGS(X) X(HD_SAMPLING_GRID, "grid") X(HD_SAMPLING_MULTIJITTER, "multijitter")

/* Names by HdSampling; NULL ends them. */
extern const char *const hd_sampling_names[];

typedef struct HdScene {
    int frame_count;
    HdPath eye, target;
    double field_of_view_degrees; /* horizontal */
    int width, height;
    HdCrop crop;
    int samples_per_side; /* n of n x n samples of a pixel, or of its columns of cells */
    int sample_rows;      /* rows of cells of HD_SAMPLING_MULTIJITTER; 0: n */
    HdSampling sampling;
    double max_error; /* largest truncation error of a pixel, in 1/255 units; 0: no limit */
    int depth;        /* maximum ray depth; primary rays have depth 0 */
    double cutoff;    /* weight below which, in every channel, a ray ends; 0: off */
    double exposure;
    HdVec3 background;
    HdEnvironment environment;
    int solid_count;
    HdSolid *solids; /* owned */
    int light_count;
    HdLight *lights; /* owned; without the edge lights */
    HdFloor floor;
    HdGeometry geometry;
    HdAccel accel;
    int mesh_count;
    HdMesh *meshes; /* owned; each built */
    int instance_count;
    HdInstance *instances; /* owned */
    int picture_count;
    HdPicture *pictures; /* owned; textures of meshes */
} HdScene;

/* Returns the solid's shape about its centre, rotated, with circumradius 1. */
HdPlatonic hd_solid_shape(const HdSolid *solid);

/* Returns the material that an instance has for one of its mesh's, with the relative index. */
HdMaterial hd_instance_material(const HdScene *scene, const HdInstance *instance, int number);

/* Returns whether neither side of a face lets rays pass. */
bool hd_is_opaque(const HdMaterial *face);

/* Returns the number of lights on the edges of a valid solid. */
int hd_edge_light_count(const HdSolid *solid);

/* Returns whether pixels come with truncation bounds (HdFrame). */
bool hd_scene_has_error_bound(const HdScene *scene);

/* Returns whether ray trees may be deeper than 64, as the cut-off does not end them long before.
   Call it before hd_scene_drop_error_bound. */
bool hd_scene_has_deep_trees(const HdScene *scene);

/* Converts the scene to one of about the same work without an error bound, to measure a device's
   speed. */
void hd_scene_drop_error_bound(HdScene *scene);

/* Returns the mean of the corners. */
HdVec3 hd_floor_centre(const HdFloor *floor);

/* Counts point lights and edge lights of a valid scene, also those that light nothing. */
int hd_scene_light_count(const HdScene *scene);

/* Counts those of these lights that light something and whose falloff has no end. */
int hd_scene_endless_light_count(const HdScene *scene);

/* Counts the triangles of all meshes, each mesh once. */
int64_t hd_scene_triangle_count(const HdScene *scene);

/* Builds the hierarchies of all meshes on all processors. */
HdStatus hd_scene_build_meshes(HdScene *scene, HdError *error);

/* Frees all meshes, instances and pictures, and clears their counts. */
void hd_scene_drop_meshes(HdScene *scene);

/* Adds a sentence to `notes` for each setting of a valid scene that is probably unintended. */
void hd_scene_notes(const HdScene *scene, HdProblems *notes);

/* Frees the scene's members and clears it. */
void hd_scene_free(HdScene *scene);

#endif
