# SPDX-License-Identifier: MIT
"""Whether devices made the same pictures: a fast wrong frame is no result."""
from harness.summary import label


def are_strict(options):
    """Only strict arithmetic promises the same bytes."""
    pairs = zip([""] + options, options + [""])
    return not any(word == "--math=fast" or (before == "--math" and word == "fast") for before, word in pairs)


def difference(devices):
    """(frame, [[label, ...], ...]): the first frame with different pictures, and who made the same; or
    None. A device that makes two kinds of one frame stands in two groups."""
    makers = {}
    for device in devices:
        for run in device["runs"]:
            for frame in run["frames"]:
                groups = makers.setdefault(frame["frame"], {}).setdefault(frame["picture"], [])
                if label(device) not in groups:
                    groups.append(label(device))
    for number in sorted(makers):
        if len(makers[number]) > 1:
            return number, list(makers[number].values())
    return None


def compare(devices, options):
    """{"same": true, false, or null where nothing was compared; "devices": [label]; "sentence"}"""
    devices = [device for device in devices if device["strict"] and device["runs"]]
    names = [label(device) for device in devices]
    if not are_strict(options):
        return {"same": None, "devices": [], "sentence": "The pictures were not compared: --math fast promises "
                                                         "no equal bytes."}
    found = difference(devices)
    if found is not None:
        groups = " / ".join(", ".join(group) for group in found[1])
        return {"same": False, "devices": names,
                "sentence": f"THE PICTURES DIFFER, so these times are no result: frame {found[0]}, {groups}."}
    if len(names) < 2:
        return {"same": None, "devices": names, "sentence": "The pictures were not compared: fewer than two "
                                                            "strict devices made any."}
    return {"same": True, "devices": names, "sentence": f"The pictures of {', '.join(names)} are the same bytes."}
