"""What lying snow looks like: its material."""

import bpy

from ...core import wiring
from ...core.declare import registered
from ...core.file.pointers import pointed

KEY = "motus_snow_cover"
"""Custom property of the material that is made here, by which it is found again."""
NAME = "Motus Snow Cover"
COLOR = 0.86, 0.90, 0.96, 1.0
GRAIN, BUMP = 22.0, 0.25


def dress(cover):
    """Give the snow its material: the one that was chosen, or one of ours, which somebody may have changed and so stays."""
    _set(cover, pointed(cover.motus.snow_cover, "material") or _own() or _new())


def drop(cover):
    """Take it back."""
    _set(cover, None)
    cover.motus.snow_cover.property_unset("material")
    found = _own()
    if found is not None and found.users == 0:
        bpy.data.materials.remove(found)


def _set(cover, material):
    wiring.set_points_material(registered["snow_cover"], cover, material)


def _own():
    return next((one for one in bpy.data.materials if KEY in one and one.library is None), None)


def _new():
    """White, a little blue, and grainy; closed wherever there is snow, as in Solid. Few nodes, for the file's sake."""
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
