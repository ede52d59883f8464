# SPDX-License-Identifier: MIT
"""Renders a scene by Mitsuba 3, by the Python that has it: harness/rivals/mitsuba.py calls it.

Reads {"threads", "scene", "sampler", "spp", "seed", "file"} from standard input, where `scene` is a dictionary of plugins, with
{"colour": [...]} for a colour and {"look_at": {...}} for a transformation, and `sampler` the number of the sensor. Renders with few
samples to warm up, where kernels are compiled, and then what is asked for, which becomes the file; writes {"version", "cpu", "wall"},
the last two in seconds."""
import json
import sys
import time

import drjit as dr
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
WARM_UP = 16  # samples a pixel


class Whitted(mi.BSDF):
    """A face by hedron's model: it is lit by lights alone, and rays go on mirrored or straight through; light to what lies behind
    takes the colour."""

    def __init__(self, props):
        super().__init__(props)
        self.lit, self.mirror, self.through = [mi.Color3f(props[name]) for name in ("lit", "mirror", "through")]
        mirrored, passing = dr.max(self.mirror), dr.max(self.through)
        self.share = dr.select(mirrored + passing > 0, mirrored / (mirrored + passing), 1)  # of the rays that are mirrored
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [each | sides for each in (mi.BSDFFlags.DiffuseReflection, mi.BSDFFlags.DeltaReflection,
                                                       mi.BSDFFlags.DeltaTransmission)]
        self.m_flags = self.m_components[0] | self.m_components[1] | self.m_components[2]

    def sample(self, _context, si, sample, _sample2, active=True):
        """One of the rays that go on."""
        is_mirrored, found = sample < self.share, mi.BSDFSample3f()
        found.wo = dr.select(is_mirrored, mi.reflect(si.wi), -si.wi)
        found.pdf = dr.select(is_mirrored, self.share, 1 - self.share)
        found.eta = 1
        found.sampled_component = dr.select(is_mirrored, mi.UInt32(1), mi.UInt32(2))
        found.sampled_type = dr.select(is_mirrored, mi.UInt32(+mi.BSDFFlags.DeltaReflection),
                                       mi.UInt32(+mi.BSDFFlags.DeltaTransmission))
        return found, dr.select(is_mirrored, self.mirror, self.through) / found.pdf & (active & (found.pdf > 0))

    def eval(self, _context, si, wo, active=True):
        """Of light that comes straight from a light."""
        facing = mi.Frame3f.cos_theta(wo)
        return self.lit * dr.inv_pi * dr.abs(facing) & (active & (mi.Frame3f.cos_theta(si.wi) * facing > 0))

    def pdf(self, _context, _si, _wo, _active=True):
        """No ray goes on because of it."""
        return mi.Float(0)

    def eval_pdf(self, context, si, wo, active=True):
        """Both."""
        return self.eval(context, si, wo, active), mi.Float(0)

    def eval_null_transmission(self, _si, active=True):
        """Of light on its way to something else."""
        return self.through & active


def unpacked(value):
    """With Mitsuba's own types."""
    if not isinstance(value, dict):
        return value
    if "colour" in value:
        return mi.ScalarColor3f(value["colour"])
    if "look_at" in value:
        return mi.ScalarTransform4f().look_at(**value["look_at"])
    return {key: unpacked(each) for key, each in value.items()}


def rendered(scene, asked, spp, seed):
    """The picture, and what it took."""
    begin, worked = time.monotonic(), time.process_time()
    picture = mi.render(scene, sensor=scene.sensors()[asked["sampler"]], spp=spp, seed=seed)
    dr.eval(picture)
    dr.sync_thread()
    return picture, {"cpu": time.process_time() - worked, "wall": time.monotonic() - begin}


def main():
    """Everything that standard input asks for."""
    asked = json.load(sys.stdin)
    mi.register_bsdf("whitted", Whitted)
    dr.set_thread_count(asked["threads"])
    scene = mi.load_dict(unpacked(asked["scene"]))
    rendered(scene, asked, min(asked["spp"], WARM_UP), 0)
    picture, took = rendered(scene, asked, asked["spp"], asked["seed"])
    mi.Bitmap(picture).write(asked["file"])
    print(json.dumps({"version": mi.__version__, **took}))


if __name__ == "__main__":
    main()
