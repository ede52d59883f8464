/* SPDX-License-Identifier: MIT */
#include "error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

HdStatus hd_fail(HdError *error, HdStatus status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    error->status = status;
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    return status;
}

void hd_error_prefix(HdError *error, const char *name) {
    char whole[sizeof error->message];
    int length = snprintf(whole, sizeof whole, "%s: ", name);
    snprintf(whole + length, sizeof whole - (size_t)length, "%s", error->message);
    memcpy(error->message, whole, sizeof whole);
}
