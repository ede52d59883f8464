/* SPDX-License-Identifier: MIT */
/* The options of the command line, and what each sets. Included twice, so without a guard: by
   options.h for the members of HdOptions, by options.c for the rows of HdOptionSpec.
   ROW(...): an option that sets a member of a part of the plan (run/plan.h), another option's, or
   none. OPTION(MEMBER, ROW...): one with a member of its own. */

OPTION(bool gpu, "--gpu", NULL, NULL,
       "Trace on a GPU, the default; if none is suitable, on the CPU with a note",
       HD_COMMAND_CLASSIC, FLAG(gpu), .only_one_of = modes)
OPTION(bool cpu, "--cpu", NULL, NULL, "Trace on the CPU only", HD_COMMAND_CLASSIC, FLAG(cpu),
       .only_one_of = modes)
OPTION(bool prints_default, "--default", NULL, NULL,
       "Print a colourful scene as classic input, and exit", HD_COMMAND_CLASSIC,
       FLAG(prints_default), .only_one_of = modes)
ROW("--variant", NULL, "N", "Which three solids the input describes",
    HD_COMMAND_CLASSIC | HD_COMMAND_CONVERT, INTEGER(scene.variant, 1, HD_CLASSIC_VARIANTS),
    .standard = "4, which is tetrahedron, octahedron, dodecahedron", .role = HD_DECIDES_PIXELS)
ROW("--output", "-o", "OUT", "Film, picture or numbered sequence of pictures; up to 8 times",
    HD_COMMAND_RENDER, TEXTS(store.names, store.count, HD_MAX_OUTPUTS),
    .check = hd_output_check_name, .expected = "the name of a file",
    .standard = "that of the scene, else hedron.mp4, or hedron.png for one frame",
    .use = "more than one for several formats", .takes_file = true)
ROW("--output", "-o", "SCENE", "Scene file to write", HD_COMMAND_CONVERT,
    TEXTS(store.names, store.count, 1), .expected = "the name of a file",
    .standard = "standard output", .takes_file = true)
ROW("--layers", NULL, "LIST",
    "Extra channels for OpenEXR: depth, normal and object number of the first hit, bound on the "
    "pixel's truncation error",
    HD_COMMAND_RENDER, .type = HD_OPTION_SET, AT(store.layers), .choices = hd_layer_names,
    .use = "for compositing")
ROW("--set", NULL, "PATH=VALUE",
    "Replace a value of the scene, such as camera.field_of_view=40; up to 64 times",
    HD_COMMAND_RENDER | HD_COMMAND_CHECK | HD_COMMAND_TUNE | HD_COMMAND_VIEW,
    TEXTS(scene.changes, scene.change_count, HD_MAX_CHANGES), .check = check_change,
    .use = "to try a value without editing the file", .role = HD_DECIDES_PIXELS)
ROW("--strict-files", NULL, NULL,
    "Refuse meshes, material libraries and textures that have wrong items; without it they get "
    "notes",
    HD_COMMAND_RENDER | HD_COMMAND_CHECK | HD_COMMAND_TUNE | HD_COMMAND_VIEW,
    FLAG(scene.strict_files))
OPTION(const char *frames, "--frames", "-f", "LIST",
       "Render only these frames, such as 0-9,20; 0-99:2 is every second one", MEASURING,
       TEXT(frames, NULL), .standard = "all")
ROW("--again", NULL, NULL,
    "Render all frames. Without it, finished pictures of a numbered PNG sequence are kept if their "
    "pixels would be the same",
    HD_COMMAND_RENDER, FLAG(store.again))
ROW("--no-sync", NULL, NULL,
    "Do not wait until files are on the disk. They survive the end of the program, but not a power "
    "cut",
    HD_COMMAND_CLASSIC | HD_COMMAND_RENDER, FLAG(store.no_sync),
    .use = "for many small frames on a slow disk")
OPTION(const char *mesh, "--mesh", NULL, "MODEL.obj",
       "Show this mesh on a floor, lit and wholly in view, whatever its size", HD_COMMAND_NEW,
       TEXT(mesh, "the name of a file"), .takes_file = true)
OPTION(
    const char *up, "--up", NULL, "AXIS",
    "Axis of the mesh that points up; auto: z if it stands on z=0 and not on y=0, or is far from "
    "y=0; otherwise y",
    HD_COMMAND_NEW, ONE_OF(HD_OPTION_WORD, up, "auto", "y", "z"), .standard = "auto")
OPTION(bool terminal, "--terminal", NULL, NULL,
       "Show the scene in this terminal instead of a window", HD_COMMAND_VIEW, FLAG(terminal),
       .use = "over ssh, or without a display")
ROW("--size", NULL, "WxH", "Size of the picture in pixels", SHOWING, .type = HD_OPTION_SIZE,
    AT(scene.size), .expected = "WIDTHxHEIGHT such as 640x480, each 1 to 65535",
    .standard = OF_SCENE, .role = HD_DECIDES_NUMBERS)
ROW("--samples", NULL, "N", "N x N samples for each pixel", SHOWING,
    INTEGER(scene.samples, 1, HD_MAX_SAMPLES_PER_SIDE), .standard = OF_SCENE,
    .use = "few for a preview, more for smooth edges", .role = HD_DECIDES_NUMBERS)
ROW("--depth", NULL, "N", "Maximum ray depth: reflections and transmissions in a row", SHOWING,
    INTEGER(scene.depth, 0, HD_MAX_DEPTH), .standard = OF_SCENE,
    .use = "more for mirrors inside a solid, less for speed", .role = HD_DECIDES_NUMBERS)
ROW("--cutoff", NULL, "W", "End rays whose weight is below W in every channel; 0: never", SHOWING,
    REAL(scene.cutoff, 0.0, 1.0), .below_high = true, .standard = OF_SCENE,
    .role = HD_DECIDES_NUMBERS)
ROW("--aa", NULL, "NAME",
    "Antialiasing by N x N samples. grid: in the middles of N x N cells; multijitter: one in each "
    "cell and in each of N * N columns and rows, with about 0.8 of the error in the mean",
    RENDERING | HD_COMMAND_VIEW, .type = HD_OPTION_CHOICE, AT(scene.sampling),
    .choices = hd_sampling_names, .standard = OF_SCENE, .role = HD_DECIDES_PIXELS)
ROW("--max-error", NULL, "E",
    "Maximum truncation error of a pixel, in 1/255 units. Depth, cut-off and lights follow from it "
    "instead of from the scene",
    RENDERING | HD_COMMAND_VIEW, REAL(scene.max_error, HD_MIN_ERROR, HD_MAX_ERROR),
    .standard = OF_SCENE, .use = "to choose accuracy rather than depth", .role = HD_DECIDES_PIXELS)
OPTION(bool reference, "--reference", NULL, NULL,
       "Render a reference picture: double precision, 32 x 32 low-discrepancy samples (or those of "
       "--samples), '--max-error 1/64'",
       HD_COMMAND_RENDER, FLAG(reference),
       .use = "to measure the error of other pictures; slow, so with a small --size or --crop",
       .role = HD_DECIDES_PIXELS)
ROW("--crop", NULL, "WxH+X+Y", "Render only W x H pixels, from column X and row Y on",
    HD_COMMAND_RENDER, .type = HD_OPTION_CROP, AT(scene.crop),
    .expected = "WIDTHxHEIGHT+X+Y such as 64x64+320+200", .role = HD_DECIDES_NUMBERS)
ROW("--backend", NULL, "NAME", "Backend; auto: the best device of any, for 'selftest' all",
    SHOWING | HD_COMMAND_SELFTEST,
    ONE_OF(HD_OPTION_WORD, devices.backend, "auto", "c", "opencl", "cuda"), .standard = "auto")
ROW("--device", NULL, "DEVICE",
    "Device: its number in 'hedron devices', BACKEND:NUMBER, or part of its name. For 'render' and "
    "the classic mode also all, or a list such as cuda:0,c:0, which share the frames",
    SHOWING | HD_COMMAND_SELFTEST,
    TEXT(devices.device, "a number, BACKEND:NUMBER or part of a name"),
    .standard = "the best one, for 'selftest' all", .use = "all for a film on several GPUs")
OPTION(bool quick, "--quick", NULL, NULL,
       "Test with 8192 operands and one kind of kernels, in a second or two once these are "
       "compiled",
       HD_COMMAND_SELFTEST, FLAG(quick))
OPTION(bool deep, "--deep", NULL, NULL,
       "Also compare 2400 random scenes with the C backend, in each precision and pipeline. A "
       "mismatch is reported with its pixel, sample and ray depth",
       HD_COMMAND_SELFTEST, FLAG(deep), .use = "for a new driver or card; takes minutes")
ROW("--lanes", NULL, "N", "Rays traced together on a CPU, up to what a vector register holds",
    SHOWING, .type = HD_OPTION_NUMERAL, AT(devices.render.lanes), .choices = lane_counts,
    .standard = OF_DEVICE)
ROW("--threads", "-j", "N", "Threads of the C backend", SHOWING,
    INTEGER(devices.render.threads, 1, HD_MAX_THREADS), .standard = "one for each core")
ROW("--pipeline", NULL, "NAME",
    "mega: each packet traces its whole ray tree; wavefront: one ray depth at a time, compacted "
    "between; wavefront-uncompacted: the same with ended rays kept, for comparison; auto: what "
    "suits device and scene",
    SHOWING, .type = HD_OPTION_CHOICE, AT(devices.render.pipeline), .choices = hd_pipeline_names,
    .standard = "auto")
ROW("--block", NULL, "N", "Threads of a GPU's work group", SHOWING,
    INTEGER(devices.render.block, HD_BLOCK_STEP, HD_MAX_BLOCK), .step = HD_BLOCK_STEP,
    .standard = OF_DEVICE)
ROW("--grid", NULL, "N", "Maximum number of work groups in one GPU launch", SHOWING,
    INTEGER(devices.render.grid, 1, HD_MAX_GRID), .standard = OF_DEVICE)
ROW("--max-launch", NULL, "MS",
    "Maximum duration of one GPU launch, in ms. A display on that GPU freezes meanwhile", SHOWING,
    REAL(devices.render.launch_ms, HD_MIN_LAUNCH_MS, HD_MAX_LAUNCH_MS),
    .standard = "50 if the GPU may drive a display, else 500", .use = "less for a smooth desktop")
ROW("--geometry", NULL, "NAME",
    "solids: half-spaces with patterns on their faces; triangles: everything as triangles, which "
    "gives nearly the same picture",
    SHOWING, CHOICE(scene.geometry, "solids", "triangles"), .standard = "solids",
    .use = "triangles to measure meshes", .role = HD_DECIDES_PIXELS)
ROW("--divisions", NULL, "N",
    "With '--geometry triangles': cut each side of a triangle into N, the triangle into N x N",
    SHOWING, INTEGER(scene.divisions, 1, HD_MAX_DIVISIONS), .standard = "1",
    .role = HD_DECIDES_PIXELS)
ROW("--accel", NULL, "NAME",
    "Search for triangles. brute: test all; bvh: by a bounding volume hierarchy; auto: brute for "
    "a mesh of up to 8",
    SHOWING, CHOICE(scene.accel, "auto", "brute", "bvh"), .standard = "auto",
    .role = HD_DECIDES_PIXELS)
ROW("--precision", NULL, "P", "Precision of the kernels", SHOWING,
    CHOICE(devices.render.precision, "float", "double"), .standard = "float",
    .role = HD_DECIDES_PIXELS)
ROW("--math", NULL, "M",
    "strict: the same bytes on every device; fast: the device's native arithmetic, not available "
    "on the C backend",
    SHOWING, CHOICE(devices.render.math, "strict", "fast"), .standard = "strict",
    .use = "fast if equal bytes do not matter", .role = HD_DECIDES_PIXELS)
ROW("--stats", NULL, "FILE",
    "Write a line of JSON for each frame, with its times and rays, to FILE; -: standard output, "
    "which then has nothing else",
    RENDERING, TEXT(store.statistics, "a file or -"), .takes_file = true)
ROW("--verbose", "-v", NULL, "Report what was chosen, and why", RENDERING, FLAG(reporting.verbose),
    .only_one_of = loudness)
ROW("--quiet", "-q", NULL,
    "Print no progress and no notes. Names of outputs still go to standard output", RENDERING,
    FLAG(reporting.quiet), .only_one_of = loudness)
ROW("--frame-lines", NULL, NULL,
    "Print a line on standard error for each frame that is stored; with --quiet nothing else",
    HD_COMMAND_RENDER, FLAG(reporting.reports_frames), .use = "for programs that watch a run")
OPTION(bool schema, "--schema", NULL, NULL, "Print the JSON Schema of scene files, and exit",
       HD_COMMAND_CHECK, FLAG(schema), .use = "for completion in an editor")
OPTION(bool json, "--json", NULL, NULL, "Print the result as JSON",
       HD_COMMAND_CHECK | HD_COMMAND_DEVICES | HD_COMMAND_SELFTEST | HD_COMMAND_TUNE |
           HD_COMMAND_COMPARE,
       FLAG(json))
OPTION(const char *diff, "--diff", NULL, "OUT.png", "Write a heat map of the display error",
       HD_COMMAND_COMPARE, TEXT(diff, NULL), .check = check_diff, .takes_file = true)
OPTION(double fail_above, "--fail-above", NULL, "X",
       "Exit with code 1 if the maximum display error is above X, in 1/255 units",
       HD_COMMAND_COMPARE, REAL(fail_above, 0.0, HD_MAX_ERROR))
OPTION(int curve, "--curve", NULL, "NAME",
       "Transfer curve of PNG pictures and of display values, whatever the files say",
       HD_COMMAND_COMPARE, .type = HD_OPTION_CHOICE, AT(curve), .choices = hd_curve_names)
ROW("--help", "-h", NULL, "Print the help of the command", EVERYTHING, COMMAND(HD_COMMAND_HELP))
ROW("--version", "-V", NULL, "Print the version", RENDERING, COMMAND(HD_COMMAND_VERSION))
