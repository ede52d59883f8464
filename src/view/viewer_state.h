/* SPDX-License-Identifier: MIT */
/* What a viewer remembers, for its own files. */
#ifndef HD_VIEW_VIEWER_STATE_H
#define HD_VIEW_VIEWER_STATE_H

#include "view/host.h"
#include "view/pose.h"
#include "view/side.h"
#include "view/split.h"

struct HdViewer {
    HdViewHost host;
    HdViewSide sides[2];
    int side_count, active;
    HdPose pose;
    bool is_free; /* the view is `pose`, not the flight's */
    int frame;
    bool is_playing;
    double played_from;  /* when frame 0 would have been */
    int change;          /* number of what is to be seen */
    int asked, settling; /* the changes for which moving and whole pictures were wished */
    double moved;        /* when it changed last */
    double watched;
    HdPace pace;
    int most_width;         /* of moving pictures; 0: the scene's */
    double last_picture;    /* when a moving one came */
    double picture_seconds; /* between two, smoothed; 0: not known */
    HdViewImage composed;
    HdSplitFigures figures;
    int version; /* of what is shown */
    int gain;
    bool saves; /* once the picture is whole */
    bool hides_figures, shows_help, has_ended;
    char note[512]; /* what the last key came to */
};

#endif
