"""Trails: the ways that the end bobs have come, as tubes in the bobs' colours, computed anew on each frame."""

from dataclasses import dataclass

import bpy

from ..core import wiring
from ..core.blender import datablocks
from ..core.declare import Matrix, Points, Problem, Setting, Variable, registered
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.refusals import INFINITE
from . import clock, parts, pivot_motion, solve

RATE = 60.0  # places of a trail in a second
MOST = 20_000  # places of one trail
MATERIAL = "Motus Trail"
PLAIN = (0.8, 0.8, 0.8)

NO_PENDULUM = Problem("The pendulum of this trail is gone")
NOT_FINITE = Problem("A setting of the trail is not a finite number")
UNBAKEABLE = Problem("A trail is computed from the pendulum on each frame: there is nothing to bake")
PROBLEMS = (NO_PENDULUM, NOT_FINITE, *(problem for problem in solve.PROBLEMS if problem.blocking))
# Cycles has an own sense for an attribute that is named "color", which comes out black (5.2).
POINTS = Points(attributes=(("curve", 'INT'), ("radius", 'FLOAT'), ("tint", 'COLOR'), ("age", 'FLOAT')), shape='TUBES', space='LOCAL')


@dataclass(frozen=True)
class PivotInfluence:
    """The influence of the pendulum whose trail it is: the trail waits for its settings."""

    name: str

    @staticmethod
    def variable(_owner, settings):
        pivot = pointed(settings, "pivot")
        return pivot and Variable('OBJECT', pivot, "motus.pendulum.influence")

    @staticmethod
    def read(value, _settings):
        return value


INPUTS = (Matrix("matrix", of="pivot"), PivotInfluence("swing"), Setting("seconds"), Setting("fade"), Setting("thickness"))


def make(context, matrix, swing, seconds, fade, thickness):
    """The solver: tubes in the pivot's space."""
    pivot = context.target("pivot")
    if pivot is None or matrix is None or not parts.has_pendulum(pivot):
        return NO_PENDULUM
    if not all(abs(value) < INFINITE for value in (swing, seconds, fade, thickness)):
        return NOT_FINITE
    settings, scene = pivot.motus.pendulum, context.depsgraph.scene
    found = solve.swing_of(settings, scene)
    if isinstance(found, Problem):
        return found
    now = clock.read(pivot, settings, context.frame, context.fps)
    felt = pivot_motion.felt(pivot, scene, now.rate)[0] if settings.use_pivot_motion else {}
    times = _times(now.seconds, max(seconds, 0.0))
    if len(times) < 2 or thickness <= 0.0:
        return None
    try:
        found.at(now.seconds, **felt)  # all at once, which is sooner, or refused where they are too many for so long a time
        ways = [found.way(times, number, **felt)[:, : found.each] for number in range(found.count)]
    except ValueError:
        return solve.unknown(now.seconds, found.count)
    _fill(context.points(len(times) * found.count), pivot, ways, np.abs(now.seconds - times) / seconds, (swing, fade, thickness))
    return None


def _times(now, length):
    """Rising seconds of the trail, whose places stay where they are as time goes on, but for its ends."""
    first, last = (max(0.0, now - length), now) if now >= 0.0 else (now, min(0.0, now + length))
    step = max(1.0 / RATE, (last - first) / MOST)
    inner = step * np.arange(np.floor(first / step) + 1.0, np.ceil(last / step))
    return np.concatenate(([first], inner, [last])) if last > first else np.empty(0)


def _fill(points, pivot, ways, ages, looks):
    swing, fade, thickness = looks
    settings, count = pivot.motus.pendulum, len(ages)
    lengths, shares = np.array(parts.lengths(settings)), 1.0 - fade * ages
    colors, offsets = _of_bobs(settings)
    for number, angles in enumerate(ways):
        rows = slice(number * count, (number + 1) * count)
        if len(points["curve"][rows]) < count:  # there is no room for more
            points["radius"][rows], points["tint"][rows], points["age"][rows] = 0.0, 0.0, 0.0
            points["position"][rows], points["curve"][rows] = 0.0, -1
            continue
        # NumPy's sine is not always the same; its complex exponential is.
        turned = np.exp(1j * (swing * angles))
        points["position"][rows, 0] = turned.imag @ lengths
        points["position"][rows, 1] = offsets.get(number, 0.0)
        points["position"][rows, 2] = -(turned.real @ lengths)
        points["curve"][rows] = number
        points["radius"][rows] = thickness * shares
        points["tint"][rows, :3] = colors.get(number, PLAIN)
        points["tint"][rows, 3] = shares
        points["age"][rows] = ages


def _of_bobs(settings):
    """({index of the pendulum in the fan: colour of its end bob}, {index: offset of its upper rod along the pivot's Y axis, m})."""
    each, colors, offsets = parts.rods_each(settings), {}, {}
    for entry in settings.rods:
        number, rod = divmod(entry.number, each)
        # Blender may be making evaluated copies of these at this very time: the solver waits for the pivot alone.
        thing, bob = (one and one.original for one in (pointed(entry, "object"), pointed(entry, "bob")))
        if rod == 0 and thing:
            offsets[number] = thing.location.y
        slots = bob.material_slots if bob else ()
        if rod == each - 1 and len(slots) and slots[0].material:  # type: ignore[misc]
            colors[number] = tuple(slots[0].material.diffuse_color)[:3]  # type: ignore[misc]
    return colors, offsets


# --- making and removing ---------------------------------------------------------------------------------------------


def system():
    """The registered System of trails."""
    return registered["pendulum_trail"]


def add(collection, pivot, keywords):
    """Give a pendulum a trail, or the trail that it has other settings."""
    obj = parts.own_trail(pivot)
    if obj is None:
        name = f"{pivot.name} Trail"
        obj = pivot.motus.pendulum.trail = bpy.data.objects.new(name, bpy.data.meshes.new(name))
        collection.objects.link(obj)
        obj.parent = pivot
    found = obj.motus.pendulum_trail
    found.pivot = pivot
    found.rod = next(iter(parts.members(pivot)), None)
    for name, value in keywords.items():
        setattr(found, name, value)
    wiring.attach(system(), obj)
    dress(obj)


def dress(obj):
    """Give a trail its material."""
    wiring.set_points_material(system(), obj, _material())


def remove(pivot):
    """Take the trail of a pendulum away."""
    obj, pivot.motus.pendulum.trail = parts.own_trail(pivot), None
    if obj and not obj.library:
        discard(obj)


def discard(obj):
    """Remove a trail that no pendulum names."""
    if wiring.is_attached(system(), obj):
        # With a modifier whose hub is gone Blender 5 does not count the material's user down.
        wiring.set_points_material(system(), obj, None)
        wiring.detach(system(), obj)
    datablocks.remove_objects([obj])
    material = bpy.data.materials.get((MATERIAL, None))
    if material and material.users == 0:
        bpy.data.materials.remove(material)


def _material():
    """Light in the colour of the bob, that vanishes with age."""
    found = bpy.data.materials.get((MATERIAL, None))
    if found:
        return found
    material = bpy.data.materials.new(MATERIAL)
    if not material.use_nodes:
        material.use_nodes = True
    if not hasattr(material, "surface_render_method"):  # of the EEVEE before Blender 4.2
        material.blend_method = 'HASHED'
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    color, light, nothing, mixed, output = (
        nodes.new(kind)
        for kind in (
            "ShaderNodeAttribute",
            "ShaderNodeEmission",
            "ShaderNodeBsdfTransparent",
            "ShaderNodeMixShader",
            "ShaderNodeOutputMaterial",
        )
    )
    for index, node in enumerate((color, light, nothing, mixed, output)):
        node.location.x = 200.0 * index
    color.attribute_name = "tint"
    links.new(color.outputs["Color"], light.inputs["Color"])
    for source, target in (
        (color.outputs["Alpha"], mixed.inputs[0]),
        (nothing.outputs[0], mixed.inputs[1]),
        (light.outputs[0], mixed.inputs[2]),
        (mixed.outputs[0], output.inputs["Surface"]),
    ):
        links.new(source, target)
    return material
