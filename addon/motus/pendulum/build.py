"""Make rods and bobs, parent them to the pivot, and remove them: the functions that the operators call."""

import colorsys
import math
from typing import NamedTuple

import bpy
from mathutils import Matrix, Quaternion

from ..core import wiring
from ..core.blender import actions, datablocks
from ..core.declare import registered
from ..core.declare.forgetting import forget
from ..core.file import libraries
from ..core.file.pointers import pointed
from ..core.measures import units
from ..core.settings import lists
from . import directions, parts, trail

PREFIX = "motus.pendulum."
SIDES, RINGS, SEGMENTS = 16, 16, 32
SATURATION, VALUE = 0.85, 0.8


class Look(NamedTuple):
    """Sizes and colours of new rods and bobs.

    rod_radius: in m. bob_radius: of a bob of 1 kg, in m. spacing: distance between pendulums of a fan along the pivot's Y axis, in m.
    hue: of the first pendulum's colour, from 0 to 1.
    """

    rod_radius: float = 0.012
    bob_radius: float = 0.08
    spacing: float = 0.006
    hue: float = 0.0


def system():
    """Return the System of pendulums from the registry, because this module cannot import the package that imports it."""
    return registered["pendulum"]


def rebuild(pivot):
    """Adapt rods and bobs to the pivot's settings, then renew the drivers and constraints of the pendulum and its trail."""
    parts.fit(pivot)
    wiring.refresh(system(), pivot)
    own_trail = parts.own_trail(pivot)
    if own_trail:
        wiring.refresh(trail.system(), own_trail)


def new_pivot(context, name, place):
    """Make an empty as a new pivot in the active collection. place: its world matrix."""
    pivot = bpy.data.objects.new(name, None)
    pivot.matrix_world = place
    pivot.empty_display_type = 'SPHERE'
    pivot.empty_display_size = 0.05 / units.metres(context.scene)
    context.collection.objects.link(pivot)
    return pivot


def attach(context, owner, kind, count, keywords, look, bobs=(), has_made_pivot=False):
    """Make a pendulum, or a fan of `count` pendulums, on a pivot.

    owner: the pivot. kind: of the settings. keywords: {setting: value}. look: a Look.
    bobs: existing objects that become the bobs; if empty, bobs are made. has_made_pivot: whether the pivot is removed with the pendulum.
    """
    settings = owner.motus.pendulum
    settings.kind, settings.count, settings.has_made_pivot = kind, count, has_made_pivot
    for name, value in keywords.items():
        setattr(settings, name, value)
    collection = libraries.collection_for(context, owner)
    shapes = _shapes(settings, look, has_balls=not bobs)
    for index in range(count):
        material = _material(owner.name, (look.hue + index / count) % 1.0)
        _add(collection, owner, index, shapes, material, look, bobs)
    wiring.attach(system(), owner)


def angle_of(rod):
    """Return the angle between a rod, a vector in the pivot's space, and straight down, in radians; positive towards +X."""
    return math.atan2(rod.x, -rod.z)


def end_matrices(settings):
    """List the matrices of the ends of the first pendulum's rods at the start of the motion, in the pivot's space."""
    if settings.kind == 'SPHERICAL':
        turn = Quaternion(directions.turn(directions.of_angles(settings.angle1, settings.heading), 1.0))
        return [turn.to_matrix().to_4x4() @ Matrix.Translation((0.0, 0.0, -settings.length1))]
    matrix = Matrix()
    found, above = [], 0.0
    for length, angle in zip(parts.lengths(settings), (settings.angle1, settings.angle2)):
        matrix = matrix @ Matrix.Rotation(above - angle, 4, 'Y') @ Matrix.Translation((0.0, 0.0, -length))
        found.append(matrix)
        above = angle
    return found


def _add(collection, owner, index, shapes, material, look, bobs):
    settings = owner.motus.pendulum
    each, ends = parts.rods_each(settings), end_matrices(settings)
    parent = owner
    for rod_index, (rod_mesh, bob_mesh) in enumerate(shapes):
        number = index * each + rod_index
        suffix = f"{index + 1}.{rod_index + 1}" if settings.count > 1 else str(rod_index + 1)
        rod = _link(collection, f"{owner.name} Rod {suffix}", rod_mesh, parent, material)
        if rod_index == 0:
            rod.location.y = (index - 0.5 * (settings.count - 1)) * look.spacing
        entry = lists.add(settings.rods, rod.name)
        entry.number = number
        if bobs:
            _take(entry, bobs[rod_index], rod, owner.matrix_world @ ends[rod_index])
        else:
            entry.bob = _link(collection, f"{owner.name} Bob {suffix}", bob_mesh, rod, material)
        entry.object = rod
        parent = rod
    parts.fit(owner)


def _take(entry, bob, rod, end):
    """Parent an existing object to a rod as its bob, so that it keeps its place if the rod's end has the world matrix `end`."""
    entry.bob, entry.is_placed = bob, True
    entry.before, entry.rest = parts.values(bob.matrix_parent_inverse), parts.values(end.inverted_safe())
    bob.parent = rod


def _link(collection, name, mesh, parent, material):
    obj = bpy.data.objects.new(name, mesh)
    collection.objects.link(obj)
    obj.parent = parent
    # All pendulums of a fan share the meshes, so the material is assigned to the object instead of the mesh.
    (slot,) = obj.material_slots
    slot.link, slot.material = 'OBJECT', material
    return obj


def _shapes(settings, look, has_balls):
    """List (mesh of the rod, mesh of the bob or None) for each rod of one pendulum. has_balls: whether bobs are made."""
    masses = settings.mass1, settings.mass2
    thickest = max(look.rod_radius, 1e-5)
    return [
        (_rod(length, thickest), _ball(look.bob_radius * mass ** (1.0 / 3.0)) if has_balls else None)
        for length, mass in zip(parts.lengths(settings), masses)
    ]


def _rod(length, radius):
    """Make the mesh of a cylindrical rod from the origin down to z = -length."""
    ring = [(radius * math.cos(math.tau * i / SIDES), radius * math.sin(math.tau * i / SIDES)) for i in range(SIDES)]
    vertices = [(x, y, z) for z in (0.0, -length) for x, y in ring]
    sides = [(i, (i + 1) % SIDES, SIDES + (i + 1) % SIDES, SIDES + i) for i in range(SIDES)]
    caps = [tuple(range(SIDES))[::-1], tuple(range(SIDES, 2 * SIDES))]
    mesh = _mesh("Rod", vertices, [face[::-1] for face in sides] + [cap[::-1] for cap in caps])
    mesh[parts.MADE_KEY] = length
    for polygon in mesh.polygons[len(sides) :]:
        polygon.use_smooth = False
    return mesh


def _ball(radius):
    """Make the mesh of a bob: a sphere around the origin."""
    vertices, faces = [(0.0, 0.0, radius)], []
    for ring in range(1, RINGS):
        turn = math.pi * ring / RINGS
        vertices += [
            (
                radius * math.sin(turn) * math.cos(math.tau * i / SEGMENTS),
                radius * math.sin(turn) * math.sin(math.tau * i / SEGMENTS),
                radius * math.cos(turn),
            )
            for i in range(SEGMENTS)
        ]
    vertices.append((0.0, 0.0, -radius))
    last = len(vertices) - 1
    for i in range(SEGMENTS):
        following = (i + 1) % SEGMENTS
        faces.append((0, 1 + i, 1 + following))
        faces.append((last, last - SEGMENTS + following, last - SEGMENTS + i))
        for ring in range(RINGS - 2):
            above, below = 1 + ring * SEGMENTS, 1 + (ring + 1) * SEGMENTS
            faces.append((above + i, below + i, below + following, above + following))
    mesh = _mesh("Bob", vertices, faces)
    mesh[parts.MADE_KEY] = 0.0
    return mesh


def _mesh(name, vertices, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.materials.append(None)
    mesh.update()
    return mesh


def _material(name, hue):
    """Make a glossy material of a hue from 0 to 1."""
    color = (*colorsys.hsv_to_rgb(hue, SATURATION, VALUE), 1.0)
    material = bpy.data.materials.new(name)
    material.diffuse_color = color  # type: ignore[assignment]
    if not material.use_nodes:
        material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == 'BSDF_PRINCIPLED')
    shader.inputs["Base Color"].default_value = color
    shader.inputs["Roughness"].default_value = 0.25
    shader.inputs["Metallic"].default_value = 0.35
    return material


def clear(owner, keeps_objects):
    """Remove a pendulum: its drivers and constraints, the keys of its settings, its trail, and the settings themselves.

    owner: the pivot. keeps_objects: whether the rods, bobs and pivot that Motus has made stay in the file.
    """
    settings = owner.motus.pendulum
    entries = [
        (pointed(entry, "object"), pointed(entry, "bob"), entry.is_placed, parts.matrix(entry.before)) for entry in parts.own_rods(owner)
    ]
    made_pivot = settings.has_made_pivot
    trail.remove(owner)
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    for rod, bob, is_placed, before in entries:
        if bob and is_placed and bob.parent == rod:
            bob.parent, bob.matrix_parent_inverse = None, before
        forget(system(), rod)
    forget(system(), owner)
    if keeps_objects:
        return
    made = [obj for rod, bob, is_placed, _ in entries for obj in (rod, None if is_placed else bob) if obj]
    datablocks.remove_objects([*made, *([owner] if made_pivot else [])])


def free(rod, keeps_objects):
    """Free a rod without a pendulum, such as a duplicated rod, from its constraints.

    If the pivot of the rod's pendulum does not exist any more, all rods, bobs and trails that are left of the pendulum are treated.
    keeps_objects: whether the rods and bobs stay in the file. Trails are always removed.
    """
    rods = wiring.abandoned(system(), rod)
    bobs, trails = parts.left_with(rods)
    for obj in trails:
        trail.discard(obj)
    freed = rods or [rod]
    wiring.release(system(), *freed)
    for obj in freed:
        forget(system(), obj)
    if not keeps_objects:
        datablocks.remove_objects([*rods, *bobs])
