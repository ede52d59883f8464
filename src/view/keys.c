/* SPDX-License-Identifier: MIT */
#include "view/keys.h"

#include <stddef.h>

static const struct {
    int key;
    HdViewAction action;
} keys[] = {
    {' ', HD_VIEW_PLAY},
    {'0', HD_VIEW_TO_FLIGHT},
    {',', HD_VIEW_EARLIER},
    {'.', HD_VIEW_LATER},
    {HD_KEY_LEFT, HD_VIEW_ORBIT_LEFT},
    {HD_KEY_RIGHT, HD_VIEW_ORBIT_RIGHT},
    {HD_KEY_UP, HD_VIEW_ORBIT_UP},
    {HD_KEY_DOWN, HD_VIEW_ORBIT_DOWN},
    {'a', HD_VIEW_PAN_LEFT},
    {'d', HD_VIEW_PAN_RIGHT},
    {'w', HD_VIEW_PAN_UP},
    {'s', HD_VIEW_PAN_DOWN},
    {'+', HD_VIEW_NEARER},
    {'=', HD_VIEW_NEARER},
    {'-', HD_VIEW_FARTHER},
    {'b', HD_VIEW_BACKEND},
    {'v', HD_VIEW_DEVICE},
    {'f', HD_VIEW_PRECISION},
    {'[', HD_VIEW_SHALLOWER},
    {']', HD_VIEW_DEEPER},
    {'n', HD_VIEW_FEWER_SAMPLES},
    {'m', HD_VIEW_MORE_SAMPLES},
    {'x', HD_VIEW_ADAPTIVE},
    {'2', HD_VIEW_SPLIT},
    {'\t', HD_VIEW_OTHER_SIDE},
    {'g', HD_VIEW_LESS_GAIN},
    {'G', HD_VIEW_MORE_GAIN},
    {'p', HD_VIEW_SAVE},
    {'c', HD_VIEW_PRINT},
    {'o', HD_VIEW_OVERLAY},
    {'h', HD_VIEW_HELP},
    {'?', HD_VIEW_HELP},
    {'q', HD_VIEW_QUIT},
    {27, HD_VIEW_QUIT},
    {3, HD_VIEW_QUIT}, /* Ctrl-C in a terminal that sends it as a character */
};

const char *const hd_view_key_lines[] = {
    "space    play the flight, or stop it",
    ", .      a frame back, a frame on",
    "0        back from a view of your own to the flight",
    "arrows   turn about the target (drag with the left button)",
    "w a s d  move (drag with the right button)",
    "+ -      nearer, farther (the wheel)",
    "b v      next backend, next device",
    "f        float or double",
    "[ ]      less or more depth",
    "n m      fewer or more samples",
    "x        adaptive sampling, or the grid",
    "2        split: two settings and their difference",
    "tab      the other side of the split, for the keys above",
    "g G      less or more of the difference",
    "p        save the picture, once it is finished",
    "c        print the camera as JSON",
    "o h q    figures, this help, quit",
    NULL,
};

HdViewAction hd_view_action_of(int key) {
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i].key == key)
            return keys[i].action;
    return HD_VIEW_NOTHING;
}
