"""How many functions one frame calls: a count that no other work of the machine changes, in place of a time."""

import itertools
import sys
import unittest
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).resolve().parents[3] / "bench"))

import typical_bench

import support

WARM, COUNTED = range(1, 6), range(6, 16)
MOST = {
    "one follower": 75,
    "50 followers, one curve": 138,
    "50 followers, 50 curves": 2290,
    "one rig, four limbs": 112,
    "10 pendulums": 523,
    "10 objects with dynamics": 576,
    "10 look-ats": 618,
    "10 rigs with a layer": 607,
}
"""Most calls a frame for each scene of the benchmark typical_bench, of Python's functions and of built-in ones.

Each is the count at the time of writing and 5 % more, since versions of Python count differently.
"""


def calls_of_a_frame(scene):
    """Mean number of calls while Blender evaluates a frame, drivers and handlers included.

    Blender evaluates drivers in threads of its own, as many as are free: `sys.monitoring` counts in all of them, whereas
    `sys.setprofile` counts in one.
    """
    count = itertools.count()
    monitoring, tool = sys.monitoring, sys.monitoring.PROFILER_ID

    def note(*_call):
        next(count)

    for frame in WARM:
        scene.frame_set(frame)
    monitoring.use_tool_id(tool, "calls of a frame")
    try:
        monitoring.register_callback(tool, monitoring.events.CALL, note)
        monitoring.set_events(tool, monitoring.events.CALL)
        for frame in COUNTED:
            scene.frame_set(frame)
    finally:
        monitoring.set_events(tool, monitoring.events.NO_EVENTS)
        monitoring.register_callback(tool, monitoring.events.CALL, None)
        monitoring.free_tool_id(tool)
    return next(count) / len(COUNTED)


@unittest.skipUnless(hasattr(sys, "monitoring"), "Python counts calls in all threads since 3.12")
@support.in_one_blender
class CallTest(support.SceneTestCase):
    def test_calls_of_a_frame(self):
        for name, most in MOST.items():
            with self.subTest(name):
                make, motus = typical_bench.SCENES[name][:2]
                support.empty_scene()
                motus(make())
                self.assertLessEqual(calls_of_a_frame(bpy.context.scene), most)
