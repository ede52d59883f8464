/* SPDX-License-Identifier: MIT */
/* Declarations shared by the fake driver's files. One thread at a time is in any of them. */
#ifndef HD_FAKE_CUDA_FAKE_H
#define HD_FAKE_CUDA_FAKE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "device/cuda/api.h"
#include "kernel.h"

/* ---- calls (call.c) ---- */

enum {
    FAKE_INVALID_VALUE = 1,
    FAKE_INVALID_IMAGE = 200,
    FAKE_INVALID_CONTEXT = 201,
    FAKE_NO_BINARY_FOR_GPU = 209,
    FAKE_INVALID_HANDLE = 400,
    FAKE_NOT_FOUND = 500,
    FAKE_NOT_READY = 600
};

/* Every function begins with one of them. They make it fail if FAKE_CUDA_FAILS says so, and keep
   other threads out until it returns. FAKE_CALL also requires a current context that is not
   lost. */
#define FAKE_CALL_ANYWHERE(function)                                                               \
    __attribute__((cleanup(fake_leave))) HdCuResult fake_entered = fake_enter(#function, false);   \
    if (fake_entered != HD_CU_SUCCESS)                                                             \
    return fake_entered
#define FAKE_CALL(function)                                                                        \
    __attribute__((cleanup(fake_leave))) HdCuResult fake_entered = fake_enter(#function, true);    \
    if (fake_entered != HD_CU_SUCCESS)                                                             \
    return fake_entered
HdCuResult fake_enter(const char *function, bool needs_context);
void fake_leave(HdCuResult *entered);

/* Reports on standard error the program's misuse; returns the code. */
__attribute__((format(printf, 2, 3))) HdCuResult fake_misuse(HdCuResult code, const char *format,
                                                             ...);

/* Likewise if it is noticed too late for its call: the context is lost, and the next call that
   waits returns the code. */
void fake_lose(HdCuResult code, const char *what);
HdCuResult fake_lost(void);

/* Returns the value of an environment variable. */
double fake_number(const char *variable, double otherwise);

/* Returns the device's architecture: 61 stands for sm_61. */
int fake_capability(void);

/* ---- living handles, by their address (living.c): using any other is an error ---- */

typedef enum FakeKind { FAKE_STREAM, FAKE_EVENT, FAKE_MODULE, FAKE_FUNCTION } FakeKind;

/* Returns zeroed memory, registered under its kind; NULL if there is none. */
void *fake_create(FakeKind kind, size_t bytes);
bool fake_lives(FakeKind kind, const void *handle);
void fake_forget(FakeKind kind, void *handle);

/* ---- memory (memory.c) ---- */

/* Returns the host's address of the device's memory; NULL unless all of it lies in one living
   allocation. */
void *fake_memory(HdCuPointer pointer, size_t bytes);
/* Registers variables of a module, which are memory of the device while the module lives. Returns
   false if the table is full. */
bool fake_add_global(const void *module, void *data, size_t bytes);
void fake_drop_globals(const void *module);
bool fake_is_pinned(const void *data, size_t bytes);

/* Returns whether nobody wrote before or behind any memory. */
bool fake_guards_hold(void);

/* Counts of memory, streams, events, modules. */
int fake_living_count(void);
int fake_memory_count(void);

/* ---- streams (streams.c) ---- */

typedef struct FakeLaunch {
    HdCuFunction function;
    FakeIndex blocks, threads;
    uint64_t *arguments; /* as passed; device addresses */
} FakeLaunch;

/* Queues a launch, whose arguments become the queue's. */
HdCuResult fake_queue_launch(HdCuStream stream, FakeLaunch launch);

/* Reports queued operations before something is freed. */
void fake_expect_idle(void);

/* ---- launches (launch.c, fibers.c) ---- */

/* Runs a launch; an error loses the context. */
void fake_run_launch(const FakeLaunch *launch);

typedef struct FakeGrid {
    const FakeKernel *kernel;
    void *const *arguments;
    FakeThread *thread; /* the module's */
    const FakeShared *shared;
} FakeGrid;

/* Runs all blocks, whose numbers are set in `thread`. Returns the error, or NULL. */
const char *fake_run_grid(const FakeGrid *grid);

#endif
