/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/known_folders.h"

#include <pthread.h>
#include <stdint.h>
#include <string.h>

#include "base/hash.h"

/* As many as a run has outputs, and more. A sequence whose folders are numbered has countless ones,
   but it asks for each but once. */
enum { MAX_FOLDERS = 32 };

static struct {
    uint64_t hashes[MAX_FOLDERS]; /* of their names; 0: none */
    int next;
} known;

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static uint64_t hash_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    return hd_hash_bytes(HD_HASH_START, path, slash == NULL ? 0 : (size_t)(slash - path) + 1);
}

static bool find(uint64_t hash) {
    for (int i = 0; i < MAX_FOLDERS; i++)
        if (known.hashes[i] == hash)
            return true;
    return false;
}

void hd_known_folders_add(const char *path) {
    uint64_t hash = hash_folder(path);
    pthread_mutex_lock(&mutex);
    if (!find(hash)) {
        known.hashes[known.next] = hash;
        known.next = (known.next + 1) % MAX_FOLDERS;
    }
    pthread_mutex_unlock(&mutex);
}

bool hd_known_folders_has(const char *path) {
    uint64_t hash = hash_folder(path);
    pthread_mutex_lock(&mutex);
    bool has = find(hash);
    pthread_mutex_unlock(&mutex);
    return has;
}

void hd_known_folders_forget(void) {
    pthread_mutex_lock(&mutex);
    memset(&known, 0, sizeof known);
    pthread_mutex_unlock(&mutex);
}
