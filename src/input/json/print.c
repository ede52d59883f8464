/* SPDX-License-Identifier: MIT */
#include "input/json/print.h"

#include <string.h>

#include "base/hash.h"
#include "base/text.h"

static void put(HdJsonPrinter *printer, const char *text) {
    if (printer->out != NULL)
        fputs(text, printer->out);
    else
        printer->hash = hd_hash_bytes(printer->hash, text, strlen(text));
}

static void start_line(HdJsonPrinter *printer) {
    put(printer, "\n");
    for (int i = 0; i < printer->depth; i++)
        put(printer, "  ");
}

/* What stands between the value before and the key or value that comes now. */
static void separate(HdJsonPrinter *printer) {
    if (printer->has_key) {
        printer->has_key = false;
        return;
    }
    if (printer->has_elements)
        put(printer, ",");
    if (printer->depth > 0)
        start_line(printer);
    printer->has_elements = true;
}

static void put_string(HdJsonPrinter *printer, const char *text) {
    char piece[8];
    put(printer, "\"");
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            snprintf(piece, sizeof piece, "\\%c", c);
        else if (c < 0x20 || c == 0x7f)
            snprintf(piece, sizeof piece, "\\u%04x", c);
        else
            snprintf(piece, sizeof piece, "%c", c);
        put(printer, piece);
    }
    put(printer, "\"");
}

void hd_json_key(HdJsonPrinter *printer, const char *key) {
    separate(printer);
    put_string(printer, key);
    put(printer, ": ");
    printer->has_key = true;
}

void hd_json_open(HdJsonPrinter *printer, char bracket) {
    const char text[2] = {bracket, '\0'};
    separate(printer);
    put(printer, text);
    printer->depth++;
    printer->has_elements = false;
}

void hd_json_close(HdJsonPrinter *printer, char bracket) {
    const char text[2] = {bracket, '\0'};
    printer->depth--;
    if (printer->has_elements)
        start_line(printer);
    put(printer, text);
    printer->has_elements = true;
}

void hd_json_raw(HdJsonPrinter *printer, const char *json) {
    separate(printer);
    put(printer, json);
}

void hd_json_string(HdJsonPrinter *printer, const char *text) {
    separate(printer);
    put_string(printer, text);
}

void hd_json_number(HdJsonPrinter *printer, double value) {
    char text[HD_NUMBER_SIZE];
    hd_exact_number(value, text);
    hd_json_raw(printer, text);
}

void hd_json_vector(HdJsonPrinter *printer, HdVec3 value) {
    const double parts[3] = {value.x, value.y, value.z};
    char text[HD_NUMBER_SIZE];
    separate(printer);
    for (int i = 0; i < 3; i++) {
        hd_exact_number(parts[i], text);
        put(printer, i == 0 ? "[" : ", ");
        put(printer, text);
    }
    put(printer, "]");
}
