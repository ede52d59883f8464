/* SPDX-License-Identifier: MIT */
/* A system that fails, preloaded and set by environment variables.
   Memory: FAILING_MEMORY_AT is the number, from 1, of the first allocation that fails;
   FAILING_MEMORY_TIMES is how many of them fail, by default 1. FAILING_MEMORY_COUNT names a file
   that gets their number.
   Threads: FAILING_THREADS_AFTER of them are started, later ones refused.
   Orphans: with FAILING_ORPHANS programs outlive their parent.
   A file system that hangs: opening a file with STUCK_OPEN in its name waits for ever, as for a
   lost server, and only a deadly signal ends it; STUCK_MARK is made before. A disk: SYNC_LOG names
   a file that gets a line for each call: "sync FILE BYTES", "folder FOLDER", "rename FROM TO
   BYTES". SYNC_FAIL=N: the call number N of fsync(), counted from 1, and all later ones fail with
   an input/output error. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "real.h"

/* ---- memory ---- */

/* glibc's own, because dlsym() allocates as well. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long counted;

static bool fails(void) {
    long at = number_of("FAILING_MEMORY_AT", 0), number = atomic_fetch_add(&counted, 1) + 1;
    if (at == 0 || number < at || number - at >= number_of("FAILING_MEMORY_TIMES", 1))
        return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size) {
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    return fails() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size) {
    return fails() ? NULL : __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
    return fails() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size) {
    if (fails())
        return ENOMEM;
    *memory = __libc_memalign(alignment, size);
    return *memory != NULL ? 0 : ENOMEM;
}

__attribute__((destructor)) static void report_count(void) {
    const char *name = getenv("FAILING_MEMORY_COUNT");
    int file = name != NULL ? open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    if (file >= 0 && dprintf(file, "%ld\n", atomic_load(&counted)) > 0)
        close(file);
}

/* ---- threads and orphans ---- */

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                   void *argument) {
    int (*real)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    static atomic_long started;
    find_real("pthread_create", &real);
    return atomic_fetch_add(&started, 1) >= number_of("FAILING_THREADS_AFTER", LONG_MAX)
               ? EAGAIN
               : real(thread, attributes, run, argument);
}

int prctl(int option, ...) {
    va_list arguments;
    va_start(arguments, option);
    const unsigned long first = va_arg(arguments, unsigned long);
    va_end(arguments);
    if (getenv("FAILING_ORPHANS") == NULL)
        return (int)syscall(SYS_prctl, option, first, 0, 0, 0);
    errno = EINVAL;
    return -1;
}

/* ---- a file system that hangs ---- */

/* The parent of a vfork() handles no signal before the child has ended. */
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
    int (*real)(const char *, int, ...);
    const char *mark = getenv("STUCK_MARK"), *wanted = getenv("STUCK_OPEN");
    va_list arguments;
    va_start(arguments, flags);
    int mode = (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
    va_end(arguments);
    find_real("open", &real);
    if (mark != NULL && wanted != NULL && strstr(path, wanted) != NULL) {
        close(real(mark, O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
        hang();
    }
    return real(path, flags, mode);
}

/* ---- a disk ---- */

static void tell(const char *what, const char *first, const char *second, const struct stat *file) {
    const char *name = getenv("SYNC_LOG");
    if (name == NULL)
        return;
    int log = open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (log < 0 ||
        dprintf(log, "%s %s %s%lld\n", what, first, second, (long long)file->st_size) < 0)
        abort();
    close(log);
}

int fsync(int descriptor) {
    static atomic_long syncs;
    int (*real)(int);
    char link[64], path[PATH_MAX] = "";
    struct stat found;
    find_real("fsync", &real);
    const bool is_folder = fstat(descriptor, &found) == 0 && S_ISDIR(found.st_mode);
    if (atomic_fetch_add(&syncs, 1) + 1 >= number_of("SYNC_FAIL", LONG_MAX)) {
        errno = EIO;
        return -1;
    }
    const int code = real(descriptor);
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    if (readlink(link, path, sizeof path - 1) > 0)
        tell(is_folder ? "folder" : "sync", path, "", &found);
    return code;
}

int rename(const char *from, const char *to) {
    int (*real)(const char *, const char *);
    char path[PATH_MAX] = "", second[PATH_MAX + 1];
    struct stat found = {0};
    find_real("rename", &real);
    if (realpath(from, path) == NULL || stat(path, &found) != 0)
        path[0] = '\0';
    snprintf(second, sizeof second, "%s ", to);
    const int code = real(from, to);
    tell("rename", path, second, &found);
    return code;
}
