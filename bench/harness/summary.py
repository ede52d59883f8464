# SPDX-License-Identifier: MIT
"""Medians and quartiles of the frames that count."""
from statistics import median


def label(device):
    """As it is chosen on the command line."""
    return device["backend"] if device["index"] is None else f"{device['backend']}:{device['index']}"


def quartiles(values):
    """First quartile, median, third: at a quarter, a half and three quarters of the way from the
    smallest to the largest, linearly between neighbours."""
    ordered = sorted(values)

    def at(share):
        place = (len(ordered) - 1) * share
        low = int(place)
        high = min(low + 1, len(ordered) - 1)
        return ordered[low] + (ordered[high] - ordered[low]) * (place - low)

    return [at(0.25), at(0.5), at(0.75)]


def timed_frames(device):
    """The frames of all runs but the first of each, which warms up."""
    return [frame for run in device["runs"] for frame in run["frames"] if not frame["warm_up"]]


def rays(frame):
    return sum(frame["rays"].values())


def rate(count, seconds):
    """A second that the clock could not see makes no rate."""
    return count / seconds if seconds > 0 else None


def summarize(device):
    """None where no frame counts. Rates are those of the median frame."""
    frames = timed_frames(device)
    if not frames:
        return None
    traces = [frame["seconds"]["trace"] for frame in frames]
    whole = [sum(frame["seconds"].values()) for frame in frames]
    first, middle, third = quartiles(traces)
    rays_a_second = [rate(rays(frame), frame["seconds"]["trace"]) for frame in frames]
    tests_a_second = [rate(frame["shadow_tests"], frame["seconds"]["trace"]) for frame in frames]
    return {
        "frames": len(frames),
        "trace_ms": {"median": 1e3 * middle, "q1": 1e3 * first, "q3": 1e3 * third},
        "frame_ms": 1e3 * median(whole),
        "frames_per_second": rate(1, median(whole)),
        "rays_per_second": None if None in rays_a_second else median(rays_a_second),
        "shadow_tests_per_second": None if None in tests_a_second else median(tests_a_second),
        "ratio_to_fastest": None,
    }


def add_ratios(devices):
    summaries = [device["summary"] for device in devices if device["summary"]]
    fastest = min((each["trace_ms"]["median"] for each in summaries), default=0)
    for each in summaries:
        each["ratio_to_fastest"] = rate(each["trace_ms"]["median"], fastest)


def trace_by_frame(device):
    """[(frame, median of the milliseconds of all runs)], in the order of the frames."""
    times = {}
    for frame in timed_frames(device):
        times.setdefault(frame["frame"], []).append(1e3 * frame["seconds"]["trace"])
    return [(number, median(times[number])) for number in sorted(times)]
