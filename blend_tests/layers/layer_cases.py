"""What the tests of layers share: a figure that walks, actions for it, and where its bones really are."""

import math

import bpy
from mathutils import Quaternion, Vector

import support
from look_at.look_at_cases import BONES, LookAtTestCase, build_rig

WALKING = {
    "Hips": (0.2, 0.0, 0.3),
    "Chest": (0.1, 0.4, 0.0),
    "UpperArm.L": (0.5, 0.0, 0.1),
    "LowerArm.L": (0.3, 0.2, 0.0),
    "Thigh.L": (0.7, 0.0, 0.0),
}
THROWING = {
    "Hips": (0.0, 0.0, 0.0),
    "Chest": (0.0, -0.6, 0.2),
    "UpperArm.L": (-1.4, 0.3, 0.6),
    "LowerArm.L": (-0.8, 0.0, 0.4),
    "Thigh.L": (-0.3, 0.0, 0.5),
}
FIRST, LAST = 1, 21


def quaternion(angles):
    """Of turns about X, Y, Z, one after the other."""
    return Quaternion((0, 0, 1), angles[2]) @ Quaternion((0, 1, 0), angles[1]) @ Quaternion((1, 0, 0), angles[0])


def new_action(name, keys):
    """An action for an object. keys: {(data path, index): [(frame, value), ...]}."""
    action = bpy.data.actions.new(name)
    holder = bpy.data.objects.new(name, None)
    support.addon("core.blender.actions").assign(holder, action)
    bag = support.addon("core.blender.actions").assign_copy(holder, name)
    made = holder.animation_data.action
    for (path, index), points in keys.items():
        curve = bag.fcurves.new(path, index=index)
        for frame, value in points:
            curve.keyframe_points.insert(frame, value)
        curve.update()
    made.use_fake_user = True
    bpy.data.objects.remove(holder)
    bpy.data.actions.remove(action)
    made.name = name
    return made


def turning(name, turns, first=FIRST, last=LAST):
    """An action that turns bones from rest to what their angles say."""
    keys = {}
    for bone, angles in turns.items():
        end = quaternion(angles)
        for index in range(4):
            keys[f'pose.bones["{bone}"].rotation_quaternion', index] = [
                (first, Quaternion()[index]),
                ((first + last) / 2, Quaternion().slerp(end, 0.7)[index]),
                (last, end[index]),
            ]
    return new_action(name, keys)


def play(rig, action):
    """Let an action be the rig's own."""
    actions = support.addon("core.blender.actions")
    slot = actions.slots_for_objects(action)[0].identifier if hasattr(action, "slots") else ""
    actions.assign(rig, action, slot)


class LayerTestCase(LookAtTestCase):
    """A figure "Rig" whose own action is "Walk", and an action "Throw"."""

    def setUp(self):
        super().setUp()
        self.system = support.addon("layers").SYSTEM
        self.actions = support.addon("core.blender.actions")
        self.walk, self.throw = turning("Walk", WALKING), turning("Throw", THROWING)
        self.play(self.rig, self.walk)
        bpy.context.view_layer.update()

    play = staticmethod(play)

    def add(self, rig="Rig", **keywords):
        """Add a layer; returns it."""
        keywords.setdefault("action", "Throw")
        keywords.setdefault("start", float(FIRST))
        keywords.setdefault("after", 'HOLD')
        self.assertEqual(bpy.ops.motus.layer_add(object=rig, **keywords), {'FINISHED'})
        return bpy.data.objects[rig].motus.layers.entries[-1]

    def own(self, bone, rig=None):
        """Transform of an evaluated bone on its parent, from its constraints too."""
        rig = self.evaluated(rig)
        posed = rig.pose.bones[bone]
        return rig.convert_space(pose_bone=posed, matrix=posed.matrix, from_space='POSE', to_space='LOCAL')

    def played(self, action, frame, rig="Reference"):
        """{bone: own transform} of the figure that plays an action alone."""
        figure = bpy.data.objects.get(rig) or build_rig(name=rig)
        self.play(figure, action)
        self.go_to(frame)
        return {name: self.own(name, figure) for name in BONES}

    def assertSameTurn(self, found, wanted, message="", tolerance=2e-6):
        """Two matrices turn alike."""
        found, wanted = found.to_quaternion().normalized(), wanted.to_quaternion().normalized()
        self.assertGreater(abs(found.dot(wanted)), math.cos(max(tolerance, 1e-6)) - 2e-7, message)
        worst = max(abs(a - b) for a, b in zip(found, wanted if found.dot(wanted) > 0 else -wanted))
        self.assertLess(worst, tolerance, message)

    def assertSamePlace(self, found, wanted, tolerance=2e-6):
        self.assertLess((Vector(found) - Vector(wanted)).length, tolerance)
