/* SPDX-License-Identifier: MIT */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/text.h"

HdStatus hd_fail(HdError *error, HdStatus status, const char *format, ...) {
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    error->status = status;
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    hd_escape_lines(message, error->message, sizeof error->message);
    return status;
}

void hd_error_prefix(HdError *error, const char *name) {
    hd_fail(error, error->status, "%s: %s", name, error->message);
}
