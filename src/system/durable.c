/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/durable.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "system/path.h"

/* Neither pipes nor the folders of some file systems can be synced. */
static bool has_disk(int reason) {
    return reason != EINVAL && reason != ENOTSUP && reason != ENOSYS && reason != EROFS;
}

static int sync_descriptor(int descriptor) {
    int code;
    do
        code = fsync(descriptor);
    while (code != 0 && errno == EINTR);
    return code == 0 || !has_disk(errno) ? 0 : errno;
}

static HdStatus fail(const char *path, int reason, HdError *error) {
    return hd_fail(error, HD_FAILED, "cannot write %s to the disk: %s", path, strerror(reason));
}

HdStatus hd_sync_file(int descriptor, const char *path, HdError *error) {
    const int reason = sync_descriptor(descriptor);
    return reason == 0 ? HD_OK : fail(path, reason, error);
}

static HdStatus sync_one(const char *folder, HdError *error) {
    int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return errno == EACCES ? HD_OK : fail(folder, errno, error);
    const int reason = sync_descriptor(descriptor);
    close(descriptor);
    return reason == 0 ? HD_OK : fail(folder, reason, error);
}

/* The folder of `path`, without its last slashes but for the root's; the current one is ".". */
static bool find_folder(const char *path, char folder[HD_MAX_PATH]) {
    size_t length = hd_folder_length(path);
    if (length >= HD_MAX_PATH)
        return false;
    memcpy(folder, path, length);
    while (length > 1 && folder[length - 1] == '/')
        length--;
    if (length == 0)
        folder[length++] = '.';
    folder[length] = '\0';
    return true;
}

static bool is_top(const char *folder) {
    return strcmp(folder, "/") == 0 || strcmp(folder, ".") == 0;
}

HdStatus hd_sync_folder(HdFolderSet *synced, const char *path, HdError *error) {
    char file[HD_MAX_PATH], folder[HD_MAX_PATH];
    HdStatus status = HD_OK;
    bool was_known = false;
    snprintf(file, sizeof file, "%s", path);
    while (status == HD_OK && !was_known && find_folder(file, folder)) {
        was_known = hd_folder_set_has(synced, file) || is_top(folder);
        status = sync_one(folder, error);
        if (status == HD_OK)
            hd_folder_set_add(synced, file);
        memcpy(file, folder, sizeof file);
    }
    return status;
}
