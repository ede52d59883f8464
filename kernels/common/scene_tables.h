/* SPDX-License-Identifier: MIT */
/* The tables of a compiled scene and of one frame, which kernels read. The host fills them
   (src/tables); a backend copies them unchanged.

   Every struct holds reals first, then 32-bit integers, each a multiple of four in number, so that
   it has no padding in float and in double. An object is a solid, the floor or, as the last one,
   all meshes together. Its geometry is relative to its own centre. Signed distances are positive
   outside. Rays and hits number mesh instances too: floor_end + i is instance i, whose object is
   floor_end. */
#ifndef HD_SCENE_TABLES_H
#define HD_SCENE_TABLES_H

#include "real.h"

typedef struct ALIGNED_16 {
    real x, y, z, unused;
} Vector;

typedef struct ALIGNED_16 {
    real background[3]; /* radiance */
    real exposure;
    real mesh_reach;         /* largest coordinate of a mesh, relative to the meshes' centre */
    real environment_factor; /* of the environment's texels */
    real light_bound[3];     /* sum of the lights' intensities, in scenes with an error bound */
    real environment_start;  /* its picture's coordinate towards the x axis */
    real unused[2];
    int solid_count; /* also the object number of the floor, if the scene has one */
    int floor_end;
    int object_count;
    int plane_count;
    int light_count;
    int instance_count;
    int top_root;            /* node over all instances; -1: kernels test each instance */
    int node_stack;          /* maximum of nodes that wait during a traversal */
    int wide_stack;          /* likewise for wide nodes */
    int refracts;            /* whether some index of refraction is not 1 */
    int lit_from_behind;     /* whether some material is */
    int bounded;             /* whether pixels have an error bound (HD_BOUNDED_SUMS) */
    int cut_outs;            /* whether some mesh material has holes */
    int environment_picture; /* what rays see beyond the objects, besides `background`; -1: none */
    int unused_int[2];
} Header;

/* For a solid with parallel faces (Object.paired): the planes n.x = distance and n.x = -distance of
   two opposite faces. For another solid: the plane n.x = distance of a face. A face's number is
   twice its plane's, plus one for n.x = -distance. For the floor: its own plane, then four upright
   ones that bound it. */
typedef struct ALIGNED_16 {
    real x, y, z, distance;
} Plane;

typedef struct ALIGNED_16 {
    real rim_depth;  /* the rim's width times the sine of the dihedral angle: a point of a face lies
                        on the rim if it is nearer than this to another face's plane */
    real disc_depth; /* likewise, with the radius of the edge lights' discs */
    real disc_radius_squared;
    real edge_half_length;
    real circumradius_squared;
    real radius_about;       /* slightly more than the circumradius */
    real disc_reach_squared; /* of the farthest point of a disc from the middle of its edge */
    real unused;
    real seen_outside[3],
        unused0; /* bound of the radiance that rays leaving it see, in scenes with an error bound */
    real seen_inside[3], unused1; /* likewise for rays inside it */
    int first_plane, plane_count;
    int first_edge, edge_count;
    int face_material, rim_material;
    int lights_per_edge;
    int paired;   /* whether its faces are parallel in pairs */
    int isolated; /* whether no other object reaches into it */
    int unused_int[3];
} Object;

typedef struct ALIGNED_16 {
    real middle[3], unused0;
    real direction[3], unused1; /* unit */
    real disc_radiance[3], unused2;
} Edge;

/* The terms of a material that a row stores as the scene does. */
#define HD_PLAIN_TERMS(COLOUR, NUMBER)                                                             \
    COLOUR(colour)                                                                                 \
    NUMBER(ambient)                                                                                \
    COLOUR(mirror_tint)                                                                            \
    NUMBER(diffuse) NUMBER(specular) NUMBER(reflection) NUMBER(transmission)
#define HD_ROW_COLOUR(term) real term[3];
#define HD_ROW_NUMBER(term) real term;

typedef struct ALIGNED_16 {
    HD_PLAIN_TERMS(HD_ROW_COLOUR, HD_ROW_NUMBER)
    real inner_reflection, inner_transmission; /* for rays that hit from inside the solid */
    real index_of_refraction, inverse_index;
    real min_highlight; /* cosine whose power is 2^-60; a smaller one counts as 0 */
    int shininess, lit_from_behind, unused_int[2];
} Material;

typedef struct ALIGNED_16 {
    real intensity[3];
    /* 1 over the square of the falloff's length; negative: the light ends there; 0: no falloff */
    real inverse_falloff_squared;
    int own_face[2]; /* faces that hold an edge light; -1: none */
    int cluster;     /* number of its cluster (light_clusters) */
    int run; /* length of the run of consecutive lights of a cluster that begins here; 0: not the
                first one, or, for packets of one lane, a light that is tested alone */
} Light;

/* The count of light clusters: none if the lights are few, otherwise a multiple of all lane counts.
 */
enum { HD_MAX_LIGHT_CLUSTERS = 256 };
#define HD_LIGHT_CLUSTERS(lights)                                                                  \
    ((lights) < 16                          ? 0                                                    \
     : (lights) > 8 * HD_MAX_LIGHT_CLUSTERS ? HD_MAX_LIGHT_CLUSTERS                                \
                                            : ((lights) + 127) / 128 * 16)

/* Rows for each cluster: a sphere about its lights, relative to an object, and the distance at
   which all of its lights have ended. */
enum {
    HD_CLUSTER_X,
    HD_CLUSTER_Y,
    HD_CLUSTER_Z,
    HD_CLUSTER_RADIUS,
    HD_CLUSTER_REACH,
    HD_CLUSTER_ROWS
};

/* For packets of one lane: a sphere about the lights of a run, and their reach. */
typedef struct ALIGNED_16 {
    real place[3], radius; /* relative to an object */
    real reach, unused[3];
} LightRun;

/* The count of objects, from the first on, that have a bit in occlusion masks. */
enum { HD_MASKED_OBJECTS = 30 };

/* The side of an object's faces that a light is on, a bit for each face. The light is strictly
   inside faces with a bit in neither word. */
typedef struct ALIGNED_16 {
    uint outside, on_plane, unused[2];
} LightSides;

/* Texture coordinates (s, t), in the unit square, of a point X of the floor: on a parallelogram
   s = axis_s.X + start[0], t = axis_t.X + start[1]. Otherwise, with floor coordinates
   a = axis_a.X, b = axis_b.X, they solve (a, b) = origin + s e + t f + s t g (inverse bilinear
   interpolation). */
typedef struct ALIGNED_16 {
    real axis_s[3], unused3;
    real axis_t[3], unused4;
    real start[2], unused5[2];
    real axis_a[3], unused0;
    real axis_b[3], unused1;
    real origin[2], e[2];
    real f[2], g[2];
    real orientation, unused2[3]; /* +1 or -1: the sign of the map's determinant */
    int picture;                  /* -1: none */
    int is_parallelogram;
    int unused_int[2];
} FloorMap;

/* An instance of a mesh. In mesh coordinates the longest side of the mesh's box runs from -1 to 1.
   They are row . p for each row of `to_mesh` and a point p relative to the instance's start;
   `to_world` is the inverse. Its triangles are [first_triangle, first_triangle + triangle_count).
   */
typedef struct ALIGNED_16 {
    real start[3];        /* the mesh's origin, relative to the meshes' centre */
    real contact_squared; /* square of the distance, in mesh coordinates, that rounding may put
                             between a point and its surface */
    real to_mesh[3][3];
    real to_world[3][3];
    real unused[2];
    int root; /* node, a wide one if packets have several lanes; -1: kernels test every triangle */
    int first_corner_colours; /* place of its first triangle in corner_colours; -1: there are none
                               */
    int first_triangle, triangle_count;
    int first_mesh_material;
    int first_face;           /* number of the face that is its group 1 */
    int first_corner_normals; /* place of its first triangle in corner_normals; -1: the mesh is flat
                               */
    int first_corner_uvs;     /* likewise; -1: there are none */
} Instance;

/* Corners counterclockwise as seen from outside. */
typedef struct ALIGNED_16 {
    real a[3], tag; /* a whole number: mesh material * HD_TRIANGLE_GROUPS + group */
    real b[3], unused0;
    real c[3], unused1;
} Triangle;

enum {
    HD_TRIANGLE_GROUPS = 32,
    HD_TRIANGLE_GROUP_BITS = 5,
    HD_LEAF_ITEM_BITS = 4,
    HD_LEAF_ITEM_MASK = 15
};

/* The boxes of two children: bounds[axis][0] their lower bounds, bounds[axis][1] the upper ones. A
   negative child is a leaf: ~child is first << HD_LEAF_ITEM_BITS | count. Its items are `count`
   triangles, or entries of top_items, from `first` on. The first child lies lower on `axis`. */
typedef struct ALIGNED_16 {
    real bounds[3][2][2];
    int child[2];
    int axis;
    int unused;
} MeshNode;

/* A material of a mesh, and how it filters light from outside and from inside. Filters are optical
   densities in factors of two: the binary logarithm of 1 over the transmitted share. They are whole
   numbers of 2^-24 and, for the remainder, of 2^-48; each is at most HD_OPAQUE_DENSITY. */
typedef struct ALIGNED_16 {
    real emission[3], unused;            /* radiance */
    int filter[2][4], filter_rest[2][4]; /* red, green, blue; the fourth: whether it is opaque */
    int material;
    int picture; /* -1: none */
    int mask;    /* likewise: the picture that cuts holes, where red is below a half; only in a
                    mesh with texture coordinates */
    int unused_int;
} MeshMaterial;

enum {
    HD_DENSITY_BITS = 24,
    HD_DENSITY_ONE = 1 << HD_DENSITY_BITS,
    HD_OPAQUE_DENSITY = 41 << HD_DENSITY_BITS,
    HD_DARK_DENSITY = 40 << HD_DENSITY_BITS
};

/* A texture, which repeats or continues its border's texels outwards. */
typedef struct ALIGNED_16 {
    int first_texel, width, height, is_clamped;
} Picture;

typedef struct ALIGNED_16 {
    real u, v, unused[2];
} TextureCoordinates;

/* One frame. The direction to the image point (i, j) is forward + i * right + j * down; i and j
   count half steps of a sample grid from the middle of the whole picture. The grid has grid_side x
   grid_side places for samples in each pixel.

   An ordinary frame samples all places of the grid, row by row. In a patterned frame, each pixel
   has the places sample_places[i] = column | row << 16 of its grid; the list is repeated to
   HD_PATTERN_SPARE more elements, for packets across pixels. In a listed frame, which is patterned,
   pixel e is entries[e] = x | y << 16 of the whole picture, or -1: none. */
typedef struct ALIGNED_16 {
    real forward[3], cutoff;
    real right[3], to_fixed;  /* 2^(fraction bits of a sample) */
    real down[3], from_fixed; /* factor from a pixel's sum to its samples' radiance */
    real bound_cutoff; /* in scenes with an error bound: rays and lights that add less than this to
                          a sample, after exposure, are left out; 0: none */
    real bound_to_fixed;   /* 2^(fraction bits of a sample's error bound) */
    real bound_from_fixed; /* factor from a pixel's sum to its samples' error bounds */
    real unused;
    int width, height;
    int samples; /* samples in a pixel */
    int grid_side;
    int first_column, first_row; /* i and j of the first sample of the frame */
    int listed;
    int depth;
    int pixel_shift; /* bits that a sample loses when it is added to a pixel's sum */
    int bound_shift; /* likewise for its error bound */
    int patterned;
    int unused_int;
} View;

enum { HD_PATTERN_SPARE = 16 };

#define HD_ASSERT_SIZE(type, reals, ints)                                                          \
    typedef char hd_size_of_##type##_is_as_documented                                              \
        [sizeof(type) == (reals) * sizeof(real) + (ints)*4 ? 1 : -1]
HD_ASSERT_SIZE(Vector, 4, 0);
HD_ASSERT_SIZE(Header, 12, 16);
HD_ASSERT_SIZE(Plane, 4, 0);
HD_ASSERT_SIZE(Object, 16, 12);
HD_ASSERT_SIZE(Edge, 12, 0);
HD_ASSERT_SIZE(Material, 16, 4);
HD_ASSERT_SIZE(Light, 4, 4);
HD_ASSERT_SIZE(LightRun, 8, 0);
HD_ASSERT_SIZE(LightSides, 0, 4);
HD_ASSERT_SIZE(FloorMap, 32, 4);
HD_ASSERT_SIZE(Instance, 24, 8);
HD_ASSERT_SIZE(Triangle, 12, 0);
HD_ASSERT_SIZE(MeshNode, 12, 4);
HD_ASSERT_SIZE(MeshMaterial, 4, 20);
HD_ASSERT_SIZE(Picture, 0, 4);
HD_ASSERT_SIZE(TextureCoordinates, 4, 0);
HD_ASSERT_SIZE(View, 16, 12);

/* The tables of a scene, in the order of the kernels' arguments. */
#define HD_SCENE_TABLES(X)                                                                         \
    X(Header, header)                                                                              \
    X(Object, objects)                                                                             \
    X(Plane, planes)                                                                               \
    X(Edge, edges)                                                                                 \
    X(Material, materials)                                                                         \
    X(Light, lights)                                                                               \
    /* [object * light_count + light]: the light relative to the object */                         \
    X(Vector, light_offsets)                                                                       \
    /* [light * plane_count + plane]: n.L of a solid's plane, which is exactly `distance` for the  \
       own faces of an edge light; the distance to a floor's plane */                              \
    X(real, light_coordinates)                                                                     \
    /* [light * object_count + object], of solids only */                                          \
    X(LightSides, light_sides)                                                                     \
    /* [object * (light_count + 1)]: a bit for each solid, and the floor, that occludes no light   \
       from points of the object; then the same for each light */                                  \
    X(int, occlusion_masks)                                                                        \
    /* [(object * HD_CLUSTER_ROWS + row) * clusters + cluster] */                                  \
    X(real, light_clusters)                                                                        \
    /* [object * light_count + light], of the first light of each run; only for packets of one     \
       lane */                                                                                     \
    X(LightRun, light_runs)                                                                        \
    /* [from * object_count + to]: centre of `from` minus that of `to` */                          \
    X(Vector, object_offsets)                                                                      \
    X(FloorMap, floor_map)                                                                         \
    /* of pictures, two words each: r | g << 16, b; row by row, with one more column and row */    \
    X(uint, texels)                                                                                \
    X(Instance, instances)                                                                         \
    /* of all meshes, in the order of the leaves */                                                \
    X(Triangle, triangles)                                                                         \
    /* over the instances; for packets of one lane also of all meshes */                           \
    X(MeshNode, mesh_nodes)                                                                        \
    /* of nodes with as many children as packets have lanes: lower x, y, z of all of them, then    \
       upper; none for packets of one lane */                                                      \
    X(real, wide_bounds)                                                                           \
    /* likewise */                                                                                 \
    X(int, wide_children)                                                                          \
    /* numbers of instances */                                                                     \
    X(int, top_items)                                                                              \
    X(MeshMaterial, mesh_materials)                                                                \
    X(Vector, mesh_normals)                                                                        \
    /* [3 * triangle + corner]: places in mesh_normals; negative: none */                          \
    X(int, corner_normals)                                                                         \
    X(TextureCoordinates, mesh_uvs)                                                                \
    /* [3 * triangle + corner]: places in mesh_uvs */                                              \
    X(int, corner_uvs)                                                                             \
    /* [3 * triangle + corner]: tints of the material's colour */                                  \
    X(Vector, corner_colours)                                                                      \
    X(Picture, pictures)

/* The tables of a frame, whose arguments follow. */
#define HD_FRAME_TABLES(X)                                                                         \
    X(View, view)                                                                                  \
    /* [to]: the eye minus the centre of `to` */                                                   \
    X(Vector, eye_offsets)                                                                         \
    /* of a listed frame */                                                                        \
    X(int, entries)                                                                                \
    /* of a patterned frame */                                                                     \
    X(int, sample_places)

/* Tables whose rows neighbouring threads mostly read together, and how many rows constant memory
   holds. */
#define HD_SMALL_SCENE_TABLES(X)                                                                   \
    X(Header, header, 1)                                                                           \
    X(Object, objects, 16)                                                                         \
    X(Plane, planes, 128)                                                                          \
    X(Edge, edges, 128)                                                                            \
    X(Vector, object_offsets, 256)                                                                 \
    X(FloorMap, floor_map, 1)
#define HD_SMALL_FRAME_TABLES(X)                                                                   \
    X(View, view, 1)                                                                               \
    X(Vector, eye_offsets, 16) /* as many as objects */

#define HD_TABLE_INDEX(type, name) HD_TABLE_##name,
enum { HD_SCENE_TABLES(HD_TABLE_INDEX) HD_SCENE_TABLE_COUNT };
enum { HD_FRAME_TABLES(HD_TABLE_INDEX) HD_FRAME_TABLE_COUNT };

/* The counts of one work item, except its primary rays. A ray is a closest-hit search of a live
   lane. A shadow test is a pair of a lit point and a light that may reach it. A clamp is a
   contribution that was limited to 2^16. */
typedef struct ALIGNED_16 {
    uint64 mirrored, transmitted, shadow_tests, clamps;
} RayCounts;

enum { HD_RAY_COUNTS = 4 };
HD_ASSERT_SIZE(RayCounts, 0, 2 * HD_RAY_COUNTS);

/* Limits after exposure: of one contribution, and of a ray of weight 1, which adds one contribution
   at each depth of the deepest tree. */
enum { HD_CONTRIBUTION_LIMIT = 1 << 16, HD_RADIANCE_LIMIT = HD_CONTRIBUTION_LIMIT * 1001 };

/* The sums of a pixel, each of which gives a float: red, green, blue and, in scenes with an error
   bound, that bound after exposure. */
enum { HD_RADIANCE_SUMS = 3, HD_BOUNDED_SUMS = 4 };

/* First hits of a pixel: the share of its samples that hit anything, then the hit of the ray
   through its centre. That is the distance, the normal towards the eye, and the object's number
   from 1 on; all are 0 if the ray hits nothing. */
enum { HD_ALPHA_FLOATS = 1, HD_FIRST_FLOATS = 6 };

/* Planes of the floor: its own one and one for each side. */
enum { HD_FLOOR_SIDES = 4, HD_FLOOR_PLANES = 1 + HD_FLOOR_SIDES };

/* The picture is divided into blocks of HD_BLOCK_SIDE x HD_BLOCK_SIDE pixels, row by row, with Z
   order within a block. A work item renders HD_PIXELS_PER_ITEM consecutive pixels of that order. */
enum { HD_BLOCK_SIDE = 8, HD_BLOCK_PIXELS = 64 };

/* Column and row of pixel number `z` of a block, for an integer or a packet. */
#define HD_Z_COLUMN(z) (((z)&1) | ((z) >> 1 & 2) | ((z) >> 2 & 4))
#define HD_Z_ROW(z)    (((z) >> 1 & 1) | ((z) >> 2 & 2) | ((z) >> 3 & 4))

#endif
