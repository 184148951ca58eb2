"""The ways in which results reach bones, each as a small animated rig to test: KINDS."""

from unittest import mock

import bpy

import support
import toy_bone_system
import toy_system
from core.wiring.wiring_cases import WiringTestCase, each_of, frame_set

capabilities = support.addon("core.blender.capabilities")
wiring = support.addon("core.wiring")
FRAMES = (10, 3, 55, 1.5, 54)


def build(chains=2, stretch=0.3, system=toy_bone_system.SYSTEM, **settings):
    """A keyed rig whose chains bend towards a moving target."""
    rig = toy_bone_system.animate(toy_bone_system.new_rig(chains=chains))
    target = toy_system.new_target()
    toy_bone_system.bend(
        rig, {f"{toy_bone_system.chain_name(chain)}.0": target for chain in range(chains)}, system=system, stretch=stretch, **settings
    )
    return rig


def build_few():
    """Two chains of two bones."""
    return build()


def build_without_stretch():
    """The same without scales and guards."""
    return build(stretch=0.0)


def build_many():
    """Many bones."""
    return build(chains=6)


def build_driven_setting():
    """One setting is driven, which the solver has to wait for."""
    rig = build()
    drive(rig, 'motus.bend.entries["A.0"].weight', "1.0+0.5*sin(frame)")
    wiring.refresh(toy_bone_system.SYSTEM, rig)
    return rig


def build_driven_channels():
    """Bones of a chain have drivers of their own."""
    rig = build()
    for name in ("A.0", "B.1"):
        rig.pose.bones[name].rotation_mode = 'XYZ'
        drive(rig, f'pose.bones["{name}"].rotation_euler', "sin(frame)", 0)
    wiring.refresh(toy_bone_system.SYSTEM, rig)
    return rig


def build_all_driven():
    """Both at once."""
    rig = build_driven_channels()
    drive(rig, 'motus.bend.entries["B.0"].weight', "1.0+0.5*cos(frame)")
    for curve in rig.animation_data.drivers:
        if curve.data_path.endswith("rotation_euler"):  # from 4.5 on, Blender may otherwise put the last frame's value back
            target = curve.driver.variables.new().targets[0]
            target.id, target.data_path = rig, "pass_index"
    wiring.refresh(toy_bone_system.SYSTEM, rig)
    return rig


def without_attribute(kind):
    """A kind as files from older Blenders have it."""

    def build_old():
        with mock.patch.object(capabilities, "has_geometry_attribute_constraint", return_value=False):
            return kind()

    build_old.__name__ = f"{kind.__name__}_without_attribute"
    return build_old


LASTING_KINDS = (build_few, build_without_stretch, build_many, build_driven_setting, build_driven_channels, build_all_driven)
"""Those that stay what they are when the rig is wired again."""
KINDS = (*LASTING_KINDS, *map(without_attribute, LASTING_KINDS))
each_kind = each_of(KINDS)
each_lasting_kind = each_of(LASTING_KINDS)


def drive(obj, path, expression, index=None):
    """A scripted driver without variables."""
    curve = obj.driver_add(path) if index is None else obj.driver_add(path, index)
    curve.driver.expression = expression


def poses(rig):
    """Evaluated pose matrices of all bones by name."""
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return {bone.name: bone.matrix.copy() for bone in evaluated.pose.bones}


class BoneTestCase(WiringTestCase):
    """Tests with the toy bone systems registered."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        toy_bone_system.register()
        cls.addClassCleanup(toy_bone_system.unregister)

    def assert_bent(self, rig, systems=(toy_bone_system.SYSTEM,), tolerance=1e-5):
        """All bones stand as the systems' definition says, at the present frame."""
        found = poses(rig)
        for name, wanted in toy_bone_system.expected(rig, systems).items():
            with self.subTest(bone=name):
                self.assert_same_matrix(found[name], wanted, tolerance)

    def assert_alive(self, rig, systems=(toy_bone_system.SYSTEM,)):
        """The same at several frames, and that the system does anything there."""
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig, systems)
        rig.motus.bend.influence = 0.0
        bpy.context.view_layer.update()
        own = poses(rig)
        self.assert_bent(rig, systems)
        rig.motus.bend.influence = 1.0
        bpy.context.view_layer.update()
        self.assertGreater(max((matrix.to_3x3().col[1] - own[name].to_3x3().col[1]).length for name, matrix in poses(rig).items()), 0.05)

    def assert_untouched(self, rig):
        """All bones stand as their animation says."""
        for frame in FRAMES:
            frame_set(frame)
            evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
            found = poses(rig)
            for bone in evaluated.data.bones:
                parent = found[bone.parent.name] if bone.parent else None
                wanted = toy_bone_system.own_pose(evaluated, bone, parent or bone.matrix_local.Identity(4))
                self.assert_same_matrix(found[bone.name], wanted)
