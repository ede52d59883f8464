# SPDX-License-Identifier: MIT
"""What the programs of bench/ have in common towards the one who calls them."""
import math
import os
import sys


def whole_number(text):
    """For argparse: 1 or more; "1e6" will do."""
    number = float(text)
    if not 1 <= number < math.inf or number != int(number):
        raise ValueError
    return int(number)


whole_number.__name__ = "number from 1 on"  # argparse's message uses it


def news():
    """Tells what is being done: one line that changes on a terminal, else nothing."""
    return terminal_news if os.isatty(2) else no_news


def no_news(_):
    pass


def terminal_news(text):
    print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
