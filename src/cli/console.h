/* SPDX-License-Identifier: MIT */
/* Reports a run on standard error: progress, the details of --verbose, and deviations from what was
   requested. With --quiet only devices that fail are reported. */
#ifndef HD_CLI_CONSOLE_H
#define HD_CLI_CONSOLE_H

#include <pthread.h>

#include "base/watch.h"
#include "choice/devices.h"
#include "output/frame_store.h"
#include "run/plan.h"

typedef enum HdProgressForm {
    HD_PROGRESS_NONE,
    HD_PROGRESS_BAR,   /* a bar on a terminal */
    HD_PROGRESS_LINES, /* a line every few seconds */
    HD_PROGRESS_FRAMES /* only a line for each frame, for programs */
} HdProgressForm;

/* Progress of a run. */
typedef struct HdProgress {
    int done, total;          /* frames */
    double part;              /* traced part of the next ones, in frames */
    double seconds;           /* time since the start */
    double seconds_preparing; /* those before a device traced anything */
} HdProgress;

typedef struct HdConsole {
    bool verbose, quiet;
    HdProgressForm form;
    const HdWatch *watch; /* progress within the frames; NULL: none */
    pthread_t watcher;
    int total; /* frames in the count */
    double start_seconds;
    pthread_mutex_t
        mutex; /* guards standard error while frames are rendered, and the members below */
    pthread_cond_t over; /* signals `is_over`: no more frames are watched */
    bool is_over;
    double tracing_from; /* time when a device was ready; 0: none is */
    double line_seconds; /* time of the last plain line, and the run's progress then */
    double line_frames;
    double frame_seconds; /* time when the last frame was stored, or tracing began */
    int rendered;         /* rendered frames so far */
    uint64_t rays;        /* rays of all frames so far */
    double missing;       /* truncation bound of the worst frame so far, in 1/255 units */
} HdConsole;

/* Initialises the console; it needs no closing. */
void hd_console_open(HdConsole *console, const HdReportPlan *reporting);

/* Reports the run of some frames before it begins, and what its films cannot keep of the picture
   style. `name` is the scene's, for people. */
void hd_console_report_run(const HdConsole *console, const char *name, const HdSceneFile *file,
                           const HdOutputPlan *plan, const HdFrameList *frames);

/* Reports the number of frames that are finished already, and starts to count the others. */
void hd_console_start(HdConsole *console, const HdResume *resume);

/* Shows, before the first frame, what the user waits for, if there is a bar. */
void hd_console_prepare(const HdConsole *console, const char *what);

/* Removes the bar, so that a message can be written. */
void hd_console_clear(const HdConsole *console);

void hd_console_report_devices(const HdConsole *console, const HdDeviceTeam *team);

/* Begins to report the frames in `watch`, until the end below: a terminal shows the progress within
   a long frame, plain lines report it from time to time. Announces the first signal at once if
   standard error is a terminal. */
void hd_console_watch(HdConsole *console, const HdWatch *watch);

/* Hold and release the bar: between the two calls the caller may write in its place, briefly. The
   second reports a stored frame, unless it is NULL; programs get a line for each, "hedron: frame 17
   stored, 3 of 40" (docs/development/many-machines.md). */
void hd_console_hold(HdConsole *console);
void hd_console_release(HdConsole *console, const HdStoredFrame *stored);

/* Report, on any thread, that a renderer has the scene and describes itself as `line`
   (hd_renderer_describe), or that a device is excluded from the rest of the run. */
void hd_console_report_upload(HdConsole *console, const HdRenderer *renderer, const char *line,
                              const HdSceneTables *tables);
void hd_console_report_loss(HdConsole *console, const HdDevice *device, const char *why);

/* Reports the end of the run. `lines` has the description of each of the team's renderers when it
   got the scene, or "" if it did not; its first frame may have changed it. */
void hd_console_end(HdConsole *console, const HdScene *scene, const HdDeviceTeam *team,
                    const char (*lines)[HD_RENDERER_LINE], HdStatus status);

/* Writes "[####....] line", no wider than `columns`. If the line leaves no room for the bar it
   stands alone, and is cut if it is too long itself. */
void hd_progress_bar(const HdProgress *progress, const char *line, int columns, char text[160]);

/* Writes "12/120 frames, 1.41 frames/s, 1:16 left"; with all of them done, "..., 1:25 in all, 2.1 s
   of it to prepare"; with a part, "12/120 frames, 40 % of the next, ...". The rate counts rendering
   alone, without preparing. */
void hd_progress_line(const HdProgress *progress, char text[128]);

#endif
