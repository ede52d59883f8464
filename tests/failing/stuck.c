/* SPDX-License-Identifier: MIT */
/* Preloaded, a file system that hangs: to open a file whose name ends in STUCK_OPEN waits for ever,
   as for a server that is gone, and no signal but one that kills ends it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

typedef int Open(const char *path, int flags, ...);

static bool is_stuck(const char *path) {
    const char *wanted = getenv("STUCK_OPEN");
    return wanted != NULL && strstr(path, wanted) != NULL;
}

/* The system lets the parent of a vfork() handle no signal before the child has ended. */
static void hang(void) {
    pid_t parent = getpid();
    if (vfork() == 0) { /* NOLINT(clang-analyzer-security.insecureAPI.vfork) */
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        while (getppid() == parent)
            usleep(100000);
        _exit(0);
    }
}

int open(const char *path, int flags, ...) {
    void *found = dlsym(RTLD_NEXT, "open");
    Open *real;
    va_list arguments;
    va_start(arguments, flags);
    int mode = (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
    va_end(arguments);
    memcpy(&real, &found, sizeof real);
    const char *mark = getenv("STUCK_MARK");
    if (mark != NULL && is_stuck(path)) {
        close(real(mark, O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
        hang();
    }
    return real(path, flags, mode);
}
