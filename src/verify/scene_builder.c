/* SPDX-License-Identifier: MIT */
#include "verify/scene_builder.h"

#include <stdlib.h>
#include <string.h>

#include "base/trigonometry.h"

static void *allocate(int count, size_t size) {
    return calloc(count > 0 ? (size_t)count : 1, size);
}

static HdVec3 same(double a) {
    return hd_vec3(a, a, a);
}

HdMaterial build_material(HdVec3 colour, double reflection, double transmission) {
    return (HdMaterial){.colour = colour,
                        .mirror_tint = same(1.0),
                        .diffuse = 0.3,
                        .specular = 0.4,
                        .shininess = 48,
                        .reflection = reflection,
                        .transmission = transmission,
                        .index_of_refraction = 1.0};
}

bool build_scene(HdScene *scene, int width, int height, int samples, int depth, int solids,
                 int lights) {
    memset(scene, 0, sizeof *scene);
    scene->frame_count = 1;
    scene->target.cylinder.z0 = -1.0; /* away from the eye; the frames' cameras differ */
    scene->width = width;
    scene->height = height;
    scene->samples_per_side = samples;
    scene->depth = depth;
    scene->field_of_view_degrees = 60.0;
    scene->exposure = 1.0;
    scene->background = hd_vec3(0.01, 0.02, 0.04);
    scene->solids = allocate(solids, sizeof *scene->solids);
    scene->lights = allocate(lights, sizeof *scene->lights);
    if (scene->solids == NULL || scene->lights == NULL)
        return false;
    scene->solid_count = solids;
    scene->light_count = lights;
    return true;
}

void build_solid(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                 HdVec3 colour, int lights_per_edge) {
    double count = lights_per_edge > 0 ? 12.0 * lights_per_edge : 1.0;
    scene->solids[index] = (HdSolid){.kind = kind,
                                     .centre = centre,
                                     .circumradius = radius,
                                     .face = build_material(colour, 0.6, 0.35),
                                     .rim_width = 0.05 * radius,
                                     .rim = {.colour = same(0.05),
                                             .mirror_tint = same(1.0),
                                             .diffuse = 0.5,
                                             .specular = 0.25,
                                             .shininess = 7,
                                             .index_of_refraction = 1.0},
                                     .lights = {.per_edge = lights_per_edge,
                                                .colour_count = 1,
                                                .colours = {{1.0, 1.0, 1.0}},
                                                .intensity = 2.0 / count,
                                                .falloff = {.distance = radius},
                                                .disc_radius = 0.025 * radius,
                                                .disc_radiance = 3.0}};
}

void build_glass(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                 double grey, double transmission) {
    build_solid(scene, index, kind, centre, radius, same(grey), 0);
    scene->solids[index].rim_width = 0.0;
    scene->solids[index].face.reflection = 0.0;
    scene->solids[index].face.transmission = transmission;
}

void build_light(HdScene *scene, int index, HdVec3 position, HdVec3 intensity) {
    scene->lights[index] = (HdLight){.position = position, .intensity = intensity};
}

/* A texture of hard squares and smooth ramps, so that a wrong texel or weight shows. */
bool build_texture(HdTexture *texture, int width, int height) {
    texture->texels = allocate(3 * width * height, sizeof *texture->texels);
    if (texture->texels == NULL)
        return false;
    texture->width = width;
    texture->height = height;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            uint16_t *rgb = texture->texels + 3 * (y * width + x);
            rgb[0] = (x / 4 + y / 4) % 2 ? 60000 : 4000;
            rgb[1] = (uint16_t)(65535 * x / width);
            rgb[2] = (uint16_t)(65535 * y / height);
        }
    return true;
}

bool build_sky(HdScene *scene, int width, int height, double top, double rotation_degrees) {
    scene->environment =
        (HdEnvironment){.intensity = 0.75, .rotation_degrees = rotation_degrees, .top = top};
    return build_texture(&scene->environment.texture, width, height);
}

void build_floor(HdScene *scene, HdVec3 a, HdVec3 b, HdVec3 c, HdVec3 d) {
    scene->floor.present = true;
    scene->floor.corners[0] = a;
    scene->floor.corners[1] = b;
    scene->floor.corners[2] = c;
    scene->floor.corners[3] = d;
    scene->floor.material = build_material(hd_vec3(0.9, 0.8, 0.7), 0.4, 0.0);
    scene->floor.material.diffuse = 0.7;
}

void build_square_floor(HdScene *scene, double half_side, double z) {
    build_floor(scene, hd_vec3(-half_side, half_side, z), hd_vec3(half_side, half_side, z),
                hd_vec3(half_side, -half_side, z), hd_vec3(-half_side, -half_side, z));
}

void build_camera(HdCamera *camera, HdVec3 eye, HdVec3 target, double field_of_view_degrees) {
    double sine, cosine;
    camera->eye = eye;
    camera->forward = hd_normalize(hd_sub(target, eye));
    camera->right = hd_normalize(hd_cross(camera->forward, hd_vec3(0.0, 0.0, 1.0)));
    camera->up = hd_cross(camera->right, camera->forward);
    hd_sine_cosine(field_of_view_degrees * HD_PI / 360.0, &sine, &cosine);
    camera->tangent_of_half_fov = sine / cosine;
}

/* ---- meshes ---- */

bool build_meshes(HdScene *scene, int meshes, int instances, int pictures) {
    scene->meshes = allocate(meshes, sizeof *scene->meshes);
    scene->instances = allocate(instances, sizeof *scene->instances);
    scene->pictures = allocate(pictures, sizeof *scene->pictures);
    if (scene->meshes == NULL || scene->instances == NULL || scene->pictures == NULL)
        return false;
    scene->mesh_count = meshes;
    scene->instance_count = instances;
    scene->picture_count = pictures;
    return true;
}

/* Allocates everything; the caller fills in the triangles. */
static bool build_mesh(HdMesh *mesh, int vertices, int triangles, int materials) {
    mesh->vertices = allocate(vertices, sizeof *mesh->vertices);
    mesh->corners = allocate(triangles, sizeof *mesh->corners);
    mesh->material_of = materials > 1 ? allocate(triangles, sizeof *mesh->material_of) : NULL;
    mesh->materials = allocate(materials, sizeof *mesh->materials);
    mesh->vertex_count = vertices;
    mesh->material_count = materials;
    return mesh->vertices != NULL && mesh->corners != NULL && mesh->materials != NULL &&
           (materials == 1 || mesh->material_of != NULL);
}

static void set_material(HdMesh *mesh, int index, const HdMaterial *material) {
    mesh->materials[index] =
        (HdMeshMaterial){.material = *material, .picture = -1, .mask_picture = -1, .passes_as = -1};
}

/* A globe is a grid of (rows + 1) x (2 rows + 1) points. Its first and last column coincide, and
   the first and last row are one point each; only texture coordinates distinguish them. */
static int32_t vertex_at(int rows, int row, int column) {
    if (row == 0 || row == rows)
        return row == rows;
    return 2 + (row - 1) * 2 * rows + column % (2 * rows);
}

static HdVec3 point_at(int rows, int row, int column, double bump) {
    double polar_sine, polar_cosine, sine, cosine, wave, other_wave, unused;
    hd_sine_cosine(HD_PI * row / rows, &polar_sine, &polar_cosine);
    hd_sine_cosine(2.0 * HD_PI * column / (2 * rows), &sine, &cosine);
    hd_sine_cosine(10.0 * HD_PI * column / (2 * rows), &wave, &unused);
    hd_sine_cosine(4.0 * HD_PI * row / rows, &other_wave, &unused);
    double radius = 1.0 + bump * wave * other_wave * polar_sine * polar_sine;
    return hd_scale(hd_vec3(polar_sine * cosine, polar_sine * sine, polar_cosine), radius);
}

static void add_globe_triangle(HdMesh *mesh, int rows, const int row[3], const int column[3]) {
    int number = mesh->triangle_count++;
    for (int i = 0; i < 3; i++) {
        int32_t vertex = vertex_at(rows, row[i], column[i]);
        mesh->corners[number][i] = vertex;
        if (mesh->corner_normals != NULL)
            mesh->corner_normals[number][i] = vertex;
        if (mesh->corner_uvs != NULL)
            mesh->corner_uvs[number][i] = row[i] * (2 * rows + 1) + column[i];
    }
}

static bool add_globe_normals(HdMesh *mesh, int triangles) {
    mesh->normals = allocate(mesh->vertex_count, sizeof *mesh->normals);
    mesh->corner_normals = allocate(triangles, sizeof *mesh->corner_normals);
    if (mesh->normals == NULL || mesh->corner_normals == NULL)
        return false;
    mesh->normal_count = mesh->vertex_count;
    memcpy(mesh->normals, mesh->vertices, (size_t)mesh->normal_count * sizeof *mesh->normals);
    return true;
}

static bool add_globe_uvs(HdMesh *mesh, int rows, int triangles) {
    const int columns = 2 * rows, count = (rows + 1) * (columns + 1);
    mesh->uvs = allocate(count, sizeof *mesh->uvs);
    mesh->corner_uvs = allocate(triangles, sizeof *mesh->corner_uvs);
    if (mesh->uvs == NULL || mesh->corner_uvs == NULL)
        return false;
    mesh->uv_count = count;
    for (int i = 0; i < mesh->uv_count; i++) {
        int row = i / (columns + 1);
        mesh->uvs[i][0] = 3.0 * (i % (columns + 1)) / columns - 1.0;
        mesh->uvs[i][1] = 1.5 * row / rows;
    }
    return true;
}

bool build_sphere_mesh(HdMesh *mesh, int rows, double bump, bool smooth, bool mapped,
                       const HdMaterial *material) {
    const int columns = 2 * rows, triangles = 2 * columns * (rows - 1);
    if (!build_mesh(mesh, 2 + (rows - 1) * columns, triangles, 1))
        return false;
    for (int row = 0; row <= rows; row++)
        for (int column = 0; column < columns; column++)
            mesh->vertices[vertex_at(rows, row, column)] = point_at(rows, row, column, bump);
    if ((smooth && !add_globe_normals(mesh, triangles)) ||
        (mapped && !add_globe_uvs(mesh, rows, triangles)))
        return false;
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            int down[3] = {row, row + 1, row + 1}, right[3] = {column, column, column + 1};
            int back[3] = {row, row + 1, row}, left[3] = {column, column + 1, column + 1};
            if (row < rows - 1)
                add_globe_triangle(mesh, rows, down, right);
            if (row > 0)
                add_globe_triangle(mesh, rows, back, left);
        }
    set_material(mesh, 0, material);
    return true;
}

bool build_cube_mesh(HdMesh *mesh, const HdMaterial *first, const HdMaterial *second) {
    static const int32_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    if (!build_mesh(mesh, 8, 12, 2))
        return false;
    for (int i = 0; i < 8; i++)
        mesh->vertices[i] = hd_vec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    mesh->triangle_count = 12;
    for (int i = 0; i < 12; i++) {
        const int32_t *face = faces[i / 2];
        mesh->corners[i][0] = face[0];
        mesh->corners[i][1] = face[1 + i % 2];
        mesh->corners[i][2] = face[2 + i % 2];
        mesh->material_of[i] = i < 4;
    }
    set_material(mesh, 0, first);
    set_material(mesh, 1, second);
    return true;
}

bool build_colours(HdMesh *mesh) {
    mesh->colours = allocate(mesh->vertex_count, sizeof *mesh->colours);
    for (int i = 0; mesh->colours != NULL && i < mesh->vertex_count; i++)
        mesh->colours[i] = hd_vec3(i % 2, 0.25 * (i % 5), 1.0 - 0.5 * (i % 3));
    return mesh->colours != NULL;
}

void build_instance(HdScene *scene, int index, int mesh, HdVec3 position, HdVec3 rotation,
                    double scale) {
    scene->instances[index] = (HdInstance){.mesh = mesh,
                                           .position = position,
                                           .rotation_degrees = rotation,
                                           .scale = hd_vec3(scale, scale, scale)};
}

bool finish_meshes(HdScene *scene) {
    HdError ignored;
    HdThreadPool *pool;
    HdStatus status = hd_thread_pool_create(&pool, 1, &ignored);
    if (status != HD_OK)
        return false;
    for (int i = 0; status == HD_OK && i < scene->mesh_count; i++)
        status = hd_mesh_build(&scene->meshes[i], pool, &ignored);
    hd_thread_pool_destroy(pool);
    return status == HD_OK;
}
