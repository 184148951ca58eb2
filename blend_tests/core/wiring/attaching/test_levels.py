"""In which order entries are solved: through parents, constraints, drivers, deformed meshes and other objects."""

import bpy

import support
import toy_bone_system
import toy_system
from core.wiring.bone_cases import BoneTestCase, drive

dependencies = support.addon("core.wiring.attaching.levels")
wiring = support.addon("core.wiring")


class LevelTest(BoneTestCase):
    """Entries "A.0" and "B.0" of one rig; what the second one's target hangs on is the test's."""

    def setUp(self):
        super().setUp()
        self.rig = toy_bone_system.new_rig(chains=3)
        self.first, self.second = toy_system.new_object("First"), toy_system.new_object("Second")

    def levels(self, **more):
        """Levels of the entries, before they are wired, and the same afterwards."""
        found = [self._levels(attach, more) for attach in (False, True)]
        self.assertEqual(found[0], found[1])
        return found[0]

    def _levels(self, attach, more):
        targets = {"A.0": self.first, "B.0": self.second} | {name.replace("_", "."): one for name, one in more.items()}
        settings = self.rig.motus.bend
        if attach:
            wiring.attach(toy_bone_system.SYSTEM, self.rig)
        else:
            settings.entries.clear()
            for name, target in targets.items():
                entry = settings.entries.add()
                entry.name = name
                entry.target, entry.target_bone = target if isinstance(target, tuple) else (target, "")
        return [dependencies.levels(self.rig)["bend", name] for name in targets]

    def constrain(self, thing, kind, **settings):
        constraint = thing.constraints.new(kind)
        for name, value in settings.items():
            setattr(constraint, name, value)
        return constraint

    def read(self, owner, path, source, source_path="", bone="", index=0):
        """A driver that reads another thing's property, or transform."""
        driver = owner.driver_add(path, index).driver
        driver.type = 'SUM'
        variable = driver.variables.new()
        if not source_path:
            variable.type = 'TRANSFORMS'
        variable.targets[0].id = source
        if source_path:
            variable.targets[0].data_path = source_path
        else:
            variable.targets[0].bone_target = bone

    def test_independent(self):
        self.assertEqual(self.levels(), [0, 0])

    def test_empty(self):
        self.assertEqual(dependencies.levels(self.rig), {})

    def test_without_target(self):
        self.second = None
        self.assertEqual(self.levels(), [0, 0])

    def test_target_is_a_driven_bone(self):
        self.second = (self.rig, "A.1")
        self.assertEqual(self.levels(), [0, 1])

    def test_target_is_a_child_of_a_driven_bone(self):
        self.second = (self.rig, "A.end")
        self.assertEqual(self.levels(), [0, 1])

    def test_target_is_a_bone_beside(self):
        self.second = (self.rig, "C.0")
        self.assertEqual(self.levels(), [0, 0])

    def test_chain_of_levels(self):
        self.second = (self.rig, "A.1")
        self.assertEqual(self.levels(C_0=(self.rig, "B.end")), [0, 1, 2])

    def test_chain_on_a_chain(self):
        self.assertEqual(self.levels(A_end=self.first), [0, 0, 1])

    def test_loops(self):
        self.first = (self.rig, "A.1")
        self.assertEqual(self.levels(), [None, 0])
        self.first, self.second = (self.rig, "B.1"), (self.rig, "A.1")
        self.assertEqual(self.levels(), [None, None])
        self.assertEqual(self.levels(C_0=(self.rig, "A.end")), [None, None, 0])

    def test_object_on_a_bone(self):
        self.second.parent, self.second.parent_type, self.second.parent_bone = self.rig, 'BONE', "A.1"
        self.assertEqual(self.levels(), [0, 1])
        self.second.parent_bone = "B.1"
        self.assertEqual(self.levels(), [0, None])

    def test_grandchild_of_a_bone(self):
        middle = toy_system.new_object("Middle")
        middle.parent, middle.parent_type, middle.parent_bone = self.rig, 'BONE', "A.1"
        self.second.parent = middle
        self.assertEqual(self.levels(), [0, 1])

    def test_object_on_the_rig(self):
        self.second.parent = self.rig
        self.assertEqual(self.levels(), [0, 0])

    def test_constraints_of_the_target(self):
        self.constrain(self.second, 'COPY_LOCATION', target=self.rig, subtarget="A.1")
        self.assertEqual(self.levels(), [0, 1])

    def test_armature_constraint(self):
        target = self.constrain(self.second, 'ARMATURE').targets.new()
        target.target, target.subtarget = self.rig, "A.0"
        self.assertEqual(self.levels(), [0, 1])

    def test_constraints_of_the_bone_above(self):
        self.constrain(self.rig.pose.bones["root"], 'DAMPED_TRACK', target=self.second)
        self.second.parent, self.second.parent_type, self.second.parent_bone = self.rig, 'BONE', "A.1"
        # The second one waits for the first, which is not wired.
        self.assertEqual(self.levels(), [None, 0])

    def test_blenders_own_ik(self):
        # C.0 is turned by the IK of its child towards a bone that the first entry drives.
        self.constrain(self.rig.pose.bones["C.1"], 'IK', target=self.rig, subtarget="A.1", chain_count=2)
        self.second = (self.rig, "C.0")
        self.assertEqual(self.levels(), [0, 1])
        self.second = (self.rig, "C.side")
        self.assertEqual(self.levels(), [0, 1])
        self.rig.pose.bones["C.1"].constraints[0].chain_count = 1
        self.assertEqual(self.levels(), [0, 0])

    def test_drivers_of_the_target(self):
        self.read(self.second, "location", self.rig, bone="A.1")
        self.assertEqual(self.levels(), [0, 1])

    def test_driver_that_reads_a_matrix(self):
        self.read(self.second, "location", self.rig, 'pose.bones["A.1"].matrix[0][3]')
        self.assertEqual(self.levels(), [0, 1])

    def test_driver_that_reads_animation_only(self):
        self.read(self.second, "location", self.rig, 'pose.bones["A.1"].location[0]')
        self.assertEqual(self.levels(), [0, 0])

    def test_drivers_through_custom_properties(self):
        middle = toy_system.new_object("Middle")
        middle["x"] = 0.0
        curve = middle.driver_add('["x"]')
        curve.driver.type = 'SUM'
        variable = curve.driver.variables.new()
        variable.type = 'TRANSFORMS'
        variable.targets[0].id, variable.targets[0].bone_target = self.rig, "A.1"
        self.read(self.second, "location", middle, '["x"]')
        self.assertEqual(self.levels(), [0, 1])

    def test_drivers_of_a_constraint(self):
        self.constrain(self.second, 'LIMIT_LOCATION')
        curve = self.second.driver_add("constraints[0].influence")
        variable = curve.driver.variables.new()
        variable.type = 'TRANSFORMS'
        variable.targets[0].id, variable.targets[0].bone_target = self.rig, "A.1"
        self.assertEqual(self.levels(), [0, 1])

    def test_drivers_of_the_chains_animation(self):
        self.read(self.rig, 'pose.bones["B.1"].location', self.rig, bone="A.1")
        self.assertEqual(self.levels(), [0, 1])

    def test_bones_that_are_named_by_their_numbers(self):
        names = self.rig.pose.bones.keys()
        driven, read = names.index("B.1"), names.index("A.1")
        self.read(self.rig, 'pose.bones["B.1"].location', self.rig, f"pose.bones[{read}].matrix[0][3]")
        self.rig.animation_data.drivers[-1].data_path = f"pose.bones[{driven}].location"
        self.assertEqual(self.levels(), [0, 1])

    def test_driven_settings_belong_to_all(self):
        self.levels()
        drive(self.rig, 'motus.bend.entries["A.0"].weight', "frame")
        self.assertEqual(self.levels(), [0, 0])
        curve = self.rig.driver_add("motus.bend.influence")
        variable = curve.driver.variables.new()
        variable.type = 'TRANSFORMS'
        variable.targets[0].id, variable.targets[0].bone_target = self.rig, "A.1"
        self.assertEqual(self.levels(), [None, 0])

    def test_vertex_of_a_deformed_mesh(self):
        mesh = bpy.data.meshes.new("Skin")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        skin = toy_system.new_object("Skin", data=mesh)
        skin.modifiers.new("Armature", 'ARMATURE').object = self.rig
        self.first = toy_system.new_object("Third")
        self.second.parent, self.second.parent_type = skin, 'VERTEX'
        # All bones count, the second entry's own too.
        self.assertEqual(self.levels(), [0, None])

    def test_constraint_on_a_deformed_mesh(self):
        other = toy_bone_system.new_rig("Other")
        self.constrain(other.pose.bones["A.1"], 'COPY_ROTATION', target=self.rig, subtarget="A.1")
        mesh = bpy.data.meshes.new("Skin")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        skin = toy_system.new_object("Skin", data=mesh)
        skin.modifiers.new("Armature", 'ARMATURE').object = other
        self.constrain(self.second, 'COPY_LOCATION', target=skin)
        self.assertEqual(self.levels(), [0, 0])
        self.second.constraints[0].subtarget = "Group"
        self.assertEqual(self.levels(), [0, 1])
        self.second.constraints.clear()
        self.constrain(self.second, 'SHRINKWRAP', target=skin)
        self.assertEqual(self.levels(), [0, 1])

    def test_through_another_driven_rig(self):
        other = toy_bone_system.new_rig("Other")
        toy_bone_system.bend(other, {"A.0": (self.rig, "A.1")})
        self.second = (other, "A.1")
        self.assertEqual(self.levels(), [0, 1])

    def test_through_another_rig_with_a_hub(self):
        other = toy_bone_system.new_rig("Other")
        toy_bone_system.bend(other, {"A.0": (self.rig, "A.1")})
        drive(other, "motus.bend.influence", "1.0")
        wiring.refresh(toy_bone_system.SYSTEM, other)
        self.assertIsNotNone(other.motus.bend.hub)
        self.second = (other, "A.1")
        self.assertEqual(self.levels(), [0, 1])

    def test_other_systems_entries_count(self):
        toy_bone_system.bend(self.rig, {"C.0": (self.rig, "A.1")}, system=toy_bone_system.NOD)
        self.second = (self.rig, "C.1")
        self.assertEqual(self.levels(), [0, 2])
        self.assertEqual(dependencies.levels(self.rig)["nod", "C.0"], 1)

    def test_cycles_of_the_users_end(self):
        self.constrain(self.first, 'COPY_LOCATION', target=self.second)
        self.constrain(self.second, 'COPY_LOCATION', target=self.first)
        self.assertEqual(self.levels(), [0, 0])

    def test_many_in_a_row(self):
        rig = toy_bone_system.new_rig("Long", chains=1, length=400)
        for index in range(0, 400, 2):
            entry = rig.motus.bend.entries.add()
            entry.name, entry.target = f"A.{index}", self.first
        found = dependencies.levels(rig)
        self.assertEqual([found["bend", f"A.{index}"] for index in range(0, 400, 2)], list(range(200)))


class GroupDataTest(BoneTestCase):
    """What a group keeps with its carrier."""

    def test_kinds_of_data(self):
        import dataclasses

        seen = {}
        data = {"text": "é\n\"", "number": 3, "real": 0.25, "many": [1, 2, 3], "reals": [0.5, 1.5], "none": ""}

        def solve(context):
            seen.update({key: list(value) if key in ("many", "reals") else value for key, value in context.data.items()})
            seen["group"] = context.group
            return

        core = support.addon("core.declare")
        system = dataclasses.replace(
            toy_bone_system.SYSTEM,
            solve=solve,
            groups=lambda owner: (
                core.Group(key="b", data=data, members=(core.Member(owner.pose.bones["A.0"], frozenset({"rotation"}), is_relative=True),)),
            ),
        )
        rig = toy_bone_system.new_rig()
        self.addCleanup(core.registered.__setitem__, "bend", toy_bone_system.SYSTEM)
        core.registered["bend"] = system
        wiring.attach(system, rig)
        path = str(self.folder / "data.blend")
        for step in ("wired", "reopened", "copied"):
            with self.subTest(step):
                seen.clear()
                if step == "reopened":
                    bpy.ops.wm.save_as_mainfile(filepath=path)
                    bpy.ops.wm.open_mainfile(filepath=path)
                if step == "copied":
                    rig = bpy.data.objects["Rig"]
                    copy = rig.copy()
                    bpy.context.scene.collection.objects.link(copy)
                    bpy.data.objects.remove(rig)
                bpy.context.scene.frame_set(7)
                self.assertEqual(seen, data | {"group": "b"})
