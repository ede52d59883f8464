/* SPDX-License-Identifier: MIT */
/* A thread that has a device and renders what is wished for: quick pictures while something moves,
   and, while nothing does, the whole picture, by parts, so that it can be given up at any time. */
#ifndef HD_VIEW_WORKER_H
#define HD_VIEW_WORKER_H

#include "run/plan.h"
#include "scene/camera.h"
#include "view/image.h"

/* What is to be seen. */
typedef struct HdViewWish {
    const HdDevicePlan *plan; /* this and the file live until the worker rests */
    const HdSceneFile *file;
    int device_change, scene_change; /* another number: plan or scene are other than before */
    HdCamera camera;
    bool is_moving;  /* one picture of `detail`; otherwise the scene's own, which settles */
    HdDetail detail; /* with one sample at least */
} HdViewWish;

typedef struct HdViewWorker HdViewWorker;

/* `wake` is called on the worker's thread whenever there is something new. */
HdStatus hd_view_worker_start(HdViewWorker **worker, void (*wake)(void *context), void *context,
                              HdError *error);

/* Replaces the wish; a picture that is under way for an earlier one is given up. */
void hd_view_worker_show(HdViewWorker *worker, const HdViewWish *wish);

/* Drops the wish, and waits until nothing is read of its plan and scene any more. */
void hd_view_worker_rest(HdViewWorker *worker);

/* The wish is fulfilled, or cannot be. */
bool hd_view_worker_is_idle(HdViewWorker *worker);

/* Copies the picture into `image` if it is newer than `*version`, which it sets. */
bool hd_view_worker_image(HdViewWorker *worker, HdViewImage *image, int *version);

/* The device in a line, or what it is doing before it renders; what went wrong last, "": nothing.
 */
void hd_view_worker_describe(HdViewWorker *worker, char *device, size_t device_size, char *problem,
                             size_t problem_size);

/* Writes the settled picture in the style of its scene. HD_FAILED where there is none. */
HdStatus hd_view_worker_save(HdViewWorker *worker, const char *path, HdError *error);

/* Waits for its thread. NULL is allowed. */
void hd_view_worker_end(HdViewWorker *worker);

#endif
