/* SPDX-License-Identifier: MIT */
#include "device/verdict.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "device/kernel_source.h"
#include "system/cache_folder.h"

enum { KEY_LENGTH = 1024 };

static const char kind[] = "verdict", right[] = "right";

static void write_key(const char *device, const char *driver, char key[KEY_LENGTH]) {
    uint64_t hash = hd_hash_bytes(HD_HASH_START, hd_opencl_source, hd_opencl_source_size);
    hash = hd_hash_bytes(hash, hd_cuda_source, hd_cuda_source_size);
    snprintf(key, KEY_LENGTH, "hedron %s, kernels %016" PRIx64 "\ndevice %s\ndriver %s\n",
             HD_VERSION, hash, device, driver);
}

void hd_verdict_put(const char *device, const char *driver, const char *difference) {
    char key[KEY_LENGTH];
    HdError ignored;
    write_key(device, driver, key);
    hd_cache_put_text(kind, key, difference[0] != '\0' ? difference : right, &ignored);
}

bool hd_verdict_get(const char *device, const char *driver, char *difference, size_t capacity) {
    char key[KEY_LENGTH];
    HdError ignored;
    write_key(device, driver, key);
    if (hd_cache_get_text(kind, key, difference, capacity, &ignored) != HD_OK) {
        difference[0] = '\0';
        return false;
    }
    if (strcmp(difference, right) == 0)
        difference[0] = '\0';
    return true;
}
