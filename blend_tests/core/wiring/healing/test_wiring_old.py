"""Files in which owners carry their solvers themselves, as an older version wired them.

They go on working, and what is local is wired as today when the file is opened.
"""

from unittest import mock

import bpy

import support
import toy_bone_system
import toy_system
from core.wiring.bone_cases import BoneTestCase, build_few, build_without_stretch, poses
from core.wiring.healing import old_wiring
from core.wiring.wiring_cases import WiringTestCase, build_bone, build_object, each_of, frame_set

wiring = support.addon("core.wiring")
attaching = support.addon("core.wiring.attaching.attach")
hub_lookup = support.addon("core.wiring.hubs.hub_lookup")
FRAMES = (12, 40.5, 3)


def save(case):
    """Saves the file as the old version has left it; to save evaluates, and then it would be wired as today."""
    path = str(case.folder / "old.blend")
    with mock.patch.object(attaching, "_refresh"):
        bpy.ops.wm.save_as_mainfile(filepath=path)
    return path


def link(path, *names):
    support.empty_scene()
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = list(names)
    for one in wanted.objects:
        bpy.context.scene.collection.objects.link(one)
    return wanted.objects[0]


def carriers(system, owner):
    return [type(carrier).__name__ for _, carrier in hub_lookup.carriers(system, owner)]


class ObjectTest(WiringTestCase):
    def build(self, build):
        owner, things = build(toy_system.new_target())
        old_wiring.rewire(toy_system.SYSTEM, owner)
        return owner, things

    @each_of((build_object, build_bone))
    def test_opened(self, build):
        _, things = self.build(build)
        names = [(thing.id_data.name, thing.name) for thing in things]
        bpy.ops.wm.open_mainfile(filepath=save(self))
        owner = bpy.data.objects[names[0][0]]
        self.assertEqual(carriers(toy_system.SYSTEM, owner), ["Mesh"])
        things = [owner.pose.bones[name] if owner.pose else owner for _, name in names]
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, things)
        self.assertEqual(
            [len(thing.constraints) for thing in things],
            [1 if support.addon("core.blender.capabilities").has_geometry_attribute_constraint() else 2],
        )

    @each_of((build_object, build_bone))
    def test_linked(self, build):
        owner, things = self.build(build)
        bones = [thing.name for thing in things if isinstance(thing, bpy.types.PoseBone)]
        owner = link(save(self), owner.name)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, [owner.pose.bones[name] for name in bones] or [owner])
        self.assertEqual(carriers(toy_system.SYSTEM, owner), ["Object"])
        self.assertIsNone(wiring.problem(toy_system.SYSTEM, owner, bpy.context.evaluated_depsgraph_get()))
        self.assertEqual([obj.name for obj in bpy.data.objects if not obj.library], [])

    @each_of((build_object, build_bone))
    def test_appended(self, build):
        owner, things = self.build(build)
        name, bones = owner.name, [thing.name for thing in things if isinstance(thing, bpy.types.PoseBone)]
        folder = f"{save(self)}/Object/"
        support.empty_scene()
        bpy.ops.wm.append(filepath=folder + name, directory=folder, filename=name)
        owner = bpy.data.objects[name]
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, [owner.pose.bones[bone] for bone in bones] or [owner])
        self.assertEqual(carriers(toy_system.SYSTEM, owner), ["Mesh"])

    def test_constraints_that_the_user_has_renamed(self):
        owner, _ = self.build(build_object)
        for constraint in owner.constraints:
            constraint.name = f"Mine {constraint.name}"
        owner.constraints.new('LIMIT_SCALE').name = "Mine"
        driver = owner.constraints["Mine"].driver_add("influence").driver
        driver.variables.new().targets[0].id = owner
        driver.variables[0].targets[0].data_path = wiring.output_path(toy_system.SYSTEM, "angle")
        wiring.detach(toy_system.SYSTEM, owner)
        self.assertEqual([constraint.name for constraint in owner.constraints], ["Mine"])
        self.assertEqual([key for key in owner.keys() if key.startswith("motus_")], [])

    def test_reader_of_an_output(self):
        """A driver of the user's that reads the owner's property reads it after the file was opened too."""
        self.build(build_object)
        reader = toy_system.new_object("Reader")
        driver = reader.driver_add("location", 2).driver
        driver.type = 'SUM'
        target = driver.variables.new().targets[0]
        target.id, target.data_path = bpy.data.objects["Owner"], '["motus_orbit_out"][2]'
        bpy.ops.wm.open_mainfile(filepath=save(self))
        for frame in (48, 12):
            frame_set(frame)
            self.assertAlmostEqual(toy_system.world_matrix(bpy.data.objects["Reader"]).translation.z, frame / 24.0, places=5)

    def test_overridden(self):
        owner, _ = self.build(build_object)
        linked = link(save(self), owner.name)
        owner = linked.override_create(remap_local_usages=True)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, [owner])
        owner.motus.orbit.radius = 6.0
        for frame in FRAMES:
            frame_set(frame)
            self.assert_follows(owner, [owner])


class BonesTest(BoneTestCase):
    def build(self, build):
        rig = build()
        frame_set(1)
        old_wiring.rewire(toy_bone_system.SYSTEM, rig)
        return rig

    @each_of((build_few, build_without_stretch))
    def test_opened(self, build):
        self.build(build)
        bpy.ops.wm.open_mainfile(filepath=save(self))
        rig = bpy.data.objects["Rig"]
        self.assertEqual(carriers(toy_bone_system.SYSTEM, rig), ["Mesh"])
        self.assert_alive(rig)
        self.assertEqual([obj.name for obj in bpy.data.objects if "Anchor" in obj.name], [])
        self.assertEqual([key for key in rig.keys() if "_out" in key or "_info" in key], [])

    @each_of((build_few, build_without_stretch))
    def test_linked(self, build):
        self.build(build)
        rig = link(save(self), "Rig")
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)
        self.assertEqual(carriers(toy_bone_system.SYSTEM, rig), ["Object"])
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertIsNotNone(wiring.output(toy_bone_system.SYSTEM, rig, "A.0.angle", graph))

    @each_of((build_few, build_without_stretch))
    def test_overridden(self, build):
        self.build(build)
        rig = link(save(self), "Rig").override_create(remap_local_usages=True)
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)
        rig.motus.bend.entries[-1].weight = 0.3
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)
        wanted = poses(rig)
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "override.blend"))
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "override.blend"))
        frame_set(FRAMES[-1])
        rig = next(one for one in bpy.data.objects if one.type == 'ARMATURE' and one.override_library)
        self.assert_bent(rig)
        for name, matrix in poses(rig).items():
            self.assert_same_matrix(matrix, wanted[name])
