# SPDX-License-Identifier: MIT
"""What bench/study times: points of charts, each of which is one job of hedron on one device."""
from harness.measure.jobs import job

DEFAULT, OFFICIAL = "default", "official"
# A GPU's frame of the CPUs' size is too short to be timed; times of CPUs are multiplied by what they do less.
VIEWS = {True: (("--size", "320x180", "--samples", "2"), 16), False: (("--size", "1280x720", "--samples", "2"), 1)}
WHOLE_FRAME = "one frame of the built-in scene, 1280 x 720, 2 x 2 samples"


class Points:
    """`devices` are those that can run, by their labels. `scenes` has the files of all scenes, or the reason why one could
    not be made."""

    def __init__(self, devices, quick, cores, extra, scenes):
        self.devices, self.quick, self.cores, self.extra, self.scenes = devices, quick, cores, extra, scenes
        self.part = None  # which adds its points now
        self.left_out = {}  # part: why there is nothing, or not all
        self.found = []

    def add(self, series, x, device, scene, options, *, frames=None, **named):
        if isinstance(self.scenes[scene], str):
            self.left_out[self.part] = self.scenes[scene]
            return
        self.found.append(job(device, scene, frames or ("0-2" if self.quick else "0-3"), (*options, *self.extra),
                              part=self.part, series=series, x=x, **named))

    def each(self, views=None):
        """(label, device, options of its view, what times are multiplied by)"""
        return [(label, device, *(views or VIEWS)[device["is_cpu"]]) for label, device in self.devices.items()]

    def sweep(self, option, values, wanted=lambda device: True, views=None, series="", none=None):
        """Of one option, on the devices that are wanted; `none` says that there is no such device."""
        if not any(map(wanted, self.devices.values())):
            self.left_out[self.part] = none
        for label, device, view, scale in self.each(views):
            for value in values if wanted(device) else ():
                self.add(series, value, label, DEFAULT, (*view, option, str(value)), scale=scale)
