/* SPDX-License-Identifier: MIT */
/* A live view of a scene without its window: what is to be seen, how fine it may be while it moves,
   what keys and mouse do to it, and what is told about it. Windows and terminals feed it and show
   what it has. One thread calls it. */
#ifndef HD_VIEW_VIEWER_H
#define HD_VIEW_VIEWER_H

#include <stdio.h>

#include "run/plan.h"
#include "view/image.h"

enum { HD_VIEW_LINE = 80, HD_VIEW_LINES = 40 };

/* Keys that are no characters, in the order of terminals. */
enum { HD_KEY_UP = 256, HD_KEY_DOWN, HD_KEY_RIGHT, HD_KEY_LEFT };

typedef struct HdViewer HdViewer;

/* Reads the scene, and starts to render its first frame. `out`, which must live on, gets names of
   saved pictures and cameras. */
HdStatus hd_viewer_open(HdViewer **viewer, const HdScenePlan *scene, const HdDevicePlan *devices,
                        FILE *out, HdError *error);

/* A key, a character or one of the above, was pressed, or repeats. `now` is that of
   hd_monotonic_seconds, here and below. */
void hd_viewer_key(HdViewer *viewer, int key, double now);

/* The mouse was dragged by such shares of the picture's width, to turn or to move the view. */
void hd_viewer_drag(HdViewer *viewer, bool moves, double right, double down, double now);

/* To be called after keys, and when the wait below is over: flies on, looks after the files, gives
   wishes to the sides. False once the user wants to end. */
bool hd_viewer_tick(HdViewer *viewer, double now);

/* For so long at most a key may be waited for: little while a side renders or something moves. */
int hd_viewer_wait_ms(HdViewer *viewer);

/* The picture; `version` is set to its number, which changes with the picture. Until the first one
   is there its width is 0. */
const HdViewImage *hd_viewer_picture(HdViewer *viewer, int *version);

/* Two sides are compared. */
bool hd_viewer_is_split(const HdViewer *viewer);

/* The size that the scene asks for. */
void hd_viewer_size(const HdViewer *viewer, int *width, int *height);

/* Moving pictures need no more pixels in a row than this; 0: any number. */
void hd_viewer_limit(HdViewer *viewer, int width);

/* What is to be told now; returns the number of lines, each ASCII where the scene's name is. */
int hd_viewer_lines(HdViewer *viewer, char lines[HD_VIEW_LINES][HD_VIEW_LINE]);

/* Waits for what is under way. NULL is allowed. */
void hd_viewer_close(HdViewer *viewer);

/* Shows the scene until the user closes the window. HD_UNAVAILABLE where there is no display,
   HD_INTERRUPTED after a signal. Names of saved pictures and cameras go to standard output. */
HdStatus hd_view_in_window(const HdScenePlan *scene, const HdDevicePlan *devices, HdError *error);

/* Shows the scene in the terminal that controls this program until the user ends it, and leaves the
   terminal as it was. HD_UNAVAILABLE where there is none, HD_INTERRUPTED after a signal. Names of
   saved pictures and cameras go to standard output; where that is the terminal, at the end. */
HdStatus hd_view_in_terminal(const HdScenePlan *scene, const HdDevicePlan *devices, HdError *error);

#endif
