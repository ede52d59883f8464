/* SPDX-License-Identifier: MIT */
/* From what the user asked for to the devices that can do it, to the best of these, and to those
   that render together, which may be one. */
#ifndef HD_CHOICE_DEVICES_H
#define HD_CHOICE_DEVICES_H

#include "choice/measure.h"
#include "render/backends.h"

typedef enum HdDeviceKind {
    HD_WANT_ANY,   /* a GPU or plain C, whichever is faster */
    HD_PREFER_GPU, /* a GPU, else any backend's CPU, which is worth a note */
    HD_ONLY_CPU    /* only a CPU will do: plain C, unless a backend is named */
} HdDeviceKind;

typedef struct HdDeviceSelection {
    const char *backend; /* NULL: any */
    const char *device; /* number within the backend, BACKEND:NUMBER or part of a name; NULL: any */
    HdDeviceKind kind;
    bool is_for_one;                /* several devices will not do */
    const HdRenderOptions *options; /* what it must be able to do */
    const HdJob *job;               /* what it is to be the fastest at */
} HdDeviceSelection;

enum { HD_MAX_CANDIDATES = 32 };

typedef struct HdCandidates {
    HdDeviceSelection selection;          /* for one device; BACKEND:NUMBER taken apart */
    HdTeamDevice list[HD_MAX_CANDIDATES]; /* the best first, as far as is known without measuring */
    int count;
    bool is_free;         /* nobody named one: another may take the place of one that fails */
    int compared;         /* so many, from the first on, are worth measuring; less than 2: none */
    double frame_seconds; /* of plain C, estimated, where several are compared */
    int best;             /* -1: none is known to be */
    char reasons[4096];   /* why backends and devices were passed over */
    char why[1024];       /* why the one that is taken; "": it is the first */
    char note[2048];      /* what failed; "": nothing did */
    char passed[2048];    /* GPUs that are passed over though nobody asked for that, in a sentence,
                             with what would help; "": there are none */
} HdCandidates;

/* A job that plain C does in less is not worth waking another device for, */
#define HD_AUTO_SMALL_SECONDS 0.25
/* nor compiling kernels and measuring for. */
#define HD_AUTO_MEASURE_SECONDS 2.0

/* Finds the devices that can do what the wish's options ask, none of which is open: GPUs come
   before CPUs, then backends in the order of hd_backends, then the device with the most compute
   units times clock. CPUs of other backends than plain C are among them only where a GPU is
   preferred, or where their backend or a device is named. Where any will do, a job that plain C
   does in less than HD_AUTO_SMALL_SECONDS is its own: no driver is asked then. HD_UNAVAILABLE with
   every reason where there are none; HD_BAD_INPUT where the device's backend is another than the
   wish's. */
HdStatus hd_candidates_find(HdCandidates *candidates, const HdDeviceSelection *selection,
                            HdError *error);

/* Opens one of the candidates, of which there are some. Which one: where the job is worth it, the
   fastest of those compared, which is measured once for a machine and jobs alike. Otherwise plain
   C, if it is among those compared, else the first. A device that turns out to be unavailable, such
   as one that computes wrongly, is passed over where nobody named it: kernels that are compiled at
   run time are then compiled for the scene. The candidates' `why` and `note` tell about it. The
   open one is then `*opened`. */
HdStatus hd_candidates_open(HdCandidates *candidates, HdTeamDevice *opened, HdError *error);

/* The devices that the names mean, whatever they can do: `backend` NULL is any, `device` as above,
   or NULL or "all" for all. `devices` has room for HD_BACKEND_COUNT * HD_MAX_DEVICES.
   HD_UNAVAILABLE with every reason where there are none. */
HdStatus hd_devices_named(const char *backend, const char *device, HdDevice *devices, int *count,
                          HdError *error);

typedef struct HdDeviceTeam {
    HdTeamDevice list[HD_MAX_WORKERS]; /* open */
    int count;
    char note[4096]; /* worth telling unasked; empty: nothing is */
    char why[8192];  /* why these devices, and why others were passed over */
} HdDeviceTeam;

/* Opens a device that can do what the wish's options ask: the best candidate, or,
   where nobody named one, the fastest (hd_candidates_open): among GPUs where one is preferred, else
   among GPUs and plain C. Where a GPU was preferred, no backend was named and there is none, a note
   says so in a sentence.

   Or opens several: a list as in "cuda:0,cuda:1,c:0", each part of which names one as a single
   device is named, or "all". All are those of every backend, or of the one that is named, that can
   do what the options ask; what cannot be opened is left out, and so are GPUs by OpenCL that the
   team has by CUDA, and CPUs of other backends than plain C unless their backend is named; the note
   tells of what is left out because it fails. Plain C beside GPUs leaves a core to each of them. A
   device of a list that cannot be opened is an error, and one that is named twice is HD_BAD_INPUT,
   as are several where the wish is for one. On failure nothing is open. */
HdStatus hd_open_devices(HdDeviceTeam *team, const HdDeviceSelection *selection, HdError *error);

void hd_close_devices(HdDeviceTeam *team);

#endif
