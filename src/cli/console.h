/* SPDX-License-Identifier: MIT */
/* What a run tells on standard error: progress, what --verbose asks for, and what went otherwise
   than was asked for. --quiet leaves none of it but that devices fail. */
#ifndef HD_CLI_CONSOLE_H
#define HD_CLI_CONSOLE_H

#include <pthread.h>

#include "base/watch.h"
#include "choice/devices.h"
#include "output/frame_store.h"
#include "run/plan.h"

typedef enum HdProgressForm {
    HD_PROGRESS_NONE,
    HD_PROGRESS_BAR,   /* on a terminal */
    HD_PROGRESS_LINES, /* a line every few seconds */
    HD_PROGRESS_FRAMES /* a line for each frame, and nothing else, which programs read */
} HdProgressForm;

/* How far a run is, for its line. */
typedef struct HdProgress {
    int done, total;          /* frames */
    double part;              /* of the next ones, in frames, what is traced */
    double seconds;           /* since the begin */
    double seconds_preparing; /* of them, before devices traced anything */
} HdProgress;

typedef struct HdConsole {
    bool verbose, quiet;
    HdProgressForm form;
    const HdWatch *watch; /* of the frames; NULL: nobody watches them */
    pthread_t watcher;
    int total; /* frames that are counted */
    double start_seconds;
    pthread_mutex_t mutex; /* of standard error while frames are rendered, and of what follows */
    pthread_cond_t over;   /* no more frames are watched: `is_over` */
    bool is_over;
    double tracing_from; /* when a device was ready; 0: none is */
    double line_seconds; /* when the last plain line was written, and where the run was then */
    double line_frames;
    double frame_seconds; /* when the last frame was stored, or tracing began */
    int rendered;         /* frames so far */
    uint64_t rays;        /* of all frames so far */
    double missing;       /* steps of 255 at most, of the worst frame so far */
} HdConsole;

/* There is nothing to close. */
void hd_console_open(HdConsole *console, const HdTelling *telling);

/* Before anything is done, and what films lack of the style. `name` is the scene's, for people. */
void hd_console_report_run(const HdConsole *console, const char *name, const HdScene *scene,
                           const HdOutputPlan *plan, int frame_count);

/* Tells how many frames are finished already, and begins to count those that a device must be
   prepared for. */
void hd_console_start(HdConsole *console, const HdResume *resume);

/* Before the first frame: shows what the user waits for, where there is a bar. */
void hd_console_prepare(const HdConsole *console, const char *what);

/* Takes the bar away, so that a message can be written. */
void hd_console_clear(const HdConsole *console);

void hd_console_report_devices(const HdConsole *console, const HdDeviceTeam *team);

/* Begins to report the frames in `watch`, until the end below: a terminal shows the progress within
   a long frame, plain lines report it from time to time. Announces the first signal at once if
   standard error is a terminal. */
void hd_console_watch(HdConsole *console, const HdWatch *watch);

/* Between the two something else may be written where the bar is, not for long. The second tells
   that a frame is stored, unless that is NULL: programs have a line for each, "hedron: frame 17
   stored, 3 of 40", as docs/development/many-machines.md promises. */
void hd_console_hold(HdConsole *console);
void hd_console_release(HdConsole *console, const HdStoredFrame *stored);

/* On any thread: a renderer got the scene and says `line` of itself (hd_renderer_describe); a
   device is left out of the rest of the run. */
void hd_console_report_upload(HdConsole *console, const HdRenderer *renderer, const char *line,
                              const HdSceneTables *tables);
void hd_console_report_loss(HdConsole *console, const HdDevice *device, const char *why);

/* All frames are rendered, or no more are. `lines` is what each of the team's renderers said when
   it got the scene, "" where it did not: its first frame may have changed that. */
void hd_console_end(HdConsole *console, const HdScene *scene, const HdDeviceTeam *team,
                    const char (*lines)[HD_RENDERER_LINE], HdStatus status);

/* "[####....] line", no wider than `columns`: a line that leaves no room for the bar stands alone,
   and is cut where it is too long itself. */
void hd_progress_bar(const HdProgress *progress, const char *line, int columns, char text[160]);

/* "12/120 frames, 1.41 frames/s, 1:16 left"; with all of them done, "..., 1:25 in all, 2.1 s of it
   to prepare"; with a part, "12/120 frames, 40 % of the next, ...". The rate counts rendering
   alone, without preparing. */
void hd_progress_line(const HdProgress *progress, char text[128]);

#endif
