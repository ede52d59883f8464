/* SPDX-License-Identifier: MIT */
#include "mesh/obj/read.h"

#include <stdlib.h>

#include "mesh/obj/text.h"

_Static_assert(sizeof(HdVec3) == 3 * sizeof(double), "three numbers of the text are a vector");

/* Texture coordinates and normals that no corner names are left out. */
static void take_elements(HdObjText *text, HdMesh *mesh) {
    const HdObjElements *elements = text->elements;
    mesh->vertices = (HdVec3 *)hd_obj_text_take(text, HD_OBJ_VERTEX);
    mesh->vertex_count = (int)elements[HD_OBJ_VERTEX].count;
    if (elements[HD_OBJ_NORMAL].highest > 0) {
        mesh->normals = (HdVec3 *)hd_obj_text_take(text, HD_OBJ_NORMAL);
        mesh->normal_count = (int)elements[HD_OBJ_NORMAL].count;
    }
    if (elements[HD_OBJ_UV].highest > 0) {
        mesh->uvs = (double(*)[2])hd_obj_text_take(text, HD_OBJ_UV);
        mesh->uv_count = (int)elements[HD_OBJ_UV].count;
    }
}

static bool allocate_triangles(const HdObjText *text, HdMesh *mesh) {
    HdObjMemory *memory = text->memory;
    const size_t count = (size_t)text->triangle_count;
    mesh->corners = hd_obj_allocate(memory, count, sizeof *mesh->corners);
    if (mesh->normals != NULL)
        mesh->corner_normals = hd_obj_allocate(memory, count, sizeof *mesh->corner_normals);
    if (mesh->uvs != NULL)
        mesh->corner_uvs = hd_obj_allocate(memory, count, sizeof *mesh->corner_uvs);
    if (text->names.count > 1)
        mesh->material_of = hd_obj_allocate(memory, count, sizeof *mesh->material_of);
    return mesh->corners != NULL && (mesh->normals == NULL || mesh->corner_normals != NULL) &&
           (mesh->uvs == NULL || mesh->corner_uvs != NULL) &&
           (text->names.count <= 1 || mesh->material_of != NULL);
}

/* Without a direction there is no normal. */
static int32_t normal_of(const HdMesh *mesh, int32_t number) {
    if (number < 0)
        return -1;
    const HdVec3 normal = mesh->normals[number];
    return normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0 ? -1 : number;
}

static void add_triangle(HdMesh *mesh, const HdObjCorner *corners, const int32_t chosen[3],
                         int32_t material) {
    const int triangle = mesh->triangle_count++;
    for (int i = 0; i < 3; i++) {
        const int32_t *element = corners[chosen[i]].element;
        mesh->corners[triangle][i] = element[HD_OBJ_VERTEX];
        if (mesh->corner_normals != NULL)
            mesh->corner_normals[triangle][i] = normal_of(mesh, element[HD_OBJ_NORMAL]);
        if (mesh->corner_uvs != NULL)
            mesh->corner_uvs[triangle][i] = element[HD_OBJ_UV];
    }
    if (mesh->material_of != NULL)
        mesh->material_of[triangle] = material;
}

/* Room for the largest polygon. */
typedef struct Polygon {
    HdVec3 *points;
    int32_t (*triangles)[3];
} Polygon;

static bool add_face(HdMesh *mesh, const Polygon *room, const HdObjCorner *corners,
                     const HdObjFace *face) {
    static const int32_t in_order[3] = {0, 1, 2};
    const int count = face->corner_count;
    if (count == 3) {
        add_triangle(mesh, corners, in_order, face->material);
        return true;
    }
    for (int i = 0; i < count; i++)
        room->points[i] = mesh->vertices[corners[i].element[HD_OBJ_VERTEX]];
    if (!hd_polygon_cut(room->points, count, room->triangles))
        return false;
    for (int i = 0; i < count - 2; i++)
        add_triangle(mesh, corners, room->triangles[i], face->material);
    return true;
}

static HdStatus add_faces(const HdObjText *text, HdMesh *mesh, const Polygon *room) {
    const HdObjCorner *corners = text->corners;
    for (size_t i = 0; i < text->face_count; i++) {
        const HdObjFace *face = &text->faces[i];
        if (!add_face(mesh, room, corners, face))
            return hd_fail(text->error, HD_BAD_INPUT,
                           "%s: face %zu is not convex and has %d corners, expected at most %d",
                           text->path, i + 1, (int)face->corner_count, (int)HD_MAX_CONCAVE_CORNERS);
        corners += face->corner_count;
    }
    return HD_OK;
}

static HdStatus take_faces(const HdObjText *text, HdMesh *mesh) {
    HdObjMemory *memory = text->memory;
    const size_t most = (size_t)text->most_corners;
    const Polygon room = {hd_obj_allocate(memory, most, sizeof *room.points),
                          hd_obj_allocate(memory, most, sizeof *room.triangles)};
    const bool has_room =
        room.points != NULL && room.triangles != NULL && allocate_triangles(text, mesh);
    const HdStatus status = has_room ? add_faces(text, mesh, &room)
                                     : hd_obj_fail_memory(memory, text->path, text->error);
    free(room.points);
    free(room.triangles);
    return status;
}

static HdStatus take_mesh(HdObjText *text, HdMesh *mesh) {
    take_elements(text, mesh);
    if (!hd_obj_read_materials(text, mesh))
        return hd_obj_fail_memory(text->memory, text->path, text->error);
    const HdStatus status = take_faces(text, mesh);
    if (status != HD_OK)
        return status;
    const int count = mesh->triangle_count;
    hd_mesh_drop_degenerate(mesh);
    if (mesh->triangle_count == 0)
        return hd_fail(text->error, HD_BAD_INPUT, "%s: none of its %d triangles has an area",
                       text->path, count);
    return HD_OK;
}

HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t most_bytes, HdProblems *notes,
                          HdError *error) {
    HdObjMemory memory = {.most = most_bytes};
    HdObjText text = {.path = path, .memory = &memory, .notes = notes, .error = error};
    *mesh = (HdMesh){0};
    HdStatus status = hd_obj_text_read(&text);
    if (status == HD_OK)
        status = take_mesh(&text, mesh);
    hd_obj_text_free(&text);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}
