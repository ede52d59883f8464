/* SPDX-License-Identifier: MIT */
#include "mesh/obj/reading.h"

#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "mesh/mesh.h"
#include "unit_test.h"

static HdObjMemory memory;
static HdNameTable table;

static int clear(void **state) {
    (void)state;
    hd_name_table_free(&table);
    memory = (HdObjMemory){.most = 64 << 20};
    return 0;
}

static HdSpan span(const char *text) {
    return (HdSpan){text, text + strlen(text)};
}

static int add(const char *name) {
    return hd_name_table_add(&table, span(name), &memory);
}

TEST(names_have_numbers) {
    assert_int_equal(hd_name_table_find(&table, span("a")), -1);
    assert_int_equal(add("a"), 0);
    assert_int_equal(add("ab"), 1);
    assert_int_equal(add(""), 2);
    assert_int_equal(add("ab"), 1);
    assert_int_equal(hd_name_table_find(&table, span("a")), 0);
    assert_int_equal(hd_name_table_find(&table, span("b")), -1);
    assert_string_equal(table.names[1], "ab");
}

/* The next name with the slot: a number from `*number` on and a character. */
static void next_colliding(int *number, uint64_t slot, char name[16]) {
    for (;;) {
        int size = snprintf(name, 16, "%d", (*number)++);
        uint64_t begun = hd_hash_bytes(HD_HASH_START, name, (size_t)size);
        for (char last = '!'; last <= '~'; last++)
            if (hd_hash_bytes(begun, &last, 1) % (4 * HD_MAX_MESH_MATERIALS) == slot) {
                name[size] = last;
                name[size + 1] = '\0';
                return;
            }
    }
}

TEST(beginnings_that_collide) {
    char name[16] = "a";
    const uint64_t slots = 4 * HD_MAX_MESH_MATERIALS;
    const uint64_t slot = hd_hash_bytes(HD_HASH_START, "a", 1) % slots;
    for (int i = 0; hd_hash_bytes(HD_HASH_START, name, strlen(name)) % slots != slot || i == 0; i++)
        snprintf(name, sizeof name, "a%d", i);
    assert_int_equal(add(name), 0);
    assert_int_equal(hd_name_table_find(&table, span("a")), -1);
    assert_int_equal(add("a"), 1);
}

/* Only names made to collide come so far; each look-up would take longer and longer. */
TEST(too_many_that_collide) {
    char names[257][16];
    int number = 0;
    for (int i = 0; i < 257; i++) {
        next_colliding(&number, 5, names[i]);
        assert_int_equal(add(names[i]), i < 256 ? i : HD_NAME_TOO_MANY);
    }
    for (int i = 0; i < 256; i++) {
        assert_int_equal(hd_name_table_find(&table, span(names[i])), i);
        assert_string_equal(table.names[i], names[i]);
    }
}

EACH(clear, clear)
