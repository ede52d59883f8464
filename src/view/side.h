/* SPDX-License-Identifier: MIT */
/* Renders one side of a view: a scene with its settings, and a thread that has a device and serves
   requests. Makes quick pictures during motion, and otherwise the whole picture by parts, so that
   it can be dropped at any time. */
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

/* Requested view. */
typedef struct HdViewRequest {
    HdCamera camera;
    bool is_moving;  /* one picture of `detail`; otherwise the scene's own, which settles */
    HdDetail detail; /* one sample at least */
} HdViewRequest;

typedef struct HdViewSide {
    HdScenePlan scene_plan; /* this, the next and the file change only while the thread rests */
    HdDevicePlan devices;
    char device[32]; /* storage for the device's name in the plan */
    HdSceneFile file;
    uint64_t files;        /* hash of the files when last read */
    char file_error[4096]; /* error of the last reading; "": none */
    HdViewImage image;
    pthread_t thread;
    bool has_thread;
    bool is_opened;    /* the device is that of the plan */
    bool is_uploaded;  /* the device has the scene of the file */
    HdDeviceTeam team; /* owned by the thread, as are the next ones */
    bool has_bound;    /* the kernels' tables are those of a scene with an error bound */
    HdFrame frame;     /* has the scene's own size */
    HdFrame part;
    HdWatch watch;         /* unwanted once the current request is outdated */
    pthread_mutex_t mutex; /* guards the members below */
    pthread_cond_t changed;
    HdViewRequest request;
    bool has_request, is_done, is_busy, must_end;
    bool is_saveable; /* `frame` is settled, in `style` */
    HdPictureStyle style;
    HdViewImage made; /* next image */
    bool has_news;    /* `made` is not fetched yet */
    char description[HD_RENDERER_LINE + 64], problem[4096];
} HdViewSide;

/* Reads the scene and starts the thread. On failure nothing is open. */
HdStatus hd_view_side_open(HdViewSide *side, const HdScenePlan *scene, const HdDevicePlan *devices,
                           HdError *error);

/* Reads the scene again if a file has changed, and returns true if it did. After an error in the
   scene the side keeps the previous one. */
bool hd_view_side_follow_files(HdViewSide *side);

/* Changes a setting, a number by the step `by`, and reads the scene again. */
void hd_view_side_change(HdViewSide *side, HdViewSetting setting, int by);

/* Replaces the request; drops the picture of an earlier one. */
void hd_view_side_show(HdViewSide *side, const HdViewRequest *request);

/* Returns whether the request is served, or cannot be. */
bool hd_view_side_is_idle(HdViewSide *side);

/* Makes a newer picture the image, if there is one. */
bool hd_view_side_fetch(HdViewSide *side);

/* Describes the device in a line, or its preparation, and the last error, "": none. */
void hd_view_side_describe(HdViewSide *side, char *device, size_t device_size, char *problem,
                           size_t problem_size);

/* Writes the settled picture in the style of its scene. HD_FAILED if there is none. */
HdStatus hd_view_side_save(HdViewSide *side, const char *path, HdError *error);

/* Waits for its thread. A side that is not open may be closed. */
void hd_view_side_close(HdViewSide *side);

#endif
