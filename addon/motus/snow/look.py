"""What flakes look like: what the snow's modifier makes of its points."""

import math

import bpy

from ..core import wiring
from ..core.blender import helpers
from ..core.declare import registered
from ..core.file.choices import chosen
from ..core.file.pointers import pointed

KEY = "motus_flakes"
"""Custom property of what is made here, by which it is found again: which of these it is."""
ICE, GLOW, WHITE = "Motus Flake", "Motus Spark", "Motus Flake Points"
"""Materials."""
GLOW_STRENGTH = 12.0

# Of a crystal's arm along +X, of a flake of radius 1: half the width of the arm at its foot and near its tip, and
# (foot, length, half the width) of the twigs, which leave it by 60 degrees.
ARM_WIDTHS = 0.075, 0.05
TIP = 0.93
TWIGS = (0.32, 0.22, 0.045), (0.52, 0.30, 0.045), (0.74, 0.17, 0.035)
CORE = 0.2
# Of a petal of radius 1: (along, half the width, how far it is bent up) from its foot to its tip.
PETAL = (-0.9, 0.12, 0.22), (-0.3, 0.55, 0.02), (0.35, 0.75, 0.0), (0.85, 0.45, 0.14)


def dress(owner):
    """Let the flakes of an emitter look as its settings say.

    What the look before was made of stays until the snow is removed or the file is closed: somebody may have changed the material.
    """
    settings, system = owner.motus.snow, registered["snow"]
    if settings.look == 'POINTS':
        wiring.set_points_material(system, owner, _white())
    elif settings.look == 'COLLECTION':
        wiring.set_points_collection(system, owner, pointed(settings, "flakes"))
    else:
        wiring.set_points_object(
            system, owner, pointed(settings, "flake") if settings.look == 'OBJECT' else _shape(chosen(settings, "look"))
        )


def drop(owner):
    """Remove the materials and objects that were made for an emitter."""
    wiring.set_points_material(registered["snow"], owner, None)
    _drop_unused()


def _own(collection, what):
    """A material or object of this file that was made here before; None without one."""
    return next((one for one in collection if one.get(KEY) == what and one.library is None), None)


def _drop_unused():
    """Remove shapes and materials where no emitter has them any more."""
    for look in _SHAPES:
        shape = _own(bpy.data.objects, look)
        if shape is not None and shape.users == 0:
            mesh = shape.data
            bpy.data.objects.remove(shape)
            if mesh is not None and mesh.users == 0:
                bpy.data.meshes.remove(mesh)
    for name in (ICE, GLOW, WHITE):
        material = _own(bpy.data.materials, name)
        if material is not None and material.users == 0:
            bpy.data.materials.remove(material)


# --- the shapes ------------------------------------------------------------------------------------------------------


def _shape(look):
    """The shape of this file that goes by the name of a look: an object in no collection, which modifiers alone show."""
    found = _own(bpy.data.objects, look)
    if found is not None:
        return found
    name, build, material = _SHAPES[look]
    mesh = bpy.data.meshes.new("Flake")
    vertices, faces = build()
    mesh.from_pydata(vertices, [], faces)
    mesh.materials.append(material())
    shape = helpers.make(name, mesh, is_hidden=False)
    shape[KEY] = look
    return shape


def _crystal():
    """Vertices and faces of a flat crystal of radius 1 in the XY plane."""
    vertices, faces = [], []
    for arm in range(6):
        angle = arm * math.pi / 3.0
        foot, tip = ARM_WIDTHS
        _add(vertices, faces, angle, ((0.0, -foot), (TIP, -tip), (1.0, 0.0), (TIP, tip), (0.0, foot)))
        for start, length, width in TWIGS:
            for side in (1.0, -1.0):
                _add(vertices, faces, angle, _twig(start, length, width, side))
    corners = [(CORE * math.cos(corner * math.pi / 3.0), CORE * math.sin(corner * math.pi / 3.0)) for corner in range(6)]
    _add(vertices, faces, math.pi / 6.0, corners)
    return vertices, faces


def _twig(start, length, width, side):
    """Corners of a twig beside the arm, pointed at its end."""
    along = math.cos(math.pi / 3.0), side * math.sin(math.pi / 3.0)
    across = -along[1] * side, along[0] * side
    outline = ((0.0, -width), (0.85 * length, -0.8 * width), (length, 0.0), (0.85 * length, 0.8 * width), (0.0, width))
    corners = [(start + far * along[0] + off * across[0], far * along[1] + off * across[1]) for far, off in outline]
    return corners if side > 0.0 else corners[::-1]


def _add(vertices, faces, angle, corners):
    cosine, sine = math.cos(angle), math.sin(angle)
    faces.append(tuple(range(len(vertices), len(vertices) + len(corners))))
    vertices.extend((cosine * x - sine * y, sine * x + cosine * y, 0.0) for x, y in corners)


def _petal():
    """A petal, bent up at its ends and notched at its tip."""
    vertices = [place for x, width, z in PETAL for place in ((x, -width, z + 0.1), (x, 0.0, z), (x, width, z + 0.1))]
    rows = range(len(PETAL) - 1)
    return vertices, [(3 * row + side, 3 * row + 3 + side, 3 * row + 4 + side, 3 * row + 1 + side) for row in rows for side in (0, 1)]


def _speck():
    """Vertices and faces of an octahedron of radius 1, the shape of the flakes in the looks Speck and Spark."""
    vertices = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    return vertices, [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]


def _ice():
    """A surface in the flake's colour, which instances have from the points that they stand on."""
    return _own(bpy.data.materials, ICE) or _material(ICE, "ShaderNodeBsdfDiffuse", has_tint=True)


def _glow():
    """Light in the flake's colour."""
    found = _own(bpy.data.materials, GLOW)
    if found is None:
        found = _material(GLOW, "ShaderNodeEmission", has_tint=True)
        next(node for node in found.node_tree.nodes if node.type == 'EMISSION').inputs["Strength"].default_value = GLOW_STRENGTH
    return found


def _white():
    """White, as Cycles reads no colours of bare points."""
    return _own(bpy.data.materials, WHITE) or _material(WHITE, "ShaderNodeBsdfDiffuse", has_tint=False)


def _material(name, kind, has_tint):
    """A new material of one shader, white or in the colour of the instance. Few nodes, for the file's sake."""
    material = bpy.data.materials.new(name)
    material[KEY] = name
    if not material.use_nodes:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    shader, output = nodes.new(kind), nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 200.0
    links.new(shader.outputs[0], output.inputs["Surface"])
    shader.inputs["Color"].default_value = material.diffuse_color = 0.92, 0.95, 1.0, 1.0  # type: ignore[assignment]
    if has_tint:
        tint = nodes.new("ShaderNodeAttribute")
        tint.attribute_name, tint.attribute_type = "tint", 'INSTANCER'
        tint.location.x = -200.0
        links.new(tint.outputs["Color"], shader.inputs["Color"])
    return material


_SHAPES = {
    'FLAKE': ("Motus Flake", _crystal, _ice),
    'PETAL': ("Motus Petal", _petal, _ice),
    'SPECK': ("Motus Speck", _speck, _ice),
    'SPARK': ("Motus Spark", _speck, _glow),
}
"""Look -> name, function that gives vertices and faces, function that gives the material."""
