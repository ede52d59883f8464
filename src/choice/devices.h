/* SPDX-License-Identifier: MIT */
/* Selects devices: finds those that match the user's selection, picks the best, and opens the one
   or several that render together. */
#ifndef HD_CHOICE_DEVICES_H
#define HD_CHOICE_DEVICES_H

#include "choice/measure.h"
#include "render/backends.h"

typedef enum HdDeviceKind {
    HD_WANT_ANY,   /* a GPU or plain C, whichever is faster */
    HD_PREFER_GPU, /* a GPU, else any backend's CPU, with a note */
    HD_ONLY_CPU    /* a CPU only: plain C, unless a backend is named */
} HdDeviceKind;

typedef struct HdDeviceSelection {
    const char *backend; /* NULL: any */
    const char *device; /* number within the backend, BACKEND:NUMBER or part of a name; NULL: any */
    HdDeviceKind kind;
    bool is_for_one;                /* reject several devices */
    const HdRenderOptions *options; /* options the device must support */
    const HdJob *job;               /* job to optimise for */
} HdDeviceSelection;

enum { HD_MAX_CANDIDATES = 32 };

typedef struct HdCandidates {
    HdDeviceSelection selection;          /* selection of one device; BACKEND:NUMBER split */
    HdTeamDevice list[HD_MAX_CANDIDATES]; /* best first, as estimated without measuring */
    int count;
    bool is_free;           /* none was named: another may replace one that fails */
    int compared;           /* number of candidates to measure, from the first on; below 2: none */
    double frame_seconds;   /* estimate for plain C, if several are compared */
    int best;               /* -1: none known */
    char reasons[4096];     /* why backends and devices were rejected */
    char why[1024];         /* why that one is best; "": it is the first */
    char note[2048];        /* failures; "": none */
    char unused_gpus[2048]; /* sentence on GPUs unused for other reasons than the selection; "":
                               none */
} HdCandidates;

/* Job time of plain C, in s, below which no other device is started, */
#define HD_AUTO_SMALL_SECONDS 0.25
/* and below which no kernels are compiled and measured. */
#define HD_AUTO_MEASURE_SECONDS 2.0

/* Finds the devices that support the selection's options, and opens none. GPUs come before CPUs,
   then backends in the order of hd_backends, then the greatest product of compute units and clock.
   CPUs of backends other than plain C count only if a GPU is preferred, or their backend or a
   device is named. If any device will do, plain C gets a job that it does in less than
   HD_AUTO_SMALL_SECONDS; no driver then starts. Fails with HD_UNAVAILABLE and all reasons if there
   is none, with HD_BAD_INPUT if the device's backend contradicts the selection's. */
HdStatus hd_candidates_find(HdCandidates *candidates, const HdDeviceSelection *selection,
                            HdError *error);

/* Opens one of the candidates, at least one of which must exist. For a long enough job that is the
   fastest of those compared, measured once per machine and kind of job; otherwise plain C if
   compared, else the first. If the user named none, skips an unavailable device, such as one that
   computes wrongly; kernels compiled at run time are therefore compiled for the scene. Explains the
   result in `why` and `note`. */
HdStatus hd_candidates_open(HdCandidates *candidates, HdTeamDevice *opened, HdError *error);

/* Finds the named devices, whatever they support: `backend` NULL is any, `device` as above, or NULL
   or "all" for all. `devices` has space for HD_BACKEND_COUNT * HD_MAX_DEVICES. Fails with
   HD_UNAVAILABLE and all reasons if there is none. */
HdStatus hd_devices_named(const char *backend, const char *device, HdDevice *devices, int *count,
                          HdError *error);

typedef struct HdDeviceTeam {
    HdTeamDevice list[HD_MAX_WORKERS]; /* open */
    int count;
    char note[4096]; /* message to show unasked; empty: none */
    char why[8192];  /* why these devices, and why others were rejected */
} HdDeviceTeam;

/* Opens one device that supports the selection's options: the best candidate, or, if none is named,
   the fastest (hd_candidates_open) among GPUs if preferred, else among GPUs and plain C. If a GPU
   is preferred, no backend is named and there is no GPU, a note says so.

   Or opens several: a list as in "cuda:0,cuda:1,c:0", each entry as for one device, or "all": all
   of the named or of every backend that support the options. "all" omits devices that cannot be
   opened, with a note if they failed, and GPUs by OpenCL that the team has by CUDA. It also omits
   CPUs of backends other than plain C unless their backend is named. Plain C leaves a core to each
   GPU. Fails if a device of a list cannot be opened, and with HD_BAD_INPUT if one is named twice or
   several are not allowed. On failure nothing is open. */
HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceSelection *selection, HdError *error);

void hd_close_devices(HdDeviceTeam *team);

#endif
