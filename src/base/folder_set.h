/* SPDX-License-Identifier: MIT */
/* The folders that files of a run went to, by their names. */
#ifndef HD_BASE_FOLDER_SET_H
#define HD_BASE_FOLDER_SET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* As many as a run has outputs, and more. A sequence whose folders are numbered has countless ones,
   but it asks for each but once. */
enum { HD_FOLDER_SET_ROOM = 32 };

/* Empty when it is all zeros. Beyond its room the oldest are forgotten. */
typedef struct HdFolderSet {
    uint64_t hashes[HD_FOLDER_SET_ROOM]; /* of their names; 0: none */
    int next;
} HdFolderSet;

/* What of `path` is before the name, with the slash. */
size_t hd_folder_length(const char *path);

/* Whether the folder of the file `path` is in the set. */
bool hd_folder_set_has(const HdFolderSet *set, const char *path);

/* Puts the folder of the file `path` into the set, where it is not in it. */
void hd_folder_set_add(HdFolderSet *set, const char *path);

#endif
