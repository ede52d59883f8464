# SPDX-License-Identifier: MIT
"""The command line of everything under bench/."""
import argparse
import math
import os
import signal
import sys
from pathlib import Path

from harness.run.program import ROOT, Problem


def whole_number(text):
    """1 or more; "1e6" will do."""
    number = float(text)
    if not 1 <= number < math.inf or number != int(number):
        raise ValueError
    return int(number)


whole_number.__name__ = "number from 1 on"  # argparse's message uses it


def part_names(parts):
    """In the order of the parts."""
    def names_in(text):
        names = text.split(",")
        if not set(names) <= set(parts):
            raise argparse.ArgumentTypeError(f"'{text}' names a part that is none of {', '.join(parts)}")
        return [part for part in parts if part in names]
    return names_in


class Command:
    """One of the names that bench/study knows, or a program of its own."""
    name = ""
    about = ""  # what it does, for --help
    codes = "exit codes: 0 done, 2 wrong usage or input"
    own_options = None  # of hedron render, which it sets itself; None: it renders nothing

    @classmethod
    def title(cls):
        return f"bench/{cls.name}" if (ROOT / "bench" / cls.name).is_file() else f"bench/study {cls.name}"

    @classmethod
    def add_options(cls, parser):
        """What it takes."""

    @classmethod
    def complete(cls, arguments):
        """Fills in what follows from the options."""

    @classmethod
    def parse(cls, words):
        options, usage = [], None
        if cls.own_options is not None:
            usage = "%(prog)s [OPTION]... [-- HEDRON_OPTION...]"
            if "--" in words:
                split = words.index("--")
                words, options = words[:split], words[split + 1:]
        parser = argparse.ArgumentParser(prog=cls.title(), usage=usage, description=cls.about, epilog=cls.codes,
                                         allow_abbrev=False)
        cls.add_options(parser)
        arguments = parser.parse_args(words)
        for option in options:
            if option.split("=")[0] in cls.own_options or option.startswith("-o"):
                parser.error(f"{option} cannot stand after --, for {cls.title()} sets it itself")
        arguments.options = options
        try:
            cls.complete(arguments)
        except ValueError as error:
            parser.error(str(error))
        return arguments

    @classmethod
    def run(cls, arguments):
        """The exit code."""
        raise NotImplementedError

    @classmethod
    def main(cls, words):
        arguments = cls.parse(words)
        for number in (signal.SIGTERM, signal.SIGHUP):  # like Ctrl-C: no hedron is left running
            signal.signal(number, signal.default_int_handler)
        try:
            return cls.run(arguments)
        except Problem as problem:
            print(f"{cls.title()}: {problem}", file=sys.stderr)
            return problem.code
        except KeyboardInterrupt:
            return 130
        except BrokenPipeError:  # nobody reads the tables; the files are written
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 1


def add_common(parser, quick, repeats, parts):
    """The options that all measurements share. `repeats` are rounds, slowly and quickly."""
    if quick:
        parser.add_argument("--quick", action="store_true", help=quick)
    else:
        parser.set_defaults(quick=False)
    parser.add_argument("--hedron", type=Path, default=ROOT / "build/release/hedron", metavar="PROGRAM",
                        help="the program to measure, beside which are those of the build (default: build/release/hedron)")
    parser.add_argument("--out", type=Path, default=ROOT / "bench/out", metavar="FOLDER",
                        help="where the results go (default: bench/out)")
    if repeats:
        default = f"default: {repeats[0]}" + (f", with --quick {repeats[1]}" if quick else "")
        parser.add_argument("--repeats", type=whole_number, metavar="N", help=f"rounds of all runs, in turns ({default})")
        parser.add_argument("--device", action="append", default=[], metavar="BACKEND[:NUMBER]",
                            help="only this backend or device of 'hedron devices'; may be repeated")
    else:
        parser.set_defaults(repeats=None, device=[])
    if parts:
        parser.add_argument("--parts", type=part_names(parts), default=list(parts), metavar="NAME,...",
                            help=f"only these; of {', '.join(parts)}")
