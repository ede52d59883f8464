/* SPDX-License-Identifier: MIT */
/* The commands, the rows of HdCommandSpec: included by options.c, so without a guard. */

ROW(HD_COMMAND_RENDER, "render", "[SCENE.json]", ".json", 1, "render a scene to films and pictures",
    "Renders the frames of SCENE.json (-: standard input), or of the built-in scene, and prints "
    "the name of each output.\n\n"
    "An output is a picture (" HD_PICTURE_ENDINGS "), a sequence such as "
    "out/%04d.png or out/####.png, or a film (" HD_FILM_ENDINGS "). FFmpeg makes the films. A "
    "picture without a number takes a single frame.\n\n"
    "A numbered .png sequence can be resumed: finished pictures with the same pixels are kept, and "
    "a film in the same run contains them too.\n\n"
    "--set reaches each value of the scene by its path: '--set camera.eye=[4,0,2]'. A value is "
    "JSON, or else a string. --size, --samples, --depth and --cutoff take effect after --set.")
ROW(HD_COMMAND_VIEW, "view", "[SCENE.json]", ".json", 1,
    "fly through a scene in a window or a terminal",
    "Shows SCENE.json, or the built-in scene, live. Space plays the camera path, mouse and arrows "
    "turn the view, h lists all keys. While something moves, hedron adapts size and samples to the "
    "device. A view that stands still is refined to the bytes of 'hedron render'.\n\n"
    "Whenever the file is saved, hedron reloads it. An error in it appears over the last "
    "good picture. Names of saved pictures (p) and cameras to paste into a scene (c) go to "
    "standard output.\n\n"
    "This runs the program hedron-view, which needs SDL 2 for a window, chafa for --terminal.")
ROW(HD_COMMAND_NEW, "new", "[SCENE.json]", ".json", 1, "write a scene with comments to start from",
    "Writes a small scene with comments to SCENE.json (default: scene.json). A file that exists is "
    "never overwritten. 'hedron help scene' explains every key.")
ROW(HD_COMMAND_CHECK, "check", "SCENE.json...", ".json", -1,
    "look for errors in scenes without rendering",
    "Reads each scene (-: standard input) and its files. It prints a line for a valid scene and "
    "every error of a wrong one; then the exit code is 2. Notes point out settings that are valid "
    "but probably unintended.")
ROW(HD_COMMAND_CONVERT, "convert", "[CLASSIC_INPUT]", NULL, 1,
    "convert a classic input to a scene file",
    "Reads the input of the classic mode from a file, or from standard input, and writes the same "
    "scene as JSON. 'hedron render' makes the same pixels of it.")
ROW(HD_COMMAND_DEVICES, "devices", "", NULL, 0,
    "list backends and devices, and why others are unavailable",
    "Lists backends and devices, and the reason if one is unavailable.")
ROW(HD_COMMAND_SELFTEST, "selftest", "", NULL, 0, "test whether devices compute correctly",
    "Tests every device, or those of --device and --backend, in float and, if the device has it, "
    "in double. It compares the arithmetic of the kernels on a million hard operands with the C "
    "backend, and frames by every kind of kernel with known hashes.\n\n"
    "The report of a device has its driver, the compiler of its kernels, the tests, the first "
    "mismatch, the times, and a hash of all but the times. hedron remembers the result for this "
    "driver, and 'hedron render' skips a device that computes wrongly.\n\n"
    "The exit code is 1 if a device computes wrongly, and 3 if no device can be tested.")
ROW(HD_COMMAND_TUNE, "tune", "[SCENE.json]", ".json", 1,
    "measure and remember the fastest settings",
    "Measures the pipelines on the device that 'hedron render' would use for SCENE.json (-: "
    "standard input) or the built-in scene. It also varies the lanes of a CPU, and the work groups "
    "and registers of a GPU. It keeps what --pipeline, --lanes, --block or --grid set.\n\n"
    "It prints the time of a picture for each candidate and the ratio to the default. The best "
    "goes to the cache folder: 'hedron render' uses it for similar scenes with the same options. "
    "Strict pictures keep their bytes.")
ROW(HD_COMMAND_COMPARE, "compare", "FIRST SECOND", NULL, 2,
    "measure the difference of two pictures",
    "Compares two pictures of the same size: PNG, OpenEXR or PFM. It prints RMSE, PSNR, mean "
    "error, and maximum error with its pixel. It also prints the error that one pixel in 1000 "
    "exceeds, and the shares of pixels off by more than 1/255 and 8/255. The error of a pixel is "
    "that of its worst channel.\n\n"
    "Display errors are of values clamped to 0..1 and encoded by the transfer curve, in 1/255 "
    "units. Without --curve that is sRGB if a PNG says so or both are PFM, else linear. Linear "
    "errors are of light with 1 as white, clamped to 0..1 if one picture is a PNG. Other "
    "channels that both OpenEXR pictures have are compared by value.\n\n"
    "The heat map of --diff has a logarithmic scale in 1/255 units: black below 1/4, dark violet "
    "(1/4), purple (1), red (4), orange (16), yellow (128), pale yellow (255); cyan for NaN and "
    "infinite values.\n\n"
    "The exit code is 1 if a colour is NaN or infinite, or if the maximum display error is above "
    "--fail-above.")
ROW(HD_COMMAND_HELP, "help", "[TOPIC]", NULL, 1, "explain a command or a topic",
    "TOPIC is a command, or: scene, every key of a scene file; classic, the classic mode; man, the "
    "man page in troff; completion, completion-zsh or completion-fish, a script that completes "
    "arguments in bash, zsh or fish.")
ROW(HD_COMMAND_COMPLETE, "complete", "-- WORD...", NULL, -1, "list completions for a shell",
    "Prints the completions of the last WORD, which may be empty: one a line, then a tab and its "
    "meaning. ':.json' stands for file names with that ending, ':' for all file names. For the "
    "scripts of 'hedron help completion'.")
ROW(HD_COMMAND_CLASSIC, NULL, "< INPUT", NULL, 0, "the classic mode",
    "The classic mode reads a configuration from standard input. It prints one line for each "
    "frame, and nothing else: frame TAB milliseconds TAB rays.\n\n"
    "The configuration is numbers and paths, separated by white space: frames, output path, width, "
    "height, field of view; camera paths of eye and target; three solids; floor; lights; depth and "
    "samples. '--default' prints an example, docs/reference/files.md explains each number, and "
    "'hedron convert' makes a scene file of it.")
