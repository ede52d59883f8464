# SPDX-License-Identifier: MIT
"""The sections of bench/study's page: for each part its charts, with a sentence made from the data."""
from harness import study_sweeps as sweeps
from harness import study_versus as versus
from harness.study_section import Section, scaled_note

SECTIONS = {
    "official": (
        versus.official, "Mean time of a frame",
        "The official example beside the figures of the report that it comes from. A frame is prepared, "
        "traced and copied."),
    "animation": (
        sweeps.animation, "Along the animation",
        "The built-in scene's tracing, frame by frame."),
    "blocks": (
        sweeps.blocks, "Block and grid sizes",
        "--block and --grid of GPUs, each with the other as hedron chooses it."),
    "triangles": (
        sweeps.triangles, "Number of triangles",
        "A sphere of so many triangles, searched by a hierarchy (--accel bvh) and one by one (--accel brute)."),
    "lights": (
        sweeps.lights, "Number of lights",
        "The default scene under so many point lights, each with shadows."),
    "samples": (
        sweeps.samples, "Samples per pixel",
        "The grid of --samples N has N x N."),
    "depth": (
        sweeps.depth, "Depth",
        "--depth, with the scene's own cut-off."),
    "lanes": (
        sweeps.lanes, "Lanes and instruction sets",
        "--lanes of the CPUs."),
    "threads": (
        sweeps.threads, "Threads",
        "--threads of the C backend."),
    "one_thread": (
        versus.one_thread, "One thread against everything else",
        "The same picture by one thread of the C backend, ray by ray and with lanes, and by every device with"
        " all it has."),
    "pipelines": (
        versus.pipelines, "Megakernel and wavefront",
        "--pipeline mega, wavefront, and wavefront-uncompacted, which keeps dead rays."),
    "arithmetic": (
        versus.arithmetic, "Arithmetic",
        "--math strict and fast, --precision float and double."),
    "stages": (
        versus.stages, "Start-up and stages",
        "Whole runs of one frame. What a run takes longer with empty caches is the building of kernels; those"
        " of the C backend are compiled ahead."),
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
