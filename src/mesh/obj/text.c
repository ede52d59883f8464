/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "mesh/obj/text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "mesh/mesh.h"

enum {
    RAW_SIZE = 1 << 17,
    MOST_DIGITS = 9, /* of a number of a vertex; ten might leave the range of fast_obj's int */
    KEYWORD_ROOM = 8 /* before and after what is copied of a line */
};

_Static_assert(RAW_SIZE > HD_OBJ_MOST_LINE + 2, "a line and its end fit into the buffer");

static const char no_material[] = HD_OBJ_NO_MATERIAL;

static const char byte_order_mark[] = "\xef\xbb\xbf";

static const char *const plurals[HD_OBJ_KIND_COUNT] = {"vertices", "texture coordinates",
                                                       "normals"};
static const char *const kinds[HD_OBJ_KIND_COUNT] = {"vertex", "texture coordinate", "normal"};

/* Statements that change nothing here, or that the file can do without. */
static const char *const harmless[] = {"o",   "g",     "s",        "usemap",  "maplib",
                                       "lod", "bevel", "c_interp", "d_interp"};

static bool fail_reading(HdObjText *text, const char *reason) {
    text->status =
        hd_fail(text->error, HD_BAD_INPUT, "cannot read the mesh %s: %s", text->path, reason);
    return false;
}

static bool fail_memory(HdObjText *text) {
    text->status = hd_obj_fail_memory(text->memory, text->path, text->error);
    return false;
}

#define fail_line(text, ...) fail_at((text), (text)->line_number, __VA_ARGS__)

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static bool
fail_at(HdObjText *text, size_t line, const char *format, ...) {
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    text->status =
        hd_fail(text->error, HD_BAD_INPUT, "%s: line %zu: %s", text->path, line, message);
    return false;
}

/* Reads until the buffer is full or the file ends. */
static bool fill(HdObjText *text) {
    memmove(text->raw, text->raw + text->raw_begin, text->raw_end - text->raw_begin);
    text->raw_end -= text->raw_begin;
    text->raw_begin = 0;
    while (!text->is_at_end && text->raw_end < RAW_SIZE) {
        const ssize_t count =
            read(text->descriptor, text->raw + text->raw_end, RAW_SIZE - text->raw_end);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return fail_reading(text, strerror(errno));
        text->is_at_end = count == 0;
        text->raw_end += (size_t)count;
    }
    return true;
}

HdStatus hd_obj_text_open(HdObjText *text) {
    struct stat found;
    text->material = -1;
    /* Not blocking, lest a named pipe stops the program before it is refused. */
    text->descriptor = open(text->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (text->descriptor < 0 || fstat(text->descriptor, &found) != 0)
        fail_reading(text, strerror(errno));
    else if (S_ISDIR(found.st_mode))
        fail_reading(text, strerror(EISDIR));
    else if (!S_ISREG(found.st_mode))
        fail_reading(text, "it is not a regular file");
    if (text->status != HD_OK)
        return text->status;
    text->raw = hd_obj_reallocate(text->memory, NULL, RAW_SIZE);
    text->joined = hd_obj_reallocate(text->memory, NULL, HD_OBJ_MOST_LINE);
    text->clean = hd_obj_reallocate(text->memory, NULL, HD_OBJ_MOST_LINE + KEYWORD_ROOM);
    if (text->raw == NULL || text->joined == NULL || text->clean == NULL)
        fail_memory(text);
    else if (fill(text) && text->raw_end >= 3 && memcmp(text->raw, byte_order_mark, 3) == 0)
        text->raw_begin = 3;
    return text->status;
}

void hd_obj_text_close(HdObjText *text) {
    if (text->descriptor >= 0)
        close(text->descriptor);
    text->descriptor = -1;
}

/* Looks for the line's end from `*at` on; false: it is not in the buffer, or something is wrong. */
static bool find_end(HdObjText *text, size_t *at) {
    const unsigned char *raw = (const unsigned char *)text->raw;
    for (; *at < text->raw_end; ++*at) {
        const unsigned char byte = raw[*at];
        if (byte > '\r')
            continue;
        if (byte == '\n' || byte == '\r')
            return true;
        if (byte == '\0')
            return fail_at(text, text->lines_read + 1, "it has a byte 0, so this is no OBJ file");
    }
    return false;
}

static bool is_comment(HdSpan line) {
    while (line.begin < line.end && (*line.begin == ' ' || *line.begin == '\t'))
        line.begin++;
    return line.begin < line.end && *line.begin == '#';
}

/* Takes the line end at raw_begin: "\n", "\r\n" or, as old files have it, "\r". */
static bool skip_end(HdObjText *text) {
    if (text->raw_begin == text->raw_end)
        return true;
    if (text->raw[text->raw_begin++] == '\n')
        return true;
    if (text->raw_begin == text->raw_end && !fill(text))
        return false;
    if (text->raw_begin < text->raw_end && text->raw[text->raw_begin] == '\n')
        text->raw_begin++;
    return true;
}

/* Passes over the rest of a comment that is longer than the buffer. */
static bool skip_comment(HdObjText *text) {
    size_t at = text->raw_end;
    while (!find_end(text, &at)) {
        if (text->status != HD_OK)
            return false;
        text->raw_begin = text->raw_end;
        if (!fill(text))
            return false;
        at = 0;
        if (text->raw_end == 0)
            return true;
    }
    text->raw_begin = at;
    return true;
}

/* The next line as it stands in the file; NULL for its begin at the end, or when something is
   wrong. It lasts until the next one is asked for, but skip_end() may move it. */
static HdSpan next_raw_line(HdObjText *text) {
    const HdSpan none = {NULL, NULL};
    size_t at = text->raw_begin;
    if (!find_end(text, &at)) {
        const size_t seen = at - text->raw_begin;
        if (text->status != HD_OK || !fill(text))
            return none;
        at = seen;
        if (!find_end(text, &at) && text->status != HD_OK)
            return none;
    }
    if (text->raw_begin == text->raw_end)
        return none;
    HdSpan line = {text->raw + text->raw_begin, text->raw + at};
    text->lines_read++;
    text->raw_begin = at;
    if (is_comment(line)) {
        line.end = line.begin;
        if (at == RAW_SIZE && !skip_comment(text))
            return none;
    } else if (line.end - line.begin > HD_OBJ_MOST_LINE) {
        fail_at(text, text->lines_read, "it is longer than %d bytes", HD_OBJ_MOST_LINE);
        return none;
    }
    return line;
}

static bool is_continued(HdSpan line) {
    return line.begin < line.end && line.end[-1] == '\\';
}

/* Puts a line and those that continue it together; false at the end, or when something is wrong. */
static bool next_line(HdObjText *text, HdSpan *line) {
    size_t used = 0;
    *line = next_raw_line(text);
    text->line_number = text->lines_read;
    while (line->begin != NULL && is_continued(*line)) {
        const size_t length = (size_t)(line->end - line->begin);
        if (used + length > HD_OBJ_MOST_LINE)
            return fail_line(text, "with those that continue it, it is longer than %d bytes",
                             HD_OBJ_MOST_LINE);
        memcpy(text->joined + used, line->begin, length);
        used += length;
        text->joined[used - 1] = ' ';
        if (!skip_end(text))
            return false;
        *line = next_raw_line(text);
    }
    if (text->status != HD_OK)
        return false;
    if (used == 0)
        return line->begin != NULL;
    const size_t length = line->begin != NULL ? (size_t)(line->end - line->begin) : 0;
    if (used + length > HD_OBJ_MOST_LINE)
        return fail_line(text, "with those that continue it, it is longer than %d bytes",
                         HD_OBJ_MOST_LINE);
    if (length > 0)
        memcpy(text->joined + used, line->begin, length);
    *line = (HdSpan){text->joined, text->joined + used + length};
    return true;
}

/* Hands the line on. */
static void keep(HdObjText *text, const char *keyword, HdSpan rest) {
    const size_t before = strlen(keyword), length = (size_t)(rest.end - rest.begin);
    memcpy(text->clean, keyword, before);
    memcpy(text->clean + before, rest.begin, length);
    text->clean[before + length] = '\n';
    text->clean_size = before + length + 1;
}

static bool is_statement_end(HdSpan word) {
    return word.begin == word.end || *word.begin == '#';
}

/* `least` numbers at least, of which at most `most` are handed on; what follows is for others. */
static bool keep_numbers(HdObjText *text, HdObjKind kind, const char *keyword, HdSpan line,
                         int least, int most) {
    HdSpan numbers = {NULL, NULL};
    for (int i = 0; i < most; i++) {
        double value;
        const HdSpan word = hd_next_word(&line);
        if (i >= least && is_statement_end(word))
            break;
        const char *fault = hd_number_fault(word, &value);
        if (fault != NULL)
            return fail_line(text, "number %d of a %s is '%.*s', expected %s", i + 1, kinds[kind],
                             hd_span_shown(word), word.begin, fault);
        if (i == 0)
            numbers.begin = word.begin;
        numbers.end = word.end;
    }
    text->elements[kind].count++;
    keep(text, keyword, numbers);
    return true;
}

/* Reads "-12" or "12"; without digits, `*number` is 0. NULL: too many digits. */
static const char *read_index(const char *at, const char *end, bool *has_digits, int64_t *number) {
    const bool is_negative = at < end && *at == '-';
    int64_t value = 0;
    int digits = 0;
    if (is_negative)
        at++;
    for (; at < end && *at >= '0' && *at <= '9'; at++) {
        if (++digits > MOST_DIGITS)
            return NULL;
        value = 10 * value + (*at - '0');
    }
    *has_digits = digits > 0;
    *number = is_negative ? -value : value;
    return is_negative && digits == 0 ? NULL : at;
}

/* Positive numbers may name what comes later; the highest is looked at again at the end. */
static bool check_index(HdObjText *text, HdObjKind kind, int64_t number, HdSpan word) {
    HdObjElements *elements = &text->elements[kind];
    const int64_t absolute = number < 0 ? elements->count + 1 + number : number;
    if (absolute > elements->highest) {
        elements->highest = absolute;
        elements->line_of_highest = text->line_number;
    }
    if (absolute > 0)
        return true;
    return fail_line(text,
                     "corner '%.*s' of a face names %s %lld, expected 1 and up, or -1 to -%lld "
                     "counted back from here",
                     hd_span_shown(word), word.begin, kinds[kind], (long long)number,
                     (long long)elements->count);
}

/* "v", "v/t", "v//n" or "v/t/n". */
static bool check_corner(HdObjText *text, HdSpan word) {
    const char *at = word.begin;
    for (int kind = HD_OBJ_VERTEX; kind < HD_OBJ_KIND_COUNT; kind++) {
        int64_t number;
        bool is_there;
        at = read_index(at, word.end, &is_there, &number);
        if (at == NULL || (kind == HD_OBJ_VERTEX && !is_there))
            break;
        if (is_there && !check_index(text, (HdObjKind)kind, number, word))
            return false;
        if (at == word.end)
            return true;
        if (*at++ != '/')
            break;
    }
    return fail_line(
        text,
        "corner '%.*s' of a face, expected numbers of a vertex, texture coordinate and "
        "normal as 1, 1/2, 1//3 or 1/2/3",
        hd_span_shown(word), word.begin);
}

static bool add_run(HdObjText *text) {
    if (text->run_count == text->run_room) {
        const size_t room = text->run_room > 0 ? 2 * text->run_room : 16;
        HdObjRun *runs = hd_obj_reallocate(text->memory, text->runs, room * sizeof *runs);
        if (runs == NULL)
            return fail_memory(text);
        text->runs = runs;
        text->run_room = room;
    }
    text->runs[text->run_count++] = (HdObjRun){(uint32_t)text->face_count, text->material};
    return true;
}

static bool set_material(HdObjText *text, HdSpan name) {
    const int number = hd_name_table_add(&text->names, name, text->memory);
    if (number == HD_NAME_NO_MEMORY)
        return fail_memory(text);
    if (number == HD_NAME_TOO_MANY)
        return fail_line(text, "there are more materials than fit, expected at most %d",
                         (int)HD_MAX_MESH_MATERIALS);
    text->material = number;
    return true;
}

/* Before a face is counted. */
static bool note_material(HdObjText *text) {
    if (text->material < 0 &&
        !set_material(text, (HdSpan){no_material, no_material + strlen(no_material)}))
        return false;
    return (text->run_count > 0 && text->runs[text->run_count - 1].material == text->material) ||
           add_run(text);
}

static bool keep_face(HdObjText *text, HdSpan line) {
    HdSpan corners = {NULL, NULL};
    int count = 0;
    for (;; count++) {
        const HdSpan word = hd_next_word(&line);
        if (is_statement_end(word))
            break;
        if (!check_corner(text, word))
            return false;
        if (count == 0)
            corners.begin = word.begin;
        corners.end = word.end;
    }
    if (count < 3)
        return fail_line(text, "a face has %d corner%s, expected at least 3", count,
                         count == 1 ? "" : "s");
    if (!note_material(text))
        return false;
    text->face_count++;
    text->triangle_count += count - 2;
    if (count > text->most_corners)
        text->most_corners = count;
    if (text->triangle_count > HD_MAX_MESH_TRIANGLES)
        return fail_line(text, "there are more than %d triangles", (int)HD_MAX_MESH_TRIANGLES);
    keep(text, "f ", corners);
    return true;
}

static bool keep_name(HdObjText *text, HdSpan line, const char *what, bool is_library) {
    const HdSpan name = hd_rest(line);
    const char *fault = hd_name_fault(name);
    if (fault != NULL)
        return fail_line(text, "the name of a %s, expected %s", what, fault);
    if (!is_library)
        return set_material(text, name);
    keep(text, "mtllib ", name);
    return true;
}

/* Of what is left out the first is told. Rubbish seldom begins with a word. */
static bool leave_out(HdObjText *text, HdSpan word) {
    for (const char *at = word.begin; at < word.end; at++)
        if (*at <= ' ' || *at > '~')
            return fail_line(text, "it begins with byte 0x%02x, so this is no OBJ file",
                             (unsigned)(unsigned char)*at);
    for (size_t i = 0; i < sizeof harmless / sizeof *harmless; i++)
        if (hd_span_is(word, harmless[i]))
            return true;
    if (!text->has_left_out)
        hd_problem(text->notes,
                   "%s: line %zu: statements such as '%.*s' are not used, only faces (f) are",
                   text->path, text->line_number, hd_span_shown(word), word.begin);
    text->has_left_out = true;
    return true;
}

static bool take_line(HdObjText *text, HdSpan line) {
    const HdSpan word = hd_next_word(&line);
    if (is_statement_end(word))
        return true;
    if (hd_span_is(word, "v"))
        return keep_numbers(text, HD_OBJ_VERTEX, "v ", line, 3, 3);
    if (hd_span_is(word, "f"))
        return keep_face(text, line);
    if (hd_span_is(word, "vn"))
        return keep_numbers(text, HD_OBJ_NORMAL, "vn ", line, 3, 3);
    if (hd_span_is(word, "vt"))
        return keep_numbers(text, HD_OBJ_UV, "vt ", line, 1, 2);
    if (hd_span_is(word, "usemtl"))
        return keep_name(text, line, "material", false);
    if (hd_span_is(word, "mtllib"))
        return keep_name(text, line, "material library", true);
    return leave_out(text, word);
}

/* Reads lines until one is to be handed on. */
static bool find_clean_line(HdObjText *text) {
    HdSpan line;
    while (text->clean_size == 0) {
        if (!next_line(text, &line) || !take_line(text, line) || !skip_end(text))
            return false;
    }
    return true;
}

size_t hd_obj_text_read(HdObjText *text, char *to, size_t room) {
    size_t used = 0;
    while (text->status == HD_OK && find_clean_line(text) && text->clean_size <= room - used) {
        memcpy(to + used, text->clean, text->clean_size);
        used += text->clean_size;
        text->clean_size = 0;
    }
    return text->status == HD_OK ? used : 0;
}

HdStatus hd_obj_text_finish(HdObjText *text) {
    for (int kind = 0; text->status == HD_OK && kind < HD_OBJ_KIND_COUNT; kind++) {
        const HdObjElements *elements = &text->elements[kind];
        if (elements->highest > elements->count)
            fail_at(text, elements->line_of_highest, "a face names %s %lld, and there are %lld %s",
                    kinds[kind], (long long)elements->highest, (long long)elements->count,
                    plurals[kind]);
    }
    if (text->status == HD_OK && text->face_count == 0)
        fail_reading(text, text->elements[HD_OBJ_VERTEX].count > 0
                               ? "it has vertices, but no faces"
                               : "it has no faces, so it is empty or no OBJ file");
    return text->status;
}
