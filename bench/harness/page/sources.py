# SPDX-License-Identifier: MIT
"""The results that a page of bench/study shows together: this machine's and those of others."""
from dataclasses import dataclass

from harness.chart import gnuplot
from harness.chart.lines import Line
from harness.store.result import machine_words

NAME_LENGTH, MACHINE_LENGTH = 28, 24


@dataclass(frozen=True)
class Device:
    """One of one machine; `place` counts through all of them and gives the colour."""
    result: dict
    entry: dict
    place: int
    machine: int
    several: bool  # machines

    @property
    def label(self):
        return self.entry["label"]

    @property
    def machine_name(self):
        return gnuplot.plain(self.result["machine"]["name"], MACHINE_LENGTH)

    @property
    def short(self):
        return f"{self.label} ({self.machine_name})" if self.several else self.label

    @property
    def name(self):
        """Of the machine too, where there are several."""
        own = gnuplot.device_title(self.entry)
        return f"{gnuplot.plain(own, NAME_LENGTH)}, {self.machine_name}" if self.several else own

    def entries(self, part, **wanted):
        return of_part(self.result, part, device=self.label, **wanted)

    def line(self, part, name=None, points=None, **wanted):
        """Time against what the part varies."""
        points = points or sorted((each["x"], each["summary"]["trace_ms"]) for each in self.entries(part, **wanted))
        return Line(name or self.name, points, self.place, self.machine + 1, self.place, self.short)


def of_part(result, part, **wanted):
    """The measured entries."""
    return [entry for entry in result["measurements"] if entry["part"] == part and entry["summary"]
            and all(entry[key] == value for key, value in wanted.items())]


class Sources:
    """`results` are in the order of the page; this machine's, if any, comes first."""

    def __init__(self, results):
        self.results, self.devices = results, []
        for number, result in enumerate(results):
            for entry in result["devices"]:
                if entry["reason"] is None:
                    self.devices.append(Device(result, entry, len(self.devices), number, len(results) > 1))

    def about(self, scene):
        """What the head of a chart is made of."""
        machines = "; ".join(dict.fromkeys(self.machine_words(result) for result in self.results))
        versions = ", ".join(dict.fromkeys(result["hedron"]["version"] for result in self.results))
        return {"hedron": {"version": versions}, "scene": {"name": scene}, "machine": {"words": machines}}

    @staticmethod
    def machine_words(result):
        place = result["machine"]
        return (f"{place['name']}: " if place["name"] != place["cpu"] else "") + machine_words(result)

    def measured(self, part):
        return [entry for result in self.results for entry in of_part(result, part)]

    def with_part(self, part):
        """The devices that have measurements of it."""
        return [device for device in self.devices if device.entries(part)]
