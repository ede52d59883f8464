/* SPDX-License-Identifier: MIT */
/* Builds the scenes of the golden frames and of the conformance suite. Functions that allocate
   return false when out of memory. */
#ifndef HD_VERIFY_SCENE_BUILDER_H
#define HD_VERIFY_SCENE_BUILDER_H

#include "scene/camera.h"
#include "scene/scene.h"

/* Makes an empty scene with memory for solids and lights; the caller frees it. */
bool build_scene(HdScene *scene, int width, int height, int samples, int depth, int solids,
                 int lights);

/* Returns a partly diffuse and specular material with that reflection and transmission. */
HdMaterial build_material(HdVec3 colour, double reflection, double transmission);

/* Builds a solid with reflection 0.6, transmission 0.35, a rim and edge lights. */
void build_solid(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                 HdVec3 colour, int lights_per_edge);

/* Builds a solid without a rim, edge lights and reflection. */
void build_glass(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                 double grey, double transmission);
void build_light(HdScene *scene, int index, HdVec3 position, HdVec3 intensity);
void build_floor(HdScene *scene, HdVec3 a, HdVec3 b, HdVec3 c, HdVec3 d);
void build_square_floor(HdScene *scene, double half_side, double z);
bool build_texture(HdTexture *texture, int width, int height);

/* Makes an environment of such a texture, whose texels are up to `top`, with intensity 0.75. */
bool build_sky(HdScene *scene, int width, int height, double top, double rotation_degrees);

/* Looks from `eye` at `target`, z up. */
void build_camera(HdCamera *camera, HdVec3 eye, HdVec3 target, double field_of_view_degrees);

/* Allocates meshes in a scene; the caller frees them with the scene. */
bool build_meshes(HdScene *scene, int meshes, int instances, int pictures);

/* Makes a closed sphere of radius 1 about the origin, poles on the z axis, in an empty (zeroed)
   mesh with one material, which is copied. It has `rows` (at least 2) rings of 2 * `rows`
   quadrilaterals, which are single triangles at the poles: 4 * rows * (rows - 1) triangles. A
   fixed wave moves vertices along the radius by up to `bump`. `smooth` adds the normals of the
   undisplaced sphere, `mapped` texture coordinates, also beyond 0 to 1. Builds no hierarchy. On
   false the caller still frees the mesh. */
bool build_sphere_mesh(HdMesh *mesh, int rows, double bump, bool smooth, bool mapped,
                       const HdMaterial *material);

/* Makes a cube from -1 to 1, of 12 triangles; faces 0 and 1 have the second material. */
bool build_cube_mesh(HdMesh *mesh, const HdMaterial *first, const HdMaterial *second);

/* Colours the vertices of a mesh. */
bool build_colours(HdMesh *mesh);

/* Places a mesh, with the same scale for every axis. */
void build_instance(HdScene *scene, int index, int mesh, HdVec3 position, HdVec3 rotation,
                    double scale);

/* Builds the hierarchies of all meshes. */
bool finish_meshes(HdScene *scene);

#endif
