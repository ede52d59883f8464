/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "system/leftovers.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

#include "base/limits.h"
#include "system/path.h"

/* All outputs of a run may be films, and all of them pictures of many frames under way. */
enum { MAX_GROUPS = 2 * HD_MAX_OUTPUTS, MAX_FILES = 32 * HD_MAX_OUTPUTS };

/* A name that is being removed is never written to again: its slot stays taken. */
typedef enum FileState { FREE, BEING_WRITTEN, REMEMBERED, BEING_REMOVED } FileState;

static struct {
    atomic_int state;
    char path[HD_MAX_PATH];
} files[MAX_FILES];

/* Among threads; the handler of a signal goes by the states alone. */
static pthread_mutex_t files_mutex = PTHREAD_MUTEX_INITIALIZER;

static atomic_int groups[MAX_GROUPS]; /* 0: free */

_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal's handler must not wait for a lock");
_Static_assert(sizeof(pid_t) <= sizeof(int), "a process id is stored as an int");

static bool swap(atomic_int *value, int from, int to) {
    return atomic_compare_exchange_strong(value, &from, to);
}

void hd_leftovers_add_file(const char *path) {
    size_t size = strlen(path) + 1;
    pthread_mutex_lock(&files_mutex);
    for (int i = 0; i < MAX_FILES && size <= HD_MAX_PATH; i++) {
        if (!swap(&files[i].state, FREE, BEING_WRITTEN))
            continue;
        memcpy(files[i].path, path, size);
        atomic_store(&files[i].state, REMEMBERED);
        break;
    }
    pthread_mutex_unlock(&files_mutex);
}

void hd_leftovers_forget_file(const char *path) {
    pthread_mutex_lock(&files_mutex);
    for (int i = 0; i < MAX_FILES; i++)
        if (atomic_load(&files[i].state) == REMEMBERED && strcmp(files[i].path, path) == 0)
            swap(&files[i].state, REMEMBERED, FREE);
    pthread_mutex_unlock(&files_mutex);
}

void hd_leftovers_add_group(pid_t leader) {
    for (int i = 0; i < MAX_GROUPS; i++)
        if (swap(&groups[i], 0, (int)leader))
            return;
}

void hd_leftovers_forget_group(pid_t leader) {
    for (int i = 0; i < MAX_GROUPS; i++)
        swap(&groups[i], (int)leader, 0);
}

/* The groups first, lest they make their files again. */
void hd_leftovers_remove(void) {
    for (int i = 0; i < MAX_GROUPS; i++) {
        int leader = atomic_exchange(&groups[i], 0);
        if (leader > 0)
            kill(-leader, SIGKILL);
    }
    for (int i = 0; i < MAX_FILES; i++)
        if (swap(&files[i].state, REMEMBERED, BEING_REMOVED))
            unlink(files[i].path);
}
