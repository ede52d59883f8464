/* SPDX-License-Identifier: MIT */
#include "verify/golden.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Made by the build from tests/golden/frames.txt. */
extern const unsigned char hd_golden_hashes[];

const HdSceneTables hd_golden_needs = {.plane_count = 32,
                                       .depth = 32,
                                       .node_stack = 32,
                                       .refracts = true,
                                       .lit_from_behind = true,
                                       .many_lights = true,
                                       .small_tables = true};

/* More than any of the frames takes. */
enum { ROOM = 8 << 20 };

const char *hd_golden_text(void) {
    return (const char *)hd_golden_hashes;
}

bool hd_golden_find_hashes(const char *name, HdPrecision precision, HdGoldenHashes *hashes) {
    size_t length = strlen(name);
    for (const char *line = hd_golden_text(); line != NULL && *line != '\0';
         line = strchr(line, '\n')) {
        line += *line == '\n';
        uint64_t frame[2], first_hits[2];
        if (strncmp(line, name, length) != 0 || line[length] != ' ' ||
            sscanf(line + length, "%" SCNx64 " %" SCNx64 " %" SCNx64 " %" SCNx64, &frame[0],
                   &frame[1], &first_hits[0], &first_hits[1]) != 4)
            continue;
        *hashes = (HdGoldenHashes){frame[precision], first_hits[precision]};
        return true;
    }
    return false;
}

HdStatus hd_golden_build(const HdGoldenFrame *frame, HdScene *scene, HdCamera *camera,
                         HdError *error) {
    void *room = malloc(ROOM);
    if (room == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the golden frame '%s'",
                       frame->name);
    free(room);
    frame->build(scene, camera);
    return HD_OK;
}
