/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* flock */

#include "system/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/folder_set.h"
#include "system/durable.h"
#include "system/interrupt.h"
#include "system/leftovers.h"

enum { MAX_ATTEMPTS = 1000, ORPHAN_GLANCES = 1000 /* of 10 ms each */ };

/* Between the name and the numbers. */
#define MARK ".tmp-"

static const char *folder_of(const char *path, char folder[HD_MAX_PATH]) {
    const int length = (int)hd_folder_length(path);
    snprintf(folder, HD_MAX_PATH, "%.*s", length > 0 ? length : 1, length > 0 ? path : ".");
    return folder;
}

/* The folders that this run has written to, so that one that goes away is missed instead of made
   anew without what was in it. */
static HdFolderSet known;
static pthread_mutex_t known_mutex = PTHREAD_MUTEX_INITIALIZER;

/* Whether the run has written to the file's folder. */
static bool knows_folder(const char *path) {
    pthread_mutex_lock(&known_mutex);
    const bool is_known = hd_folder_set_has(&known, path);
    pthread_mutex_unlock(&known_mutex);
    return is_known;
}

static void know_folder(const char *path) {
    pthread_mutex_lock(&known_mutex);
    hd_folder_set_add(&known, path);
    pthread_mutex_unlock(&known_mutex);
}

void hd_known_folders_forget(void) {
    pthread_mutex_lock(&known_mutex);
    known = (HdFolderSet){0};
    pthread_mutex_unlock(&known_mutex);
}

static HdStatus check_target(const char *path, HdError *error) {
    struct stat found;
    size_t length = strlen(path);
    if (length == 0 || path[length - 1] == '/')
        return hd_fail(error, HD_BAD_INPUT, "cannot write \"%s\": expected the name of a file",
                       path);
    if (length >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write \"%s\": the name has %zu bytes, expected fewer than %d", path,
                       length, HD_MAX_PATH);
    if (stat(path, &found) == 0 && !S_ISREG(found.st_mode))
        return hd_fail(error, HD_BAD_INPUT, "cannot write %s: it exists and is not a regular file",
                       path);
    return HD_OK;
}

/* The name is cut because many file systems end at 255 bytes, and the suffix must fit as well. */
static HdStatus temporary_name(const char *path, int attempt, char temporary[HD_MAX_PATH],
                               HdError *error) {
    int folder = (int)hd_folder_length(path);
    int length = snprintf(temporary, HD_MAX_PATH, "%.*s%.*s" MARK "%ld-%d", folder, path,
                          HD_TEMPORARY_MOST_KEPT, path + folder, (long)getpid(), attempt);
    if (length < 0 || length >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write %s: its temporary name has %d bytes, expected fewer than %d",
                       path, length, HD_MAX_PATH);
    return HD_OK;
}

/* The temporary name is cut to fit, so that the final one would be found too long only at the end.
 */
static HdStatus check_length(const char *path, HdError *error) {
    const size_t length = strlen(path + hd_folder_length(path));
    char folder[HD_MAX_PATH];
    long most = pathconf(folder_of(path, folder), _PC_NAME_MAX);
    if (most > 0 && length > (size_t)most)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write \"%s\": the name of the file has %zu bytes, expected at most "
                       "%ld",
                       path, length, most);
    return HD_OK;
}

/* Moves `*text` past a number; false where there is none. */
static bool skip_digits(const char **text) {
    const size_t count = strspn(*text, "0123456789");
    *text += count;
    return count > 0;
}

size_t hd_temporary_name_length(const char *name) {
    const char *found = NULL;
    for (const char *next = strstr(name, MARK); next != NULL; next = strstr(next + 1, MARK))
        found = next;
    if (found == NULL)
        return 0;
    const char *text = found + strlen(MARK);
    if (!skip_digits(&text) || *text++ != '-' || !skip_digits(&text) || *text != '\0')
        return 0;
    return (size_t)(found - name);
}

/* Between its making and its locking the file looks like one that was left behind. Where a file
   system has no locks, none can be held, and nothing is removed. */
static bool lock(int descriptor) {
    struct stat found;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return false;
    return fstat(descriptor, &found) != 0 || found.st_nlink > 0;
}

/* Whether the process that the name tells is gone, as far as this machine knows. */
static bool writer_is_gone(const char *temporary) {
    const char *numbers = temporary + hd_folder_length(temporary);
    numbers += hd_temporary_name_length(numbers) + strlen(MARK);
    return kill((pid_t)strtol(numbers, NULL, 10), 0) != 0 && errno == ESRCH;
}

/* What a program that was killed had started, and could not end with it, has the lock until it ends
   for want of input. */
static bool lock_stale(int descriptor, const char *temporary) {
    const struct timespec glance = {.tv_nsec = 10000000};
    const bool waits = writer_is_gone(temporary);
    for (int i = 0; flock(descriptor, LOCK_EX | LOCK_NB) != 0; i++) {
        if (errno != EWOULDBLOCK || !waits || i == ORPHAN_GLANCES || hd_interrupt_signal() != 0)
            return false;
        nanosleep(&glance, NULL);
    }
    return true;
}

void hd_temporary_remove_stale(const char *temporary) {
    struct stat found, named;
    int descriptor = open(temporary, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0)
        return;
    /* Another process may have removed it and given its name to a file of its own meanwhile. */
    if (fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) &&
        lock_stale(descriptor, temporary) && lstat(temporary, &named) == 0 &&
        named.st_dev == found.st_dev && named.st_ino == found.st_ino)
        unlink(temporary);
    close(descriptor);
}

/* Of a folder that was there, or of a temporary file. */
static HdStatus fail_without(const char *path, const char *temporary, HdError *error) {
    char folder[HD_MAX_PATH];
    if (access(folder_of(path, folder), F_OK) != 0)
        return hd_fail(error, HD_FAILED,
                       "cannot write %s: its folder %s is gone; it was there before", path, folder);
    return hd_fail(error, HD_FAILED, "cannot write %s: somebody removed %s", path, temporary);
}

static HdStatus fail_to_create(const char *path, const char *temporary, int reason,
                               HdError *error) {
    if (reason == ENOENT && knows_folder(path))
        return fail_without(path, temporary, error);
    return hd_fail(error, HD_FAILED, "cannot write %s: cannot create %s: %s", path, temporary,
                   strerror(reason));
}

HdStatus hd_temporary_create(const char *path, unsigned mode, char temporary[HD_MAX_PATH],
                             int *descriptor, HdError *error) {
    HdStatus status = check_target(path, error);
    if (status == HD_OK && !knows_folder(path))
        status = hd_path_make_parents(path, error);
    if (status == HD_OK)
        status = check_length(path, error);
    /* A process id comes back after a crash, and containers that share a folder repeat them. */
    for (int attempt = 0; status == HD_OK && attempt < MAX_ATTEMPTS; attempt++) {
        status = temporary_name(path, attempt, temporary, error);
        if (status != HD_OK)
            break;
        *descriptor = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (*descriptor >= 0 && lock(*descriptor)) {
            hd_leftovers_add_file(temporary);
            know_folder(path);
            return HD_OK;
        }
        if (*descriptor >= 0)
            close(*descriptor);
        else if (errno != EEXIST)
            return fail_to_create(path, temporary, errno, error);
    }
    if (status != HD_OK)
        return status;
    return hd_fail(error, HD_FAILED, "cannot write %s: all %d temporary names up to %s are taken",
                   path, MAX_ATTEMPTS, temporary);
}

HdStatus hd_temporary_check(const char *temporary, const char *path, HdError *error) {
    if (access(temporary, F_OK) != 0 && errno == ENOENT)
        return fail_without(path, temporary, error);
    return HD_OK;
}

void hd_temporary_remove(const char *temporary) {
    unlink(temporary);
    hd_leftovers_forget_file(temporary);
}

HdStatus hd_temporary_publish(const char *temporary, const char *path, HdError *error) {
    if (rename(temporary, path) == 0) {
        hd_leftovers_forget_file(temporary);
        return HD_OK;
    }
    int reason = errno;
    hd_temporary_remove(temporary);
    if (reason == ENOENT)
        return fail_without(path, temporary, error);
    return hd_fail(error, HD_FAILED, "cannot rename %s to %s: %s", temporary, path,
                   strerror(reason));
}

static HdStatus open_file(HdAtomicFile *file, const char *path, unsigned mode, HdError *error) {
    int descriptor = -1;
    HdStatus status = hd_temporary_create(path, mode, file->temporary, &descriptor, error);
    if (status != HD_OK)
        return status;
    memcpy(file->path, path, strlen(path) + 1);
    file->lock = -1;
    file->stream = fdopen(descriptor, "wb");
    if (file->stream != NULL)
        return HD_OK;
    int reason = errno;
    close(descriptor);
    hd_temporary_remove(file->temporary);
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(reason));
}

HdStatus hd_atomic_file_open(HdAtomicFile *file, const char *path, HdError *error) {
    return open_file(file, path, HD_MODE_USUAL, error);
}

HdStatus hd_atomic_file_open_private(HdAtomicFile *file, const char *path, HdError *error) {
    return open_file(file, path, HD_MODE_PRIVATE, error);
}

static void unlock(HdAtomicFile *file) {
    if (file->lock >= 0)
        close(file->lock);
    file->lock = -1;
}

static void drop(HdAtomicFile *file) {
    hd_temporary_remove(file->temporary);
    unlock(file);
}

/* The stream remembers a write that failed, but not why: one more byte mostly tells. */
static int find_reason(const HdAtomicFile *file) {
    return write(fileno(file->stream), "", 1) < 0 ? errno : EIO;
}

HdStatus hd_atomic_file_close(HdAtomicFile *file, HdError *error) {
    /* Closing may succeed after a write that failed. */
    int reason = ferror(file->stream) ? find_reason(file) : 0;
    file->lock = fcntl(fileno(file->stream), F_DUPFD_CLOEXEC, 0);
    if (file->lock < 0 && reason == 0)
        reason = errno;
    if (fclose(file->stream) != 0 && reason == 0)
        reason = errno;
    file->stream = NULL;
    if (reason == 0)
        return HD_OK;
    drop(file);
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", file->path, strerror(reason));
}

HdStatus hd_atomic_file_sync(HdAtomicFile *file, HdError *error) {
    HdStatus status = hd_sync_file(file->lock, file->path, error);
    if (status != HD_OK)
        drop(file);
    return status;
}

HdStatus hd_atomic_file_publish(HdAtomicFile *file, HdError *error) {
    HdStatus status = hd_temporary_publish(file->temporary, file->path, error);
    unlock(file);
    return status;
}

HdStatus hd_atomic_file_commit(HdAtomicFile *file, HdDurability durability, HdError *error) {
    HdFolderSet synced = {0};
    HdStatus status = hd_atomic_file_close(file, error);
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_atomic_file_sync(file, error);
    if (status == HD_OK)
        status = hd_atomic_file_publish(file, error);
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_sync_folder(&synced, file->path, error);
    return status;
}

void hd_atomic_file_discard(HdAtomicFile *file) {
    if (file->stream == NULL && file->lock < 0)
        return;
    if (file->stream != NULL)
        fclose(file->stream);
    file->stream = NULL;
    drop(file);
}
