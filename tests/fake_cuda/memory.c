/* SPDX-License-Identifier: MIT */
/* Memory of the device, which is the host's at addresses that the host cannot read, and memory of
   the host for copies. Both are filled with POISON at first and lie between guards.
   FAKE_CUDA_MEMORY is the device's reported size in bytes. At most FAKE_CUDA_LARGEST bytes are
   granted at once, and FAKE_CUDA_FREE in all, as if a desktop had the rest. */
#include <stdlib.h>
#include <string.h>

#include "fake.h"

enum { GUARD = 256, POISON = 0xcd, UNTOUCHED = 0xa5, PAGE = 4096, MAX_GLOBALS = 256 };

static const HdCuPointer first_address = 0xfade000000000000;
static const double default_memory = 256e6;

typedef struct Memory {
    struct Memory *next;
    HdCuPointer address; /* 0: it is the host's */
    size_t bytes;
    unsigned char *data; /* between two guards */
} Memory;

static Memory *all;

/* ---- guards ---- */

static bool is_untouched(const unsigned char *guard) {
    return guard[0] == UNTOUCHED && memcmp(guard, guard + 1, GUARD - 1) == 0;
}

static bool holds(const Memory *memory) {
    return is_untouched(memory->data - GUARD) && is_untouched(memory->data + memory->bytes);
}

bool fake_guards_hold(void) {
    for (const Memory *memory = all; memory != NULL; memory = memory->next)
        if (!holds(memory))
            return false;
    return true;
}

/* ---- the allocations ---- */

int fake_memory_count(void) {
    int count = 0;
    for (const Memory *memory = all; memory != NULL; memory = memory->next)
        count++;
    return count;
}

static bool is_within(HdCuPointer begin, size_t bytes, HdCuPointer from, size_t size) {
    return begin >= from && begin - from <= size && bytes <= size - (begin - from);
}

static struct {
    const void *module; /* NULL: the place is free */
    unsigned char *data;
    size_t bytes;
} globals[MAX_GLOBALS];

bool fake_add_global(const void *module, void *data, size_t bytes) {
    for (int i = 0; i < MAX_GLOBALS; i++)
        if (globals[i].module == NULL || globals[i].data == data) {
            globals[i].module = module;
            globals[i].data = data;
            globals[i].bytes = bytes;
            return true;
        }
    return false;
}

void fake_drop_globals(const void *module) {
    for (int i = 0; i < MAX_GLOBALS; i++)
        if (globals[i].module == module)
            globals[i].module = NULL;
}

static void *global(HdCuPointer pointer, size_t bytes) {
    for (int i = 0; i < MAX_GLOBALS; i++)
        if (globals[i].module != NULL &&
            is_within(pointer, bytes, (uintptr_t)globals[i].data, globals[i].bytes))
            return globals[i].data + (size_t)(pointer - (uintptr_t)globals[i].data);
    return NULL;
}

void *fake_memory(HdCuPointer pointer, size_t bytes) {
    for (const Memory *memory = all; memory != NULL; memory = memory->next)
        if (memory->address != 0 && is_within(pointer, bytes, memory->address, memory->bytes))
            return memory->data + (size_t)(pointer - memory->address);
    return global(pointer, bytes);
}

bool fake_is_pinned(const void *data, size_t bytes) {
    for (const Memory *memory = all; memory != NULL; memory = memory->next)
        if (memory->address == 0 &&
            is_within((uintptr_t)data, bytes, (uintptr_t)memory->data, memory->bytes))
            return true;
    return false;
}

/* ---- allocating and freeing ---- */

static Memory *take(size_t bytes) {
    Memory *memory = malloc(sizeof *memory);
    unsigned char *data = malloc(bytes + 2 * (size_t)GUARD);
    if (memory == NULL || data == NULL) {
        free(memory);
        free(data);
        return NULL;
    }
    memset(data, UNTOUCHED, bytes + 2 * (size_t)GUARD);
    memset(data + GUARD, POISON, bytes);
    *memory = (Memory){.next = all, .bytes = bytes, .data = data + GUARD};
    all = memory;
    return memory;
}

static HdCuResult release(Memory **link) {
    Memory *memory = *link;
    bool held = holds(memory);
    fake_expect_idle();
    *link = memory->next;
    free(memory->data - GUARD);
    free(memory);
    return held ? HD_CU_SUCCESS
                : fake_misuse(HD_CU_ERROR_ILLEGAL_ADDRESS,
                              "something was written outside an allocation");
}

static double device_bytes(void) {
    double bytes = 0.0;
    for (const Memory *memory = all; memory != NULL; memory = memory->next)
        bytes += memory->address != 0 ? (double)memory->bytes : 0.0;
    return bytes;
}

HdCuResult cuMemAlloc_v2(HdCuPointer *pointer, size_t bytes) {
    static HdCuPointer next_address = first_address;
    FAKE_CALL(cuMemAlloc);
    if (bytes == 0)
        return fake_misuse(FAKE_INVALID_VALUE, "no bytes of memory are asked for");
    bool is_too_much = (double)bytes > fake_number("FAKE_CUDA_LARGEST", 1e18) ||
                       device_bytes() + (double)bytes > fake_number("FAKE_CUDA_FREE", 1e18);
    Memory *memory = is_too_much ? NULL : take(bytes);
    if (memory == NULL)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    *pointer = memory->address = next_address;
    next_address += (bytes / PAGE + 2) * PAGE; /* never the same again */
    return HD_CU_SUCCESS;
}

HdCuResult cuMemFree_v2(HdCuPointer pointer) {
    FAKE_CALL(cuMemFree);
    for (Memory **link = &all; *link != NULL; link = &(*link)->next)
        if (pointer != 0 && (*link)->address == pointer)
            return release(link);
    return fake_misuse(FAKE_INVALID_VALUE, "memory of the device is freed that is not there");
}

HdCuResult cuMemHostAlloc(void **data, size_t bytes, unsigned int flags) {
    FAKE_CALL(cuMemHostAlloc);
    if (bytes == 0 || flags != 0)
        return fake_misuse(FAKE_INVALID_VALUE, "%zu bytes of the host with flags %u", bytes, flags);
    Memory *memory = take(bytes);
    if (memory == NULL)
        return HD_CU_ERROR_OUT_OF_MEMORY;
    *data = memory->data;
    return HD_CU_SUCCESS;
}

HdCuResult cuMemFreeHost(void *data) {
    FAKE_CALL(cuMemFreeHost);
    for (Memory **link = &all; *link != NULL; link = &(*link)->next)
        if ((*link)->address == 0 && (*link)->data == data)
            return release(link);
    return fake_misuse(FAKE_INVALID_VALUE, "memory of the host is freed that is not there");
}

HdCuResult cuMemGetInfo_v2(size_t *available, size_t *total) {
    FAKE_CALL(cuMemGetInfo);
    double all_bytes = fake_number("FAKE_CUDA_MEMORY", default_memory);
    double left = fake_number("FAKE_CUDA_FREE", 1e18) - device_bytes();
    *total = (size_t)all_bytes;
    *available = (size_t)(left < all_bytes ? left : all_bytes);
    return HD_CU_SUCCESS;
}
