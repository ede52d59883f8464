/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "output/stale_files.h"

#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "system/atomic_file.h"

typedef struct Search {
    const HdOutput *output;
    const HdFrameList *frames;
    char folder[HD_MAX_PATH]; /* with its last slash; empty: the current one */
} Search;

static bool find_file(const Search *search, int frame, char path[HD_MAX_PATH]) {
    HdError ignored;
    return hd_output_file(search->output, frame, path, &ignored) == HD_OK;
}

/* Returns the length of the folder, its slash included. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

static bool is_in_folder(const Search *search, const char *path) {
    const size_t length = folder_length(path);
    return strlen(search->folder) == length && memcmp(search->folder, path, length) == 0;
}

static bool is_of_frame(const Search *search, const char *entry, int frame) {
    char path[HD_MAX_PATH];
    return find_file(search, frame, path) && is_in_folder(search, path) &&
           hd_temporary_belongs(entry, path + strlen(search->folder));
}

static bool is_of_run(const Search *search, const char *entry) {
    if (search->output->is_film)
        return is_of_frame(search, entry, 0);
    for (int i = 0; i < search->frames->count; i++)
        if (is_of_frame(search, entry, search->frames->frames[i]))
            return true;
    return false;
}

static void search_folder(const Search *search) {
    const struct dirent *entry;
    DIR *folder = opendir(search->folder[0] != '\0' ? search->folder : ".");
    if (folder == NULL)
        return;
    while ((entry = readdir(folder)) != NULL) {
        char path[HD_MAX_PATH + sizeof entry->d_name];
        if (strstr(entry->d_name, ".tmp-") == NULL || !is_of_run(search, entry->d_name))
            continue;
        snprintf(path, sizeof path, "%s%s", search->folder, entry->d_name);
        hd_temporary_remove_stale(path);
    }
    closedir(folder);
}

/* Frames that follow each other lie mostly in one folder. */
static void search_output(const HdOutput *output, const HdFrameList *frames) {
    Search search = {.output = output, .frames = frames};
    char path[HD_MAX_PATH];
    for (int i = 0; i < frames->count; i++) {
        if (!find_file(&search, frames->frames[i], path) || (i > 0 && is_in_folder(&search, path)))
            continue;
        const size_t length = folder_length(path);
        memcpy(search.folder, path, length);
        search.folder[length] = '\0';
        search_folder(&search);
    }
}

void hd_stale_files_remove(const HdOutputPlan *plan, const HdFrameList *frames) {
    for (int i = 0; i < plan->count; i++)
        search_output(&plan->list[i], frames);
}
