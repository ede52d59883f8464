/* SPDX-License-Identifier: MIT */
/* What the machine has: time, processors, memory, displays; and what it refused. */
#ifndef HD_SYSTEM_MACHINE_H
#define HD_SYSTEM_MACHINE_H

#include <stdbool.h>
#include <stddef.h>

/* Seconds on a clock that only goes forward. */
double hd_monotonic_seconds(void);

/* The number of processors that this process may run on, at least 1. */
int hd_processor_count(void);

/* Bytes of memory that there are; where the system does not tell, what even a small machine has. */
double hd_physical_memory(void);

/* How many descriptors this process may still open, if no other thread opens any. */
int hd_free_descriptors(void);

/* Memory for tables and pictures, for free() to free: aligned to 64 bytes and not zeroed. Where
   there is much of it the system is asked for large pages, because the first touch of each small
   one takes longer than filling it. NULL where there is none left. */
void *hd_large_allocate(size_t bytes);

/* Where Linux tells of graphics cards and what is plugged into them. */
#define HD_DISPLAY_FOLDER "/sys/class/drm"

/* True where this session has a desktop (DISPLAY, WAYLAND_DISPLAY), or where a display is plugged
   in, as a file "status" of one of the connectors below `folder` tells. Which GPU draws it is not
   asked. */
bool hd_display_may_be_there(const char *folder);

/* ---- what the library could not have and did without: sentences for people, told by who may
   print ---- */

enum { HD_FALLBACK_LENGTH = 512 };

/* Keeps a sentence; one that is there already is not kept twice, nor is one that finds no room. Any
   thread may call it. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void hd_fallback_note(const char *format, ...);

/* Takes out the oldest sentence; false where there is none. */
bool hd_fallback_take(char text[HD_FALLBACK_LENGTH]);

#endif
