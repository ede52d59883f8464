/* SPDX-License-Identifier: MIT */
#include <inttypes.h>
#include <stdio.h>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/load_scene.h"
#include "input/schema.h"

static void print_meshes(const HdScene *scene) {
    if (scene->mesh_count > 0)
        printf("%d mesh%s of %" PRId64 " triangles in %d place%s, ", scene->mesh_count,
               scene->mesh_count == 1 ? "" : "es", hd_scene_triangle_count(scene),
               scene->instance_count, hd_plural(scene->instance_count));
}

static HdStatus check_scene(const char *operand, HdError *error) {
    HdProblems notes = {.count = 0};
    const HdSceneSource source = {.loads_files = true, .notes = &notes, .file_notes = &notes};
    const char *name = hd_operand_name(operand);
    HdSceneFile file;
    HdStatus status = hd_read_scene_file(&file, operand, &source, error);
    if (status != HD_OK)
        return status;
    int solids = file.scene.solid_count, lights = hd_scene_light_count(&file.scene);
    int frames = file.scene.frame_count;
    printf("%s: fine, %d solid%s, ", name, solids, hd_plural(solids));
    print_meshes(&file.scene);
    printf("%d light%s, %d frame%s\n", lights, hd_plural(lights), frames, hd_plural(frames));
    hd_problems_print(&notes, stdout, name, ": note: ");
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
    fflush(stdout);
    return hd_fail(error, worst, "%d of %d scenes %s wrong", wrong, options->operand_count,
                   wrong == 1 ? "is" : "are");
}
