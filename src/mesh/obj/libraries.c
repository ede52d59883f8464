/* SPDX-License-Identifier: MIT */
#include "mesh/obj/libraries.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/obj/mtl_text.h"
#include "system/path.h"

enum { MOST_LIBRARIES = 64 };

typedef struct Libraries {
    const char *path; /* of the mesh */
    HdObjMemory *memory;
    HdProblems *notes;
    HdMtlDefinitions definitions;
    const char *names[MOST_LIBRARIES]; /* of those that were asked for */
    int count;
} Libraries;

/* The folder of the path with its last slash, or nothing. */
static HdSpan folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    return (HdSpan){path, slash != NULL ? slash + 1 : path};
}

/* Without a folder it is named all the same, so that a name below is taken for nothing but a
   file's. */
static HdSpan folder_of_textures(const char *path) {
    static const char here[] = "./";
    const HdSpan folder = folder_of(path);
    return folder.begin < folder.end ? folder : (HdSpan){here, here + strlen(here)};
}

static bool is_known(const Libraries *libraries, const char *name) {
    for (int i = 0; i < libraries->count; i++)
        if (strcmp(libraries->names[i], name) == 0)
            return true;
    return false;
}

/* Whether the library is to be read, now and never again. */
static bool admit(Libraries *libraries, const char *name) {
    const HdSpan span = {name, name + strlen(name)};
    const char *fault = hd_file_name_fault(span);
    if (is_known(libraries, name))
        return false;
    if (libraries->count == MOST_LIBRARIES)
        fault = "no more than 64 libraries";
    if (fault != NULL) {
        hd_problem(libraries->notes, "%s: the material library '%.*s' is not read, expected %s",
                   libraries->path, hd_span_shown(span), name, fault);
        return false;
    }
    libraries->names[libraries->count++] = name;
    return true;
}

static bool read_bytes(Libraries *libraries, const char *path, const char *name, HdError *problem) {
    unsigned char *bytes;
    size_t size;
    HdObjMemory *memory = libraries->memory;
    const size_t room = memory->most - memory->used;
    const int64_t most = room < INT32_MAX ? (int64_t)room : INT32_MAX;
    if (hd_file_read(path, "material library", most, &bytes, &size, problem) != HD_OK) {
        hd_problem(libraries->notes, "%s: %s", libraries->path, problem->message);
        return true;
    }
    const char *text = (const char *)bytes;
    const HdMtlSource source = {
        path, {text, text + size}, folder_of_textures(libraries->path), folder_of(name)};
    memory->used += size;
    const bool has_room = hd_mtl_read(&source, &libraries->definitions, memory, libraries->notes);
    hd_obj_release(memory, bytes, size);
    return has_room;
}

static bool read_library(Libraries *libraries, const char *name) {
    const HdSpan folder = folder_of(libraries->path);
    const size_t before = (size_t)(folder.end - folder.begin), size = before + strlen(name) + 1;
    char *path = hd_obj_allocate(libraries->memory, size, 1);
    HdError *problem = hd_obj_allocate(libraries->memory, 1, sizeof *problem);
    bool has_room = path != NULL && problem != NULL;
    if (has_room) {
        memcpy(path, folder.begin, before);
        memcpy(path + before, name, size - before);
        has_room = read_bytes(libraries, path, name, problem);
    }
    hd_obj_release(libraries->memory, path, size);
    hd_obj_release(libraries->memory, problem, sizeof *problem);
    return has_room;
}

static bool read_libraries(Libraries *libraries, char *names, size_t size) {
    for (size_t at = 0; at < size; at += strlen(&names[at]) + 1) {
        hd_fix_separators(&names[at]);
        if (admit(libraries, &names[at]) && !read_library(libraries, &names[at]))
            return false;
    }
    return true;
}

static bool allocate_definitions(HdMtlDefinitions *definitions, HdObjMemory *memory) {
    const size_t count = (size_t)definitions->names->count;
    definitions->of = hd_obj_allocate(memory, count, sizeof *definitions->of);
    definitions->order = hd_obj_allocate(memory, count, sizeof *definitions->order);
    for (size_t i = 0; definitions->of != NULL && i < count; i++)
        definitions->of[i] = (HdMtlDefinition){.parameters = hd_mtl_defaults};
    return definitions->of != NULL && definitions->order != NULL;
}

static void free_definitions(HdMtlDefinitions *definitions) {
    for (int i = 0; definitions->of != NULL && i < definitions->names->count; i++)
        free(definitions->of[i].texture);
    free(definitions->of);
    free(definitions->order);
}

/* What has no definition is as if it had one that says nothing. */
static void define_materials(const Libraries *libraries, HdMesh *mesh) {
    const HdMtlDefinitions *definitions = &libraries->definitions;
    char place[256];
    for (int i = 0; i < mesh->material_count; i++)
        hd_mtl_material(&hd_mtl_defaults, &mesh->materials[i], "", libraries->notes);
    for (int i = 0; i < definitions->count; i++) {
        const int number = definitions->order[i];
        HdMtlDefinition *definition = &definitions->of[number];
        HdMeshMaterial *material = &mesh->materials[number];
        const HdSpan name = {material->name, material->name + strlen(material->name)};
        snprintf(place, sizeof place, "%s: material '%.*s'", libraries->path, hd_span_shown(name),
                 name.begin);
        hd_mtl_material(&definition->parameters, material, place, libraries->notes);
        material->texture = definition->texture;
        definition->texture = NULL;
    }
}

static void note_undefined(const Libraries *libraries, const HdMesh *mesh) {
    const HdMtlDefinitions *definitions = &libraries->definitions;
    const int count = mesh->material_count - definitions->count;
    int first = 0;
    if (count == 0)
        return;
    while (definitions->of[first].is_defined)
        first++;
    const char *name = mesh->materials[first].name;
    if (mesh->material_count == 1 && strcmp(name, HD_OBJ_NO_MATERIAL) == 0)
        return; /* the file wants none */
    hd_problem(libraries->notes,
               "%s: no material library has '%.80s'%s, so the default look is taken: white, opaque",
               libraries->path, name, count > 1 ? " and others that faces name" : "");
}

/* The names become the mesh's. */
static bool make_materials(HdNameTable *names, HdObjMemory *memory, HdMesh *mesh) {
    mesh->materials = hd_obj_allocate(memory, (size_t)names->count, sizeof *mesh->materials);
    if (mesh->materials == NULL)
        return false;
    mesh->material_count = names->count;
    for (int i = 0; i < names->count; i++) {
        mesh->materials[i] =
            (HdMeshMaterial){.name = names->names[i], .picture = -1, .passes_as = -1};
        names->names[i] = NULL;
    }
    return true;
}

bool hd_obj_read_materials(HdObjText *text, HdMesh *mesh) {
    Libraries libraries = {.path = text->lines.path,
                           .memory = text->lines.memory,
                           .notes = text->notes,
                           .definitions.names = &text->names};
    const bool has_room = allocate_definitions(&libraries.definitions, libraries.memory) &&
                          read_libraries(&libraries, text->libraries, text->libraries_size) &&
                          make_materials(&text->names, libraries.memory, mesh);
    if (has_room) {
        define_materials(&libraries, mesh);
        note_undefined(&libraries, mesh);
    }
    free_definitions(&libraries.definitions);
    return has_room;
}
