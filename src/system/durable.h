/* SPDX-License-Identifier: MIT */
/* Bytes and names that outlive a power cut: they are on the disk, not only with the system. */
#ifndef HD_SYSTEM_DURABLE_H
#define HD_SYSTEM_DURABLE_H

#include "base/error.h"
#include "base/folder_set.h"

/* Waits until the bytes of an open file are on the disk; `path` is for the message. HD_FAILED where
   the disk says no. What no disk is behind, such as a pipe, has nothing to wait for. */
HdStatus hd_sync_file(int descriptor, const char *path, HdError *error);

/* Waits until the name of the file `path` is on the disk: syncs its folder, and those above it up
   to one that is in `synced`, for they may be new; puts them there. A folder that may not be read
   was made by somebody else, and is left to the system. */
HdStatus hd_sync_folder(HdFolderSet *synced, const char *path, HdError *error);

#endif
