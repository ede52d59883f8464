/* SPDX-License-Identifier: MIT */
#include "mesh/obj/mtl_text.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_NOTED = 32, MOST_ILLUM = 10 };

typedef struct Reader {
    const HdMtlSource *source;
    HdMtlDefinitions *definitions;
    HdObjMemory *memory;
    HdProblems *notes;
    size_t line;
    bool is_in_material;
    bool has_dissolve;         /* the material has d, so Tr does not count */
    HdMtlDefinition *material; /* which is being defined; */
    HdMtlDefinition unused;    /* this one, where it is not wanted */
    bool is_out_of_memory;
    HdSpan noted[MOST_NOTED]; /* statements whose first use has been told */
    int noted_count;
} Reader;

#define note(reader, format, ...)                                                                  \
    hd_problem((reader)->notes, "%s: line %zu: " format, (reader)->source->path, (reader)->line,   \
               __VA_ARGS__)

/* Of two materials with one name the first counts. */
static HdMtlDefinition *define(Reader *reader, HdSpan name) {
    HdMtlDefinitions *definitions = reader->definitions;
    const int number = hd_name_table_find(definitions->names, name);
    if (number < 0 || definitions->of[number].is_defined)
        return &reader->unused;
    definitions->order[definitions->count++] = number;
    definitions->of[number].is_defined = true;
    return &definitions->of[number];
}

static void start_material(Reader *reader, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    reader->is_in_material = fault == NULL;
    reader->has_dissolve = false;
    if (fault != NULL)
        note(reader, "the name of a material, expected %s; it is left out", fault);
    else
        reader->material = define(reader, name);
}

/* Reads up to `most` numbers, at least one. 0, after a note: they are not all right. */
static int read_numbers(Reader *reader, HdSpan keyword, HdSpan line, int most, double *values) {
    for (int i = 0; i < most; i++) {
        const HdSpan word = hd_next_word(&line);
        if (i > 0 && word.begin == word.end)
            return i;
        const char *fault = hd_number_fault(word, &values[i]);
        if (fault != NULL) {
            note(reader, "%.*s has '%.*s', expected %s; the line is left out",
                 hd_span_shown(keyword), keyword.begin, hd_span_shown(word), word.begin, fault);
            return 0;
        }
    }
    return most;
}

/* One number stands for all three of a colour. */
static void keep_numbers(Reader *reader, HdSpan keyword, HdSpan line, float *to, int most) {
    double values[3];
    const int count = read_numbers(reader, keyword, line, most, values);
    if (count == 0)
        return;
    for (int i = 0; i < most; i++)
        to[i] = (float)values[i < count ? i : 0];
    reader->has_dissolve |= hd_span_is(keyword, "d");
}

/* In millionths, so that 1 - 0.9 is 0.1. */
static void keep_transparency(Reader *reader, HdSpan keyword, HdSpan line) {
    double value;
    if (read_numbers(reader, keyword, line, 1, &value) == 0 || reader->has_dissolve)
        return;
    const double opacity = value < 0.0 ? 1.0 : value > 1.0 ? 0.0 : 1.0 - value;
    reader->material->parameters.d = (float)((int)(opacity * 1e6 + 0.5) / 1e6);
    if (value < 0.0 || value > 1.0)
        note(reader, "Tr is %.9g, expected 0 to 1, and is taken for the nearer of them", value);
}

static void keep_illum(Reader *reader, HdSpan line) {
    double value;
    const HdSpan word = hd_next_word(&line);
    if (hd_number_fault(word, &value) != NULL || value < 0.0 || value > MOST_ILLUM ||
        value != (int)value)
        note(reader, "illum is '%.*s', expected 0 to %d; the line is left out", hd_span_shown(word),
             word.begin, (int)MOST_ILLUM);
    else
        reader->material->parameters.illum = (int)value;
}

static char *append(char *to, HdSpan span) {
    const size_t length = (size_t)(span.end - span.begin);
    memcpy(to, span.begin, length);
    return to + length;
}

/* The last one counts. */
static void set_texture(Reader *reader, HdSpan name) {
    const HdMtlSource *source = reader->source;
    const size_t size = (size_t)(source->mesh_folder.end - source->mesh_folder.begin) +
                        (size_t)(source->folder.end - source->folder.begin) +
                        (size_t)(name.end - name.begin) + 1;
    char *texture = hd_obj_allocate(reader->memory, size, 1);
    if (texture == NULL) {
        reader->is_out_of_memory = true;
        return;
    }
    char *own = append(texture, source->mesh_folder);
    *append(append(own, source->folder), name) = '\0';
    hd_fix_separators(own);
    free(reader->material->texture);
    reader->material->texture = texture;
}

static void keep_texture(Reader *reader, HdSpan line) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_file_name_fault(name);
    if (fault == NULL && *name.begin == '-')
        fault = "a name without options before it";
    if (fault != NULL)
        note(reader, "map_Kd is '%.*s', expected %s; there will be no texture", hd_span_shown(name),
             name.begin, fault);
    else if (reader->material != &reader->unused)
        set_texture(reader, name);
}

static void leave_out(Reader *reader, HdSpan keyword) {
    const size_t length = (size_t)(keyword.end - keyword.begin);
    for (int i = 0; i < reader->noted_count; i++) {
        const HdSpan noted = reader->noted[i];
        if ((size_t)(noted.end - noted.begin) == length &&
            memcmp(noted.begin, keyword.begin, length) == 0)
            return;
    }
    if (reader->noted_count == MOST_NOTED)
        return;
    reader->noted[reader->noted_count++] = keyword;
    if (hd_name_fault(keyword) == NULL)
        note(reader, "%.*s is not used", hd_span_shown(keyword), keyword.begin);
    else
        note(reader, "%s", "it has no statement of a material library");
}

static void take_statement(Reader *reader, HdSpan keyword, HdSpan line) {
    HdMtlParameters *to = &reader->material->parameters;
    const struct {
        const char *keyword;
        float *to;
        int count;
    } numbers[] = {{"Kd", to->Kd, 3}, {"Ka", to->Ka, 3},  {"Ks", to->Ks, 3},  {"Ke", to->Ke, 3},
                   {"Tf", to->Tf, 3}, {"Ns", &to->Ns, 1}, {"Ni", &to->Ni, 1}, {"d", &to->d, 1}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (hd_span_is(keyword, numbers[i].keyword)) {
            keep_numbers(reader, keyword, line, numbers[i].to, numbers[i].count);
            return;
        }
    if (hd_span_is(keyword, "Tr"))
        keep_transparency(reader, keyword, line);
    else if (hd_span_is(keyword, "illum"))
        keep_illum(reader, line);
    else if (hd_span_is(keyword, "map_Kd"))
        keep_texture(reader, line);
    else
        leave_out(reader, keyword);
}

static void take_line(Reader *reader, HdSpan line) {
    const HdSpan keyword = hd_next_word(&line);
    if (keyword.begin == keyword.end || *keyword.begin == '#')
        return;
    if (hd_span_is(keyword, "newmtl"))
        start_material(reader, line);
    else if (reader->is_in_material)
        take_statement(reader, keyword, line);
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

bool hd_mtl_read(const HdMtlSource *source, HdMtlDefinitions *definitions, HdObjMemory *memory,
                 HdProblems *notes) {
    Reader reader = {
        .source = source, .definitions = definitions, .memory = memory, .notes = notes};
    HdSpan rest = source->text;
    if (memchr(rest.begin, '\0', (size_t)(rest.end - rest.begin)) != NULL) {
        hd_problem(notes, "%s: it has bytes 0, so this is no material library", source->path);
        return true;
    }
    while (rest.begin < rest.end) {
        reader.line++;
        take_line(&reader, take_next_line(&rest));
    }
    return !reader.is_out_of_memory;
}
