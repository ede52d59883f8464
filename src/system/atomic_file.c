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

/* permissions of a new file, before the umask */
enum { MODE_USUAL = 0666, MODE_PRIVATE = 0600 };

/* separator of the final name and the numbers */
#define SEPARATOR ".tmp-"

/* Returns the folder of `path` without trailing slashes: "." for the current one, "/" for the
   root. */
static const char *folder_of(const char *path, char folder[HD_MAX_PATH]) {
    size_t length = hd_folder_length(path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    snprintf(folder, HD_MAX_PATH, "%.*s", length > 0 ? (int)length : 1, length > 0 ? path : ".");
    return folder;
}

/* ---- folders of the run ---- */

/* Holds more folders than a run's outputs need, parents included. A sequence with numbered folders
   has arbitrarily many, but looks up each only once. */
enum { MAX_FOLDERS = 64 };

/* SYNCED: the folders above it are synced too */
typedef enum FolderState { UNKNOWN, EXISTS, SYNCED } FolderState;

/* A folder that this run wrote to. If it disappears, with its contents, the run fails. */
typedef struct Folder {
    uint64_t hash; /* hash of its name */
    FolderState state;
} Folder;

/* ring buffer: a new folder replaces the oldest */
static struct {
    pthread_mutex_t mutex;
    unsigned next;
    Folder list[MAX_FOLDERS];
} known = {.mutex = PTHREAD_MUTEX_INITIALIZER};

/* Returns what is known about the folder of the file `path`, and raises it to `more`. */
static FolderState update_folder_state(const char *path, FolderState more) {
    const uint64_t hash = hd_hash_bytes(HD_HASH_START, path, hd_folder_length(path));
    unsigned i = 0;
    pthread_mutex_lock(&known.mutex);
    while (i < MAX_FOLDERS && (known.list[i].state == UNKNOWN || known.list[i].hash != hash))
        i++;
    const FolderState before = i < MAX_FOLDERS ? known.list[i].state : UNKNOWN;
    if (more > before)
        known.list[i < MAX_FOLDERS ? i : known.next++ % MAX_FOLDERS] = (Folder){hash, more};
    pthread_mutex_unlock(&known.mutex);
    return before;
}

void hd_known_folders_forget(void) {
    pthread_mutex_lock(&known.mutex);
    memset(known.list, 0, sizeof known.list);
    pthread_mutex_unlock(&known.mutex);
}

/* ---- the disk ---- */

#define CANNOT_SYNC "cannot write %s to the disk: %s"

/* Returns whether a failed sync matters: pipes and the folders of some file systems cannot be
   synced. */
static bool is_disk_error(int reason) {
    return reason != EINVAL && reason != ENOTSUP && reason != ENOSYS && reason != EROFS;
}

HdStatus hd_sync_file(int descriptor, const char *path, HdError *error) {
    int code;
    do
        code = fsync(descriptor);
    while (code != 0 && errno == EINTR);
    if (code == 0 || !is_disk_error(errno))
        return HD_OK;
    return hd_fail(error, HD_FAILED, CANNOT_SYNC, path, strerror(errno));
}

static HdStatus sync_one(const char *folder, HdError *error) {
    int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0 && errno == EACCES)
        return HD_OK;
    if (descriptor < 0)
        return hd_fail(error, HD_FAILED, CANNOT_SYNC, folder, strerror(errno));
    const HdStatus status = hd_sync_file(descriptor, folder, error);
    close(descriptor);
    return status;
}

HdStatus hd_sync_folder(const char *path, HdError *error) {
    char file[HD_MAX_PATH], folder[HD_MAX_PATH];
    bool is_last = false;
    snprintf(file, sizeof file, "%s", path);
    while (!is_last) {
        folder_of(file, folder);
        HD_TRY(sync_one(folder, error));
        is_last = update_folder_state(file, SYNCED) == SYNCED || strcmp(folder, "/") == 0 ||
                  strcmp(folder, ".") == 0;
        memcpy(file, folder, sizeof file);
    }
    return HD_OK;
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

/* Cuts the name because many file systems allow 255 bytes, suffix included. */
static HdStatus temporary_name(const char *path, int attempt, char temporary[HD_MAX_PATH],
                               HdError *error) {
    int folder = (int)hd_folder_length(path);
    int length = snprintf(temporary, HD_MAX_PATH, "%.*s%.*s" SEPARATOR "%ld-%d", folder, path,
                          HD_TEMPORARY_MAX_KEPT, path + folder, (long)getpid(), attempt);
    if (length < 0 || length >= HD_MAX_PATH)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write %s: its temporary name has %d bytes, expected fewer than %d",
                       path, length, HD_MAX_PATH);
    return HD_OK;
}

/* Checks the final name early: the temporary one is cut, so only renaming would fail. */
static HdStatus check_length(const char *path, HdError *error) {
    const size_t length = strlen(path + hd_folder_length(path));
    char folder[HD_MAX_PATH];
    long max_length = pathconf(folder_of(path, folder), _PC_NAME_MAX);
    if (max_length > 0 && length > (size_t)max_length)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write \"%s\": the name of the file has %zu bytes, expected at most "
                       "%ld",
                       path, length, max_length);
    return HD_OK;
}

size_t hd_temporary_name_length(const char *name) {
    const char *found = NULL;
    int end = 0;
    for (const char *next = strstr(name, SEPARATOR); next != NULL;
         next = strstr(next + 1, SEPARATOR))
        found = next;
    if (found == NULL || sscanf(found, SEPARATOR "%*[0-9]-%*[0-9]%n", &end) != 0 || end == 0)
        return 0;
    return found[end] == '\0' ? (size_t)(found - name) : 0;
}

/* ---- stale files of killed programs ---- */

/* Returns whether the process in the file name has ended, as far as this machine knows. */
static bool writer_has_ended(const char *temporary) {
    const char *numbers = temporary + hd_folder_length(temporary);
    numbers += hd_temporary_name_length(numbers) + strlen(SEPARATOR);
    return kill((pid_t)strtol(numbers, NULL, 10), 0) != 0 && errno == ESRCH;
}

bool hd_temporary_remove_stale(const char *temporary) {
    struct stat found, named;
    bool is_done = true;
    const int descriptor = open(temporary, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0)
        return true;
    const bool is_file = fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
    if (is_file && flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        is_done = errno != EWOULDBLOCK || !writer_has_ended(temporary);
    /* Another process may have removed the file and reused its name. */
    else if (is_file && lstat(temporary, &named) == 0 && named.st_dev == found.st_dev &&
             named.st_ino == found.st_ino)
        unlink(temporary);
    close(descriptor);
    return is_done;
}

/* ---- a file ---- */

/* Reports that the folder, which existed earlier, or the temporary file is missing. */
static HdStatus fail_missing(const HdAtomicFile *file, HdError *error) {
    char folder[HD_MAX_PATH];
    const int length = (int)hd_folder_length(file->path);
    snprintf(folder, sizeof folder, "%.*s", length > 0 ? length : 1, length > 0 ? file->path : ".");
    if (access(folder, F_OK) != 0)
        return hd_fail(error, HD_FAILED,
                       "cannot write %s: its folder %s was removed during the run", file->path,
                       folder);
    return hd_fail(error, HD_FAILED, "cannot write %s: somebody removed %s", file->path,
                   file->temporary);
}

/* Locks the file. False if it was removed as stale before. Without locks in the file system nobody
   holds one, and nothing is removed. */
static bool lock(int descriptor) {
    struct stat found;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return false;
    return fstat(descriptor, &found) != 0 || found.st_nlink > 0;
}

/* Creates the file under the first free name. A process id is reused after a crash and by
   containers that share a folder. */
static HdStatus create(HdAtomicFile *file, unsigned mode, HdError *error) {
    for (int attempt = 0; attempt < MAX_ATTEMPTS; attempt++) {
        HD_TRY(temporary_name(file->path, attempt, file->temporary, error));
        const int descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        const int reason = errno;
        if (descriptor < 0 && reason == ENOENT &&
            update_folder_state(file->path, UNKNOWN) != UNKNOWN)
            return fail_missing(file, error);
        if (descriptor < 0 && reason != EEXIST)
            return hd_fail(error, HD_FAILED, "cannot write %s: cannot create %s: %s", file->path,
                           file->temporary, strerror(reason));
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
    HD_TRY(check_target(path, error));
    if (update_folder_state(path, UNKNOWN) == UNKNOWN)
        HD_TRY(hd_path_make_parents(path, 0777, error));
    HD_TRY(check_length(path, error));
    memcpy(file->path, path, strlen(path) + 1);
    HD_TRY(create(file, mode, error));
    hd_cleanup_add_file(file->temporary);
    update_folder_state(path, EXISTS);
    return HD_OK;
}

HdStatus hd_atomic_file_reserve(HdAtomicFile *file, const char *path, HdError *error) {
    return reserve(file, path, MODE_USUAL, error);
}

static HdStatus open_file(HdAtomicFile *file, const char *path, unsigned mode, HdError *error) {
    HD_TRY(reserve(file, path, mode, error));
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
        return fail_missing(file, error);
    return HD_OK;
}

/* Unlocks the file and forgets its temporary name, which no longer exists. */
static void unlock_temporary(HdAtomicFile *file) {
    hd_cleanup_forget_file(file->temporary);
    if (file->lock >= 0)
        close(file->lock);
    file->lock = -1;
}

static void remove_temporary(HdAtomicFile *file) {
    unlink(file->temporary);
    unlock_temporary(file);
}

HdStatus hd_atomic_file_close(HdAtomicFile *file, HdError *error) {
    if (file->stream == NULL)
        return HD_OK;
    int reason = 0;
    /* The stream remembers a failed write without its reason; writing one more byte usually shows
       it. */
    if (ferror(file->stream))
        reason = write(fileno(file->stream), "", 1) < 0 ? errno : EIO;
    file->lock = fcntl(fileno(file->stream), F_DUPFD_CLOEXEC, 0);
    if (file->lock < 0 && reason == 0)
        reason = errno;
    if (fclose(file->stream) != 0 && reason == 0)
        reason = errno;
    file->stream = NULL;
    if (reason == 0)
        return HD_OK;
    remove_temporary(file);
    return hd_fail(error, HD_FAILED, "cannot write %s: %s", file->path, strerror(reason));
}

/* Syncs by name: another program may have replaced the file. */
static HdStatus sync_named(const HdAtomicFile *file, HdError *error) {
    const int descriptor = open(file->temporary, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT)
        return fail_missing(file, error);
    const HdStatus status =
        hd_sync_file(descriptor >= 0 ? descriptor : file->lock, file->path, error);
    if (descriptor >= 0)
        close(descriptor);
    return status;
}

HdStatus hd_atomic_file_sync(HdAtomicFile *file, HdError *error) {
    const HdStatus status = sync_named(file, error);
    if (status != HD_OK)
        remove_temporary(file);
    return status;
}

HdStatus hd_atomic_file_publish(HdAtomicFile *file, HdError *error) {
    if (rename(file->temporary, file->path) == 0) {
        unlock_temporary(file);
        return HD_OK;
    }
    const int reason = errno;
    remove_temporary(file);
    if (reason == ENOENT)
        return fail_missing(file, error);
    return hd_fail(error, HD_FAILED, "cannot rename %s to %s: %s", file->temporary, file->path,
                   strerror(reason));
}

HdStatus hd_atomic_file_commit(HdAtomicFile *file, HdDurability durability, HdError *error) {
    HD_TRY(hd_atomic_file_close(file, error));
    if (durability == HD_DURABLE)
        HD_TRY(hd_atomic_file_sync(file, error));
    HD_TRY(hd_atomic_file_publish(file, error));
    return durability == HD_DURABLE ? hd_sync_folder(file->path, error) : HD_OK;
}

void hd_atomic_file_discard(HdAtomicFile *file) {
    if (file->stream == NULL && file->lock < 0)
        return;
    if (file->stream != NULL)
        fclose(file->stream);
    file->stream = NULL;
    remove_temporary(file);
}
