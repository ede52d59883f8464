/* SPDX-License-Identifier: MIT */
/* Private to the compilation of scenes. The geometry is computed in double, once for both
   precisions (elements.c, mesh_places.c); what rounds it to `real` when it is stored is compiled
   twice, with HD_DOUBLE 0 and 1, and its functions have NAMED names. */
#ifndef HD_TABLES_BUILDER_H
#define HD_TABLES_BUILDER_H

#include "kernels/host/shared.h"
#include "mesh/hierarchy.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "tables/table.h"

#if HD_DOUBLE
#define NAMED(name) name##_double
#else
#define NAMED(name) name##_float
#endif

/* A light, relative to the solid whose edge it sits on. */
typedef struct HdLightSource {
    HdVec3 position; /* relative to the owner's centre, or in world space */
    int owner;       /* number of the solid, -1: none */
    int face[2];     /* the owner's faces that hold the light */
    HdVec3 intensity;
    HdFalloff falloff;
} HdLightSource;

/* Entries of the tables of meshes. */
typedef struct HdMeshSizes {
    size_t triangles, nodes, wide_nodes, normals, uvs, corner_normals, corner_uvs, mesh_materials;
} HdMeshSizes;

typedef struct HdMeshPlace {
    HdMeshSizes first; /* where the mesh's entries begin in the tables */
    HdWideHierarchy wide;
} HdMeshPlace;

/* A light in the order of clusters: those of a cluster follow each other. */
typedef struct HdClusteredLight {
    HdVec3 position; /* in world space */
    HdVec3 about;    /* the middle of its edge, if it has one */
    double key;      /* by which they are sorted */
    int light, cluster;
} HdClusteredLight;

typedef struct HdBuilder {
    const HdScene *scene;
    int lanes;
    int solid_count;    /* 0 where solids are made of triangles */
    bool has_floor;     /* likewise */
    HdPlatonic *shapes; /* of the solids, turned as they are in the scene */
    int object_count, plane_count, edge_count, light_count;
    HdVec3 *centres;        /* of the objects, world space */
    HdLightSource *sources; /* in the order of the table of lights */
    HdClusteredLight *clustered;
    HdMeshPlace *places; /* of the meshes */
    HdMeshSizes sizes;
    HdVec3 mesh_centre; /* of all instances */
    double mesh_reach;  /* most coordinate of an instance, relative to that centre */
    int node_stack, wide_stack;
    HdHierarchy top; /* over the instances; without nodes where there are few */
    size_t first_top_node;
    int first_mesh_material;
    int picture_count; /* the scene's and, after those, the floor's */
    size_t texels;
    void *table[HD_SCENE_TABLE_COUNT];
} HdBuilder;

/* A mesh instance's way from the mesh's own coordinates to those relative to the meshes' centre:
   columns . p + start. */
typedef struct HdPlacement {
    HdVec3 columns[3], start;
} HdPlacement;

/* The floor's frame: its normal from the diagonals, which fits four nearly coplanar corners best.
 */
typedef struct HdFloorFrame {
    HdVec3 centre, normal, axis_a, axis_b;
} HdFloorFrame;

/* Shapes the solids, and counts objects, planes, edges, lights and pictures. */
HdStatus hd_builder_count(HdBuilder *builder, HdError *error);
/* Lists the lights, and clusters them: halves the lights across their longest side, and the halves,
   until there are as many clusters as HD_LIGHT_CLUSTERS says; an edge's lights stay together where
   they can. */
void hd_builder_list_lights(HdBuilder *builder);

/* Solids, the floor and all meshes together, as far as there are any of them; and where one of
   these has its centre, in world space. */
int hd_object_count(const HdScene *scene);
HdVec3 hd_object_centre(const HdScene *scene, int object);
const HdTexture *hd_builder_texture(const HdBuilder *builder, int picture);

/* Faces in parallel pairs share an entry of the table of planes. */
int hd_faces_per_plane(const HdPlatonic *shape);
int hd_solid_plane_count(const HdPlatonic *shape);
/* A share `along` of the way along an edge, relative to the solid's centre. */
HdVec3 hd_edge_point(const HdPlatonic *shape, int edge, double circumradius, double along);
HdVec3 hd_edge_colour(const HdEdgeLights *lights, int edge);
/* A light relative to an object. */
HdVec3 hd_light_offset(const HdBuilder *builder, const HdLightSource *source, int object);
HdFloorFrame hd_floor_frame(const HdFloor *floor);

/* No ray sees more radiance, contributions being clamped. */
HdVec3 hd_max_radiance(const HdScene *scene);

/* Where each mesh's entries begin, the box about all instances and the hierarchy over them. */
HdStatus hd_builder_prepare_meshes(HdBuilder *builder, HdError *error);
void hd_builder_free_meshes(HdBuilder *builder);

const HdMesh *hd_mesh_of(const HdScene *scene, int instance);
const HdMaterial *hd_material_of(const HdInstance *instance, const HdMeshMaterial *material);
/* In world space. */
HdPlacement hd_placement_of(const HdScene *scene, int instance);
/* The middle of the box about all instances, in world space; returns half its longest side. */
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
/* Of surveyed scenes: what is seen at most by rays that leave each object. */
void NAMED(hd_fill_seen)(const HdBuilder *builder);
void NAMED(hd_fill_floor)(const HdBuilder *builder);
void NAMED(hd_fill_pictures)(const HdBuilder *builder);
void NAMED(hd_fill_object_offsets)(const HdBuilder *builder);
void NAMED(hd_fill_meshes)(const HdBuilder *builder);
/* After the others: from what they stored. */
void NAMED(hd_fill_lights)(const HdBuilder *builder);

/* As hd_compile_scene and hd_compile_frame (tables.h), which choose one of both. `list` is NULL
   where all pixels have all places of the grid. */
#define HD_DECLARE_COMPILERS(precision)                                                            \
    HdStatus hd_compile_scene_##precision(HdSceneTables *tables, const HdScene *scene,             \
                                          HdError *error);                                         \
    HdStatus hd_compile_frame_##precision(HdFrameTables *tables, const HdScene *scene,             \
                                          const HdCamera *camera, const HdSampleList *list,        \
                                          HdError *error);
HD_DECLARE_COMPILERS(float)
HD_DECLARE_COMPILERS(double)

#endif
