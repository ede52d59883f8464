/* SPDX-License-Identifier: MIT */
/* Several devices trace the frames of a sequence together. */
#ifndef HD_RENDER_TEAM_H
#define HD_RENDER_TEAM_H

#include "render/tracer.h"
#include "render/tracer_pace.h"

typedef struct HdTracerTeam {
    const HdTracerJob *job;
    HdRenderer *const *renderers;
    int count; /* 2 to HD_MOST_TRACERS */
    /* Puts the scene on a renderer; called on threads of the team, for several at once. `seconds`
       may say about how long a frame takes there; 0: not known. */
    HdStatus (*prepare)(void *context, int number, double *seconds, HdError *error);
    /* A device failed, and others go on. Called for one at a time. */
    void (*dropped)(void *context, int number, const HdError *error);
    void *context;
} HdTracerTeam;

/* Traces frames until the store has none left, each device on a thread of its own. What a device
   had under way when it failed is traced by others; once all have failed, the error is the last
   one's. HD_INTERRUPTED after a signal. */
HdStatus hd_tracer_team_run(const HdTracerTeam *team, HdError *error);

#endif
