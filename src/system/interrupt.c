/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/interrupt.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/limits.h"
#include "system/path.h"

enum {
    SAME_REQUEST_MS = 500,
    TIMEOUT_MS = 1500,
    REMOVAL_MS = 300,
    CLOCK_SLACK_MS = 2,
    INTERVAL_MS = 250,
    WRITE_INTERVAL_MS = 200
};

static const int watched_signals[] = {SIGINT, SIGTERM, SIGHUP};
static const double MIN_TIMEOUT_S = 0.1, MAX_TIMEOUT_S = 86400.0;
static const char timeout_message[] = "hedron: interrupted; the running work did not end in time\n";

/* Signals arrive in any thread, two of them possibly in two threads at once. */
static atomic_int caught;
static atomic_llong caught_ms; /* on a monotonic clock; 0: no signal yet */
static _Atomic(const char *) announcement;

/* Timers, because every thread of the program may be blocked. */
static struct {
    timer_t end, kill; /* send SIGALRM and, if that is not handled, SIGKILL */
    bool has_end, has_kill;
} timers;

static atomic_bool is_removing;

static long timeout_ms = TIMEOUT_MS;

_Static_assert(ATOMIC_INT_LOCK_FREE == 2 && ATOMIC_LLONG_LOCK_FREE == 2 &&
                   ATOMIC_POINTER_LOCK_FREE == 2,
               "a signal's handler must not wait for a lock");

/* ---- cleanup registry ---- */

/* Enough for all outputs as films, and for all of them as pictures with many frames in flight. */
enum { MAX_GROUPS = 2 * HD_MAX_OUTPUTS, MAX_FILES = 32 * HD_MAX_OUTPUTS };

/* A name that is being removed is never written to again: its slot stays taken. */
typedef enum FileState { FREE, BEING_WRITTEN, REMEMBERED, BEING_REMOVED } FileState;

static struct {
    atomic_int state;
    char path[HD_MAX_PATH];
} files[MAX_FILES];

/* protects the files among threads; signal handlers use the states alone */
static pthread_mutex_t files_mutex = PTHREAD_MUTEX_INITIALIZER;

static atomic_int groups[MAX_GROUPS]; /* 0: free */

_Static_assert(sizeof(pid_t) <= sizeof(int), "a process id is stored as an int");

static bool swap(atomic_int *value, int from, int to) {
    return atomic_compare_exchange_strong(value, &from, to);
}

void hd_cleanup_add_file(const char *path) {
    size_t size = strlen(path) + 1;
    pthread_mutex_lock(&files_mutex);
    for (int i = 0; i < MAX_FILES && size <= HD_MAX_PATH; i++) {
        if (!swap(&files[i].state, FREE, BEING_WRITTEN))
            continue;
        memcpy(files[i].path, path, size);
        atomic_store(&files[i].state, REMEMBERED);
        break;
    }
    pthread_mutex_unlock(&files_mutex);
}

void hd_cleanup_forget_file(const char *path) {
    pthread_mutex_lock(&files_mutex);
    for (int i = 0; i < MAX_FILES; i++)
        if (atomic_load(&files[i].state) == REMEMBERED && strcmp(files[i].path, path) == 0)
            swap(&files[i].state, REMEMBERED, FREE);
    pthread_mutex_unlock(&files_mutex);
}

void hd_cleanup_add_group(pid_t leader) {
    for (int i = 0; i < MAX_GROUPS; i++)
        if (swap(&groups[i], 0, (int)leader))
            return;
}

void hd_cleanup_forget_group(pid_t leader) {
    for (int i = 0; i < MAX_GROUPS; i++)
        swap(&groups[i], (int)leader, 0);
}

/* Kills the groups first, which could create their files again. */
void hd_cleanup_remove(void) {
    for (int i = 0; i < MAX_GROUPS; i++) {
        int leader = atomic_exchange(&groups[i], 0);
        if (leader > 0)
            kill(-leader, SIGKILL);
    }
    for (int i = 0; i < MAX_FILES; i++)
        if (swap(&files[i].state, REMEMBERED, BEING_REMOVED))
            unlink(files[i].path);
}

/* ---- signals ---- */

static long long milliseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (long long)now.tv_sec * 1000 + now.tv_nsec / 1000000 + 1;
}

static void set_timer(timer_t timer, long after_ms) {
    const struct itimerspec once = {
        .it_value = {.tv_sec = after_ms / 1000, .tv_nsec = after_ms % 1000 * 1000000}};
    timer_settime(timer, 0, &once, NULL);
}

static void set_handler(int number, void (*handler)(int), int flags) {
    struct sigaction action = {.sa_handler = handler, .sa_flags = flags};
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

static void unblock(int number) {
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, number);
    pthread_sigmask(SIG_UNBLOCK, &only, NULL);
}

static void write_message(const char *text) {
    if (text != NULL && write(STDERR_FILENO, text, strlen(text)) < 0)
        errno = 0; /* nobody can read a report */
}

/* Ends as if the signal had never been caught, so that the parent process sees the signal. */
static void die_by_signal(int number) {
    set_handler(number, SIG_DFL, 0);
    unblock(number);
    raise(number);
    _exit(128 + number);
}

/* Removing files may block too, so the timers run meanwhile. */
static void end_at_once(int number, const char *text) {
    atomic_store(&is_removing, true);
    if (timers.has_end)
        set_timer(timers.end, REMOVAL_MS);
    if (timers.has_kill)
        set_timer(timers.kill, 2 * REMOVAL_MS);
    write_message(text);
    hd_cleanup_remove();
    die_by_signal(number);
}

/* Also wakes the main thread, and then does nothing else. */
static void handle_deadline(int unused) {
    int number = atomic_load(&caught);
    long long waited = milliseconds() - atomic_load(&caught_ms);
    (void)unused;
    if (number == 0 || waited + CLOCK_SLACK_MS < timeout_ms)
        return;
    if (atomic_load(&is_removing))
        die_by_signal(number);
    end_at_once(number, timeout_message);
}

static void handle(int number) {
    int kept = errno;
    long long first = 0, now = milliseconds();
    if (atomic_compare_exchange_strong(&caught_ms, &first, now)) {
        atomic_store(&caught, number);
        if (timers.has_end)
            set_timer(timers.end, timeout_ms);
        write_message(atomic_load(&announcement));
    } else if (now - first >= SAME_REQUEST_MS) {
        end_at_once(number, NULL);
    }
    errno = kept;
}

static bool is_ignored(int number) {
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

/* The system prefers the main thread for signals, but that handles none while it waits for a file
   server that is gone. This thread then handles them, and SIGALRM wakes the main thread. */
static void *watch(void *main_thread) {
    const struct timespec poll_interval = {.tv_nsec = INTERVAL_MS * 1000000};
    sigset_t all, watched;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, NULL);
    sigemptyset(&watched);
    for (size_t i = 0; i < sizeof watched_signals / sizeof *watched_signals; i++)
        sigaddset(&watched, watched_signals[i]);
    sigaddset(&watched, SIGALRM);
    for (;;) {
        int number = sigtimedwait(&watched, NULL, &poll_interval);
        if (number == SIGALRM) {
            handle_deadline(number);
        } else if (number > 0 && !is_ignored(number)) {
            handle(number);
            pthread_kill(*(pthread_t *)main_thread, SIGALRM);
        }
    }
    return NULL;
}

/* Returns false if the system has no timer left. */
static bool create_timer(timer_t *timer, int number) {
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = number};
    return timer_create(CLOCK_MONOTONIC, &event, timer) == 0;
}

/* Keeps signals ignored that the parent process ignored: shells do so for background jobs, and
   nohup. */
void hd_interrupt_install(void) {
    static pthread_t main_thread;
    pthread_t watcher;
    /* SIGALRM may arrive again while the first one is handled. */
    set_handler(SIGALRM, handle_deadline, SA_NODEFER);
    unblock(SIGALRM);
    timers.has_end = create_timer(&timers.end, SIGALRM);
    timers.has_kill = create_timer(&timers.kill, SIGKILL);
    for (size_t i = 0; i < sizeof watched_signals / sizeof *watched_signals; i++)
        if (!is_ignored(watched_signals[i]))
            set_handler(watched_signals[i], handle, 0);
    set_handler(SIGXFSZ, SIG_IGN, 0);
    set_handler(SIGPIPE, SIG_IGN, 0);
    set_handler(SIGCHLD, SIG_DFL, 0);
    main_thread = pthread_self();
    /* Without this thread the timeout fails only during a wait for a file server. */
    if (pthread_create(&watcher, NULL, watch, &main_thread) == 0)
        pthread_detach(watcher);
}

HdStatus hd_interrupt_read_timeout(HdError *error) {
    const char *text = getenv("HEDRON_STOP_PATIENCE");
    char *end;
    if (text == NULL || text[0] == '\0')
        return HD_OK;
    double seconds = strtod(text, &end);
    if (*end != '\0' || !(seconds >= MIN_TIMEOUT_S && seconds <= MAX_TIMEOUT_S))
        return hd_fail(error, HD_BAD_INPUT,
                       "HEDRON_STOP_PATIENCE is '%.200s', expected seconds from %g to %g", text,
                       MIN_TIMEOUT_S, MAX_TIMEOUT_S);
    timeout_ms = (long)(1e3 * seconds);
    return HD_OK;
}

int hd_interrupt_signal(void) {
    return atomic_load(&caught);
}

bool hd_wait_to_write(int descriptor) {
    struct pollfd ready = {.fd = descriptor, .events = POLLOUT};
    int count;
    while ((count = poll(&ready, 1, WRITE_INTERVAL_MS)) == 0 || (count < 0 && errno == EINTR))
        if (hd_interrupt_signal() != 0)
            return false;
    return true;
}

void hd_interrupt_announce(const char *text) {
    atomic_store(&announcement, text);
}
