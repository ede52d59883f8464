# SPDX-License-Identifier: MIT
"""The machine and its load."""
import os
import platform


def cpu_name():
    try:
        with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as file:
            for line in file:
                key, _, value = line.partition(":")
                if key.strip() in ("model name", "Model"):
                    return " ".join(value.split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


def cores():
    """Returns the processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count()


def load():
    """Returns the mean number of runnable processes over 1, 5 and 15 minutes."""
    return [round(mean, 2) for mean in os.getloadavg()]


def busy_seconds():
    """Returns the busy seconds of the usable processors, for all programs; None if the system does not report them."""
    try:
        usable = {f"cpu{number}" for number in os.sched_getaffinity(0)}
        with open("/proc/stat", encoding="ascii", errors="replace") as file:
            lines = [words for words in map(str.split, file) if words and words[0] in usable]
        # user, nice and system; interrupts, and time stolen by other guests of the host
        ticks = [sum(map(int, words[1:4])) + sum(map(int, words[6:9])) for words in lines]
    except (OSError, ValueError, AttributeError):
        return None
    return sum(ticks) / os.sysconf("SC_CLK_TCK") if any(ticks) else None


def describe():
    return {
        "cpu": cpu_name(),
        "cores": cores(),
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "load_before": load(),
        "load_after": None,
    }
