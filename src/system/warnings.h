/* SPDX-License-Identifier: MIT */
/* What the library could not have and did without: sentences for people, told by who may print. */
#ifndef HD_SYSTEM_WARNINGS_H
#define HD_SYSTEM_WARNINGS_H

#include <stdbool.h>

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
