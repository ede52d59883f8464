/* SPDX-License-Identifier: MIT */
/* What was measured on devices, remembered in the cache folder (cache_folder.h) for jobs alike:
   those of the same version of the program, with the same options, whose scenes have as many
   planes, triangles, instances, lights, lights that no distance ends and samples, and are as deep,
   rounded to powers of two, a floor or none, and deep trees or not. */
#ifndef HD_CHOICE_RECORD_H
#define HD_CHOICE_RECORD_H

#include <stdbool.h>

#include "device/options.h"
#include "scene/scene.h"

/* `kind` is that of the entry, `devices` lines that tell what was measured. Errors as
   hd_cache_put. */
HdStatus hd_record_put(const char *kind, const HdScene *scene, const HdRenderOptions *options,
                       const char *devices, const char *text, HdError *error);

/* False where there is none that fits into `capacity`. */
bool hd_record_get(const char *kind, const HdScene *scene, const HdRenderOptions *options,
                   const char *devices, char *text, size_t capacity);

#endif
