/* SPDX-License-Identifier: MIT */
/* Memory for tables: whether a scene's fit, told in words that help where they do not. */
#ifndef HD_TABLES_ROOM_H
#define HD_TABLES_ROOM_H

#include "base/error.h"
#include "tables/table.h"

enum { HD_BYTE_TEXT_SIZE = 32 };

/* For messages: "288 MB", "1.07 GB"; less than a thousand as "16 bytes". */
void hd_byte_text(double bytes, char out[HD_BYTE_TEXT_SIZE]);

/* What users may do where a device has too little memory; ends a sentence. */
extern const char hd_room_advice[];

typedef struct HdRoom {
    const char *name;   /* of the device or machine */
    const char *advice; /* what to do where it is too little */
    double memory;      /* bytes in all; 0: unknown */
    double at_once;     /* most bytes of one table; 0: unknown */
} HdRoom;

/* HD_UNAVAILABLE where a table, or all of them, can never fit, however much is free: with what is
   too large, what it needs, and what there is. */
HdStatus hd_check_room(const HdSceneTables *tables, const HdRoom *room, HdError *error);

/* Memory for table->bytes, zeroed and aligned for the widest loads; at least one unit, so that no
   table is NULL. `what` names it in a message: "scene's triangles". */
HdStatus hd_table_allocate(HdTable *table, const char *what, HdError *error);

#endif
