"""Trails: the recent paths of the end bobs, as tubes in the bobs' colours, computed anew on each frame."""

from dataclasses import dataclass

import bpy

from ..core import wiring
from ..core.blender import datablocks
from ..core.declare import Matrix, Points, Problem, Setting, Variable, registered
from ..core.file.pointers import pointed
from ..core.lazy import numpy as np
from ..core.refusals import INFINITE
from . import clock, directions, parts, pivot_motion, solve

RATE = 60.0  # points of a trail per second
MOST = 20_000  # greatest number of points of one trail
MATERIAL = "Motus Trail"
PLAIN = (0.8, 0.8, 0.8)

NO_PENDULUM = Problem("The pendulum of this trail is gone")
NOT_FINITE = Problem("A setting of the trail is not a finite number")
UNBAKEABLE = Problem("A trail is computed from the pendulum on each frame: there is nothing to bake")
PROBLEMS = (NO_PENDULUM, NOT_FINITE, *(problem for problem in solve.PROBLEMS if problem.blocking))
# The attribute is not named "color", because Cycles gives this name a special meaning and renders it black (Blender 5.2).
POINTS = Points(attributes=(("curve", 'INT'), ("radius", 'FLOAT'), ("tint", 'COLOR'), ("age", 'FLOAT')), shape='TUBES', space='LOCAL')


@dataclass(frozen=True)
class PivotInfluence:
    """Input of the trail's solver: the influence of the trail's pendulum. It makes the trail wait for the pendulum's settings."""

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
    """Compute the points of the trail's tubes in the pivot's space. This is the solver of trails; it returns a Problem or None.

    matrix: world matrix of the pivot. swing: influence of the pendulum. seconds: length of the trail in time. fade: how much the
    trail vanishes towards its end, from 0 to 1. thickness: radius in m.
    """
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
    felt = pivot_motion.felt(pivot, scene, now.rate, found.is_spherical)[0] if settings.use_pivot_motion else {}
    times = _times(now.seconds, max(seconds, 0.0))
    if len(times) < 2 or thickness <= 0.0:
        return None
    if found.takes_too_long(now.seconds, pivot, context.depsgraph):
        return solve.FAN_TOO_FAR
    try:
        found.at(now.seconds, **felt)  # computes all pendulums together, which is faster; raises if they are too many for so long a time
        ways = [found.way(times, number, **felt) for number in range(found.count)]
    except ValueError:
        return solve.unknown(now.seconds, found.count)
    lengths = parts.lengths(settings)
    ends = [directions.ends(found, states, lengths, swing) for states in ways]
    _fill(context.points(len(times) * found.count), pivot, ends, np.abs(now.seconds - times) / seconds, fade, thickness)
    return None


def _times(now, length):
    """Return the times of the trail's points, rising, in seconds of the pendulum's own time; empty if the trail has no length.

    Except at the ends they are multiples of a fixed step, so that the points do not move as time goes on.
    now: present time. length: of the trail. A trail does not reach beyond the start, time 0.
    """
    first, last = (max(0.0, now - length), now) if now >= 0.0 else (now, min(0.0, now + length))
    step = max(1.0 / RATE, (last - first) / MOST)
    inner = step * np.arange(np.floor(first / step) + 1.0, np.ceil(last / step))
    return np.concatenate(([first], inner, [last])) if last > first else np.empty(0)


def _fill(points, pivot, ends, ages, fade, thickness):
    count, shares = len(ages), 1.0 - fade * ages
    colors, offsets = _of_bobs(pivot.motus.pendulum)
    for number, places in enumerate(ends):
        rows = slice(number * count, (number + 1) * count)
        if len(points["curve"][rows]) < count:  # the mesh has no room for further points
            points["radius"][rows], points["tint"][rows], points["age"][rows] = 0.0, 0.0, 0.0
            points["position"][rows], points["curve"][rows] = 0.0, -1
            continue
        points["position"][rows] = places
        points["position"][rows, 1] += offsets.get(number, 0.0)
        points["curve"][rows] = number
        points["radius"][rows] = thickness * shares
        points["tint"][rows, :3] = colors.get(number, PLAIN)
        points["tint"][rows, 3] = shares
        points["age"][rows] = ages


def _of_bobs(settings):
    """Return ({index of the pendulum in the fan: colour of its end bob}, {index: offset of its upper rod along the pivot's Y axis, m})."""
    each, colors, offsets = parts.rods_each(settings), {}, {}
    for entry in settings.rods:
        number, rod = divmod(entry.number, each)
        # Originals are read, because Blender may be making the evaluated copies at this moment: the solver only waits for the pivot.
        thing, bob = (one and one.original for one in (pointed(entry, "object"), pointed(entry, "bob")))
        if rod == 0 and thing:
            offsets[number] = thing.location.y
        slots = bob.material_slots if bob else ()
        if rod == each - 1 and len(slots) and slots[0].material:  # type: ignore[misc]
            colors[number] = tuple(slots[0].material.diffuse_color)[:3]  # type: ignore[misc]
    return colors, offsets


# --- making and removing ---------------------------------------------------------------------------------------------


def system():
    """Return the System of trails from the registry, because this module cannot import the package that imports it."""
    return registered["pendulum_trail"]


def add(collection, pivot, keywords):
    """Add a trail to a pendulum, or change the settings of its existing trail.

    collection: of a new trail object. keywords: {setting: value}.
    """
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
    """Assign the material of trails to a trail object; the material is made if it does not exist."""
    wiring.set_points_material(system(), obj, _material())


def remove(pivot):
    """Remove the trail of a pendulum, if it has one. pivot: of the pendulum."""
    obj, pivot.motus.pendulum.trail = parts.own_trail(pivot), None
    if obj and not obj.library:
        discard(obj)


def discard(obj):
    """Remove a trail object to which no pendulum points any more."""
    if wiring.is_attached(system(), obj):
        # Otherwise Blender 5 keeps counting the material's user after the hub (hidden object with the solver's results) is removed.
        wiring.set_points_material(system(), obj, None)
        wiring.detach(system(), obj)
    datablocks.remove_objects([obj])
    material = bpy.data.materials.get((MATERIAL, None))
    if material and not datablocks.is_used(material):
        bpy.data.materials.remove(material)


def _material():
    """Return the material of trails, which is made if it does not exist: it emits the bob's colour and becomes transparent with age."""
    found = bpy.data.materials.get((MATERIAL, None))
    if found:
        return found
    material = bpy.data.materials.new(MATERIAL)
    if not material.use_nodes:
        material.use_nodes = True
    if not hasattr(material, "surface_render_method"):  # EEVEE before Blender 4.2
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
