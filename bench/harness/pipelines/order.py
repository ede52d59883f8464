# SPDX-License-Identifier: MIT
"""What it gives to sort a wavefront's queue: hedron_queue_order's figures, and their table and chart."""
from statistics import median

from harness.chart.rows import Row, one_value, rows
from harness.measure.numbers import number
from harness.run.program import run_tool

ORDERS = {"product": "product: item by item", "uncompacted": "with dead rays", "appended": "as they come",
          "segments": "passing, then mirrored", "touched": "sorted by object touched",
          "touched_face": "sorted by face touched", "met": "sorted by face to be met"}
PARTS = ("first", "trace", "key", "sort")
WORDS = dict(zip((*PARTS, "all"), ("level 0", "levels below", "finding keys", "sorting", "all of it")))


def run(program, *words):
    """Raises Problem with the reason where it cannot be."""
    return run_tool(program.beside("bench/hedron_queue_order"), *words).stdout


def measure(program, scenes, rounds, samples):
    return parse(run(program, "--rounds", rounds, "--samples", samples, *scenes))


def parse(text):
    """{"instruction_set", "lanes", "orders": [...]}: nanoseconds are the processor's, for each ray of all levels."""
    result, counts, times = {}, {}, {}
    for what, *words in map(str.split, text.splitlines()):
        key = tuple(words[:3])  # scene, batch, order
        if what == "build":
            result = {"instruction_set": words[0], "lanes": int(words[1])}
        elif what == "order":
            counts[key] = [int(word) for word in words[3:]]
        elif what == "time":
            times.setdefault(key, []).append([float(word) for word in words[3:]])
    result["orders"] = [entry(*key, counts, rounds) for key, rounds in times.items()]
    return result


def entry(scene, batch, order, counts, rounds):
    _, below, bundles, touched, met = counts[scene, batch, order]
    # No order changes how many rays there are; `product` does not count them.
    all_rays = sum(counts[scene, batch, "appended"][:2])
    each = [[1e9 * value / all_rays for value in times] for times in rounds]
    return {"scene": scene.removesuffix(".json"), "batch": int(batch), "order": order, "rays": all_rays,
            "ns_a_ray": {**{part: median(column) for part, column in zip(PARTS, zip(*each))}, "all": median(map(sum, each))},
            **{name: count / bundles if bundles else None for name, count in
               (("lanes_alive", below), ("touched_a_bundle", touched), ("met_a_bundle", met))}}


HEAD = ["scene", "order", "batch", "ns a ray", "levels below 0", "key", "sort", "lanes alive", "touched", "met"]


def cells(each):
    times = each["ns_a_ray"]
    return [each["scene"], ORDERS[each["order"]], str(each["batch"]),
            *(number(times[key], 3) if times[key] else "-" for key in ("all", "trace", "key", "sort")),
            *(number(each[key], 3) for key in ("lanes_alive", "touched_a_bundle", "met_a_bundle"))]


def chart(result):
    """The first scene."""
    found = result["queue_order"]
    scene = found["orders"][0]["scene"]
    shown = [each for each in found["orders"] if each["scene"] == scene]
    batch = max(each["batch"] for each in shown)
    times = {each["order"]: each["ns_a_ray"] for each in shown if each["batch"] == batch}
    below = {order: number(each["trace"], 3) for order, each in times.items()}
    cost = number(times["touched"]["key"] + times["touched"]["sort"], 3)
    caption = (f"One thread, {found['lanes']} lanes ({found['instruction_set']}), {scene}. With {batch} samples at once, "
               f"sorting by the object touched takes the levels below from {below['appended']} ns a ray to "
               f"{below['touched']} and costs {cost}; two segments take {below['segments']} and cost nothing. Medians of "
               "the processor's time; the product's own loop is timed as a whole.")
    drawn = []
    for each in shown:
        name = f"{each['batch']} samples, {ORDERS[each['order']]}"
        for place, (key, variant) in enumerate(WORDS.items()):
            ns = each["ns_a_ray"][key]
            if ns:
                drawn.append(Row(name, one_value(ns), f"{number(ns, 3)} ns" if key == "all" else "", place, variant=variant))
    return rows(result, "A wavefront's queue in several orders", caption, "nanoseconds for each ray", drawn)
