/* SPDX-License-Identifier: MIT */
/* Private to the compilation of scenes. Geometry is computed in double, once for both precisions
   (elements.c, mesh_places.c). Functions that store it rounded to `real` have NAMED names and are
   compiled twice, with HD_DOUBLE 0 and 1. */
#ifndef HD_TABLES_BUILDER_H
#define HD_TABLES_BUILDER_H

#include "kernels/host/shared.h"
#include "mesh/hierarchy.h"
#include "scene/camera.h"
#include "scene/placement.h"
#include "tables/table.h"

#if HD_DOUBLE
#define NAMED(name) name##_double
#else
#define NAMED(name) name##_float
#endif

/* A light, which may belong to an edge of a solid. */
typedef struct HdLightSource {
    HdVec3 position; /* relative to the owner's centre; without one, world space */
    int owner;       /* number of the solid, -1: none */
    int face[2];     /* faces of the owner that hold the light */
    HdVec3 intensity;
    HdFalloff falloff;
} HdLightSource;

/* Counts of entries in the tables of meshes. */
typedef struct HdMeshSizes {
    size_t triangles, nodes, wide_nodes, normals, uvs, corner_normals, corner_uvs, corner_colours,
        mesh_materials;
} HdMeshSizes;

typedef struct HdMeshPlace {
    HdMeshSizes first; /* the mesh's first entries in the tables */
    HdWideHierarchy wide;
} HdMeshPlace;

/* A light in the order of clusters. */
typedef struct HdClusteredLight {
    HdVec3 position; /* in world space */
    HdVec3 about;    /* middle of its edge, or its position */
    double key;      /* sort key */
    int light, cluster;
} HdClusteredLight;

typedef struct HdBuilder {
    const HdScene *scene;
    int lanes;
    int solid_count;    /* 0 if solids are made of triangles */
    bool has_floor;     /* likewise */
    HdPlatonic *shapes; /* shapes of the solids, rotated as in the scene */
    int object_count, plane_count, edge_count, light_count;
    HdVec3 *centres;        /* centres of the objects, world space */
    HdLightSource *sources; /* lights in the order of their table */
    HdClusteredLight *clustered;
    HdMeshPlace *places; /* places of the meshes */
    HdMeshSizes sizes;
    HdVec3 mesh_centre; /* centre of all instances, world space */
    double mesh_reach;  /* maximum coordinate of an instance, relative to that centre */
    int node_stack, wide_stack;
    HdHierarchy top; /* hierarchy over the instances; no nodes if they are few */
    size_t first_top_node;
    int first_mesh_material;
    int picture_count;       /* pictures of the scene, of the floor, of the environment */
    int environment_picture; /* number of the last one; -1: none */
    size_t texels;
    void *table[HD_SCENE_TABLE_COUNT];
} HdBuilder;

/* The floor's frame; the normal of the diagonals fits four nearly coplanar corners best. */
typedef struct HdFloorFrame {
    HdVec3 centre, normal, axis_a, axis_b;
} HdFloorFrame;

/* Shapes the solids, and counts objects, planes, edges, lights and pictures. */
HdStatus hd_builder_count(HdBuilder *builder, HdError *error);
/* Lists the lights and clusters them: divides them in half along their longest side, recursively,
   into HD_LIGHT_CLUSTERS clusters. An edge's lights stay together if possible. */
void hd_builder_list_lights(HdBuilder *builder);

/* Return the count of objects (solids, the floor, all meshes together) and the centre of one, in
   world space. */
int hd_object_count(const HdScene *scene);
HdVec3 hd_object_centre(const HdScene *scene, int object);
const HdTexture *hd_builder_texture(const HdBuilder *builder, int picture);

/* Returns 2 for faces in parallel pairs, which share a row of the table of planes; otherwise 1. */
int hd_faces_per_plane(const HdPlatonic *shape);
int hd_solid_plane_count(const HdPlatonic *shape);
/* Returns the point at a share `along` of an edge, relative to the solid's centre. */
HdVec3 hd_edge_point(const HdPlatonic *shape, int edge, double circumradius, double along);
HdVec3 hd_edge_colour(const HdEdgeLights *lights, int edge);
/* Returns a light's position relative to an object's centre. */
HdVec3 hd_light_offset(const HdBuilder *builder, const HdLightSource *source, int object);
HdFloorFrame hd_floor_frame(const HdFloor *floor);

/* Returns the maximum radiance that a ray sees with clamped contributions. */
HdVec3 hd_max_radiance(const HdScene *scene);

/* Fills places, sizes, mesh_centre, mesh_reach, top, first_top_node and the stack depths: each
   mesh's first entries in the tables, its wide hierarchy with several lanes, the box about all
   instances in world space, and the hierarchy over them. Call it after hd_builder_count. Does
   nothing without instances. HD_BAD_INPUT: the meshes have more than HD_MAX_MESH_TRIANGLES
   together. HD_FAILED: out of memory, or no thread pool. HD_INTERRUPTED: a signal came. Call
   hd_builder_free_meshes in any case. */
HdStatus hd_builder_prepare_meshes(HdBuilder *builder, HdError *error);
void hd_builder_free_meshes(HdBuilder *builder);

/* Computes the centre of the box about all instances, in world space; returns half its longest
   side. */
double hd_box_meshes(const HdScene *scene, HdVec3 *centre);
bool hd_has_hierarchy(const HdScene *scene, const HdMesh *mesh);

static inline void hd_store3(real out[3], HdVec3 v) {
    out[0] = (real)v.x;
    out[1] = (real)v.y;
    out[2] = (real)v.z;
}

static inline Vector hd_as_vector(HdVec3 v) {
    return (Vector){(real)v.x, (real)v.y, (real)v.z, R(0.0)};
}

void NAMED(hd_fill_header)(const HdBuilder *builder, const HdSceneTables *tables);
void NAMED(hd_fill_material)(Material *out, const HdMaterial *material);
void NAMED(hd_fill_solids)(const HdBuilder *builder);
/* Fills the bounds of the radiance seen by rays that leave each object. */
void NAMED(hd_fill_seen)(const HdBuilder *builder);
void NAMED(hd_fill_floor)(const HdBuilder *builder);
void NAMED(hd_fill_pictures)(const HdBuilder *builder);
void NAMED(hd_fill_object_offsets)(const HdBuilder *builder);
void NAMED(hd_fill_meshes)(const HdBuilder *builder);
/* Reads the other tables, so runs last. */
void NAMED(hd_fill_lights)(const HdBuilder *builder);

/* The two precisions of hd_compile_scene and hd_compile_frame (table.h). */
#define HD_DECLARE_COMPILERS(precision)                                                            \
    HdStatus hd_compile_scene_##precision(HdSceneTables *tables, const HdScene *scene,             \
                                          HdError *error);                                         \
    HdStatus hd_compile_frame_##precision(HdFrameTables *tables, const HdScene *scene,             \
                                          const HdCamera *camera, const HdPixelList *list,         \
                                          HdError *error);
HD_DECLARE_COMPILERS(float)
HD_DECLARE_COMPILERS(double)

#endif
