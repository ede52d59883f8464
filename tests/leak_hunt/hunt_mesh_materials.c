/* SPDX-License-Identifier: MIT */
#include "hunt_mesh_materials.h"

#include <math.h>
#include <stdlib.h>

#include "../../scenes/models/random.h"
#include "scene/platonic.h"

void *hunt_allocate(size_t count, size_t size) {
    void *memory = calloc(count, size);
    if (memory == NULL)
        abort();
    return memory;
}

HdVec3 hunt_pixel_ray(int side, int x, int y) {
    double step = HUNT_TANGENT / side;
    return hd_vec3(step * (2 * x + 1 - side), 1.0, step * (side - 1 - 2 * y));
}

static void make_room(HdMesh *mesh, int vertices, int triangles, const HdMaterial *material) {
    mesh->vertices = hunt_allocate((size_t)vertices, sizeof *mesh->vertices);
    mesh->corners = hunt_allocate((size_t)triangles, sizeof *mesh->corners);
    mesh->material_count = 1;
    mesh->materials = hunt_allocate(1, sizeof *mesh->materials);
    mesh->materials[0] =
        (HdMeshMaterial){.material = *material, .picture = -1, .mask_picture = -1, .passes_as = -1};
}

static void add_triangle(HdMesh *mesh, int a, int b, int c) {
    int32_t *corner = mesh->corners[mesh->triangle_count++];
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
}

/* ---- the sheets ---- */

enum { FRONT, BACK };

/* Counterclockwise as the eye sees it in front, the other way round at the back. */
static void add_sheet_triangle(HdMesh *mesh, int sheet, int first, int a, int b, int c) {
    if (sheet == FRONT)
        add_triangle(mesh, first + a, first + b, first + c);
    else
        add_triangle(mesh, first + a, first + c, first + b);
}

/* Returns whether a cell's diagonal runs down to the right. In the corners of the sheet it runs
   inwards: a triangle of three vertices of the rim would be in both sheets. */
static bool falls(int n, int i, int j, uint64_t *random) {
    bool by_chance = random_bits(random) & 1;
    if ((i == 0 || i == n - 2) && (j == 0 || j == n - 2))
        return i == j;
    return by_chance;
}

/* Vertex i, j of a sheet of n x n, i to the right and j downwards, is number j n + i. */
static void add_sheet(HdMesh *mesh, int n, int sheet, uint64_t *random) {
    int first = sheet * n * n;
    for (int j = 0; j + 1 < n; j++)
        for (int i = 0; i + 1 < n; i++) {
            int here = j * n + i, below = here + n;
            if (falls(n, i, j, random)) {
                add_sheet_triangle(mesh, sheet, first, here, below, below + 1);
                add_sheet_triangle(mesh, sheet, first, here, below + 1, here + 1);
            } else {
                add_sheet_triangle(mesh, sheet, first, here, below, here + 1);
                add_sheet_triangle(mesh, sheet, first, here + 1, below, below + 1);
            }
        }
}

/* Joins an edge of the front sheet's rim, in its triangle's order, to that of the back sheet. */
static void add_wall(HdMesh *mesh, int n, int a, int b) {
    int behind = n * n;
    add_triangle(mesh, b, a, a + behind);
    add_triangle(mesh, b, a + behind, b + behind);
}

/* Joins the rims of both sheets of n x n vertices. */
static void add_walls(HdMesh *mesh, int n) {
    int last = n - 1;
    for (int k = 0; k < last; k++) {
        add_wall(mesh, n, k * n, (k + 1) * n);
        add_wall(mesh, n, last * n + k, last * n + k + 1);
        add_wall(mesh, n, (k + 1) * n + last, k * n + last);
        add_wall(mesh, n, k + 1, k);
    }
}

/* Vertices of a sheet's side, and the eye's ray through a vertex. */
static int vertices_of_side(int side) {
    return (side - 1 - 2 * HUNT_RIM) / 2 + 1;
}

static HdVec3 vertex_ray(int side, int i, int j) {
    return hunt_pixel_ray(side, HUNT_RIM + 2 * i, HUNT_RIM + 2 * j);
}

/* Returns the number of triangles from a vertex to the rim. */
static int steps_to_rim(int n, int i, int j) {
    int across = i < n - 1 - i ? i : n - 1 - i, down = j < n - 1 - j ? j : n - 1 - j;
    return across < down ? across : down;
}

/* At the rim both sheets have the same vertices; from there they part at a right angle. */
static double depth_of_sheet(int side, int sheet, int steps, double height) {
    double pixel = 2.0 * HUNT_TANGENT / side, flank = 5.0 * pixel * steps;
    double away = fmin(flank, 0.5) + height * pixel * fmin(steps, 4.0) / 4.0;
    return sheet == FRONT ? 2.5 - away : 2.5 + away;
}

/* Returns a vertex of row j of n. Row 0 is the edge, towards which triangles get smaller. */
static HdVec3 wedge_vertex(int n, int sheet, int i, int j) {
    const double slope = 0.08748866352592401; /* tan 5 degrees */
    double across = (double)i / (n - 1), down = (double)j / (n - 1);
    double away = 3.5 * down * down, height = slope * away;
    return hd_vec3(3.0 * across - 1.5, 2.5 - away, sheet == FRONT ? height : -height);
}

static HdVec3 material_vertex(HuntMeshMaterial mesh_material, int side, int sheet, int i, int j,
                              double height) {
    int n = vertices_of_side(side);
    HdVec3 ray = vertex_ray(side, i, j);
    if (mesh_material == MATERIAL_WEDGE)
        return wedge_vertex(n, sheet, i, j);
    if (mesh_material == MATERIAL_SHEETS)
        return hd_scale(ray, depth_of_sheet(side, sheet, steps_to_rim(n, i, j), height));
    return sheet == FRONT ? hd_vec3(2.0 * ray.x, -1.0, 2.0 * ray.z)
                          : hd_scale(ray, 2.0 + height * 2.0 * HUNT_TANGENT / side);
}

/* Sheets have common vertices at their joint; the others have walls between them. */
void build_mesh_material(HdMesh *mesh, HuntMeshMaterial mesh_material, int side, double roughness,
                         const HdMaterial *material, uint64_t *random) {
    int n = vertices_of_side(side);
    make_room(mesh, 2 * n * n, 4 * (n - 1) * (n - 1) + 8 * (n - 1), material);
    for (int sheet = FRONT; sheet <= BACK; sheet++) {
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                double height = random_between(random, -1.0, 1.0) * roughness;
                mesh->vertices[mesh->vertex_count++] =
                    material_vertex(mesh_material, side, sheet, i, j, height);
            }
        add_sheet(mesh, n, sheet, random);
    }
    if (mesh_material != MATERIAL_SHEETS)
        add_walls(mesh, n);
}

/* ---- a triangle a pixel ---- */

static void add_spot(HdMesh *mesh, int side, int x, int y, double depth) {
    double size = 0.9 * depth * HUNT_TANGENT / side;
    HdVec3 middle = hd_scale(hunt_pixel_ray(side, x, y), depth);
    int first = mesh->vertex_count;
    mesh->vertices[first] = hd_add(middle, hd_vec3(-size, 0.0, -size));
    mesh->vertices[first + 1] = hd_add(middle, hd_vec3(size, 0.0, -size));
    mesh->vertices[first + 2] = hd_add(middle, hd_vec3(0.0, 0.0, size));
    mesh->vertex_count += 3;
    add_triangle(mesh, first, first + 1, first + 2);
}

void build_spots(HdMesh *mesh, int side, const bool *chosen, double depth,
                 const HdMaterial *material) {
    make_room(mesh, 3 * side * side, side * side, material);
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++)
            if (chosen[y * side + x])
                add_spot(mesh, side, x, y, depth);
}

/* Returns a corner or a point of an edge of the mesh. */
static HdVec3 choose_target(const HdMesh *mesh, uint64_t *random) {
    int triangle = (int)random_between(random, 0.0, mesh->triangle_count);
    int k = (int)random_between(random, 0.0, 3.0);
    HdVec3 a = mesh->vertices[mesh->corners[triangle][k]];
    HdVec3 b = mesh->vertices[mesh->corners[triangle][(k + 1) % 3]];
    double share = random_bits(random) & 1 ? random_between(random, 0.0, 1.0) : 0.0;
    return hd_add(a, hd_scale(hd_sub(b, a), share));
}

/* Returns a normal that mirrors the eye's ray to a target well on this side of the wall. */
static HdVec3 choose_normal(HdVec3 point, const HdMesh *target, HdVec3 rotation_degrees,
                            uint64_t *random) {
    HdVec3 way;
    do {
        HdVec3 aim = choose_target(target, random);
        hd_rotate_points(&aim, 1, rotation_degrees);
        way = hd_normalize(hd_sub(aim, point));
    } while (way.y > -0.1);
    return hd_normalize(hd_sub(way, hd_normalize(point)));
}

void build_mirrors(HdMesh *mesh, int side, double depth, const HdMesh *target,
                   HdVec3 rotation_degrees, const HdMaterial *material, uint64_t *random) {
    int count = side * side;
    make_room(mesh, 3 * count, count, material);
    mesh->normals = hunt_allocate((size_t)count, sizeof *mesh->normals);
    mesh->corner_normals = hunt_allocate((size_t)count, sizeof *mesh->corner_normals);
    mesh->normal_count = count;
    for (int i = 0; i < count; i++) {
        int x = i % side, y = i / side;
        HdVec3 middle = hd_scale(hunt_pixel_ray(side, x, y), depth);
        add_spot(mesh, side, x, y, depth);
        mesh->normals[i] = choose_normal(middle, target, rotation_degrees, random);
        for (int k = 0; k < 3; k++)
            mesh->corner_normals[i][k] = i;
    }
}
