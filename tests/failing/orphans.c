/* SPDX-License-Identifier: MIT */
/* Preloaded, a system that cannot end programs with the one that started them. */
#include <errno.h>
#include <sys/prctl.h>

int prctl(int option, ...) {
    (void)option;
    errno = EINVAL;
    return -1;
}
