"""Sequences of pictures as the footage of a chroma key: which files they consist of, and which gaps are told."""

import os

import bpy

import support
from chroma.chroma_setup_cases import SetUpTestCase, footage

compositor = support.addon("chroma.compositor")


class Footage(SetUpTestCase):
    def sequence(self, numbers):
        """Names of pictures of a sequence in the test's folder."""
        names = [f"shot_{number:03d}.png" for number in numbers]
        for name in names:
            footage(self.folder, name=name)
        footage(self.folder, name="another_007.png")
        return names

    def test_a_sequence_is_chosen(self):
        names = self.sequence(range(7, 12))
        self.set_up(directory=str(self.folder), files=[{"name": name} for name in reversed(names)])
        scene = bpy.context.scene
        node = compositor.node_of(scene, "Footage")
        self.assertEqual((node.image.source, node.image.name), ('SEQUENCE', names[0]))
        self.assertEqual((node.frame_duration, node.frame_start, node.frame_offset), (5, 1, 6))
        self.assertEqual((scene.frame_start, scene.frame_end), (1, 5))
        self.assertEqual((scene.render.resolution_x, scene.render.resolution_y), (60, 40))

    def test_a_still_stays_one_beside_its_sequence(self):
        names = self.sequence(range(1, 4))
        still = bpy.data.images.load(str(self.folder / names[0]))
        self.set_up(directory=str(self.folder), files=[{"name": name} for name in names])
        self.assertEqual(still.source, 'FILE')
        bpy.ops.motus.chroma_key_remove()
        self.assertEqual([image.name for image in bpy.data.images if image.source == 'SEQUENCE'], [])

    def test_a_sequence_of_the_file_is_named(self):
        names = self.sequence(range(7, 10))
        bpy.data.images.load(str(self.folder / names[0])).source = 'SEQUENCE'
        self.set_up(clip=names[0])
        self.assertEqual(compositor.node_of(bpy.context.scene, "Footage").frame_duration, 3)

    def test_files_that_make_no_sequence(self):
        names = self.sequence(range(1, 3))
        files = [{"name": name} for name in (*names, "another_007.png")]
        self.refused("numbered sequence", directory=str(self.folder), files=files)

    def test_numbers_in_names(self):
        numbered = support.addon("chroma.footage")._numbered
        for name, parts in (
            ("shot_007.png", ("shot_", "007", ".png")),
            ("f_0001.jp2", ("f_", "0001", ".jp2")),
            ("12.left.exr", ("", "12", ".left.exr")),
            ("still.jp2", None),
            ("IMG_20240101120000.jpg", None),
        ):
            self.assertEqual(numbered(name), parts, name)

    def test_gaps_are_told(self):
        names = self.sequence((7, 8, 10, 13))
        self.set_up(directory=str(self.folder), files=[{"name": name} for name in names])
        scene = bpy.context.scene
        self.assertEqual(scene.frame_end, 7)
        self.assertEqual(scene.motus.chroma.gap, "shot_007.png lacks pictures 9, 11-12: frames 3, 5-6 show the ones before")
        node = compositor.node_of(scene, "Footage")
        for frame, picture in ((6, 10), (3, 8), (1, 7), (4, 10), (7, 13), (2, 8), (5, 10)):
            scene.frame_set(frame)
            self.assertEqual(frame + node.frame_offset, picture)
        footage(self.folder, name="shot_009.png")
        bpy.ops.motus.chroma_key_measure()
        self.assertEqual(scene.motus.chroma.gap, "shot_007.png lacks pictures 11-12: frames 5-6 show the ones before")
        bpy.ops.motus.chroma_key_remove()
        self.assertFalse([action for action in bpy.data.actions if action.users])

    def test_sequence_without_a_gap(self):
        self.set_up(directory=str(self.folder), files=[{"name": name} for name in self.sequence((7, 8, 9))])
        self.assertEqual(bpy.context.scene.motus.chroma.gap, "")

    def test_ranges_are_short(self):
        ranges = support.addon("chroma.footage")._ranges
        self.assertEqual(ranges([1, 2, 4]), "1-2, 4")
        self.assertEqual(ranges(range(1, 40, 2)), "1, 3, 5, 7, 9, 11, 13, 15, ...")

    def test_footage_that_went_is_told(self):
        self.set_up(clip=footage(self.folder))
        image = compositor.node_of(bpy.context.scene, "Footage").image
        os.remove(bpy.path.abspath(image.filepath))
        image.reload()
        with self.assertRaisesRegex(RuntimeError, "cannot be read as a picture"):
            bpy.ops.motus.chroma_key_measure()
