/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/cache_trust.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "system/atomic_file.h"
#include "system/file_bytes.h"

const char *hd_cache_find_fault(const struct stat *found) {
    if (found->st_uid != geteuid())
        return "it belongs to another user";
    if ((found->st_mode & (S_IWGRP | S_IWOTH)) != 0)
        return "other users may write to it";
    return NULL;
}

HdStatus hd_cache_check_folder(const char *folder, HdError *error) {
    struct stat found;
    if (stat(folder, &found) != 0)
        return hd_fail(error, errno == ENOENT || errno == ENOTDIR ? HD_UNAVAILABLE : HD_FAILED,
                       "cannot use the folder %s: %s", folder, strerror(errno));
    const char *fault = S_ISDIR(found.st_mode) ? hd_cache_find_fault(&found) : "it is not a folder";
    return fault == NULL ? HD_OK
                         : hd_fail(error, HD_FAILED, "cannot use the folder %s: %s", folder, fault);
}

/* ---- the key ---- */

static const char *read_open_key(int descriptor, unsigned char key[HD_HASH_KEY_BYTES]) {
    struct stat found;
    if (fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode))
        return "it is not a regular file";
    const char *fault = hd_cache_find_fault(&found);
    if (fault != NULL)
        return fault;
    if ((found.st_mode & (S_IRGRP | S_IROTH)) != 0)
        return "other users may read it";
    if (found.st_size != HD_HASH_KEY_BYTES ||
        hd_read_fully(descriptor, key, HD_HASH_KEY_BYTES) != HD_HASH_KEY_BYTES)
        return "its size is wrong";
    return NULL;
}

/* HD_UNAVAILABLE: there is none, or nobody can tell. */
static HdStatus read_key(const char *path, unsigned char key[HD_HASH_KEY_BYTES], HdError *error) {
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    const bool tells_nothing =
        descriptor < 0 && (errno == ENOENT || errno == EMFILE || errno == ENFILE);
    const HdStatus failure = tells_nothing ? HD_UNAVAILABLE : HD_FAILED;
    const char *fault = descriptor < 0 ? strerror(errno) : read_open_key(descriptor, key);
    if (descriptor >= 0)
        close(descriptor);
    return fault == NULL ? HD_OK
                         : hd_fail(error, failure, "the key %s cannot be used: %s", path, fault);
}

static HdStatus take_random_bytes(unsigned char *bytes, size_t size, HdError *error) {
    int source = open("/dev/urandom", O_RDONLY | O_CLOEXEC);
    const bool taken = hd_read_fully(source, bytes, size) == (ssize_t)size;
    if (source >= 0)
        close(source);
    return taken ? HD_OK : hd_fail(error, HD_FAILED, "there are no random bytes for a key");
}

/* One that another process makes meanwhile is not replaced: entries may have been made with it. */
static HdStatus make_key(const char *path, HdError *error) {
    unsigned char key[HD_HASH_KEY_BYTES];
    HdAtomicFile file;
    HdStatus status = take_random_bytes(key, sizeof key, error);
    if (status == HD_OK)
        status = hd_atomic_file_open_private(&file, path, error);
    if (status != HD_OK)
        return status;
    fwrite(key, 1, sizeof key, file.stream); /* closing finds what fails */
    status = hd_atomic_file_close(&file, error);
    if (status == HD_OK && link(file.temporary, path) != 0 && errno != EEXIST)
        return hd_atomic_file_publish(&file, error); /* where there are no second names */
    hd_atomic_file_discard(&file);
    return status;
}

HdStatus hd_cache_key(const char *folder, bool may_make, unsigned char key[HD_HASH_KEY_BYTES],
                      HdError *error) {
    char path[HD_MAX_PATH];
    const int length = snprintf(path, sizeof path, "%s/" HD_CACHE_KEY_NAME, folder);
    if (length < 0 || length >= HD_MAX_PATH)
        return hd_fail(error, HD_FAILED, "the name of the cache folder is too long");
    HdStatus status = read_key(path, key, error);
    if (status == HD_OK || !may_make)
        return status;
    if (status == HD_FAILED) /* where there was none may be another process's by now */
        unlink(path);
    status = make_key(path, error);
    return status == HD_OK ? read_key(path, key, error) : status;
}
