/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "output/stale_files.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

#include "base/folder_set.h"
#include "output/frame_names.h"
#include "system/atomic_file.h"

static DIR *open_folder(const char *folder) {
    return opendir(folder[0] != '\0' ? folder : ".");
}

/* Temporary files of the entries, which are the outputs' files. */
static void search_files(const HdFrameNames *names) {
    const struct dirent *entry;
    DIR *folder = open_folder(names->folder);
    if (folder == NULL)
        return;
    while ((entry = readdir(folder)) != NULL) {
        char path[HD_MAX_PATH + sizeof entry->d_name];
        const size_t length = hd_temporary_name_length(entry->d_name);
        if (length == 0 || hd_frame_names_place(names, entry->d_name, length,
                                                length == HD_TEMPORARY_MOST_KEPT) < 0)
            continue;
        snprintf(path, sizeof path, "%s%s", names->folder, entry->d_name);
        hd_temporary_remove_stale(path);
    }
    closedir(folder);
}

/* Of one frame, in a folder of its own. */
static void search_own_folder(const HdFrameNames *names, const char *entry) {
    HdFrameNames own = {.frames = names->frames};
    char path[3 * HD_MAX_PATH];
    const int length = snprintf(path, sizeof path, "%s%s%s", names->folder, entry, names->rest);
    if (length >= HD_MAX_PATH)
        return;
    const size_t folder = hd_folder_length(path);
    snprintf(own.folder, sizeof own.folder, "%.*s", (int)folder, path);
    snprintf(own.prefix, sizeof own.prefix, "%.*s", length - (int)folder, path + folder);
    search_files(&own);
}

static void search_folders(const HdFrameNames *names) {
    const struct dirent *entry;
    DIR *folder = open_folder(names->folder);
    if (folder == NULL)
        return;
    while ((entry = readdir(folder)) != NULL)
        if (hd_frame_names_place(names, entry->d_name, strlen(entry->d_name), false) >= 0)
            search_own_folder(names, entry->d_name);
    closedir(folder);
}

void hd_stale_files_remove(const HdOutputPlan *plan, const HdFrameList *frames) {
    for (int i = 0; i < plan->count; i++) {
        HdFrameNames names;
        HdError ignored;
        if (hd_frame_names_find(&names, &plan->list[i], frames, &ignored) != HD_OK)
            continue;
        if (names.rest[0] == '\0')
            search_files(&names);
        else
            search_folders(&names);
    }
}
