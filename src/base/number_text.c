/* SPDX-License-Identifier: MIT */
#include "base/number_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void hd_exact_number(double value, char out[HD_NUMBER_SIZE]) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, HD_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            break;
    }
    if (value == 0.0 && signbit(value)) /* as an integer, -0 is 0 */
        snprintf(out, HD_NUMBER_SIZE, "-0.0");
}

void hd_short_number(double value, char out[HD_NUMBER_SIZE]) {
    snprintf(out, HD_NUMBER_SIZE, "%g", value);
    if (strtod(out, NULL) != value)
        hd_exact_number(value, out);
    char *exponent = strchr(out, 'e');
    if (exponent == NULL)
        return;
    char *digits = exponent + 1;
    if (*digits == '-')
        exponent++;
    while (*digits == '+' || *digits == '-' || *digits == '0')
        digits++;
    memmove(exponent + 1, digits, strlen(digits) + 1);
}

const char *hd_plural(int count) {
    return count == 1 ? "" : "s";
}
