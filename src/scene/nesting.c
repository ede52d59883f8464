/* SPDX-License-Identifier: MIT */
#include "scene/nesting.h"

#include <math.h>
#include <stdlib.h>

#include "base/growth.h"
#include "base/minmax.h"
#include "scene/contact.h"
#include "scene/media.h"
#include "system/interrupt.h"

/* A shell of an object. */
typedef struct Surface {
    const HdMediumObject *object; /* NULL: none */
    int shell;
} Surface;

/* What is around a surface. */
typedef struct Around {
    Surface holder, unsure; /* the innermost that holds it; one in another state */
    HdNestState state;      /* of the unsure one */
} Around;

/* A shell around a point. */
typedef struct Candidate {
    double volume;
    int32_t shell;
} Candidate;

/* The shells of a mesh around each of them, if its own materials count, and if an instance has
   another material. */
typedef struct Own {
    Around *around[2]; /* owned; NULL: not asked for */
} Own;

typedef struct Finder {
    HdMedia media;
    Own *own; /* by model */
    HdNesting *nesting;
    HdError *error;
    bool for_notes;
    HdShellList list; /* reused, like the next */
    Candidate *candidates;
    int candidate_capacity;
    int64_t work; /* visits of boxes and triangles that may follow */
} Finder;

/* Bounds the time for shells that lie too close to each other: about 20 s. */
static const int64_t MAX_WORK = INT64_C(1) << 30;

/* Likewise for a note on those that cross. */
static const int64_t MAX_CROSSING_WORK = INT64_C(1) << 23;

static HdStatus no_memory(HdError *error) {
    return HD_NO_ROOM(error, "the objects that lie within others");
}

/* ---- what counts ---- */

/* Rays do not enter an opaque mesh, but solids hold others in any case. */
static bool is_clear(const HdMediumObject *object, int shell) {
    if (object->material != NULL)
        return !hd_is_opaque(object->material);
    return object->model->media[shell].is_clear;
}

static const HdShell *shell_of(const HdMediumObject *object, int shell) {
    return &object->model->shells->shells[shell];
}

static bool surface_refracts(const Surface *surface) {
    const HdMediumObject *object = surface->object;
    return (object->material != NULL ? object->material->index_of_refraction
                                     : object->model->media[surface->shell].index) != 1.0;
}

/* Returns whether the surface is a closed shell turned inside out, which counts as of index 1. */
static bool is_cavity(const Surface *surface) {
    if (surface->object->solid != NULL || !surface->object->model->shells->are_measured)
        return false;
    const HdShell *shell = shell_of(surface->object, surface->shell);
    return shell->is_closed && shell->volume < 0.0;
}

/* Returns the index within a shell; outer sides that face inwards bound a cavity. NaN: several. */
static double index_within(const HdMediumObject *object, int shell) {
    if (object->solid == NULL && shell_of(object, shell)->volume < 0.0)
        return 1.0;
    return object->material != NULL ? object->material->index_of_refraction
                                    : object->model->media[shell].index;
}

/* ---- pairs ---- */

/* Faces of solids move by less when they are separated; shells keep the same share as a distance.
 */
static const double clear_share = 0x1p-14;

static double volume_of(const Surface *surface) {
    const HdVec3 *to = surface->object->placed.to.columns;
    return fabs(shell_of(surface->object, surface->shell)->volume) * hd_length(to[0]) *
           hd_length(to[1]) * hd_length(to[2]);
}

/* Of two that hold a third, the inner one is smaller. */
static bool is_smaller(const Surface *a, const Surface *b) {
    return volume_of(a) < volume_of(b);
}

static void add_holder(Around *around, const Surface *surface) {
    if (around->holder.object == NULL || is_smaller(surface, &around->holder))
        around->holder = *surface;
}

static HdStatus measure(Finder *finder, const HdMediumObject *object) {
    return hd_shells_measure(object->model->shells, object->model->mesh, finder->error);
}

static HdStatus build_surface(Finder *finder, const Surface *surface) {
    const HdMediumModel *model = surface->object->model;
    return hd_shell_build(model->shells, model->mesh, surface->shell, finder->media.pool,
                          finder->error);
}

static HdStatus is_within(Finder *finder, const Surface *surface, const Surface *outer,
                          bool *is_within) {
    const HdPlacedMesh *placed = &surface->object->placed, *around = &outer->object->placed;
    *is_within = hd_shell_fits(placed, surface->shell, around, outer->shell);
    if (!*is_within)
        return HD_OK;
    HD_TRY(build_surface(finder, surface));
    HD_TRY(build_surface(finder, outer));
    *is_within = hd_shells_are_clear(placed, surface->shell, around, outer->shell, clear_share,
                                     &finder->work);
    return HD_OK;
}

/* Adds what the surface around says about the surface within, which has a corner there. */
static HdStatus judge(Finder *finder, Around *around, const Surface *surface,
                      const Surface *outer) {
    const bool are_closed = shell_of(surface->object, surface->shell)->is_closed &&
                            shell_of(outer->object, outer->shell)->is_closed;
    bool holds = false;
    if (are_closed)
        HD_TRY(is_within(finder, surface, outer, &holds));
    if (holds) {
        add_holder(around, outer);
    } else if (is_clear(outer->object, outer->shell) && around->unsure.object == NULL &&
               index_within(outer->object, outer->shell) != 1.0) {
        around->unsure = *outer;
        around->state = are_closed ? HD_NEST_CROSSES : HD_NEST_OPEN;
    }
    return HD_OK;
}

static int compare_candidates(const void *first, const void *second) {
    const Candidate *a = first, *b = second;
    return a->volume != b->volume ? (a->volume > b->volume) - (a->volume < b->volume)
                                  : (a->shell > b->shell) - (a->shell < b->shell);
}

/* Sorts the listed shells that let rays pass by their volumes. Solids hold others in any case. */
static HdStatus sort_candidates(Finder *finder, const HdMediumObject *object, int *count) {
    *count = 0;
    if (finder->list.count == 0)
        return HD_OK;
    HD_TRY(measure(finder, object));
    finder->candidates = hd_reserved(finder->candidates, sizeof *finder->candidates,
                                     finder->list.count, &finder->candidate_capacity);
    if (finder->candidates == NULL)
        return no_memory(finder->error);
    for (int i = 0; i < finder->list.count; i++) {
        const Surface outer = {object, finder->list.shells[i]};
        if (object->solid != NULL || is_clear(object, outer.shell))
            finder->candidates[(*count)++] = (Candidate){volume_of(&outer), outer.shell};
    }
    if (*count > 0)
        qsort(finder->candidates, (size_t)*count, sizeof *finder->candidates, compare_candidates);
    return HD_OK;
}

static HdVec3 corner_of(const Surface *surface) {
    const HdShells *shells = surface->object->model->shells;
    return hd_mesh_corner(surface->object->model->mesh,
                          shells->triangles[shells->shells[surface->shell].first], 0);
}

/* Adds the shells of a object that hold a corner of the surface, from the smallest to the first one
   that holds all of it. */
static HdStatus judge_object(Finder *finder, Around *around, const Surface *surface,
                             const HdMediumObject *object) {
    const int but = object == surface->object ? surface->shell : -1;
    int count;
    if (!hd_shells_around(
            &object->placed,
            hd_point_between(&surface->object->placed, &object->placed, corner_of(surface)), but,
            &finder->list, &finder->work))
        return no_memory(finder->error);
    HD_TRY(sort_candidates(finder, object, &count));
    if (count > 0)
        HD_TRY(measure(finder, surface->object));
    if (is_cavity(surface) && !finder->for_notes)
        return HD_OK;
    for (int i = 0; i < count && finder->work > 0; i++) {
        const Surface outer = {object, finder->candidates[i].shell};
        if (around->holder.object != NULL && !is_smaller(&outer, &around->holder))
            break;
        HD_TRY(judge(finder, around, surface, &outer));
    }
    return HD_OK;
}

/* ---- shells of one mesh ---- */

static HdStatus poll(const Finder *finder) {
    return hd_interrupt_signal() == 0
               ? HD_OK
               : hd_fail(finder->error, HD_INTERRUPTED,
                         "interrupted while finding the objects that lie within others");
}

/* Finds the shells of a mesh around each other. All its instances share them. */
static HdStatus find_own(Finder *finder, const HdMediumObject *object, Around *own) {
    for (int i = 0; i < object->model->shells->count && finder->work > 0; i++) {
        HD_TRY(poll(finder));
        if (is_clear(object, i))
            HD_TRY(judge_object(finder, &own[i], &(Surface){object, i}, object));
    }
    return HD_OK;
}

static HdStatus add_own(Finder *finder, Around *around, const Surface *surface) {
    const HdMediumObject *object = surface->object;
    Around **own =
        &finder->own[object->model - finder->media.models].around[object->material != NULL];
    if (*own == NULL) {
        *own = calloc((size_t)object->model->shells->count, sizeof **own);
        if (*own == NULL)
            return no_memory(finder->error);
        HD_TRY(find_own(finder, object, *own));
    }
    *around = (*own)[surface->shell];
    if (around->holder.object != NULL)
        around->holder.object = object;
    if (around->unsure.object != NULL)
        around->unsure.object = object;
    return HD_OK;
}

/* ---- all objects ---- */

/* Solids within solids are known. */
static HdStatus add_other(Finder *finder, Around *around, const Surface *surface,
                          const HdMediumObject *object) {
    if (object == surface->object || (object->solid != NULL && surface->object->solid != NULL))
        return HD_OK;
    return judge_object(finder, around, surface, object);
}

static bool is_in_box(HdVec3 point, const HdBox *box) {
    const double at[3] = {point.x, point.y, point.z};
    for (int axis = 0; axis < 3; axis++)
        if (at[axis] < (double)box->lower[axis] || at[axis] > (double)box->upper[axis])
            return false;
    return true;
}

/* Judges the objects whose boxes hold a point of the surface. */
static HdStatus add_others(Finder *finder, Around *around, const Surface *surface, HdVec3 point) {
    int32_t waiting[HD_MAX_HIERARCHY_DEPTH + 2] = {0};
    for (int count = 1; count > 0;) {
        const int32_t child = waiting[--count];
        if (child < 0) {
            HD_TRY(add_other(
                finder, around, surface,
                &finder->media.objects[finder->media.tree.order[~child >> HD_LEAF_SHIFT]]));
            continue;
        }
        const HdBuildNode *node = &finder->media.tree.nodes[child];
        for (int i = 0; i < 2; i++)
            if (is_in_box(point, &node->box[i]))
                waiting[count++] = node->child[i];
    }
    return HD_OK;
}

static HdNestObject name_of(const HdMediumObject *object) {
    return (HdNestObject){object->solid != NULL, object->number};
}

static HdStatus add_result(Finder *finder, const Surface *surface, const Surface *other,
                           HdNestState state, double around) {
    HdNesting *nesting = finder->nesting;
    const HdNested nested = {name_of(surface->object), name_of(other->object), surface->shell,
                             state, around};
    return hd_append(&nesting->list, sizeof nested, &nesting->count, &nesting->capacity, &nested)
               ? HD_OK
               : no_memory(finder->error);
}

static HdStatus add_within(Finder *finder, const Surface *surface, const Surface *holder) {
    const double index = index_within(holder->object, holder->shell);
    if (index == 1.0)
        return HD_OK;
    return isnan(index) ? add_result(finder, surface, holder, HD_NEST_MIXED, 1.0)
                        : add_result(finder, surface, holder, HD_NEST_WITHIN, index);
}

static HdStatus add_results(Finder *finder, const Surface *surface, const Around *around) {
    if (around->holder.object != NULL)
        HD_TRY(add_within(finder, surface, &around->holder));
    if (around->unsure.object != NULL)
        HD_TRY(add_result(finder, surface, &around->unsure, around->state, 1.0));
    return HD_OK;
}

static HdStatus find_around(Finder *finder, Around *around, const Surface *surface) {
    const HdMediumObject *object = surface->object;
    if (object->solid != NULL) {
        const HdScene *scene = finder->media.scene;
        const int number = hd_solid_around(scene->solids, scene->solid_count, object->number);
        if (number >= 0)
            around->holder.object = &finder->media.objects[number];
        return add_others(finder, around, surface, object->solid->centre);
    }
    if (object->model->shells->count > 1)
        HD_TRY(add_own(finder, around, surface));
    return add_others(finder, around, surface, hd_place(&object->placed.to, corner_of(surface)));
}

static HdStatus note_cavity(Finder *finder, const Surface *surface, const Around *around) {
    const bool is_held = around->unsure.object != NULL ||
                         (around->holder.object != NULL &&
                          index_within(around->holder.object, around->holder.shell) != 1.0);
    return finder->for_notes && !is_held && surface_refracts(surface)
               ? add_result(finder, surface, surface, HD_NEST_CAVITY, 1.0)
               : HD_OK;
}

static HdStatus find_surface(Finder *finder, const Surface *surface) {
    Around around = {.state = HD_NEST_WITHIN};
    if (!is_clear(surface->object, surface->shell))
        return HD_OK;
    if (finder->for_notes && surface_refracts(surface) && surface->object->solid == NULL)
        HD_TRY(measure(finder, surface->object));
    HD_TRY(find_around(finder, &around, surface));
    if (finder->work <= 0)
        return add_result(finder, surface, surface, HD_NEST_SKIPPED, 1.0);
    return is_cavity(surface) ? note_cavity(finder, surface, &around)
                              : add_results(finder, surface, &around);
}

/* Leaves one of the results from `first` on if all shells of the object lie within one other. */
static void merge_results(HdNesting *nesting, int first, int shells) {
    if (nesting->count - first != shells || shells < 2)
        return;
    HdNested *list = nesting->list + first;
    for (int i = 0; i < shells; i++)
        if (list[i].state != HD_NEST_WITHIN || list[i].around != list[0].around ||
            list[i].other.is_solid != list[0].other.is_solid ||
            list[i].other.number != list[0].other.number)
            return;
    list[0].shell = HD_ALL_SHELLS;
    nesting->count = first + 1;
}

static HdStatus find_object(Finder *finder, const HdMediumObject *object) {
    const int shells = object->solid != NULL ? 1 : object->model->shells->count;
    const int first = finder->nesting->count;
    for (int i = 0; i < shells && finder->work > 0; i++) {
        HD_TRY(poll(finder));
        HD_TRY(find_surface(finder, &(Surface){object, i}));
    }
    merge_results(finder->nesting, first, shells);
    return HD_OK;
}

/* ---- crossings ---- */

static bool object_refracts(const Finder *finder, const HdMediumObject *object) {
    return object->solid != NULL ? hd_refracts(&object->solid->face)
                                 : hd_instance_refracts(finder->media.scene, object->number);
}

static HdStatus surfaces_cross(Finder *finder, const Surface *a, const Surface *b, bool *cross) {
    const HdPlacedMesh *placed = &a->object->placed, *other = &b->object->placed;
    if (--finder->work <= 0 || !hd_shell_boxes_meet(placed, a->shell, other, b->shell))
        return HD_OK;
    HD_TRY(build_surface(finder, a));
    HD_TRY(build_surface(finder, b));
    const bool are_clear =
        hd_shells_are_clear(placed, a->shell, other, b->shell, 0.0, &finder->work);
    *cross = !are_clear && finder->work > 0;
    return HD_OK;
}

/* Solids that cross are none of a valid scene. */
static HdStatus objects_cross(Finder *finder, const HdMediumObject *a, const HdMediumObject *b,
                              bool *cross) {
    if ((a->solid != NULL && b->solid != NULL) ||
        !hd_boxes_meet(a->lower, a->upper, b->lower, b->upper))
        return HD_OK;
    HD_TRY(poll(finder));
    for (int i = 0; i < a->model->shells->count && finder->work > 0; i++) {
        const int count = a == b ? i : b->model->shells->count;
        for (int k = 0; k < count && !*cross && finder->work > 0; k++)
            HD_TRY(surfaces_cross(finder, &(Surface){a, i}, &(Surface){b, k}, cross));
    }
    return HD_OK;
}

static bool knows_crossing(const HdNesting *nesting) {
    for (int i = 0; i < nesting->count; i++)
        if (nesting->list[i].state == HD_NEST_CROSSES)
            return true;
    return false;
}

static HdStatus find_crossing(Finder *finder) {
    bool cross = false;
    if (knows_crossing(finder->nesting))
        return HD_OK;
    finder->work = finder->work < MAX_CROSSING_WORK ? finder->work : MAX_CROSSING_WORK;
    for (int i = 0; i < finder->media.object_count && finder->work > 0; i++) {
        const HdMediumObject *object = &finder->media.objects[i];
        for (int j = 0; j <= i && object_refracts(finder, object) && finder->work > 0; j++) {
            const HdMediumObject *other = &finder->media.objects[j];
            finder->work--;
            if (object_refracts(finder, other))
                HD_TRY(objects_cross(finder, object, other, &cross));
            if (cross)
                return add_result(finder, &(Surface){other, 0}, &(Surface){object, 0},
                                  HD_NEST_CROSSES, 1.0);
        }
    }
    return HD_OK;
}

/* ---- all ---- */

static HdStatus find(Finder *finder, const HdScene *scene) {
    HdNesting *nesting = finder->nesting;
    nesting->mesh_count = scene->mesh_count;
    nesting->shells = calloc((size_t)scene->mesh_count + 1, sizeof *nesting->shells);
    finder->own =
        calloc((size_t)scene->mesh_count + (size_t)scene->solid_count, sizeof *finder->own);
    if (nesting->shells == NULL || finder->own == NULL)
        return no_memory(finder->error);
    HD_TRY(hd_media_find(&finder->media, scene, nesting->shells, finder->error));
    for (int i = 0; i < finder->media.object_count && finder->work > 0; i++)
        HD_TRY(find_object(finder, &finder->media.objects[i]));
    return finder->for_notes ? find_crossing(finder) : HD_OK;
}

static void free_finder(Finder *finder) {
    const HdScene *scene = finder->media.scene;
    for (int i = 0; finder->own != NULL && i < scene->mesh_count + scene->solid_count; i++) {
        free(finder->own[i].around[0]);
        free(finder->own[i].around[1]);
    }
    free(finder->own);
    free(finder->list.shells);
    free(finder->candidates);
    hd_media_free(&finder->media);
}

HdStatus hd_nesting_find(HdNesting *nesting, const HdScene *scene, bool for_notes, HdError *error) {
    *nesting = (HdNesting){0};
    if (!hd_has_media(scene))
        return HD_OK;
    Finder finder = {.media.scene = scene,
                     .nesting = nesting,
                     .error = error,
                     .for_notes = for_notes,
                     .work = MAX_WORK};
    const HdStatus status = find(&finder, scene);
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
