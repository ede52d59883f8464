/* SPDX-License-Identifier: MIT */
/* Passes every file of a folder to a fuzz target, and changed copies of each: the campaign's finds
   stay fixed, even without libFuzzer. The changes follow from the bytes and the number alone, so
   that a run can be repeated. fuzz_TARGET FOLDER [CHANGES] */
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "fuzz.h"

enum { MAX_BYTES = 1 << 20 };

static uint64_t random_state;

/* xorshift64 (G. Marsaglia 2003). */
static size_t random_below(size_t limit) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (size_t)(random_state >> 11) % limit;
}

/* Runs a copy of its own size, so that a sanitizer detects a byte read too many. */
static void run_copy(const uint8_t *bytes, size_t size) {
    uint8_t *copy = malloc(size > 0 ? size : 1);
    fuzz_expect(copy != NULL, "no memory");
    memcpy(copy, bytes, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

/* Sets a byte, flips a bit, removes a run of bytes, or repeats one. */
static size_t change(uint8_t *bytes, size_t size) {
    const size_t at = random_below(size), rest = size - at;
    const size_t length = 1 + random_below(rest < 16 ? rest : 16);
    switch (random_below(4)) {
    case 0:
        bytes[at] = (uint8_t)random_below(256);
        return size;
    case 1:
        bytes[at] ^= (uint8_t)(1u << random_below(8));
        return size;
    case 2:
        memmove(bytes + at, bytes + at + length, rest - length);
        return size - length;
    default:
        memmove(bytes + at + length, bytes + at, rest);
        return size + length;
    }
}

static void run_changed(const uint8_t *bytes, size_t size, int changes) {
    enum { MAX_AT_ONCE = 4 };
    uint8_t *changed = malloc(size + 16 * MAX_AT_ONCE);
    fuzz_expect(changed != NULL, "no memory");
    for (int i = 0; i < changes && size > 0; i++) {
        size_t left = size;
        memcpy(changed, bytes, size);
        random_state = hd_hash_bytes(HD_HASH_START, bytes, size) + (uint64_t)i;
        for (size_t count = 1 + random_below(MAX_AT_ONCE); count > 0 && left > 0; count--)
            left = change(changed, left);
        run_copy(changed, left);
    }
    free(changed);
}

static void run_file(const char *folder, const char *name, int changes) {
    char path[4096];
    uint8_t *bytes = malloc(MAX_BYTES);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    fuzz_expect(bytes != NULL && file != NULL, "a file of the corpus that cannot be read");
    const size_t size = fread(bytes, 1, MAX_BYTES, file);
    fclose(file);
    run_copy(bytes, size);
    run_changed(bytes, size, changes);
    free(bytes);
}

static int is_input(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

int main(int count, char **arguments) {
    struct dirent **files;
    const int changes = count > 2 ? atoi(arguments[2]) : 0;
    if (count < 2) {
        fprintf(stderr, "usage: %s FOLDER [CHANGES]\n", arguments[0]);
        return 2;
    }
    const int file_count = scandir(arguments[1], &files, is_input, alphasort);
    fuzz_expect(file_count > 0, "the folder has no corpus");
    for (int i = 0; i < file_count; i++) {
        run_file(arguments[1], files[i]->d_name, changes);
        free(files[i]);
    }
    free(files);
    printf("%d files, each as it is and changed %d times\n", file_count, changes);
    return 0;
}
