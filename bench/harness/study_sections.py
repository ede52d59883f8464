# SPDX-License-Identifier: MIT
"""The sections of bench/study's page: for each part its charts, with a sentence made from the data."""
from dataclasses import dataclass, field
from statistics import median

from harness import report, study_bounds, study_points, study_state, triangle_models
from harness.study_charts import Axis, Line, Row, is_wide, lines, ms, number, rows, spread_words
from harness.study_points import ALL, ARITHMETIC, COLD, ONE_LANE, ONE_THREAD, PIPELINES, WARM, WHOLE_FRAME

REPORT = {"the report's CPU": 84.5e3, "the report's GTX 1050": 1.10e3}  # milliseconds of a frame of the same scene
REPORT_COLOUR = 6
MOST_CLAUSES = 4
PARTS_OF_A_RUN = ("program and device start", "kernels built", "scene and kernels to the device", "prepare", "trace",
                  "read back", "convert and encode PNG")


@dataclass
class Section:
    part: str
    title: str
    about: str  # what was measured, in a sentence or two
    charts: dict = field(default_factory=dict)  # name: (height, commands)
    captions: dict = field(default_factory=dict)
    table: list = field(default_factory=list)  # rows of cells, the first is the head
    notes: list = field(default_factory=list)

    def draw(self, name, kind, about, title, caption, *arguments, **named):
        self.charts[f"study_{name}"] = kind(about, title, caption, *arguments, **named)
        self.captions[f"study_{name}"] = caption


def ratio(value):
    return f"{report.number(value, 3)} times"


def sentence(words):
    return words[:1].upper() + words[1:]


def speed_words(factor, than):
    return f"{ratio(factor)} as fast as {than}" if factor >= 1 else f"{ratio(1 / factor)} as slow as {than}"


def middle(entry):
    return entry["summary"]["trace_ms"]["median"]


def y_axis(drawn, words="milliseconds for each frame"):
    return Axis(words, is_wide([spread["median"] for line in drawn for _, spread in line.points]))


def growth(line):
    """(x, y) of both ends of a line."""
    (x, first), (last_x, last) = line.points[0], line.points[-1]
    return x, first["median"], last_x, last["median"]


def few(told):
    """As many clauses as a sentence can have."""
    more = len(told) - MOST_CLAUSES
    return "; ".join(told[:MOST_CLAUSES]) + (f"; and {more} more in the figures below" if more > 0 else "")


def growth_words(drawn, what, words=number):
    """How each line grows from end to end."""
    told = []
    for line in drawn:
        if len(line.points) > 1:
            x, first, last_x, last = growth(line)
            told.append(f"{ratio(last / first)} as long on {line.short}" if told else
                        f"From {words(x)} to {words(last_x)} {what} a frame takes {ratio(last / first)} as long on {line.short}")
    return few(told) + "." if told else "There is one point only."


def best_words(drawn, words=number):
    """The fastest point of each line."""
    told = []
    for line in drawn:
        x, spread = min(line.points, key=lambda point: point[1]["median"])
        worst = max(each["median"] for _, each in line.points)
        told.append(f"{words(x)} on {line.short} (the slowest takes {ratio(worst / spread['median'])} as long)")
    return few(told)


def table_of(sources, part, name, what):
    """A row for each measurement."""
    found = [["device", "machine", what, "milliseconds [quartiles]", "times", "runs", "rejected", "options", "renderer"]]
    for device in sources.with_part(part):
        for entry in device.entries(part):
            each = entry["summary"]
            disturbed = " (disturbed)" if each["noisy"] else ""
            found.append([device.label, device.result["machine"]["name"], name(entry),
                          f"{report.number(each['trace_ms']['median'])} [{report.number(each['trace_ms']['q1'])} .. "
                          f"{report.number(each['trace_ms']['q3'])}]{disturbed}", str(entry["scale"]), str(each["runs"]),
                          str(each["rejected"]), " ".join(entry["options"]), entry["renderer"]])
    return found


def scaled_note(entries):
    scales = sorted({entry["scale"] for entry in entries if entry["scale"] > 1})
    return [f"Some times are those of a picture with 1/{scale} of the samples, times {scale}, as the figures tell." for scale in scales]


# ---- the parts

def official(sources, section):
    devices = sorted(sources.with_part("official"), key=lambda device: official_spread(device)["median"])
    drawn = [Row(name, {key: value for key in ("median", "q1", "q3")}, ms(value), REPORT_COLOUR, group="report")
             for name, value in REPORT.items()]
    drawn += [Row(device.name, official_spread(device), spread_words(official_spread(device)), device.place,
                  bound_of(device, device.entries("official")[0])) for device in devices]
    fastest = official_spread(devices[0])["median"]
    cpu, gpu = REPORT
    caption = (f"{devices[0].short} takes {ms(fastest)} for a frame, {speed_words(REPORT[cpu] / fastest, cpu)} and "
               f"{speed_words(REPORT[gpu] / fastest, gpu)}")
    if len(devices) > 1:
        slowest = official_spread(devices[-1])["median"]
        caption += (f"; {devices[-1].short}, the slowest, takes {ms(slowest)}, {speed_words(REPORT[cpu] / slowest, cpu)}")
    section.draw("official", rows, sources.about("official example, 640 x 480, 16 x 16 samples, depth 10"),
                 "Mean time of a frame", caption + ".", "milliseconds for each frame", drawn, study_bounds.NAME)
    section.table = table_of(sources, "official", lambda entry: f"frames {entry['frames']}", "what")


def bound_of(device, entry):
    return study_bounds.milliseconds(device.result, device.entry, entry)


def official_spread(device):
    return device.entries("official")[0]["summary"]["frame_ms"]


def by_frame(entry):
    """[(frame, spread)]"""
    times = {}
    for run in study_state.chosen_runs(entry):
        for frame in study_state.counted(run):
            times.setdefault(frame["frame"], []).append(1e3 * entry["scale"] * frame["seconds"]["trace"])
    return [(frame, study_state.spread(values)) for frame, values in sorted(times.items())]


def animation(sources, section):
    drawn = [Line(device.name, by_frame(device.entries("animation")[0]), device.place, device.machine + 1, device.place,
                  device.short) for device in sources.with_part("animation")]
    times = [[spread["median"] for _, spread in line.points] for line in drawn]
    most = max(range(len(drawn)), key=lambda place: max(times[place]) / min(times[place]))
    slowest = max(drawn[most].points, key=lambda point: point[1]["median"])
    caption = (f"The slowest frame ({slowest[0]}) takes {ratio(max(times[most]) / min(times[most]))} as long as the fastest on "
               f"{drawn[most].short}, where that differs most.")
    section.draw("animation", lines, sources.about(WHOLE_FRAME), "Time of tracing along the animation", caption,
                 Axis("frame number"), y_axis(drawn), drawn)
    section.table = table_of(sources, "animation", lambda entry: f"frames {entry['frames']}", "what")


def blocks(sources, section):
    for series, what in (("block", "threads of a work group"), ("grid", "work groups of a launch, at most")):
        drawn = [device.line("blocks", series=series) for device in sources.with_part("blocks")
                 if device.entries("blocks", series=series)]
        if not drawn:
            continue
        section.draw(f"blocks_{series}", lines, sources.about(WHOLE_FRAME), f"Time against {what}",
                     f"The fastest: {best_words(drawn)}.",
                     Axis(what, True, {number(x): x for line in drawn for x, _ in line.points}), y_axis(drawn), drawn)
    section.table = table_of(sources, "blocks", lambda entry: f"--{entry['series']} {entry['x']:g}", "option")


def crossing_words(device):
    trees = {x: spread["median"] for x, spread in device.line("triangles", series="bvh").points}
    brute = device.line("triangles", series="brute").points
    slower = [x for x, spread in brute if x in trees and spread["median"] > trees[x]]
    where = f"from {triangle_models.words(int(min(slower)))} triangles on" if slower else "nowhere that was measured"
    return f"on {device.short} {where}"


def triangles(sources, section):
    drawn, trees = [], []
    for device in sources.with_part("triangles"):
        if not device.entries("triangles", series="bvh"):
            continue
        trees.append(device.line("triangles", f"{device.short}, hierarchy", series="bvh"))
        brute = device.line("triangles", f"{device.short}, each triangle tried", series="brute")
        drawn += [trees[-1], Line(brute.name, brute.points, brute.colour, 4, brute.mark, brute.short)]
    counts = {triangle_models.words(10 ** power): 10 ** power for power in range(1, 8)}
    caption = growth_words(trees, "triangles", lambda x: triangle_models.words(int(x)))
    caption += " The hierarchy is the faster one " + few(list(map(crossing_words, sources.with_part("triangles")))) + "."
    if not trees:
        return
    section.draw("triangles", lines, sources.about("mirrored, transparent sphere with bumps, 1280 x 960, 2 x 2 samples"),
                 "Time against the number of triangles", caption, Axis("triangles", True, counts),
                 Axis("milliseconds for each frame", True), drawn)
    section.table = table_of(sources, "triangles", lambda entry: f"{entry['x']:g}, {entry['series']}", "triangles")


def sweep(sources, section, part, title, x_axis, scene=WHOLE_FRAME, what=None, **named):
    """A line for each device."""
    drawn = [device.line(part) for device in sources.with_part(part)]
    logarithmic = Axis("milliseconds for each frame", x_axis.logarithmic) if x_axis.logarithmic else y_axis(drawn)
    section.draw(part, lines, sources.about(scene), title, growth_words(drawn, what or x_axis.words), x_axis,
                 logarithmic, drawn, **named)
    section.table = table_of(sources, part, lambda entry: f"{entry['x']:g}", x_axis.words)


def ticks_of(sources, part):
    return {number(x): x for x in sorted({entry["x"] for entry in sources.measured(part)})}


def lights(sources, section):
    sweep(sources, section, "lights", "Time against the number of lights",
          Axis("point lights", True, ticks_of(sources, "lights")),
          "default scene under point lights, 1280 x 720, 2 x 2 samples")


def samples(sources, section):
    def squared(line):
        return Line(line.name, [(x * x, spread) for x, spread in line.points], line.colour, line.dash, line.mark, line.short)
    drawn = [squared(device.line("samples")) for device in sources.with_part("samples")]
    base = min(drawn, key=lambda line: line.points[0][1]["median"])
    x, first = base.points[0][0], base.points[0][1]["median"]
    last = max(x for line in drawn for x, _ in line.points)
    section.draw("samples", lines, sources.about("one frame of the built-in scene, 1280 x 720"), "Time against samples per pixel",
                 growth_words(drawn, "samples per pixel"),
                 Axis("samples per pixel", True, {number(x * x): x * x for x in sorted({entry['x'] for entry in sources.measured('samples')})}),
                 Axis("milliseconds for each frame", True), drawn,
                 bounds=[[(x, first), (last, first * last / x)]] if last > x else (), bound_name="in proportion to the samples")
    section.table = table_of(sources, "samples", lambda entry: f"{entry['x'] ** 2:g}", "samples per pixel")


def depth(sources, section):
    sweep(sources, section, "depth", "Time against depth", Axis("mirrorings and passings of a ray, at most", False, ticks_of(sources, "depth")),
          what="in depth")


def ideal(drawn):
    """As if twice as many took half as long, from the first point of each line."""
    bounds = []
    for line in drawn:
        x, first = line.points[0][0], line.points[0][1]["median"]
        bounds.append([(each, first * x / each) for each, _ in line.points])
    return [bound for bound in bounds if len(bound) > 1]


def sets_words(sources):
    found = {}
    for entry in sources.measured("lanes"):
        for name in ("avx512", "avx2", "generic"):
            if entry["renderer"] and f" {name}" in entry["renderer"]:
                found.setdefault(name, set()).add(int(entry["x"]))
    told = [f"{', '.join(map(str, sorted(each)))} by {name}" for name, each in found.items()]
    words = "Which instruction set runs is no choice of the user's: hedron takes the best build that the CPU has for so many lanes"
    return f"{words} (here {'; '.join(told)})." if told else f"{words}."


def lanes(sources, section):
    drawn = [device.line("lanes") for device in sources.with_part("lanes")]
    section.draw("lanes", lines, sources.about(WHOLE_FRAME), "Time against rays traced together",
                 f"The fastest: {best_words(drawn, lambda x: f'{x:g} lanes')}.",
                 Axis("lanes", True, ticks_of(sources, "lanes")), Axis("milliseconds for each frame", True), drawn,
                 bounds=ideal(drawn), bound_name="bound: in proportion to one")
    section.notes.append(sets_words(sources))
    section.table = table_of(sources, "lanes", lambda entry: f"{entry['x']:g}", "lanes")


def threads_words(line):
    x, first, last_x, last = growth(line)
    if last_x == x:
        return f"{line.short} has one core"
    return f"{last_x:g} threads are {speed_words(first / last, f'{x:g}')} on {line.short}"


def threads(sources, section):
    drawn = [device.line("threads") for device in sources.with_part("threads")]
    told = [threads_words(line) for line in drawn]
    section.draw("threads", lines, sources.about(WHOLE_FRAME), "Time against threads of the C backend",
                 few(told) + ".",
                 Axis("threads", True, ticks_of(sources, "threads")), Axis("milliseconds for each frame", True), drawn,
                 bounds=ideal(drawn), bound_name="bound: in proportion to one")
    section.table = table_of(sources, "threads", lambda entry: f"{entry['x']:g}", "threads")


def one_thread(sources, section):
    found = [(device, entry) for device in sources.with_part("one_thread") for entry in device.entries("one_thread")]
    found.sort(key=lambda pair: -middle(pair[1]))
    base = next((entry for _, entry in found if entry["series"] == ONE_THREAD), None)
    drawn = []
    for device, entry in found:
        against = f", {report.number(middle(base) / middle(entry), 3)} x" if base else ""
        bound = bound_of(device, entry) if entry["series"] == ALL else None
        drawn.append(Row(f"{device.short}, {entry['series']}" if entry["series"] != ALL else device.name,
                         entry["summary"]["trace_ms"], ms(middle(entry)) + against, device.place, bound))
    fastest, entry = found[-1]
    caption = f"{fastest.short} traces a frame in {ms(middle(entry))}"
    if base:
        caption += f", {speed_words(middle(base) / middle(entry), 'one thread of the C backend')}"
        plain = next((each for device, each in found if each["series"] == ONE_LANE and each["device"] == base["device"]), None)
        if plain:
            caption += f", which is {speed_words(middle(plain) / middle(base), 'one thread that traces ray by ray')}"
    section.draw("one_thread", rows, sources.about("official example, 640 x 480, 4 x 4 samples, depth 10"),
                 "One thread against everything else", caption + ". The factors at the bars are against one thread.",
                 "milliseconds for each frame", drawn, study_bounds.NAME)
    section.table = table_of(sources, "one_thread", lambda entry: entry["series"], "what")


def pipelines(sources, section):
    drawn, gains = [], []
    for device in sources.with_part("pipelines"):
        for scene in (study_points.DEFAULT, study_points.OFFICIAL):
            found = {PIPELINES[int(entry["x"])]: entry for entry in device.entries("pipelines", series=scene)}
            for place, name in enumerate(PIPELINES):
                if name in found:
                    drawn.append(Row(f"{device.short}, {scene}, {name}", found[name]["summary"]["trace_ms"],
                                     spread_words(found[name]["summary"]["trace_ms"]), place, group=f"{device.place} {scene}"))
            if len(found) == len(PIPELINES):
                gains.append((middle(found["wavefront"]) / middle(found["mega"]),
                              middle(found["wavefront-uncompacted"]) / middle(found["wavefront"]), f"{device.short}, {scene}"))
    caption = "Too little was measured to compare."
    if gains:
        best, compacted = min(gains), max(gains, key=lambda each: each[1])
        caption = (f"The wavefront does best on {best[2]}, where it takes {ratio(best[0])} the megakernel's time; closing up the "
                   f"live rays helps most on {compacted[2]}: without it the wavefront takes {ratio(compacted[1])} as long.")
    section.draw("pipelines", rows, sources.about("built-in scene, 1280 x 720, and official example, 640 x 480, 2 x 2 samples"), "Megakernel and wavefront", caption,
                 "milliseconds for each frame", drawn)
    section.table = table_of(sources, "pipelines", lambda entry: f"{entry['series']}, {PIPELINES[int(entry['x'])]}", "what")


def arithmetic(sources, section):
    drawn, told = [], []
    for device in sources.with_part("arithmetic"):
        found = {ARITHMETIC[int(entry["x"])]: entry for entry in device.entries("arithmetic")}
        for kind, entry in found.items():
            drawn.append(Row(f"{device.short}, {kind[0]}, {kind[1]}", entry["summary"]["trace_ms"],
                             spread_words(entry["summary"]["trace_ms"]), ARITHMETIC.index(kind), group=str(device.place)))
        base = found.get(("float", "strict"))
        others = [f"{words} takes {ratio(middle(found[kind]) / middle(base))} as long" for kind, words in
                  ((("float", "fast"), "fast arithmetic"), (("double", "strict"), "double")) if base and kind in found]
        if others:
            told.append(f"on {device.short} {' and '.join(others)}")
    caption = sentence(few(told) + ", all against strict arithmetic in float.") if told else "Too little was measured to compare."
    section.draw("arithmetic", rows, sources.about(WHOLE_FRAME), "Strict and fast, float and double", caption,
                 "milliseconds for each frame", drawn)
    section.table = table_of(sources, "arithmetic", lambda entry: ", ".join(ARITHMETIC[int(entry["x"])]), "what")


def stage_seconds(run):
    """Seconds of the parts of a run of one frame, without the building of kernels."""
    frame = run["frames"][0]
    seconds, began = frame["seconds"], frame["began"]
    end = max(began[stage] + seconds[stage] for stage in began if began[stage] is not None)
    return {"program and device start": max(0.0, run["wall"] - end),
            "scene and kernels to the device": min(value for value in began.values() if value is not None),
            "prepare": seconds["prepare"], "trace": seconds["trace"], "read back": seconds["copy"],
            "convert and encode PNG": seconds["convert"] + seconds["store"]}


def stage_spreads(device):
    """{part of a run: spread in milliseconds}"""
    warm, cold = [device.entries("stages", series=series) for series in (WARM, COLD)]
    found = {}
    if warm:
        each = [stage_seconds(run) for run in study_state.chosen_runs(warm[0])]
        found = {name: study_state.spread([1e3 * seconds[name] for seconds in each]) for name in each[0]}
    if warm and cold:
        usual = median(run["wall"] for run in study_state.chosen_runs(warm[0]))
        built = [max(0.0, 1e3 * (run["wall"] - usual)) for run in study_state.chosen_runs(cold[0])]
        found["kernels built"] = study_state.spread(built)
    return found


def stages(sources, section):
    drawn, told = [], []
    for device in sources.with_part("stages"):
        found = stage_spreads(device)
        for place, name in enumerate(PARTS_OF_A_RUN):
            if name in found:
                drawn.append(Row(f"{device.short}, {name}", found[name], ms(found[name]["median"]), place, group=str(device.place)))
        if found:
            longest = max(found, key=lambda name: found[name]["median"])
            told.append(f"{longest} takes longest on {device.short}, {ms(found[longest]['median'])}")
    if not drawn:
        return
    section.draw("stages", rows, sources.about("one frame of the built-in scene to PNG, 640 x 360, 3 x 3 samples"),
                 "Start-up and stages of a run of one frame", sentence(few(told) + "."), "milliseconds", drawn)
    section.table = table_of(sources, "stages", lambda entry: entry["series"], "what")


SECTIONS = {
    "official": (official, "Mean time of a frame",
                 "The official example beside the figures of the report that it comes from. A frame is prepared, traced and copied."),
    "animation": (animation, "Along the animation", "The built-in scene's tracing, frame by frame."),
    "blocks": (blocks, "Block and grid sizes", "--block and --grid of GPUs, each with the other as hedron chooses it."),
    "triangles": (triangles, "Number of triangles", "A sphere of so many triangles, searched by a hierarchy (--accel bvh) and one by one "
                  "(--accel brute)."),
    "lights": (lights, "Number of lights", "The default scene under so many point lights, each with shadows."),
    "samples": (samples, "Samples per pixel", "The grid of --samples N has N x N."),
    "depth": (depth, "Depth", "--depth, with the scene's own cut-off."),
    "lanes": (lanes, "Lanes and instruction sets", "--lanes of the CPUs."),
    "threads": (threads, "Threads", "--threads of the C backend."),
    "one_thread": (one_thread, "One thread against everything else", "The same picture by one thread of the C backend, ray by ray and with "
                   "lanes, and by every device with all it has."),
    "pipelines": (pipelines, "Megakernel and wavefront", "--pipeline mega, wavefront, and wavefront-uncompacted, which keeps dead rays."),
    "arithmetic": (arithmetic, "Arithmetic", "--math strict and fast, --precision float and double."),
    "stages": (stages, "Start-up and stages", "Whole runs of one frame. What a run takes longer with empty caches is the building of kernels; "
               "those of the C backend are compiled ahead."),
}


def measured_sections(sources):
    """One for each part that anybody measured or that has a reason why not."""
    found = []
    for part, (fill, title, about) in SECTIONS.items():
        section = Section(part, title, about)
        for result in sources.results:
            reason = result["left_out"].get(part)
            if reason:
                section.notes.append(reason if len(sources.results) == 1 else f"{result['machine']['name']}: {reason}")
        if sources.measured(part):
            fill(sources, section)
            section.notes += scaled_note(sources.measured(part))
        if section.charts or section.notes:
            found.append(section)
    return found
