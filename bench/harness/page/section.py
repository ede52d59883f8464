# SPDX-License-Identifier: MIT
"""Parts of bench/study, and their sections of its page: what all machines measured of a part."""
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from harness.chart.axes import Axis, axis_number
from harness.chart.lines import Line, lines
from harness.chart.sheet import model, plain
from harness.measure.numbers import number, spread_text
from harness.store.result import machine_words

MOST_SENTENCES = 4
BACKENDS = {"c": "C", "cuda": "CUDA", "opencl": "OpenCL"}
TOO_LITTLE = "Too little was measured to compare."
MS = "milliseconds for each frame"
TIME_AXIS = Axis(MS, True)
WHOLE_FRAME = "one frame of the built-in scene, 1280 x 720, 2 x 2 samples"


@dataclass(frozen=True)
class Part:
    """A part: what a file of harness/measurements declares for bench/study. Either `add` puts points into the plan, or
    `measure` does something else and returns the reason if it did not."""
    place: int  # in the order of the parts
    title: str
    about: str  # purpose, in a sentence or two
    add: Callable = None
    scenes: Callable = None  # {name: file, or the reason why there is none} of its scenes
    measure: Callable = None
    fill: Callable = None  # fills its section, from the results
    failures: Callable = lambda result: []
    cells: Callable = None  # cells of a device in the page's first table (page/answer.py)
    answer: Callable = None  # sentences of HTML below that table, from the results
    lead: int = 9  # place among the answers at the top of the page; the others follow in their order


@dataclass(frozen=True)
class Device:
    """Device of a machine, and its results of a part; `place` counts the different devices and gives the colour."""
    result: dict
    entry: dict
    place: int
    part: str
    label: str
    name: str  # short, and different from all others
    machine: str  # name of its machine; empty if there is only one

    def entries(self, **wanted):
        """Returns the measured ones."""
        wanted.update(part=self.part, device=self.label)
        return [entry for entry in self.result["measurements"]
                if entry["summary"] and all(entry[key] == value for key, value in wanted.items())]

    def line(self, name=None, points=None, **wanted):
        """Returns a line of time against what the part varies."""
        points = points or sorted((each["x"], each["summary"]["trace_ms"]) for each in self.entries(**wanted))
        return Line(name or self.name, points, self.place, 1, self.place, self.name, self.machine)


def short_name(result, device):
    """Returns the model and the backend; of CPUs also the number of cores."""
    backend = "PoCL" if "Portable Computing Language" in device["driver"] else BACKENDS[device["backend"]]
    return f"{result['machine']['cores']}-core " * device["is_cpu"] + f"{model(device)} ({backend})"


def all_devices(results, part=""):
    """Returns all devices. `results` are in the order of the page; this machine's, if any, comes first."""
    runnable = [(result, entry) for result in results for entry in result["devices"] if entry["reason"] is None]
    names = [short_name(*each) for each in runnable]
    found, places = [], {}
    for (result, entry), name in zip(runnable, names):
        machine = plain(result["machine"]["name"])
        if names.count(name) > 1:
            name += f", {entry['label']}" + f" of {machine}" * (len(results) > 1)
        known = result["machine"]["cpu"], result["machine"]["cores"], entry["label"], entry["name"]
        place = places.setdefault(known, len(places))
        found.append(Device(result, entry, place, part, entry["label"], name + dagger(result),
                            (machine + dagger(result)) * (len(results) > 1)))
    return found


def dagger(result):
    """Returns the mark of figures by other kernels than this program's."""
    return "" if result.get("same_kernels", True) else " \u2020"


@dataclass
class Section:
    part: str
    title: str
    about: str  # purpose, in a sentence or two
    results: list
    devices: list = field(default_factory=list)  # machines that measured it
    charts: dict = field(default_factory=dict)  # (chart, caption) by their names
    table: list = field(default_factory=list)  # rows of cells, the first is the head
    notes: list = field(default_factory=list)
    remarks: list = field(default_factory=list)  # below the table
    shown: list = field(default_factory=list)  # (title, rows of cells) of tables that are not folded away
    pictures: list = field(default_factory=list)  # (title, words, PNG as base64)

    def __post_init__(self):
        self.devices = [device for device in all_devices(self.results, self.part) if device.entries()]

    def entries(self):
        return [entry for device in self.devices for entry in device.entries()]

    def draw(self, kind, scene, title, caption, *arguments, name=None, **named):
        """Draws a chart of this kind; its head names all machines."""
        machines = [(f"{result['machine']['name']}: " if result["machine"]["name"] != result["machine"]["cpu"] else "")
                    + machine_words(result) for result in self.results]
        about = {"hedron": {"version": ", ".join(dict.fromkeys(result["hedron"]["version"] for result in self.results))},
                 "scene": {"name": scene}, "machine": {"words": "; ".join(dict.fromkeys(machines))}}
        self.add(name or self.part, kind(about, title, caption, *arguments, **named), caption)

    def add(self, name, chart, caption):
        self.charts[f"study_{name}"] = chart, caption

    def tabulate(self, name, what="what"):
        """Makes the table, a row for each measurement."""
        self.table = [["device", "machine", what, "milliseconds [quartiles]", "times", "runs", "rejected", "options", "renderer"]]
        for device in self.devices:
            for entry in device.entries():
                each = entry["summary"]
                self.table.append([device.label, device.result["machine"]["name"], name(entry), spread_text(
                    each["trace_ms"], " .. ") + (" (disturbed)" if each["noisy"] else ""), str(entry["scale"]),
                    str(each["runs"]), str(each["rejected"]), " ".join(entry["options"]), entry["renderer"]])

    def sweep(self, title, x_axis, caption=None, *, scene=WHOLE_FRAME, points=lambda line: line, name=lambda x: f"{x:g}",
              bounds=None):
        """Draws a line for each device, and makes a table; `bounds` makes lower bounds from the lines."""
        drawn = [points(device.line()) for device in self.devices]
        words = caption(drawn) if caption else growth_words(drawn, x_axis.words)
        self.draw(lines, scene, title, words, replace(x_axis, ticks=ticks_of(drawn)),
                  TIME_AXIS, drawn, **(bounds(drawn) if bounds else {}))
        self.tabulate(lambda entry: name(entry["x"]), x_axis.words)

    def note_scales(self):
        entries = self.entries()
        for scale in sorted({entry["scale"] for entry in entries if entry["scale"] > 1}):
            devices = sorted({entry["device"] for entry in entries if entry["scale"] == scale})
            self.remarks.append(f"Times of {' and '.join(devices)} are those of a picture with 1/{scale} of the samples, "
                              f"times {scale}, if the figures say so.")


def sections(parts, results):
    """Returns a section for each part that a machine measured or has a reason not to."""
    found = []
    for name, part in parts.items():
        section = Section(name, part.title, part.about, results)
        for result in results:
            if result["left_out"].get(name):
                section.notes.append(("" if len(results) == 1 else f"{result['machine']['name']}: ") + result["left_out"][name])
        if part.fill and (part.measure or section.devices):
            part.fill(section)
            section.note_scales()
        if part.fill and (section.charts or section.notes or section.pictures):
            found.append(section)
    return sorted(found, key=lambda section: parts[section.part].lead)


# ---- common parts of sentences

def ratio(value):
    return f"{number(value, 3)} times"


def sentence(words):
    return words[:1].upper() + words[1:]


def speed_words(factor, than):
    return f"{ratio(factor)} as fast as {than}" if factor >= 1 else f"{ratio(1 / factor)} as slow as {than}"


def middle(entry):
    return entry["summary"]["trace_ms"]["median"]


def relative(entry, base):
    """Returns a spread, in times of the other's median."""
    return {key: value / middle(base) for key, value in entry["summary"]["trace_ms"].items()}


def ticks_of(drawn):
    return {axis_number(x): x for x in sorted({x for line in drawn for x, _ in line.points})}


def growth(line):
    """Returns (x, y) of both ends of a line."""
    (x, first), (last_x, last) = line.points[0], line.points[-1]
    return x, first["median"], last_x, last["median"]


def few(sentences):
    """Returns a sentence for each of the first few."""
    more = len(sentences) - MOST_SENTENCES
    return " ".join(f"{sentence(each)}." for each in sentences[:MOST_SENTENCES]) + (
        f" The figures below have {more} more." if more > 0 else "")


def range_words(pairs):
    """Returns the least and the most of [(value, name of device)]."""
    words = [f"{number(value, 3)} on {name}" for value, name in (min(pairs), max(pairs))]
    return " up to ".join(words[:len(pairs)])


def growth_words(drawn, what="", words=axis_number):
    """Returns how the lines grow from end to end."""
    grown = [(line, *growth(line)) for line in drawn if len(line.points) > 1]
    if not grown:
        return "There is one point only."
    _, x, _, last_x, _ = grown[0]
    factors = range_words([(last / first, line.short) for line, _, first, _, last in grown])
    ends = f"From {words(x)} to {words(last_x)} {what}".rstrip()
    return f"{ends} the time of a frame grows by a factor of {factors}."


def best_words(drawn, words=axis_number):
    """Returns the fastest point of each line, in sentences."""
    sentences = []
    for line in drawn:
        x, spread = min(line.points, key=lambda point: point[1]["median"])
        worst = max(each["median"] for _, each in line.points)
        sentences.append(f"{words(x)} is fastest on {line.short}: {ratio(worst / spread['median'])} as fast as the slowest")
    return few(sentences)


def proportional(drawn):
    """Returns bounds: half the time for twice as many, from the first point of each line."""
    ends = [(line, *growth(line)[:2]) for line in drawn if len(line.points) > 1]
    return {"bounds": [[(each, first * x / each) for each, _ in line.points] for line, x, first in ends],
            "bound_name": "bound: half the time for twice as many"}
