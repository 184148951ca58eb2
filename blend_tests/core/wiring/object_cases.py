"""Objects and bones that are driven on top of their own animation, as small scenes to test: KINDS."""

import bpy

import support
import toy_bone_system
import toy_sway_system
import toy_system
from core.wiring.bone_cases import without_attribute
from core.wiring.wiring_cases import WiringTestCase, each_of, frame_set

wiring = support.addon("core.wiring")
SYSTEM = toy_sway_system.SYSTEM
FRAMES = (10, 3, 55, 1.5, 54)


def keyed(thing, step=0.0):
    """A thing with keys on all its channels."""
    thing.rotation_mode = 'XYZ'
    for frame, factor in ((1, 0.2), (60, -0.7)):
        thing.location = (factor + step, 0.5 * factor, 1.0 - factor)
        thing.rotation_euler = (0.4 * factor, step + factor, 0.3)
        thing.scale = (1.0 + 0.3 * factor, 1.0, 1.2 + 0.5 * factor)
        for path in ("location", "rotation_euler", "scale"):
            thing.keyframe_insert(path, frame=frame)
    return thing


def build():
    """An owner, a child of a moving parent, and two that sway with one that sways, one of these mirrored."""
    owner = keyed(toy_system.new_object("Owner"))
    parent = keyed(toy_system.new_object("Parent"), 0.7)
    child, last, mirrored = (keyed(toy_system.new_object(name), 0.1 * place) for place, name in enumerate("ABC"))
    child.parent = parent
    child.matrix_parent_inverse = toy_sway_system.Matrix.LocRotScale((0.1, 0.2, 0.3), None, (1.5, 1.5, 1.5))
    mirrored.animation_data.action = None
    mirrored.scale = (-1.0, 1.2, 0.8)
    target = toy_system.new_target()
    toy_sway_system.sway(owner, (mirrored, last), (child, target), (last, child), (None, target))
    return owner


def build_driven():
    """The same where a channel is driven."""
    owner = build()
    for name in ("Owner", "A"):
        curve = bpy.data.objects[name].driver_add("location", 0)
        curve.driver.expression = "sin(frame)"
    wiring.refresh(SYSTEM, owner)
    return owner


def build_rig():
    """A rig whose bones and which itself sway, and an object that sways with it."""
    rig = toy_bone_system.new_rig()
    for name in ("A.0", "B.side"):
        keyed(rig.pose.bones[name])
    rig.data.bones["A.0"].use_local_location = False
    curve = rig.pose.bones["B.side"].driver_add("location", 1)
    curve.driver.expression = "0.1*sin(frame)"
    target = toy_system.new_target()
    other = keyed(toy_system.new_object("Other"))
    toy_sway_system.sway(rig, ("A.0", target), ("B.side", other), (other, target), (None, target))
    return rig


KINDS = (build, build_driven, build_rig, *map(without_attribute, (build, build_driven, build_rig)))
each_kind = each_of(KINDS)


def things(owner):
    return [toy_sway_system.driven(owner, entry) for entry in owner.motus.sway.entries]


def matrices(owner):
    """Evaluated matrices of all driven things: in world space, of bones in that of the rig."""
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for thing in things(owner):
        evaluated = thing.id_data.evaluated_get(graph)
        bone = isinstance(thing, bpy.types.PoseBone)
        found.append((evaluated.pose.bones[thing.name].matrix if bone else evaluated.matrix_world).copy())
    return found


def expected(owner, influence=1.0):
    """What these are to be, from the channels, parents and targets that are evaluated at the present frame."""
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for thing, entry in zip(things(owner), owner.motus.sway.entries):
        offset = toy_sway_system.offset(entry.target.evaluated_get(graph).matrix_world, influence)
        evaluated = thing.id_data.evaluated_get(graph)
        if isinstance(thing, bpy.types.PoseBone):
            bone = evaluated.pose.bones[thing.name]
            basis = toy_sway_system.on_top(bone.matrix_basis, *offset)
            found.append(evaluated.convert_space(pose_bone=bone, matrix=basis, from_space='LOCAL', to_space='POSE'))
            continue
        matrix = toy_sway_system.on_top(evaluated.matrix_basis, *offset)
        if thing.parent:
            matrix = thing.parent.evaluated_get(graph).matrix_world @ thing.matrix_parent_inverse @ matrix
        found.append(matrix)
    return found


class ObjectTestCase(WiringTestCase):
    """Tests with the system registered."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        support.register_systems(SYSTEM)
        cls.addClassCleanup(support.unregister_systems, SYSTEM)

    def assert_sways(self, owner, influence=1.0, frames=FRAMES):
        """All driven things stand as the system's definition says."""
        for frame in frames:
            frame_set(frame)
            for thing, found, wanted in zip(things(owner), matrices(owner), expected(owner, influence)):
                with self.subTest(thing=thing.name, frame=frame):
                    self.assert_same_matrix(found, wanted)

    def assert_untouched(self, owner):
        """All of them stand as their animation says."""
        self.assert_sways(owner, 0.0)
