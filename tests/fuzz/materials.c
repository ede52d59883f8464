/* SPDX-License-Identifier: MIT */
/* Material libraries in MTL, of a mesh that names a few materials. */
#include <string.h>

#include "fuzz.h"

static const char mesh[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                           "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 3 2\nusemtl c d # e\nf 2 3 1\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_file("a.mtl", data, size);
    fuzz_read_mesh(fuzz_file("a.obj", mesh, strlen(mesh)));
    return 0;
}
