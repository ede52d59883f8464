/* SPDX-License-Identifier: MIT */
/* Signals, each in a process of its own, and its end. */
#define _XOPEN_SOURCE 700
#include "system/interrupt.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

#include "system/machine.h"
#include "test_folder.h"

static HdError error;

/* ---- actions of processes ---- */

static void pass(double seconds) {
    struct timespec rest = {.tv_nsec = (long)(1e9 * seconds)};
    while (nanosleep(&rest, &rest) != 0)
        ;
}

static int number;

static void raise_one(void) {
    hd_interrupt_announce("stopping\n");
    errno = EDOM;
    if (hd_interrupt_signal() != 0 || raise(number) != 0 || errno != EDOM)
        _exit(97);
    _exit(hd_interrupt_signal());
}

static void announce_nothing(void) {
    hd_interrupt_announce("stopping\n");
    hd_interrupt_announce(NULL);
    close(STDERR_FILENO);
    raise(SIGTERM);
    _exit(hd_interrupt_signal());
}

static void raise_two_at_once(void) {
    hd_interrupt_announce("stopping\n");
    raise(SIGINT);
    raise(SIGTERM);
    _exit(hd_interrupt_signal());
}

/* The main thread handles none, as if a lost file server blocked it. */
static void be_deaf(void) {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, NULL);
}

static void wait_deaf(void) {
    be_deaf();
    kill(getpid(), SIGTERM);
    while (hd_interrupt_signal() == 0)
        pass(0.001);
    _exit(hd_interrupt_signal());
}

static void leave_a_file(void) {
    write_bytes("left", "x", 1);
    hd_cleanup_add_file("left");
}

static void raise_a_second_one(void) {
    leave_a_file();
    raise(SIGTERM);
    pass(0.51);
    raise(SIGINT);
}

static void hang(void) {
    leave_a_file();
    kill(getpid(), SIGTERM);
    for (;;)
        pause();
}

static void hang_deaf(void) {
    be_deaf();
    hang();
}

static void last_without_a_signal(void) {
    raise(SIGALRM); /* which is no interrupt */
    pass(0.12);
    _exit(hd_interrupt_signal());
}

static void look_at_others(void) {
    static const int numbers[] = {SIGPIPE, SIGXFSZ, SIGHUP, SIGCHLD};
    for (int i = 0; i < 4; i++) {
        struct sigaction action;
        sigaction(numbers[i], NULL, &action);
        if (action.sa_handler != (i < 3 ? SIG_IGN : SIG_DFL))
            _exit(95);
    }
    kill(getpid(), SIGHUP);
    pass(0.002);
    _exit(hd_interrupt_signal());
}

/* ---- their ends ---- */

static char said[1000]; /* the last one's output on standard error */
static double took;     /* its seconds */

static void be(void (*act)(void), const int errors[2]) {
    signal(SIGCHLD, SIG_IGN); /* as from a careless parent */
    if (act == look_at_others)
        signal(SIGHUP, SIG_IGN); /* as by nohup */
    dup2(errors[1], STDERR_FILENO);
    close(errors[0]);
    hd_interrupt_install();
    if (hd_interrupt_read_timeout(&error) != HD_OK)
        _exit(99);
    act();
    _exit(98);
}

/* Returns the end of a process with this action: its exit code, or minus the signal. */
static int outcome_of(void (*act)(void)) {
    int errors[2], status = 0;
    size_t size = 0;
    ssize_t count;
    const double start = hd_monotonic_seconds();
    assert_int_equal(pipe(errors), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        be(act, errors);
    close(errors[1]);
    while ((count = read(errors[0], said + size, sizeof said - 1 - size)) > 0)
        size += (size_t)count;
    said[size] = '\0';
    close(errors[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    took = hd_monotonic_seconds() - start;
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

static const char too_late[] = "hedron: interrupted; the running work did not end in time\n";

static const struct {
    const char *name;
    void (*act)(void);
    const char *timeout;
    int outcome;
    const char *said;
} cases[] = {
    {"it is announced", raise_one, "", SIGINT, "stopping\n"},
    {"it is announced", raise_one, "", SIGTERM, "stopping\n"},
    {"it is announced", raise_one, "", SIGHUP, "stopping\n"},
    {"nothing is to be announced", announce_nothing, "", SIGTERM, ""},
    {"two at once count as one", raise_two_at_once, "", SIGINT, "stopping\n"},
    {"another thread takes it if the main thread is stuck", wait_deaf, "", SIGTERM, ""},
    {"a second one later ends it at once", raise_a_second_one, "100", -SIGINT, ""},
    {"who does not end in time is ended", hang, "0.1", -SIGTERM, too_late},
    {"whose main thread is stuck, too", hang_deaf, "0.1", -SIGTERM, too_late},
    {"what the parent ignored stays ignored, but for children", look_at_others, "", 0, ""},
    {"without a signal it may last", last_without_a_signal, "0.1", 0, ""},
};

TEST(signals_end_it_as_they_should) {
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        setenv("HEDRON_STOP_PATIENCE", cases[i].timeout, 1);
        number = cases[i].outcome;
        const int outcome = outcome_of(cases[i].act);
        if (outcome != cases[i].outcome || strcmp(said, cases[i].said) != 0 ||
            access("left", F_OK) == 0 || (cases[i].said == too_late && took < 0.1))
            fail_msg("%s: it ended with %d, said '%s' and took %g s", cases[i].name, outcome, said,
                     took);
    }
}

TEST(the_timeout_is_a_time) {
    static const struct {
        const char *text;
        bool is_good;
    } timeouts[] = {{"", true},       {"0.1", true}, {"86400", true}, {"0.0999", false},
                    {"86401", false}, {"1s", false}, {"nan", false},  {"-1", false}};
    for (size_t i = 0; i < sizeof timeouts / sizeof *timeouts; i++) {
        setenv("HEDRON_STOP_PATIENCE", timeouts[i].text, 1);
        assert_int_equal(hd_interrupt_read_timeout(&error),
                         timeouts[i].is_good ? HD_OK : HD_BAD_INPUT);
        if (!timeouts[i].is_good) {
            expect_contains(error.message, timeouts[i].text);
            expect_contains(error.message, "expected seconds from 0.1 to 86400");
        }
    }
}

/* Shells start background processes with some of these ignored. */
static int begin(void **state) {
    (void)state;
    unsetenv("HEDRON_STOP_PATIENCE");
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    return 0;
}

EACH(begin, NULL)
