/* SPDX-License-Identifier: MIT */
/* Preloaded, a disk whose syncing is watched and fails. SYNC_LOG names a file that gets a line for
   each call: "sync FILE", "folder FOLDER", "rename FROM TO". SYNC_FAIL=N: the call number N of
   fsync(), counted from 1, and all later ones fail with an input/output error. SYNC_KILL=N: the
   program dies before its Nth sync of a folder. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef int Sync(int descriptor);
typedef int Rename(const char *from, const char *to);

static atomic_int syncs, folder_syncs;

static bool is_number(const char *variable, int number) {
    const char *text = getenv(variable);
    return text != NULL && number >= atoi(text);
}

static void tell(const char *what, const char *first, const char *second) {
    char line[3 * PATH_MAX];
    const char *name = getenv("SYNC_LOG");
    if (name == NULL)
        return;
    const int length = snprintf(line, sizeof line, "%s %s%s%s\n", what, first,
                                second[0] != '\0' ? " " : "", second);
    int log = open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (log < 0 || write(log, line, (size_t)length) != length)
        abort();
    close(log);
}

int fsync(int descriptor) {
    char link[64], path[PATH_MAX] = "";
    struct stat found;
    void *next = dlsym(RTLD_NEXT, "fsync");
    Sync *real;
    memcpy(&real, &next, sizeof real);
    const bool is_folder = fstat(descriptor, &found) == 0 && S_ISDIR(found.st_mode);
    if (is_number("SYNC_FAIL", 1 + atomic_fetch_add(&syncs, 1))) {
        errno = EIO;
        return -1;
    }
    if (is_folder && is_number("SYNC_KILL", 1 + atomic_fetch_add(&folder_syncs, 1)))
        raise(SIGKILL);
    const int code = real(descriptor);
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    if (readlink(link, path, sizeof path - 1) > 0)
        tell(is_folder ? "folder" : "sync", path, "");
    return code;
}

int rename(const char *from, const char *to) {
    char folder[PATH_MAX];
    void *next = dlsym(RTLD_NEXT, "rename");
    Rename *real;
    memcpy(&real, &next, sizeof real);
    if (realpath(from, folder) == NULL)
        folder[0] = '\0';
    const int code = real(from, to);
    tell("rename", folder, to);
    return code;
}
