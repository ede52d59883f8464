# SPDX-License-Identifier: MIT
"""How fast several devices are that share the frames of a run."""


def steady_rate(frames):
    """Frames a second, as the sum of what each device does between the end of its first frame and that of its last:
    neither the compiling of kernels nor the wait of the last device for the others is in it. 0 where a device made
    fewer than two frames."""
    ends = {}
    for frame in frames:
        key = (frame["backend"], frame["index"])
        ends.setdefault(key, []).append(frame["began"]["trace"] + frame["seconds"]["trace"])
    if any(len(times) < 2 for times in ends.values()):
        return 0.0
    return sum((len(times) - 1) / (max(times) - min(times)) for times in ends.values())


def counts(total):
    """1, 2, 4, ... and all of them."""
    found = [1]
    while found[-1] * 2 <= total:
        found.append(found[-1] * 2)
    return found + [total] * (found[-1] != total)
