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

/* How a light fades with the distance d: 1 / (1 + (d / distance)^2), or (1 - (d / end)^2)^2 up to
   d = end and nothing beyond, or, both being 0, not at all. */
typedef struct HdFalloff {
    double distance;
    double end;
} HdFalloff;

/* Point lights at (k + 1/2) / per_edge along every edge of a solid, each seen as a disc. */
typedef struct HdEdgeLights {
    int per_edge;
    int colour_count; /* edge e has colour e modulo colour_count; at least 1 if there are lights */
    HdVec3 colours[HD_MAX_EDGE_COLOURS]; /* 0..1 */
    double intensity; /* of each light, times its colour; 0: a bright spot that lights nothing */
    HdFalloff falloff;
    double disc_radius;
    double disc_radiance; /* times the light's colour */
} HdEdgeLights;

typedef struct HdSolid {
    HdSolidKind kind;
    HdVec3 centre;
    double circumradius;
    HdVec3 rotation_degrees; /* from the canonical orientation: about x, then y, then z */
    HdMaterial face;
    double rim_width; /* measured in the face, from the edge inwards; 0: no rim */
    HdMaterial rim;
    HdEdgeLights lights;
} HdSolid;

typedef struct HdLight {
    HdVec3 position;
    HdVec3 intensity;
    HdFalloff falloff;
} HdLight;

/* A flat convex quadrilateral. The texture's top left, top right, bottom right and bottom left
   corners lie at corner 0, 1, 2 and 3. */
typedef struct HdFloor {
    bool present;
    HdVec3 corners[4];
    HdMaterial material;
    HdTexture texture; /* width 0: none */
} HdFloor;

typedef struct HdPicture {
    HdTexture texture;
    bool is_clamped; /* its border goes on outwards; otherwise it repeats without end */
} HdPicture;

/* A mesh in its place: its points are scaled, then turned as solids are, then moved. */
typedef struct HdInstance {
    int mesh; /* number in HdScene.meshes */
    HdVec3 position;
    HdVec3 rotation_degrees;
    HdVec3 scale;      /* each positive */
    bool has_material; /* `material` takes the place of all of the mesh's own ones */
    HdMaterial material;
} HdInstance;

/* How triangles are searched. */
typedef enum HdAccel { HD_ACCEL_AUTO, HD_ACCEL_BRUTE, HD_ACCEL_BVH } HdAccel;

/* What solids and the floor are made of. With triangles, which hd_scene_triangulate makes, the
   first instances of the scene are its solids, in order, and the solids themselves are no longer
   seen, but for their lights; the floor follows. */
typedef enum HdGeometry { HD_GEOMETRY_SOLIDS, HD_GEOMETRY_TRIANGLES } HdGeometry;

/* r(t) = r0 + r_amplitude * sin(r_frequency * t + r_phase), z(t) likewise,
   phi(t) = phi0 + phi_frequency * t, for t in [0, 2 pi). */
typedef struct HdCylinderPath {
    double r0, z0, phi0;
    double r_amplitude, z_amplitude;
    double r_frequency, z_frequency, phi_frequency;
    double r_phase, z_phase;
} HdCylinderPath;

/* Where the eye or the target is: on a cylinder path, or, `is_fixed`, always at `point`. */
typedef struct HdPath {
    bool is_fixed;
    HdVec3 point;
    HdCylinderPath cylinder;
} HdPath;

/* Where in a pixel its samples are, and how many it gets. */
typedef enum HdSampling {
    HD_SAMPLING_GRID,     /* all places of a grid */
    HD_SAMPLING_ADAPTIVE, /* places of that grid, as many as the pixel needs */
    HD_SAMPLING_REFERENCE /* a low-discrepancy set, dense and the same in every pixel */
} HdSampling;

/* The picture is a part of a larger one, whose pixel left, top is its first one. */
typedef struct HdCrop {
    int whole_width, whole_height; /* 0: it is the whole */
    int left, top;
} HdCrop;

typedef struct HdScene {
    int frame_count;
    HdPath eye, target;
    double field_of_view_degrees; /* horizontal */
    int width, height;
    HdCrop crop;
    int samples_per_side; /* n of the n x n samples of a pixel, at most, or of its grid */
    HdSampling sampling;
    double max_error; /* what may be left out of a pixel, in steps of 255; 0: no such limit */
    int depth;        /* primary rays have depth 0 */
    double cutoff;    /* rays whose weight falls below it in every channel end; 0: off */
    double exposure;
    HdVec3 background;
    int solid_count;
    HdSolid *solids; /* owned */
    int light_count;
    HdLight *lights; /* owned; the edge lights are not among them */
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

/* Its corners, edges and faces about its centre, turned as it is, with circumradius 1. */
HdPlatonic hd_solid_shape(const HdSolid *solid);

/* The lights on the edges of a solid whose values are valid. */
int hd_edge_light_count(const HdSolid *solid);

/* Pixels come with bounds of what was left out (HdFrame). */
bool hd_scene_has_error_bound(const HdScene *scene);

/* A sample's rays may go on for more than 64 levels, and are not ended long before by the cut-off.
   To be asked before the survey is dropped. */
bool hd_scene_has_deep_trees(const HdScene *scene);

/* Makes it a scene of about the same work that is not surveyed: to learn how fast a device is. */
void hd_scene_drop_error_bound(HdScene *scene);

/* The mean of the corners. */
HdVec3 hd_floor_centre(const HdFloor *floor);

/* Point lights and lights of edges of a valid scene, those that light nothing included. */
int hd_scene_light_count(const HdScene *scene);

/* Of these the ones that light something and whose light no distance ends. */
int hd_scene_endless_light_count(const HdScene *scene);

/* Triangles of all meshes, each counted once however often it is placed. */
int64_t hd_scene_triangle_count(const HdScene *scene);

/* Builds the hierarchies of all meshes, on all processors. */
HdStatus hd_scene_build_meshes(HdScene *scene, HdError *error);

/* Frees the meshes, their instances and pictures; the scene then has none. */
void hd_scene_drop_meshes(HdScene *scene);

/* Adds a sentence to `notes` for each thing in a valid scene that is allowed and seldom meant. */
void hd_scene_notes(const HdScene *scene, HdProblems *notes);

/* Frees what the scene owns and clears it. */
void hd_scene_free(HdScene *scene);

#endif
