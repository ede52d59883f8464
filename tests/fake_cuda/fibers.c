/* SPDX-License-Identifier: MIT */
/* The threads of a block as fibers: each runs until it waits for others. Blocks run one after the
   other. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <ucontext.h>

#include "fake.h"

/* Stacks must not all begin in the same cache lines. */
enum {
    MAX_FIBERS = 1024,
    STACK = (128 << 10) + 1088,
    CANARY = 64,
    UNTOUCHED = 0x5a,
    POISON = 0xcd
};

typedef struct Fiber {
    void *stack;
    bool waits; /* for all threads of the block */
    bool is_over;
} Fiber;

static Fiber fibers[MAX_FIBERS];
static unsigned char *stacks;
static void *scheduler; /* its stack */
static Fiber *current;
static const FakeGrid *grid; /* the running one */
static unsigned int launches;
static const char *failure;

/* ---- switching stacks ---- */

#ifdef __x86_64__

/* Saves the registers that a function must preserve on the current stack, and stores its
   pointer. */
void fake_switch(void **from, void *to);
__asm__(".text\n"
        ".globl fake_switch\n"
        ".hidden fake_switch\n"
        ".type fake_switch, @function\n"
        "fake_switch:\n"
        "    pushq %rbp\n"
        "    pushq %rbx\n"
        "    pushq %r12\n"
        "    pushq %r13\n"
        "    pushq %r14\n"
        "    pushq %r15\n"
        "    movq %rsp, (%rdi)\n"
        "    movq %rsi, %rsp\n"
        "    popq %r15\n"
        "    popq %r14\n"
        "    popq %r13\n"
        "    popq %r12\n"
        "    popq %rbx\n"
        "    popq %rbp\n"
        "    ret\n"
        ".size fake_switch, . - fake_switch\n");

/* Prepares a stack on which fake_switch returns to `begin`, as if called. */
static void *prepare(unsigned char *stack, void (*begin)(void)) {
    enum { KEPT = 6 };
    uintptr_t top = ((uintptr_t)stack + STACK) & ~(uintptr_t)63;
    void **words = (void **)top - 2; /* NOLINT(performance-no-int-to-ptr) */
    memcpy(words, &begin, sizeof begin);
    words -= KEPT;
    memset(words, 0, KEPT * sizeof *words);
    return words;
}

#else /* slower, since each switch asks the kernel for the signals' mask */

static ucontext_t outside; /* of the scheduler; that of a fiber lies at the top of its stack */

static void fake_switch(void **from, void *to) {
    if (*from == NULL)
        *from = &outside;
    swapcontext(*from, to);
}

static void *prepare(unsigned char *stack, void (*begin)(void)) {
    uintptr_t top = ((uintptr_t)stack + STACK - sizeof(ucontext_t)) & ~(uintptr_t)63;
    ucontext_t *context = (ucontext_t *)top; /* NOLINT(performance-no-int-to-ptr) */
    getcontext(context);
    context->uc_stack.ss_sp = stack;
    context->uc_stack.ss_size = top - (uintptr_t)stack;
    makecontext(context, begin, 0);
    return context;
}

#endif

static void leave(void) {
    fake_switch(&current->stack, scheduler);
}

/* ---- a thread ---- */

static void begin_thread(void) {
    grid->kernel->call(grid->arguments);
    current->is_over = true;
    leave();
}

static void wait(void) {
    current->waits = true;
    leave();
}

/* ---- a block ---- */

static void start_threads(unsigned int count) {
    memset(grid->shared->begin + FAKE_SHARED_GUARD, POISON,
           (size_t)(grid->shared->end - grid->shared->begin) - FAKE_SHARED_GUARD);
    for (unsigned int i = 0; i < count; i++)
        fibers[i] = (Fiber){.stack = prepare(stacks + (size_t)i * STACK, begin_thread)};
}

/* Returns whether any thread could run. Every other block, and launch, begins with its last thread,
   so that code that relies on an order is wrong in one of them. */
static bool run_ready(unsigned int count) {
    bool any = false;
    for (unsigned int turn = 0; turn < count; turn++) {
        unsigned int i = (grid->thread->block.x + launches) % 2 ? count - 1 - turn : turn;
        if (fibers[i].is_over || fibers[i].waits)
            continue;
        grid->thread->thread = (FakeIndex){i, 0, 0};
        current = &fibers[i];
        fake_switch(&scheduler, current->stack);
        any = true;
    }
    return any;
}

/* Lets the threads continue if all of them wait. Those that ended never will: nothing waits for
   them. */
static bool release(unsigned int count) {
    for (unsigned int i = 0; i < count; i++)
        if (fibers[i].is_over || !fibers[i].waits)
            return false;
    for (unsigned int i = 0; i < count; i++)
        fibers[i].waits = false;
    return true;
}

static void check_end(unsigned int count) {
    for (unsigned int i = 0; i < count; i++) {
        if (!fibers[i].is_over)
            failure = "threads of a block wait for some that never come";
        for (int k = 0; k < CANARY; k++)
            if (stacks[(size_t)i * STACK + (size_t)k] != UNTOUCHED)
                failure = "a thread needs more than its stack";
    }
}

static void run_block(unsigned int count) {
    start_threads(count);
    do {
        while (run_ready(count))
            ;
    } while (failure == NULL && release(count));
    if (failure == NULL)
        check_end(count);
}

static bool make_stacks(void) {
    if (stacks != NULL)
        return true;
    void *memory = mmap(NULL, (size_t)MAX_FIBERS * STACK, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED)
        return false;
    stacks = memory;
    for (int i = 0; i < MAX_FIBERS; i++)
        memset(stacks + (size_t)i * STACK, UNTOUCHED, CANARY);
    return true;
}

const char *fake_run_grid(const FakeGrid *launched) {
    grid = launched;
    launches++;
    grid->thread->wait = wait;
    failure = make_stacks() ? NULL : "there is no memory for stacks";
    for (unsigned int i = 0; failure == NULL && i < grid->thread->blocks.x; i++) {
        grid->thread->block = (FakeIndex){i, 0, 0};
        run_block(grid->thread->threads.x);
    }
    return failure;
}
