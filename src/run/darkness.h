/* SPDX-License-Identifier: MIT */
/* Why a picture is black. */
#ifndef HD_RUN_DARKNESS_H
#define HD_RUN_DARKNESS_H

#include "scene/scene.h"

/* Renders the frame small, in plain C on one thread, and adds a sentence to `notes` for each reason
   why all that is in view is black or nearly so, or one that nothing is in view; else one for each
   solid whose material shows nothing. Adds nothing if the picture is a crop or if the frame cannot
   be rendered. `curve` is the pictures'. */
void hd_note_darkness(const HdScene *scene, HdCurve curve, int frame, HdProblems *notes);

#endif
