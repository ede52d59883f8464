/* SPDX-License-Identifier: MIT */
/* Numbers as text that reads back as the same double, and words that follow a number. */
#ifndef HD_BASE_NUMBER_TEXT_H
#define HD_BASE_NUMBER_TEXT_H

enum { HD_NUMBER_SIZE = 32 };

/* With as few digits, 15 to 17, as it takes to read the same double back; 0's sign is kept. */
void hd_exact_number(double value, char out[HD_NUMBER_SIZE]);

/* The same for messages, which say 1e12 rather than 1000000000000. */
void hd_short_number(double value, char out[HD_NUMBER_SIZE]);

/* What a word for that many things ends in: "s", or nothing for one. */
const char *hd_plural(int count);

#endif
