/* SPDX-License-Identifier: MIT */
#include "cli/options.h"

#include <stdio.h>

#include "device/options.h"
#include "image/file_kind.h"
#include "input/classic.h"
#include "output/outputs.h"

enum {
    RENDERING = HD_COMMAND_CLASSIC | HD_COMMAND_RENDER,
    MEASURING = RENDERING | HD_COMMAND_TUNE,
    EVERYTHING = MEASURING | HD_COMMAND_CHECK | HD_COMMAND_CONVERT | HD_COMMAND_DEVICES |
                 HD_COMMAND_COMPARE | HD_COMMAND_HELP
};

#define QUOTED(number) #number,
static const char *const lane_counts[] = {HD_LANE_COUNTS(QUOTED) NULL};

const char *const hd_curve_names[] = {"linear", "srgb", NULL};

static const char modes[] = "--gpu, --cpu and --default";
static const char loudness[] = "--verbose and --quiet";

static HdStatus check_diff(const char *text, const char *option, HdError *error) {
    if (hd_output_kind(text) == HD_OUTPUT_PNG)
        return HD_OK;
    return hd_fail(error, HD_BAD_INPUT, "%s is '%s', expected a name that ends in .png", option,
                   text);
}

/* The columns of the table that a type needs. */
#define AT(member)   .offset = offsetof(HdOptions, member)
#define FLAG(member) .type = HD_OPTION_FLAG, AT(member)
#define INTEGER(member, least, most)                                                               \
    .type = HD_OPTION_INTEGER, AT(member), .low = (least), .high = (most)
#define REAL(member, least, most) .type = HD_OPTION_REAL, AT(member), .low = (least), .high = (most)
#define ONE_OF(kind, member, ...)                                                                  \
    .type = (kind), AT(member), .choices = (const char *const[]) {                                 \
        __VA_ARGS__, NULL                                                                          \
    }
#define CHOICE(member, ...)  ONE_OF(HD_OPTION_CHOICE, member, __VA_ARGS__)
#define TEXT(member, wanted) .type = HD_OPTION_TEXT, AT(member), .expected = (wanted)
#define TEXTS(kind, member, count, most)                                                           \
    .type = (kind), AT(member), .count_offset = offsetof(HdOptions, count), .high = (most)
#define COMMAND(taken) .type = HD_OPTION_COMMAND, .command = (taken)

const HdOptionSpec hd_option_specs[] = {
    {"--gpu", NULL, NULL, "trace on the GPU (this is the default of the classic mode)",
     HD_COMMAND_CLASSIC, FLAG(gpu), .only_one_of = modes},
    {"--cpu", NULL, NULL, "trace on the CPU only", HD_COMMAND_CLASSIC, FLAG(cpu),
     .only_one_of = modes},
    {"--default", NULL, NULL,
     "print the most colourful configuration in the input format, and exit", HD_COMMAND_CLASSIC,
     FLAG(prints_default), .only_one_of = modes},
    {"--variant", NULL, "1..10",
     "which three solids the input means (default 4: tetrahedron, octahedron, dodecahedron)",
     HD_COMMAND_CLASSIC | HD_COMMAND_CONVERT, INTEGER(variant, 1, HD_CLASSIC_VARIANTS),
     .unset = HD_CLASSIC_DEFAULT_VARIANT},
    {"--output", "-o", "OUT",
     "film.mp4, picture.png or a sequence such as out/%04d.png; up to 8 times", HD_COMMAND_RENDER,
     TEXTS(HD_OPTION_TEXTS, outputs, output_count, HD_MAX_OUTPUTS), .check = hd_output_check_name,
     .expected = "the name of a file", .takes_file = true},
    {"--output", "-o", "SCENE", "the scene file to be written (default: standard output)",
     HD_COMMAND_CONVERT, TEXTS(HD_OPTION_TEXTS, outputs, output_count, 1),
     .expected = "the name of a file", .takes_file = true},
    {"--set", NULL, "PATH=VALUE",
     "replace a value of the scene file, for example camera.field_of_view=40; up to 64 times",
     HD_COMMAND_RENDER | HD_COMMAND_TUNE,
     TEXTS(HD_OPTION_CHANGES, changes, change_count, HD_MAX_CHANGES),
     .expected = "PATH=VALUE such as camera.field_of_view=40"},
    {"--frames", NULL, "LIST", "render these frames only, for example 0-9,20", MEASURING,
     TEXT(frames, NULL)},
    {"--again", NULL, NULL,
     "render all frames; otherwise those of numbered PNG pictures that are finished already, with "
     "the same pixels, are left as they are",
     HD_COMMAND_RENDER, FLAG(again)},
    {"--size", NULL, "WxH", "size of the picture in pixels", MEASURING, .type = HD_OPTION_SIZE,
     AT(size), .expected = "WIDTHxHEIGHT such as 640x480, each 1 to 65535"},
    {"--samples", NULL, "N", "N x N samples for each pixel", MEASURING,
     INTEGER(samples, 1, HD_MAX_SAMPLES_PER_SIDE)},
    {"--depth", NULL, "N", "how often a ray may be mirrored or pass a face", MEASURING,
     INTEGER(depth, 0, HD_MAX_DEPTH), .unset = -1},
    {"--cutoff", NULL, "W", "end rays that weigh less than W, 0..1 (0: never)", MEASURING,
     REAL(cutoff, 0.0, 1.0), .below_high = true, .unset = -1},
    {"--aa", NULL, "NAME",
     "grid: all N x N samples in each pixel; adaptive: only as many of them as it needs, which is "
     "an estimate and no promise (default grid)",
     RENDERING, CHOICE(sampling, "grid", "adaptive"), .unset = -1},
    {"--max-error", NULL, "E",
     "leave out of each pixel what cannot change it by more than E steps of 255, and nothing else: "
     "depth, cut-off and lights follow from that promise; with --aa adaptive also the error that "
     "sampling aims at",
     RENDERING, REAL(max_error, HD_LEAST_ERROR, HD_MAX_ERROR)},
    {"--reference", NULL, NULL,
     "as near to the truth as can be: double precision, 32 x 32 samples of a low-discrepancy set "
     "(or N x N), --max-error 1/64; slow, so take a small picture or --crop",
     HD_COMMAND_RENDER, FLAG(reference)},
    {"--crop", NULL, "WxH+X+Y", "render only so many pixels from column X and row Y on",
     HD_COMMAND_RENDER, .type = HD_OPTION_CROP, AT(crop),
     .expected = "WIDTHxHEIGHT+X+Y such as 64x64+320+200"},
    {"--backend", NULL, "NAME", "auto, c, opencl or cuda (default auto: the best one found)",
     MEASURING, ONE_OF(HD_OPTION_WORD, backend, "auto", "c", "opencl", "cuda")},
    {"--device", NULL, "DEVICE",
     "number of the device as listed by 'hedron devices', also as c:0, or part of its name; "
     "several that share the frames: all, or a list such as cuda:0,cuda:1,c:0",
     RENDERING, TEXT(device, "a number, BACKEND:NUMBER or part of a name")},
    {"--device", NULL, "DEVICE",
     "number of the device as listed by 'hedron devices', also as c:0, or part of its name",
     HD_COMMAND_TUNE, TEXT(device, "a number, BACKEND:NUMBER or part of a name")},
    {"--lanes", NULL, "N",
     "rays traced together on a CPU: " HD_LANE_COUNTS_IN_WORDS " (default: what suits it)",
     MEASURING, .type = HD_OPTION_NUMERAL, AT(render.lanes), .choices = lane_counts},
    {"--threads", NULL, "N", "threads of the C backend (default: one for each core)", MEASURING,
     INTEGER(render.threads, 1, HD_MAX_THREADS)},
    {"--pipeline", NULL, "NAME",
     "mega: a bundle follows its whole tree of rays; wavefront: all rays of a level, closed up; "
     "wavefront-uncompacted: with its dead rays, for comparison (default auto: what suits device "
     "and scene)",
     MEASURING, .type = HD_OPTION_CHOICE, AT(render.pipeline), .choices = hd_pipeline_names},
    {"--block", NULL, "N",
     "threads of a GPU's work group, a multiple of 32 (default: what suits it)", MEASURING,
     INTEGER(render.block, HD_BLOCK_STEP, HD_MAX_BLOCK), .step = HD_BLOCK_STEP},
    {"--grid", NULL, "N", "work groups of one launch on a GPU, at most (default: what suits it)",
     MEASURING, INTEGER(render.grid, 1, HD_MAX_GRID)},
    {"--geometry", NULL, "NAME",
     "solids: half-spaces with patterns on their faces; triangles: all of it as triangles, which "
     "gives nearly the same picture (default solids)",
     MEASURING, CHOICE(geometry, "solids", "triangles")},
    {"--divisions", NULL, "N",
     "with --geometry triangles: cut the side of each triangle into N, the triangle into N x N "
     "(default 1)",
     MEASURING, INTEGER(divisions, 1, HD_MAX_DIVISIONS)},
    {"--accel", NULL, "NAME",
     "how triangles are searched; brute: each of them; bvh: by a bounding volume hierarchy "
     "(default auto: brute for a handful)",
     MEASURING, CHOICE(accel, "auto", "brute", "bvh")},
    {"--precision", NULL, "P", "float or double (default float)", MEASURING,
     CHOICE(render.precision, "float", "double")},
    {"--math", NULL, "M",
     "strict: the same bytes everywhere; fast: the device's own (default strict)", MEASURING,
     CHOICE(render.math, "strict", "fast")},
    {"--stats", NULL, "FILE",
     "write a line of JSON about each frame, its times and rays, to FILE; -: standard output, "
     "which then has nothing else",
     RENDERING, TEXT(statistics, "a file or -"), .takes_file = true},
    {"--verbose", NULL, NULL, "tell what was chosen and why", RENDERING, FLAG(verbose),
     .only_one_of = loudness},
    {"--quiet", NULL, NULL, "no progress and no notes; errors only", RENDERING, FLAG(quiet),
     .only_one_of = loudness},
    {"--frame-lines", NULL, NULL,
     "progress for programs: a line on standard error for each frame that is stored; with --quiet "
     "nothing else",
     HD_COMMAND_RENDER, FLAG(tells_frames)},
    {"--schema", NULL, NULL, "print the JSON Schema of scene files, and exit", HD_COMMAND_CHECK,
     FLAG(schema)},
    {"--json", NULL, NULL, "print the list as JSON", HD_COMMAND_DEVICES | HD_COMMAND_TUNE,
     FLAG(json)},
    {"--json", NULL, NULL, "print the figures as JSON", HD_COMMAND_COMPARE, FLAG(json)},
    {"--diff", NULL, "OUT.png", "write a heat map of the display error", HD_COMMAND_COMPARE,
     TEXT(diff, NULL), .check = check_diff, .takes_file = true},
    {"--fail-above", NULL, "X",
     "end with exit code 1 if the largest display error is above X steps of 255",
     HD_COMMAND_COMPARE, REAL(fail_above, 0.0, HD_MAX_ERROR), .unset = -1},
    {"--curve", NULL, "NAME",
     "the curve that PNG pictures are on and display values are put on: linear or srgb, whatever "
     "the files say",
     HD_COMMAND_COMPARE, .type = HD_OPTION_CHOICE, AT(curve), .choices = hd_curve_names,
     .unset = -1},
    {"--help", "-h", NULL, "print this help", EVERYTHING, COMMAND(HD_COMMAND_HELP)},
    {"--version", "-V", NULL, "print the version", RENDERING, COMMAND(HD_COMMAND_VERSION)},
    {.name = NULL},
};
_Static_assert(HD_CLASSIC_VARIANTS == 10 && HD_CLASSIC_DEFAULT_VARIANT == 4 &&
                   HD_MAX_OUTPUTS == 8 && HD_MAX_CHANGES == 64 && HD_BLOCK_STEP == 32 &&
                   HD_MAX_IMAGE_SIDE == 65535,
               "the texts say so");

const HdOptionSpec *hd_option_next(const HdOptionSpec *spec, HdCommand command) {
    spec = spec == NULL ? hd_option_specs : spec + 1;
    while (spec->name != NULL && (spec->commands & (unsigned)command) == 0)
        spec++;
    return spec->name != NULL ? spec : NULL;
}

void hd_option_heading(const HdOptionSpec *spec, char *text, int capacity) {
    snprintf(text, (size_t)capacity, "%s%s%s%s%s", spec->short_name ? spec->short_name : "",
             spec->short_name ? ", " : "", spec->name, spec->value ? " " : "",
             spec->value ? spec->value : "");
}
