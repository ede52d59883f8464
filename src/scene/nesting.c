/* SPDX-License-Identifier: MIT */
#include "scene/nesting.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/growth.h"
#include "base/minmax.h"
#include "scene/contact.h"
#include "scene/shell_gap.h"
#include "scene/triangulate.h"

/* The triangles of a shell that let rays pass. */
typedef struct Look {
    bool is_clear; /* there are such */
    double index;  /* their index of refraction; NaN: several */
} Look;

/* The shell of the same mesh around a shell. */
typedef struct Holder {
    int32_t shell, unsure; /* the innermost; one in another state; -1: none */
    HdNestState state;     /* of the unsure one */
} Holder;

/* A mesh, or the faces of a solid. */
typedef struct Model {
    const HdMesh *mesh;
    HdShells *shells;
    Look *looks;        /* owned; of the mesh's own materials, by shell */
    Holder *holders[2]; /* owned; by shell, if own materials count, and if all shells are clear */
} Model;

/* A solid, or an instance that lets rays pass. */
typedef struct Thing {
    HdNestObject object;
    const HdSolid *solid;       /* NULL: an instance */
    const HdMaterial *material; /* of all triangles; NULL: the mesh's own ones */
    Model *model;               /* NULL without clear instances */
    HdPlacedMesh placed;
    HdVec3 lower, upper; /* box in the world */
} Thing;

typedef struct Finder {
    const HdScene *scene;
    HdNesting *nesting;
    HdError *error;
    int thing_count;
    Thing *things;
    Model *models;  /* of the meshes, then of the solids */
    HdMesh *solids; /* faces of the solids */
    HdShells *of_solids;
    HdHierarchy tree; /* over the things */
    HdShellList list; /* reused */
} Finder;

static HdStatus no_memory(HdError *error) {
    HD_NO_ROOM(error, "the objects that lie within others");
    return HD_FAILED;
}

/* ---- what counts ---- */

static bool is_clear_instance(const HdScene *scene, int number) {
    const HdInstance *instance = &scene->instances[number];
    const HdMesh *mesh = hd_mesh_of(scene, number);
    if (instance->has_material)
        return !hd_is_opaque(&instance->material);
    for (int i = 0; i < mesh->material_count; i++)
        if (!hd_is_opaque(&mesh->materials[i].material))
            return true;
    return false;
}

static bool refracts(const HdMaterial *material) {
    return material->index_of_refraction != 1.0 && !hd_is_opaque(material);
}

static bool instance_refracts(const HdScene *scene, int number) {
    const HdInstance *instance = &scene->instances[number];
    const HdMesh *mesh = hd_mesh_of(scene, number);
    bool found = instance->has_material && refracts(&instance->material);
    for (int i = 0; i < mesh->material_count && !instance->has_material; i++)
        found |= refracts(&mesh->materials[i].material);
    return found;
}

/* Opaque solids count too. */
static bool has_media(const HdScene *scene) {
    for (int i = 0; i < scene->solid_count; i++)
        if (scene->solids[i].face.index_of_refraction != 1.0)
            return true;
    for (int i = 0; i < scene->instance_count; i++)
        if (instance_refracts(scene, i))
            return true;
    return false;
}

/* Rays do not enter an opaque mesh, but solids hold others in any case. */
static bool is_clear(const Thing *thing, int shell) {
    if (thing->material != NULL)
        return !hd_is_opaque(thing->material);
    return thing->model->looks[shell].is_clear;
}

static const HdShell *shell_of(const Thing *thing, int shell) {
    return &thing->model->shells->shells[shell];
}

/* Returns the index within a shell; outer sides that face inwards bound a cavity. NaN: several. */
static double index_within(const Thing *thing, int shell) {
    if (thing->solid == NULL && shell_of(thing, shell)->volume < 0.0)
        return 1.0;
    return thing->material != NULL ? thing->material->index_of_refraction
                                   : thing->model->looks[shell].index;
}

/* ---- preparing ---- */

static void look_at(Look *look, const HdMaterial *material) {
    if (hd_is_opaque(material))
        return;
    if (!look->is_clear)
        *look = (Look){true, material->index_of_refraction};
    else if (look->index != material->index_of_refraction)
        look->index = (double)NAN;
}

static HdStatus prepare_model(Model *model, const HdMesh *mesh, HdShells *shells, HdError *error) {
    if (model->mesh != NULL)
        return HD_OK;
    *model = (Model){.mesh = mesh, .shells = shells};
    HD_TRY(hd_shells_find(shells, mesh, error));
    model->looks = calloc((size_t)shells->count, sizeof *model->looks);
    if (model->looks == NULL)
        return no_memory(error);
    for (int i = 0; i < mesh->triangle_count; i++)
        look_at(&model->looks[shells->shell_of[i]],
                &mesh->materials[mesh->material_of != NULL ? mesh->material_of[i] : 0].material);
    return HD_OK;
}

static void place_thing(Thing *thing, HdPlacement to) {
    const HdMesh *mesh = thing->model->mesh;
    const HdVec3 half = hd_placed_half(
        &to, hd_scale(hd_sub(mesh->upper, mesh->lower), 0.5 / hd_mesh_half_side(mesh)));
    thing->placed = (HdPlacedMesh){mesh, thing->model->shells, to};
    thing->lower = hd_sub(to.start, half);
    thing->upper = hd_add(to.start, half);
}

/* A solid's faces, without rim and discs. */
static HdStatus mesh_solid(Finder *finder, Thing *thing, int number, HdThreadPool *pool) {
    HdMesh *mesh = &finder->solids[number];
    HdSolid plain = *thing->solid;
    plain.rim_width = 0.0;
    plain.lights.per_edge = 0;
    HD_TRY(hd_triangulate_solid(mesh, &plain, HD_MIN_DISC_SIDES, 1, finder->error));
    HD_TRY(hd_mesh_build(mesh, pool, finder->error));
    thing->model = &finder->models[finder->scene->mesh_count + number];
    HD_TRY(prepare_model(thing->model, mesh, &finder->of_solids[number], finder->error));
    HD_TRY(hd_shells_measure(&finder->of_solids[number], mesh, finder->error));
    const double half = hd_mesh_half_side(mesh);
    place_thing(thing, (HdPlacement){{{half, 0.0, 0.0}, {0.0, half, 0.0}, {0.0, 0.0, half}},
                                     hd_add(thing->solid->centre, hd_mesh_centre(mesh))});
    return HD_OK;
}

static HdStatus add_solids(Finder *finder, bool has_meshes, HdThreadPool *pool) {
    for (int i = 0; i < finder->scene->solid_count; i++) {
        const HdSolid *solid = &finder->scene->solids[i];
        const double radius = solid->circumradius;
        Thing *thing = &finder->things[finder->thing_count++];
        *thing = (Thing){.object = {true, i}, .solid = solid, .material = &solid->face};
        if (has_meshes)
            HD_TRY(mesh_solid(finder, thing, i, pool));
        thing->lower = hd_sub(solid->centre, hd_vec3(radius, radius, radius));
        thing->upper = hd_add(solid->centre, hd_vec3(radius, radius, radius));
    }
    return HD_OK;
}

static HdStatus add_instances(Finder *finder) {
    const HdScene *scene = finder->scene;
    for (int i = 0; i < scene->instance_count; i++) {
        const HdInstance *instance = &scene->instances[i];
        if (!is_clear_instance(scene, i))
            continue;
        Thing *thing = &finder->things[finder->thing_count++];
        *thing = (Thing){.object = {false, i},
                         .material = instance->has_material ? &instance->material : NULL,
                         .model = &finder->models[instance->mesh]};
        HD_TRY(prepare_model(thing->model, hd_mesh_of(scene, i),
                             &finder->nesting->shells[instance->mesh], finder->error));
        place_thing(thing, hd_placement_of(scene, i));
    }
    return HD_OK;
}

/* Returns a box in floats, slightly too large. */
static HdBox box_of(const Thing *thing) {
    const double lower[3] = {thing->lower.x, thing->lower.y, thing->lower.z};
    const double upper[3] = {thing->upper.x, thing->upper.y, thing->upper.z};
    HdBox box;
    for (int axis = 0; axis < 3; axis++) {
        box.lower[axis] = nextafterf((float)lower[axis], -FLT_MAX);
        box.upper[axis] = nextafterf((float)upper[axis], FLT_MAX);
    }
    return box;
}

static HdStatus build_tree(Finder *finder, HdThreadPool *pool) {
    const HdHierarchyOptions options = {.node_cost = 0.1f, .max_in_leaf = 1};
    HdBox *boxes = calloc((size_t)finder->thing_count, sizeof *boxes);
    if (boxes == NULL)
        return no_memory(finder->error);
    for (int i = 0; i < finder->thing_count; i++)
        boxes[i] = box_of(&finder->things[i]);
    const HdStatus status = hd_hierarchy_build(&finder->tree, boxes, finder->thing_count, &options,
                                               pool, finder->error);
    free(boxes);
    return status;
}

static HdStatus prepare(Finder *finder) {
    const HdScene *scene = finder->scene;
    const size_t solids = (size_t)scene->solid_count, meshes = (size_t)scene->mesh_count;
    bool has_meshes = false;
    for (int i = 0; i < scene->instance_count && !has_meshes; i++)
        has_meshes = is_clear_instance(scene, i);
    finder->nesting->mesh_count = scene->mesh_count;
    finder->nesting->shells = calloc(meshes + 1, sizeof(HdShells));
    finder->things = calloc(solids + (size_t)scene->instance_count, sizeof *finder->things);
    finder->models = calloc(solids + meshes, sizeof *finder->models);
    finder->solids = calloc(solids + 1, sizeof *finder->solids);
    finder->of_solids = calloc(solids + 1, sizeof *finder->of_solids);
    if (finder->nesting->shells == NULL || finder->things == NULL || finder->models == NULL ||
        finder->solids == NULL || finder->of_solids == NULL)
        return no_memory(finder->error);
    HdThreadPool *pool = NULL;
    HdStatus status = hd_thread_pool_create(&pool, 1, finder->error);
    if (status == HD_OK)
        status = add_solids(finder, has_meshes, pool);
    if (status == HD_OK)
        status = add_instances(finder);
    if (status == HD_OK)
        status = build_tree(finder, pool);
    hd_thread_pool_destroy(pool);
    return status;
}

/* ---- pairs ---- */

/* Faces of solids move by less when they are separated; shells keep the same share as a distance.
 */
static const double clear_share = 0x1p-14;

/* A shell of a thing. */
typedef struct Part {
    const Thing *thing;
    int shell;
} Part;

/* What was found around a part. */
typedef struct Around {
    Part holder, unsure; /* the innermost that holds it; one in another state */
    HdNestState state;   /* of the unsure one */
} Around;

static double volume_of(const Part *part) {
    const HdVec3 *to = part->thing->placed.to.columns;
    return fabs(shell_of(part->thing, part->shell)->volume) * hd_length(to[0]) * hd_length(to[1]) *
           hd_length(to[2]);
}

/* Of two that hold a third, the inner one is smaller. */
static bool is_smaller(const Part *a, const Part *b) {
    if (a->thing->solid != NULL && b->thing->solid != NULL)
        return a->thing->solid->circumradius < b->thing->solid->circumradius;
    return volume_of(a) < volume_of(b);
}

static void add_holder(Around *around, const Part *part) {
    if (around->holder.thing == NULL || is_smaller(part, &around->holder))
        around->holder = *part;
}

/* Adds what the part around says about the part within, which has a corner there. */
static HdStatus judge(Finder *finder, Around *around, const Part *within, const Part *outer) {
    const Model *model = within->thing->model, *of_outer = outer->thing->model;
    HD_TRY(hd_shells_measure(model->shells, model->mesh, finder->error));
    HD_TRY(hd_shells_measure(of_outer->shells, of_outer->mesh, finder->error));
    const HdShell *a = shell_of(within->thing, within->shell);
    const HdShell *b = shell_of(outer->thing, outer->shell);
    if (a->is_closed && a->volume < 0.0) /* a cavity, itself of index 1 */
        return HD_OK;
    const bool are_closed = a->is_closed && b->is_closed;
    if (are_closed && hd_shells_are_clear(&within->thing->placed, within->shell,
                                          &outer->thing->placed, outer->shell, clear_share)) {
        add_holder(around, outer);
    } else if (is_clear(outer->thing, outer->shell) && around->unsure.thing == NULL &&
               index_within(outer->thing, outer->shell) != 1.0) {
        around->unsure = *outer;
        around->state = are_closed ? HD_NEST_CROSSES : HD_NEST_OPEN;
    }
    return HD_OK;
}

/* Adds the shells of a thing that hold a corner of the part. */
static HdStatus judge_thing(Finder *finder, Around *around, const Part *part, const Thing *thing) {
    const int but = thing == part->thing ? part->shell : -1;
    const HdVec3 corner =
        hd_mesh_corner(part->thing->model->mesh, shell_of(part->thing, part->shell)->first, 0);
    if (!hd_shells_around(&thing->placed,
                          hd_point_between(&part->thing->placed, &thing->placed, corner), but,
                          &finder->list))
        return no_memory(finder->error);
    for (int i = 0; i < finder->list.count; i++) {
        const Part outer = {thing, finder->list.shells[i]};
        if (thing->solid != NULL || is_clear(thing, outer.shell))
            HD_TRY(judge(finder, around, part, &outer));
    }
    return HD_OK;
}

/* ---- shells of one mesh ---- */

/* Finds the holders of all shells of a mesh that has several. All places of it share them. */
static HdStatus find_holders(Finder *finder, const Thing *thing, Holder *holders) {
    for (int i = 0; i < thing->model->shells->count; i++) {
        Around around = {.state = HD_NEST_WITHIN};
        const Part part = {thing, i};
        if (is_clear(thing, i))
            HD_TRY(judge_thing(finder, &around, &part, thing));
        holders[i] = (Holder){around.holder.thing != NULL ? around.holder.shell : -1,
                              around.unsure.thing != NULL ? around.unsure.shell : -1, around.state};
    }
    return HD_OK;
}

static HdStatus add_own(Finder *finder, Around *around, const Part *part) {
    const Thing *thing = part->thing;
    Holder **holders = &thing->model->holders[thing->material != NULL];
    const int count = thing->model->shells->count;
    if (*holders == NULL) {
        *holders = calloc((size_t)count, sizeof **holders);
        if (*holders == NULL)
            return no_memory(finder->error);
        HD_TRY(find_holders(finder, thing, *holders));
    }
    const Holder *holder = &(*holders)[part->shell];
    if (holder->shell >= 0)
        add_holder(around, &(Part){thing, holder->shell});
    if (holder->unsure >= 0 && around->unsure.thing == NULL) {
        around->unsure = (Part){thing, holder->unsure};
        around->state = holder->state;
    }
    return HD_OK;
}

/* ---- all things ---- */

static HdStatus add_other(Finder *finder, Around *around, const Part *part, const Thing *thing) {
    if (thing == part->thing)
        return HD_OK;
    if (thing->solid == NULL || part->thing->solid == NULL)
        return judge_thing(finder, around, part, thing);
    if (hd_solid_holds(thing->solid, part->thing->solid))
        add_holder(around, &(Part){thing, 0});
    return HD_OK;
}

static bool is_in_box(HdVec3 point, const HdBox *box) {
    const double at[3] = {point.x, point.y, point.z};
    for (int axis = 0; axis < 3; axis++)
        if (at[axis] < (double)box->lower[axis] || at[axis] > (double)box->upper[axis])
            return false;
    return true;
}

/* Judges the things whose boxes hold a point of the part. */
static HdStatus add_others(Finder *finder, Around *around, const Part *part, HdVec3 point) {
    int32_t waiting[HD_MAX_HIERARCHY_DEPTH + 2] = {0};
    for (int count = 1; count > 0;) {
        const int32_t child = waiting[--count];
        if (child < 0) {
            HD_TRY(add_other(finder, around, part,
                             &finder->things[finder->tree.order[~child >> HD_LEAF_SHIFT]]));
            continue;
        }
        const HdBuildNode *node = &finder->tree.nodes[child];
        for (int i = 0; i < 2; i++)
            if (is_in_box(point, &node->box[i]))
                waiting[count++] = node->child[i];
    }
    return HD_OK;
}

static HdStatus add_result(Finder *finder, const Part *part, const Part *other, HdNestState state,
                           double around) {
    HdNesting *nesting = finder->nesting;
    const HdNested nested = {part->thing->object, other->thing->object, part->shell, state, around};
    return hd_append(&nesting->list, sizeof nested, &nesting->count, &nesting->capacity, &nested)
               ? HD_OK
               : no_memory(finder->error);
}

static HdStatus add_within(Finder *finder, const Part *part, const Part *holder) {
    const double index = index_within(holder->thing, holder->shell);
    if (index == 1.0)
        return HD_OK;
    return isnan(index) ? add_result(finder, part, holder, HD_NEST_MIXED, 1.0)
                        : add_result(finder, part, holder, HD_NEST_WITHIN, index);
}

static HdStatus add_results(Finder *finder, const Part *part, const Around *around) {
    if (around->holder.thing != NULL)
        HD_TRY(add_within(finder, part, &around->holder));
    if (around->unsure.thing != NULL)
        HD_TRY(add_result(finder, part, &around->unsure, around->state, 1.0));
    return HD_OK;
}

static HdStatus find_part(Finder *finder, const Part *part) {
    const Thing *thing = part->thing;
    Around around = {.state = HD_NEST_WITHIN};
    HdVec3 point;
    if (!is_clear(thing, part->shell))
        return HD_OK;
    if (thing->solid != NULL)
        point = thing->solid->centre;
    else
        point = hd_place(&thing->placed.to, hd_mesh_corner(thing->model->mesh,
                                                           shell_of(thing, part->shell)->first, 0));
    if (thing->solid == NULL && thing->model->shells->count > 1)
        HD_TRY(add_own(finder, &around, part));
    HD_TRY(add_others(finder, &around, part, point));
    return add_results(finder, part, &around);
}

/* ---- crossings ---- */

/* Comparing more would take long; a note on some is enough. */
enum { MAX_COMPARED = 1000 };

static bool thing_refracts(const Finder *finder, const Thing *thing) {
    return thing->solid != NULL ? refracts(&thing->solid->face)
                                : instance_refracts(finder->scene, thing->object.number);
}

static bool boxes_meet(const Thing *a, const Thing *b) {
    return a->lower.x <= b->upper.x && b->lower.x <= a->upper.x && a->lower.y <= b->upper.y &&
           b->lower.y <= a->upper.y && a->lower.z <= b->upper.z && b->lower.z <= a->upper.z;
}

/* Solids that cross are none of a valid scene. */
static bool cross(const Thing *a, const Thing *b) {
    if (a->solid != NULL && b->solid != NULL)
        return false;
    if (a == b && a->model->shells->count == 1)
        return false;
    return boxes_meet(a, b) &&
           !hd_shells_are_clear(&a->placed, HD_ANY_SHELL, &b->placed, HD_ANY_SHELL, 0.0);
}

static bool knows_crossing(const HdNesting *nesting) {
    for (int i = 0; i < nesting->count; i++)
        if (nesting->list[i].state == HD_NEST_CROSSES)
            return true;
    return false;
}

static HdStatus find_crossing(Finder *finder) {
    const int count = hd_min(finder->thing_count, MAX_COMPARED);
    if (knows_crossing(finder->nesting))
        return HD_OK;
    for (int i = 0; i < count; i++) {
        const Thing *thing = &finder->things[i];
        for (int j = 0; j <= i && thing_refracts(finder, thing); j++)
            if (thing_refracts(finder, &finder->things[j]) && cross(thing, &finder->things[j]))
                return add_result(finder, &(Part){&finder->things[j], 0}, &(Part){thing, 0},
                                  HD_NEST_CROSSES, 1.0);
    }
    return HD_OK;
}

/* ---- all ---- */

static HdStatus find(Finder *finder, bool finds_crossings) {
    HD_TRY(prepare(finder));
    for (int i = 0; i < finder->thing_count; i++) {
        const Thing *thing = &finder->things[i];
        const int shells = thing->solid != NULL ? 1 : thing->model->shells->count;
        for (int k = 0; k < shells; k++)
            HD_TRY(find_part(finder, &(Part){thing, k}));
    }
    return finds_crossings ? find_crossing(finder) : HD_OK;
}

static void free_finder(Finder *finder) {
    const int solids = finder->scene->solid_count, meshes = finder->scene->mesh_count;
    for (int i = 0; finder->models != NULL && i < meshes + solids; i++) {
        free(finder->models[i].looks);
        free(finder->models[i].holders[0]);
        free(finder->models[i].holders[1]);
    }
    for (int i = 0; finder->solids != NULL && i < solids; i++)
        hd_mesh_free(&finder->solids[i]);
    for (int i = 0; finder->of_solids != NULL && i < solids; i++)
        hd_shells_free(&finder->of_solids[i]);
    free(finder->things);
    free(finder->models);
    free(finder->solids);
    free(finder->of_solids);
    free(finder->list.shells);
    hd_hierarchy_free(&finder->tree);
}

HdStatus hd_nesting_find(HdNesting *nesting, const HdScene *scene, bool finds_crossings,
                         HdError *error) {
    *nesting = (HdNesting){0};
    if (!has_media(scene))
        return HD_OK;
    Finder finder = {.scene = scene, .nesting = nesting, .error = error};
    const HdStatus status = find(&finder, finds_crossings);
    free_finder(&finder);
    if (status != HD_OK)
        hd_nesting_free(nesting);
    return status;
}

void hd_nesting_free(HdNesting *nesting) {
    for (int i = 0; nesting->shells != NULL && i < nesting->mesh_count; i++)
        hd_shells_free(&nesting->shells[i]);
    free(nesting->shells);
    free(nesting->list);
    *nesting = (HdNesting){0};
}
