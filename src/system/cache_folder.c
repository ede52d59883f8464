/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/cache_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/low_bytes.h"
#include "system/atomic_file.h"

/* A file holds a checksum of the rest, the key with its terminator, and the payload. If the format
   or the byte order differs, the checksum is wrong. */
enum { CHECKSUM_BYTES = sizeof(uint64_t) };

/* file name extension of entries */
#define EXTENSION ".entry"

/* ---- names ---- */

static HdStatus join(char out[HD_MAX_PATH], const char *folder, const char *name, HdError *error) {
    int length = snprintf(out, HD_MAX_PATH, "%s/%s", folder, name);
    if (length < 0 || length >= HD_MAX_PATH)
        return hd_fail(error, HD_UNAVAILABLE, "the name of the cache folder is too long");
    return HD_OK;
}

HdStatus hd_cache_folder(char folder[HD_MAX_PATH], HdError *error) {
    const char *named = getenv("HEDRON_CACHE");
    const char *caches = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    folder[0] = '\0';
    if (named != NULL && strcmp(named, "off") == 0)
        return hd_fail(error, HD_UNAVAILABLE, "HEDRON_CACHE is off");
    if (named != NULL && named[0] != '\0') {
        int length = snprintf(folder, HD_MAX_PATH, "%s", named);
        return length < HD_MAX_PATH ? HD_OK
                                    : hd_fail(error, HD_UNAVAILABLE, "HEDRON_CACHE is too long");
    }
    if (caches != NULL && caches[0] == '/')
        return join(folder, caches, "hedron", error);
    if (home == NULL || home[0] != '/')
        return hd_fail(
            error, HD_UNAVAILABLE,
            "there is no cache folder, for neither HEDRON_CACHE, XDG_CACHE_HOME nor HOME "
            "names one");
    if (access(home, F_OK) != 0)
        return hd_fail(error, HD_UNAVAILABLE, "there is no home folder %s", home);
    return join(folder, home, ".cache/hedron", error);
}

static HdStatus entry_path(char path[HD_MAX_PATH], char folder[HD_MAX_PATH], const char *kind,
                           const char *key, HdError *error) {
    char name[HD_CACHE_MAX_KIND + 32];
    HD_TRY(hd_cache_folder(folder, error));
    snprintf(name, sizeof name, "%.*s-%016" PRIx64 EXTENSION, (int)HD_CACHE_MAX_KIND, kind,
             hd_hash_bytes(HD_HASH_START, key, strlen(key)));
    return join(path, folder, name, error);
}

/* ---- reading ---- */

/* Returns why others could write to a file or folder, as a phrase after its name; NULL if only this
   user may. */
static const char *find_owner_fault(const struct stat *found) {
    if (found->st_uid != geteuid())
        return "it belongs to another user";
    if ((found->st_mode & (S_IWGRP | S_IWOTH)) != 0)
        return "other users may write to it";
    return NULL;
}

/* Returns HD_UNAVAILABLE if the folder is missing, and HD_FAILED with the reason if others may
   write to it. */
static HdStatus check_folder(const char *folder, HdError *error) {
    struct stat found;
    if (stat(folder, &found) != 0)
        return hd_fail(error, errno == ENOENT || errno == ENOTDIR ? HD_UNAVAILABLE : HD_FAILED,
                       "cannot use the folder %s: %s", folder, strerror(errno));
    const char *fault = S_ISDIR(found.st_mode) ? find_owner_fault(&found) : "it is not a folder";
    return fault == NULL ? HD_OK
                         : hd_fail(error, HD_FAILED, "cannot use the folder %s: %s", folder, fault);
}

/* Returns the fault, or NULL. The caller frees `*file`, also after a fault. */
static const char *read_file(int descriptor, unsigned char **file, size_t *size) {
    struct stat found;
    if (fstat(descriptor, &found) != 0)
        return "its properties cannot be read";
    if (!S_ISREG(found.st_mode))
        return "it is not a regular file";
    const char *fault = find_owner_fault(&found);
    if (fault != NULL)
        return fault;
    if (found.st_size < CHECKSUM_BYTES || found.st_size > HD_CACHE_MAX_ENTRY_BYTES)
        return "its size is wrong";
    *size = (size_t)found.st_size;
    *file = malloc(*size);
    if (*file == NULL)
        return "out of memory";
    const ssize_t done = hd_read_fully(descriptor, *file, *size);
    return done == (ssize_t)*size ? NULL : "it cannot be read";
}

/* Machines of any byte order may share the folder. */
static void write_checksum(unsigned char out[CHECKSUM_BYTES], uint64_t hash) {
    hd_put_low_bytes(out, hash, CHECKSUM_BYTES);
}

/* Moves the payload to the front. Returns the fault, or NULL. */
static const char *extract_payload(unsigned char *file, size_t *size, const char *key) {
    const size_t key_bytes = strlen(key) + 1;
    const unsigned char *content = file + CHECKSUM_BYTES;
    unsigned char checksum[CHECKSUM_BYTES];
    *size -= CHECKSUM_BYTES;
    write_checksum(checksum, hd_hash_bytes(HD_HASH_START, content, *size));
    if (memcmp(file, checksum, CHECKSUM_BYTES) != 0)
        return "its checksum is wrong";
    if (*size < key_bytes || memcmp(content, key, key_bytes) != 0)
        return "it belongs to another key";
    *size -= key_bytes;
    memmove(file, content + key_bytes, *size);
    return NULL;
}

HdStatus hd_cache_get(const char *kind, const char *key, unsigned char **bytes, size_t *size,
                      HdError *error) {
    char path[HD_MAX_PATH], folder[HD_MAX_PATH];
    *bytes = NULL;
    *size = 0;
    HD_TRY(entry_path(path, folder, kind, key, error));
    HD_TRY(check_folder(folder, error));
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR))
        return hd_fail(error, HD_UNAVAILABLE, "%s has no entry for this key", folder);
    if (descriptor < 0)
        return hd_fail(error, HD_FAILED, "%s cannot be used: %s", path, strerror(errno));
    const char *fault = read_file(descriptor, bytes, size);
    if (fault == NULL)
        fault = extract_payload(*bytes, size, key);
    if (fault == NULL)
        futimens(descriptor, NULL); /* marks it as used */
    close(descriptor);
    if (fault == NULL)
        return HD_OK;
    free(*bytes);
    *bytes = NULL;
    return hd_fail(error, HD_FAILED, "%s cannot be used: %s", path, fault);
}

/* ---- limits ---- */

enum { STALE_SECONDS = 3600 };

/* The total size of all entries, and the least recently used one. Entries up to the time `stuck`
   cannot be removed. */
typedef struct Usage {
    int64_t bytes;
    char oldest[256];
    int64_t used, stuck; /* nanoseconds */
} Usage;

static void add_entry(Usage *usage, const char *name, const struct stat *found) {
    const int64_t used = (int64_t)found->st_mtim.tv_sec * 1000000000 + found->st_mtim.tv_nsec;
    usage->bytes += (int64_t)found->st_size;
    if (used <= usage->stuck || (usage->oldest[0] != '\0' && used >= usage->used))
        return;
    snprintf(usage->oldest, sizeof usage->oldest, "%s", name);
    usage->used = used;
}

static void visit_entry(Usage *usage, int folder, const char *name) {
    struct stat found;
    if (fstatat(folder, name, &found, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(found.st_mode))
        return;
    if (hd_path_has_ending(name, EXTENSION))
        add_entry(usage, name, &found);
    else if (strstr(name, EXTENSION ".tmp-") != NULL &&
             time(NULL) - found.st_mtim.tv_sec > STALE_SECONDS)
        unlinkat(folder, name, 0);
}

void hd_cache_limit(const char *folder, int64_t max_bytes) {
    DIR *stream = opendir(folder);
    Usage usage = {0};
    bool is_over = stream != NULL;
    while (is_over) {
        usage = (Usage){.stuck = usage.stuck};
        rewinddir(stream);
        for (const struct dirent *found = readdir(stream); found != NULL; found = readdir(stream))
            visit_entry(&usage, dirfd(stream), found->d_name);
        is_over = usage.bytes > max_bytes && usage.oldest[0] != '\0';
        if (is_over && unlinkat(dirfd(stream), usage.oldest, 0) != 0 && errno != ENOENT)
            usage.stuck = usage.used;
    }
    if (stream != NULL)
        closedir(stream);
}

/* ---- writing ---- */

static HdStatus make_folder(const char *folder, HdError *error) {
    char below[HD_MAX_PATH];
    snprintf(below, sizeof below, "%s", folder);
    for (char *slash = strchr(below + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(below, 0700);
        *slash = '/';
    }
    if (mkdir(folder, 0700) != 0 && errno != EEXIST)
        return hd_fail(error, HD_FAILED, "cannot make the folder %s: %s", folder, strerror(errno));
    return HD_OK;
}

static HdStatus write_entry(const char *path, const char *key, const void *bytes, size_t size,
                            HdError *error) {
    const size_t key_bytes = strlen(key) + 1;
    unsigned char checksum[CHECKSUM_BYTES];
    write_checksum(checksum,
                   hd_hash_bytes(hd_hash_bytes(HD_HASH_START, key, key_bytes), bytes, size));
    HdAtomicFile file;
    HD_TRY(hd_atomic_file_open_private(&file, path, error));
    fwrite(checksum, 1, CHECKSUM_BYTES, file.stream); /* errors show when committing */
    fwrite(key, 1, key_bytes, file.stream);
    fwrite(bytes, 1, size, file.stream);
    return hd_atomic_file_commit(&file, HD_WITHOUT_SYNC, error);
}

HdStatus hd_cache_put(const char *kind, const char *key, const void *bytes, size_t size,
                      HdError *error) {
    char path[HD_MAX_PATH], folder[HD_MAX_PATH];
    HD_TRY(entry_path(path, folder, kind, key, error));
    if (size > HD_CACHE_MAX_ENTRY_BYTES - CHECKSUM_BYTES - strlen(key) - 1)
        return hd_fail(error, HD_FAILED,
                       "a cache entry of %zu bytes is too large, expected at most %d", size,
                       (int)HD_CACHE_MAX_ENTRY_BYTES);
    HD_TRY(make_folder(folder, error));
    HD_TRY(check_folder(folder, error));
    HD_TRY(write_entry(path, key, bytes, size, error));
    hd_cache_limit(folder, HD_CACHE_MAX_BYTES);
    return HD_OK;
}

/* ---- texts ---- */

HdStatus hd_cache_get_text(const char *kind, const char *key, char *text, size_t capacity,
                           HdError *error) {
    unsigned char *bytes;
    size_t size;
    const HdStatus status = hd_cache_get(kind, key, &bytes, &size, error);
    text[0] = '\0';
    if (bytes == NULL)
        return status;
    const bool is_text = size < capacity && memchr(bytes, '\0', size) == NULL;
    if (is_text)
        snprintf(text, capacity, "%.*s", (int)size, (const char *)bytes);
    free(bytes);
    if (is_text)
        return HD_OK;
    return hd_fail(error, HD_FAILED, "the cached entry of %zu bytes is not a text of kind %s", size,
                   kind);
}

HdStatus hd_cache_put_text(const char *kind, const char *key, const char *text, HdError *error) {
    return hd_cache_put(kind, key, text, strlen(text), error);
}
