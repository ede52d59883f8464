/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/cache_limit.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/growth.h"

enum { STALE_SECONDS = 3600 };

typedef struct Entry {
    char name[256];
    int64_t bytes;
    struct timespec used;
} Entry;

typedef struct Listing {
    Entry *entries;
    int count, room;
    int64_t bytes;
} Listing;

static bool ends_in(const char *name, const char *ending) {
    size_t length = strlen(name), tail = strlen(ending);
    return length >= tail && strcmp(name + length - tail, ending) == 0;
}

static void add(Listing *listing, const char *name, const struct stat *found) {
    Entry entry = {.bytes = (int64_t)found->st_size, .used = found->st_mtim};
    if (strlen(name) >= sizeof entry.name)
        return;
    memcpy(entry.name, name, strlen(name) + 1);
    if (hd_append(&listing->entries, sizeof entry, &listing->count, &listing->room, &entry))
        listing->bytes += entry.bytes;
}

static void look_at(Listing *listing, int folder, const char *name) {
    struct stat found;
    if (fstatat(folder, name, &found, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(found.st_mode))
        return;
    if (ends_in(name, HD_CACHE_ENDING))
        add(listing, name, &found);
    else if (strstr(name, HD_CACHE_ENDING ".tmp-") != NULL &&
             time(NULL) - found.st_mtim.tv_sec > STALE_SECONDS)
        unlinkat(folder, name, 0);
}

static int by_use(const void *first, const void *second) {
    const struct timespec *a = &((const Entry *)first)->used, *b = &((const Entry *)second)->used;
    if (a->tv_sec != b->tv_sec)
        return a->tv_sec < b->tv_sec ? -1 : 1;
    return (a->tv_nsec > b->tv_nsec) - (a->tv_nsec < b->tv_nsec);
}

void hd_cache_limit(const char *folder, int64_t most) {
    Listing listing = {0};
    DIR *stream = opendir(folder);
    if (stream == NULL)
        return;
    for (const struct dirent *found = readdir(stream); found != NULL; found = readdir(stream))
        look_at(&listing, dirfd(stream), found->d_name);
    if (listing.entries != NULL)
        qsort(listing.entries, (size_t)listing.count, sizeof *listing.entries, by_use);
    for (int i = 0; i < listing.count && listing.bytes > most; i++) {
        unlinkat(dirfd(stream), listing.entries[i].name, 0);
        listing.bytes -= listing.entries[i].bytes;
    }
    closedir(stream);
    free(listing.entries);
}
