/* SPDX-License-Identifier: MIT */
/* What a kernel reads: the tables of a compiled scene and of one frame. The host fills them
   (src/tables), a backend copies them as they are.

   Every struct holds reals first, then 32-bit integers, each a multiple of four in number, so that
   it has no padding in float and in double. "Object" is a solid, the floor or, last of all, one
   object for all meshes. Geometry of an object is relative to its own centre. Signed distances are
   positive outside. Rays and hits count on beyond the objects: number floor_end + i is the mesh
   instance i, whose object is floor_end. */
#ifndef HD_SCENE_TABLES_H
#define HD_SCENE_TABLES_H

#include "real.h"

typedef struct ALIGNED_16 {
    real x, y, z, unused;
} Vector;

typedef struct ALIGNED_16 {
    real background[3]; /* radiance */
    real exposure;
    real mesh_reach; /* no coordinate of a mesh, relative to their centre, is larger */
    real unused0;
    real light_bound[3]; /* the lights' intensities, added up; of surveyed scenes */
    real unused1[3];
    int solid_count; /* the floor, if there is one, is object number solid_count */
    int floor_end;
    int object_count;
    int plane_count;
    int light_count;
    int instance_count;
    int top_root;        /* node over all instances; -1: they are tried one by one */
    int node_stack;      /* most nodes that wait while one walks through a hierarchy */
    int wide_stack;      /* likewise of the wide nodes */
    int refracts;        /* some index of refraction is not 1 */
    int lit_from_behind; /* some material is */
    int bounded;         /* pixels come with their survey (HD_PIXEL_SUMS) */
} Header;

/* Of a solid with parallel faces (Object.paired): the planes n.x = distance and n.x = -distance of
   two opposite faces; of another one: the plane n.x = distance of a face. A face's number is twice
   that of its plane, and one more for n.x = -distance. Of the floor: its own plane first, then four
   upright ones that bound it. */
typedef struct ALIGNED_16 {
    real x, y, z, distance;
} Plane;

typedef struct ALIGNED_16 {
    real rim_depth; /* a point of a face lies on the rim when it is nearer than this to the plane of
                       another face: the rim's width times the sine of the dihedral angle */
    real disc_depth; /* likewise for the radius of the edge lights' discs */
    real disc_radius_squared;
    real edge_half_length;
    real circumradius_squared;
    real radius_about;       /* a little more than the circumradius */
    real disc_reach_squared; /* no disc is further away from the middle of its edge */
    real unused;
    real seen_outside[3], unused0; /* no ray that leaves it sees more; of surveyed scenes */
    real seen_inside[3], unused1;  /* likewise inwards */
    int first_plane, plane_count;
    int first_edge, edge_count;
    int face_material, rim_material;
    int lights_per_edge;
    int paired;   /* its faces come in parallel pairs */
    int isolated; /* nothing else reaches into the sphere about it */
    int unused_int[3];
} Object;

typedef struct ALIGNED_16 {
    real middle[3], unused0;
    real direction[3], unused1; /* unit */
    real disc_radiance[3], unused2;
} Edge;

/* What a material's row has as the scene does, in colours and numbers. */
#define HD_PLAIN_TERMS(COLOUR, NUMBER)                                                             \
    COLOUR(colour)                                                                                 \
    NUMBER(ambient)                                                                                \
    COLOUR(mirror_tint)                                                                            \
    NUMBER(diffuse) NUMBER(specular) NUMBER(reflection) NUMBER(transmission)
#define HD_ROW_COLOUR(term) real term[3];
#define HD_ROW_NUMBER(term) real term;

typedef struct ALIGNED_16 {
    HD_PLAIN_TERMS(HD_ROW_COLOUR, HD_ROW_NUMBER)
    real inner_reflection, inner_transmission; /* for rays that meet it from inside the solid */
    real index_of_refraction, inverse_index;
    real min_highlight; /* a cosine whose power is less than 2^-60 counts as 0 */
    int shininess, lit_from_behind, unused_int[2];
} Material;

typedef struct ALIGNED_16 {
    real intensity[3];
    /* 1 over the square of the falloff's length; negative: at which nothing is left; 0: none */
    real inverse_falloff_squared;
    int own_face[2]; /* the faces that hold an edge light; -1: none */
    int cluster;     /* of lights near each other (light_clusters) */
    int run; /* so many lights of its cluster follow each other from this one on, which is the
                first; 0: another one, or, where packets have one lane, it is judged alone */
} Light;

/* How many clusters lights make: none where there are too few to be worth it, otherwise a multiple
   of what packets hold. */
enum { HD_MAX_LIGHT_CLUSTERS = 256 };
#define HD_LIGHT_CLUSTERS(lights)                                                                  \
    ((lights) < 16                          ? 0                                                    \
     : (lights) > 8 * HD_MAX_LIGHT_CLUSTERS ? HD_MAX_LIGHT_CLUSTERS                                \
                                            : ((lights) + 127) / 128 * 16)

/* Of spheres about the lights of each cluster: place relative to an object, radius; and the
   distance beyond which nothing is left of any of its lights. */
enum {
    HD_CLUSTER_X,
    HD_CLUSTER_Y,
    HD_CLUSTER_Z,
    HD_CLUSTER_RADIUS,
    HD_CLUSTER_REACH,
    HD_CLUSTER_ROWS
};

/* Where packets have one lane: a sphere about the lights of a run, and their reach. */
typedef struct ALIGNED_16 {
    real place[3], radius; /* relative to an object */
    real reach, unused[3];
} LightRun;

/* Of so many objects, the first ones, is known whether they are beside the ways of light. */
enum { HD_MASKED_OBJECTS = 30 };

/* On which side of an object's faces a light is, a bit for each face from the object's first one
   on. It is strictly inside of those that are in neither word. */
typedef struct ALIGNED_16 {
    uint outside, on_plane, unused[2];
} LightSides;

/* Texture coordinates (s, t) in the unit square of a point X of the floor. Of a parallelogram they
   are s = axis_s.X + start[0], t = axis_t.X + start[1]. Otherwise, with floor coordinates
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

/* A mesh in its place. A mesh has coordinates of its own, in which its box's longest side runs from
   -1 to 1: row . p for each row of `to_mesh` and a point p relative to the instance's start;
   `to_world` leads back. Its triangles have the numbers [first_triangle, first_triangle +
   triangle_count). */
typedef struct ALIGNED_16 {
    real start[3];        /* the mesh's origin, relative to the meshes' centre */
    real contact_squared; /* of the distance, in the mesh's coordinates, that rounding may put
                             between a point of the mesh and its surface */
    real to_mesh[3][3];
    real to_world[3][3];
    real unused[2];
    int root; /* a node, of the wide ones where packets have lanes; -1: every triangle is tried */
    int unused_int;
    int first_triangle, triangle_count;
    int first_mesh_material;
    int first_face;           /* number of the face that is its group 1 */
    int first_corner_normals; /* place of its first triangle's in corner_normals; -1: it is flat */
    int first_corner_uvs;     /* likewise; -1: there are none */
} Instance;

/* Counterclockwise as seen from outside. */
typedef struct ALIGNED_16 {
    real a[3], tag; /* a whole number: skin * HD_TRIANGLE_GROUPS + group */
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
   child that is negative is a leaf: ~child is first << HD_LEAF_ITEM_BITS | count, and its items are
   the triangles, or the entries of top_items, from number `first` on. The first child lies lower on
   `axis`. */
typedef struct ALIGNED_16 {
    real bounds[3][2][2];
    int child[2];
    int axis;
    int unused;
} MeshNode;

/* What a mesh's triangles show: a material, and how they filter light on its way to a point, met
   from outside and from inside: in octaves, the binary logarithm of 1 over what passes, as whole
   numbers of 2^-24 and, what that leaves out, of 2^-48; each is at most HD_OPAQUE_DENSITY. */
typedef struct ALIGNED_16 {
    real emission[3], unused;            /* radiance */
    int filter[2][4], filter_rest[2][4]; /* red, green, blue; the fourth: nothing passes at all */
    int material;
    int picture; /* -1: none */
    int unused_int[2];
} MeshMaterial;

enum {
    HD_DENSITY_BITS = 24,
    HD_DENSITY_ONE = 1 << HD_DENSITY_BITS,
    HD_OPAQUE_DENSITY = 41 << HD_DENSITY_BITS,
    HD_DARK_DENSITY = 40 << HD_DENSITY_BITS
};

/* A texture: repeated without end, or its border's texels continued outwards. */
typedef struct ALIGNED_16 {
    int first_texel, width, height, is_clamped;
} Picture;

typedef struct ALIGNED_16 {
    real u, v, unused[2];
} TextureCoordinates;

/* One frame. The direction to the image point (i, j), counted in half steps of a sample grid from
   the middle of the whole picture, is forward + i * right + j * down. The grid has grid_side x
   grid_side places for samples in each pixel.

   Pixels that follow each other in the picture have all places of the grid, row by row. A listed
   frame has any: its pixel number e is entries[2 e] = x | y << 16 of the whole picture, with the
   samples sample_places[entries[2 e + 1] + i] = column | row << 16 of the pixel's grid; there is
   none where entries[2 e + 1] is negative. */
typedef struct ALIGNED_16 {
    real forward[3], cutoff;
    real right[3], to_fixed;  /* 2^(fraction bits of a sample) */
    real down[3], from_fixed; /* a pixel's sum times this is the sum of its samples' radiance */
    real bound_cutoff;   /* of surveyed scenes: rays and lights that cannot add more than this to a
                            sample, after exposure, are left out; 0: none are */
    real bound_to_fixed; /* 2^(fraction bits of a sample's bound) */
    real bound_from_fixed; /* a pixel's sum times this is the sum of its samples' bounds */
    real unused;
    int width, height;
    int samples; /* of a pixel */
    int grid_side;
    int first_column, first_row; /* i and j of the first sample */
    int listed;
    int depth;
    int pixel_shift; /* bits that a sample loses before it joins a pixel's sum */
    int bound_shift; /* likewise its bound */
    int unused_int[2];
} View;

#define HD_ASSERT_SIZE(type, reals, ints)                                                          \
    typedef char hd_size_of_##type##_is_as_documented                                              \
        [sizeof(type) == (reals) * sizeof(real) + (ints)*4 ? 1 : -1]
HD_ASSERT_SIZE(Vector, 4, 0);
HD_ASSERT_SIZE(Header, 12, 12);
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
    /* [light * plane_count + plane]: n.L of a solid's plane, exactly that of an edge light's      \
       own faces; the distance to a floor's plane */                                               \
    X(real, light_coordinates)                                                                     \
    /* [light * object_count + object], of solids only */                                          \
    X(LightSides, light_sides)                                                                     \
    /* [object * (light_count + 1)]: what is beside all ways from lights to points of the object,  \
       a bit for each solid and the floor that no segment crosses; then the same of each light */  \
    X(int, occlusion_masks)                                                                        \
    /* [(object * HD_CLUSTER_ROWS + row) * clusters + cluster] */                                  \
    X(real, light_clusters)                                                                        \
    /* [object * light_count + light], of the first light of each run; none where packets have     \
       several lanes */                                                                            \
    X(LightRun, light_runs)                                                                        \
    /* [from * object_count + to]: centre of `from` minus that of `to` */                          \
    X(Vector, object_offsets)                                                                      \
    X(FloorMap, floor_map)                                                                         \
    /* of pictures, two words each: r | g << 16, b; row by row, with one more column and row */    \
    X(uint, texels)                                                                                \
    X(Instance, instances)                                                                         \
    /* of all meshes, in the order of the leaves */                                                \
    X(Triangle, triangles)                                                                         \
    /* over the instances; where packets have one lane of all meshes too */                        \
    X(MeshNode, mesh_nodes)                                                                        \
    /* of nodes with as many children as packets have lanes: lower x, y, z of all of them, then    \
       upper; none where packets have one lane */                                                  \
    X(real, wide_bounds)                                                                           \
    /* likewise */                                                                                 \
    X(int, wide_children)                                                                          \
    /* numbers of instances */                                                                     \
    X(int, top_items)                                                                              \
    X(MeshMaterial, mesh_materials)                                                                \
    X(Vector, mesh_normals)                                                                        \
    /* [3 * triangle + corner]: places in mesh_normals; negative: it is flat */                    \
    X(int, corner_normals)                                                                         \
    X(TextureCoordinates, mesh_uvs)                                                                \
    /* [3 * triangle + corner]: places in mesh_uvs */                                              \
    X(int, corner_uvs)                                                                             \
    X(Picture, pictures)

/* The tables of a frame, whose arguments follow. */
#define HD_FRAME_TABLES(X)                                                                         \
    X(View, view)                                                                                  \
    /* [to]: the eye minus the centre of `to` */                                                   \
    X(Vector, eye_offsets)                                                                         \
    /* of a listed frame (View) */                                                                 \
    X(int, entries)                                                                                \
    /* likewise */                                                                                 \
    X(int, sample_places)

/* The tables of solids of which neighbouring threads mostly read the same row at a time, and how
   many rows a device's constant memory holds, where it has some. */
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

/* What one work item counted beside its primary rays. A ray is a closest-hit search of a live lane;
   a shadow test is a pair of a lit point and a light that may reach it; a clamp is a contribution
   that was cut to 2^16. */
typedef struct ALIGNED_16 {
    uint64 mirrored, transmitted, shadow_tests, clamps;
} RayCounts;

/* A contribution is cut to the first; so no ray of weight 1 adds more than the other, which is that
   of each level of the deepest tree. After exposure. */
enum { HD_CONTRIBUTION_LIMIT = 1 << 16, HD_RADIANCE_LIMIT = HD_CONTRIBUTION_LIMIT * 1001 };

/* What is summed up for each pixel, and comes of it as floats: red, green, blue; of surveyed scenes
   also a bound of what was left out, after exposure. */
enum { HD_RADIANCE_SUMS = 3, HD_BOUNDED_SUMS = 4 };

/* What the eye's rays meet first, of each pixel: the share of its samples that meet anything; and
   of the ray through its middle the distance, the normal, which is turned towards the eye, and the
   object's number from 1 on. The latter are 0 where nothing is met. */
enum { HD_ALPHA_FLOATS = 1, HD_FIRST_FLOATS = 6 };

/* The floor has its own plane and one for each of its sides. */
enum { HD_FLOOR_SIDES = 4, HD_FLOOR_PLANES = 1 + HD_FLOOR_SIDES };

/* The picture is cut into blocks of HD_BLOCK_SIDE x HD_BLOCK_SIDE pixels, row by row, and within a
   block follows the Z order; a work item renders HD_PIXELS_PER_ITEM consecutive pixels of that
   order. */
enum { HD_BLOCK_SIDE = 8, HD_BLOCK_PIXELS = 64 };

/* Column and row of pixel number `z` of a block; of an integer or a packet of them. */
#define HD_Z_COLUMN(z) (((z)&1) | ((z) >> 1 & 2) | ((z) >> 2 & 4))
#define HD_Z_ROW(z)    (((z) >> 1 & 1) | ((z) >> 2 & 2) | ((z) >> 3 & 4))

#endif
