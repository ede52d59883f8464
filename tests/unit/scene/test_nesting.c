/* SPDX-License-Identifier: MIT */
/* Indices of refraction of solids and meshes that lie within others. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>

#include "scene/nesting.h"
#include "scene/triangulate.h"
#include "system/thread_pool.h"
#include "unit_test.h"

enum { THINGS = 3 };

/* Cubes along the x axis. */
typedef struct Row {
    const char *kinds; /* each a solid, a mesh, a mesh turned inside out, or one with a hole */
    double x[THINGS], edge[THINGS], index[THINGS], expected[THINGS];
} Row;

static HdThreadPool *pool;

static HdSolid cube(const Row *row, int number) {
    return (HdSolid){.kind = HD_HEXAHEDRON,
                     .centre = {row->x[number], 0.0, 0.0},
                     .circumradius = 0.5 * sqrt(3.0) * row->edge[number],
                     .face = {.transmission = 1.0, .index_of_refraction = row->index[number]}};
}

static void append(HdMesh *mesh, const HdMesh *part, HdVec3 centre, char kind) {
    const int vertices = mesh->vertex_count, count = part->triangle_count - (kind == 'h');
    for (int i = 0; i < part->vertex_count; i++)
        mesh->vertices[mesh->vertex_count++] = hd_add(part->vertices[i], centre);
    for (int i = 0; i < count; i++) {
        int32_t *corner = mesh->corners[mesh->triangle_count];
        for (int k = 0; k < 3; k++)
            corner[k] = vertices + part->corners[i][kind == 'i' ? 2 - k : k];
        mesh->material_of[mesh->triangle_count++] = mesh->material_count;
    }
    mesh->materials[mesh->material_count++] = (HdMeshMaterial){
        .material = part->materials[0].material, .name = strdup("m"), .passes_as = -1};
}

/* Adds a mesh of the cubes from `first` on, up to `end`, as an instance that is moved and scaled.
 */
static void add_mesh(HdScene *scene, const Row *row, int first, int end) {
    HdMesh *mesh = &scene->meshes[scene->mesh_count];
    assert_true(hd_mesh_allocate(mesh, 64, 64));
    mesh->materials = calloc(THINGS, sizeof *mesh->materials);
    for (int i = first; i < end; i++) {
        const HdSolid solid = cube(row, i);
        HdMesh part;
        assert_int_equal(hd_triangulate_solid(&part, &solid, 8, 1, NULL), HD_OK);
        append(mesh, &part, hd_sub(solid.centre, hd_vec3(1.0, 0.0, 0.0)), row->kinds[i]);
        hd_mesh_free(&part);
    }
    for (int i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].z *= 4.0;
    assert_int_equal(hd_mesh_build(mesh, pool, NULL), HD_OK);
    scene->instances[scene->instance_count++] =
        (HdInstance){.mesh = scene->mesh_count++, .position.x = 1.0, .scale = {1.0, 1.0, 0.25}};
}

static HdScene scene_of(const Row *row, bool is_one_mesh) {
    HdScene scene = {.solids = calloc(THINGS, sizeof *scene.solids),
                     .meshes = calloc(THINGS, sizeof *scene.meshes),
                     .instances = calloc(THINGS, sizeof *scene.instances)};
    for (int i = 0; i < THINGS; i++) {
        if (row->kinds[i] == 's')
            scene.solids[scene.solid_count++] = cube(row, i);
        else if (!is_one_mesh || scene.mesh_count == 0)
            add_mesh(&scene, row, i, is_one_mesh ? THINGS : i + 1);
    }
    return scene;
}

/* Expects the index of each cube in the order of the row. */
static void expect_indices(const HdScene *scene, const Row *row, bool is_one_mesh) {
    int solid = 0, instance = 0, triangle = 0;
    for (int i = 0; i < THINGS; i++) {
        if (row->kinds[i] == 's') {
            assert_true(scene->solids[solid++].face.index_of_refraction == row->expected[i]);
            continue;
        }
        const HdInstance *of = &scene->instances[instance];
        const HdMesh *mesh = &scene->meshes[of->mesh];
        for (int left = 12 - (row->kinds[i] == 'h'); left > 0; left--) {
            const int material = mesh->material_of[triangle++];
            assert_true(hd_instance_material(scene, of, material).index_of_refraction ==
                        row->expected[i]);
        }
        if (!is_one_mesh) {
            triangle = 0;
            instance++;
        }
    }
}

static void expect_nested(const Row *row, bool is_one_mesh) {
    HdScene scene = scene_of(row, is_one_mesh);
    assert_int_equal(hd_scene_nest(&scene, NULL), HD_OK);
    expect_indices(&scene, row, is_one_mesh);
    hd_scene_free(&scene);
}

TEST(indices_count_against_those_around) {
    static const Row rows[] = {
        {"", {0.0, 0.0, 0.25}, {4.0, 2.0, 1.0}, {1.5, 1.2, 1.8}, {1.5, 1.2 / 1.5, 1.8 / 1.2}},
        /* a bubble; not clear of faces, and crossing; the innermost comes first */
        {"", {0.0, 0.9, 9.0}, {4.0, 2.0, 1.0}, {1.5, 1.0, 1.3}, {1.5, 1.0 / 1.5, 1.3}},
        {"", {0.0, 0.9999, 1.5}, {4.0, 2.0, 2.0}, {1.5, 1.4, 1.2}, {1.5, 1.4, 1.2}},
        {"", {0.1, 0.0, 0.1}, {1.0, 4.0, 2.0}, {1.8, 1.5, 1.2}, {1.8 / 1.2, 1.5, 1.2 / 1.5}},
        /* two beside each other in one; in one instance they share a result */
        {"", {0.0, 1.2, -1.2}, {4.0, 1.0, 1.0}, {1.5, 1.2, 1.8}, {1.5, 1.2 / 1.5, 1.8 / 1.5}},
        /* a hollow cube; one that is not closed, around others and within */
        {"mim", {0.0, 0.0, 0.25}, {4.0, 2.0, 1.0}, {1.5, 1.5, 1.8}, {1.5, 1.5, 1.8}},
        {"sis", {0.0, 0.0, 0.25}, {4.0, 2.0, 1.0}, {1.5, 1.5, 1.8}, {1.5, 1.5, 1.8}},
        {"hmm", {0.0, 0.0, 0.25}, {4.0, 2.0, 1.0}, {1.5, 1.2, 1.8}, {1.5, 1.2, 1.8 / 1.2}},
        {"mmh", {0.0, 0.0, 0.25}, {4.0, 2.0, 1.0}, {1.5, 1.2, 1.8}, {1.5, 1.2 / 1.5, 1.8}}};
    static const char *const kinds[] = {"sss", "mmm", "sms", "msm", "smm", "mss"};
    assert_int_equal(hd_thread_pool_create(&pool, 1, NULL), HD_OK);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            Row row = rows[i];
            row.kinds = row.kinds[0] == '\0' ? kinds[k] : row.kinds;
            expect_nested(&row, false);
            if (strchr(row.kinds + 1, 's') == NULL)
                expect_nested(&row, true);
        }
    hd_thread_pool_destroy(pool);
}
