/* SPDX-License-Identifier: MIT */
#include "mesh/obj_reading.h"

#include <string.h>

#include "mesh/mesh.h"
#include "unit_test.h"

static HdObjMemory memory;
static HdNameTable table;

static int clear(void **state) {
    (void)state;
    hd_name_table_free(&table);
    memory = (HdObjMemory){.max_bytes = 64 << 20};
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
    assert_string_equal(table.names[1].owned, "ab");
}

EACH(clear, clear)
