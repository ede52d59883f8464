/* SPDX-License-Identifier: MIT */
/* Preloaded, a system that has few threads to give: FAILING_THREADS_AFTER of them are started,
   later ones refused. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef int Create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                   void *argument);

static atomic_int started;

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                   void *argument) {
    const char *limit = getenv("FAILING_THREADS_AFTER");
    void *found = dlsym(RTLD_NEXT, "pthread_create");
    Create *create;
    memcpy(&create, &found, sizeof create);
    if (limit != NULL && atomic_fetch_add(&started, 1) >= atoi(limit))
        return EAGAIN;
    return create(thread, attributes, run, argument);
}
