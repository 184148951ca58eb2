"""Poses of every system as its solver gives them: 13 systems on three frames, and what chroma key finds in a picture.

Blender writes results into constraints and attributes in single precision, and versions differ in how they do it. So the numbers are taken where the
solver leaves them. What a solver is given by Blender is the same bits in every version in these scenes: bones along the axes, keyed locations.
"""

import contextlib
import hashlib
import json
from pathlib import Path

import bpy
import numpy as np

import support
from ik import ik_cases
from saved import make, saved_cases
from snow import snow_cases
from support import key, link

TABLE = Path(__file__).resolve().with_name("poses.json")
FRAMES = (37, 5, 100)
"""In an order that no playback has."""
SHORT = 24
"""Up to so many numbers of an array are written down, of a longer one a summary."""


def ik():
    """An arm of bones along the axes, with a pole and keyed weights, and a spine that stretches."""

    def bones(edit_bones):
        ik_cases.add_chain(edit_bones, "Arm", ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 1.0)), None)
        ik_cases.add_chain(edit_bones, "Spine", [(2.0, 0.0, 0.5 * index) for index in range(6)], None)

    made = make.rig("Rig", bones)
    key(link("Target"), "location", {1: (0.4, -0.5, 1.0), 60: (0.3, 0.5, 1.5)})
    key(link("Far"), "location", {1: (2.5, 0.0, 1.5), 50: (3.0, 1.0, 3.0)})
    link("Pole", None, (0.5, -2.0, 1.5))
    bpy.ops.motus.ik_add(object="Rig", bone="Arm 1", target="Target", pole="Pole", softness=0.1)
    bpy.ops.motus.ik_add(object="Rig", bone="Spine 4", target="Far", chain_length=0, stretch=1.0)
    key(made.motus.ik.entries["Arm 1"], "position_weight", {1: 1.0, 50: 0.4})


SCENES = {
    "path": make.path,
    "layers": make.layers,
    "walker": make.walker,
    "ik": ik,
    "look_at": make.look_at,
    "dynamics": make.dynamics,
    "pull": make.pull,
    "lattice": make.lattice,
    "pendulum": make.pendulum,
    "drivers": make.drivers,
    "snow": make.snow,
    "snow_cover": make.snow_cover,
    "stereo": make.stereo,
    "chroma": make.chroma,
}
SAME_BITS = {
    "layers": ("rotations",),
    "walker": ("Robot locations",),
    "pull": ("offsets",),
    "pendulum": ("Hook outputs",),
    "snow": ("flakes",),
}
"""What is the same bits by each compiler that docs/library.md names: arrays whose name contains one of these. The walker's are the feet, the pendulum's
the double one."""


def build(name):
    """The scene of a system, in an empty file."""
    support.empty_scene()
    bpy.context.scene.render.fps = 24
    bpy.context.scene.frame_set(1)
    SCENES[name]()
    bpy.context.view_layer.update()


def frames(name):
    """Those on which a system is looked at; a picture is the same on all."""
    return FRAMES[:1] if name == "chroma" else FRAMES


@contextlib.contextmanager
def told(name):
    """A dictionary that is filled, while Blender evaluates, with what a system's solvers leave in their contexts: {owner, group and array: numbers}."""
    found, kept = {}, []
    for system in support.addon("systems").SYSTEMS:
        for function in ("solve", "solve_rows"):
            solve = getattr(system, function, None)
            if solve and system.name == name:
                kept.append((system, function, solve))
                object.__setattr__(system, function, _noting(solve, found))
    try:
        yield found
    finally:
        for system, function, solve in kept:
            object.__setattr__(system, function, solve)


def _noting(solve, found):
    def noting(context, *arguments, **inputs):
        problem = solve(context, *arguments, **inputs)
        owner = context.owner.name if context.owner else "rows"
        for what in ("locations", "rotations", "scales", "outputs", "offsets"):
            numbers = getattr(context, what)
            if numbers is not None and len(numbers):
                found[" ".join(filter(None, (owner, context.group, what)))] = np.array(numbers)
        return problem

    return noting


def arrays(name, frame):
    """{what: array} of a system's scene on a frame."""
    with told(name) as found:
        support.go_to(frame)
        bpy.context.evaluated_depsgraph_get()
    if name == "snow":
        for obj in (bpy.data.objects["Snow"], bpy.data.objects["Snow.001"]):
            found |= {f"{obj.name} flakes {what}": array for what, array in snow_cases.flakes(obj).items()}
    elif name == "chroma":
        color, report = support.addon("chroma.analysis").measure(bpy.data.images["Footage"])
        found |= {"color": np.array(color)} | {what: np.ravel(numbers) for what, numbers in report.items()}
    elif name in {"lattice", "drivers"}:  # which have no solver of Motus
        found |= {what: np.array(numbers) for what, numbers in saved_cases.numbers(frame).items()}
    return found


def row(name, found):
    """What is kept of a pose: the bits of what is the same everywhere, as one number, and all numbers, of long arrays in short."""
    same = [what for what in sorted(found) if any(part in what for part in SAME_BITS.get(name, ()))]
    bits = hashlib.sha256(b"".join(np.ascontiguousarray(found[what]).tobytes() for what in same)).hexdigest() if same else ""
    return {"bits": bits, "numbers": {what: _in_short(found[what]) for what in sorted(found)}}


def _in_short(array):
    array = np.asarray(array, float)
    array = array.ravel() if array.size <= SHORT else saved_cases.in_short(array.reshape(len(array), -1))
    return [float(number) for number in array]


def poses(name):
    """{frame: what is kept} of a system's poses."""
    build(name)
    return {str(frame): row(name, arrays(name, frame)) for frame in frames(name)}


def table():
    """What is kept of all poses: {system: {frame: bits and numbers}}."""
    return json.loads(TABLE.read_text(encoding="utf-8"))
