/* SPDX-License-Identifier: MIT */
#include "base/folder_set.h"

#include <string.h>

#include "base/hash.h"

size_t hd_folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

static uint64_t hash_of(const char *path) {
    return hd_hash_bytes(HD_HASH_START, path, hd_folder_length(path));
}

bool hd_folder_set_has(const HdFolderSet *set, const char *path) {
    const uint64_t hash = hash_of(path);
    for (int i = 0; i < HD_FOLDER_SET_ROOM; i++)
        if (set->hashes[i] == hash)
            return true;
    return false;
}

void hd_folder_set_add(HdFolderSet *set, const char *path) {
    if (hd_folder_set_has(set, path))
        return;
    set->hashes[set->next] = hash_of(path);
    set->next = (set->next + 1) % HD_FOLDER_SET_ROOM;
}
