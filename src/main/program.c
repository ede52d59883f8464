/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "main/program.h"

#include <stdio.h>
#include <unistd.h>

#include "system/interrupt.h"
#include "system/thread_pool.h"

int hd_program_run(int count, char **arguments, HdCommandFunction *run) {
    static HdError error;
    HdOptions options;
    hd_interrupt_install();
    HdStatus status = hd_check_stack(&error);
    if (status == HD_OK)
        status = hd_interrupt_read_patience(&error);
    if (status == HD_OK)
        status = hd_options_parse(&options, count, arguments, &error);
    if (status == HD_OK && count == 1 && isatty(STDIN_FILENO))
        options.command = HD_COMMAND_HELP;
    if (status == HD_OK)
        status = run(&options, &error);
    if (status == HD_OK && (fflush(stdout) != 0 || ferror(stdout)))
        status = hd_fail(&error, HD_FAILED, "cannot write to standard output");
    if (status == HD_OK)
        return 0;
    fprintf(stderr, "hedron: %s\n", error.message);
    if (status == HD_INTERRUPTED)
        return 128 + hd_interrupt_signal();
    return (int)status;
}
