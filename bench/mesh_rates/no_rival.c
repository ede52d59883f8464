/* SPDX-License-Identifier: MIT */
/* Where Embree is not installed. */
#include <stddef.h>

#include "rival.h"

HdRival *hd_rival_create(const HdObject *object, int threads, bool is_robust) {
    (void)is_robust;
    (void)object;
    (void)threads;
    return NULL;
}

void hd_rival_free(HdRival *rival) {
    (void)rival;
}

double hd_rival_build_seconds(const HdRival *rival) {
    (void)rival;
    return 0.0;
}

const HdRivalWay hd_rival_ways[] = {{NULL, NULL}};
