"""Every system at work in a minute: added, looked at on three frames in two orders, baked and back, saved, opened, and removed.

`./motus test` runs this file alone in the Blenders that the whole suite does not run in.
"""

import bpy
import numpy as np

import support
from saved import make, saved_cases as cases

FRAMES = (21, 5, 37)
"""In an order that no playback has; a bake of every 16th frame has keys on them."""
BAKED = {
    "path": ("Eased", "Keyed"),
    "layers": ("Puppet",),
    "walker": ("Robot",),
    "ik": ("Rig",),
    "look_at": ("Figure",),
    "dynamics": ("Ribbon", "Parcel", "Rope"),
    "pull": (),
    "lattice": (),
    "pendulum": ("Hook", "Crane"),
    "snow": (),
    "snow_cover": (),
    "stereo": ("Eyes",),
    "chroma": (),
    "drivers": (),
}
"""Each system and lying snow, and which owners of its scene are baked: pins, flakes, a lattice, the nodes of a key and drivers are not."""


def left():
    """What of Motus there is in the file: helpers, results in custom properties, what reads them, lattices, and a key's nodes."""
    blocks = [block for kind in ("objects", "meshes", "node_groups", "materials") for block in getattr(bpy.data, kind)]
    found = [block.name for block in blocks if "Motus" in block.name]
    for obj in bpy.data.objects:
        found += [f"{obj.name}: {key}" for key in obj.keys() if key.startswith("motus_")]
        for animation in [block.animation_data for block in (obj, obj.data) if block and block.animation_data]:
            # In the scene of paths a driver of the artist's reads a follower.
            found += [f"{obj.name}: {curve.driver.expression}" for curve in animation.drivers if obj.name != "Gauge"]
        found += [f"{obj.name}: {one.name}" for owner in (obj, *(obj.pose.bones if obj.pose else ())) for one in owner.constraints]
        found += [f"{obj.name}: {one.name}" for one in obj.modifiers]
    return found + [node.name for node in support.addon("chroma.compositor").keys_of(bpy.context.scene)]


class Smoke(support.SceneTestCase):
    def numbers(self, frames=FRAMES):
        return {frame: cases.numbers(frame) for frame in frames}

    def assert_near(self, found, wanted, tolerance):
        for frame, numbers in wanted.items():
            self.assertEqual(sorted(found[frame]), sorted(numbers))
            for what, row in numbers.items():
                off = np.abs(np.subtract(found[frame][what], row)) / np.maximum(np.abs(row), 1.0)
                self.assertLess(float(off.max()), tolerance, (frame, what))

    def run_through(self, name):
        getattr(make, name)()
        live = self.numbers()
        if name != "chroma":  # whose picture stands still
            self.assertNotEqual(live[5], live[37])
        self.assertEqual(self.numbers(reversed(FRAMES)), live)
        path = self.save()
        for owner in BAKED[name]:
            self.assertEqual(bpy.ops.motus.bake(object=owner, frame_start=5, frame_end=37, step=16), {'FINISHED'})
        self.assert_near(self.numbers(), live, 1e-5)
        for owner in BAKED[name]:
            self.assertEqual(bpy.ops.motus.unbake(object=owner), {'FINISHED'})
        self.assertEqual(self.numbers(), live)
        for _ in range(2):  # what was just made, and what is in the file
            self.assertNotEqual(left(), [])
            cases.remove(name)
            self.assertEqual(left(), [])
            cases.open_file(path)
            self.assert_near(self.numbers(), live, 1e-6)


def _test(name):
    return lambda self: self.run_through(name)


for name in BAKED:
    setattr(Smoke, f"test_{name}", _test(name))
