/* SPDX-License-Identifier: MIT */
/* The program's signals; SIGINT, SIGTERM and SIGHUP become a question that the work asks between
 * frames. */
#ifndef HD_INTERRUPT_H
#define HD_INTERRUPT_H

/* Catches the three once each, unless they are ignored; a second one ends the program at once. A
   file that grows past its limit becomes an error of write instead of a death, and children can be
   waited for whatever the parent process had set. */
void hd_interrupt_install(void);

/* The number of the signal that came, or 0. */
int hd_interrupt_signal(void);

#endif
