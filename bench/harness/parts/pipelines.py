# SPDX-License-Identifier: MIT
"""The megakernel and the wavefront."""
from harness.chart.bars import Row, rows, spread_words
from harness.measure.points import DEFAULT, OFFICIAL
from harness.page.part import Part
from harness.page.section import TOO_LITTLE, middle, ratio, table_of

PIPELINES = ("mega", "wavefront", "wavefront-uncompacted")


def add(points):
    for label, _, *own in points.each():
        for scene, (view, scale) in {DEFAULT: own, OFFICIAL: (("--samples", "2"), 1)}.items():
            for place, name in enumerate(PIPELINES):
                points.add(scene, place, label, scene, (*view, "--pipeline", name), scale=scale)


def gain_words(gains):
    if not gains:
        return TOO_LITTLE
    best, compacted = min(gains), max(gains, key=lambda each: each[1])
    return (f"The wavefront does best on {best[2]}, where it takes {ratio(best[0])} the megakernel's time; closing up the "
            f"live rays helps most on {compacted[2]}: without it the wavefront takes {ratio(compacted[1])} as long.")


def fill(sources, section):
    drawn, gains = [], []
    for device in sources.with_part("pipelines"):
        for scene in (DEFAULT, OFFICIAL):
            found = {PIPELINES[int(entry["x"])]: entry for entry in device.entries("pipelines", series=scene)}
            for place, name in enumerate(PIPELINES):
                if name in found:
                    spread = found[name]["summary"]["trace_ms"]
                    drawn.append(Row(f"{device.short}, {scene}, {name}", spread, spread_words(spread), place,
                                     group=f"{device.place} {scene}"))
            if len(found) == len(PIPELINES):
                mega, wavefront, uncompacted = (middle(found[name]) for name in PIPELINES)
                gains.append((wavefront / mega, uncompacted / wavefront, f"{device.short}, {scene}"))
    about = sources.about("built-in scene, 1280 x 720, and official example, 640 x 480, 2 x 2 samples")
    section.draw("pipelines", rows, about, "Megakernel and wavefront", gain_words(gains), "milliseconds for each frame", drawn)
    section.table = table_of(sources, "pipelines", lambda entry: f"{entry['series']}, {PIPELINES[int(entry['x'])]}", "what")


PART = Part(11, "Megakernel and wavefront", "--pipeline mega, wavefront, and wavefront-uncompacted, which keeps dead rays.",
            add, fill=fill)
