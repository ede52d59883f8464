/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "system/file_bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct File {
    const char *path, *what;
    int descriptor;
} File;

static HdStatus fail_reading(const File *file, HdError *error) {
    return hd_fail(error, HD_BAD_INPUT, "cannot read the %s %s: %s", file->what, file->path,
                   strerror(errno));
}

static HdStatus check_file(const File *file, int64_t most, size_t *size, HdError *error) {
    struct stat found;
    if (fstat(file->descriptor, &found) != 0)
        return fail_reading(file, error);
    if (!S_ISREG(found.st_mode))
        return hd_fail(error, HD_BAD_INPUT, "cannot read the %s %s: it is not a regular file",
                       file->what, file->path);
    if (found.st_size > most || (uintmax_t)found.st_size >= SIZE_MAX)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot read the %s %s: it has %lld bytes, expected at most %lld",
                       file->what, file->path, (long long)found.st_size, (long long)most);
    *size = (size_t)found.st_size;
    return HD_OK;
}

ssize_t hd_read_fully(int descriptor, void *bytes, size_t size) {
    size_t done = 0;
    while (done < size) {
        const ssize_t count = read(descriptor, (char *)bytes + done, size - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return -1;
        if (count == 0)
            break;
        done += (size_t)count;
    }
    return (ssize_t)done;
}

static HdStatus read_file(const File *file, unsigned char **bytes, size_t size, HdError *error) {
    *bytes = malloc(size + 1);
    if (*bytes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the %zu bytes of the %s %s",
                       size, file->what, file->path);
    const ssize_t done = hd_read_fully(file->descriptor, *bytes, size);
    if (done == (ssize_t)size)
        return HD_OK;
    const HdStatus status =
        done < 0
            ? fail_reading(file, error)
            : hd_fail(error, HD_BAD_INPUT, "cannot read the %s %s: it ended after %zd of %zu bytes",
                      file->what, file->path, done, size);
    free(*bytes);
    *bytes = NULL;
    return status;
}

HdStatus hd_file_read(const char *path, const char *what, int64_t most, unsigned char **bytes,
                      size_t *size, HdError *error) {
    /* Not blocking, lest a named pipe stops the program before it is refused. */
    const File file = {path, what, open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    *bytes = NULL;
    if (file.descriptor < 0)
        return fail_reading(&file, error);
    HdStatus status = check_file(&file, most, size, error);
    if (status == HD_OK)
        status = read_file(&file, bytes, *size, error);
    close(file.descriptor);
    return status;
}
