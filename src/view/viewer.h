/* SPDX-License-Identifier: MIT */
/* Controls a live view of a scene without its window: what is visible, how fine it is in motion,
   the effect of keys and mouse, and the text about it. Windows and terminals send input and show
   the result. One thread calls it. */
#ifndef HD_VIEW_VIEWER_H
#define HD_VIEW_VIEWER_H

#include <stdio.h>

#include "run/plan.h"
#include "view/image.h"

enum { HD_VIEW_LINE = 80, HD_VIEW_LINES = 40 };

/* Keys that are no characters, in the order of terminals. */
enum { HD_KEY_UP = 256, HD_KEY_DOWN, HD_KEY_RIGHT, HD_KEY_LEFT };

typedef struct HdViewer HdViewer;

/* Reads the scene, and starts to render its first frame. `out`, which must outlive the viewer, gets
   names of saved pictures and cameras. */
HdStatus hd_viewer_open(HdViewer **viewer, const HdScenePlan *scene, const HdDevicePlan *devices,
                        FILE *out, HdError *error);

/* Handles a key, a character or one of the above, that was pressed or repeats. `now` is by
   hd_monotonic_seconds, here and below. */
void hd_viewer_key(HdViewer *viewer, int key, double now);

/* Turns or moves the view by a drag of the mouse, in shares of the picture's width. */
void hd_viewer_drag(HdViewer *viewer, bool moves, double right, double down, double now);

/* Advances the camera path, checks the files and sends requests to the sides. Must be called after
   keys, and after the wait below. Returns false once the user wants to end. */
bool hd_viewer_tick(HdViewer *viewer, double now);

/* Returns the longest wait for a key in ms: short while a side renders or something moves. */
int hd_viewer_wait_ms(HdViewer *viewer);

/* Returns the picture, and in `version` its number, which changes with the picture. Its width is 0
   before the first one. */
const HdViewImage *hd_viewer_picture(HdViewer *viewer, int *version);

/* Returns whether two sides are compared. */
bool hd_viewer_is_split(const HdViewer *viewer);

/* Writes the scene's own size. */
void hd_viewer_size(const HdViewer *viewer, int *width, int *height);

/* Limits the width of moving pictures; 0: no limit. */
void hd_viewer_limit(HdViewer *viewer, int width);

/* Writes the current lines of text and returns their number; ASCII if the scene's name is. */
int hd_viewer_lines(HdViewer *viewer, char lines[HD_VIEW_LINES][HD_VIEW_LINE]);

/* Waits for current work. NULL is allowed. */
void hd_viewer_close(HdViewer *viewer);

/* Shows the scene until the user closes the window. HD_UNAVAILABLE without a display,
   HD_INTERRUPTED after a signal. Names of saved pictures and cameras go to standard output. */
HdStatus hd_view_in_window(const HdScenePlan *scene, const HdDevicePlan *devices, HdError *error);

/* Shows the scene in the controlling terminal until the user ends it, and restores the terminal.
   HD_UNAVAILABLE without a terminal, HD_INTERRUPTED after a signal. Names of saved pictures and
   cameras go to standard output; if that is the terminal, at the end. */
HdStatus hd_view_in_terminal(const HdScenePlan *scene, const HdDevicePlan *devices, HdError *error);

#endif
