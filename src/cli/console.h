/* SPDX-License-Identifier: MIT */
/* What a run tells on standard error: progress, what --verbose asks for, and what went otherwise
   than was asked for. --quiet leaves none of it but that devices fail. */
#ifndef HD_CLI_CONSOLE_H
#define HD_CLI_CONSOLE_H

#include <pthread.h>

#include "choice/devices.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "output/frame_store.h"

enum { HD_RENDERER_LINE = 512 };

typedef struct HdConsole {
    bool verbose, quiet;
    HdProgress progress;
    pthread_mutex_t mutex; /* of standard error while frames are rendered, and of what follows */
    int rendered;          /* frames so far */
    uint64_t rays;         /* of all frames so far */
    double missing;        /* steps of 255 at most, of the worst frame so far */
} HdConsole;

/* Before anything is done. `name` is the scene's, for people. */
void hd_console_tell_run(const char *name, const HdScene *scene, const HdOutputPlan *plan,
                         int frame_count);

/* Tells how many frames are finished already, and begins to count. `wants_lines`: progress in plain
   lines where standard error is no terminal. */
void hd_console_start(HdConsole *console, const HdOptions *options, bool wants_lines,
                      const HdResume *resume);

/* Before the first frame: what the user waits for. */
void hd_console_prepare(const HdConsole *console, const char *what);

/* Devices were chosen, or could not be: `team` is NULL. */
void hd_console_tell_devices(const HdConsole *console, const HdDeviceTeam *team);

/* On any thread: a renderer got the scene and says `line` of itself (hd_renderer_describe); a
   device is left out of the rest of the run; a frame is stored. */
void hd_console_tell_upload(HdConsole *console, const HdRenderer *renderer, const char *line,
                            const HdSceneTables *tables);
void hd_console_tell_loss(HdConsole *console, const HdDevice *device, const char *why);
void hd_console_tell_frame(HdConsole *console, const HdStoredFrame *stored);

/* Has the first signal answered at once, where somebody may be waiting at a terminal. */
void hd_console_announce_interrupt(const HdConsole *console);

/* All frames are rendered, or no more are. `lines` is what each of the team's renderers said when
   it got the scene, "" where it did not: its first frame may have changed that. */
void hd_console_end(const HdConsole *console, const HdScene *scene, const HdDeviceTeam *team,
                    const char (*lines)[HD_RENDERER_LINE], HdStatus status);

#endif
