/* SPDX-License-Identifier: MIT */
/* Jobs alike, for measurements that are remembered. */
#ifndef HD_CHOICE_JOB_KIND_H
#define HD_CHOICE_JOB_KIND_H

#include "device/renderer.h"
#include "scene/scene.h"

enum { HD_JOB_KIND_LENGTH = 512 };

/* Writes lines of text that are the same for jobs whose measurements serve each other: those of the
   same version of the program, with the same options, whose scenes have as many planes, triangles,
   instances, lights, lights that no distance ends and samples, and are as deep, rounded to powers
   of two, a floor or none, and deep trees or not. `capacity` is at least HD_JOB_KIND_LENGTH. */
void hd_job_kind(const HdScene *scene, const HdRenderOptions *options, char *text, int capacity);

#endif
