/* SPDX-License-Identifier: MIT */
/* What keys do in a view: the one table that windows, terminals and help follow. */
#ifndef HD_VIEW_KEYS_H
#define HD_VIEW_KEYS_H

typedef enum HdViewAction {
    HD_VIEW_NOTHING,
    HD_VIEW_PLAY,
    HD_VIEW_TO_FLIGHT,
    HD_VIEW_EARLIER,
    HD_VIEW_LATER,
    HD_VIEW_ORBIT_LEFT,
    HD_VIEW_ORBIT_RIGHT,
    HD_VIEW_ORBIT_UP,
    HD_VIEW_ORBIT_DOWN,
    HD_VIEW_PAN_LEFT,
    HD_VIEW_PAN_RIGHT,
    HD_VIEW_PAN_UP,
    HD_VIEW_PAN_DOWN,
    HD_VIEW_NEARER,
    HD_VIEW_FARTHER,
    HD_VIEW_BACKEND,
    HD_VIEW_DEVICE,
    HD_VIEW_PRECISION,
    HD_VIEW_SHALLOWER,
    HD_VIEW_DEEPER,
    HD_VIEW_FEWER_SAMPLES,
    HD_VIEW_MORE_SAMPLES,
    HD_VIEW_ADAPTIVE,
    HD_VIEW_SPLIT,
    HD_VIEW_OTHER_SIDE,
    HD_VIEW_LESS_GAIN,
    HD_VIEW_MORE_GAIN,
    HD_VIEW_SAVE,
    HD_VIEW_PRINT,
    HD_VIEW_OVERLAY,
    HD_VIEW_HELP,
    HD_VIEW_QUIT
} HdViewAction;

/* Keys that are no characters. */
enum { HD_KEY_UP = 256, HD_KEY_DOWN, HD_KEY_LEFT, HD_KEY_RIGHT };

/* HD_VIEW_NOTHING where the key does nothing. */
HdViewAction hd_view_action_of(int key);

/* What keys do, for people; NULL ends the lines, each below 64 characters. */
extern const char *const hd_view_key_lines[];

#endif
