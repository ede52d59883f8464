/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include "steps.h"

#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

/* The largest function that is watched, in bytes. */
enum { WATCHED_BYTES = 1 << 20 };

#if defined(__linux__) && defined(__x86_64__)

static _Noreturn void run_child(void (*work)(void *), void *context) {
    if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0)
        _exit(1);
    raise(SIGSTOP);
    work(context);
    _exit(0);
}

/* Steps the child, which is stopped, to its end. */
static bool follow(HdSteps *steps, uintptr_t start, pid_t child) {
    int status;
    while (ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) == 0 &&
           waitpid(child, &status, 0) == child) {
        if (!WIFSTOPPED(status))
            return WIFEXITED(status) && WEXITSTATUS(status) == 0;
        long place =
            ptrace(PTRACE_PEEKUSER, child, (void *)offsetof(struct user_regs_struct, rip), NULL);
        uintptr_t offset = (uintptr_t)place - start;
        if (offset < (uintptr_t)steps->size)
            steps->times[offset]++;
    }
    return false;
}

bool hd_count_steps(HdSteps *steps, uintptr_t start, void (*work)(void *), void *context) {
    int status;
    steps->size = WATCHED_BYTES;
    steps->times = calloc(WATCHED_BYTES, sizeof *steps->times);
    if (steps->times == NULL)
        return false;
    pid_t child = fork();
    if (child == 0)
        run_child(work, context);
    if (child < 0 || waitpid(child, &status, 0) != child)
        return false;
    return WIFSTOPPED(status) && follow(steps, start, child);
}

#else

bool hd_count_steps(HdSteps *steps, uintptr_t start, void (*work)(void *), void *context) {
    (void)start;
    (void)work;
    (void)context;
    steps->times = NULL;
    steps->size = 0;
    return false;
}

#endif
