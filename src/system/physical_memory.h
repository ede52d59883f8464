/* SPDX-License-Identifier: MIT */
#ifndef HD_SYSTEM_PHYSICAL_MEMORY_H
#define HD_SYSTEM_PHYSICAL_MEMORY_H

/* Bytes of memory that this machine has; where the system does not tell, what even a small one has.
 */
double hd_physical_memory(void);

#endif
