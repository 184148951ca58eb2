"""The picture of the Lattice page, made through the add-on's own operators."""

import math

import bpy
import numpy as np
from mathutils import Vector

import stage

WIDTH = 4.1
CLAY, STEEL, PULL, HOLD = ((0.62, 0.30, 0.16, 1.0), (0.16, 0.20, 0.26, 1.0), (0.85, 0.20, 0.05, 1.0), (0.05, 0.30, 0.75, 1.0))
EAR, CHIN, CROWN = Vector((1.35, 0.0, 0.3)), Vector((0.0, -0.55, -0.95)), Vector((0.15, -0.35, 0.9))
RESOLUTION = (4, 4, 4)
# Where it is taken, how far it is pulled, across which axes that is repeated, and which place is held.
PULLS = (
    ("fitted", None, None, set(), None),
    ("pulled by a point", CROWN, Vector((0.25, -0.1, 0.75)), set(), None),
    ("mirrored, the chin held", EAR, Vector((0.42, 0.0, 0.3)), {'X'}, CHIN),
)


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [_render_pulls(folder / "lattice_pull.png")]


def _render_pulls(file):
    """A head with its lattice: at rest, pulled at the crown, and by both ears while the chin is held."""
    scene = stage.new_scene((0.72, 0.78, 0.86), 0.55)
    stage.add_floor(stage.glossy_material("Floor", (0.42, 0.47, 0.53, 1.0), 0.9)).location.z = -1.7
    stage.add_sun((math.radians(48), math.radians(-12), math.radians(-30)), 1.7, softness=6.0)
    for column, (label, *pull) in enumerate(PULLS):
        place = Vector(((column - 1) * WIDTH, 0.0, 0.0))
        _add_head(place, *pull)
        stage.add_text(label, place + Vector((0.0, -1.8, -1.62)), 0.27)
    stage.add_camera(scene, (0.0, -16.0, 2.6), (0.0, 0.0, 0.28), width=3.3 * WIDTH)
    return stage.render(scene, file, (1280, 480), samples=64)


def _add_head(place, start, displacement, mirror, held):
    bpy.ops.mesh.primitive_monkey_add(location=place)
    head = bpy.context.object
    head.data.materials.append(stage.glossy_material("Clay", CLAY, 0.55))
    head.modifiers.new("Subdivision", 'SUBSURF').levels = 2
    head.modifiers["Subdivision"].render_levels = 2
    for polygon in head.data.polygons:
        polygon.use_smooth = True
    bpy.ops.motus.lattice_fit(objects=head.name, resolution=RESOLUTION, margin=0.03)
    lattice = bpy.context.object
    if start:
        before = _nearest(head, place + start)
        stays = [_nearest(head, place + held)[0]] if held else []
        bpy.ops.motus.lattice_pull(
            object=head.name, vertex=before[0], displacement=displacement, mirror=mirror, held=", ".join(map(str, stays))
        )
        after = _points(head)
        # In front of the head, into which it would vanish.
        ends = [end + Vector((0.0, -1.5, 0.0)) for end in (before[1], Vector(after[before[0]].tolist()))]
        _add_arrow(*ends, PULL)
        if mirror:
            _add_arrow(*(Vector((2.0 * place.x - end.x, end.y, end.z)) for end in ends), PULL)
        for vertex in stays:
            _add_ball(Vector(after[vertex].tolist()), 0.07, HOLD)
    _add_cage(lattice)


def _points(obj):
    """(m, 3): the object's vertices in the world, with all modifiers."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    found = np.array([evaluated.matrix_world @ vertex.co for vertex in mesh.vertices])
    evaluated.to_mesh_clear()
    return found


def _nearest(obj, place):
    """(index, place) of the vertex nearest to a place."""
    points = _points(obj)
    index = int(((points - np.array(place)) ** 2).sum(axis=1).argmin())
    return index, Vector(points[index].tolist())


def _add_cage(lattice):
    """The lattice's lines, as they stand, and its points."""
    steel = bpy.data.materials.get("Steel") or stage.glossy_material("Steel", STEEL, 0.35, 0.6)
    matrix = lattice.matrix_world
    places = np.array([matrix @ point.co_deform for point in lattice.data.points])
    grid = places.reshape(*reversed(RESOLUTION), 3)
    for axis in range(3):
        lines = np.moveaxis(grid, axis, 2).reshape(-1, RESOLUTION[2 - axis], 3)
        for line in lines:
            stage.add_tube([Vector(point.tolist()) for point in line], 0.013, steel)
    for point in places:
        _add_ball(Vector(point.tolist()), 0.036, STEEL)


def _add_ball(place, radius, color):
    name = f"Ball {color}"
    material = bpy.data.materials.get(name) or stage.glossy_material(name, color, 0.4)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=place, segments=16, ring_count=8)
    bpy.context.object.data.materials.append(material)


def _add_arrow(start, end, color):
    name = f"Arrow {color}"
    material = bpy.data.materials.get(name) or stage.glossy_material(name, color, 0.4)
    neck = end - 0.16 * (end - start).normalized()
    stage.add_tube([start, neck], 0.026, material)
    tip = stage.add_tube([neck, end], 0.075, material)
    tip.data.splines[0].points[1].radius = 0.0
