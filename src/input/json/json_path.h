/* SPDX-License-Identifier: MIT */
/* Places in JSON as messages spell them: solids[1].rim, materials["blue glass"].colour. */
#ifndef HD_INPUT_JSON_JSON_PATH_H
#define HD_INPUT_JSON_JSON_PATH_H

#include <stddef.h>

enum { HD_JSON_PATH_SIZE = 512 };

/* Goes on to a key, or to an element of an array; what does not fit is cut. They return the length
   to go back to. */
size_t hd_json_path_key(char path[HD_JSON_PATH_SIZE], const char *key);
size_t hd_json_path_index(char path[HD_JSON_PATH_SIZE], size_t index);

#endif
