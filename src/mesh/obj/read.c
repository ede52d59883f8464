/* SPDX-License-Identifier: MIT */
#include "mesh/obj/read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/obj/fast_obj.h"
#include "mesh/obj/material.h"
#include "mesh/obj/mtl_text.h"
#include "mesh/obj/text.h"
#include "mesh/polygon.h"
#include "system/file_bytes.h"

enum { MOST_LIBRARIES = 64 };

/* A library's text on its way to fast_obj. */
typedef struct Library {
    char *text;
    size_t size;
} Library;

typedef struct Reading {
    const char *path;
    HdProblems *notes;
    HdError *error;
    HdObjMemory memory;
    HdObjText text;
    Library library;
    char *libraries[MOST_LIBRARIES]; /* names of those that were asked for */
    int library_count;
    HdMesh *mesh;
} Reading;

static HdStatus fail_memory(const Reading *reading) {
    return hd_obj_fail_memory(&reading->memory, reading->path, reading->error);
}

/* The folder of the path with its last slash, or nothing. */
static HdSpan folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    return (HdSpan){path, slash != NULL ? slash + 1 : path};
}

static size_t span_size(HdSpan span) {
    return (size_t)(span.end - span.begin);
}

static void join(char *to, HdSpan folder, const char *name) {
    memcpy(to, folder.begin, span_size(folder));
    memcpy(to + span_size(folder), name, strlen(name) + 1);
}

/* A copy that is the memory's. */
static char *copy_span(Reading *reading, HdSpan span) {
    char *copy = hd_obj_reallocate(&reading->memory, NULL, span_size(span) + 1);
    if (copy == NULL)
        return NULL;
    memcpy(copy, span.begin, span_size(span));
    copy[span_size(span)] = '\0';
    return copy;
}

static bool is_known_library(const Reading *reading, const char *name) {
    for (int i = 0; i < reading->library_count; i++)
        if (strcmp(reading->libraries[i], name) == 0)
            return true;
    return false;
}

/* Whether the library is to be read, now and never again. */
static bool admit_library(Reading *reading, const char *name) {
    const HdSpan span = {name, name + strlen(name)};
    const char *fault = hd_file_name_fault(span);
    if (is_known_library(reading, name))
        return false;
    if (reading->library_count == MOST_LIBRARIES)
        fault = "no more than 64 libraries";
    if (fault != NULL) {
        hd_problem(reading->notes, "%s: the material library '%.*s' is not read, expected %s",
                   reading->path, hd_span_shown(span), name, fault);
        return false;
    }
    reading->libraries[reading->library_count] = copy_span(reading, span);
    if (reading->libraries[reading->library_count] == NULL) {
        reading->text.status = fail_memory(reading);
        return false;
    }
    reading->library_count++;
    return true;
}

static void clean_library(Reading *reading, const char *path, HdSpan folder, HdSpan bytes) {
    char *in_front = copy_span(reading, folder);
    if (in_front != NULL) {
        const HdMtlSource source = {path, in_front, bytes};
        reading->library.text =
            hd_mtl_clean(&source, &reading->memory, reading->notes, &reading->library.size);
        hd_obj_release(&reading->memory, in_front);
    }
    if (reading->library.text == NULL)
        reading->text.status = fail_memory(reading);
}

static void read_library_file(Reading *reading, const char *path, const char *name) {
    unsigned char *bytes;
    size_t size;
    const size_t room = reading->memory.most - reading->memory.used;
    const int64_t most = room < INT32_MAX ? (int64_t)room : INT32_MAX;
    HdError *problem = hd_obj_reallocate(&reading->memory, NULL, sizeof *problem);
    if (problem == NULL) {
        reading->text.status = fail_memory(reading);
        return;
    }
    if (hd_file_read(path, "material library", most, &bytes, &size, problem) == HD_OK) {
        const char *text = (const char *)bytes;
        reading->memory.used += size;
        clean_library(reading, path, folder_of(name), (HdSpan){text, text + size});
        reading->memory.used -= size;
        free(bytes);
    } else {
        hd_problem(reading->notes, "%s: %s", reading->path, problem->message);
    }
    hd_obj_release(&reading->memory, problem);
}

static void *open_library(Reading *reading, const char *name) {
    const HdSpan folder = folder_of(reading->path);
    reading->library = (Library){NULL, 0};
    if (!admit_library(reading, name))
        return NULL;
    char *path = hd_obj_reallocate(&reading->memory, NULL, span_size(folder) + strlen(name) + 1);
    if (path == NULL) {
        reading->text.status = fail_memory(reading);
        return NULL;
    }
    join(path, folder, name);
    read_library_file(reading, path, name);
    hd_obj_release(&reading->memory, path);
    return reading->library.text != NULL ? &reading->library : NULL;
}

/* The first file that is asked for is the mesh, under no name. */
static void *open_file(const char *name, void *user) {
    Reading *reading = user;
    return *name == '\0' ? (void *)&reading->text : open_library(reading, name);
}

static void close_file(void *file, void *user) {
    Reading *reading = user;
    if (file != &reading->library)
        return;
    hd_obj_release(&reading->memory, reading->library.text);
    reading->library.text = NULL;
}

static size_t read_bytes(void *file, void *to, size_t room, void *user) {
    Reading *reading = user;
    if (file == &reading->text)
        return hd_obj_text_read(&reading->text, to, room);
    memcpy(to, reading->library.text, reading->library.size);
    return reading->library.size;
}

/* Asked of libraries alone. */
static unsigned long size_of_file(void *file, void *user) {
    (void)file;
    return (unsigned long)((Reading *)user)->library.size;
}

static HdStatus read_file(Reading *reading, fastObjMesh **from) {
    const fastObjCallbacks callbacks = {open_file, close_file, read_bytes, size_of_file};
    HdObjText *text = &reading->text;
    HdStatus status = hd_obj_text_open(text);
    if (status == HD_OK) {
        const HdFastObjEnd end = hd_fast_obj_read(from, &callbacks, reading, &reading->memory);
        if (end == HD_FAST_OBJ_TOO_LONG)
            status = hd_fail(reading->error, HD_BAD_INPUT,
                             "%s: it has more than the 287 million corners of faces or 322 million "
                             "vertices that can be read",
                             reading->path);
        else if (end == HD_FAST_OBJ_NO_MEMORY)
            status = fail_memory(reading);
        else
            status = hd_obj_text_finish(text);
    }
    hd_obj_text_close(text);
    return status;
}

/* fast_obj puts a dummy at the begin of each array. */
static bool take_vertices(Reading *reading, fastObjMesh *from) {
    HdMesh *mesh = reading->mesh;
    const int count = (int)from->position_count - 1;
    mesh->vertices =
        hd_obj_allocate_result(&reading->memory, (size_t)count, sizeof *mesh->vertices);
    if (mesh->vertices == NULL)
        return false;
    for (size_t i = 0; i < (size_t)count; i++) {
        const float *position = from->positions + 3 * (i + 1);
        mesh->vertices[i] = hd_vec3((double)position[0], (double)position[1], (double)position[2]);
    }
    mesh->vertex_count = count;
    hd_fast_obj_release(&reading->memory, from->positions);
    from->positions = NULL;
    return true;
}

static bool take_normals(Reading *reading, fastObjMesh *from) {
    HdMesh *mesh = reading->mesh;
    const int count = (int)from->normal_count - 1;
    mesh->normals = hd_obj_allocate_result(&reading->memory, (size_t)count, sizeof *mesh->normals);
    if (mesh->normals == NULL)
        return false;
    for (size_t i = 0; i < (size_t)count; i++) {
        const float *normal = from->normals + 3 * (i + 1);
        mesh->normals[i] = hd_vec3((double)normal[0], (double)normal[1], (double)normal[2]);
    }
    mesh->normal_count = count;
    hd_fast_obj_release(&reading->memory, from->normals);
    from->normals = NULL;
    return true;
}

static bool take_uvs(Reading *reading, fastObjMesh *from) {
    HdMesh *mesh = reading->mesh;
    const int count = (int)from->texcoord_count - 1;
    mesh->uvs = hd_obj_allocate_result(&reading->memory, (size_t)count, sizeof *mesh->uvs);
    if (mesh->uvs == NULL)
        return false;
    for (size_t i = 0; i < (size_t)count; i++) {
        mesh->uvs[i][0] = (double)from->texcoords[2 * (i + 1)];
        mesh->uvs[i][1] = (double)from->texcoords[2 * (i + 1) + 1];
    }
    mesh->uv_count = count;
    hd_fast_obj_release(&reading->memory, from->texcoords);
    from->texcoords = NULL;
    return true;
}

static bool allocate_triangles(Reading *reading) {
    HdMesh *mesh = reading->mesh;
    const size_t count = (size_t)reading->text.triangle_count;
    HdObjMemory *memory = &reading->memory;
    mesh->corners = hd_obj_allocate_result(memory, count, sizeof *mesh->corners);
    if (mesh->normals != NULL)
        mesh->corner_normals = hd_obj_allocate_result(memory, count, sizeof *mesh->corner_normals);
    if (mesh->uvs != NULL)
        mesh->corner_uvs = hd_obj_allocate_result(memory, count, sizeof *mesh->corner_uvs);
    if (reading->text.names.count > 1)
        mesh->material_of = hd_obj_allocate_result(memory, count, sizeof *mesh->material_of);
    return mesh->corners != NULL && (mesh->normals == NULL || mesh->corner_normals != NULL) &&
           (mesh->uvs == NULL || mesh->corner_uvs != NULL) &&
           (reading->text.names.count <= 1 || mesh->material_of != NULL);
}

/* Without a direction there is no normal. */
static int32_t normal_number(const HdMesh *mesh, fastObjUInt number) {
    if (number == 0)
        return -1;
    const HdVec3 normal = mesh->normals[number - 1];
    return normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0 ? -1 : (int32_t)number - 1;
}

static void add_triangle(HdMesh *mesh, const fastObjIndex *corners, const int32_t chosen[3],
                         int32_t material) {
    const int triangle = mesh->triangle_count++;
    for (int i = 0; i < 3; i++) {
        const fastObjIndex corner = corners[chosen[i]];
        mesh->corners[triangle][i] = (int32_t)corner.p - 1;
        if (mesh->corner_normals != NULL)
            mesh->corner_normals[triangle][i] = normal_number(mesh, corner.n);
        if (mesh->corner_uvs != NULL)
            mesh->corner_uvs[triangle][i] = (int32_t)corner.t - 1;
    }
    if (mesh->material_of != NULL)
        mesh->material_of[triangle] = material;
}

/* Room for the largest polygon. */
typedef struct Polygon {
    HdVec3 *points;
    int32_t (*triangles)[3];
} Polygon;

static bool add_face(HdMesh *mesh, const Polygon *room, const fastObjIndex *corners, int count,
                     int32_t material) {
    static const int32_t in_order[3] = {0, 1, 2};
    if (count == 3) {
        add_triangle(mesh, corners, in_order, material);
        return true;
    }
    for (int i = 0; i < count; i++)
        room->points[i] = mesh->vertices[corners[i].p - 1];
    if (!hd_polygon_cut(room->points, count, room->triangles))
        return false;
    for (int i = 0; i < count - 2; i++)
        add_triangle(mesh, corners, room->triangles[i], material);
    return true;
}

static HdStatus take_faces(Reading *reading, const fastObjMesh *from) {
    const HdObjText *text = &reading->text;
    const size_t most = (size_t)text->most_corners;
    const fastObjIndex *corners = from->indices;
    const Polygon room = {hd_obj_reallocate(&reading->memory, NULL, most * sizeof *room.points),
                          hd_obj_reallocate(&reading->memory, NULL, most * sizeof *room.triangles)};
    size_t run = 0;
    if (room.points == NULL || room.triangles == NULL || !allocate_triangles(reading))
        return fail_memory(reading);
    for (unsigned int face = 0; face < from->face_count; face++) {
        const int count = (int)from->face_vertices[face];
        if (run + 1 < text->run_count && text->runs[run + 1].first_face == face)
            run++;
        if (!add_face(reading->mesh, &room, corners, count, text->runs[run].material))
            return hd_fail(reading->error, HD_BAD_INPUT,
                           "%s: face %u is not convex and has %d corners, expected at most %d",
                           reading->path, face + 1, count, (int)HD_MAX_CONCAVE_CORNERS);
        corners += count;
    }
    return HD_OK;
}

static HdMtlParameters parameters_of(const fastObjMaterial *from) {
    HdMtlParameters to = {.Ns = from->Ns, .Ni = from->Ni, .d = from->d, .illum = (int)from->Kt[0]};
    memcpy(to.Ka, from->Ka, sizeof to.Ka);
    memcpy(to.Kd, from->Kd, sizeof to.Kd);
    memcpy(to.Ks, from->Ks, sizeof to.Ks);
    memcpy(to.Ke, from->Ke, sizeof to.Ke);
    memcpy(to.Tf, from->Tf, sizeof to.Tf);
    return to;
}

/* Without a folder HD_MTL_HERE stays, so that the name is taken for nothing but a file's. */
static bool take_texture(Reading *reading, const char *path, HdMeshMaterial *to) {
    const HdSpan folder = folder_of(reading->path);
    const char *name = span_size(folder) > 0 ? path + strlen(HD_MTL_HERE) : path;
    to->texture = hd_obj_allocate_result(&reading->memory, span_size(folder) + strlen(name) + 1, 1);
    if (to->texture != NULL)
        join(to->texture, folder, name);
    return to->texture != NULL;
}

/* What a library says of the material; of two with one name the first counts. */
static bool define_material(Reading *reading, const fastObjMaterial *from, bool *is_defined) {
    const HdSpan name = {from->name, from->name + strlen(from->name)};
    const int number = hd_name_table_find(&reading->text.names, name);
    char place[256];
    if (number < 0 || is_defined[number])
        return true;
    is_defined[number] = true;
    const HdMtlParameters parameters = parameters_of(from);
    snprintf(place, sizeof place, "%s: material '%.*s'", reading->path, hd_span_shown(name),
             name.begin);
    hd_mtl_material(&parameters, &reading->mesh->materials[number], place, reading->notes);
    return from->map_Kd.path == NULL ||
           take_texture(reading, from->map_Kd.path, &reading->mesh->materials[number]);
}

static bool define_default(Reading *reading, int number) {
    HdMeshMaterial *material = &reading->mesh->materials[number];
    const char *name = reading->text.names.names[number];
    hd_mtl_material(&hd_mtl_defaults, material, reading->path, reading->notes);
    material->picture = material->passes_as = -1;
    material->name = hd_obj_allocate_result(&reading->memory, strlen(name) + 1, 1);
    if (material->name != NULL)
        memcpy(material->name, name, strlen(name) + 1);
    return material->name != NULL;
}

static void note_undefined(Reading *reading, const bool *is_defined) {
    int count = 0, first = -1;
    for (int i = 0; i < reading->mesh->material_count; i++) {
        if (is_defined[i])
            continue;
        first = count++ == 0 ? i : first;
    }
    if (count == 0)
        return;
    const char *name = reading->mesh->materials[first].name;
    if (reading->mesh->material_count == 1 && strcmp(name, HD_OBJ_NO_MATERIAL) == 0)
        return; /* the file wants none */
    hd_problem(reading->notes,
               "%s: no material library has '%.80s'%s, so the default look is taken: white, opaque",
               reading->path, name, count > 1 ? " and others that faces name" : "");
}

static bool take_materials(Reading *reading, const fastObjMesh *from) {
    HdMesh *mesh = reading->mesh;
    const int count = reading->text.names.count;
    const size_t room = (size_t)count;
    bool *is_defined = hd_obj_reallocate(&reading->memory, NULL, room * sizeof *is_defined);
    mesh->materials = hd_obj_allocate_result(&reading->memory, room, sizeof *mesh->materials);
    if (is_defined == NULL || mesh->materials == NULL)
        return false;
    memset(is_defined, 0, room * sizeof *is_defined);
    memset(mesh->materials, 0, room * sizeof *mesh->materials);
    mesh->material_count = count;
    for (int i = 0; i < count; i++)
        if (!define_default(reading, i))
            return false;
    for (unsigned int i = 0; i < from->material_count; i++)
        if (!define_material(reading, &from->materials[i], is_defined))
            return false;
    note_undefined(reading, is_defined);
    return true;
}

static HdStatus take_mesh(Reading *reading, fastObjMesh *from) {
    const HdObjElements *elements = reading->text.elements;
    HdMesh *mesh = reading->mesh;
    if (!take_vertices(reading, from) ||
        (elements[HD_OBJ_NORMAL].highest > 0 && !take_normals(reading, from)) ||
        (elements[HD_OBJ_UV].highest > 0 && !take_uvs(reading, from)) ||
        !take_materials(reading, from))
        return fail_memory(reading);
    const HdStatus status = take_faces(reading, from);
    if (status != HD_OK)
        return status;
    const int count = mesh->triangle_count;
    hd_mesh_drop_degenerate(mesh);
    if (mesh->triangle_count == 0)
        return hd_fail(reading->error, HD_BAD_INPUT, "%s: none of its %d triangles has an area",
                       reading->path, count);
    return HD_OK;
}

HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t most_bytes, HdProblems *notes,
                          HdError *error) {
    Reading reading = {.path = path, .notes = notes, .error = error, .mesh = mesh};
    fastObjMesh *from = NULL;
    *mesh = (HdMesh){0};
    reading.memory.most = most_bytes;
    reading.text =
        (HdObjText){.path = path, .memory = &reading.memory, .notes = notes, .error = error};
    HdStatus status = read_file(&reading, &from);
    if (status == HD_OK)
        status = take_mesh(&reading, from);
    hd_obj_release_all(&reading.memory);
    if (status != HD_OK)
        hd_mesh_free(mesh);
    return status;
}
