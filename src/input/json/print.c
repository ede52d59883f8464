/* SPDX-License-Identifier: MIT */
#include "input/json/print.h"

#include "base/text.h"

static void start_line(HdJsonPrinter *printer) {
    fprintf(printer->out, "\n%*s", 2 * printer->depth, "");
}

/* What stands between the value before and the key or value that comes now. */
static void separate(HdJsonPrinter *printer) {
    if (printer->has_key) {
        printer->has_key = false;
        return;
    }
    if (printer->has_elements)
        putc(',', printer->out);
    if (printer->depth > 0)
        start_line(printer);
    printer->has_elements = true;
}

static void print_string(FILE *out, const char *text) {
    putc('"', out);
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else if (c < 0x20 || c == 0x7f)
            fprintf(out, "\\u%04x", c);
        else
            putc(c, out);
    }
    putc('"', out);
}

void hd_json_key(HdJsonPrinter *printer, const char *key) {
    separate(printer);
    print_string(printer->out, key);
    fputs(": ", printer->out);
    printer->has_key = true;
}

void hd_json_open(HdJsonPrinter *printer, char bracket) {
    separate(printer);
    putc(bracket, printer->out);
    printer->depth++;
    printer->has_elements = false;
}

void hd_json_close(HdJsonPrinter *printer, char bracket) {
    printer->depth--;
    if (printer->has_elements)
        start_line(printer);
    putc(bracket, printer->out);
    printer->has_elements = true;
}

void hd_json_raw(HdJsonPrinter *printer, const char *json) {
    separate(printer);
    fputs(json, printer->out);
}

void hd_json_string(HdJsonPrinter *printer, const char *text) {
    separate(printer);
    print_string(printer->out, text);
}

void hd_json_number(HdJsonPrinter *printer, double value) {
    char text[HD_NUMBER_SIZE];
    hd_exact_number(value, text);
    hd_json_raw(printer, text);
}

void hd_json_vector(HdJsonPrinter *printer, HdVec3 value) {
    const double parts[3] = {value.x, value.y, value.z};
    char text[3][HD_NUMBER_SIZE];
    for (int i = 0; i < 3; i++)
        hd_exact_number(parts[i], text[i]);
    separate(printer);
    fprintf(printer->out, "[%s, %s, %s]", text[0], text[1], text[2]);
}
