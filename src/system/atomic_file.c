/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* flock */

#include "system/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "system/interrupt.h"

enum { MAX_ATTEMPTS = 1000 };

/* Permissions of a file, from its first instant on, less what the umask takes. */
enum { MODE_USUAL = 0666, MODE_PRIVATE = 0600 };

/* Between the name and the numbers. */
#define MARK ".tmp-"

/* The folder of `path`, without its last slashes but for the root's; the current one is ".". */
static const char *folder_of(const char *path, char folder[HD_MAX_PATH]) {
    size_t length = hd_folder_length(path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    snprintf(folder, HD_MAX_PATH, "%.*s", length > 0 ? (int)length : 1, length > 0 ? path : ".");
    return folder;
}

/* ---- folders of the run ---- */

/* As many as a run has outputs, with those above them, and more. A sequence whose folders are
   numbered has countless ones, but it asks for each but once. */
enum { MAX_FOLDERS = 64 };

/* A folder that this run wrote to: where it goes away it is missed, instead of made anew without
   what was in it. */
typedef struct Folder {
    uint64_t hash;  /* of its name; 0: none */
    bool is_synced; /* and so are those above it */
} Folder;

/* Beyond the room the oldest are forgotten. */
static struct {
    pthread_mutex_t mutex;
    int next;
    Folder list[MAX_FOLDERS];
} known = {.mutex = PTHREAD_MUTEX_INITIALIZER};

static Folder *find_folder(uint64_t hash) {
    for (int i = 0; i < MAX_FOLDERS; i++)
        if (known.list[i].hash == hash)
            return &known.list[i];
    return NULL;
}

static uint64_t folder_hash(const char *path) {
    return hd_hash_bytes(HD_HASH_START, path, hd_folder_length(path));
}

/* What is known of the folder of the file `path`; all zero: nothing. */
static Folder folder_known(const char *path) {
    pthread_mutex_lock(&known.mutex);
    const Folder *found = find_folder(folder_hash(path));
    const Folder folder = found != NULL ? *found : (Folder){0};
    pthread_mutex_unlock(&known.mutex);
    return folder;
}

static void know_folder(const char *path, bool is_synced) {
    const uint64_t hash = folder_hash(path);
    pthread_mutex_lock(&known.mutex);
    Folder *found = find_folder(hash);
    if (found == NULL) {
        found = &known.list[known.next];
        *found = (Folder){.hash = hash};
        known.next = (known.next + 1) % MAX_FOLDERS;
    }
    found->is_synced |= is_synced;
    pthread_mutex_unlock(&known.mutex);
}

void hd_known_folders_forget(void) {
    pthread_mutex_lock(&known.mutex);
    memset(known.list, 0, sizeof known.list);
    pthread_mutex_unlock(&known.mutex);
}

/* ---- the disk ---- */

/* Neither pipes nor the folders of some file systems can be synced. */
static bool has_disk(int reason) {
    return reason != EINVAL && reason != ENOTSUP && reason != ENOSYS && reason != EROFS;
}

static HdStatus fail_to_sync(const char *path, int reason, HdError *error) {
    return hd_fail(error, HD_FAILED, "cannot write %s to the disk: %s", path, strerror(reason));
}

HdStatus hd_sync_file(int descriptor, const char *path, HdError *error) {
    int code;
    do
        code = fsync(descriptor);
    while (code != 0 && errno == EINTR);
    return code == 0 || !has_disk(errno) ? HD_OK : fail_to_sync(path, errno, error);
}

static HdStatus sync_one(const char *folder, HdError *error) {
    int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return errno == EACCES ? HD_OK : fail_to_sync(folder, errno, error);
    const HdStatus status = hd_sync_file(descriptor, folder, error);
    close(descriptor);
    return status;
}

static bool is_top(const char *folder) {
    return strcmp(folder, "/") == 0 || strcmp(folder, ".") == 0;
}

HdStatus hd_sync_folder(const char *path, HdError *error) {
    char file[HD_MAX_PATH], folder[HD_MAX_PATH];
    HdStatus status = HD_OK;
    bool was_synced = false;
    snprintf(file, sizeof file, "%s", path);
    while (status == HD_OK && !was_synced) {
        was_synced = is_top(folder_of(file, folder)) || folder_known(file).is_synced;
        status = sync_one(folder, error);
        if (status == HD_OK)
            know_folder(file, true);
        memcpy(file, folder, sizeof file);
    }
    return status;
}

/* ---- names ---- */

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

/* ---- what killed programs left ---- */

/* Whether the process that the name tells is gone, as far as this machine knows. */
static bool writer_is_gone(const char *temporary) {
    const char *numbers = temporary + hd_folder_length(temporary);
    numbers += hd_temporary_name_length(numbers) + strlen(MARK);
    return kill((pid_t)strtol(numbers, NULL, 10), 0) != 0 && errno == ESRCH;
}

bool hd_temporary_remove_stale(const char *temporary) {
    struct stat found, named;
    bool is_done = true;
    int descriptor = open(temporary, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0)
        return true;
    if (fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode))
        is_done = true;
    else if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        is_done = errno != EWOULDBLOCK || !writer_is_gone(temporary);
    /* Another process may have removed it and given its name to a file of its own meanwhile. */
    else if (lstat(temporary, &named) == 0 && named.st_dev == found.st_dev &&
             named.st_ino == found.st_ino)
        unlink(temporary);
    close(descriptor);
    return is_done;
}

/* ---- a file ---- */

/* Of a folder that was there, or of a temporary file. */
static HdStatus fail_without(const char *path, const char *temporary, HdError *error) {
    char folder[HD_MAX_PATH];
    const int length = (int)hd_folder_length(path);
    snprintf(folder, sizeof folder, "%.*s", length > 0 ? length : 1, length > 0 ? path : ".");
    if (access(folder, F_OK) != 0)
        return hd_fail(error, HD_FAILED,
                       "cannot write %s: its folder %s is gone; it was there before", path, folder);
    return hd_fail(error, HD_FAILED, "cannot write %s: somebody removed %s", path, temporary);
}

static HdStatus fail_to_create(const HdAtomicFile *file, int reason, HdError *error) {
    if (reason == ENOENT && folder_known(file->path).hash != 0)
        return fail_without(file->path, file->temporary, error);
    return hd_fail(error, HD_FAILED, "cannot write %s: cannot create %s: %s", file->path,
                   file->temporary, strerror(reason));
}

/* Between its making and its locking the file looks like one that was left behind. Where a file
   system has no locks, none can be held, and nothing is removed. */
static bool lock(int descriptor) {
    struct stat found;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return false;
    return fstat(descriptor, &found) != 0 || found.st_nlink > 0;
}

/* Under the first temporary name that is free. A process id comes back after a crash, and
   containers that share a folder repeat them. */
static HdStatus create(HdAtomicFile *file, unsigned mode, HdError *error) {
    for (int attempt = 0; attempt < MAX_ATTEMPTS; attempt++) {
        const HdStatus status = temporary_name(file->path, attempt, file->temporary, error);
        if (status != HD_OK)
            return status;
        const int descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor < 0 && errno != EEXIST)
            return fail_to_create(file, errno, error);
        if (descriptor >= 0 && lock(descriptor)) {
            file->lock = descriptor;
            return HD_OK;
        }
        if (descriptor >= 0)
            close(descriptor);
    }
    return hd_fail(error, HD_FAILED, "cannot write %s: all %d temporary names up to %s are taken",
                   file->path, MAX_ATTEMPTS, file->temporary);
}

static HdStatus reserve(HdAtomicFile *file, const char *path, unsigned mode, HdError *error) {
    file->stream = NULL;
    file->lock = -1;
    HdStatus status = check_target(path, error);
    if (status == HD_OK && folder_known(path).hash == 0)
        status = hd_path_make_parents(path, 0777, error);
    if (status == HD_OK)
        status = check_length(path, error);
    if (status != HD_OK)
        return status;
    memcpy(file->path, path, strlen(path) + 1);
    status = create(file, mode, error);
    if (status == HD_OK) {
        hd_leftovers_add_file(file->temporary);
        know_folder(path, false);
    }
    return status;
}

HdStatus hd_atomic_file_reserve(HdAtomicFile *file, const char *path, HdError *error) {
    return reserve(file, path, MODE_USUAL, error);
}

static HdStatus open_file(HdAtomicFile *file, const char *path, unsigned mode, HdError *error) {
    HdStatus status = reserve(file, path, mode, error);
    if (status != HD_OK)
        return status;
    file->stream = fdopen(file->lock, "wb");
    if (file->stream != NULL) {
        file->lock = -1;
        return HD_OK;
    }
    const int reason = errno;
    hd_atomic_file_discard(file);
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(reason));
}

HdStatus hd_atomic_file_open(HdAtomicFile *file, const char *path, HdError *error) {
    return open_file(file, path, MODE_USUAL, error);
}

HdStatus hd_atomic_file_open_private(HdAtomicFile *file, const char *path, HdError *error) {
    return open_file(file, path, MODE_PRIVATE, error);
}

HdStatus hd_atomic_file_check(const HdAtomicFile *file, HdError *error) {
    if (access(file->temporary, F_OK) != 0 && errno == ENOENT)
        return fail_without(file->path, file->temporary, error);
    return HD_OK;
}

static void unlock(HdAtomicFile *file) {
    if (file->lock >= 0)
        close(file->lock);
    file->lock = -1;
}

static void drop(HdAtomicFile *file) {
    unlink(file->temporary);
    hd_leftovers_forget_file(file->temporary);
    unlock(file);
}

/* The stream remembers a write that failed, but not why: one more byte mostly tells. */
static int find_reason(const HdAtomicFile *file) {
    return write(fileno(file->stream), "", 1) < 0 ? errno : EIO;
}

HdStatus hd_atomic_file_close(HdAtomicFile *file, HdError *error) {
    if (file->stream == NULL)
        return HD_OK;
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

/* By its name, for another program may have put a file of its own in the place of ours. */
static HdStatus sync_named(const HdAtomicFile *file, HdError *error) {
    const int descriptor = open(file->temporary, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT)
        return fail_without(file->path, file->temporary, error);
    const HdStatus status =
        hd_sync_file(descriptor >= 0 ? descriptor : file->lock, file->path, error);
    if (descriptor >= 0)
        close(descriptor);
    return status;
}

HdStatus hd_atomic_file_sync(HdAtomicFile *file, HdError *error) {
    HdStatus status = sync_named(file, error);
    if (status != HD_OK)
        drop(file);
    return status;
}

HdStatus hd_atomic_file_publish(HdAtomicFile *file, HdError *error) {
    if (rename(file->temporary, file->path) == 0) {
        hd_leftovers_forget_file(file->temporary);
        unlock(file);
        return HD_OK;
    }
    const int reason = errno;
    drop(file);
    if (reason == ENOENT)
        return fail_without(file->path, file->temporary, error);
    return hd_fail(error, HD_FAILED, "cannot rename %s to %s: %s", file->temporary, file->path,
                   strerror(reason));
}

HdStatus hd_atomic_file_commit(HdAtomicFile *file, HdDurability durability, HdError *error) {
    HdStatus status = hd_atomic_file_close(file, error);
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_atomic_file_sync(file, error);
    if (status == HD_OK)
        status = hd_atomic_file_publish(file, error);
    if (status == HD_OK && durability == HD_DURABLE)
        status = hd_sync_folder(file->path, error);
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
