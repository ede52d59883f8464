/* SPDX-License-Identifier: MIT */
/* Declarations shared by the fuzz targets. Each target is a file of its own with
   LLVMFuzzerTestOneInput: one reader of the library, and the program's next steps with its result.
   libFuzzer drives them (HEDRON_FUZZ), or replay.c, which only passes them files. */
#ifndef HD_FUZZ_H
#define HD_FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "scene/scene.h"

/* Returns 0, as libFuzzer wants it. Ends the process if the library broke its contract. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Returns a new copy with a zero byte behind it, as text; the caller frees it. */
char *fuzz_text(const uint8_t *data, size_t size);

/* Writes a file of that name into a folder of this process, which is removed at its end. Returns
   the path, valid until the next call with the same name. */
const char *fuzz_file(const char *name, const void *data, size_t size);

/* Ends the process with a message unless the condition holds. */
void fuzz_expect(int holds, const char *what);

/* Errors that wrong input may cause: never a failure of the machine, as a wrong size of memory
   would be. */
void fuzz_expect_input_status(HdStatus status, const HdError *error);

/* Reads the mesh at the path in 64 MiB, smooths it and builds its hierarchy, as loading a scene
   does; ends the process if the mesh is not sound (mesh_work.c). */
void fuzz_read_mesh(const char *path);

/* Renders a few pixels of a valid scene's last frame in both precisions, if it has few lights. Ends
   the process if a valid scene is refused (scene_work.c). */
void fuzz_render_scene(const HdScene *scene);

/* Corrects the checksums of all chunks, which a fuzzer does not find by itself, and returns the
   number of pixels in the head; 0: there is no head (png_sums.c). */
uint64_t fuzz_mend_png(unsigned char *bytes, size_t size);

#endif
