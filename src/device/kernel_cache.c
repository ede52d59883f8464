/* SPDX-License-Identifier: MIT */
#include "device/kernel_cache.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/text.h"
#include "system/cache_folder.h"

void hd_kernel_cache_begin(HdKernelCache *cache, const char *backend, const char *device,
                           const char *driver) {
    *cache = (HdKernelCache){.backend = backend};
    snprintf(cache->device, sizeof cache->device, "%s (%s)", device, driver);
}

/* ---- entries: a head, then the binary ---- */

typedef struct Head {
    char stamp[48]; /* stamp_of */
    char maker[sizeof((HdKernelCache *)0)->maker];
} Head;

/* Returns the state of the kernels' test, for entries and notes. */
static const char *stamp_of(const HdKernelCache *cache) {
    return cache->shape.math == HD_MATH_STRICT ? "passed the self-test"
                                               : "not tested, since the arithmetic is fast";
}

/* Turns an entry into its binary, in place. */
static bool open_entry(HdKernelCache *cache, unsigned char *entry, size_t *size) {
    Head head;
    if (*size <= sizeof head)
        return false;
    memcpy(&head, entry, sizeof head);
    if (strncmp(head.stamp, stamp_of(cache), sizeof head.stamp) != 0)
        return false;
    snprintf(cache->maker, sizeof cache->maker, "%.*s", (int)sizeof head.maker - 1, head.maker);
    *size -= sizeof head;
    memmove(entry, entry + sizeof head, *size);
    return true;
}

static HdStatus store_binary(const HdKernelCache *cache, const unsigned char *binary, size_t size,
                             HdError *error) {
    Head head = {.stamp = ""};
    unsigned char *entry = malloc(sizeof head + size);
    if (entry == NULL)
        return HD_NO_ROOM(error, "compiled kernels");
    snprintf(head.stamp, sizeof head.stamp, "%s", stamp_of(cache));
    memcpy(head.maker, cache->maker, sizeof head.maker);
    memcpy(entry, &head, sizeof head);
    memcpy(entry + sizeof head, binary, size);
    HdStatus status = hd_cache_put(cache->backend, cache->key, entry, sizeof head + size, error);
    free(entry);
    return status;
}

/* Without a folder, spares the driver the work of making a binary. */
static HdStatus store(const HdKernelCache *cache, HdError *error) {
    char folder[HD_MAX_PATH];
    size_t size = 0;
    HD_TRY(hd_cache_folder(folder, error));
    unsigned char *binary = cache->key[0] != '\0' ? cache->read(cache->context, &size) : NULL;
    HdStatus status = binary != NULL && size > 0
                          ? store_binary(cache, binary, size, error)
                          : hd_fail(error, HD_UNAVAILABLE, "the driver does not provide them");
    free(binary);
    return status;
}

static void add_note(HdKernelCache *cache, const char *text) {
    hd_add_text(cache->note, sizeof cache->note, "; ", "%s", text);
}

/* ---- search and storage ---- */

/* Fails, and empties the key, if the key is too long. */
static bool write_key(HdKernelCache *cache, const void *source, size_t source_size,
                      const char *options, const char *driver) {
    int length =
        snprintf(cache->key, sizeof cache->key,
                 "hedron %s\nkernels %016" PRIx64 ", %zu bytes\noptions %s\ndevice %s\ndriver %s\n",
                 HD_VERSION, hd_hash_bytes(HD_HASH_START, source, source_size), source_size,
                 options, cache->device, driver);
    const bool has_memory = length >= 0 && (size_t)length < sizeof cache->key;
    if (!has_memory)
        cache->key[0] = '\0';
    return has_memory;
}

bool hd_kernel_cache_find(HdKernelCache *cache, const void *source, size_t source_size,
                          const char *options, const char *driver, unsigned char **binary,
                          size_t *size) {
    char folder[HD_MAX_PATH];
    HdError error;
    cache->is_untested = false;
    cache->note[0] = cache->maker[0] = '\0';
    *binary = NULL;
    if (!write_key(cache, source, source_size, options, driver))
        return false;
    HdStatus status = hd_cache_get(cache->backend, cache->key, binary, size, &error);
    if (status == HD_OK && open_entry(cache, *binary, size)) {
        hd_cache_folder(folder, &error);
        snprintf(cache->note, sizeof cache->note, "taken from %.900s%s%s", folder,
                 cache->maker[0] != '\0' ? ", made by " : "", cache->maker);
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
    snprintf(cache->maker, sizeof cache->maker, "%s", maker);
    hd_add_text(cache->note, sizeof cache->note, "; ", "compiled in %.0f ms%s%s", 1e3 * seconds,
                maker[0] != '\0' ? " by " : "", cache->maker);
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

/* ---- arithmetic of devices: one of these texts, or `wrong` and the difference ---- */

enum { KEY_LENGTH = 1024 };

static const char kind[] = "arithmetic", right[] = "right", by_fma[] = "right with division by fma",
                  wrong[] = "wrong: ";

static void write_device_key(char key[KEY_LENGTH], const char *device, const char *driver,
                             HdPrecision precision) {
    uint64_t hash = hd_hash_bytes(HD_HASH_START, hd_opencl_source, hd_opencl_source_size);
    hash = hd_hash_bytes(hash, hd_cuda_source, hd_cuda_source_size);
    snprintf(key, KEY_LENGTH, "hedron %s, kernels %016" PRIx64 "\ndevice %s\ndriver %s\n%s\n",
             HD_VERSION, hash, device, driver,
             precision == HD_PRECISION_DOUBLE ? "double" : "float");
}

void hd_arithmetic_remember(const char *device, const char *driver, HdPrecision precision,
                            const HdArithmetic *found) {
    char key[KEY_LENGTH], text[sizeof wrong + sizeof found->difference];
    HdError ignored;
    write_device_key(key, device, driver, precision);
    snprintf(text, sizeof text, "%s", found->rounds_by_fma ? by_fma : right);
    if (found->difference[0] != '\0')
        snprintf(text, sizeof text, "%s%s", wrong, found->difference);
    hd_cache_put_text(kind, key, text, &ignored);
}

bool hd_arithmetic_recall(const char *device, const char *driver, HdPrecision precision,
                          HdArithmetic *known) {
    char key[KEY_LENGTH], text[sizeof wrong + sizeof known->difference];
    HdError ignored;
    write_device_key(key, device, driver, precision);
    *known = (HdArithmetic){.difference = ""};
    if (hd_cache_get_text(kind, key, text, sizeof text, &ignored) != HD_OK)
        return false;
    known->rounds_by_fma = strcmp(text, by_fma) == 0;
    if (strncmp(text, wrong, strlen(wrong)) == 0)
        snprintf(known->difference, sizeof known->difference, "%.511s", text + strlen(wrong));
    return known->difference[0] != '\0' || known->rounds_by_fma || strcmp(text, right) == 0;
}
