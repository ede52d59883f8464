/* SPDX-License-Identifier: MIT */
#include "device/kernel_cache.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "system/cache_folder.h"

void hd_kernel_cache_begin(HdKernelCache *cache, const HdDevice *device) {
    *cache = (HdKernelCache){.backend = device->backend->name};
    snprintf(cache->device, sizeof cache->device, "%s (%s)", device->name, device->driver);
}

/* ---- entries: the stamp, the maker, a line each, then the binary ---- */

/* What an entry, or a note, says of the kernels' test. */
static const char *stamp_of(const HdKernelCache *cache) {
    return cache->shape.math == HD_MATH_STRICT ? "passed the self-test"
                                               : "not tested, for the arithmetic is fast";
}

/* Takes the line off the front of what is left; false where there is none that fits. */
static bool take_line(unsigned char **bytes, size_t *size, char *line, size_t capacity) {
    const unsigned char *end = *size > 0 ? memchr(*bytes, '\n', *size) : NULL;
    size_t length = end != NULL ? (size_t)(end - *bytes) : 0;
    if (end == NULL || length >= capacity)
        return false;
    memcpy(line, *bytes, length);
    line[length] = '\0';
    *bytes += length + 1;
    *size -= length + 1;
    return true;
}

/* Turns an entry into its binary, at the front of the same memory. */
static bool open_entry(HdKernelCache *cache, unsigned char *entry, size_t *size) {
    char stamp[64];
    unsigned char *rest = entry;
    if (!take_line(&rest, size, stamp, sizeof stamp) || strcmp(stamp, stamp_of(cache)) != 0 ||
        !take_line(&rest, size, cache->maker, sizeof cache->maker) || *size == 0)
        return false;
    memmove(entry, rest, *size);
    return true;
}

static HdStatus store_binary(const HdKernelCache *cache, const unsigned char *binary, size_t size,
                             HdError *error) {
    size_t capacity = strlen(stamp_of(cache)) + sizeof cache->maker + 2 + size;
    char *entry = malloc(capacity);
    if (entry == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for compiled kernels");
    int length = snprintf(entry, capacity, "%s\n%s\n", stamp_of(cache), cache->maker);
    memcpy(entry + length, binary, size);
    HdStatus status = hd_cache_put(cache->backend, cache->key, entry, (size_t)length + size, error);
    free(entry);
    return status;
}

/* A driver may have to work for it, so that it is not asked where there is no folder. */
static HdStatus store(const HdKernelCache *cache, HdError *error) {
    char folder[HD_MAX_PATH];
    size_t size = 0;
    HdStatus status = hd_cache_folder(folder, error);
    if (status != HD_OK)
        return status;
    unsigned char *binary = cache->key[0] != '\0' ? cache->read(cache->context, &size) : NULL;
    status = binary != NULL && size > 0
                 ? store_binary(cache, binary, size, error)
                 : hd_fail(error, HD_UNAVAILABLE, "the driver does not hand them out");
    free(binary);
    return status;
}

/* ---- notes ---- */

static void add_note(HdKernelCache *cache, const char *text) {
    size_t length = strlen(cache->note);
    snprintf(cache->note + length, sizeof cache->note - length, "%s%s", length > 0 ? "; " : "",
             text);
}

static void note_found(HdKernelCache *cache) {
    char folder[HD_MAX_PATH];
    HdError ignored;
    hd_cache_folder(folder, &ignored);
    snprintf(cache->note, sizeof cache->note, "taken from %.900s%s%s", folder,
             cache->maker[0] != '\0' ? ", made by " : "", cache->maker);
}

/* ---- finding and keeping ---- */

bool hd_kernel_cache_key(const HdKernelCache *cache, const void *source, size_t source_size,
                         const char *options, const char *driver, char *key, size_t capacity) {
    int length =
        snprintf(key, capacity,
                 "hedron %s\nkernels %016" PRIx64 ", %zu bytes\noptions %s\ndevice %s\ndriver %s\n",
                 HD_VERSION, hd_hash_bytes(HD_HASH_START, source, source_size), source_size,
                 options, cache->device, driver);
    if (length >= 0 && (size_t)length < capacity)
        return true;
    key[0] = '\0';
    return false;
}

bool hd_kernel_cache_find(HdKernelCache *cache, const void *source, size_t source_size,
                          const char *options, const char *driver, unsigned char **binary,
                          size_t *size) {
    HdError error;
    cache->is_untested = false;
    cache->note[0] = cache->maker[0] = '\0';
    if (!hd_kernel_cache_key(cache, source, source_size, options, driver, cache->key,
                             sizeof cache->key)) {
        *binary = NULL;
        return false;
    }
    HdStatus status = hd_cache_get(cache->backend, cache->key, binary, size, &error);
    if (status == HD_OK && open_entry(cache, *binary, size)) {
        note_found(cache);
        return true;
    }
    if (status == HD_OK)
        add_note(cache, "the cached kernels passed no test");
    else if (status == HD_FAILED)
        add_note(cache, error.message);
    free(*binary);
    *binary = NULL;
    return false;
}

void hd_kernel_cache_refuse(HdKernelCache *cache, const char *reason) {
    cache->note[0] = '\0';
    add_note(cache, "the driver refused the cached kernels");
    add_note(cache, reason);
}

void hd_kernel_cache_compiled(HdKernelCache *cache, HdKernelReader *read, const void *context,
                              const char *maker, double seconds) {
    char text[160];
    snprintf(cache->maker, sizeof cache->maker, "%s", maker);
    snprintf(text, sizeof text, "compiled in %.0f ms%s%s", 1e3 * seconds,
             maker[0] != '\0' ? " by " : "", cache->maker);
    add_note(cache, text);
    cache->is_untested = true;
    cache->read = read;
    cache->context = context;
}

void hd_kernel_cache_accept(HdKernelCache *cache) {
    HdError error;
    if (!cache->is_untested)
        return;
    cache->is_untested = false;
    add_note(cache, stamp_of(cache));
    bool stored = store(cache, &error) == HD_OK;
    add_note(cache, stored ? "cached" : "not cached");
    if (!stored)
        add_note(cache, error.message);
}
