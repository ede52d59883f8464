# SPDX-License-Identifier: MIT
"""The sections of bench/study's page whose charts are bars: one thing against another."""
from statistics import median

from harness import report, study_bounds, study_points, study_state
from harness.study_charts import Row, ms, rows, spread_words
from harness.study_points import ALL, ARITHMETIC, COLD, ONE_LANE, ONE_THREAD, PIPELINES, WARM, WHOLE_FRAME
from harness.study_section import few, middle, ratio, sentence, speed_words, table_of

REPORT = {"the report's CPU": 84.5e3, "the report's GTX 1050": 1.10e3}  # milliseconds of a frame of the same scene
REPORT_COLOUR = 6
PARTS_OF_A_RUN = ("program and device start", "kernels built", "scene and kernels to the device", "prepare", "trace",
                  "read back", "convert and encode PNG")
TOO_LITTLE = "Too little was measured to compare."


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
        plain = next((each for device, each in found
                      if each["series"] == ONE_LANE and each["device"] == base["device"]), None)
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
                    spread = found[name]["summary"]["trace_ms"]
                    drawn.append(Row(f"{device.short}, {scene}, {name}", spread, spread_words(spread), place,
                                     group=f"{device.place} {scene}"))
            if len(found) == len(PIPELINES):
                gains.append((middle(found["wavefront"]) / middle(found["mega"]),
                              middle(found["wavefront-uncompacted"]) / middle(found["wavefront"]),
                              f"{device.short}, {scene}"))
    caption = TOO_LITTLE
    if gains:
        best, compacted = min(gains), max(gains, key=lambda each: each[1])
        caption = (f"The wavefront does best on {best[2]}, where it takes {ratio(best[0])} the megakernel's time; "
                   f"closing up the live rays helps most on {compacted[2]}: without it the wavefront takes "
                   f"{ratio(compacted[1])} as long.")
    about = sources.about("built-in scene, 1280 x 720, and official example, 640 x 480, 2 x 2 samples")
    section.draw("pipelines", rows, about, "Megakernel and wavefront", caption,
                 "milliseconds for each frame", drawn)
    section.table = table_of(sources, "pipelines", lambda entry: f"{entry['series']}, {PIPELINES[int(entry['x'])]}",
                             "what")


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
    caption = sentence(few(told) + ", all against strict arithmetic in float.") if told else TOO_LITTLE
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
                drawn.append(Row(f"{device.short}, {name}", found[name], ms(found[name]["median"]), place,
                                 group=str(device.place)))
        if found:
            longest = max(found, key=lambda name: found[name]["median"])
            told.append(f"{longest} takes longest on {device.short}, {ms(found[longest]['median'])}")
    if not drawn:
        return
    section.draw("stages", rows, sources.about("one frame of the built-in scene to PNG, 640 x 360, 3 x 3 samples"),
                 "Start-up and stages of a run of one frame", sentence(few(told) + "."), "milliseconds", drawn)
    section.table = table_of(sources, "stages", lambda entry: entry["series"], "what")
