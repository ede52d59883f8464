/* SPDX-License-Identifier: MIT */
/* The plan of a run or a view, in the parts that its readers need: scene, devices, outputs,
   messages. The command line fills them (cli/options.h); each reader gets only its own part. */
#ifndef HD_RUN_PLAN_H
#define HD_RUN_PLAN_H

#include <stdbool.h>

#include "base/limits.h"
#include "choice/devices.h"
#include "input/scene_file.h"

enum { HD_MAX_CHANGES = 64 };

typedef struct HdPlannedArea {
    int width, height, left, top;
} HdPlannedArea;

/* The scene and its overrides (load_scene.h). A member that is 0, or negative if 0 is a valid
   value, keeps the scene's value. */
typedef struct HdScenePlan {
    const char *path; /* "-": standard input; NULL: the built-in scene */
    bool is_classic;  /* classic input of that variant, on standard input */
    int variant;
    HdSceneChange changes[HD_MAX_CHANGES];
    int change_count;
    bool strict_files; /* refuse meshes and libraries with faults */
    HdPlannedArea size, crop;
    int samples;   /* samples per side */
    int depth;     /* negative: the scene's */
    double cutoff; /* negative: the scene's */
    double max_error;
    int sampling; /* an HdSampling; negative: the scene's */
    HdGeometry geometry;
    int divisions; /* divisions of the sides of triangles */
    HdAccel accel;
    char given[256]; /* these numbers as the user gave them, for messages; "": none */
} HdScenePlan;

typedef struct HdDevicePlan {
    const char *backend, *device; /* names as in HdDeviceSelection */
    HdDeviceKind kind;
    HdRenderOptions render; /* default: the device's lanes, a thread for each core, float, strict */
} HdDevicePlan;

/* Outputs of frames, and statistics. */
typedef struct HdStorePlan {
    const char *names[HD_MAX_OUTPUTS];
    int count;              /* 0: the scene's output */
    unsigned layers;        /* HD_LAYER_BIT each */
    bool again;             /* render finished frames again */
    bool no_sync;           /* stored files need not survive a power failure */
    const char *statistics; /* "-": standard output; NULL: none */
    char given[8192];       /* options that decide pixels, as given, for labels of pictures */
} HdStorePlan;

/* Messages on standard error. */
typedef struct HdReportPlan {
    bool verbose, quiet;
    bool reports_frames; /* a line for each frame, for programs */
    bool wants_lines;    /* progress in plain lines, without a terminal */
} HdReportPlan;

#endif
