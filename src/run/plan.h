/* SPDX-License-Identifier: MIT */
/* What a run or a view is to do, in the parts that its readers need: what is rendered, on what,
   where it goes, how much is told. The command line fills them (cli/options.h); each reader gets
   its own part and nothing else. */
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

/* The scene, and what is laid over it (load_scene.h). What is 0, or negative where 0 is a value,
   stays as the scene has it. */
typedef struct HdScenePlan {
    const char *path; /* "-": standard input; NULL: the built-in scene */
    bool is_classic;  /* it is a classic input, on standard input, of that variant */
    int variant;
    HdSceneChange changes[HD_MAX_CHANGES];
    int change_count;
    HdPlannedArea size, crop;
    int samples;   /* per side */
    int depth;     /* negative: the scene's */
    double cutoff; /* negative: the scene's */
    double max_error;
    int sampling; /* an HdSampling; negative: the scene's */
    HdGeometry geometry;
    int divisions; /* of the sides of triangles */
    HdAccel accel;
    char given[256]; /* the numbers among these, as they were given: what messages about them begin
                        with; "": none were */
} HdScenePlan;

typedef struct HdDevicePlan {
    const char *backend, *device; /* as in HdDeviceSelection */
    HdDeviceKind kind;
    HdRenderOptions render; /* the device's lanes, a thread for each core, float, strict */
} HdDevicePlan;

/* Where frames go, and what is told of them in files. */
typedef struct HdStorePlan {
    const char *names[HD_MAX_OUTPUTS];
    int count;              /* 0: what the scene asks for */
    unsigned layers;        /* HD_LAYER_BIT each */
    bool again;             /* frames that are finished are rendered again */
    bool no_sync;           /* what is stored need not outlive a power cut */
    const char *statistics; /* "-": standard output; NULL: none */
    char given[8192];       /* all that decides pixels, as it was given, for pictures to tell */
} HdStorePlan;

/* What standard error has. */
typedef struct HdTelling {
    bool verbose, quiet;
    bool tells_frames; /* a line for each frame, which programs read */
    bool wants_lines;  /* progress in plain lines where there is no terminal */
} HdTelling;

#endif
