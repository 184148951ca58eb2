"""How many functions one frame calls: a count that no other work of the machine changes, in place of a time."""

import sys
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).resolve().parents[3] / "bench"))

import typical_bench

import support

WARM, COUNTED = range(1, 6), range(6, 16)
MOST = {
    "one follower": 80,
    "50 followers, one curve": 150,
    "50 followers, 50 curves": 2550,
    "one rig, four limbs": 116,
    "10 pendulums": 530,
    "10 objects with dynamics": 600,
    "10 look-ats": 660,
    "10 rigs with a layer": 660,
}
"""Most calls a frame for each scene of the benchmark typical_bench, of Python's functions and of built-in ones.

A scene may have some more calls than were counted when this table was written, since versions of Python count differently.
"""


def calls_of_a_frame(scene):
    """Mean number of calls while Blender evaluates a frame, drivers and handlers included."""
    count = 0

    def note(_frame, event, _function):
        nonlocal count
        count += event in {"call", "c_call"}

    for frame in WARM:
        scene.frame_set(frame)
    sys.setprofile(note)
    try:
        for frame in COUNTED:
            scene.frame_set(frame)
    finally:
        sys.setprofile(None)
    return count / len(COUNTED)


@support.in_one_blender
class CallTest(support.SceneTestCase):
    def test_calls_of_a_frame(self):
        for name, most in MOST.items():
            with self.subTest(name):
                make, motus = typical_bench.SCENES[name][:2]
                support.empty_scene()
                motus(make())
                self.assertLessEqual(calls_of_a_frame(bpy.context.scene), most)
