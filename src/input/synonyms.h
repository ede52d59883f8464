/* SPDX-License-Identifier: MIT */
/* What other programs call the things of a scene. */
#ifndef HD_INPUT_SYNONYMS_H
#define HD_INPUT_SYNONYMS_H

#include "base/text.h"

/* hd_nearest_offer, but a name that means the word, or is the word but for upper and
   lower case, is nearer than any other. */
void hd_synonym_offer(HdNearest *nearest, const char *name);

#endif
