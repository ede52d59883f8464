/* SPDX-License-Identifier: MIT */
/* What the processor is called, and which of its cores are big. */
#ifndef HD_SYSTEM_PROCESSOR_H
#define HD_SYSTEM_PROCESSOR_H

#include <stddef.h>

/* Writes the processor's name as Linux reports it in the folders proc and sys below `root`, ""
   for the system's own: the model's name, or on ARM the kinds of cores and the machine's model.
   Writes "processor" if it reports none. */
void hd_processor_name(const char *root, char *name, size_t capacity);

/* Cores that this process may use. A big one has over half the capacity of the strongest; all are
   big where Linux reports no capacities. */
typedef struct HdCores {
    int big, little;
} HdCores;

/* Counts them; `root` is as above. */
HdCores hd_processor_cores(const char *root);

#endif
