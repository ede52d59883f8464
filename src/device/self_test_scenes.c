/* SPDX-License-Identifier: MIT */
#include "device/self_test_scenes.h"

#include <stdlib.h>
#include <string.h>

#include "mesh/mesh.h"

enum { SIDE = 16, SAMPLES = 2, DEPTH = 5, MOST_DEPTH = 8, TEXTURE_WIDTH = 6, TEXTURE_HEIGHT = 5 };

static HdMaterial material(HdVec3 colour, double reflection, double transmission) {
    return (HdMaterial){.colour = colour,
                        .mirror_tint = hd_vec3(0.9, 0.95, 1.0),
                        .ambient = 0.02,
                        .diffuse = 0.4,
                        .specular = 0.3,
                        .shininess = 21,
                        .reflection = reflection,
                        .transmission = transmission,
                        .index_of_refraction = 1.0};
}

static HdPath fixed(HdVec3 point) {
    return (HdPath){.is_fixed = true, .point = point};
}

/* For a scene to own. */
static void *copy_of(const void *from, size_t bytes, bool *has_room) {
    void *copy = malloc(bytes);
    if (copy != NULL)
        memcpy(copy, from, bytes);
    *has_room = *has_room && copy != NULL;
    return copy;
}

/* Lights of which one fades and one ends; the second lies within the cube. A row of others is out
   of reach, which kernels that judge lights together find out for many at once. */
static void add_lights(HdScene *scene, bool *has_room) {
    enum { FAR = 40 };
    HdLight lights[2 + FAR] = {
        {.position = {1.5, -2.5, 3.0}, .intensity = {1.0, 0.9, 0.7}, .falloff = {.distance = 4.0}},
        {.position = {0.125, -0.25, 0.25}, .intensity = {0.3, 0.5, 0.9}, .falloff = {.end = 6.0}}};
    for (int i = 0; i < FAR; i++)
        lights[2 + i] = (HdLight){.position = {0.0, 0.0, 100.0 + i},
                                  .intensity = {1.0, 1.0, 1.0},
                                  .falloff = {.end = 50.0}};
    scene->lights = copy_of(lights, sizeof lights, has_room);
    scene->light_count = sizeof lights / sizeof *lights;
}

static HdMaterial glass(bool refracts, bool lit_from_behind) {
    HdMaterial glass = material(hd_vec3(0.8, 0.9, 0.6), 0.15, 0.7);
    glass.has_inner_side = true;
    glass.inner_reflection = 0.6;
    glass.inner_transmission = 0.35;
    glass.lit_from_behind = lit_from_behind;
    if (refracts)
        glass.index_of_refraction = 1.5;
    return glass;
}

/* Highlights of four exponents, rims, lights along the edges and many levels of rays: threads of a
   warp part often. The solids are apart, since one refracts. */
static void add_solids(HdScene *scene, bool refracts, bool lit_from_behind, bool *has_room) {
    HdSolid solids[] = {{.kind = HD_HEXAHEDRON,
                         .circumradius = 1.25,
                         .rotation_degrees = {10.0, 20.0, 30.0},
                         .face = glass(refracts, lit_from_behind),
                         .rim_width = 0.1,
                         .rim = material(hd_vec3(0.3, 0.2, 0.1), 0.0, 0.0),
                         .lights = {.per_edge = 2,
                                    .colour_count = 2,
                                    .colours = {{1.0, 0.5, 0.25}, {0.25, 0.75, 1.0}},
                                    .intensity = 0.0625,
                                    .falloff = {.distance = 1.25},
                                    .disc_radius = 0.0625,
                                    .disc_radiance = 2.0}},
                        {.kind = HD_TETRAHEDRON,
                         .centre = {-0.75, 1.75, 0.25},
                         .circumradius = 0.625,
                         .rotation_degrees = {-20.0, 35.0, 50.0},
                         .face = material(hd_vec3(0.6, 0.5, 0.9), 0.3, 0.6),
                         .rim_width = 0.05,
                         .rim = material(hd_vec3(0.4, 0.9, 0.8), 0.5, 0.0),
                         .lights = {.per_edge = 1,
                                    .colour_count = 1,
                                    .colours = {{0.5, 1.0, 0.25}},
                                    .intensity = 0.125,
                                    .falloff = {.end = 7.0},
                                    .disc_radius = 0.03125,
                                    .disc_radiance = 1.5}}};
    solids[0].rim.shininess = 3;
    solids[1].face.shininess = 200;
    solids[1].face.lit_from_behind = lit_from_behind;
    solids[1].rim.shininess = 2;
    scene->solids = copy_of(solids, sizeof solids, has_room);
    scene->solid_count = sizeof solids / sizeof *solids;
    scene->depth = MOST_DEPTH;
}

static HdTexture texture(bool *has_room) {
    uint16_t texels[TEXTURE_WIDTH * TEXTURE_HEIGHT * 3];
    for (int i = 0; i < TEXTURE_WIDTH * TEXTURE_HEIGHT * 3; i++)
        texels[i] = (uint16_t)(i * 40503 + 12345);
    return (HdTexture){.width = TEXTURE_WIDTH,
                       .height = TEXTURE_HEIGHT,
                       .texels = copy_of(texels, sizeof texels, has_room)};
}

static void add_floor(HdScene *scene, bool *has_room) {
    scene->floor = (HdFloor){
        .present = true,
        .corners = {{-3.0, 3.0, -1.5}, {3.0, 3.0, -1.5}, {3.0, -3.0, -1.5}, {-3.0, -3.0, -1.5}},
        .material = material(hd_vec3(0.9, 0.8, 0.7), 0.2, 0.3),
        .texture = texture(has_room),
    };
}

/* ---- meshes ---- */

/* The points of a lattice of 3 x 3 x 3, all but its middle: each face has four squares. */
enum { POINTS = 26, MIDDLE = 13, FACES = 6, TRIANGLES = 48 };

typedef struct Lattice {
    HdVec3 places[POINTS];
    double uvs[POINTS][2];
    int32_t corners[TRIANGLES][3];
    int32_t material_of[TRIANGLES]; /* 0 and, above and below, 1 */
    uint8_t group_of[TRIANGLES];    /* of each face one */
} Lattice;

/* Of the point with the coordinates 0, 1 or 2. */
static int32_t number_of(const int point[3]) {
    int number = point[0] + 3 * point[1] + 9 * point[2];
    return number < MIDDLE ? number : number - 1;
}

static HdVec3 place_of(const int point[3], bool is_ball) {
    static const double reach[4] = {0.0, 1.0, 0.75, 0.625};
    int away = 0;
    for (int axis = 0; axis < 3; axis++)
        away += point[axis] != 1;
    return hd_scale(hd_vec3(point[0] - 1, point[1] - 1, point[2] - 1), is_ball ? reach[away] : 1.0);
}

static void place_points(Lattice *lattice, bool is_ball) {
    for (int i = 0; i < POINTS; i++) {
        int number = i < MIDDLE ? i : i + 1;
        const int point[3] = {number % 3, number / 3 % 3, number / 9};
        HdVec3 place = lattice->places[i] = place_of(point, is_ball);
        lattice->uvs[i][0] = 0.5 * place.x + 0.25 * place.z;
        lattice->uvs[i][1] = 0.75 * place.y - 0.125 * place.z;
    }
}

/* The square with the given lowest corner, on the lower or the upper face across an axis. */
static void add_square(Lattice *lattice, int number, int face, int first, int second) {
    static const int steps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    int axis = face / 2, upper = face % 2;
    int32_t around[4];
    for (int k = 0; k < 4; k++) {
        const int *step = steps[upper ? k : 3 - k]; /* counterclockwise as seen from outside */
        int point[3];
        point[axis] = 2 * upper;
        point[(axis + 1) % 3] = first + step[0];
        point[(axis + 2) % 3] = second + step[1];
        around[k] = number_of(point);
    }
    for (int half = 0; half < 2; half++) {
        int32_t *corners = lattice->corners[number + half];
        corners[0] = around[0];
        corners[1] = around[1 + half];
        corners[2] = around[2 + half];
        lattice->material_of[number + half] = axis == 2;
        lattice->group_of[number + half] = (uint8_t)(face + 1);
    }
}

static HdMesh mesh_of(const Lattice *lattice, bool is_ball, bool *has_room) {
    HdMesh mesh = {.vertex_count = POINTS,
                   .vertices = copy_of(lattice->places, sizeof lattice->places, has_room),
                   .triangle_count = TRIANGLES,
                   .corners = copy_of(lattice->corners, sizeof lattice->corners, has_room)};
    if (is_ball) {
        mesh.normal_count = mesh.uv_count = POINTS;
        mesh.normals = copy_of(lattice->places, sizeof lattice->places, has_room);
        mesh.uvs = copy_of(lattice->uvs, sizeof lattice->uvs, has_room);
        mesh.corner_normals = copy_of(lattice->corners, sizeof lattice->corners, has_room);
        mesh.corner_uvs = copy_of(lattice->corners, sizeof lattice->corners, has_room);
        mesh.material_of = copy_of(lattice->material_of, sizeof lattice->material_of, has_room);
    } else {
        mesh.group_of = copy_of(lattice->group_of, sizeof lattice->group_of, has_room);
    }
    return mesh;
}

/* A closed mesh of 48 triangles whose corners are exact numbers on every system: a ball with smooth
   normals, texture coordinates and the materials 0 and 1; or a cube within +-1 whose faces are
   groups, of material 0. */
static HdMesh make_mesh(bool is_ball, const HdMeshMaterial *materials, int count, bool *has_room) {
    Lattice lattice;
    place_points(&lattice, is_ball);
    for (int square = 0; square < 4 * FACES; square++)
        add_square(&lattice, 2 * square, square / 4, square % 2, square / 2 % 2);
    HdMesh mesh = mesh_of(&lattice, is_ball, has_room);
    mesh.materials = copy_of(materials, (size_t)count * sizeof *materials, has_room);
    mesh.material_count = count;
    return mesh;
}

enum { BALL, CUBE, MESHES, INSTANCES = 4 };

static void make_meshes(HdMesh meshes[MESHES], bool refracts, bool lit_from_behind,
                        bool *has_room) {
    HdMeshMaterial ball[2] = {
        {.material = glass(refracts, lit_from_behind), .picture = -1, .passes_as = -1},
        {.material = material(hd_vec3(0.9, 0.7, 0.8), 0.1, 0.5),
         .emission = {0.05, 0.1, 0.02},
         .picture = 0,
         .passes_as = 0}};
    const HdMeshMaterial cube = {
        .material = material(hd_vec3(0.6, 0.3, 0.2), 0.5, 0.0), .picture = -1, .passes_as = -1};
    ball[1].material.lit_from_behind = lit_from_behind;
    ball[1].material.index_of_refraction = ball[0].material.index_of_refraction;
    meshes[BALL] = make_mesh(true, ball, 2, has_room);
    meshes[CUBE] = make_mesh(false, &cube, 1, has_room);
}

/* So many that there is a hierarchy over them, none of them in another. */
static void place_meshes(HdScene *scene, bool *has_room) {
    const HdInstance instances[INSTANCES] = {
        {.mesh = BALL,
         .position = {0.0, 0.0, 0.125},
         .rotation_degrees = {10.0, 20.0, 30.0},
         .scale = {1.0, 0.875, 0.75}},
        {.mesh = BALL,
         .position = {1.0, 1.25, 0.5},
         .scale = {0.5, 0.5, 0.5},
         .has_material = true,
         .material = material(hd_vec3(0.5, 0.75, 1.0), 0.25, 0.5)},
        {.mesh = CUBE,
         .position = {-1.0, 0.75, -1.0},
         .rotation_degrees = {0.0, 0.0, 25.0},
         .scale = {0.375, 0.375, 0.375}},
        {.mesh = CUBE,
         .position = {0.625, -1.0, -0.75},
         .rotation_degrees = {15.0, 0.0, 40.0},
         .scale = {0.375, 0.25, 0.125}},
    };
    scene->instances = copy_of(instances, sizeof instances, has_room);
    scene->instance_count = INSTANCES;
}

static void add_meshes(HdScene *scene, bool refracts, bool lit_from_behind, bool *has_room) {
    HdMesh meshes[MESHES];
    HdPicture picture = {.texture = texture(has_room)};
    make_meshes(meshes, refracts, lit_from_behind, has_room);
    place_meshes(scene, has_room);
    scene->meshes = copy_of(meshes, sizeof meshes, has_room);
    scene->mesh_count = scene->meshes != NULL ? MESHES : 0;
    scene->pictures = copy_of(&picture, sizeof picture, has_room);
    scene->picture_count = scene->pictures != NULL ? 1 : 0;
    for (int i = scene->mesh_count; i < MESHES; i++)
        hd_mesh_free(&meshes[i]);
    if (scene->pictures == NULL)
        hd_texture_clear(&picture.texture);
}

static HdStatus build_meshes(HdScene *scene, HdError *error) {
    HdThreadPool *pool = NULL;
    HdStatus status = hd_thread_pool_create(&pool, 1, error);
    for (int i = 0; status == HD_OK && i < scene->mesh_count; i++)
        status = hd_mesh_build(&scene->meshes[i], pool, error);
    hd_thread_pool_destroy(pool);
    return status;
}

HdStatus hd_self_test_scene(HdScene *scene, HdSelfTestFrame frame, bool refracts,
                            bool lit_from_behind, HdError *error) {
    bool has_room = true;
    *scene = (HdScene){.frame_count = 1,
                       .eye = fixed(hd_vec3(2.0, -2.75, 1.25)),
                       .target = fixed(hd_vec3(0.0, 0.0, -0.25)),
                       .field_of_view_degrees = 50.0,
                       .width = SIDE,
                       .height = SIDE,
                       .samples_per_side = SAMPLES,
                       .depth = DEPTH,
                       .cutoff = 0.001,
                       .exposure = 1.25,
                       .background = hd_vec3(0.01, 0.02, 0.04)};
    add_lights(scene, &has_room);
    if (frame == HD_SELF_TEST_SOLID)
        add_solids(scene, refracts, lit_from_behind, &has_room);
    else
        add_floor(scene, &has_room);
    if (frame == HD_SELF_TEST_MESH)
        add_meshes(scene, refracts, lit_from_behind, &has_room);
    HdStatus status =
        has_room ? build_meshes(scene, error)
                 : hd_fail(error, HD_FAILED, "out of memory: no room for the test of the kernels");
    if (status != HD_OK)
        hd_scene_free(scene);
    return status;
}
