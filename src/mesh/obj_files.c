/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "mesh/obj_files.h"

#include <string.h>
#include <strings.h>

#include "system/path.h"

enum { MAX_PARTS = 8 };

static bool is_separator(char c) {
    return c == '/' || c == '\\';
}

static bool has_drive(HdSpan name) {
    return name.end - name.begin > 1 && name.begin[1] == ':';
}

/* Returns where the part of a name begins that ends at `end`. */
static const char *start_of_part(const char *begin, const char *end) {
    while (end > begin && !is_separator(end[-1]))
        end--;
    return end;
}

const char *hd_obj_file_name_fault(HdSpan name) {
    if (hd_name_fault(name) != NULL)
        return hd_name_fault(name);
    if (is_separator(*name.begin) || has_drive(name))
        return "a name relative to this file's folder";
    for (const char *end = name.end, *begin; end > name.begin; end = begin - (begin > name.begin)) {
        begin = start_of_part(name.begin, end);
        if (hd_span_is((HdSpan){begin, end}, ".."))
            return "a name in this file's folder or below it";
    }
    return NULL;
}

HdSpan hd_obj_folder(HdSpan path) {
    return (HdSpan){path.begin, start_of_part(path.begin, path.end)};
}

char *hd_obj_path(HdObjMemory *memory, const HdObjPlace *place, HdSpan name) {
    const HdSpan parts[3] = {place->base, place->folder, name};
    size_t size = 0, used = 0;
    for (int i = 0; i < 3; i++)
        size += hd_span_size(parts[i]);
    char *path = hd_obj_allocate(memory, size + 1, 1);
    for (int i = 0; path != NULL && i < 3; used += hd_span_size(parts[i]), i++)
        memcpy(path + used, parts[i].begin, hd_span_size(parts[i]));
    for (size_t i = hd_span_size(place->base); path != NULL && i < size; i++)
        path[i] = path[i] == '\\' ? '/' : path[i];
    if (path != NULL)
        path[size] = '\0';
    return path;
}

/* Returns the path if a regular file is there. */
static char *try_path(HdObjMemory *memory, const HdObjPlace *place, HdSpan name) {
    struct stat found;
    char *path = hd_obj_file_name_fault(name) == NULL ? hd_obj_path(memory, place, name) : NULL;
    if (path == NULL || (stat(path, &found) == 0 && S_ISREG(found.st_mode)))
        return path;
    hd_obj_release(memory, path, strlen(path) + 1);
    return NULL;
}

static HdSpan without_quotes(HdSpan name) {
    const bool is_quoted = hd_span_size(name) > 1 && *name.begin == '"' && name.end[-1] == '"';
    return is_quoted ? (HdSpan){name.begin + 1, name.end - 1} : name;
}

typedef struct Search {
    char name[HD_MAX_PATH];  /* name to find in any letter case */
    char found[HD_MAX_PATH]; /* empty: none */
} Search;

static void compare_name(void *context, const char *name) {
    Search *search = context;
    const bool is_first = search->found[0] == '\0' || strcmp(name, search->found) < 0;
    if (strcasecmp(name, search->name) == 0 && is_first)
        snprintf(search->found, sizeof search->found, "%s", name);
}

static char *try_other_case(HdObjMemory *memory, const HdObjPlace *place, HdSpan name) {
    Search search = {.found = ""};
    char *folder = hd_obj_path(memory, place, hd_span_of("")), *path = NULL;
    snprintf(search.name, sizeof search.name, "%.*s", (int)hd_span_size(name), name.begin);
    if (folder != NULL)
        hd_path_visit(folder, compare_name, &search);
    if (search.found[0] != '\0')
        path = try_path(memory, place, hd_span_of(search.found));
    hd_obj_release(memory, folder, folder != NULL ? strlen(folder) + 1 : 0);
    return path;
}

/* Looks for the last parts of a name in one folder. */
static char *find_in(HdObjMemory *memory, const HdObjPlace *place, HdSpan name) {
    const char *begins[MAX_PARTS];
    int count = 0;
    char *path = NULL;
    for (const char *begin = NULL, *end = name.end; begin != name.begin && count < MAX_PARTS;
         end = begin - (begin > name.begin)) {
        begin = start_of_part(name.begin, end);
        if (hd_span_is((HdSpan){begin, end}, "..") || has_drive((HdSpan){begin, end}))
            break;
        begins[count++] = begin;
    }
    while (count > 0 && path == NULL)
        path = try_path(memory, place, (HdSpan){begins[--count], name.end});
    if (path != NULL || hd_span_size(name) >= HD_MAX_PATH)
        return path;
    return try_other_case(memory, place, (HdSpan){start_of_part(name.begin, name.end), name.end});
}

static HdSpan plain_name(HdSpan name) {
    return without_quotes(hd_without_comment(name));
}

static char *find_as_named(HdObjMemory *memory, const HdObjPlace *place, HdSpan name) {
    char *path = try_path(memory, place, name);
    return path != NULL ? path : try_path(memory, place, plain_name(name));
}

bool hd_obj_has_file(HdObjMemory *memory, const HdObjPlace *place, HdSpan name) {
    char *path = find_as_named(memory, place, name);
    hd_obj_release(memory, path, path != NULL ? strlen(path) + 1 : 0);
    return path != NULL;
}

char *hd_obj_find_file(HdObjMemory *memory, const HdObjPlace *place, HdSpan name,
                       bool *is_elsewhere) {
    char *path = find_as_named(memory, place, name);
    *is_elsewhere = path == NULL;
    if (path == NULL)
        path = find_in(memory, place, plain_name(name));
    if (path == NULL && hd_span_size(place->folder) > 0)
        path = find_in(memory, &(HdObjPlace){place->base, hd_span_of("")}, plain_name(name));
    return path;
}
