"""Chains of objects in a row: where they hang, in any order of frames, at any frame rate, with keys and parents, and after they are removed."""

import bpy
import numpy as np
from mathutils import Matrix

import support
from chains import chain_cases as cases
from core import test_habits

FRAMES = (1, 8, 13.5, 20, 26, 31.25, 90)
LIMP = {"frequency": 0.0, "drag": 0.5}
LINK = 0.4


def row(count=4, name="Bead", parent=None):
    """The root, which keys move along X, and objects in a row beside it, along Y."""
    found = [support.link(f"{name} {index}", location=(0.0, LINK * index, 2.0), parent=parent) for index in range(count + 1)]
    cases.key(found[0], "location", {1: (0.0, 0.0, 2.0), 12: (0.0, 0.0, 2.0), 24: (1.0, 0.0, 2.0)})
    return found


def add(objects, **settings):
    """The entries that motus.chains_add makes for a row; keywords of the operator, and settings of its root."""
    keywords = {name: settings.pop(name) for name in list(settings) if name in support.addon("chains.operators").KEYWORDS}
    bpy.ops.motus.chains_add(objects=", ".join(obj.name for obj in objects), **keywords)
    for name, value in settings.items():
        setattr(objects[0].motus.chains, name, value)
    bpy.context.view_layer.update()
    return objects[0].motus.chains.entries


def matrices(objects, frame):
    cases.go_to(frame)
    return np.array([support.evaluated(obj).matrix_world for obj in objects])


def places(objects, frame):
    return matrices(objects, frame)[:, :3, 3]


class ChainsObjectsTest(support.SceneTestCase):
    def test_a_limp_row_at_rest_hangs_straight_down(self):
        beads = row()
        (entry,) = add(beads, **LIMP | {"drag": 2.0}, settle=60.0)
        self.assertEqual((entry.name, len(entry.links)), ("Bead 1", 4))
        found = matrices(beads, 1)
        np.testing.assert_allclose(found[:, :3, 3], [(0.0, 0.0, 2.0 - LINK * index) for index in range(5)], atol=6e-3)
        # The animated link points along Y, the hanging one down: each object but the root turns about X by -90 degrees.
        np.testing.assert_allclose(found[1:, :3, :3], [Matrix.Rotation(-np.pi / 2, 3, 'X')] * 4, atol=1e-2)
        np.testing.assert_array_equal(found[0, :3, :3], np.eye(3))
        self.assertIsNone(cases.problem(beads[0]))

    def test_links_keep_their_lengths(self):
        beads = row()
        add(beads, **LIMP)
        for frame in FRAMES:
            found = np.linalg.norm(np.diff(places(beads, frame), axis=0), axis=1)
            np.testing.assert_allclose(found, LINK, rtol=1e-3, err_msg=f"{frame}")
        self.assertGreater(np.abs(places(beads, 24)[:, 0] - 1.0).max(), 0.1, "the row lags behind its root")

    def test_the_root_takes_along_what_nothing_else_moves(self):
        """A stiff row keeps its shape, as children of the root would, while the root moves and turns."""
        beads = row()
        cases.key(beads[0], "rotation_euler", {1: (0.0, 0.0, 0.0), 12: (0.0, 0.0, 0.0), 24: (0.5, 0.0, 1.5)})
        add(beads, frequency=50.0, damping=1.0, gravity=0.0, response=1.0)
        plain = matrices(beads, 1)
        found = matrices(beads, 120)
        np.testing.assert_allclose(found, found[0] @ np.linalg.inv(plain[0]) @ plain, atol=2e-3)

    def test_a_row_touches_and_feels_wind(self):
        beads = row()
        beads[0].animation_data_clear()
        beads[0].location.z = 2.0
        ground = support.link("Ground", location=(0.0, 0.0, 1.0))
        solid = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(solid)
        solid.objects.link(ground)
        add(beads, frequency=0.0, drag=4.0, thickness=0.05, settle=20.0, colliders=solid)
        found = places(beads, 30)
        self.assertGreater(found[:, 2].min(), 1.045)
        self.assertLess(found[-1, 2], 1.06)
        beads[0].motus.chains.colliders = None
        beads[0].motus.chains.wind = (2.0, 0.0, 0.0)
        way = places(beads, 30)[1] - places(beads, 30)[0]
        self.assertAlmostEqual(way[0] / -way[2], 4.0 * 2.0 / 9.81, delta=0.03)
        self.assertIsNone(cases.problem(beads[0]))

    def test_the_root_in_a_car(self):
        """With Inherit Motion at 0 a row comes along as if its root stood still."""
        still = row()
        still[0].animation_data_clear()
        still[0].location = (0.0, 0.0, 2.0)
        add(still, **LIMP, settle=1.0)
        wanted = places(still, 30) - places(still, 30)[0]
        support.empty_scene()
        beads = row()
        add(beads, **LIMP, settle=1.0, inherit=0.0)
        found = places(beads, 30)
        np.testing.assert_allclose(found - found[0], wanted, atol=1e-3)

    def test_what_hangs_is_no_collider_of_itself(self):
        beads = row()
        solid = bpy.data.collections.new("Solid")
        bpy.context.scene.collection.children.link(solid)
        for bead in beads[1:]:
            solid.objects.link(bead)
        add(beads, **LIMP)
        wanted = places(beads, 20)
        beads[0].motus.chains.colliders = solid
        np.testing.assert_array_equal(places(beads, 20), wanted)
        self.assertIsNone(cases.problem(beads[0]))
        solid.objects.link(support.link("Ground", location=(0.0, 0.0, 1.5)))
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(places(beads, 20) - wanted).max(), 0.05)

    def test_both_ends_are_held(self):
        beads = row(8)
        for index, bead in enumerate(beads[1:], 1):  # a gable
            bead.location = (0.0, 0.3 * index, 2.0 + 0.2 * min(index, 8 - index))
        end = np.array(beads[8].location)
        add(beads, **LIMP | {"drag": 2.0}, hold_end=True, settle=30.0)
        found = places(beads, 1)
        np.testing.assert_allclose(found[8], end, atol=2e-3)
        self.assertLess(found[4, 2], 1.9)
        # The root takes along where the end is held, too.
        np.testing.assert_allclose(places(beads, 60)[8] - places(beads, 60)[0], end - (0.0, 0.0, 2.0), atol=5e-3)

    def test_a_row_on_a_rig_beside_its_bones(self):
        rig, beads = cases.rope(2), row(2)
        cases.add(rig)
        bpy.ops.motus.chains_add(objects=f"{rig.name}, Bead 1, Bead 2")
        self.assertEqual([entry.name for entry in rig.motus.chains.entries], ["Tail 0 0", "Bead 1"])
        rest = [bead.location for bead in beads]
        self.assertGreater(np.linalg.norm(places(beads, 40) - rest, axis=1)[1:].min(), 0.02)
        self.assertIsNone(cases.problem(rig))
        bpy.context.view_layer.objects.active = rig
        self.assertRefused("pins hold", bpy.ops.motus.chains_pin)
        bpy.ops.motus.chains_remove(object=rig.name, bones="Tail 0 0")
        self.assertEqual([entry.name for entry in rig.motus.chains.entries], ["Bead 1"])
        bpy.ops.motus.chains_remove(object=rig.name)
        self.assertFalse(beads[1].constraints or rig.pose.bones["Tail 0 0"].constraints)

    def test_panel_and_overlay(self):
        beads = row()
        (entry,) = add(beads)
        bpy.context.view_layer.objects.active = beads[0]
        panel, layout = support.addon("chains.panel"), test_habits.Layout()
        for draw in (
            panel.draw_main,
            panel.draw_world,
            panel.draw_time,
            panel.draw_actions,
            *(part.draw for part in panel.PANEL.parts[:2]),
        ):
            draw(layout, bpy.context)
        (lines, *_) = support.addon("chains.overlay").overlay.draw(bpy.context, beads[0])
        self.assertEqual(len(lines.points), 8)
        np.testing.assert_allclose(lines.points[0::2][1:], lines.points[1::2][:-1])
        entry.is_muted = True
        self.assertFalse(support.addon("chains.overlay").overlay.draw(bpy.context, beads[0]))

    def test_any_frame_in_any_order(self):
        beads = row()
        add(beads, frequency=1.0)
        first = {frame: matrices(beads, frame).tobytes() for frame in FRAMES}
        support.addon().forget_all()
        for frame in reversed(FRAMES):
            self.assertEqual(matrices(beads, frame).tobytes(), first[frame])

    def test_the_same_motion_at_every_frame_rate(self):
        found = {}
        for fps in (24, 25, 60):
            support.empty_scene()
            scene = bpy.context.scene
            scene.render.fps, scene.frame_start, scene.frame_end = fps, 0, 4 * fps
            beads = row()
            beads[0].animation_data_clear()
            cases.key(beads[0], "location", {0: (0.0, 0.0, 2.0), fps: (0.0, 0.0, 2.0), 2 * fps: (0.5, 0.0, 2.0)})
            add(beads, frequency=0.7)
            found[fps] = [places(beads, seconds * fps) for seconds in (0.5, 1.0, 1.4, 2.0, 4.0)]
        for fps in (25, 60):
            np.testing.assert_allclose(found[fps], found[24], atol=1e-6)

    def test_keys_of_objects_and_of_their_parent_are_followed(self):
        """A stiff row is where its keys and its moving, turned and scaled parent have it."""
        parent = support.link("Parent")
        parent.rotation_euler, parent.scale = (0.3, -0.5, 0.7), (1.5, 1.5, 1.5)
        cases.key(parent, "location", {1: (0.0, 0.0, 0.0), 60: (1.0, 2.0, 0.5)})
        beads = row(3, parent=parent)
        cases.key(beads[2], "location", {1: beads[2].location, 60: beads[2].location + Matrix.Rotation(0.5, 3, 'Z').col[0] * 0.2})
        beads[3].rotation_euler, beads[3].scale = (0.4, 0.2, -0.9), (-1.0, 2.0, 0.5)
        plain = {frame: matrices(beads, frame) for frame in (1, 30, 60)}
        (entry,) = add(beads, frequency=50.0, damping=1.0, gravity=0.0, response=1.0)
        for frame, wanted in plain.items():
            np.testing.assert_allclose(matrices(beads, frame), wanted, atol=2e-2)
        entry.weight = 0.0
        bpy.context.view_layer.update()
        for frame, wanted in plain.items():
            np.testing.assert_allclose(matrices(beads, frame), wanted, atol=1e-5)

    def test_an_object_below_a_turned_parent_hangs_down_too(self):
        parent = support.link("Parent", location=(1.0, 0.0, 0.0))
        parent.rotation_euler, parent.scale = (0.3, -0.5, 0.7), (2.0, 2.0, 2.0)
        beads = row(3)
        for bead in beads[1:]:
            bead.parent = parent
            bead.matrix_parent_inverse = parent.matrix_basis.inverted()
        beads[2].scale.x = -1.0
        add(beads, **LIMP | {"drag": 2.0}, settle=60.0)
        found = places(beads, 1)
        np.testing.assert_allclose(found, [(0.0, 0.0, 2.0 - LINK * index) for index in range(4)], atol=3e-3)
        turned = matrices(beads, 1)[2, :3, :3]
        np.testing.assert_allclose(turned, np.array(Matrix.Rotation(-np.pi / 2, 3, 'X')) * (-1.0, 1.0, 1.0), atol=5e-3)

    def test_an_object_on_a_bone_hangs_down_too(self):
        rig = cases.rope(2)
        beads = row(2)
        for bead in beads:
            bead.parent, bead.parent_type, bead.parent_bone = rig, 'BONE', "Root"
        start = places(beads, 1)
        add(beads, **LIMP | {"drag": 2.0}, settle=60.0)
        np.testing.assert_allclose(places(beads, 1), start[0] - np.outer(LINK * np.arange(3), (0.0, 0.0, 1.0)), atol=3e-3)

    def test_an_object_that_is_moved_by_hand_is_followed(self):
        beads = row(2)
        add(beads, frequency=50.0, damping=1.0, gravity=0.0)
        places(beads, 1)
        beads[2].location.z += 0.5
        bpy.context.view_layer.update()
        np.testing.assert_allclose(support.evaluated(beads[2]).matrix_world.translation, beads[2].location, atol=1e-2)

    def test_removal_leaves_nothing(self):
        beads = row()
        before = {frame: matrices(beads, frame).tobytes() for frame in FRAMES}
        names = {obj.name for obj in bpy.data.objects}
        add(beads)
        self.assertNotEqual(matrices(beads, 20).tobytes(), before[20])
        bpy.ops.motus.chains_remove(object="Bead 3")
        for bead in beads:
            self.assertFalse(bead.constraints or [key for key in bead.keys() if key != "motus"], bead.name)
            self.assertIsNone(bead.motus.chains.leader)
        self.assertEqual({frame: matrices(beads, frame).tobytes() for frame in FRAMES}, before)
        self.assertEqual({obj.name for obj in bpy.data.objects}, names)

    def test_bake_and_unbake(self):
        beads = row()
        add(beads)
        live = {frame: matrices(beads, frame) for frame in (1, 15, 30)}
        bpy.context.view_layer.objects.active = beads[0]
        bpy.ops.motus.bake(frame_start=1, frame_end=30)
        for frame, wanted in live.items():
            np.testing.assert_allclose(matrices(beads, frame), wanted, atol=1e-5)
        bpy.ops.motus.unbake()
        for frame, wanted in live.items():
            np.testing.assert_array_equal(matrices(beads, frame), wanted)

    def test_selected_objects_hang_in_their_order(self):
        beads = row()
        for obj in beads:
            obj.select_set(True)
        bpy.context.view_layer.objects.active = beads[0]
        bpy.ops.motus.chains_add()
        (entry,) = beads[0].motus.chains.entries
        self.assertEqual([link.object for link in entry.links], beads[1:])

    def test_what_cannot_hang_is_refused(self):
        beads = row()
        beads[3].parent = beads[2]
        self.assertRefused("is parented to Bead 2", bpy.ops.motus.chains_add, objects="Bead 0, Bead 1, Bead 2, Bead 3")
        beads[3].parent = None
        beads[0].parent = beads[3]
        self.assertRefused("What Bead 0 hangs on", bpy.ops.motus.chains_add, objects="Bead 0, Bead 3")
        beads[0].parent = None
        self.assertRefused("at least two", bpy.ops.motus.chains_add, objects="Bead 0, Bead 0")
        add(beads[:3])
        self.assertRefused("driven by Chains of Bead 0", bpy.ops.motus.chains_add, objects="Bead 3, Bead 2")
        self.assertRefused("driven by Chains of Bead 0", bpy.ops.motus.chains_add, objects="Bead 0, Bead 2")

    def test_a_row_on_a_row(self):
        beads, more = row(2), row(2, "More")
        more[0].animation_data_clear()
        add(beads, **LIMP, settle=20.0)
        add([beads[2], *more[1:]], **LIMP, settle=20.0)
        for frame in (1, 20, 30):
            found = places([*beads, *more[1:]], frame)
            self.assertLess(found[3, 2], found[2, 2], frame)
            np.testing.assert_allclose(np.linalg.norm(np.diff(found[2:], axis=0), axis=1)[1], LINK, rtol=1e-2)
        self.assertIsNone(cases.problem(beads[2]))

    def test_copies_and_files(self):
        beads = row(3)
        add(beads, frequency=0.5)
        wanted = {frame: matrices(beads, frame) for frame in (1, 15, 22.5)}
        for obj in beads:
            obj.select_set(True)
        bpy.context.view_layer.objects.active = beads[0]
        bpy.ops.object.duplicate()
        copies = [bpy.data.objects[f"{bead.name}.001"] for bead in beads]
        bpy.context.view_layer.update()
        copies[0].delta_location.x = 3.0
        for copy in copies[1:]:
            copy.location.x += 3.0
        for frame, found in wanted.items():
            moved = found.copy()
            moved[:, 0, 3] += 3.0
            np.testing.assert_allclose(matrices(copies, frame), moved, atol=1e-5)
            np.testing.assert_array_equal(matrices(beads, frame), found)
        bpy.ops.wm.open_mainfile(filepath=self.save())
        beads = [bpy.data.objects[f"Bead {index}"] for index in range(4)]
        for frame, found in wanted.items():
            np.testing.assert_array_equal(matrices(beads, frame), found)

    def test_a_copied_root_alone_has_no_row(self):
        beads = row(3)
        add(beads, frequency=0.5)
        wanted = matrices(beads, 15)
        copy = beads[0].copy()
        bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        np.testing.assert_array_equal(matrices(beads, 15), wanted)
        self.assertIn("not there any more", cases.problem(copy).sentence)
        bpy.ops.motus.chains_remove(object=copy.name)
        np.testing.assert_array_equal(matrices(beads, 15), wanted)

    def test_a_row_on_a_row_whose_root_is_gone(self):
        beads, more = row(2), row(2, "More")
        add(beads)
        add([beads[2], *more[1:]])
        bpy.data.objects.remove(beads.pop(0))
        self.assertEqual([len(obj.constraints) for obj in (*beads, *more[1:])], [1, 1, 1, 1])
        bpy.context.view_layer.objects.active = beads[1]
        bpy.ops.motus.chains_remove(only_active=True)  # the button of the list: its own row alone
        self.assertEqual([len(obj.constraints) for obj in (*beads, *more[1:])], [1, 1, 0, 0])
        add([beads[1], *more[1:]])
        bpy.ops.motus.chains_remove(object=beads[1].name)
        self.assertFalse(any(obj.constraints for obj in (*beads, *more[1:])))

    def test_a_copied_object_alone_is_freed(self):
        beads = row(3)
        add(beads, frequency=0.5)
        wanted = matrices(beads, 15)
        copies = [beads[2].copy() for _ in range(2)]
        for copy in copies:
            bpy.context.scene.collection.objects.link(copy)
        bpy.context.view_layer.update()
        bpy.ops.motus.chains_remove(object=copies[0].name)
        self.assertFalse(copies[0].constraints)
        copies[1].location.y += 0.1
        bpy.ops.motus.chains_add(objects=f"{beads[0].name}, {copies[1].name}")
        self.assertEqual(len(copies[1].constraints), 1)
        self.assertEqual(len(beads[0].motus.chains.entries), 2)
        np.testing.assert_array_equal(matrices(beads, 15), wanted)
        self.assertIsNone(cases.problem(beads[0]))

    def test_an_object_of_a_row_is_deleted(self):
        beads = row(3)
        add(beads, frequency=0.5)
        bpy.data.objects.remove(beads.pop(2))
        bpy.context.view_layer.update()
        places(beads, 15)
        self.assertIn(
            cases.problem(beads[0]), (support.addon("chains.making").THINGS_CHANGED, support.addon("chains.making").THINGS_MISSING)
        )
        bpy.ops.motus.refresh(object="Bead 0")
        bpy.ops.motus.chains_remove(object="Bead 0")
        self.assertFalse(beads[1].constraints)

    def test_a_root_that_is_removed_leaves_free_objects(self):
        for opens in (False, True):
            for how in ("remove", "add"):
                with self.subTest(how, opens=opens):
                    support.empty_scene()
                    beads = row()
                    plain = matrices(beads[1:], 20)
                    names = {obj.name for obj in bpy.data.objects}
                    add(beads, **LIMP)
                    places(beads, 30)
                    bpy.data.objects.remove(beads.pop(0))
                    cases.go_to(31)
                    if opens:
                        bpy.ops.wm.open_mainfile(filepath=self.save())
                    beads = [bpy.data.objects[f"Bead {index}"] for index in range(1, 5)]
                    np.testing.assert_allclose(matrices(beads, 20), plain, atol=1e-6)
                    if how == "add":
                        add(beads)
                        self.assertEqual([len(bead.constraints) for bead in beads[1:]], [1, 1, 1])
                        self.assertIsNone(cases.problem(beads[0]))
                        self.assertGreater(np.abs(matrices(beads, 20) - plain).max(), 0.1)
                        bpy.ops.motus.chains_remove(object="Bead 1")
                    for bead in beads:
                        if bead.constraints:
                            bpy.ops.motus.chains_remove(object=bead.name)
                        self.assertFalse(bead.constraints, bead.name)
                        self.assertIsNone(bead.motus.chains.leader)
                    bpy.ops.wm.open_mainfile(filepath=self.save())
                    self.assertEqual({obj.name for obj in bpy.data.objects}, names - {"Bead 0"})

    def test_a_root_in_no_collection_counts_as_deleted(self):
        beads = row()
        plain = matrices(beads[1:], 20)
        add(beads, **LIMP)
        for bead in beads:
            bead.select_set(bead == beads[0])
        bpy.ops.object.delete()
        root, beads = bpy.data.objects["Bead 0"], beads[1:]
        cases.go_to(19)
        np.testing.assert_allclose(matrices(beads, 20), plain, atol=1e-6)
        path = self.save()
        bpy.context.scene.collection.objects.link(root)
        bpy.context.view_layer.update()
        self.assertGreater(np.abs(matrices(beads, 20) - plain).max(), 0.1, "it was put back")
        bpy.ops.wm.open_mainfile(filepath=path)
        beads = [bpy.data.objects[f"Bead {index}"] for index in range(1, 5)]
        np.testing.assert_allclose(matrices(beads, 20), plain, atol=1e-6)
        add(beads[:3])
        self.assertGreater(np.abs(matrices(beads, 20) - plain).max(), 0.05)
        self.assertEqual([len(bead.constraints) for bead in beads], [0, 1, 1, 0])
        bpy.ops.motus.chains_remove(object="Bead 3")
        self.assertFalse(any(bead.constraints for bead in beads))
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.assertEqual({obj.name for obj in bpy.data.objects}, {f"Bead {index}" for index in range(1, 5)})
