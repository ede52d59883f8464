/* SPDX-License-Identifier: MIT */
#include "truths.h"
void check_truths(HdRenderer *renderer, HdPrecision precision, const char *label, int *checked, int *failed) {
  (void)renderer; (void)precision; (void)label; (void)checked; (void)failed; }
