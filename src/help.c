/* SPDX-License-Identifier: MIT */
#include "commands.h"
#include "output_kind.h"

static void print_program(void) {
    printf("hedron renders mirrored, transparent platonic solids with lights along their edges.\n"
           "\n"
           "Usage:\n"
           "  hedron render [OPTIONS]        render the built-in scene to a film or to pictures\n"
           "  hedron devices                 list backends and devices, and what is missing\n"
           "  hedron [OPTIONS] < INPUT       the classic mode: a configuration on standard input\n"
           "  hedron --default               print such a configuration\n"
           "  hedron help [COMMAND]          explain a command\n"
           "\n"
           "Options of the classic mode:\n");
    hd_options_print(stdout, HD_COMMAND_CLASSIC);
    printf("\n"
           "In the classic mode standard output has one line for each frame and nothing else:\n"
           "  frame TAB milliseconds TAB rays\n"
           "\n"
           "Exit codes: 0 done, 1 failed, 2 wrong usage or input, 3 no such backend or device,\n"
           "130 and 143 interrupted.\n");
}

static void print_render(void) {
    printf("hedron render: renders the built-in scene.\n"
           "\n"
           "Usage: hedron render [OPTIONS]\n"
           "\n"
           "OUT ends as one of these: %s.\n"
           "Films are made by FFmpeg. A sequence of pictures has its frames' number in its name,\n"
           "%%d, %%04d or ####; a picture without takes a single frame. Without -o the film is\n"
           "written to hedron.mp4.\n"
           "\n"
           "Options:\n",
           hd_output_endings());
    hd_options_print(stdout, HD_COMMAND_RENDER);
}

static void print_devices(void) {
    printf("hedron devices: lists backends and devices; for what is missing, the reason.\n"
           "\n"
           "Usage: hedron devices\n"
           "\n"
           "Options:\n");
    hd_options_print(stdout, HD_COMMAND_DEVICES);
}

void hd_command_help(HdCommand topic) {
    if (topic == HD_COMMAND_RENDER)
        print_render();
    else if (topic == HD_COMMAND_DEVICES)
        print_devices();
    else
        print_program();
}
