# SPDX-License-Identifier: MIT
"""The command line of everything under bench/."""
import argparse
import math
import os
import signal
import sys

from harness.run.program import ROOT, Problem


def whole_number(text):
    """Returns a number of 1 or more; "1e6" is one."""
    number = float(text)
    if not 1 <= number < math.inf or number != int(number):
        raise ValueError
    return int(number)


whole_number.__name__ = "number from 1 on"  # argparse's message uses it


def part_names(parts):
    """Returns the chosen parts in their order."""
    def names_in(text):
        names = text.split(",")
        if not set(names) <= set(parts):
            raise argparse.ArgumentTypeError(f"'{text}' names a part that is none of {', '.join(parts)}")
        return [part for part in parts if part in names]
    return names_in


class Command:
    """Command line of a measurement or a program."""
    name = ""
    about = ""  # its purpose, for --help
    operands = ""  # of its usage
    codes = "exit codes: 0 done, 2 wrong usage or input"
    own_options = None  # options of hedron render that it sets itself; None: it renders nothing

    def title(self):
        return f"bench/{self.name}" if (ROOT / "bench" / self.name).is_file() else f"bench/study {self.name}"

    def add_options(self, parser):
        """Adds the options of the command."""

    def complete(self, arguments):
        """Fills in defaults that depend on other options; a ValueError is wrong usage."""

    def run(self, arguments):
        """Runs the command and returns its exit code."""
        raise NotImplementedError

    def parse(self, words):
        options, usage = [], None
        if self.own_options is not None:
            usage = f"%(prog)s [OPTION]... {self.operands}[-- HEDRON_OPTION...]"
            if "--" in words:
                split = words.index("--")
                words, options = words[:split], words[split + 1:]
        parser = argparse.ArgumentParser(prog=self.title(), usage=usage, description=self.about, epilog=self.codes,
                                         allow_abbrev=False)
        self.add_options(parser)
        arguments, unknown = parser.parse_known_args(words)
        if unknown:
            self.refuse(parser, unknown)
        for option in options:
            if option.split("=")[0] in self.own_options or option.startswith("-o"):
                parser.error(f"{option} cannot stand after --, because {self.title()} sets it itself")
        arguments.options = options
        try:
            self.complete(arguments)
        except ValueError as error:
            parser.error(str(error))
        return arguments

    def refuse(self, parser, unknown):
        """Ends the program; reports where an option of hedron belongs."""
        hint = ""
        if self.own_options is not None and unknown[0].startswith("-") and unknown[0].split("=")[0] not in self.own_options:
            hint = f"; options of hedron render go behind --, as in '{self.title()} -- --size 320x180'"
        parser.error(f"unrecognized arguments: {' '.join(unknown)}{hint}")

    def main(self, words):
        arguments = self.parse(words)
        for number in (signal.SIGTERM, signal.SIGHUP):  # like Ctrl-C: leaves no hedron running
            signal.signal(number, signal.default_int_handler)
        try:
            return self.run(arguments)
        except Problem as problem:
            print(f"{self.title()}: {problem}", file=sys.stderr)
            return problem.code
        except KeyboardInterrupt:
            return 130
        except BrokenPipeError:  # nobody reads the tables; the files are written
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 1
