"""What motus.hand_over refuses: a sentence each, nothing is left beside the file, and the file that was there before is still there."""

import sys
import unittest

import bpy

import support
from path import path_cases

BEFORE = b"the file that was there before"
FILLS_THE_DISK = """
import resource, signal
from pathlib import Path
import bpy, support
from hand_over import test_hand_over_refusals
test_hand_over_refusals.follower()
bpy.ops.motus.grid_add(width=61, height=61)
grid = bpy.context.object
bpy.ops.motus.pin_add(object=grid.name, vertex=1860, displacement=(0.0, 0.0, 1.0), radius=2.0)
for frame, strength in ((1, 0.0), (40, 1.0)):
    grid.motus.pull.pins[0].strength = strength
    grid.keyframe_insert("motus.pull.pins[0].strength", frame=frame)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
for most in {limits!r}:
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
    try:
        bpy.ops.motus.hand_over(filepath={path!r}, start=1, end=16)
    except RuntimeError as error:
        said = " ".join(str(error).split())
        print("SAID", said, [one.name for one in Path({path!r}).parent.iterdir()], Path({path!r}).read_bytes())
"""


def follower():
    """A car on a course."""
    course = path_cases.curve_data("Course")
    path_cases.add_bezier(course, path_cases.cubic_knots(path_cases.CLIMB))
    support.link("Course", course)
    car = support.link("Car")
    bpy.ops.motus.path_follow_add(object="Car", curve="Course", duration=2.0)
    return car


class TestRefusals(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "out.blend"
        self.path.write_bytes(BEFORE)

    def assert_refused(self, part, **keywords):
        """Refused with a sentence in which `part` is found, and nothing has changed in the folder."""
        there = sorted(self.folder.iterdir())
        self.assertRefused(part, bpy.ops.motus.hand_over, **{"filepath": str(self.path), "start": 1, "end": 10} | keywords)
        self.assertEqual(sorted(self.folder.iterdir()), there)
        self.assertEqual(self.path.read_bytes(), BEFORE)

    def test_one_frame(self):
        follower()
        self.assert_refused("One frame is no motion", end=1)

    def test_an_empty_range(self):
        follower()
        self.assert_refused("The range is empty", start=10, end=1)

    def test_nothing_of_motus(self):
        support.link("Empty")
        self.assert_refused("Nothing in the file is driven by Motus")

    def test_no_path_no_folder_and_a_folder(self):
        follower()
        self.assert_refused("Name the file", filepath="")
        self.assert_refused("There is no folder", filepath=str(self.folder / "none" / "out.blend"))
        (self.folder / "folder.blend").mkdir()
        self.assert_refused("is a folder", filepath=str(self.folder / "folder.blend"))

    @unittest.skipUnless(sys.platform == "linux", "no folder into which nobody can write")
    def test_a_folder_that_cannot_be_written(self):
        follower()
        self.assert_refused("Nothing can be written into /proc", filepath="/proc/out.blend")

    def test_the_open_file_itself(self):
        follower()
        own = self.folder / "own.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(own))
        size = own.stat().st_size
        self.assert_refused("is the open file itself", filepath=str(own))
        self.assertEqual(own.stat().st_size, size)

    def test_a_linked_object(self):
        follower()
        self.load(self.save(), True, "Car")
        self.assert_refused("Car is linked from another file")

    def test_an_override(self):
        follower()
        car = self.load(self.save(), True, "Car")
        car.override_create(remap_local_usages=True)
        self.assert_refused("is a library override|is linked from another file")

    def test_what_only_an_instance_of_a_collection_shows(self):
        car, collection = follower(), bpy.data.collections.new("Garage")
        collection.objects.link(car)
        bpy.context.scene.collection.objects.unlink(car)
        shown = support.link("Instance")
        shown.instance_type, shown.instance_collection = 'COLLECTION', collection
        self.assert_refused("Car is not in the view layer")

    @unittest.skipIf(sys.platform == "win32", "Windows limits no files")
    def test_a_full_disk(self):
        sentences = {200_000: "No copy of the open file could be written", 1_500_000: "The file could not be handed over"}
        status, output = support.run_blender(FILLS_THE_DISK.format(limits=list(sentences), path=str(self.path)))
        self.assertEqual(status, 0, output)
        said = [line for line in output.splitlines() if line.startswith("SAID")]
        self.assertEqual(len(said), len(sentences), output)
        for line, sentence in zip(said, sentences.values()):
            self.assertTrue(line.startswith(f"SAID Error: {sentence}"), line)
            self.assertTrue(line.endswith(f" ['out.blend'] {BEFORE!r}"), line)


class TestCancelled(support.SceneTestCase):
    def test_nothing_is_left_and_leftovers_are_removed(self):
        follower()
        path = self.folder / "out.blend"
        path.write_bytes(BEFORE)
        for name in ("out.motus-copy.blend", "out.motus-new.blend"):
            (self.folder / name).write_bytes(b"left by a session that was ended")
        handing = support.addon("hand_over.handing")
        steps = handing.hand_over(bpy.context.scene, bpy.context.view_layer, path, [0.0, 1.0, 2.0])
        next(steps)
        self.assertGreater((self.folder / "out.motus-copy.blend").stat().st_size, 10_000)
        steps.close()
        self.assertEqual([one.name for one in self.folder.iterdir()], ["out.blend"])
        self.assertEqual(path.read_bytes(), BEFORE)
