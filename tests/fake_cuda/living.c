/* SPDX-License-Identifier: MIT */
#include <stdlib.h>

#include "fake.h"

/* Stays allocated, so that no other one has its address. */
typedef struct Living {
    struct Living *next;
    FakeKind kind;
    bool lives;
    _Alignas(16) unsigned char data[];
} Living;

static Living *all;

void *fake_create(FakeKind kind, size_t bytes) {
    Living *living = calloc(1, sizeof *living + bytes);
    if (living == NULL)
        return NULL;
    *living = (Living){.next = all, .kind = kind, .lives = true};
    all = living;
    return living->data;
}

static Living *find(FakeKind kind, const void *handle) {
    for (Living *living = all; living != NULL; living = living->next)
        if (living->data == handle && living->kind == kind && living->lives)
            return living;
    return NULL;
}

bool fake_lives(FakeKind kind, const void *handle) {
    return find(kind, handle) != NULL;
}

void fake_forget(FakeKind kind, void *handle) {
    Living *living = find(kind, handle);
    if (living != NULL)
        living->lives = false;
}

int fake_living_count(void) {
    int count = 0;
    for (const Living *living = all; living != NULL; living = living->next)
        count += living->lives && living->kind != FAKE_FUNCTION;
    return count;
}
