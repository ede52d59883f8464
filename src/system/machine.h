/* SPDX-License-Identifier: MIT */
/* The machine's resources: time, processors, memory, displays; and notes about refused ones. */
#ifndef HD_SYSTEM_MACHINE_H
#define HD_SYSTEM_MACHINE_H

#include <stdbool.h>
#include <stddef.h>

/* Returns seconds on a monotonic clock. */
double hd_monotonic_seconds(void);

/* Returns the number of processors that this process may use, at least 1. */
int hd_processor_count(void);

/* Returns the bytes of physical memory; if the system does not report them, those of a small
   machine. */
double hd_physical_memory(void);

/* Returns how many descriptors this process may still open if no other thread opens any. */
int hd_free_descriptors(void);

/* Allocates memory for tables and pictures, aligned to 64 bytes and not zeroed; release it with
   free(). Requests large pages for large sizes, because touching a new small page takes longer than
   filling it. Returns NULL if out of memory. */
void *hd_large_allocate(size_t bytes);

/* folder where Linux lists graphics cards and their connectors */
#define HD_DISPLAY_FOLDER "/sys/class/drm"

/* Returns whether this session has a desktop (DISPLAY, WAYLAND_DISPLAY), or a "status" file of a
   connector below `folder` reports a display. Does not find out which GPU draws it. */
bool hd_display_may_be_there(const char *folder);

/* ---- notes: sentences about resources that the library works without, for the caller to print
   ---- */

enum { HD_FALLBACK_LENGTH = 512 };

/* Adds a note. Drops duplicates, and notes beyond the capacity. Any thread may call it. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void hd_fallback_note(const char *format, ...);

/* Removes the oldest note and copies it; returns false if there is none. */
bool hd_fallback_take(char text[HD_FALLBACK_LENGTH]);

#endif
