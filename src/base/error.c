/* SPDX-License-Identifier: MIT */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

HdStatus hd_fail(HdError *error, HdStatus status, const char *format, ...) {
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    error->status = status;
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    hd_escape_lines(message, error->message, sizeof error->message);
    return status;
}

void hd_error_prefix(HdError *error, const char *name) {
    hd_fail(error, error->status, "%s: %s", name, error->message);
}

/* shortest possible line of a problem, line break included */
enum { MIN_LINE_BYTES = 16 };

void hd_problem(HdProblems *problems, const char *format, ...) {
    char text[2048], line[sizeof text];
    va_list arguments;
    if (hd_problems_are_full(problems)) {
        problems->count++;
        return;
    }
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    hd_escape(text, line, sizeof line);
    problems->count++;
    const size_t capacity = sizeof problems->text - problems->used;
    if (strlen(line) + 2 > capacity)
        return;
    problems->used += (size_t)snprintf(problems->text + problems->used, capacity, "%s\n", line);
}

bool hd_problems_are_full(const HdProblems *problems) {
    return problems->count >= (int)sizeof problems->text / MIN_LINE_BYTES;
}

HdStatus hd_problems_first(const HdProblems *problems, HdError *error) {
    if (problems->count == 0)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT, "%.*s", (int)strcspn(problems->text, "\n"), problems->text);
}

void hd_problems_print(const HdProblems *problems, FILE *out, const char *name, const char *kind) {
    for (const char *line = problems->text; *line != '\0'; line += strcspn(line, "\n") + 1)
        fprintf(out, "%s%s%.*s\n", name, kind, (int)strcspn(line, "\n"), line);
}

HdStatus hd_problems_status(const HdProblems *problems, const char *name, HdError *error) {
    char whole[sizeof error->message];
    int listed = 0;
    const HdStatus status = hd_problems_first(problems, error);
    if (problems->count == 1)
        hd_error_prefix(error, name);
    if (problems->count <= 1)
        return status;
    snprintf(whole, sizeof whole, "%s: %d problems", name, problems->count);
    for (const char *line = problems->text; *line != '\0'; line += strcspn(line, "\n") + 1) {
        hd_add_text(whole, sizeof whole, "\n  ", "%.*s", (int)strcspn(line, "\n"), line);
        listed++;
    }
    if (listed < problems->count)
        hd_add_text(whole, sizeof whole, "\n  ", "and more of them");
    return hd_fail(error, HD_BAD_INPUT, "%s", whole);
}

void hd_fault(HdFaults *faults, const char *kind, size_t count, const char *format, ...) {
    va_list arguments;
    int at = 0;
    while (at < faults->kind_count && strcmp(faults->kinds[at].kind, kind) != 0)
        at++;
    if (at == HD_MAX_FAULT_KINDS)
        return;
    if (at == faults->kind_count) {
        faults->kind_count++;
        faults->kinds[at].kind = kind;
        va_start(arguments, format);
        vsnprintf(faults->kinds[at].first, sizeof faults->kinds[at].first, format, arguments);
        va_end(arguments);
    }
    faults->kinds[at].count += count;
}

void hd_faults_report(const HdFaults *faults, const char *name, HdProblems *problems) {
    for (int i = 0; i < faults->kind_count; i++) {
        char number[32] = "";
        if (faults->kinds[i].count > 1)
            snprintf(number, sizeof number, " (%zu times)", faults->kinds[i].count);
        hd_problem(problems, "%s%s%s%s", name != NULL ? name : "", name != NULL ? ": " : "",
                   faults->kinds[i].first, number);
    }
}
