"""Rigs with chains, for their tests."""

import types

import bpy
import numpy as np

import support
from dynamics import dynamics_cases

go_to, key, matrix, tail, place = (
    dynamics_cases.go_to,
    dynamics_cases.key,
    dynamics_cases.matrix,
    dynamics_cases.tail,
    dynamics_cases.place,
)
LENGTH = 0.3  # of the bones of rope()


def system():
    return support.addon("chains").SYSTEM


def rope(count=4, chains=1, name="Rope", tilt=2.5):
    """The rig of the tests of dynamics, turned about X by an angle: its chains stand straight out from a root bone, which keys move along X.

    Without the turn they point straight up, where limp ones would stay.
    """
    rig = dynamics_cases.rope(count, chains, name)
    rig.rotation_euler.x = tilt
    return rig


def still_rope(count=4, chains=1, name="Rope", tilt=2.5):
    """A rope() that nothing moves."""
    rig = rope(count, chains, name, tilt)
    rig.animation_data_clear()
    rig.pose.bones["Root"].location = (0.0, 0.0, 0.0)
    return rig


def add(rig, bones="Tail 0 0", **settings):
    """The entries that motus.chains_add makes; keywords of the operator, and settings of the rig."""
    keywords = {name: settings.pop(name) for name in list(settings) if name in support.addon("chains.operators").KEYWORDS}
    bpy.ops.motus.chains_add(object=rig.name, bones=bones, **keywords)
    for name, value in settings.items():
        setattr(rig.motus.chains, name, value)
    bpy.context.view_layer.update()
    return rig.motus.chains.entries


def problem(rig):
    return support.addon("core.wiring").problem(system(), rig, bpy.context.evaluated_depsgraph_get())


def tails(rig, frame, names):
    """Where the tails of bones are on a frame, (n, 3)."""
    return np.array([tail(rig, frame, name) for name in names])


def chain(rig, number=0):
    return [bone.name for bone in rig.pose.bones if bone.name.startswith(f"Tail {number} ")]


def solver():
    return support.addon("core.native").module.StrandMotion


class _Spy:
    """The native module, which notes with what a StrandMotion is made."""

    def __init__(self, module):
        self._module, self.made = module, []

    def __getattr__(self, name):
        if name != "StrandMotion":
            return getattr(self._module, name)
        return self._strand

    def _strand(self, *arguments, **keywords):
        self.made.append(types.SimpleNamespace(parents=arguments[0], times=arguments[1], poses=arguments[2], **keywords))
        return self._module.StrandMotion(*arguments, **keywords)


def made(act):
    """With what StrandMotions are made, while act() is done and one frame is gone on."""
    native = support.addon("core.native")
    spy = native.module = _Spy(native.module)
    try:
        act()
        bpy.context.view_layer.update()
    finally:
        native.module = spy._module
    return spy.made
