/* SPDX-License-Identifier: MIT */
/* The two hot loops of the kernels and the machine's arithmetic peak, each as a function that runs
   on one thread; compiled once for each instruction set and lane count, as the CPU kernels are. */
#ifndef HD_BENCH_LOOPS_H
#define HD_BENCH_LOOPS_H

#include <stdint.h>

#include "tables/table.h"

/* Packets, or lit points of packets, ready to be worked on; made by the same build; free `items`.
 */
typedef struct HdWork {
    void *items; /* owned; laid out as the build's lanes */
    int count;
} HdWork;

typedef struct HdLoops {
    const char *instruction_set;
    int lanes;
    const char *search_symbol, *light_symbol; /* of the functions below, for a disassembler */

    /* At most `most` of the view's packets of which some lane meets a solid, taken evenly; count 0
       where there are none or no memory. */
    HdWork (*make_rays)(const HdTable *scene, const HdTable *frame, int most);
    /* Likewise the surface points that primary rays meet and that lights can reach. */
    HdWork (*make_points)(const HdTable *scene, const HdTable *frame, int most);
    /* Live lanes of the packets. */
    uint64_t (*live_rays)(const HdWork *rays);
    /* One closest-hit search for each packet. The result depends on every hit. */
    uint64_t (*search)(const HdTable *scene, const HdTable *frame, const HdWork *rays);
    /* Direct light at each point from all lights; returns the shadow tests, as frames count them,
       and writes what depends on every result to `sum`. */
    uint64_t (*light)(const HdTable *scene, const HdTable *frame, const HdWork *points,
                      double *sum);
    /* `rounds` rounds of HD_PEAK_CHAINS independent chains, an instruction each: fused
       multiply-adds, or multiplications and additions in turns. */
    double (*multiply_adds)(long rounds);
    double (*multiplications_and_additions)(long rounds);
} HdLoops;

enum { HD_PEAK_CHAINS = 12 };

#endif
