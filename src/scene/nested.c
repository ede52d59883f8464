/* SPDX-License-Identifier: MIT */
/* Makes indices of refraction relative. */
#include <stdlib.h>
#include <string.h>

#include "base/growth.h"
#include "scene/nesting.h"

/* The index around each shell of an instance, if one is not 1. */
typedef struct Surroundings {
    int instance;
    double all;     /* of all shells, unless `around` is there */
    double *around; /* owned; by shell */
} Surroundings;

/* Shells of a mesh form a class if, in each instance, the index around them is the same. */
typedef struct Classes {
    int count;
    int32_t *first; /* owned; the first shell of each */
    int32_t *of;    /* owned; of each shell */
} Classes;

typedef struct Nester {
    HdScene *scene;
    const HdNesting *nesting;
    HdError *error;
    int count, capacity; /* of what follows, in the order of instances */
    Surroundings *list;  /* owned */
} Nester;

static HdStatus no_memory(const Nester *nester) {
    HD_NO_ROOM(nester->error, "the materials of meshes within others");
    return HD_FAILED;
}

/* ---- surroundings ---- */

static HdStatus add_surroundings(Nester *nester, const HdNested *nested) {
    const int instance = nested->object.number;
    const int shells = nester->nesting->shells[nester->scene->instances[instance].mesh].count;
    Surroundings added = {.instance = instance, .all = nested->around};
    const bool is_one = nested->shell == HD_ALL_SHELLS;
    if (!is_one)
        added.around = malloc((size_t)shells * sizeof(double));
    if ((!is_one && added.around == NULL) ||
        !hd_append(&nester->list, sizeof added, &nester->count, &nester->capacity, &added)) {
        free(added.around);
        return no_memory(nester);
    }
    for (int i = 0; i < shells && !is_one; i++)
        added.around[i] = 1.0;
    return HD_OK;
}

static HdStatus list_surroundings(Nester *nester) {
    for (int i = 0; i < nester->nesting->count; i++) {
        const HdNested *nested = &nester->nesting->list[i];
        if (nested->state != HD_NEST_WITHIN || nested->object.is_solid)
            continue;
        if (nester->count == 0 || nester->list[nester->count - 1].instance != nested->object.number)
            HD_TRY(add_surroundings(nester, nested));
        if (nested->shell != HD_ALL_SHELLS)
            nester->list[nester->count - 1].around[nested->shell] = nested->around;
    }
    return HD_OK;
}

static double index_around(const Surroundings *in, int shell) {
    return in->around != NULL ? in->around[shell] : in->all;
}

static bool is_of_mesh(const Nester *nester, const Surroundings *in, int mesh) {
    return nester->scene->instances[in->instance].mesh == mesh;
}

static bool has_surroundings(const Nester *nester, int mesh) {
    for (int i = 0; i < nester->count; i++)
        if (is_of_mesh(nester, &nester->list[i], mesh))
            return true;
    return false;
}

/* ---- classes ---- */

static bool are_alike(const Nester *nester, int mesh, int a, int b) {
    for (int i = 0; i < nester->count; i++)
        if (is_of_mesh(nester, &nester->list[i], mesh) &&
            index_around(&nester->list[i], a) != index_around(&nester->list[i], b))
            return false;
    return true;
}

/* Returns false if out of memory. */
static bool classify(const Nester *nester, int mesh, Classes *classes) {
    const size_t count = (size_t)nester->nesting->shells[mesh].count;
    classes->of = malloc(count * sizeof *classes->of);
    classes->first = calloc(count, sizeof *classes->first);
    if (classes->of == NULL || classes->first == NULL)
        return false;
    for (int32_t i = 0; i < (int32_t)count; i++) {
        int class = 0;
        while (class < classes->count && !are_alike(nester, mesh, classes->first[class], i))
            class ++;
        if (class == classes->count)
            classes->first[classes->count++] = i;
        classes->of[i] = class;
    }
    return true;
}

/* ---- materials ---- */

/* Classes of materials: 0 for the mesh's own, then those of their copies. */
typedef struct Copies {
    int count, capacity;
    int32_t *class_of; /* owned; of each copy */
    int32_t *number;   /* owned; of the copy of each material for each class; 0: none */
} Copies;

static HdStatus refuse_materials(const Nester *nester, const HdMesh *mesh, int own, int classes) {
    int i = 0;
    while (&nester->scene->meshes[nester->scene->instances[i].mesh] != mesh)
        i++;
    return hd_fail(nester->error, HD_BAD_INPUT,
                   "meshes[%d]: its parts lie in %d media, so that its %d materials need copies; "
                   "expected at most %d materials and copies",
                   nester->scene->instances[i].entry, classes, own, (int)HD_MAX_MESH_MATERIALS);
}

/* Changes the materials of the triangles in all classes but the first to copies. */
static HdStatus copy_materials(const Nester *nester, HdMesh *mesh, const int32_t *shell_of,
                               const Classes *classes, Copies *copies) {
    const int own = mesh->material_count;
    copies->number = calloc((size_t)classes->count * (size_t)own, sizeof *copies->number);
    if (mesh->material_of == NULL)
        mesh->material_of = calloc((size_t)mesh->triangle_count, sizeof *mesh->material_of);
    if (copies->number == NULL || mesh->material_of == NULL)
        return no_memory(nester);
    for (int i = 0; i < mesh->triangle_count; i++) {
        const int32_t class = classes->of[shell_of[i]];
        int32_t *number = &copies->number[class * own + mesh->material_of[i]];
        if (class == 0)
            continue;
        if (*number == 0) {
            *number = mesh->material_count;
            if (*number >= HD_MAX_MESH_MATERIALS)
                return refuse_materials(nester, mesh, own, classes->count);
            if (!hd_mesh_copy_material(mesh, mesh->material_of[i]) ||
                !hd_append(&copies->class_of, sizeof class, &copies->count, &copies->capacity,
                           &class))
                return no_memory(nester);
        }
        mesh->material_of[i] = *number;
    }
    return HD_OK;
}

/* Sets the index around each material of each instance of the mesh. */
static HdStatus set_around(const Nester *nester, int mesh, const Classes *classes,
                           const Copies *copies) {
    const int count = nester->scene->meshes[mesh].material_count, own = count - copies->count;
    for (int i = 0; i < nester->count; i++) {
        const Surroundings *in = &nester->list[i];
        if (!is_of_mesh(nester, in, mesh))
            continue;
        double *around = malloc((size_t)count * sizeof *around);
        if (around == NULL)
            return no_memory(nester);
        for (int m = 0; m < own; m++)
            around[m] = index_around(in, classes->first[0]);
        for (int m = 0; m < copies->count; m++)
            around[own + m] = index_around(in, classes->first[copies->class_of[m]]);
        nester->scene->instances[in->instance].around = around;
    }
    return HD_OK;
}

static HdStatus nest_mesh(const Nester *nester, int mesh) {
    Classes classes = {0};
    Copies copies = {0};
    HdStatus status = classify(nester, mesh, &classes) ? HD_OK : no_memory(nester);
    if (status == HD_OK && classes.count > 1)
        status = copy_materials(nester, &nester->scene->meshes[mesh],
                                nester->nesting->shells[mesh].shell_of, &classes, &copies);
    if (status == HD_OK)
        status = set_around(nester, mesh, &classes, &copies);
    free(classes.first);
    free(classes.of);
    free(copies.class_of);
    free(copies.number);
    return status;
}

static void nest_solids(const Nester *nester) {
    for (int i = 0; i < nester->nesting->count; i++) {
        const HdNested *nested = &nester->nesting->list[i];
        if (nested->state == HD_NEST_WITHIN && nested->object.is_solid)
            nester->scene->solids[nested->object.number].face.index_of_refraction /= nested->around;
    }
}

HdStatus hd_scene_nest(HdScene *scene, HdError *error) {
    HdNesting nesting;
    HD_TRY(hd_nesting_find(&nesting, scene, false, error));
    Nester nester = {.scene = scene, .nesting = &nesting, .error = error};
    HdStatus status = list_surroundings(&nester);
    for (int i = 0; i < scene->mesh_count && status == HD_OK; i++)
        if (has_surroundings(&nester, i))
            status = nest_mesh(&nester, i);
    if (status == HD_OK)
        nest_solids(&nester);
    for (int i = 0; i < nester.count; i++)
        free(nester.list[i].around);
    free(nester.list);
    hd_nesting_free(&nesting);
    return status;
}
