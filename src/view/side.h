/* SPDX-License-Identifier: MIT */
/* One side of a view: a scene with its settings, and a thread that has a device and renders what is
   wished for: quick pictures while something moves, and, while nothing does, the whole picture, by
   parts, so that it can be given up at any time. */
#ifndef HD_VIEW_SIDE_H
#define HD_VIEW_SIDE_H

#include <pthread.h>

#include "choice/devices.h"
#include "image/picture.h"
#include "run/plan.h"
#include "scene/camera.h"
#include "view/image.h"

typedef enum HdViewSetting {
    HD_VIEW_BACKEND,
    HD_VIEW_DEVICE,
    HD_VIEW_PRECISION,
    HD_VIEW_DEPTH,
    HD_VIEW_SAMPLES,
    HD_VIEW_SAMPLING
} HdViewSetting;

/* What is to be seen. */
typedef struct HdViewRequest {
    HdCamera camera;
    bool is_moving;  /* one picture of `detail`; otherwise the scene's own, which settles */
    HdDetail detail; /* with one sample at least */
} HdViewRequest;

typedef struct HdViewSide {
    HdScenePlan scene_plan; /* this, the next and the file change while the thread rests */
    HdDevicePlan devices;
    char device[32]; /* that the latter may name */
    HdSceneFile file;
    uint64_t files;     /* as they were when read last */
    char mistake[4096]; /* why the last reading failed; "": it did not */
    HdViewImage image;
    pthread_t thread;
    bool has_thread;
    bool is_opened;    /* the device is that of the plan */
    bool is_uploaded;  /* the device has the scene of the file */
    HdDeviceTeam team; /* the thread's own, and so are the next ones */
    bool has_bound;    /* the kernels' tables are those of a surveyed scene */
    HdFrame frame;     /* of the scene's own size */
    HdFrame part;
    HdWatch watch;         /* unwanted once the wish under way is an earlier one */
    pthread_mutex_t mutex; /* of what follows */
    pthread_cond_t changed;
    HdViewRequest request;
    bool has_request, is_done, is_busy, must_end;
    bool is_saveable; /* `frame` is settled, in `style` */
    HdPictureStyle style;
    HdViewImage made; /* becomes the image */
    bool has_news;    /* it has not yet */
    char told[HD_RENDERER_LINE + 64], problem[4096];
} HdViewSide;

/* Reads the scene and starts the thread. On failure nothing is open. */
HdStatus hd_view_side_open(HdViewSide *side, const HdScenePlan *scene, const HdDevicePlan *devices,
                           HdError *error);

/* Reads the scene again if a file has changed; true where it did. With a mistake in it the side
   keeps what it had. */
bool hd_view_side_follow_files(HdViewSide *side);

/* Changes a setting, a number `by` so much, and reads the scene again. */
void hd_view_side_change(HdViewSide *side, HdViewSetting setting, int by);

/* Replaces the wish; a picture that is under way for an earlier one is given up. */
void hd_view_side_show(HdViewSide *side, const HdViewRequest *request);

/* The wish is fulfilled, or cannot be. */
bool hd_view_side_is_idle(HdViewSide *side);

/* Takes a newer picture as the image, if there is one. */
bool hd_view_side_fetch(HdViewSide *side);

/* The device in a line, or what it is doing before it renders; what went wrong last, "": nothing.
 */
void hd_view_side_describe(HdViewSide *side, char *device, size_t device_size, char *problem,
                           size_t problem_size);

/* Writes the settled picture in the style of its scene. HD_FAILED where there is none. */
HdStatus hd_view_side_save(HdViewSide *side, const char *path, HdError *error);

/* Waits for its thread. A side that is not open may be closed. */
void hd_view_side_close(HdViewSide *side);

#endif
