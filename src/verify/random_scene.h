/* SPDX-License-Identifier: MIT */
/* Small scenes made by lot, of everything that kernels do: what no golden frame holds. */
#ifndef HD_VERIFY_RANDOM_SCENE_H
#define HD_VERIFY_RANDOM_SCENE_H

#include "scene/camera.h"
#include "tables/table.h"

/* Scenes of one kind are rendered by the same kernels. */
typedef struct HdRandomKind {
    const char *name;
    HdSceneTables needs; /* what the kernels are built for (hd_scene_tables_raise) */
    bool has_meshes, has_few_lights, has_many_lights, is_surveyed;
} HdRandomKind;

enum { HD_RANDOM_KINDS = 12 };
extern const HdRandomKind hd_random_kinds[HD_RANDOM_KINDS];

/* The kind of a seed's scene: kinds take turns. */
int hd_random_kind_of(uint64_t seed);

/* Builds the scene of a seed, the same on every machine, which the caller frees. It is valid. For
   want of memory the program ends, as with the golden frames (hd_golden_build). */
void hd_random_scene(uint64_t seed, HdScene *scene, HdCamera *camera);

#endif
