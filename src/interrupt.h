/* SPDX-License-Identifier: MIT */
/* SIGINT and SIGTERM as a question that the work asks between frames. */
#ifndef HD_INTERRUPT_H
#define HD_INTERRUPT_H

/* Catches each of the two signals once; a second one ends the program at once. */
void hd_interrupt_install(void);

/* The number of the signal that came, or 0. */
int hd_interrupt_signal(void);

#endif
