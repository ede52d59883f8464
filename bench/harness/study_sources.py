# SPDX-License-Identifier: MIT
"""The results that a page of bench/study shows together: this machine's and those of others."""
from dataclasses import dataclass

from harness import charts, study_state
from harness.study_charts import Line

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
        return charts.plain(self.result["machine"]["name"], MACHINE_LENGTH)

    @property
    def short(self):
        return f"{self.label} ({self.machine_name})" if self.several else self.label

    @property
    def name(self):
        """Of the machine too, where there are several."""
        own = f"{self.label} {charts.device_name(self.entry)}"
        return f"{charts.plain(own, NAME_LENGTH)}, {self.machine_name}" if self.several else own

    def entries(self, part, **wanted):
        return study_state.of_part(self.result, part, device=self.label, **wanted)

    def line(self, part, name=None, scale_x=1, **wanted):
        """Time against what the part varies."""
        points = sorted((each["x"] * scale_x, each["summary"]["trace_ms"]) for each in self.entries(part, **wanted))
        return Line(name or self.name, points, self.place, self.machine + 1, self.place, self.short)


class Sources:
    """`results` are in the order of the page; this machine's, if any, comes first."""

    def __init__(self, results):
        self.results = results
        several, place, self.devices = len(results) > 1, 0, []
        for number, result in enumerate(results):
            for entry in result["devices"]:
                if entry["reason"] is None:
                    self.devices.append(Device(result, entry, place, number, several))
                    place += 1

    def about(self, scene):
        """What the head of a chart is made of."""
        machines = "; ".join(dict.fromkeys(self.machine_words(result) for result in self.results))
        versions = ", ".join(dict.fromkeys(result["hedron"]["version"] for result in self.results))
        return {"hedron": {"version": versions}, "scene": {"name": scene, "width": None}, "machine": {"words": machines}}

    @staticmethod
    def machine_words(result):
        place = result["machine"]
        name = f"{place['name']}: " if place["name"] != place["cpu"] else ""
        return f"{name}{place['cpu']}, {place['cores']} {'core' if place['cores'] == 1 else 'cores'}"

    def measured(self, part):
        return [entry for result in self.results for entry in study_state.of_part(result, part)]

    def with_part(self, part):
        """The devices that have measurements of it."""
        return [device for device in self.devices if device.entries(part)]
