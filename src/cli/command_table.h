/* SPDX-License-Identifier: MIT */
/* The commands, the rows of HdCommandSpec: included by options.c, so without a guard. */

ROW(HD_COMMAND_RENDER, "render", "[SCENE.json]", ".json", 1,
    "render a scene, or the built-in one, to films and pictures",
    "Renders the frames of SCENE.json (-: standard input), or of the built-in scene, and prints "
    "the name of each output.\n\n"
    "OUT is a picture (" HD_PICTURE_ENDINGS "), a numbered sequence of pictures such as "
    "out/%04d.png or out/####.png, or a film (" HD_FILM_ENDINGS "; made by FFmpeg). A picture "
    "without a number takes a single frame. Several -o give several outputs of one run. Without "
    "-o the output is the one that the scene names, else hedron.mp4, or hedron.png for a single "
    "frame.\n\n"
    "A numbered sequence of .png that was begun before goes on: frames whose pictures are there, "
    "whole and with the same pixels, are not rendered again, and a film beside them is made of "
    "all.\n\n"
    "--set reaches every value of the scene file by its path, for example --set "
    "camera.field_of_view=40, --set camera.eye=[4,0,2], --set image.exposure=2, --set "
    "output.curve=linear or --set output.bits=16. A value is JSON, or else a string. --size, "
    "--samples, --depth and --cutoff come last.")
ROW(HD_COMMAND_VIEW, "view", "[SCENE.json]", ".json", 1,
    "fly through a scene in a window or a terminal",
    "Shows SCENE.json, or the built-in scene, live: space plays its flight, mouse and arrows "
    "turn the view, and h lists all keys. While something moves, size and samples are what the "
    "device can make in time; standing still, the picture is refined until it has the bytes that "
    "'hedron render' makes of that view. The file is watched: saved, it is shown at once, and a "
    "mistake in it is told over the last good picture. The names of pictures that are saved (p) "
    "and cameras to paste into a scene (c) go to standard output.\n\n"
    "Both are in a program of their own, hedron-view, which needs SDL 2 for the window and chafa "
    "for --terminal: block symbols in the colours that the terminal has, or pictures where it "
    "says that it can (the kitty protocol or sixels).")
ROW(HD_COMMAND_NEW, "new", "[SCENE.json]", ".json", 1, "write a scene to start from, with comments",
    "Writes a small scene in which comments tell what is what, to SCENE.json (default: "
    "scene.json), and never over a file that is there. 'hedron help scene' explains every key.")
ROW(HD_COMMAND_CHECK, "check", "SCENE.json...", ".json", -1,
    "look for mistakes in scenes without rendering",
    "Reads each scene (-: standard input) and its texture, and prints a line about each that is "
    "right, or every mistake that is in it; one wrong scene makes the exit code 2. Notes tell "
    "what is allowed and seldom meant.")
ROW(HD_COMMAND_CONVERT, "convert", "[CLASSIC_INPUT]", NULL, 1,
    "turn a classic input into a scene file",
    "Reads the input of the classic mode from a file, or from standard input, and writes the "
    "same scene as JSON. 'hedron render' makes the same pictures of it, byte for byte.")
ROW(HD_COMMAND_DEVICES, "devices", "", NULL, 0, "list backends and devices, and what is missing",
    "Lists backends and devices; for what is missing, the reason.")
ROW(HD_COMMAND_SELFTEST, "selftest", "", NULL, 0, "test whether devices compute rightly",
    "Tests every device, or those of --device and --backend, and prints a certificate for each: "
    "the device, its driver, what compiled its kernels, this program's version, what was tested, "
    "what came of it, the time, and a hash of all but times. Tested are, in float and, where "
    "there is it, in double, the arithmetic that kernels are made of, on a million hard operands "
    "against plain C's (of CUDA and OpenCL), and frames whose hashes are known, by kernels of "
    "every kind, the golden frames of the conformance suite among them. What is wrong is told "
    "with the first difference. What is found is remembered with the driver's version: 'hedron "
    "render' passes over a device that computes wrongly.\n\n"
    "The exit code is 1 if a device computes wrongly, and 3 if there is none that can be tested.")
ROW(HD_COMMAND_TUNE, "tune", "[SCENE.json]", ".json", 1,
    "measure what suits a device and a scene best, and remember it",
    "Measures, on the device that 'hedron render' would take for SCENE.json (-: standard input) "
    "or the built-in scene, which pipeline is the fastest, with how many lanes on a CPU, and on "
    "a GPU in which groups and with how many registers. What --pipeline, --lanes, --block or "
    "--grid fix is left as it is. Prints a line for each candidate, its time for a picture and "
    "the ratio to the device's default, and remembers the best in the cache folder: 'hedron "
    "render' uses it for scenes of this kind and size with the same options, and says so with "
    "--verbose. The bytes of strict pictures do not depend on it.")
ROW(HD_COMMAND_COMPARE, "compare", "FIRST SECOND", NULL, 2, "tell how far two pictures are apart",
    "Compares two pictures of the same size, PNG (8 or 16 bits), OpenEXR or PFM, in two spaces. "
    "Display: the values clamped to 0..1 and on the curve, in steps of 255. Linear: light, 1 is "
    "white; clamped to 0..1 as well if one of them is a PNG. Prints RMSE, PSNR, mean and largest "
    "error with its pixel, the error that one pixel in 1000 exceeds, and the shares of pixels "
    "off by more than 1 and 8 steps of 255. The error of a pixel is that of its worst channel. "
    "Other channels that both OpenEXR pictures have are compared by their values.\n\n"
    "The exit code is 1 if a value of a colour is NaN or infinite, or if the largest display "
    "error is above --fail-above. Without --curve the curve is sRGB if a PNG says so or both are "
    "PFM, else linear, as 'hedron render' writes them.\n\n"
    "The heat map of --diff shows the display error of each pixel on a logarithmic scale: black "
    "below 1/4 of a step of 255, dark violet at 1/4, then purple (1), red (4), orange (16), "
    "yellow (128) and pale yellow (255), lighter by the same step with each doubling; cyan for "
    "NaN and infinite values.")
ROW(HD_COMMAND_HELP, "help", "[TOPIC]", NULL, 1, "explain a command",
    "TOPIC is a command; 'scene' for every key of a scene file; 'man' for the man page (in "
    "troff); or 'completion', 'completion-zsh' or 'completion-fish' for what completes this "
    "program's arguments in bash, zsh or fish.")
ROW(HD_COMMAND_COMPLETE, "complete", "-- WORD...", NULL, -1, "tell shells what may follow",
    "Prints how the last WORD of a command line, which may be empty, can go on: a line for each "
    "way, with a tab and what it is about; ':.json' stands for the names of files that end so, "
    "':' for those of all files. For the scripts of 'hedron help completion'.")
ROW(HD_COMMAND_CLASSIC, NULL, "< INPUT", NULL, 0,
    "the classic mode: a configuration on standard input",
    "In the classic mode standard output has one line for each frame and nothing else: frame TAB "
    "milliseconds TAB rays.")
