/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device/cuda/nvrtc_check.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "device/cuda/nvrtc.h"
#include "system/cache_folder.h"
#include "system/dynamic_library.h"

enum { KEY_LENGTH = HD_MAX_PATH + 128, RECORD_LENGTH = HD_MAX_PATH + 64 };

static const char record_kind[] = "nvrtc";

static void write_key(char key[KEY_LENGTH], int arch, int driver_major) {
    const char *named = getenv("HEDRON_NVRTC");
    snprintf(key, KEY_LENGTH, "hedron %s\nsm_%d, driver for CUDA %d\nHEDRON_NVRTC %.*s\n",
             HD_VERSION, arch, driver_major, HD_MAX_PATH, named != NULL ? named : "");
}

/* Size and time tell a library from one that was installed over it. */
static bool write_record(char record[RECORD_LENGTH], const char *library) {
    struct stat found;
    if (library[0] != '/' || stat(library, &found) != 0 || !S_ISREG(found.st_mode))
        return false;
    int length = snprintf(record, RECORD_LENGTH, "%lld %lld %s", (long long)found.st_size,
                          (long long)found.st_mtime, library);
    return length < RECORD_LENGTH;
}

static bool is_remembered(int arch, int driver_major) {
    char key[KEY_LENGTH], stored[RECORD_LENGTH], present[RECORD_LENGTH];
    HdError ignored;
    write_key(key, arch, driver_major);
    if (hd_cache_get_text(record_kind, key, stored, sizeof stored, &ignored) != HD_OK)
        return false;
    const char *library = strchr(stored, '/');
    return library != NULL && write_record(present, library) && strcmp(stored, present) == 0;
}

void hd_nvrtc_remember(const char *library, int arch, int driver_major) {
    char key[KEY_LENGTH], record[RECORD_LENGTH];
    HdError ignored; /* next time it is loaded again */
    write_key(key, arch, driver_major);
    if (write_record(record, library))
        hd_cache_put_text(record_kind, key, record, &ignored);
}

HdStatus hd_nvrtc_check(const char *device, int arch, int driver_major, HdError *error) {
    HdNvrtc nvrtc;
    char library[HD_MAX_PATH];
    if (is_remembered(arch, driver_major))
        return HD_OK;
    HdStatus status = hd_nvrtc_open(&nvrtc, device, arch, driver_major, NULL, error);
    if (status != HD_OK)
        return status;
    if (hd_library_path(nvrtc.library, "nvrtcVersion", library, sizeof library))
        hd_nvrtc_remember(library, arch, driver_major);
    hd_nvrtc_close(&nvrtc);
    return HD_OK;
}
