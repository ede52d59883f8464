/* SPDX-License-Identifier: MIT */
#include "tables/room.h"

#include <stdio.h>
#include <string.h>

#include "system/machine.h"

const char hd_room_advice[] = "fewer triangles, a device with more memory or --backend c may do";

void hd_byte_text(double bytes, char out[HD_BYTE_TEXT_SIZE]) {
    static const char *const units[] = {"bytes", "kB", "MB", "GB", "TB"};
    int unit = 0;
    while (bytes >= 999.5 && unit < 4) {
        bytes /= 1000.0;
        unit++;
    }
    int decimals = unit == 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2;
    snprintf(out, HD_BYTE_TEXT_SIZE, "%.*f %s", decimals, bytes, units[unit]);
}

static HdStatus fail_table(const HdSceneTables *tables, int largest, const HdRoom *room,
                           HdError *error) {
    char need[HD_BYTE_TEXT_SIZE], at_once[HD_BYTE_TEXT_SIZE], memory[HD_BYTE_TEXT_SIZE];
    hd_byte_text((double)tables->table[largest].bytes, need);
    hd_byte_text(room->at_once, at_once);
    hd_byte_text(room->memory, memory);
    return hd_fail(
        error, HD_UNAVAILABLE, "the scene's %s need %s in one buffer; %s allows %s of its %s; %s",
        hd_scene_table_content(largest), need, room->name, at_once, memory, room->advice);
}

static HdStatus fail_all(const HdSceneTables *tables, int largest, double all, const HdRoom *room,
                         HdError *error) {
    char need[HD_BYTE_TEXT_SIZE], most[HD_BYTE_TEXT_SIZE], memory[HD_BYTE_TEXT_SIZE];
    hd_byte_text(all, need);
    hd_byte_text((double)tables->table[largest].bytes, most);
    hd_byte_text(room->memory, memory);
    return hd_fail(error, HD_UNAVAILABLE,
                   "the scene's tables need %s, %s of them for its %s; %s has %s; %s", need, most,
                   hd_scene_table_content(largest), room->name, memory, room->advice);
}

HdStatus hd_check_room(const HdSceneTables *tables, const HdRoom *room, HdError *error) {
    double all = 0.0;
    int largest = 0;
    for (int i = 0; i < tables->table_count; i++) {
        all += (double)tables->table[i].bytes;
        if (tables->table[i].bytes > tables->table[largest].bytes)
            largest = i;
    }
    if (room->memory > 0.0 && all > room->memory)
        return fail_all(tables, largest, all, room, error);
    if (room->at_once > 0.0 && (double)tables->table[largest].bytes > room->at_once)
        return fail_table(tables, largest, room, error);
    return HD_OK;
}

HdStatus hd_table_allocate(HdTable *table, const char *what, HdError *error) {
    char need[HD_BYTE_TEXT_SIZE];
    size_t bytes = (table->bytes + 63) / 64 * 64 + 64;
    hd_byte_text((double)table->bytes, need);
    table->data = hd_large_allocate(bytes);
    if (table->data == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: the %s need %s", what, need);
    memset(table->data, 0, bytes);
    return HD_OK;
}
