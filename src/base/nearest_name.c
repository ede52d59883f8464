/* SPDX-License-Identifier: MIT */
#include "base/nearest_name.h"

#include <limits.h>
#include <string.h>

enum { MAX_LETTERS = 31 };

static int least(int a, int b) {
    return a < b ? a : b;
}

/* The table of distances between the beginnings of both words (R. A. Wagner and M. J. Fischer, The
   string-to-string correction problem, 1974), two swapped neighbours counting as one mistake. */
int hd_edit_distance(const char *a, const char *b) {
    size_t a_length = strlen(a), b_length = strlen(b);
    int table[MAX_LETTERS + 1][MAX_LETTERS + 1];
    if (a_length > MAX_LETTERS || b_length > MAX_LETTERS)
        return INT_MAX;
    for (size_t i = 0; i <= a_length; i++) {
        for (size_t j = 0; j <= b_length; j++) {
            if (i == 0 || j == 0) {
                table[i][j] = (int)(i + j);
                continue;
            }
            int replaced = table[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            table[i][j] = least(replaced, least(table[i - 1][j], table[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                table[i][j] = least(table[i][j], table[i - 2][j - 2] + 1);
        }
    }
    return table[a_length][b_length];
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
