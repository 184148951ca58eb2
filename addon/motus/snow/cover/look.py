"""Look of lying snow: the material of a snow cover."""

import bpy

from ...core import wiring
from ...core.blender import datablocks
from ...core.declare import registered
from ...core.file.pointers import pointed

KEY = "motus_snow_cover"
"""Custom property of the material that this module makes, by which the material is found again."""
NAME = "Motus Snow Cover"
COLOR = 0.86, 0.90, 0.96, 1.0
GRAIN, BUMP = 22.0, 0.25


def dress(cover):
    """Set the material of a cover: the one that its settings choose, or else the material that this module makes.

    A material that was made before in this file is used again, with the changes of the artist.
    """
    _set(cover, pointed(cover.motus.snow_cover, "material") or _own() or _new())


def drop(cover):
    """Remove the material from a cover; the material that this module made is removed from the file if nothing uses it."""
    _set(cover, None)
    cover.motus.snow_cover.property_unset("material")
    found = _own()
    if found is not None and not datablocks.is_used(found):
        bpy.data.materials.remove(found)


def _set(cover, material):
    wiring.set_points_material(registered["snow_cover"], cover, material)


def _own():
    return next((one for one in bpy.data.materials if KEY in one and one.library is None), None)


def _new():
    """Make the material of lying snow: white with a little blue, grainy and opaque, as in Solid shading.

    It has few nodes, so that the file stays small.
    """
    material = bpy.data.materials.new(NAME)
    material[KEY] = True
    if not material.use_nodes:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    place, noise, bump, shader, output = (
        nodes.new(kind)
        for kind in (
            "ShaderNodeNewGeometry",
            "ShaderNodeTexNoise",
            "ShaderNodeBump",
            "ShaderNodeBsdfPrincipled",
            "ShaderNodeOutputMaterial",
        )
    )
    for index, node in enumerate(nodes):
        node.location.x = 200.0 * index
    noise.inputs["Scale"].default_value = GRAIN
    noise.inputs["Detail"].default_value = 4.0
    bump.inputs["Strength"].default_value = BUMP
    bump.inputs["Distance"].default_value = 0.02
    shader.inputs["Base Color"].default_value = material.diffuse_color = COLOR  # type: ignore[assignment]
    shader.inputs["Roughness"].default_value = 0.65
    for source, target in (
        (place.outputs["Position"], noise.inputs["Vector"]),
        (noise.outputs[0], bump.inputs["Height"]),
        (bump.outputs["Normal"], shader.inputs["Normal"]),
        (shader.outputs[0], output.inputs["Surface"]),
    ):
        links.new(source, target)
    return material
