/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "view/watch.h"

#include <sys/stat.h>

#include "base/hash.h"

static uint64_t add_file(uint64_t hash, const char *path) {
    struct stat facts;
    char expanded[HD_MAX_PATH];
    HdError ignored;
    if (path == NULL || hd_path_expand_home(path, expanded, &ignored) != HD_OK ||
        stat(expanded, &facts) != 0)
        return hd_hash_bytes(hash, "", 1);
    const int64_t told[] = {(int64_t)facts.st_ino, (int64_t)facts.st_size,
                            (int64_t)facts.st_mtim.tv_sec, (int64_t)facts.st_mtim.tv_nsec};
    return hd_hash_bytes(hash, told, sizeof told);
}

uint64_t hd_watch_files(const char *path, const HdSceneFile *file) {
    uint64_t hash = add_file(HD_HASH_START, path);
    if (file->texture_path[0] != '\0')
        hash = add_file(hash, file->texture_path);
    for (int i = 0; i < file->mesh_entry_count; i++)
        hash = add_file(hash, file->mesh_entries[i].file);
    return hash;
}
