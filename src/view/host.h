/* SPDX-License-Identifier: MIT */
/* Who shows a view: a window or a terminal. */
#ifndef HD_VIEW_HOST_H
#define HD_VIEW_HOST_H

/* What the viewer asks of who shows it. */
typedef struct HdViewHost {
    void (*wake)(void *context);                   /* on any thread: there is something new */
    void (*say)(void *context, const char *lines); /* for standard output */
    void *context;
} HdViewHost;

#endif
