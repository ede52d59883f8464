/* SPDX-License-Identifier: MIT */
#include "mesh/obj/mtl_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MOST_NOTED = 32, MOST_ILLUM = 10 };

typedef struct Cleaner {
    const HdMtlSource *source;
    HdObjMemory *memory;
    HdProblems *notes;
    size_t line;
    bool is_in_material;
    bool has_dissolve; /* the material has d, so Tr does not count */
    char *clean;
    size_t size, room;
    bool is_out_of_memory;
    HdSpan noted[MOST_NOTED]; /* statements whose first use has been told */
    int noted_count;
} Cleaner;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
note(Cleaner *cleaner, const char *format, ...) {
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    hd_problem(cleaner->notes, "%s: line %zu: %s", cleaner->source->path, cleaner->line, message);
}

static void add(Cleaner *cleaner, HdSpan span) {
    const size_t length = (size_t)(span.end - span.begin);
    if (cleaner->is_out_of_memory)
        return;
    if (length > cleaner->room - cleaner->size) {
        const size_t room = 2 * (cleaner->size + length) + 1024;
        char *grown = hd_obj_reallocate(cleaner->memory, cleaner->clean, room);
        cleaner->is_out_of_memory = grown == NULL;
        if (grown == NULL)
            return;
        cleaner->clean = grown;
        cleaner->room = room;
    }
    memcpy(cleaner->clean + cleaner->size, span.begin, length);
    cleaner->size += length;
}

static void add_text(Cleaner *cleaner, const char *text) {
    add(cleaner, (HdSpan){text, text + strlen(text)});
}

static void start_material(Cleaner *cleaner, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    cleaner->is_in_material = fault == NULL;
    cleaner->has_dissolve = false;
    if (fault != NULL) {
        note(cleaner, "the name of a material, expected %s; it is left out", fault);
        return;
    }
    add_text(cleaner, "newmtl ");
    add(cleaner, name);
    add_text(cleaner, "\nKt -1 0 0\nNs 64\n");
}

/* Reads up to `most` numbers; 0, after a note: they are not all right. */
static int read_numbers(Cleaner *cleaner, HdSpan keyword, HdSpan line, int most, HdSpan *words,
                        double *value) {
    for (int i = 0; i < most; i++) {
        words[i] = hd_next_word(&line);
        if (i > 0 && words[i].begin == words[i].end)
            return i;
        const char *fault = hd_number_fault(words[i], value);
        if (fault != NULL) {
            note(cleaner, "%.*s has '%.*s', expected %s; the line is left out",
                 hd_span_shown(keyword), keyword.begin, hd_span_shown(words[i]), words[i].begin,
                 fault);
            return 0;
        }
    }
    return most;
}

/* One number stands for all three. */
static void keep_colour(Cleaner *cleaner, HdSpan keyword, HdSpan line) {
    double value;
    HdSpan words[3];
    const int count = read_numbers(cleaner, keyword, line, 3, words, &value);
    if (count == 0)
        return;
    add(cleaner, keyword);
    for (int i = 0; i < 3; i++) {
        add_text(cleaner, " ");
        add(cleaner, words[i < count ? i : 0]);
    }
    add_text(cleaner, "\n");
}

static void keep_number(Cleaner *cleaner, HdSpan keyword, HdSpan line) {
    double value;
    HdSpan word;
    if (read_numbers(cleaner, keyword, line, 1, &word, &value) == 0)
        return;
    cleaner->has_dissolve |= hd_span_is(keyword, "d");
    add(cleaner, keyword);
    add_text(cleaner, " ");
    add(cleaner, word);
    add_text(cleaner, "\n");
}

/* fast_obj forgets to ask anew for each material whether there is a d. */
static void keep_transparency(Cleaner *cleaner, HdSpan keyword, HdSpan line) {
    char text[32];
    double value;
    HdSpan word;
    if (read_numbers(cleaner, keyword, line, 1, &word, &value) == 0 || cleaner->has_dissolve)
        return;
    const double opacity = value < 0.0 ? 1.0 : value > 1.0 ? 0.0 : 1.0 - value;
    const int millionths = (int)(opacity * 1e6 + 0.5);
    /* Not %f, which follows the language of the system. */
    snprintf(text, sizeof text, "d %d.%06d\n", millionths / 1000000, millionths % 1000000);
    add_text(cleaner, text);
    if (value < 0.0 || value > 1.0)
        note(cleaner, "Tr is %.9g, expected 0 to 1, and is taken for the nearer of them", value);
}

static void keep_illum(Cleaner *cleaner, HdSpan line) {
    double value;
    char text[32];
    const HdSpan word = hd_next_word(&line);
    if (hd_number_fault(word, &value) != NULL || value < 0.0 || value > MOST_ILLUM ||
        value != (int)value) {
        note(cleaner, "illum is '%.*s', expected 0 to %d; the line is left out",
             hd_span_shown(word), word.begin, (int)MOST_ILLUM);
        return;
    }
    snprintf(text, sizeof text, "Kt %d 0 0\n", (int)value);
    add_text(cleaner, text);
}

static void keep_texture(Cleaner *cleaner, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_file_name_fault(name);
    if (fault == NULL && *name.begin == '-')
        fault = "a name without options before it";
    if (fault != NULL) {
        note(cleaner, "map_Kd is '%.*s', expected %s; there will be no texture",
             hd_span_shown(name), name.begin, fault);
        return;
    }
    add_text(cleaner, "map_Kd " HD_MTL_HERE);
    add_text(cleaner, cleaner->source->folder);
    add(cleaner, name);
    add_text(cleaner, "\n");
}

static void leave_out(Cleaner *cleaner, HdSpan keyword) {
    const size_t length = (size_t)(keyword.end - keyword.begin);
    for (int i = 0; i < cleaner->noted_count; i++) {
        const HdSpan noted = cleaner->noted[i];
        if ((size_t)(noted.end - noted.begin) == length &&
            memcmp(noted.begin, keyword.begin, length) == 0)
            return;
    }
    if (cleaner->noted_count == MOST_NOTED)
        return;
    cleaner->noted[cleaner->noted_count++] = keyword;
    if (hd_name_fault(keyword) == NULL)
        note(cleaner, "%.*s is not used", hd_span_shown(keyword), keyword.begin);
    else
        note(cleaner, "it has no statement of a material library");
}

static bool is_one_of(HdSpan word, const char *const *list, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (hd_span_is(word, list[i]))
            return true;
    return false;
}

static void take_statement(Cleaner *cleaner, HdSpan keyword, HdSpan line) {
    static const char *const colours[] = {"Kd", "Ka", "Ks", "Ke", "Tf"};
    static const char *const numbers[] = {"Ns", "Ni", "d"};
    if (is_one_of(keyword, colours, sizeof colours / sizeof *colours))
        keep_colour(cleaner, keyword, line);
    else if (is_one_of(keyword, numbers, sizeof numbers / sizeof *numbers))
        keep_number(cleaner, keyword, line);
    else if (hd_span_is(keyword, "Tr"))
        keep_transparency(cleaner, keyword, line);
    else if (hd_span_is(keyword, "illum"))
        keep_illum(cleaner, line);
    else if (hd_span_is(keyword, "map_Kd"))
        keep_texture(cleaner, line);
    else
        leave_out(cleaner, keyword);
}

static void take_line(Cleaner *cleaner, HdSpan line) {
    const HdSpan keyword = hd_next_word(&line);
    if (keyword.begin == keyword.end || *keyword.begin == '#')
        return;
    if (hd_span_is(keyword, "newmtl"))
        start_material(cleaner, line);
    else if (cleaner->is_in_material)
        take_statement(cleaner, keyword, line);
}

/* Takes a line that ends in "\n", "\r\n" or "\r", or at the text's end. */
static HdSpan take_next_line(HdSpan *text) {
    const char *at = text->begin;
    while (at < text->end && *at != '\n' && *at != '\r')
        at++;
    const HdSpan line = {text->begin, at};
    if (at < text->end && *at++ == '\r' && at < text->end && *at == '\n')
        at++;
    text->begin = at;
    return line;
}

char *hd_mtl_clean(const HdMtlSource *source, HdObjMemory *memory, HdProblems *notes,
                   size_t *size) {
    Cleaner cleaner = {.source = source, .memory = memory, .notes = notes};
    HdSpan rest = source->text;
    if (memchr(rest.begin, '\0', (size_t)(rest.end - rest.begin)) != NULL) {
        hd_problem(notes, "%s: it has bytes 0, so this is no material library", source->path);
        rest.end = rest.begin;
    }
    add_text(&cleaner, "\n"); /* so that there is a text, and no memory means no text */
    while (rest.begin < rest.end) {
        cleaner.line++;
        take_line(&cleaner, take_next_line(&rest));
    }
    *size = cleaner.size;
    if (!cleaner.is_out_of_memory)
        return cleaner.clean;
    hd_obj_release(memory, cleaner.clean);
    return NULL;
}
