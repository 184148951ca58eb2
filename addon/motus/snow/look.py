"""Look of flakes: the materials and objects with which the emitter's modifier shows its points."""

import math

import bpy

from ..core import wiring
from ..core.blender import datablocks, helpers
from ..core.declare import registered
from ..core.file.choices import chosen
from ..core.file.pointers import pointed

KEY = "motus_flakes"
"""Custom property of the objects and materials that this module makes. Its value, a look or a name, tells them apart."""
ICE, GLOW, WHITE = "Motus Flake", "Motus Spark", "Motus Flake Points"
"""Names of the materials that this module makes."""
GLOW_STRENGTH = 12.0

# The arm along +X of a crystal of radius 1: half its width at the foot and near the tip, and (position on the arm, length, half the
# width) of its twigs, which leave the arm at 60 degrees.
ARM_WIDTHS = 0.075, 0.05
TIP = 0.93
TWIGS = (0.32, 0.22, 0.045), (0.52, 0.30, 0.045), (0.74, 0.17, 0.035)
CORE = 0.2
# Rows of a petal of radius 1 from foot to tip: (position along the petal, half the width, height to which it is bent up).
PETAL = (-0.9, 0.12, 0.22), (-0.3, 0.55, 0.02), (0.35, 0.75, 0.0), (0.85, 0.45, 0.14)


def dress(owner):
    """Show the flakes of an emitter with the material, object or collection that its settings require.

    The objects and materials of the look before stay until snow is removed or the file is closed, since the artist may have changed
    them.
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
    """Remove the material of an emitter's points, and the objects and materials of this module that no emitter uses any more."""
    wiring.set_points_material(registered["snow"], owner, None)
    _drop_unused()


def _own(collection, what):
    """Return the material or object that this module has made before in this file; None if there is none.

    collection: bpy.data.materials or bpy.data.objects. what: value of its custom property KEY.
    """
    return next((one for one in collection if one.get(KEY) == what and one.library is None), None)


def _drop_unused():
    """Remove the flake objects and materials of this module that no emitter uses any more."""
    for look in _SHAPES:
        shape = _own(bpy.data.objects, look)
        if shape is not None and not datablocks.is_used(shape):
            mesh = shape.data
            bpy.data.objects.remove(shape)
            if mesh is not None and mesh.users == 0:
                bpy.data.meshes.remove(mesh)
    for name in (ICE, GLOW, WHITE):
        material = _own(bpy.data.materials, name)
        if material is not None and not datablocks.is_used(material):
            bpy.data.materials.remove(material)


# --- objects and materials of flakes ----------------------------------------------------------------------------------


def _shape(look):
    """Return the object whose instances are flakes of a look; makes it if the file has none.

    The object is in no collection: only the emitters' modifiers show it. look: key of _SHAPES.
    """
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
    """Corners (x, y) of a twig of a crystal's arm, with a pointed end. side: 1 for the left side of the arm, -1 for the right side."""
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
    """Vertices and faces of a petal of radius 1, bent up at its ends and along its sides, so that its tip has a notch."""
    vertices = [place for x, width, z in PETAL for place in ((x, -width, z + 0.1), (x, 0.0, z), (x, width, z + 0.1))]
    rows = range(len(PETAL) - 1)
    return vertices, [(3 * row + side, 3 * row + 3 + side, 3 * row + 4 + side, 3 * row + 1 + side) for row in rows for side in (0, 1)]


def _speck():
    """Vertices and faces of an octahedron of radius 1, the shape of the flakes in the looks Speck and Spark."""
    vertices = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    return vertices, [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]


def _ice():
    """Return the material of crystals, petals and specks: a diffuse surface in the flake's colour, the attribute "tint" of its point."""
    return _own(bpy.data.materials, ICE) or _material(ICE, "ShaderNodeBsdfDiffuse", has_tint=True)


def _glow():
    """Return the material of sparks: it emits light in the flake's colour."""
    found = _own(bpy.data.materials, GLOW)
    if found is None:
        found = _material(GLOW, "ShaderNodeEmission", has_tint=True)
        next(node for node in found.node_tree.nodes if node.type == 'EMISSION').inputs["Strength"].default_value = GLOW_STRENGTH
    return found


def _white():
    """Return the material of bare points: white, because Cycles does not read the colours of bare points."""
    return _own(bpy.data.materials, WHITE) or _material(WHITE, "ShaderNodeBsdfDiffuse", has_tint=False)


def _material(name, kind, has_tint):
    """Make a material with one shader node; it has few nodes, so that the file stays small.

    kind: identifier of the shader node. has_tint: whether it has the instance's colour (attribute "tint"), not white.
    """
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
"""Look -> (name of the object, function that returns vertices and faces, function that returns the material)."""
