/* SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <math.h>

#include "base/error.h"
#include "mesh/mesh.h"
#include "system/thread_pool.h"

enum { MAX_BYTES = 64 << 20, MAX_TRIANGLES = 20000 };

static int is_index(int32_t index, int count, int least) {
    return index >= least && index < count;
}

static void check_corner(const HdMesh *mesh, int triangle, int side) {
    const HdVec3 *at = &mesh->vertices[mesh->corners[triangle][side]];
    fuzz_expect(is_index(mesh->corners[triangle][side], mesh->vertex_count, 0),
                "a corner that is no vertex");
    fuzz_expect(isfinite(at->x) && isfinite(at->y) && isfinite(at->z), "a vertex that is nowhere");
    if (mesh->normals != NULL)
        fuzz_expect(is_index(mesh->corner_normals[triangle][side], mesh->normal_count, -1),
                    "a corner's normal that is none");
    if (mesh->uvs != NULL)
        fuzz_expect(is_index(mesh->corner_uvs[triangle][side], mesh->uv_count, -1),
                    "a corner's texture coordinate that is none");
}

static void check_mesh(const HdMesh *mesh) {
    fuzz_expect(mesh->triangle_count > 0, "a mesh without triangles");
    fuzz_expect(mesh->material_count > 0, "a mesh without materials");
    for (int i = 0; i < mesh->triangle_count; i++) {
        for (int side = 0; side < 3; side++)
            check_corner(mesh, i, side);
        if (mesh->material_of != NULL)
            fuzz_expect(is_index(mesh->material_of[i], mesh->material_count, 0),
                        "a triangle's material that is none");
    }
    for (int i = 0; i < mesh->material_count; i++) {
        const HdMaterial *material = &mesh->materials[i].material;
        fuzz_expect(material->reflection >= 0.0 && material->transmission >= 0.0 &&
                        material->reflection + material->transmission <= 1.0,
                    "a material that makes light");
    }
}

static void build(HdMesh *mesh) {
    static HdThreadPool *pool;
    static HdError error;
    if (pool == NULL)
        fuzz_expect(hd_thread_pool_create(&pool, 1, &error) == HD_OK, error.message);
    fuzz_expect_input_status(hd_mesh_smooth(mesh, 40.0, &error), &error);
    check_mesh(mesh);
    if (mesh->triangle_count <= MAX_TRIANGLES)
        fuzz_expect_input_status(hd_mesh_build(mesh, pool, &error), &error);
}

void fuzz_read_mesh(const char *path) {
    static HdError error;
    HdProblems notes = {.count = 0};
    HdMesh mesh;
    const HdStatus status = hd_mesh_read_obj(&mesh, path, MAX_BYTES, &notes, &notes, &error);
    fuzz_expect_input_status(status, &error);
    if (status != HD_OK)
        return;
    check_mesh(&mesh);
    build(&mesh);
    hd_mesh_free(&mesh);
}
