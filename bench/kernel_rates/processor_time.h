/* SPDX-License-Identifier: MIT */
/* Seconds that processors worked: what others do to the machine is not in them, but for caches and
   clocks. */
#ifndef HD_BENCH_PROCESSOR_TIME_H
#define HD_BENCH_PROCESSOR_TIME_H

/* For this thread, and for all threads of the program. */
double hd_processor_seconds(void);
double hd_processors_seconds(void);

#endif
