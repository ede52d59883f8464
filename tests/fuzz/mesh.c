/* SPDX-License-Identifier: MIT */
/* Meshes in OBJ, beside which lies one material library, a.mtl. */
#include <string.h>

#include "fuzz.h"

static const char library[] = "newmtl a\nKd 0.5 0.6 0.7\nmap_Kd a.png\n"
                              "newmtl b\nillum 7\nd 0.2\nNi 1.5\nKs 0.1 0.1 0.1\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static int has_library;
    if (!has_library)
        fuzz_file("a.mtl", library, strlen(library));
    has_library = 1;
    fuzz_read_mesh(fuzz_file("a.obj", data, size));
    return 0;
}
