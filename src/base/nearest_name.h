/* SPDX-License-Identifier: MIT */
/* The name that somebody may have meant. */
#ifndef HD_BASE_NEAREST_NAME_H
#define HD_BASE_NEAREST_NAME_H

/* Keeps the nearest of the names that are offered one after the other. Start with the word alone.
 */
typedef struct HdNearest {
    const char *word;
    const char *name; /* NULL: nothing is near */
    int distance;
} HdNearest;

/* How many letters must be put in, taken away or replaced to make one word of the other. Words of
   more than 31 letters count as far from all others. */
int hd_edit_distance(const char *a, const char *b);

/* A name is near where at most a third of its letters, and at least one, would have to change. Of
   two that are equally near the first stays. */
void hd_nearest_offer(HdNearest *nearest, const char *name);

#endif
