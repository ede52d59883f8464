/* SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "command_scene.h"
#include "commands.h"

static const char *plural(int count) {
    return count == 1 ? "" : "s";
}

static HdStatus check_scene(const char *name, HdError *error) {
    HdSceneFile file;
    HdStatus status = hd_read_scene_file(&file, name, NULL, 0, error);
    if (status != HD_OK)
        return status;
    int solids = file.scene.solid_count, lights = hd_scene_light_count(&file.scene);
    int frames = file.scene.frame_count;
    printf("%s: fine, %d solid%s, %d light%s, %d frame%s\n", hd_operand_name(name), solids,
           plural(solids), lights, plural(lights), frames, plural(frames));
    hd_scene_file_free(&file);
    return HD_OK;
}

/* Of several scenes each has its message; the last one, which the program prints, counts them. */
HdStatus hd_command_check(const HdOptions *options, HdError *error) {
    HdStatus worst = HD_OK;
    int wrong = 0;
    if (options->schema)
        return hd_scene_schema_print(stdout, error);
    for (int i = 0; i < options->operand_count; i++) {
        HdStatus status = check_scene(options->operands[i], error);
        if (status == HD_OK)
            continue;
        wrong++;
        worst = worst == HD_BAD_INPUT ? worst : status;
        if (options->operand_count == 1)
            return status;
        fflush(stdout);
        fprintf(stderr, "hedron: %s\n", error->message);
    }
    if (wrong == 0)
        return HD_OK;
    return hd_fail(error, worst, "%d of %d scenes %s wrong", wrong, options->operand_count,
                   wrong == 1 ? "is" : "are");
}
