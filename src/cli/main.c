/* SPDX-License-Identifier: MIT */
/* The program: parses the command line, runs a command, prints its error, picks the exit code. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <unistd.h>

#include "cli/commands.h"
#include "system/interrupt.h"
#include "system/thread_pool.h"

static HdStatus run(const HdOptions *options, HdError *error) {
    switch (options->command) {
    case HD_COMMAND_CLASSIC:
        return hd_command_classic(options, error);
    case HD_COMMAND_RENDER:
        return hd_command_render(options, error);
    case HD_COMMAND_CHECK:
        return hd_command_check(options, error);
    case HD_COMMAND_CONVERT:
        return hd_command_convert(options, error);
    case HD_COMMAND_DEVICES:
        return hd_command_devices(options, error);
    case HD_COMMAND_SELFTEST:
        return hd_command_selftest(options, error);
    case HD_COMMAND_TUNE:
        return hd_command_tune(options, error);
    case HD_COMMAND_COMPARE:
        return hd_command_compare(options, error);
    case HD_COMMAND_NEW:
        return hd_command_new(options, error);
    case HD_COMMAND_COMPLETE:
        hd_command_complete(options);
        return HD_OK;
    case HD_COMMAND_HELP:
        hd_command_help(&options->help_topic);
        return HD_OK;
    case HD_COMMAND_VERSION:
        printf("hedron %s\n", HD_VERSION);
        return HD_OK;
    }
    return HD_OK;
}

/* Output that never reached its file is a failure like any other. */
static HdStatus close_standard_output(HdError *error) {
    if (fflush(stdout) == 0 && !ferror(stdout))
        return HD_OK;
    return hd_fail(error, HD_FAILED, "cannot write to standard output");
}

int main(int count, char **arguments) {
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
    if (status == HD_OK)
        status = close_standard_output(&error);
    if (status == HD_OK)
        return 0;
    fprintf(stderr, "hedron: %s\n", error.message);
    if (status == HD_INTERRUPTED)
        return 128 + hd_interrupt_signal();
    return (int)status;
}
