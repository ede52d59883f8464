/* SPDX-License-Identifier: MIT */
/* The two hot loops of the kernels and the machine's arithmetic peak, as functions of one thread,
   compiled for each instruction set and lane count as the CPU kernels are. */
#ifndef HD_BENCH_LOOPS_H
#define HD_BENCH_LOOPS_H

#include <stdint.h>

#include "tables/table.h"

/* Packets, or lit points of packets, made by the same build. The caller frees `items`. */
typedef struct HdWork {
    void *items; /* owned; layout by the build's lanes */
    int count;
} HdWork;

typedef struct HdLoops {
    const char *instruction_set;
    int lanes;
    const char *search_symbol, *light_symbol; /* symbols of the functions below, for a
                                                 disassembler */

    /* Returns at most `most` of the view's packets with a hit, spread evenly; count 0 if there are
       none or memory runs out. */
    HdWork (*make_rays)(const HdTable *scene, const HdTable *frame, int most);
    /* Likewise the surface points that primary rays hit and that lights can reach. */
    HdWork (*make_points)(const HdTable *scene, const HdTable *frame, int most);
    /* Returns the packets' live lanes. */
    uint64_t (*live_rays)(const HdWork *rays);
    /* Runs one closest-hit search for each packet. The result depends on every hit. */
    uint64_t (*search)(const HdTable *scene, const HdTable *frame, const HdWork *rays);
    /* Computes direct light at each point from all lights; returns the shadow tests, as frames
       count them. `sum` depends on every result. */
    uint64_t (*light)(const HdTable *scene, const HdTable *frame, const HdWork *points,
                      double *sum);
    /* Runs `rounds` rounds of HD_PEAK_CHAINS independent chains, an instruction each: fused
       multiply-adds, or alternating multiplications and additions. */
    double (*multiply_adds)(long rounds);
    double (*multiplications_and_additions)(long rounds);
} HdLoops;

enum { HD_PEAK_CHAINS = 12 };

#endif
