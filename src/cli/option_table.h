/* SPDX-License-Identifier: MIT */
/* The options of the command line, and what each sets. Included twice, so without a guard: by
   options.h for the members of HdOptions, by options.c for the rows of HdOptionSpec.
   ROW(...): an option that sets a member of a part of the plan (run/plan.h), another option's, or
   none. OPTION(MEMBER, ROW...): one with a member of its own. */

OPTION(bool gpu, "--gpu", NULL, NULL, "trace on the GPU (this is the default of the classic mode)",
       HD_COMMAND_CLASSIC, FLAG(gpu), .only_one_of = modes)
OPTION(bool cpu, "--cpu", NULL, NULL, "trace on the CPU only", HD_COMMAND_CLASSIC, FLAG(cpu),
       .only_one_of = modes)
OPTION(bool prints_default, "--default", NULL, NULL,
       "print the most colourful configuration in the input format, and exit", HD_COMMAND_CLASSIC,
       FLAG(prints_default), .only_one_of = modes)
ROW("--variant", NULL, "1..10",
    "which three solids the input means (default 4: tetrahedron, octahedron, dodecahedron)",
    HD_COMMAND_CLASSIC | HD_COMMAND_CONVERT, INTEGER(scene.variant, 1, HD_CLASSIC_VARIANTS),
    .role = HD_DECIDES_PIXELS)
ROW("--output", "-o", "OUT",
    "film.mp4, picture.png or a sequence such as out/%04d.png; up to 8 times", HD_COMMAND_RENDER,
    TEXTS(store.names, store.count, HD_MAX_OUTPUTS), .check = hd_output_check_name,
    .expected = "the name of a file", .takes_file = true)
ROW("--output", "-o", "SCENE", "the scene file to be written (default: standard output)",
    HD_COMMAND_CONVERT, TEXTS(store.names, store.count, 1), .expected = "the name of a file",
    .takes_file = true)
ROW("--layers", NULL, "LIST",
    "further channels of the OpenEXR outputs, such as depth,object: depth and normal of what is "
    "met first, its number (object), how many samples the pixel took (samples), what was left "
    "out of it at most (bound)",
    HD_COMMAND_RENDER, .type = HD_OPTION_SET, AT(store.layers), .choices = hd_layer_names)
ROW("--set", NULL, "PATH=VALUE",
    "replace a value of the scene file, for example camera.field_of_view=40; up to 64 times",
    HD_COMMAND_RENDER | HD_COMMAND_TUNE | HD_COMMAND_VIEW,
    TEXTS(scene.changes, scene.change_count, HD_MAX_CHANGES), .check = check_change,
    .role = HD_DECIDES_PIXELS)
OPTION(const char *frames, "--frames", "-f", "LIST", "render these frames only, for example 0-9,20",
       MEASURING, TEXT(frames, NULL))
ROW("--again", NULL, NULL,
    "render all frames; otherwise those of numbered PNG pictures that are finished already, with "
    "the same pixels, are left as they are",
    HD_COMMAND_RENDER, FLAG(store.again))
ROW("--no-sync", NULL, NULL,
    "do not wait until files are on the disk: what was stored outlives the program, but not a "
    "power cut",
    HD_COMMAND_CLASSIC | HD_COMMAND_RENDER, FLAG(store.no_sync))
OPTION(bool terminal, "--terminal", NULL, NULL,
       "show the scene in this terminal instead of a window", HD_COMMAND_VIEW, FLAG(terminal))
ROW("--size", NULL, "WxH", "size of the picture in pixels", SHOWING, .type = HD_OPTION_SIZE,
    AT(scene.size), .expected = "WIDTHxHEIGHT such as 640x480, each 1 to 65535",
    .role = HD_DECIDES_NUMBERS)
ROW("--samples", NULL, "N", "N x N samples for each pixel", SHOWING,
    INTEGER(scene.samples, 1, HD_MAX_SAMPLES_PER_SIDE), .role = HD_DECIDES_NUMBERS)
ROW("--depth", NULL, "N", "how often a ray may be mirrored or pass a face", SHOWING,
    INTEGER(scene.depth, 0, HD_MAX_DEPTH), .role = HD_DECIDES_NUMBERS)
ROW("--cutoff", NULL, "W", "end rays that weigh less than W, 0..1 (0: never)", SHOWING,
    REAL(scene.cutoff, 0.0, 1.0), .below_high = true, .role = HD_DECIDES_NUMBERS)
ROW("--aa", NULL, "NAME",
    "grid: all N x N samples in each pixel; adaptive: only as many of them as it needs, which is "
    "an estimate and no promise (default grid)",
    RENDERING | HD_COMMAND_VIEW, CHOICE(scene.sampling, "grid", "adaptive"),
    .role = HD_DECIDES_PIXELS)
ROW("--max-error", NULL, "E",
    "leave out of each pixel what cannot change it by more than E steps of 255, and nothing else: "
    "depth, cut-off and lights follow from that promise; with --aa adaptive also the error that "
    "sampling aims at",
    RENDERING | HD_COMMAND_VIEW, REAL(scene.max_error, HD_MIN_ERROR, HD_MAX_ERROR),
    .role = HD_DECIDES_PIXELS)
OPTION(bool reference, "--reference", NULL, NULL,
       "as near to the truth as can be: double precision, 32 x 32 samples of a low-discrepancy set "
       "(or N x N), --max-error 1/64; slow, so take a small picture or --crop",
       HD_COMMAND_RENDER, FLAG(reference), .role = HD_DECIDES_PIXELS)
ROW("--crop", NULL, "WxH+X+Y", "render only so many pixels from column X and row Y on",
    HD_COMMAND_RENDER, .type = HD_OPTION_CROP, AT(scene.crop),
    .expected = "WIDTHxHEIGHT+X+Y such as 64x64+320+200", .role = HD_DECIDES_NUMBERS)
ROW("--backend", NULL, "NAME", "auto, c, opencl or cuda (default auto: the best one found)",
    SHOWING, ONE_OF(HD_OPTION_WORD, devices.backend, "auto", "c", "opencl", "cuda"))
ROW("--device", NULL, "DEVICE",
    "number of the device as listed by 'hedron devices', also as c:0, or part of its name; "
    "several that share the frames: all, or a list such as cuda:0,cuda:1,c:0",
    RENDERING, TEXT(devices.device, "a number, BACKEND:NUMBER or part of a name"))
ROW("--device", NULL, "DEVICE",
    "number of the device as listed by 'hedron devices', also as c:0, or part of its name",
    HD_COMMAND_TUNE | HD_COMMAND_VIEW,
    TEXT(devices.device, "a number, BACKEND:NUMBER or part of a name"))
ROW("--backend", NULL, "NAME", "auto, c, opencl or cuda (default auto: all of them)",
    HD_COMMAND_SELFTEST, ONE_OF(HD_OPTION_WORD, devices.backend, "auto", "c", "opencl", "cuda"))
ROW("--device", NULL, "DEVICE",
    "number of the device as listed by 'hedron devices', also as c:0, or part of its name; all "
    "(the default)",
    HD_COMMAND_SELFTEST, TEXT(devices.device, "a number, BACKEND:NUMBER or part of a name"))
OPTION(
    bool quick, "--quick", NULL, NULL,
    "test with 8192 operands and one kind of kernels, which takes a second or two once these are "
    "compiled",
    HD_COMMAND_SELFTEST, FLAG(quick))
OPTION(bool deep, "--deep", NULL, NULL,
       "also compare 2400 random scenes with plain C, in each precision and pipeline, which takes "
       "minutes; what differs is reported with the pixel, the sample and the depth of the ray",
       HD_COMMAND_SELFTEST, FLAG(deep))
ROW("--lanes", NULL, "N",
    "rays traced together on a CPU: " HD_LANE_COUNTS_IN_WORDS " (default: what suits it)", SHOWING,
    .type = HD_OPTION_NUMERAL, AT(devices.render.lanes), .choices = lane_counts)
ROW("--threads", "-j", "N", "threads of the C backend (default: one for each core)", SHOWING,
    INTEGER(devices.render.threads, 1, HD_MAX_THREADS))
ROW("--pipeline", NULL, "NAME",
    "mega: a packet follows its whole tree of rays; wavefront: all rays of a level, closed up; "
    "wavefront-uncompacted: with its dead rays, for comparison (default auto: what suits device "
    "and scene)",
    SHOWING, .type = HD_OPTION_CHOICE, AT(devices.render.pipeline), .choices = hd_pipeline_names)
ROW("--block", NULL, "N",
    "threads of a GPU's work group, a multiple of 32 (default: what suits it)", SHOWING,
    INTEGER(devices.render.block, HD_BLOCK_STEP, HD_MAX_BLOCK), .step = HD_BLOCK_STEP)
ROW("--grid", NULL, "N", "work groups of one launch on a GPU, at most (default: what suits it)",
    SHOWING, INTEGER(devices.render.grid, 1, HD_MAX_GRID))
ROW("--max-launch", NULL, "MS",
    "longest launch on a GPU in milliseconds, 1 to 10000: while it runs, a display that the GPU "
    "draws stands still (default 50 where one may be there, else 500)",
    SHOWING, REAL(devices.render.launch_ms, HD_MIN_LAUNCH_MS, HD_MAX_LAUNCH_MS))
ROW("--geometry", NULL, "NAME",
    "solids: half-spaces with patterns on their faces; triangles: all of it as triangles, which "
    "gives nearly the same picture (default solids)",
    SHOWING, CHOICE(scene.geometry, "solids", "triangles"), .role = HD_DECIDES_PIXELS)
ROW("--divisions", NULL, "N",
    "with --geometry triangles: cut the side of each triangle into N, the triangle into N x N "
    "(default 1)",
    SHOWING, INTEGER(scene.divisions, 1, HD_MAX_DIVISIONS), .role = HD_DECIDES_PIXELS)
ROW("--accel", NULL, "NAME",
    "how triangles are searched; brute: each of them; bvh: by a bounding volume hierarchy "
    "(default auto: brute for a handful)",
    SHOWING, CHOICE(scene.accel, "auto", "brute", "bvh"), .role = HD_DECIDES_PIXELS)
ROW("--precision", NULL, "P", "float or double (default float)", SHOWING,
    CHOICE(devices.render.precision, "float", "double"), .role = HD_DECIDES_PIXELS)
ROW("--math", NULL, "M",
    "strict: the same bytes everywhere; fast: the device's own, which plain C has not (default "
    "strict)",
    SHOWING, CHOICE(devices.render.math, "strict", "fast"), .role = HD_DECIDES_PIXELS)
ROW("--stats", NULL, "FILE",
    "write a line of JSON about each frame, its times and rays, to FILE; -: standard output, "
    "which then has nothing else",
    RENDERING, TEXT(store.statistics, "a file or -"), .takes_file = true)
ROW("--verbose", "-v", NULL, "tell what was chosen and why", RENDERING, FLAG(telling.verbose),
    .only_one_of = loudness)
ROW("--quiet", "-q", NULL, "no progress and no notes; errors only", RENDERING, FLAG(telling.quiet),
    .only_one_of = loudness)
ROW("--frame-lines", NULL, NULL,
    "progress for programs: a line on standard error for each frame that is stored; with --quiet "
    "nothing else",
    HD_COMMAND_RENDER, FLAG(telling.tells_frames))
OPTION(bool schema, "--schema", NULL, NULL, "print the JSON Schema of scene files, and exit",
       HD_COMMAND_CHECK, FLAG(schema))
OPTION(bool json, "--json", NULL, NULL, "print the list as JSON",
       HD_COMMAND_CHECK | HD_COMMAND_DEVICES | HD_COMMAND_SELFTEST | HD_COMMAND_TUNE, FLAG(json))
ROW("--json", NULL, NULL, "print the figures as JSON", HD_COMMAND_COMPARE, FLAG(json))
OPTION(const char *diff, "--diff", NULL, "OUT.png", "write a heat map of the display error",
       HD_COMMAND_COMPARE, TEXT(diff, NULL), .check = check_diff, .takes_file = true)
OPTION(double fail_above, "--fail-above", NULL, "X",
       "end with exit code 1 if the largest display error is above X steps of 255",
       HD_COMMAND_COMPARE, REAL(fail_above, 0.0, HD_MAX_ERROR))
OPTION(int curve, "--curve", NULL, "NAME",
       "the curve that PNG pictures are on and display values are put on: linear or srgb, whatever "
       "the files say",
       HD_COMMAND_COMPARE, .type = HD_OPTION_CHOICE, AT(curve), .choices = hd_curve_names)
ROW("--help", "-h", NULL, "print this help", EVERYTHING, COMMAND(HD_COMMAND_HELP))
ROW("--version", "-V", NULL, "print the version", RENDERING, COMMAND(HD_COMMAND_VERSION))
