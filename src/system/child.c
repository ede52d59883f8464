/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "system/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "system/interrupt.h"

extern char **environ;

/* The shorter interval is for waits that no descriptor can end. */
enum { INTERVAL_MS = 200, SHORT_INTERVAL_MS = 10 };

/* highest signal number, real-time signals included; systems with fewer reject the rest */
enum { MAX_SIGNAL = 64 };

HdStatus hd_child_find(const char *name, char out[HD_MAX_PATH], HdError *error) {
    const char *folders = getenv("PATH");
    struct stat found;
    if (folders == NULL)
        folders = "/usr/local/bin:/usr/bin:/bin";
    for (const char *folder = folders;; folder++) {
        int length = (int)strcspn(folder, ":");
        /* An empty item of PATH is the current folder. */
        int used = length == 0 ? snprintf(out, HD_MAX_PATH, "./%s", name)
                               : snprintf(out, HD_MAX_PATH, "%.*s/%s", length, folder, name);
        if (used < HD_MAX_PATH && stat(out, &found) == 0 && S_ISREG(found.st_mode) &&
            access(out, X_OK) == 0)
            return HD_OK;
        folder += length;
        if (*folder == '\0')
            break;
    }
    return hd_fail(error, HD_UNAVAILABLE, "cannot make a film: found no program \"%s\" in PATH",
                   name);
}

static void close_descriptor(int *descriptor) {
    if (*descriptor >= 0)
        close(*descriptor);
    *descriptor = -1;
}

/* Opens a pair of sockets: writing to one without a reader need not raise a signal, as a pipe does.
   The parent keeps ends[0]. */
static bool open_channel(int ends[2]) {
    return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
}

typedef struct Order {
    pid_t *pid;
    const char *const *arguments;
    int input, output;
    int lock;   /* kept open; -1: none */
    int reason; /* errno of the result; negative: pending */
} Order;

/* ---- in the child, before it executes the other program: no allocation, no locks ---- */

/* Copies a descriptor to `to` so that it survives execve. */
static bool inherit_descriptor(int from, int to) {
    return from == to ? fcntl(to, F_SETFD, 0) == 0 : dup2(from, to) >= 0;
}

/* If the parent's standard streams are closed, the channels may have their numbers. Even then
   nothing is overwritten before its use: `output` was opened after another end, so it is never
   0. */
static bool set_streams(int input, int output) {
    if (input < 0)
        input = open("/dev/null", O_RDONLY);
    return input >= 0 && inherit_descriptor(input, STDIN_FILENO) &&
           inherit_descriptor(output, STDOUT_FILENO) && inherit_descriptor(output, STDERR_FILENO);
}

/* Resets and unblocks signals, which were blocked before the fork. The child must not run this
   program's handlers, and must not inherit blocked signals or the ignored SIGPIPE. */
static bool set_signals(void) {
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    struct sigaction now;
    sigset_t none;
    sigemptyset(&none);
    for (int signal = 1; signal <= MAX_SIGNAL; signal++)
        if (sigaction(signal, NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaction(signal, &usual, NULL);
    sigaction(SIGPIPE, &usual, NULL);
    return sigprocmask(SIG_SETMASK, &none, NULL) == 0;
}

static _Noreturn void execute(const Order *order, int report, pid_t parent) {
#ifdef __linux__
    /* On other systems the lock shows that the program lives. */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (getppid() != parent) /* the parent ended before prctl */
        _exit(1);
    /* F_DUPFD gives the lock a number above the standard streams. */
    if (setpgid(0, 0) == 0 &&
        (order->lock < 0 || fcntl(order->lock, F_DUPFD, STDERR_FILENO + 1) >= 0) &&
        set_streams(order->input, order->output) && set_signals())
        /* execve does not change the arguments, despite its prototype */
        execve(order->arguments[0], (char *const *)order->arguments, environ);
    const int reason = errno;
    while (write(report, &reason, sizeof reason) < 0 && errno == EINTR)
        continue;
    _exit(127);
}

/* ---- */

/* Returns 0 when the channel closes, as on execve; otherwise the errno sent by the child. */
static int read_report(int report, pid_t child) {
    int reason = 0;
    if (hd_read_fully(report, &reason, sizeof reason) != (ssize_t)sizeof reason)
        return 0;
    while (waitpid(child, NULL, 0) < 0 && errno == EINTR)
        continue;
    return reason;
}

/* Returns 0 or an errno. */
static int spawn_here(const Order *order) {
    const pid_t parent = getpid();
    pid_t *pid = order->pid;
    int report[2], reason = 0;
    sigset_t all, before;
    if (!open_channel(report))
        return errno;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    *pid = fork();
    if (*pid == 0)
        execute(order, report[1], parent);
    if (*pid < 0)
        reason = errno;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    close(report[1]);
    if (reason == 0)
        reason = read_report(report[0], *pid);
    close(report[0]);
    if (reason == 0)
        hd_cleanup_add_group(*pid);
    else
        *pid = 0;
    return reason;
}

/* ---- a child dies with the thread that started it, so one permanent thread starts all ---- */

static struct {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    bool has_thread, knows_forks;
    Order *order; /* NULL: none */
} launcher = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

static void *launch(void *unused) {
    (void)unused;
    pthread_mutex_lock(&launcher.mutex);
    for (;;) {
        while (launcher.order == NULL)
            pthread_cond_wait(&launcher.changed, &launcher.mutex);
        launcher.order->reason = spawn_here(launcher.order);
        launcher.order = NULL;
        pthread_cond_broadcast(&launcher.changed);
    }
    return NULL;
}

/* Resets the launcher after a fork: the child has none of the threads, and the lock may be held. */
static void reset_launcher(void) {
    launcher.mutex = (pthread_mutex_t)PTHREAD_MUTEX_INITIALIZER;
    launcher.changed = (pthread_cond_t)PTHREAD_COND_INITIALIZER;
    launcher.has_thread = false;
    launcher.order = NULL;
}

/* Starts the thread with all signals blocked; other threads handle them. */
static bool start_launcher(void) {
    pthread_t thread;
    sigset_t all, before;
    if (launcher.has_thread)
        return true;
    if (!launcher.knows_forks && pthread_atfork(NULL, NULL, reset_launcher) != 0)
        return false;
    launcher.knows_forks = true;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    launcher.has_thread = pthread_create(&thread, NULL, launch, NULL) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (launcher.has_thread)
        pthread_detach(thread);
    return launcher.has_thread;
}

/* Runs spawn_here on the launcher's thread. */
static int spawn(Order *order) {
    pthread_mutex_lock(&launcher.mutex);
    if (!start_launcher())
        order->reason = EAGAIN;
    while (order->reason < 0) {
        if (launcher.order == NULL) {
            launcher.order = order;
            pthread_cond_broadcast(&launcher.changed);
        }
        pthread_cond_wait(&launcher.changed, &launcher.mutex);
    }
    pthread_mutex_unlock(&launcher.mutex);
    return order->reason;
}

static void append_tail(HdChild *child, const char *text, size_t length) {
    size_t capacity = HD_CHILD_MAX_TAIL - child->tail_length;
    if (length > capacity) {
        size_t dropped = length - capacity;
        memmove(child->tail, child->tail + dropped, child->tail_length - dropped);
        child->tail_length -= dropped;
    }
    memcpy(child->tail + child->tail_length, text, length);
    child->tail_length += length;
    child->tail[child->tail_length] = '\0';
}

/* Reads output that poll() reported, and closes it at its end. */
static void read_output(HdChild *child) {
    char text[1024];
    ssize_t count = read(child->output, text, sizeof text);
    if (count > 0)
        append_tail(child, text, (size_t)count);
    else if (count == 0 || errno != EINTR)
        close_descriptor(&child->output);
}

/* ---- waiting ---- */

/* Waits for one of the channels { input, output }, and reads output. Returns false after an
   interrupt or if the child is stuck. `still_ms` counts intervals without an event instead of clock
   time, because the system may have slept or this program been stopped. */
static bool poll_channels(HdChild *child, struct pollfd ready[2], int poll_interval_ms,
                          int timeout_ms, int *still_ms) {
    const int count = hd_interrupt_signal() == 0 ? poll(ready, 2, poll_interval_ms) : 0;
    if (hd_interrupt_signal() != 0 || (count < 0 && errno != EINTR))
        return false;
    *still_ms = count > 0 ? 0 : *still_ms + poll_interval_ms;
    child->is_stuck = *still_ms >= timeout_ms;
    if (count > 0 && ready[1].revents != 0)
        read_output(child);
    return !child->is_stuck;
}

static bool has_ended(const HdChild *child) {
    siginfo_t state = {0};
    int code = waitid(P_PID, (id_t)child->pid, &state, WEXITED | WNOWAIT | WNOHANG);
    return code != 0 ? errno != EINTR : state.si_pid != 0;
}

/* Reads output until its end, then waits for the child. Returns false if it must be killed. */
static bool wait_for_end(HdChild *child, int timeout_ms) {
    int still_ms = 0;
    while (child->output >= 0 || !has_ended(child)) {
        struct pollfd ready[2] = {{.fd = -1}, {.fd = child->output, .events = POLLIN}};
        const int poll_interval_ms = child->output >= 0 ? INTERVAL_MS : SHORT_INTERVAL_MS;
        if (!poll_channels(child, ready, poll_interval_ms, timeout_ms, &still_ms))
            return false;
    }
    return true;
}

bool hd_child_send(HdChild *child, const uint8_t *bytes, size_t size, int timeout_ms) {
    int still_ms = 0;
    while (size > 0) {
        struct pollfd ready[2] = {{.fd = child->input, .events = POLLOUT},
                                  {.fd = child->output, .events = POLLIN}};
        if (!poll_channels(child, ready, INTERVAL_MS, timeout_ms, &still_ms))
            return false;
        if (ready[0].revents == 0)
            continue;
        ssize_t sent = send(child->input, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
            return false;
        if (sent > 0) {
            bytes += sent;
            size -= (size_t)sent;
        }
    }
    return true;
}

/* ---- ends ---- */

/* Blocks until the child has ended, and describes how in `how`. */
static bool reap(HdChild *child, char how[64]) {
    int state = 0;
    pid_t ended;
    siginfo_t unused;
    /* Its process id is reused only after waitpid. */
    while (waitid(P_PID, (id_t)child->pid, &unused, WEXITED | WNOWAIT) != 0 && errno == EINTR)
        continue;
    hd_cleanup_forget_group(child->pid);
    do
        ended = waitpid(child->pid, &state, 0);
    while (ended < 0 && errno == EINTR);
    child->pid = 0;
    close_descriptor(&child->output);
    if (ended < 0)
        snprintf(how, 64, "exit code unknown: %s", strerror(errno));
    else if (WIFSIGNALED(state))
        snprintf(how, 64, "signal %d", WTERMSIG(state));
    else
        snprintf(how, 64, "exit code %d", WEXITSTATUS(state));
    return ended > 0 && WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

bool hd_child_end(HdChild *child, int timeout_ms, char how[64]) {
    close_descriptor(&child->input);
    if (!wait_for_end(child, timeout_ms))
        kill(-child->pid, SIGKILL);
    return reap(child, how);
}

/* Kills the whole group, because "ffmpeg" may be a script that started the real program. */
void hd_child_stop(HdChild *child) {
    char how[64];
    if (child->pid > 0) {
        kill(-child->pid, SIGKILL);
        reap(child, how);
    }
    close_descriptor(&child->input);
    close_descriptor(&child->output);
}

HdStatus hd_child_start(HdChild *child, const char *const arguments[], bool with_input, int lock,
                        HdError *error) {
    int input[2] = {-1, -1}, output[2] = {-1, -1};
    *child = (HdChild){.input = -1, .output = -1};
    bool opened = (!with_input || open_channel(input)) && open_channel(output);
    int reason = opened ? 0 : errno;
    child->input = input[0];
    child->output = output[0];
    if (opened)
        reason = spawn(&(Order){&child->pid, arguments, input[1], output[1], lock, -1});
    close_descriptor(&input[1]);
    close_descriptor(&output[1]);
    if (reason == 0)
        return HD_OK;
    hd_child_stop(child);
    bool unusable = reason == ENOENT || reason == ENOEXEC || reason == EACCES;
    return hd_fail(error, unusable ? HD_UNAVAILABLE : HD_FAILED, "cannot start %s: %s",
                   arguments[0], strerror(reason));
}

const char *hd_child_tail(HdChild *child) {
    while (child->tail_length > 0 && strchr("\r\n ", child->tail[child->tail_length - 1]) != NULL)
        child->tail_length--;
    child->tail[child->tail_length] = '\0';
    return child->tail_length > 0 ? child->tail : "(nothing)";
}
