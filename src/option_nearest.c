/* SPDX-License-Identifier: MIT */
#include "option_nearest.h"

#include <limits.h>
#include <string.h>

enum { MAX_LETTERS = 31 };

static int least(int a, int b) {
    return a < b ? a : b;
}

/* Row by row of the table of distances between the beginnings of both words: R. A. Wagner and M. J.
   Fischer, The string-to-string correction problem, 1974. */
int hd_edit_distance(const char *a, const char *b) {
    size_t a_length = strlen(a), b_length = strlen(b);
    int row[MAX_LETTERS + 1];
    if (a_length > MAX_LETTERS || b_length > MAX_LETTERS)
        return INT_MAX;
    for (size_t j = 0; j <= b_length; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= a_length; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= b_length; j++) {
            int replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}

void hd_nearest_offer(HdNearest *nearest, const char *name) {
    int distance = hd_edit_distance(nearest->word, name);
    int limit = (int)strlen(name) / 3;
    if (distance > (limit > 1 ? limit : 1))
        return;
    if (nearest->name == NULL || distance < nearest->distance) {
        nearest->name = name;
        nearest->distance = distance;
    }
}
