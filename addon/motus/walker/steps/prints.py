"""Footprints: an object with a mark on the ground for each step of a walker, which shows the marks that are made so far.

The object is plain Blender: its marks know when they are made, and Geometry Nodes leave out those of later times.
"""

import math

import bpy
from mathutils import Matrix, Quaternion, Vector

from ...core.blender import node_groups
from ...core.file.pointers import pointed
from ...core.lazy import numpy as np
from ...core.measures import axes, scene_time
from ...core.refusals import Refused
from ...core.translations import tr
from .. import carrier
from . import chosen

TOUCH = "touch"
"""Name of the marks' attribute: the frame, after Time Stretching, on which the foot touches the ground."""
GROUP, MATERIAL = "Motus Footprints", "Motus Footprint"
COLOR = 0.05, 0.04, 0.03, 1.0
CORNERS, RINGS = 16, (0.55, 1.0)
"""Points around a mark, and how far its rings of points are from its middle, as shares of its size."""
BROADER = 0.18
"""How much broader a mark is at the toe, and narrower at the heel."""
LIFT = 0.02
"""Height of a mark above the ground, as a share of its width."""
USUAL_LENGTH, USUAL_WIDTH = 0.3, 0.4
"""Length of a mark as a share of the stride, if soles do not tell it, and width as a share of the length."""


def add(context, owner, length, width):
    """Add the footprints of a walker as it is planned now; returns the object. owner: original object that walks.

    length, width: of a mark, m; 0 for what suits the walker. Raises Refused if the walker takes no step.
    """
    arrays = chosen.planned(context, owner)
    if not len(arrays["leg"]):
        raise Refused(tr("{object} takes no step").format(object=owner.name))
    settings = owner.motus.walker
    scale = abs(owner.matrix_world.median_scale)
    length = length or scale * (settings.heel + settings.toe if settings.use_soles else USUAL_LENGTH * settings.stride)
    width = width or USUAL_WIDTH * length
    name = tr("{object} Footprints").format(object=owner.name)
    mesh = bpy.data.meshes.new(name)
    points, faces = _mark()
    count = len(arrays["leg"])
    places = _places(settings, scale, arrays, points * (width, length, LIFT * width))
    shifted = (np.arange(count)[:, None, None] * len(points) + np.array(faces)).reshape(-1, 4)
    # The middle is a corner of a triangle, which is written as a quadrilateral that has it twice.
    mesh.from_pydata(places.reshape(-1, 3).tolist(), [], [list(dict.fromkeys(face)) for face in shifted.tolist()])
    touches = mesh.attributes.new(TOUCH, 'FLOAT', 'POINT')
    frames = arrays["touch"] * scene_time.fps(context.scene)
    touches.data.foreach_set("value", np.repeat(frames, len(points)).astype(np.float32))
    mesh.materials.append(_material())
    found = bpy.data.objects.new(name, mesh)
    for collection in owner.users_collection or (context.scene.collection,):
        collection.objects.link(found)
    _hang(found, settings)
    _wrap(found, settings, LIFT * width)
    found.modifiers.new(GROUP, 'NODES').node_group = _group()
    return found


def _mark():
    """(points (n, 3), faces): a mark of length and width 1, its toe along +Y, in the plane Z = 1."""
    turns = np.arange(CORNERS) * math.tau / CORNERS
    rim = np.stack([0.5 * np.sin(turns) * (1.0 + BROADER * np.cos(turns)), 0.5 * np.cos(turns), np.zeros(CORNERS)], axis=1)
    points = np.concatenate([np.zeros((1, 3)), *(share * rim for share in RINGS)]) + (0.0, 0.0, 1.0)
    faces = []
    for corner in range(CORNERS):
        after = (corner + 1) % CORNERS
        faces.append((0, 0, 1 + after, 1 + corner))
        faces.append((1 + corner, 1 + after, 1 + CORNERS + after, 1 + CORNERS + corner))
    return points, faces


def _places(settings, scale, arrays, points):
    """Points (steps, n, 3) of all marks, in the space of the plan. points: (n, 3), of a mark along +Y, X to its right, Z up."""
    ahead, up = Vector(axes.vector(settings.forward_axis)), Vector(axes.vector(settings.up_axis))
    axes_of_mark = np.array((ahead.cross(up), ahead, up))
    middle = 0.5 * (settings.toe - settings.heel) if settings.use_soles else 0.0
    beneath = scale * (middle * np.array(ahead) - settings.ankle * np.array(up))
    own = points @ axes_of_mark + beneath
    turns = np.array([Quaternion(turn).to_matrix() for turn in arrays["turn"]])
    return np.einsum("sij,nj->sni", turns, own) + arrays["end"][:, None]


def _hang(found, settings):
    """Hang the footprints on the walker's carrier, if it has one, whose scale they do not get."""
    carried_by = carrier.of(settings)
    if carried_by is not None:
        found.parent = carried_by
        found.matrix_parent_inverse = Matrix.Diagonal((*carried_by.matrix_world.to_scale(), 1.0)).inverted_safe()


def _wrap(found, settings, lift):
    """Lay the marks on the ground, if it is a single mesh."""
    ground = pointed(settings, "ground")
    if ground is not None and pointed(settings, "grounds") is None:
        wrap = found.modifiers.new("Shrinkwrap", 'SHRINKWRAP')
        wrap.target, wrap.wrap_method, wrap.wrap_mode, wrap.offset = ground, 'NEAREST_SURFACEPOINT', 'ABOVE_SURFACE', lift


def _group():
    """The node group that leaves out marks whose time has not come, made if the file does not have it."""
    known = bpy.data.node_groups.get((GROUP, None))
    if known is not None:
        return known
    group = bpy.data.node_groups.new(GROUP, 'GeometryNodeTree')
    node_groups.add_sockets(group, [("Geometry", 'INPUT', "NodeSocketGeometry"), ("Geometry", 'OUTPUT', "NodeSocketGeometry")])
    entry = node_groups.add_node(group, "NodeGroupInput")
    touch = node_groups.named_attribute(group, TOUCH, 'FLOAT')
    now = node_groups.add_node(group, "GeometryNodeInputSceneTime")
    later = node_groups.add_node(group, "FunctionNodeCompare", data_type='FLOAT', operation='GREATER_THAN')
    rest = node_groups.add_node(group, "GeometryNodeDeleteGeometry", domain='POINT')
    group.links.new(touch, node_groups.enabled(later.inputs, "A"))
    group.links.new(now.outputs["Frame"], node_groups.enabled(later.inputs, "B"))
    group.links.new(entry.outputs["Geometry"], rest.inputs["Geometry"])
    group.links.new(later.outputs["Result"], rest.inputs["Selection"])
    exit_node = node_groups.add_node(group, "NodeGroupOutput")
    group.links.new(rest.outputs["Geometry"], exit_node.inputs["Geometry"])
    return group


def _material():
    known = bpy.data.materials.get((MATERIAL, None))
    if known is not None:
        return known
    made = bpy.data.materials.new(MATERIAL)
    made.use_nodes = True
    shader = next(node for node in made.node_tree.nodes if node.type == 'BSDF_PRINCIPLED')
    made.diffuse_color = COLOR  # type: ignore[assignment]
    shader.inputs["Base Color"].default_value = COLOR
    shader.inputs["Roughness"].default_value = 0.9
    return made
