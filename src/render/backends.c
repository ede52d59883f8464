/* SPDX-License-Identifier: MIT */
#include "render/backends.h"

#include <string.h>

const HdBackend *const hd_backends[HD_BACKEND_COUNT] = {HD_BACKENDS(HD_BACKEND_ADDRESS)};

const HdBackend *hd_backend_find(const char *name) {
    for (int i = 0; i < HD_BACKEND_COUNT; i++)
        if (strcmp(hd_backends[i]->name, name) == 0)
            return hd_backends[i];
    return NULL;
}

const HdBackend *hd_backend_always_there(void) {
    return hd_backends[HD_BACKEND_COUNT - 1];
}
