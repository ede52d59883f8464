/* SPDX-License-Identifier: MIT */
#include "cli/option_table.h"

#include <stdio.h>
#include <string.h>

#include "cli/command_table.h"
#include "cli/options.h"
#include "device/renderer.h"
#include "input/classic_read.h"
#include "scene/scene.h"

enum {
    RENDERING = HD_COMMAND_CLASSIC | HD_COMMAND_RENDER,
    MEASURING = RENDERING | HD_COMMAND_TUNE,
    EVERYTHING = MEASURING | HD_COMMAND_CHECK | HD_COMMAND_CONVERT | HD_COMMAND_DEVICES |
                 HD_COMMAND_COMPARE | HD_COMMAND_HELP
};

const HdOptionSpec hd_option_specs[HD_OPTION_SPEC_COUNT] = {
    {HD_OPTION_GPU, "--gpu", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_CLASSIC,
     "trace on the GPU (this is the default of the classic mode)"},
    {HD_OPTION_CPU, "--cpu", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_CLASSIC,
     "trace on the CPU only"},
    {HD_OPTION_DEFAULT, "--default", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_CLASSIC,
     "print the most colourful configuration in the input format, and exit"},
    {HD_OPTION_VARIANT, "--variant", NULL, "1..10", NULL, false, 1, HD_CLASSIC_VARIANTS,
     HD_COMMAND_CLASSIC | HD_COMMAND_CONVERT,
     "which three solids the input means (default 4: tetrahedron, octahedron, dodecahedron)"},
    {HD_OPTION_OUTPUT, "--output", "-o", "OUT", NULL, true, 0, 0, HD_COMMAND_RENDER,
     "film.mp4, picture.png or a sequence such as out/%04d.png; up to 8 times"},
    {HD_OPTION_OUTPUT, "--output", "-o", "SCENE", NULL, true, 0, 0, HD_COMMAND_CONVERT,
     "the scene file to be written (default: standard output)"},
    {HD_OPTION_SET, "--set", NULL, "PATH=VALUE", NULL, false, 0, 0,
     HD_COMMAND_RENDER | HD_COMMAND_TUNE,
     "replace a value of the scene file, for example camera.field_of_view=40; up to 64 times"},
    {HD_OPTION_FRAMES, "--frames", NULL, "LIST", NULL, false, 0, 0, MEASURING,
     "render these frames only, for example 0-9,20"},
    {HD_OPTION_AGAIN, "--again", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_RENDER,
     "render all frames; otherwise those of numbered PNG pictures that are finished already, with "
     "the same pixels, are left as they are"},
    {HD_OPTION_SIZE, "--size", NULL, "WxH", NULL, false, 0, 0, MEASURING,
     "size of the picture in pixels"},
    {HD_OPTION_SAMPLES, "--samples", NULL, "N", NULL, false, 1, HD_MAX_SAMPLES_PER_SIDE, MEASURING,
     "N x N samples for each pixel"},
    {HD_OPTION_DEPTH, "--depth", NULL, "N", NULL, false, 0, HD_MAX_DEPTH, MEASURING,
     "how often a ray may be mirrored or pass a face"},
    {HD_OPTION_CUTOFF, "--cutoff", NULL, "W", NULL, false, 0, 0, MEASURING,
     "end rays that weigh less than W, 0..1 (0: never)"},
    {HD_OPTION_AA, "--aa", NULL, "NAME", "grid adaptive", false, 0, 0, RENDERING,
     "grid: all N x N samples in each pixel; adaptive: only as many of them as it needs, which is "
     "an estimate and no promise (default grid)"},
    {HD_OPTION_MAX_ERROR, "--max-error", NULL, "E", NULL, false, 0, 0, RENDERING,
     "leave out of each pixel what cannot change it by more than E steps of 255, and nothing else: "
     "depth, cut-off and lights follow from that promise; with --aa adaptive also the error that "
     "sampling aims at"},
    {HD_OPTION_REFERENCE, "--reference", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_RENDER,
     "as near to the truth as can be: double precision, 32 x 32 samples of a low-discrepancy set "
     "(or N x N), --max-error 1/64; slow, so take a small picture or --crop"},
    {HD_OPTION_CROP, "--crop", NULL, "WxH+X+Y", NULL, false, 0, 0, HD_COMMAND_RENDER,
     "render only so many pixels from column X and row Y on"},
    {HD_OPTION_BACKEND, "--backend", NULL, "NAME", "auto c opencl cuda", false, 0, 0, MEASURING,
     "auto, c, opencl or cuda (default auto: the best one found)"},
    {HD_OPTION_DEVICE, "--device", NULL, "DEVICE", NULL, false, 0, 0, RENDERING,
     "number of the device as listed by 'hedron devices', also as c:0, or part of its name; "
     "several that share the frames: all, or a list such as cuda:0,cuda:1,c:0"},
    {HD_OPTION_DEVICE, "--device", NULL, "DEVICE", NULL, false, 0, 0, HD_COMMAND_TUNE,
     "number of the device as listed by 'hedron devices', also as c:0, or part of its name"},
    {HD_OPTION_LANES, "--lanes", NULL, "N", "1 4 8 16", false, 0, 0, MEASURING,
     "rays traced together on a CPU: 1, 4, 8 or 16 (default: what suits it)"},
    {HD_OPTION_THREADS, "--threads", NULL, "N", NULL, false, 1, HD_MAX_THREADS, MEASURING,
     "threads of the C backend (default: one for each core)"},
    {HD_OPTION_PIPELINE, "--pipeline", NULL, "NAME", "auto mega wavefront wavefront-uncompacted",
     false, 0, 0, MEASURING,
     "mega: a bundle follows its whole tree of rays; wavefront: all rays of a level, closed up; "
     "wavefront-uncompacted: with its dead rays, for comparison (default auto: what suits device "
     "and scene)"},
    {HD_OPTION_BLOCK, "--block", NULL, "N", NULL, false, HD_BLOCK_STEP, HD_MAX_BLOCK, MEASURING,
     "threads of a GPU's work group, a multiple of 32 (default: what suits it)"},
    {HD_OPTION_GRID, "--grid", NULL, "N", NULL, false, 1, HD_MAX_GRID, MEASURING,
     "work groups of one launch on a GPU, at most (default: what suits it)"},
    {HD_OPTION_GEOMETRY, "--geometry", NULL, "NAME", "solids triangles", false, 0, 0, MEASURING,
     "solids: half-spaces with patterns on their faces; triangles: all of it as triangles, which "
     "gives nearly the same picture (default solids)"},
    {HD_OPTION_DIVISIONS, "--divisions", NULL, "N", NULL, false, 1, HD_MAX_DIVISIONS, MEASURING,
     "with --geometry triangles: cut the side of each triangle into N, the triangle into N x N "
     "(default 1)"},
    {HD_OPTION_ACCEL, "--accel", NULL, "NAME", "auto brute bvh", false, 0, 0, MEASURING,
     "how triangles are searched; brute: each of them; bvh: by a bounding volume hierarchy "
     "(default auto: brute for a handful)"},
    {HD_OPTION_PRECISION, "--precision", NULL, "P", "float double", false, 0, 0, MEASURING,
     "float or double (default float)"},
    {HD_OPTION_MATH, "--math", NULL, "M", "strict fast", false, 0, 0, MEASURING,
     "strict: the same bytes everywhere; fast: the device's own (default strict)"},
    {HD_OPTION_STATS, "--stats", NULL, "FILE", NULL, true, 0, 0, RENDERING,
     "write a line of JSON about each frame, its times and rays, to FILE; -: standard output, "
     "which then has nothing else"},
    {HD_OPTION_VERBOSE, "--verbose", NULL, NULL, NULL, false, 0, 0, RENDERING,
     "tell what was chosen and why"},
    {HD_OPTION_QUIET, "--quiet", NULL, NULL, NULL, false, 0, 0, RENDERING,
     "no progress and no notes; errors only"},
    {HD_OPTION_FRAME_LINES, "--frame-lines", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_RENDER,
     "progress for programs: a line on standard error for each frame that is stored; with --quiet "
     "nothing else"},
    {HD_OPTION_SCHEMA, "--schema", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_CHECK,
     "print the JSON Schema of scene files, and exit"},
    {HD_OPTION_JSON, "--json", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_DEVICES | HD_COMMAND_TUNE,
     "print the list as JSON"},
    {HD_OPTION_JSON, "--json", NULL, NULL, NULL, false, 0, 0, HD_COMMAND_COMPARE,
     "print the figures as JSON"},
    {HD_OPTION_DIFF, "--diff", NULL, "OUT.png", NULL, true, 0, 0, HD_COMMAND_COMPARE,
     "write a heat map of the display error"},
    {HD_OPTION_FAIL_ABOVE, "--fail-above", NULL, "X", NULL, false, 0, 0, HD_COMMAND_COMPARE,
     "end with exit code 1 if the largest display error is above X steps of 255"},
    {HD_OPTION_CURVE, "--curve", NULL, "NAME", "linear srgb", false, 0, 0, HD_COMMAND_COMPARE,
     "the curve that PNG pictures are on and display values are put on: linear or srgb, whatever "
     "the "
     "files say"},
    {HD_OPTION_HELP, "--help", "-h", NULL, NULL, false, 0, 0, EVERYTHING, "print this help"},
    {HD_OPTION_VERSION, "--version", "-V", NULL, NULL, false, 0, 0, RENDERING, "print the version"},
};
_Static_assert(HD_CLASSIC_VARIANTS == 10 && HD_CLASSIC_DEFAULT_VARIANT == 4 &&
                   HD_MAX_OUTPUTS == 8 && HD_MAX_CHANGES == 64 && HD_BLOCK_STEP == 32,
               "the help says so");

/* The next word of a list, and its length; false at the end. */
static bool next_word(const char **list, const char **word, size_t *length) {
    *list += strspn(*list, " ");
    *word = *list;
    *length = strcspn(*list, " ");
    *list += *length;
    return *length > 0;
}

int hd_option_choice(const char *choices, const char *text) {
    const char *word;
    size_t length;
    for (int i = 0; next_word(&choices, &word, &length); i++)
        if (strlen(text) == length && strncmp(text, word, length) == 0)
            return i;
    return -1;
}

size_t hd_option_completed(const char *choices, const char *text, const char **word) {
    size_t length, given = strlen(text);
    while (next_word(&choices, word, &length))
        if (given > 0 && given < length && strncmp(text, *word, given) == 0)
            return length;
    return 0;
}

void hd_option_list_choices(const char *choices, char *text, int capacity) {
    const char *word;
    size_t length, used = 0, room = (size_t)capacity;
    text[0] = '\0';
    for (bool first = true; next_word(&choices, &word, &length) && used < room; first = false) {
        const char *separator = first ? "" : *choices == '\0' ? " or " : ", ";
        used += (size_t)snprintf(text + used, room - used, "%s%.*s", separator, (int)length, word);
    }
}

void hd_option_heading(const HdOptionSpec *spec, char *text, int capacity) {
    snprintf(text, (size_t)capacity, "%s%s%s%s%s", spec->short_name ? spec->short_name : "",
             spec->short_name ? ", " : "", spec->name, spec->value ? " " : "",
             spec->value ? spec->value : "");
}
