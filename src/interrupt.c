/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "interrupt.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "leftovers.h"

enum { SAME_WISH_MS = 500 };

/* Signals may come in any thread, and two of them in two threads at once. */
static atomic_int caught;
static atomic_llong caught_ms; /* on a clock that only goes forward; 0: none came */
static _Atomic(const char *) announcement;

_Static_assert(ATOMIC_INT_LOCK_FREE == 2 && ATOMIC_LLONG_LOCK_FREE == 2 &&
                   ATOMIC_POINTER_LOCK_FREE == 2,
               "a signal's handler must not wait for a lock");

static long long milliseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (long long)now.tv_sec * 1000 + now.tv_nsec / 1000000 + 1;
}

/* As if the signal had never been caught, so that the parent process sees what ended us. */
static void end_at_once(int number) {
    struct sigaction action;
    sigset_t only;
    hd_leftovers_remove();
    memset(&action, 0, sizeof action);
    action.sa_handler = SIG_DFL;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
    sigemptyset(&only);
    sigaddset(&only, number);
    pthread_sigmask(SIG_UNBLOCK, &only, NULL);
    raise(number);
    _exit(128 + number);
}

static void handle(int number) {
    int kept = errno;
    long long first = 0, now = milliseconds();
    if (atomic_compare_exchange_strong(&caught_ms, &first, now)) {
        const char *text = atomic_load(&announcement);
        atomic_store(&caught, number);
        if (text != NULL && write(STDERR_FILENO, text, strlen(text)) < 0)
            errno = kept; /* and nobody there to be told */
    } else if (now - first >= SAME_WISH_MS) {
        end_at_once(number);
    }
    errno = kept;
}

/* A signal that the parent process had ignored stays ignored: so shells start jobs in the
   background, and nohup its program. */
static void catch_signal(int number) {
    struct sigaction action;
    if (sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN)
        return;
    memset(&action, 0, sizeof action);
    action.sa_handler = handle;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

void hd_interrupt_install(void) {
    struct sigaction action;
    catch_signal(SIGINT);
    catch_signal(SIGTERM);
    catch_signal(SIGHUP);
    memset(&action, 0, sizeof action);
    sigemptyset(&action.sa_mask);
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, NULL);
    sigaction(SIGPIPE, &action, NULL);
    action.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &action, NULL);
}

int hd_interrupt_signal(void) {
    return atomic_load(&caught);
}

void hd_interrupt_announce(const char *text) {
    atomic_store(&announcement, text);
}
