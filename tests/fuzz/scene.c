/* SPDX-License-Identifier: MIT */
/* Scenes in JSON, without the files that they name: checked as by 'hedron check', compiled, written
   and read back. */
#define _POSIX_C_SOURCE 200809L

#include "input/scene_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "fuzz.h"
#include "input/write.h"

static HdStatus parse(HdSceneFile *file, const char *text, size_t size, HdError *error) {
    HdProblems notes = {.count = 0};
    const HdSceneSource source = {.name = "a.json", .folder = "", .notes = &notes};
    return hd_scene_file_parse(file, text, size, &source, error);
}

/* Prints the scene; NULL: a path is not UTF-8, which JSON cannot express. */
static char *print(const HdSceneFile *file, size_t *size) {
    static HdError error;
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    fuzz_expect(out != NULL, "no memory");
    const HdStatus status = hd_scene_file_print(out, file, &error);
    fuzz_expect(fclose(out) == 0, "no memory");
    fuzz_expect(status == HD_OK, error.message);
    return text;
}

/* Lights beyond 2^39 may come back with a rounding error. */
static int is_exact(const HdScene *scene) {
    for (int i = 0; i < scene->light_count; i++) {
        const HdVec3 at = scene->lights[i].intensity;
        if (fmax(at.x, fmax(at.y, at.z)) > 5e11)
            return 0;
    }
    return 1;
}

static void expect_to_come_back(const HdSceneFile *file) {
    static HdError error;
    HdSceneFile again;
    size_t first_size, second_size;
    char *first = print(file, &first_size);
    fuzz_expect(parse(&again, first, first_size, &error) == HD_OK, error.message);
    char *second = print(&again, &second_size);
    if (is_exact(&file->scene))
        fuzz_expect(first_size == second_size && memcmp(first, second, first_size) == 0,
                    "a scene that changes when it is written and read");
    hd_scene_file_free(&again);
    free(first);
    free(second);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static HdError error;
    HdSceneFile file;
    const HdStatus status = parse(&file, (const char *)data, size, &error);
    fuzz_expect_input_status(status, &error);
    if (status != HD_OK)
        return 0;
    fuzz_render_scene(&file.scene);
    expect_to_come_back(&file);
    hd_scene_file_free(&file);
    return 0;
}
